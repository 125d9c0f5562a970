"""The gap between piston and cylinder bore, unwrapped.

Film plane: x = radius x angle in [0, pi d), sewn at the seam; y axial from the chamber's end (0) to the case's
end (engaged length). Angle 0 points to the inner dead centre's side, along which the swash plate pushes; the
frame does not turn with the block, so both walls may spin in it. Boundaries: chamber, case.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gaps.balance import find_equilibrium, into_disc, start_towards
from gaps.result import SMALLEST_FILM, GapFilm, PositionSource, wall_power
from reynolds.film import ZERO, Cavitation, FilmProblem, FilmSolution, Held, film
from reynolds.loads import boundary_flows, evaluate, loads
from reynolds.mesh import Array, Cell, rectangle, rename
from reynolds.solve import FilmSolver
from reynolds.space import FilmSpace, film_space


@dataclass(frozen=True)
class PistonGeometry:
    """Piston diameter and radial clearance (m)."""

    diameter: float
    radial_clearance: float


@dataclass(frozen=True)
class PistonState:
    """Instant of a piston, SI: engaged length m, pressures Pa, cavitation pressure Pa, viscosity Pa s.

    velocity m/s of the piston out of the block; spins rad/s of piston and bore about the bore axis in the
    frame that does not turn.
    """

    engaged_length: float
    chamber_pressure: float
    case_pressure: float
    cavitation_pressure: float
    viscosity: float
    velocity: float
    piston_spin: float
    bore_spin: float


@dataclass(frozen=True)
class PistonLoad:
    """Side force (x, y) N on the piston, acting `arm` m beyond the case's end of the engaged length."""

    force: tuple[float, float]
    arm: float


def eccentric(geometry: PistonGeometry, ratio: float, direction: tuple[float, float]) -> Array:
    """Position of a parallel piston pushed by `ratio` of the clearance in a direction: (ex, ey, ex, ey) m."""
    unit = np.array(direction) / max(np.hypot(*direction), 1e-300)
    return np.tile(ratio * geometry.radial_clearance * unit, 2)


