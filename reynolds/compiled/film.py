"""One film at one instant in compiled form: its balance at any gap, pressure and filling."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reynolds.bodies.compliance import WallOperator
from reynolds.compiled import balance_kernels as kernels
from reynolds.compiled.balance_kernels import FlowBalance
from reynolds.compiled.gap_table import GapTable, gap_table, is_isotropic
from reynolds.compiled.gap_table_kernels import Coefficients, Motion, coefficients
from reynolds.compiled.mesh_tables import Conditions, Filling, Mesh, conditions_of, mesh_of
from reynolds.equation.balance import cavity_density
from reynolds.equation.coefficients import at_points
from reynolds.equation.deformation_sparsity import ElasticPatterns
from reynolds.fem.kernels import ROUNDING
from reynolds.laws.fluid import CONSTANT
from reynolds.linear.elastic import NearFactor, WallBalance, compliant_answer, rows_of
from reynolds.linear.factor import ITERATIVE_TOLERANCE, GeneralFactor, Solve
from reynolds.numerics.array_kernels import largest_share
from reynolds.numerics.arrays import Array
from reynolds.problem import Boundary, Cavitation, FilmProblem, FilmSolution, Pocket
from reynolds.solve.boundary import BoundaryValues, pressure_sending, spread
from reynolds.solve.iterate import pocket_feeds
from reynolds.solve.solver import without_full

Marks = NDArray[np.bool_]

NO_SLOPE = np.zeros((1, 1))


def is_compiled(problem: FilmProblem) -> bool:
    """True if a film of this kind has a compiled form.

    Linear elements, roughness without direction, and a cavity that conserves oil or none.
    """
    return is_isotropic(problem.surface) and problem.cavitation is not Cavitation.REYNOLDS and problem.space.degree == 1


@dataclass(frozen=True)
class CompiledFilm:
    """A film's shape at one instant: mesh, laws, motion and conditions, before its gap and pressure are known."""

    problem: FilmProblem
    setting: BoundaryValues
    mesh: Mesh
    table: GapTable
    motion: Motion
    given: Conditions

    def at(self, gap: Array, pressure: Array, fraction: Array, cavity: Marks) -> FilmBalance:
        """The balance at a gap (cells, points) m, pressures (size,) Pa and film fractions (size,).

        Raises as the laws of the oil do.
        """
        problem, film = self.problem, self.problem.film
        viscosity, relative, ratio, slope = film.viscosity, NO_SLOPE, np.ones(len(pressure)), np.zeros(len(pressure))
        per_viscosity = 1.0 / (12.0 * viscosity)
        if problem.fluid is not CONSTANT:
            inside = at_points(problem.space, pressure)
            viscosity, steeper = problem.fluid.viscosity(inside, film.viscosity)
            dense, denser = problem.fluid.density(inside)
            per_viscosity, relative = dense / (12.0 * viscosity), denser / dense - steeper / viscosity
            # Copies: a law may return read-only arrays, for which the kernels would be compiled once more.
            ratio, slope = (np.array(part) for part in problem.fluid.density(pressure))
        c = coefficients(self.table, gap, problem.space.everywhere(per_viscosity), self.motion)
        oil = Filling(pressure, fraction, ratio, slope, relative, cavity_density(problem))
        return FilmBalance(self, viscosity, c, oil, kernels.flow_balance(self.mesh, c, oil, self.given), cavity)

    def with_pockets(self, volumes: Array) -> CompiledFilm:
        """The same with other volumes (size,) m3 of its pockets."""
        return replace(self, given=self.given._replace(pockets=volumes))


def compiled_film(problem: FilmProblem, before: Array, step: float, pockets: Array) -> CompiledFilm:
    """A problem with its oil (size,) m3 one step (s) ago and its pockets' volumes (size,) m3.

    Raises FilmInputError as `solve.boundary.check_pressures`.
    """
    film, space, setting = problem.film, problem.space, spread(problem)
    mean, slip = film.mean_velocity, [a - b for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True)]
    return CompiledFilm(
        problem=problem,
        setting=setting,
        mesh=mesh_of(space),
        table=gap_table(problem.surface, problem.asperities, elastic=problem.walls is not None),
        motion=Motion(*(space.everywhere(part) for part in (*mean, *slip))),
        given=conditions_of(problem, setting, before, step, pockets),
    )


