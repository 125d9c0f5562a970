"""The gap between slipper and swash plate: sealing lands around a pocket fed through the piston.

Film plane: origin under the ball joint, x along the sliding velocity, z the plate's normal away from the block,
y = z cross x. The frame does not turn. Boundaries: pocket, case, and groove_1, .. between lands.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gaps.balance import START_WITHIN, find_equilibrium, into_disc, start_towards
from gaps.result import SMALLEST_FILM, GapFilm, PositionSource, wall_power
from gaps.slipper_lands import SlipperLands, slipper_mesh
from reynolds.film import ZERO, Boundary, Cavitation, FilmProblem, FilmSolution, Held, Pocket, film, no_feed
from reynolds.loads import boundary_flows, loads, pressure_integrals
from reynolds.mesh import Array
from reynolds.solve import FilmSolver
from reynolds.space import FilmSpace, film_space


@dataclass(frozen=True)
class SlipperGeometry:
    """Sealing lands, and diameter and length of the orifice that feeds the pocket (m)."""

    lands: SlipperLands
    orifice_diameter: float
    orifice_length: float


@dataclass(frozen=True)
class SlipperState:
    """Instant of a slipper, SI: pressures Pa, viscosity Pa s, sliding speed m/s (along x), spin rad/s."""

    chamber_pressure: float
    case_pressure: float
    cavitation_pressure: float
    viscosity: float
    sliding_speed: float
    spin: float


@dataclass(frozen=True)
class SlipperLoad:
    """What presses the slipper on: force N towards the plate, and the moments that the film must hold.

    moment_x, moment_y (N m) are integrals of p y and of -p x over the film and pocket, pressures above case.
    """

    force: float
    moment_x: float
    moment_y: float


@dataclass(frozen=True)
class SlipperPosition:
    """Film thickness under the ball joint (m) and the slopes dh/dx and dh/dy (rad)."""

    film_thickness: float
    slope_x: float
    slope_y: float


def hagen_poiseuille_conductance(diameter: float, length: float, viscosity: float) -> float:
    """Laminar flow per pressure drop of a capillary, pi d^4/(128 mu l), m3/(s Pa); paper Eq. (16).

    Valid for l/d > 3 or so and Re d/l << 64; a short orifice adds rho/2 (q/(Cd A))^2.
    """
    return float(np.pi * diameter**4 / (128.0 * viscosity * length))


def hydrostatic_film(geometry: SlipperGeometry, state: SlipperState, force: float) -> float:
    """Film thickness (m) at which a parallel slipper carries a force by its pocket; 0 where no pocket can.

    Lift `effective_area` p gives the pocket's pressure p above case; orifice and lands, in series, pass the same
    flow: pi h^3 p/(6 mu ln(r2/r1)) = G_orifice (p_chamber - p_case - p).
    """
    log, pocket = geometry.lands.log_ratio, force / geometry.lands.effective_area
    left = max(state.chamber_pressure - state.case_pressure - pocket, 0.0)
    orifice = hagen_poiseuille_conductance(geometry.orifice_diameter, geometry.orifice_length, state.viscosity)
    return float(np.cbrt(6.0 * state.viscosity * log * orifice * left / (np.pi * pocket)))


class SlipperGap:
    """Films of one slipper on a ring mesh (radial, around); the pocket is one unknown fed by the orifice."""

    def __init__(self, geometry: SlipperGeometry, cells: tuple[int, int] = (12, 48)) -> None:
        self.geometry = geometry
        self._space = film_space(slipper_mesh(geometry.lands.radii, cells), pockets=geometry.lands.closed)
        self._solver = FilmSolver(self._space)
        self._last: FilmSolution | None = None

    def thickness(self, space: FilmSpace, position: SlipperPosition) -> Array:
        """h = h0 + slope_x x + slope_y y (m)."""
        x, y = space.points
        return position.film_thickness + position.slope_x * x + position.slope_y * y

    def problem(self, state: SlipperState, position: SlipperPosition) -> FilmProblem:
        """The film problem at a position, in the frame that moves with the slipper (film steady in it)."""
        x, y = self._space.points
        conductance = hagen_poiseuille_conductance(
            self.geometry.orifice_diameter, self.geometry.orifice_length, state.viscosity
        )

        def feed(pressure: float) -> tuple[float, float]:
            return conductance * (state.chamber_pressure - pressure), -conductance

        return FilmProblem(
            space=self._space,
            film=film(
                self.thickness(self._space, position),
                state.viscosity,
                velocity_moving=(-state.spin * y, state.spin * x),
                velocity_fixed=(np.full((1, 1), -state.sliding_speed), ZERO),
            ),
            boundary=self._boundary(Pocket(feed), Held(state.case_pressure)),
            cavitation=Cavitation.JFO,
            cavitation_pressure=state.cavitation_pressure,
        )

    def _boundary(self, pocket: Boundary, case: Held) -> dict[str, Boundary]:
        """Edges by name: pocket, closed grooves without supply, vented grooves and rim."""
        lands = self.geometry.lands
        still = {name: Pocket(no_feed) for name in lands.closed}
        return still | {"pocket": pocket} | dict.fromkeys(lands.open, case)

    def solve(self, state: SlipperState, position: SlipperPosition) -> FilmSolution:
        """The film at a position, warm from the last one."""
        self._last = self._solver.solve(self.problem(state, position), self._last)
        return self._last

    def pocket_pressure(self, solution: FilmSolution, name: str = "pocket") -> float:
        """Pressure in the pocket, or in a closed groove (Pa)."""
        return float(solution.pressure[self._space.edge_dofs[name][0]])

    def force(self, solution: FilmSolution, state: SlipperState) -> Array:
        """Lift of film, pocket and closed grooves above case pressure and its moments: (F, Mx, My), N and N m."""
        load, moment_x, moment_y = pressure_integrals(solution)
        lift = load - state.case_pressure * float(self._space.area.sum())
        for name, area in self.geometry.lands.closed_areas().items():
            lift += (self.pocket_pressure(solution, name) - state.case_pressure) * area
        return np.array([lift, moment_x, moment_y])

    def at(self, state: SlipperState, load: SlipperLoad, position: SlipperPosition) -> GapFilm:
        """The gap at a given position; the film need not balance the load, and the result says how far."""
        return self._report(state, load, position, PositionSource.GIVEN, "position given")

    def balanced(
        self,
        state: SlipperState,
        load: SlipperLoad,
        given: SlipperPosition,
        near: SlipperPosition | None = None,
    ) -> GapFilm:
        """The gap at the mean film and tilt where force and moments balance, else at `given`.

        Quasi-static (no squeeze). `near` is tried first. Where no film of at least SMALLEST_FILM balances, the
        gap stands at `given` and the verdict says why.
        """
        radius = self.geometry.lands.outer_radius
        if load.force <= 0.0:
            verdict = f"the slipper is pulled off the plate ({-load.force:.0f} N held by the retainer)"
            return self._report(state, load, given, PositionSource.GIVEN, verdict)
        outer = np.array([load.force, load.moment_x, load.moment_y])
        scales = load.force * np.array([1.0, radius, radius])

        # Between the smallest film and a twentieth of the land's width (thin film) in the logarithm.
        low, high = np.log(SMALLEST_FILM), np.log(0.05 * (radius - self.geometry.lands.inner_radius))
        middle, half = 0.5 * (low + high), 0.5 * (high - low)

        def position(free: Array) -> SlipperPosition:
            thickness = float(np.exp(middle + half * np.tanh(free[0])))
            slope = (thickness - SMALLEST_FILM) / radius * into_disc(free[1:])
            return SlipperPosition(thickness, float(slope[0]), float(slope[1]))

        def free(at: SlipperPosition) -> Array:
            level = np.clip((np.log(at.film_thickness) - middle) / half, -START_WITHIN, START_WITHIN)
            room = np.exp(middle + half * level) - SMALLEST_FILM
            slope = np.array([at.slope_x, at.slope_y]) * radius / room
            return np.concatenate([[np.arctanh(level)], start_towards(slope)])

        def imbalance(unknowns: Array) -> Array:
            return (self.force(self.solve(state, position(unknowns)), state) - outer) / scales

        floating = max(hydrostatic_film(self.geometry, state, load.force), 3.0 * SMALLEST_FILM)
        starts = [free(given), free(SlipperPosition(floating, 0.0, 0.0))]
        if near is not None:
            starts.insert(0, free(near))
        answer = find_equilibrium(imbalance, starts)
        if answer.found:
            place = position(answer.unknowns)
            return self._report(state, load, place, PositionSource.BALANCE, "force and moments balance")
        verdict = (
            f"no film of at least {SMALLEST_FILM * 1e6:.1f} um balances {load.force:.0f} N with moments "
            f"({load.moment_x:.2f}, {load.moment_y:.2f}) N m ({answer.miss})"
        )
        return self._report(state, load, given, PositionSource.GIVEN, verdict)

    def again(self, before: GapFilm, state: SlipperState, load: SlipperLoad, given: SlipperPosition) -> GapFilm:
        """The gap at its given position, with the verdict of an earlier search that found no balance."""
        return self._report(state, load, given, PositionSource.GIVEN, before.verdict)

    def conductance(self, state: SlipperState, position: SlipperPosition) -> float:
        """Pressure flow from chamber through orifice and land per pressure difference, m3/(s Pa), at rest."""
        problem = self.problem(state, position)
        still = replace(problem.film, velocity_moving=(ZERO, ZERO), velocity_fixed=(ZERO, ZERO))
        edges = self._boundary(Held(1.0), Held(0.0))
        flows = boundary_flows(self._solver.solve(FilmProblem(problem.space, still, edges, Cavitation.NONE)))
        land = sum(flows[name] for name in self.geometry.lands.open)
        orifice = hagen_poiseuille_conductance(
            self.geometry.orifice_diameter, self.geometry.orifice_length, state.viscosity
        )
        return land * orifice / (land + orifice)

    def _report(
        self,
        state: SlipperState,
        load: SlipperLoad,
        position: SlipperPosition,
        source: PositionSource,
        verdict: str,
    ) -> GapFilm:
        solution = self.solve(state, position)
        integrals = loads(solution)
        return GapFilm(
            solution=solution,
            loads=integrals,
            source=source,
            position=np.array([position.film_thickness, position.slope_x, position.slope_y]),
            chamber_flow=-integrals.flow["pocket"],
            leakage_flow=sum(integrals.flow[name] for name in self.geometry.lands.open),
            conductance=self.conductance(state, position),
            friction_power=wall_power(solution),
            required_load=max(load.force, 0.0),
            carried_load=float(self.force(solution, state)[0]),
            verdict=verdict,
        )
