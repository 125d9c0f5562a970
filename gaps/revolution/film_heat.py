"""Film temperature over the revolution: each film by its own dissipation, walls by the heat of the turn.

Heat crosses a film in h^2/(pi^2 a), below a millisecond at 30 um, and a turn lasts tens of them: so the temperature of
a film follows its motion without delay (dT/dt at a place of the mesh is neglected). Parts need minutes to warm, so that
each has one temperature, at which the heat that its wall absorbs over the turn leaves it through its resistance. Rounds
of motion with the viscosity so found, and of temperatures at WARMED angles with positions, rates and cavities of that
motion, until viscosity stays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Generic, cast

import numpy as np

from gaps.films.reports import Reported
from gaps.revolution.march import GapRevolution, Leg, TurnReport, no_report, run_revolution
from gaps.revolution.schedule import Accuracy, Schedule
from gaps.revolution.stopped import TurnStopped
from gaps.revolution.warmth import Found, GapTemperatures, HeatFlows, ViscosityRatios, thinned
from reynolds.equation.coefficients import at_points
from reynolds.errors import FilmNotConverged, InputError
from reynolds.floating.problem import Floating
from reynolds.floating.stage import FloatingStage
from reynolds.floating.start import places_of
from reynolds.laws.fluid import Fluid, isoviscous
from reynolds.numerics.anderson import History
from reynolds.numerics.arrays import Array
from reynolds.problem import HALF, FilmProblem, FilmSolution
from reynolds.solve.solver import FilmSolver
from reynolds.thermal.coupling import Coupled, LocalLaw, ThermalCase, agree, resting_viscosity
from reynolds.thermal.energy import FilmTemperature, Heat
from reynolds.thermal.film_profile import levels
from reynolds.thermal.walls import GivenTemperature

WARMED, FEWEST = 24, 4  # angles of a turn with their own temperatures, and of a pitch at least
CLOSE = 0.01  # relative change of viscosity by one more round, root mean square
MOST_ROUNDS = 12
ROUGHLY = 1e-2  # relative change of viscosity within an angle, at first
THINS = 3e-3  # 1/K: a tenth of the thinning of oils
MOST_WALL_ROUNDS = 40


@dataclass(frozen=True)
class HeatTolerance:
    """Changes at which temperatures count as settled: of walls, K, and relative of viscosity within an angle."""

    walls: float
    viscosity: float


SETTLED, COLD = HeatTolerance(0.05, 1e-3), HeatTolerance(1.0, ROUGHLY)
"""Of a motion with its temperatures, and of one without heat on the way there."""


@dataclass(frozen=True)
class Sink:
    """Heat sink of a wall: a temperature (K) behind a resistance (m2 K/W, thickness over conductivity).

    Without resistance the wall has that temperature; an infinite one passes no heat.
    """

    temperature: float
    resistance: float = 0.0


@dataclass(frozen=True)
class GapHeat:
    """Oil and walls of a gap that warms, SI.

    density, specific_heat, conductivity of the oil; temperature (K) of inflow; thins(T): viscosity over that at this
    temperature; heat sinks of the fixed and of the moving wall. The work of compression is neglected: oil from a
    chamber is as cold as oil from the case, and throttling warms it by dp/(rho c).
    """

    density: float
    specific_heat: float
    conductivity: float
    temperature: float
    thins: Callable[[Array], Array]
    fixed: Sink
    moving: Sink

    @property
    def outside(self) -> Array:
        """Temperatures (2,) K to which the fixed and the moving wall give their heat."""
        return np.array([self.fixed.temperature, self.moving.temperature])

    def of(self, problem: FilmProblem, walls: Array) -> Heat:
        """Heat of a film between walls of such temperatures (2,) K."""
        return Heat(
            density=self.density,
            specific_heat=self.specific_heat,
            conductivity=self.conductivity,
            fixed_wall=GivenTemperature(float(walls[0])),
            moving_wall=GivenTemperature(float(walls[1])),
            inflow=dict.fromkeys(problem.boundary, self.temperature),
            port_temperature=self.temperature,
        )


def warm_revolution(
    solver: FilmSolver,
    floating: Floating,
    schedule: Schedule,
    start: Array,
    report_of: Callable[[FloatingStage], Reported],
    heat: GapHeat,
    *,
    accuracy: Accuracy | None = None,
    before: GapRevolution[Reported] | None = None,
    report: TurnReport = no_report,
) -> GapRevolution[Reported]:
    """The periodic motion of a gap and its temperatures that agree, with `warmth`; else as `run_revolution`.

    Afterwards one more round would change viscosity by CLOSE at most (root mean square), where `accuracy` is settled.
    Raises as `run_revolution`, FilmInputError where the oil's law ends, and FilmNotConverged.
    """
    began, films, found, spent = perf_counter(), 0, before, {}
    accuracy = accuracy or Accuracy()
    warmed = _warmed_angles(schedule.angles)
    schedule = replace(schedule, breaks=np.union1d(schedule.breaks, warmed))  # their films are needed
    warm = _Warming(floating, schedule.speed, warmed, report_of, heat, None if before is None else before.warmth)
    for rounds in range(1, MOST_ROUNDS + 1):
        moving = thinned(floating, schedule.speed, warm.shares)
        found = run_revolution(
            solver, moving, schedule, start, warm.report_of, accuracy=accuracy, before=found,
            report=_of_round(report, rounds),
        )  # fmt: skip
        films += found.films_solved
        if warm.shares is None:  # the motion without heat, which any way to it has
            spent = dict(found.spent)
        first = warm.shares is None and not accuracy.settled
        warmth = warm.of(found, rounds, COLD if first else SETTLED)
        if warmth.change <= CLOSE or not accuracy.settled:
            spent[Leg.HEAT] = perf_counter() - began - sum(spent.values())
            return replace(found, films_solved=films, spent=spent, warmth=warmth)
    raise FilmNotConverged(
        f"{floating.name}: motion and temperature do not agree after {MOST_ROUNDS} rounds (viscosity still "
        f"changes by {warmth.change:.2g})",
        "less load, walls that take more heat, or a film without heat",
    )


def _of_round(report: TurnReport, number: int) -> TurnReport:
    return lambda turn, share: report(f"warming {number}, {turn}", share)


class _Warming(Generic[Reported]):
    """Temperatures of one gap: gathers films as its turn passes, and warms them."""

    def __init__(
        self,
        floating: Floating,
        speed: float,
        angles: Array,
        report_of: Callable[[FloatingStage], Reported],
        heat: GapHeat,
        last: GapTemperatures | None,
    ) -> None:
        """`angles` (n,) rad, at which steps end, have temperatures; speed rad/s."""
        self._floating, self._heat, self._report_of = floating, heat, report_of
        self._angles, self._times = angles, angles / speed
        self._gathered: dict[float, FilmSolution] = {}
        self._solver = FilmSolver(floating.shape_at(0.0).space)
        self._warm: dict[float, Found] = {}
        if last is not None and len(last.films) == len(angles):
            self._warm = dict(zip(self._times, last.films, strict=True))
        self._walls = heat.outside if last is None else last.walls
        self.shares = None if last is None else last.shares

    def report_of(self, stage: FloatingStage) -> Reported:
        """Report of a stage; its film is kept at the warmed angles."""
        if stage.time in self._times:
            self._gathered[stage.time] = stage.solution
        return self._report_of(stage)

    def of(self, found: GapRevolution[Reported], rounds: int, enough: HeatTolerance) -> GapTemperatures:
        """The temperatures of the films gathered over the turn just passed, within the tolerance."""
        rubbing = float(np.mean([instant.report.heat.rubbing for instant in found.turn.instants]))
        self._settle(rubbing, enough)
        films = [self._warm[time] for time in self._times]
        logs = self._over_turn([np.log(one.share) for one in films])
        shares, before = ViscosityRatios(np.concatenate([[0.0], self._angles]), logs), self.shares
        self.shares = shares
        change = shares.logs if before is None else shares.logs - before.logs
        return GapTemperatures(
            shares=shares,
            film=self._over_turn([one.heat.mean for one in films]),
            walls=self._walls,
            mean=np.array([_mean(one) for one in films]),
            hottest=np.array([one.heat.highest.max() for one in films]),
            flows=self._flows(rubbing),
            change=float(np.sqrt(np.mean(change**2))),
            rounds=rounds,
            films=tuple(films),
        )

    def _settle(self, rubbing: float, enough: HeatTolerance) -> None:
        """Warm all films, and the walls by the heat that they absorb over the turn, until their temperatures settle.

        Films need not agree with their viscosity better than the change of the walls allows.
        """
        history, near = History(), None
        agreed = enough.viscosity if self._warm else ROUGHLY  # those of the round before need no nearing
        for _ in range(MOST_WALL_ROUNDS):
            for time in self._times:
                near = self._warm[time] = self._warmed(time, agreed, self._warm.get(time, near))
            image = self._wall_image(rubbing)
            change = float(np.abs(image - self._walls).max())
            if change < enough.walls and agreed <= enough.viscosity:
                return
            agreed = min(ROUGHLY, max(enough.viscosity, THINS * change))
            self._walls = history.extrapolate(self._walls, image)
        raise FilmNotConverged(
            f"{self._floating.name}: temperature of the walls not settled after {MOST_WALL_ROUNDS} rounds",
            "walls that take more heat",
        )

    def _wall_image(self, rubbing: float) -> Array:
        """Walls (2,) K at which their resistance passes the absorbed heat; the film's conductance damps."""
        heat, flows = self._heat, self._flows(rubbing)
        films = [self._warm[time].film for time in self._times]
        area = self._mean([float(film.problem.space.area.sum()) for film in films])
        passing = [float(np.sum(heat.conductivity / film.film.thickness * film.problem.space.area)) for film in films]
        taken = np.array([flows.to_fixed, flows.to_moving]) / area
        return wall_image(heat, self._walls, taken, self._mean(passing) / area)

    def _warmed(self, time: float, agreed: float, near: Found | None) -> Found:
        """The film at a time, with viscosity and temperature consistent to `agreed`, at fixed shape.

        It starts from a film near it, if any.

        The viscosity is that under the pressure of the motion, to which the pressure of a film of given shape
        converges: under its own pressure, the oil of a thin film between rigid walls would stiffen without bound.
        """
        cold, film, heat = self._floating.shape_at(time), self._gathered[time], self._heat
        under = at_points(film.problem.space, film.pressure)
        stiff = np.asarray(cold.fluid.viscosity(under, cold.film.viscosity)[0])
        resting = replace(film.problem.film, viscosity=stiff, couette_viscosity=None, moving_share=HALF)
        problem = replace(film.problem, film=resting, fluid=Fluid(isoviscous, cold.fluid.density))
        posed = ThermalCase(problem, local_law(problem, heat), heat.of(problem, self._walls), at_once=True)
        try:
            return _with_heat(agree(posed, levels(), agreed, self._solver, near))
        except (InputError, FilmNotConverged) as reason:
            angle = float(self._angles[self._times == time][0])
            why = reason.what if isinstance(reason, FilmNotConverged) else str(reason)
            raise TurnStopped(
                f"temperature of the {self._floating.name} at {np.degrees(angle):.5g} deg: {why}",
                "less load, a thicker oil, or a film without heat",
                angle,
            ) from None

    def _over_turn(self, of_films: list[Array]) -> Array:
        """Values of the films at their unknowns, preceded by the turn's start: its end's, at moved places."""
        first, last = (self._floating.shape_at(time).space for time in (0.0, self._times[-1]))
        return np.array([of_films[-1][places_of(first, last).unknowns], *of_films])

    def _flows(self, rubbing: float) -> HeatFlows:
        """Heat, mean over the turn; rubbing (W) heats the walls in contact."""
        heats = [self._warm[time].heat for time in self._times]
        return HeatFlows(
            dissipation=self._mean([one.dissipation for one in heats]),
            rubbing=rubbing,
            to_fixed=self._mean([one.to_fixed for one in heats]) + 0.5 * rubbing,
            to_moving=self._mean([one.to_moving for one in heats]) + 0.5 * rubbing,
            convected_out=self._mean([one.convected_out for one in heats]),
            stored=self._mean([one.stored for one in heats]),
        )

    def _mean(self, values: list[float]) -> float:
        """Mean over the turn of values at the warmed angles."""
        return float(np.average(values, weights=np.diff(self._angles, prepend=0.0)))