@dataclass(frozen=True)
class FilmBalance:
    """A film's balance at one state."""

    film: CompiledFilm
    viscosity: Array
    coefficients: Coefficients
    oil: Filling
    flow: FlowBalance
    cavity: Marks

    @cached_property
    def fed(self) -> tuple[Array, Array]:
        """The balance less the pockets' feeds (size,) m3/s, and their part of the diagonal."""
        return pocket_feeds(self.film.setting, self.flow.net, self.oil.pressure)

    @property
    def imbalance(self) -> float:
        """Largest residual of a free unknown over the flows that meet there, as `solve.iterate.imbalance_of`."""
        (rest, gain), size = self.fed, self.flow.scale
        if self.film.setting.pockets:
            size = size + np.abs(self.flow.net - rest) + ROUNDING * np.abs(gain * self.oil.pressure)
        if self.cavity.any():
            size = size + np.where(self.cavity, ROUNDING * self.flow.brim, 0.0)
        return float(largest_share(rest, size, ROUNDING, self.film.setting.held))

    @cached_property
    def missing(self) -> float:
        """Sum of the residuals of the free unknowns, m3/s."""
        return float(np.abs(self.fed[0][~self.film.setting.held]).sum())

    @property
    def holds(self) -> Array:
        """Oil of each unknown (size,) m3 that its flows leave there: the residual is kept in the oil content."""
        oil = self.flow.contents * self.oil.fraction * self.oil.ratio
        return oil - self.film.given.step * np.where(self.film.setting.held, 0.0, self.fed[0])

    def solution(self, problem: FilmProblem, deformation: Array | None = None) -> FilmSolution:
        """The film as a solution of `problem`, whose boundary and storage are those of this balance.

        deformation (vertices,) m of elastic walls, None: none.
        """
        c, given = self.coefficients, self.film.problem.film
        thinned = (
            None if given.couette_viscosity is None else given.couette_viscosity * self.viscosity / given.viscosity
        )
        return FilmSolution(
            problem=problem,
            pressure=self.oil.pressure,
            film_fraction=self.oil.fraction,
            film=replace(problem.film, thickness=c.film, viscosity=self.viscosity, couette_viscosity=thinned),
            deformation=np.zeros(len(problem.space.vertices)) if deformation is None else deformation,
            flux=(c.flux_x, c.flux_y),
            content=c.content,
            outflow=-self.flow.net,
            storage_rate=self.flow.grown,
            upwind_exchange=self.flow.mixed,
            flow_scale=self.flow.scale,
            held=self.film.setting.held,
            cavity=without_full(self.cavity, self.oil.fraction),
            path=(self.imbalance,),
        )