class PistonGap:
    """Films of one piston; the mesh (around, along) follows the engaged length without being rebuilt.

    A position is the piston axis' eccentricity (m) at the chamber's and the case's end: (ex0, ey0, ex1, ey1).
    """

    def __init__(self, geometry: PistonGeometry, cells: tuple[int, int] = (48, 12)) -> None:
        self.geometry = geometry
        mesh = rectangle((np.pi * geometry.diameter, 1.0), cells, cell=Cell.QUADRILATERAL, periodic_x=True)
        self._unit = film_space(rename(mesh, {"bottom": "chamber", "top": "case"}))
        self._space = self._unit
        self._solver = FilmSolver(self._unit)
        self._last: FilmSolution | None = None

    def _stretched(self, engaged_length: float) -> FilmSpace:
        if self._space.vertices[:, 1].max() != engaged_length:
            self._space = self._unit.moved(self._unit.vertices * [1.0, engaged_length])
        return self._space

    def thickness(self, space: FilmSpace, position: Array) -> Array:
        """h = c - e(y) . (cos, sin), e linear between the two ends (m)."""
        x, y = space.points
        along = y / space.vertices[:, 1].max()
        angle = 2.0 * x / self.geometry.diameter
        ex = position[0] + (position[2] - position[0]) * along
        ey = position[1] + (position[3] - position[1]) * along
        return self.geometry.radial_clearance - ex * np.cos(angle) - ey * np.sin(angle)

    def problem(self, state: PistonState, position: Array) -> FilmProblem:
        """The film problem at a position; raises FilmInputError where the piston touches the bore."""
        space = self._stretched(state.engaged_length)
        radius = 0.5 * self.geometry.diameter
        around = [np.full((1, 1), spin * radius) for spin in (state.piston_spin, state.bore_spin)]
        return FilmProblem(
            space=space,
            film=film(
                self.thickness(space, position),
                state.viscosity,
                velocity_moving=(around[0], np.full((1, 1), state.velocity)),
                velocity_fixed=(around[1], ZERO),
            ),
            boundary={"chamber": Held(state.chamber_pressure), "case": Held(state.case_pressure)},
            cavitation=Cavitation.JFO,
            cavitation_pressure=state.cavitation_pressure,
        )

    def solve(self, state: PistonState, position: Array) -> FilmSolution:
        """The film at a position, warm from the last one."""
        self._last = self._solver.solve(self.problem(state, position), self._last)
        return self._last

    def force(self, solution: FilmSolution) -> Array:
        """Film force on the piston and its moment about mid-length: (Fx, Fy, Mx, My), N and N m.

        F = -int p n dA, M = -int p n (y - l/2) dA with n = (cos, sin).
        """
        space = solution.problem.space
        x, y = space.points
        angle = 2.0 * x / self.geometry.diameter
        weighted = -evaluate(solution, solution.pressure)[0] * space.area
        lever = y - 0.5 * space.vertices[:, 1].max()
        return np.array(
            [
                np.sum(weighted * np.cos(angle)),
                np.sum(weighted * np.sin(angle)),
                np.sum(weighted * np.cos(angle) * lever),
                np.sum(weighted * np.sin(angle) * lever),
            ]
        )

    def at(self, state: PistonState, load: PistonLoad, position: Array) -> GapFilm:
        """The gap at a given position; the film need not balance the load, and the result says how far."""
        return self._report(
            self.solve(state, position), state, load, position, PositionSource.GIVEN, "position given"
        )

    def balanced(self, state: PistonState, load: PistonLoad, given: Array, near: Array | None = None) -> GapFilm:
        """The gap at the position where film force and moment balance the side force, else at `given`.

        Quasi-static: the position follows the load at once (no squeeze). `near` is tried first. Where no film
        of at least SMALLEST_FILM balances, the gap stands at `given` and the verdict says why.
        """
        outer = self._outer(state, load)
        scale = max(float(np.hypot(*load.force)), 1.0)
        scales = scale * np.array([1.0, 1.0, 0.5 * state.engaged_length, 0.5 * state.engaged_length])
        reach = self.geometry.radial_clearance - SMALLEST_FILM
        if reach <= 0.0:
            verdict = f"the clearance leaves no room for a film of {SMALLEST_FILM * 1e6:.1f} um all round"
            return self._report(self.solve(state, given), state, load, given, PositionSource.GIVEN, verdict)

        def position(free: Array) -> Array:
            return reach * np.concatenate([into_disc(free[:2]), into_disc(free[2:])])

        def imbalance(free: Array) -> Array:
            return (self.force(self.solve(state, position(free))) + outer) / scales

        starts = [np.concatenate([start_towards(e / reach) for e in (given[:2], given[2:])]), np.full(4, 1e-3)]
        if near is not None:
            starts.insert(0, np.concatenate([start_towards(e / reach) for e in (near[:2], near[2:])]))
        answer = find_equilibrium(imbalance, starts)
        if answer.found:
            place = position(answer.unknowns)
            return self._report(
                self.solve(state, place), state, load, place, PositionSource.BALANCE, "force and moments balance"
            )
        verdict = (
            f"no film of at least {SMALLEST_FILM * 1e6:.1f} um balances a side force of {scale:.0f} N acting "
            f"{load.arm * 1e3:.1f} mm outside the bore ({answer.miss})"
        )
        return self._report(self.solve(state, given), state, load, given, PositionSource.GIVEN, verdict)

    def again(self, before: GapFilm, state: PistonState, load: PistonLoad, given: Array) -> GapFilm:
        """The gap at its given position, with the verdict of an earlier search that found no balance."""
        solution = self.solve(state, given)
        return self._report(solution, state, load, given, PositionSource.GIVEN, before.verdict)

    def _outer(self, state: PistonState, load: PistonLoad) -> Array:
        fx, fy = load.force
        arm = 0.5 * state.engaged_length + load.arm
        return np.array([fx, fy, fx * arm, fy * arm])

    def conductance(self, state: PistonState, position: Array) -> float:
        """Pressure flow from chamber to case per pressure difference, m3/(s Pa), of this film at rest."""
        problem = self.problem(state, position)
        still = replace(problem.film, velocity_moving=(ZERO, ZERO), velocity_fixed=(ZERO, ZERO))
        answer = self._solver.solve(
            FilmProblem(problem.space, still, {"chamber": Held(1.0), "case": Held(0.0)}, Cavitation.NONE)
        )
        return boundary_flows(answer)["case"]

    def _report(
        self,
        solution: FilmSolution,
        state: PistonState,
        load: PistonLoad,
        position: Array,
        source: PositionSource,
        verdict: str,
    ) -> GapFilm:
        integrals = loads(solution)
        wanted = float(np.hypot(*load.force))
        along = np.array(load.force) / max(wanted, 1e-300)
        return GapFilm(
            solution=solution,
            loads=integrals,
            source=source,
            position=position,
            chamber_flow=-integrals.flow["chamber"],
            leakage_flow=integrals.flow["case"],
            conductance=self.conductance(state, position),
            friction_power=wall_power(solution),
            required_load=wanted,
            carried_load=-float(self.force(solution)[:2] @ along),
            verdict=verdict,
        )