def wall_image(heat: GapHeat, walls: Array, taken: Array, conductance: float) -> Array:
    """Walls (2,) K nearer to those that conduct the absorbed heat, `taken` (2,) W/m2, through their resistance.

    The film's own conductance (W/(m2 K)) damps: a warmer wall absorbs less.
    """
    resistance = np.array([heat.fixed.resistance, heat.moving.resistance])
    missing = resistance * taken - (walls - heat.outside)
    return np.asarray(walls + missing / (1.0 + resistance * conductance))


def _warmed_angles(angles: Array) -> Array:
    """Those of the reported angles that have temperatures: WARMED a turn, the last among them."""
    reported = len(angles)
    count = min(reported, max(FEWEST, round(WARMED * angles[-1] / (2.0 * np.pi))))
    return np.asarray(angles[np.round(reported * np.arange(1, count + 1) / count).astype(int) - 1])


def local_law(problem: FilmProblem, heat: GapHeat) -> LocalLaw:
    """The gap's oil (webs over ports of their own viscosity), thinned under any pressure as under none."""

    def law(temperature: Array, pressure: Array, rate: Array) -> Array:
        return np.asarray(resting_viscosity(problem, pressure[:, 0])[:, None] * heat.thins(temperature))

    return law


def _with_heat(found: Coupled[FilmTemperature | None]) -> Found:
    assert found.heat is not None  # one was posed
    return cast("Found", found)


def _mean(found: Found) -> float:
    """Mean temperature (K) of the oil in a film."""
    return float(np.average(found.heat.mean, weights=found.film.holds))