@dataclass(frozen=True)
class Linearised:
    """A film's balance, its slopes factorised: changes of pressures and film fractions by inflows and by modes."""

    balance: FilmBalance
    solve: Solve
    unit: float
    scale: float

    def changes(self, inflow: Array, tolerance: float = ITERATIVE_TOLERANCE) -> Array:
        """Changes (size, m) by inflows (size, m) m3/s: Pa, and in the cavity film fractions over `scale`."""
        load = np.where(self.balance.film.setting.held[:, None], 0.0, inflow / self.unit)
        return self.solve(np.ascontiguousarray(load.T), tolerance).T

    def parted(self, change: Array) -> tuple[Array, Array]:
        """Pressures (size, m) Pa and film fractions (size, m) of such changes."""
        cavity = self.balance.cavity[:, None]
        return np.where(cavity, 0.0, change), np.where(cavity, self.scale * change, 0.0)

    def by_thickness(self, modes: Array, pockets: Array) -> Array:
        """dR/dq_j (size, k) m3/s per unit of modes (cells, points, k) and pockets (size, k) m2."""
        at = self.balance
        return kernels.by_thickness(at.film.mesh, at.coefficients, at.oil, at.film.given, at.flow, modes, pockets)

    def oil_by_thickness(self, modes: Array, pockets: Array) -> Array:
        """Change of the oil (size, k) m3 per unit of the modes, pressures and film fractions constant."""
        at = self.balance
        return kernels.oil_by_thickness(at.film.mesh, at.coefficients, at.oil, modes, pockets)

    def oil_by_state(self, pressure: Array, fraction: Array) -> Array:
        """Change of the oil (size, m) m3 by changes of pressures (size, m) Pa and film fractions (size, m)."""
        at = self.balance
        content, oil = at.flow.contents[:, None], at.oil
        dense, denser = oil.ratio[:, None], (oil.fraction * oil.ratio_slope)[:, None]
        return np.asarray(content * (dense * fraction + denser * pressure))

    def stepped(self, pressed: Array, filled: Array) -> tuple[Array, Array, Marks]:
        """Pressures (size,) Pa, film fractions (size,) and cavity after changes of both, as `solve.iterate`."""
        at, setting = self.balance, self.balance.film.setting
        problem = at.film.problem
        level, pressure, fraction = problem.cavitation_pressure, at.oil.pressure + pressed, at.oil.fraction
        self._feed_pockets(pressure)
        if problem.cavitation is Cavitation.NONE:
            return np.where(setting.held, setting.pressure, pressure), fraction, at.cavity
        lack = (fraction + filled - 1.0) * at.flow.lack
        signed = np.where(at.cavity, lack, pressure - level)
        cavity = (signed < 0.0) & ~setting.held
        fraction = np.where(cavity, 1.0 + signed / at.flow.lack, setting.film_fraction)
        return np.where(setting.held, setting.pressure, np.maximum(signed, 0.0) + level), fraction, cavity

    def _feed_pockets(self, pressure: Array) -> None:
        """Give pockets the pressures at which their feeds send the flow of the linear step.

        Behind an orifice flow follows the root of the pressure, on which Newton's method converges slowly or
        oscillates; pressure is a smooth function of the flow.
        """
        at = self.balance
        for node, pocket in at.film.setting.pockets:
            if not at.cavity[node]:
                inflow, slope = pocket.feed(at.oil.pressure[node])
                sent = inflow + slope * (pressure[node] - at.oil.pressure[node])
                pressure[node] = pressure_sending(pocket.feed, sent, float(pressure[node]))


def linearised(balance: FilmBalance, factor: GeneralFactor) -> Linearised:
    """The slopes of a balance between rigid walls, factorised in `factor`, valid until its next use.

    Raises FilmNotConverged where no flow enters the film.
    """
    upper, lower, unit, scale = _newton_matrix(balance)
    factor.update(balance.film.problem.space.matrix(upper), lower, balance.cavity)
    return Linearised(balance, factor.solve, unit, scale)


def linearised_soft(
    balance: FilmBalance, wider: WallOperator, patterns: ElasticPatterns, near: NearFactor
) -> Linearised:
    """The same between elastic walls that the film's pressure opens by `wider` (vertices, size) m/Pa.

    `patterns` are those of the mesh, `near` keeps a factor for later ones. Raises FilmNotConverged where it is
    singular.
    """
    film, pattern = balance.film, patterns.deformation
    upper, lower, unit, scale = _newton_matrix(balance)
    free = (~film.setting.held).astype(float)
    data = kernels.by_deformation(
        film.mesh, balance.coefficients, balance.oil, film.given, free / unit, pattern.slots, pattern.entries
    )
    coupled = WallBalance(patterns.full_matrix(upper, lower), pattern.matrix(data), wider, free * ~balance.cavity)
    return Linearised(balance, rows_of(compliant_answer(coupled, near)), unit, scale)


def _newton_matrix(balance: FilmBalance) -> tuple[Array, Array, float, float]:
    film = balance.film
    return kernels.newton_matrix(
        film.mesh, balance.coefficients, balance.oil, balance.flow, balance.cavity, film.setting.held, balance.fed[1]
    )


def pocket_volumes(problem: FilmProblem, boundary: Mapping[str, Boundary]) -> Array:
    """Volume (size,) m3 at each pocket's unknown of boundaries by name."""
    found = np.zeros(problem.space.size)
    for name, condition in boundary.items():
        if isinstance(condition, Pocket):
            found[problem.space.edge_dofs[name]] += condition.volume
    return found
