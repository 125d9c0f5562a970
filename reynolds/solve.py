"""Pressure of a film: Newton on the flow balance of every unknown.

Each step solves the linearised balance for the change of pressure. Without cavitation and with linear feeds
the first step is exact; the second would change nothing. Reynolds' condition is the complementarity
p >= p_c, r >= 0, (p - p_c) r = 0 solved by a primal-dual active set (Hintermueller, Ito and Kunisch 2002)
that starts from coarser problems.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds import kernels
from reynolds.cascade import COARSEST, nested_cavity
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import Cavitation, Film, FilmProblem, FilmSolution, Held, Pocket
from reynolds.linear import Factor
from reynolds.mesh import Array
from reynolds.space import FilmSpace

MAX_ITERATIONS = 100
TOLERANCE = 1e-9
SMALLEST_CONDUCTANCE = 1e-250  # m3/(Pa s): products of less are no longer numbers of full precision


@dataclass(frozen=True)
class _Setting:
    """Boundary conditions spread over the unknowns."""

    pressure: Array
    held: NDArray[np.bool_]
    pockets: tuple[tuple[int, Pocket], ...]


class FilmSolver:
    """Solves films on one space, its vertices moved or not; keeps the symbolic factorisation between calls."""

    def __init__(self, space: FilmSpace) -> None:
        self._pattern = space.pattern
        self._factor = Factor()

    def solve(self, problem: FilmProblem, start: FilmSolution | None = None) -> FilmSolution:
        """The pressure field of `problem`; `start` warms pressures and cavity.

        Afterwards every free unknown's flow balance holds to 1e-9 of the flows meeting there. Raises
        FilmInputError as `check_pressures` does, and FilmNotConverged when the active set does not settle.
        """
        space = problem.space
        if space.pattern is not self._pattern:
            raise FilmInputError("space", "another mesh", "the space of this solver, moved or not")
        setting = _spread(problem)
        with np.errstate(over="ignore"):  # told of in words
            flows = flow_terms(problem.film)
        _check_conductance(flows[0])
        pressure = setting.pressure.copy()
        if start is not None:
            pressure = np.where(setting.held, pressure, start.pressure)
        stiffness = assemble(space, flows[0])
        cavity = np.zeros(space.size, dtype=bool)
        if problem.cavitation is Cavitation.REYNOLDS:
            found = start.cavity if start is not None else _first_cavity(space, setting, stiffness, flows)
            cavity = found & ~setting.held
            pressure[cavity] = problem.cavitation_pressure
        for iteration in range(1, MAX_ITERATIONS + 1):
            pressure = self._step(space, pressure, setting, setting.held | cavity, stiffness, flows)
            balance, size = flow_balance(space, flows, pressure)
            new_cavity = _cavity(problem, pressure, balance, size, cavity, setting)
            settled = bool(np.array_equal(new_cavity, cavity))
            pressure[new_cavity] = problem.cavitation_pressure
            imbalance = _imbalance(balance, size, setting, cavity, pressure)
            if settled and imbalance < TOLERANCE:
                return FilmSolution(problem, pressure, -balance, setting.held, cavity, imbalance, iteration)
            cavity = new_cavity
        raise FilmNotConverged(
            f"film pressure not settled after {MAX_ITERATIONS} iterations (imbalance {imbalance:.2g}, "
            f"{int(cavity.sum())} of {space.size} unknowns cavitated)",
            "a finer or more regular (Delaunay) mesh, or triangles instead of stretched quadrilaterals",
        )

    def _step(
        self,
        space: FilmSpace,
        pressure: Array,
        setting: _Setting,
        fixed: NDArray[np.bool_],
        stiffness: Array,
        flows: FlowTerms,
    ) -> Array:
        """Newton step of the free unknowns; fixed ones stay at the pressure they have."""
        matrix, load = _linearised(space, pressure, setting, fixed, stiffness, flows)
        self._factor.update(matrix)
        return pressure + self._factor.solve(load)


def _linearised(
    space: FilmSpace,
    pressure: Array,
    setting: _Setting,
    fixed: NDArray[np.bool_],
    stiffness: Array,
    flows: FlowTerms,
) -> tuple[csc_array, Array]:
    """Upper triangle and right-hand side of the balance for the change of pressure, identity where fixed."""
    balance, _ = flow_balance(space, flows, pressure)
    gain = np.zeros(space.size)
    for node, pocket in setting.pockets:
        inflow, slope = pocket.feed(pressure[node])
        balance[node] -= inflow
        gain[node] = -slope
    # Conductances are 1e-15 to 1e-9: scaled to order one they stay clear of any pivot threshold.
    scale = stiffness.max()
    data = np.empty_like(stiffness)
    pattern = space.pattern
    kernels.hold(pattern.indptr, pattern.indices, stiffness / scale, fixed, gain / scale, data)
    return space.matrix(data), np.where(fixed, 0.0, -balance / scale)


def _first_cavity(space: FilmSpace, setting: _Setting, stiffness: Array, flows: FlowTerms) -> NDArray[np.bool_]:
    """Cavity to start from: none on a small mesh, else what coarser problems find."""
    if space.size <= COARSEST:
        return np.zeros(space.size, dtype=bool)
    # Free unknowns of the spread pressures stand at cavitation pressure: the step from there is p - p_c.
    return nested_cavity(*_linearised(space, setting.pressure, setting, setting.held, stiffness, flows))


def assemble(space: FilmSpace, conductance: Array) -> Array:
    """Entries of int h^3/(12 mu) grad p . grad f, upper triangle in the space's pattern (m3/(s Pa)).

    `conductance` (cells | 1, points | 1) is h^3/(12 mu), m3/(Pa s).
    """
    reference = space.reference
    data = np.empty(len(space.pattern.indices))
    kernels.stiffness(
        space.vertices, space.cells, space.dofs, space.pattern.slots, reference.gradient,
        reference.geometry_gradient, reference.weights, conductance, data,
    )  # fmt: skip
    return data


FlowTerms = tuple[Array, Array, Array, Array]


def flow_terms(film: Film) -> FlowTerms:
    """Conductance h^3/(12 mu), Couette flow h (U1 + U2)/2 in x and y, and squeeze, at quadrature points."""
    h = film.thickness
    mean_x = 0.5 * (film.velocity_moving[0] + film.velocity_fixed[0])
    mean_y = 0.5 * (film.velocity_moving[1] + film.velocity_fixed[1])
    return h**3 / (12.0 * film.viscosity), h * mean_x, h * mean_y, film.squeeze


def _check_conductance(conductance: Array) -> None:
    if conductance.min() < SMALLEST_CONDUCTANCE or not np.isfinite(conductance).all():
        found = f"h^3/(12 mu) from {conductance.min():.3g} to {conductance.max():.3g} m3/(Pa s)"
        raise FilmInputError("film", found, f"finite and at least {SMALLEST_CONDUCTANCE:g}")


def flow_balance(space: FilmSpace, flows: FlowTerms, pressure: Array) -> tuple[Array, Array]:
    """Flow balance of every unknown (size,) m3/s, and the size of the flows that meet there (see `kernels`)."""
    out, size = np.empty(space.size), np.empty(space.size)
    reference = space.reference
    kernels.residual(
        space.vertices, space.cells, space.dofs, reference.value, reference.gradient,
        reference.geometry_gradient, reference.weights, *flows, pressure, out, size,
    )  # fmt: skip
    return out, size


def check_pressures(problem: FilmProblem) -> None:
    """Raise FilmInputError where no pressure is solved for.

    That is where a boundary is not of the mesh, where a piece of the film has no pressure level, or where a
    boundary lies below cavitation pressure.
    """
    _spread(problem)


def _spread(problem: FilmProblem) -> _Setting:
    space = problem.space
    names = space.film_mesh.boundary_names
    level = problem.cavitation_pressure if problem.cavitation is Cavitation.REYNOLDS else 0.0
    pressure = np.full(space.size, level)
    held = np.zeros(space.size, dtype=bool)
    pockets = []
    for name, condition in problem.boundary.items():
        if name not in space.edge_dofs:
            raise FilmInputError(f"boundary {name}", "no boundary of this mesh", f"one of {', '.join(names)}")
        nodes = space.edge_dofs[name]
        if isinstance(condition, Held):
            pressure[nodes], held[nodes] = condition.pressure, True
        elif len(nodes) == 1:
            pockets.append((int(nodes[0]), condition))
        else:
            raise FilmInputError(f"boundary {name}", "a pocket on separate nodes", "film_space(pockets=...)")
    if problem.held_nodes is not None:
        more = ~np.isnan(problem.held_nodes)
        pressure[more], held[more] = problem.held_nodes[more], True
    if not np.isfinite(pressure).all():
        raise FilmInputError("boundary", "a pressure that is not finite", "a number of Pa")
    fed = held.copy()
    fed[[node for node, pocket in pockets if pocket.feed(level)[1] < 0.0]] = True
    if dry := space.pattern.pieces_without(fed):
        where = f"in {dry} of {space.pattern.pieces[0]} separate pieces of the film" if fed.any() else "anywhere"
        raise FilmInputError("boundary", f"no pressure given {where}", "a boundary with a pressure at each piece")
    if problem.cavitation is Cavitation.REYNOLDS and (low := pressure[held].min(initial=np.inf)) < level:
        raise FilmInputError(
            "boundary", f"pressure {low:.4g} Pa", f"at least the cavitation pressure {level:.4g} Pa"
        )
    return _Setting(pressure, held, tuple(pockets))


def _cavity(
    problem: FilmProblem,
    pressure: Array,
    balance: Array,
    size: Array,
    cavity: NDArray[np.bool_],
    setting: _Setting,
) -> NDArray[np.bool_]:
    if problem.cavitation is Cavitation.NONE:
        return cavity
    enters = ~cavity & (pressure < problem.cavitation_pressure)
    # A node that nothing drives (balance zero but for round-off) would otherwise enter and leave for ever.
    stays = cavity & (balance > -TOLERANCE * size)
    return (enters | stays) & ~setting.held


def _imbalance(
    balance: Array, size: Array, setting: _Setting, cavity: NDArray[np.bool_], pressure: Array
) -> float:
    free = ~(setting.held | cavity)
    rest = balance.copy()
    for node, pocket in setting.pockets:
        inflow, slope = pocket.feed(pressure[node])
        rest[node] -= inflow
        size[node] += abs(inflow) + kernels.ROUNDING * abs(slope * pressure[node])
    scale = np.where(size > 0.0, size, 1.0)
    return float(np.max(np.abs(rest[free]) / scale[free], initial=0.0))
