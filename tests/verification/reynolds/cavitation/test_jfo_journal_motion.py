"""Film equation: a journal that moves under a dynamic load, with mass-conserving cavitation.

Film and body are one implicit step: the force balance holds with the film at the end of the step. Ausas, Jai and
Buscaglia 2009; all quantities are without dimension.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from reynolds import (
    ZERO,
    Cell,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Storage,
    film,
    film_space,
    loads,
    rectangle,
)

MASS, VISCOSITY = 1e-6, 1.0 / 6.0  # div(h^3 grad p) = d(theta h)/dx + 2 d(theta h)/dt
SIDES = {"bottom": Held(0.0075), "top": Held(0.0)}
BALANCED = 1e-6  # of forces, of which the load is 0.01
NUDGE = 1e-6  # of the place, for the slope of the force


def _load(t: float) -> np.ndarray:
    early, late = (np.exp(-400.0 * ((t % 1.0) - at) ** 2) for at in (0.25, 0.5))
    return np.array([0.01 * (early + 0.95534 * late), 0.0029552 * late])


@dataclass(frozen=True)
class Journal:
    """The film's space and solver, cos and sin of the angle at its points and integrated over the film."""

    space: FilmSpace
    solver: FilmSolver
    normal: np.ndarray
    integrated: np.ndarray

    def thickness(self, place: np.ndarray) -> np.ndarray:
        return np.asarray(1.0 + np.tensordot(place, self.normal, 1))

    def film(self, place: np.ndarray, storage: Storage, start: FilmSolution | None) -> FilmSolution:
        posed = film(self.thickness(place), VISCOSITY, velocity_moving=(np.ones((1, 1)), ZERO))
        return self.solver.solve(FilmProblem(self.space, posed, SIDES, storage=storage), start)


@dataclass(frozen=True)
class State:
    """Place and velocity of the journal, and the film there (None at the start)."""

    time: float
    place: np.ndarray
    velocity: np.ndarray
    held: np.ndarray
    film: FilmSolution | None
    slope: np.ndarray | None  # of the forces by the place, as last known


def _journal(around: int, across: int) -> Journal:
    space = film_space(rectangle((1.0, 0.1), (around, across), cell=Cell.QUADRILATERAL, periodic_x=True))
    angle = 2.0 * np.pi * space.points[0]
    normal = np.stack([np.cos(angle), np.sin(angle)])
    return Journal(space, FilmSolver(space), normal, np.stack([space.lumped(part) for part in normal]))


def _stepped(journal: Journal, before: State, step: float) -> State:
    """The journal one step on: M (V - V_old)/step = load + film, by Broyden's method from the slope last known."""
    time, storage = before.time + step, Storage(before.held, step)

    def missing(place: np.ndarray, start: FilmSolution | None) -> tuple[np.ndarray, FilmSolution]:
        found = journal.film(place, storage, start)
        inertia = MASS * ((place - before.place) / step - before.velocity) / step
        return inertia - _load(time) - journal.integrated @ found.pressure, found

    place = before.place + step * before.velocity
    place = place * min(1.0, 0.99 / np.hypot(*place))
    left, solution = missing(place, before.film)
    slope = before.slope
    for count in range(30):
        if np.abs(left).max() < BALANCED:
            velocity = (place - before.place) / step
            return State(time, place, velocity, solution.holds, solution, slope)
        if slope is None or count % 6 == 5:
            nudged = [missing(place + nudge, solution)[0] for nudge in NUDGE * np.eye(2)]
            slope = np.column_stack([(there - left) / NUDGE for there in nudged])
        move = -np.linalg.solve(slope, left)
        move = move * min(1.0, 0.5 * (1.0 - np.hypot(*place)) / np.hypot(*move))
        place, earlier = place + move, left
        left, solution = missing(place, solution)
        slope = slope + np.outer(left - earlier - slope @ move, move) / (move @ move)
    raise AssertionError(f"forces not balanced at t = {time:g}: {left}")


def _motion(journal: Journal, start: float, end: float, step: float) -> Iterator[State]:
    place = np.array([0.5, 0.5])
    held = journal.space.lumped(journal.thickness(place))
    state = State(start, place, np.zeros(2), held, None, None)
    for number in range(round((end - start) / step)):
        state = replace(_stepped(journal, state, step), time=start + (number + 1) * step)
        yield state


UPWIND = (
    "the listed values carry first-order upwinding of the full film: with the thickness half a cell upstream in "
    "its flux this solver gives e_max .9344, pmax 1.869 on 100 x 10 cells (listed .9338, 1.811), else .951, 1.95"
)
PLACES = (  # time, X, Y; and whether the listed digits are met within 1 % of the clearance
    (0.25, 0.85181, 0.06108, True), (0.4, 0.81881, 0.39644, True), (0.5, 0.79033, 0.48744, True),
    (0.6, 0.71928, 0.60092, True), (0.75, 0.32734, 0.87333, False), (0.9, -0.12062, 0.92056, False),
)  # fmt: skip


def test_dynamically_loaded_journal(validation):
    """From t = .2 on, by .6 the start is forgotten: the period up to 1.6.

    The least eccentricity ratio converges slowly: .3446, .3492, .3529, .3558 on 48 x 6 to 384 x 48 cells; listed
    are .3426 on 100 x 10 and .3507 on 200 x 20. Near the listed mesh, 192 x 24, it is 0.6 % above.
    """
    start, step, places, peaks = 0.2, 2e-3, {}, []
    for state in _motion(_journal(96, 12), start, 1.6, step):
        solution = state.film
        assert solution is not None
        assert loads(solution).mass_balance_error < 1e-10
        assert solution.pressure.min() >= 0.0
        if state.time > 0.6 + 0.5 * step:
            places[round(state.time % 1.0, 6)] = state.place
            peaks.append(solution.pressure.max())
    for time, x, y, met in PLACES:
        for name, expected, obtained in zip("XY", (x, y), places[time], strict=True):
            validation(
                case="Dynamically loaded journal bearing",
                source="Ausas, Jai and Buscaglia 2009, own solution on 200 x 20 cells",
                quantity=f"{name} at t = {time:g}",
                unit="1",
                expected=expected,
                obtained=obtained,
                tolerance=0.01,
                note="tolerance 1 % of the clearance",
                missed="" if met else UPWIND,
            )
    eccentricity = [float(np.hypot(*place)) for place in places.values()]
    when = list(places)
    flat = "from .54 to .1 of the next period the eccentricity ratio creeps, here from .941 to .951; " + UPWIND
    for quantity, expected, obtained, missed in (
        ("time of the largest eccentricity ratio", 0.558, when[int(np.argmax(eccentricity))], flat),
        ("time of the largest pressure", 0.502, when[int(np.argmax(peaks))], ""),
    ):
        validation(
            case="Dynamically loaded journal bearing",
            source="Ausas, Jai and Buscaglia 2009, own solution on 200 x 20 cells",
            quantity=quantity,
            unit="1",
            expected=expected,
            obtained=obtained,
            tolerance=0.01,
            note="tolerance 1 % of the period",
            missed=missed,
        )
    rows = (
        ("largest eccentricity ratio", 0.93841, max(eccentricity), UPWIND),
        ("least eccentricity ratio", 0.35071, min(eccentricity), ""),
        ("largest pressure", 1.8961, max(peaks), UPWIND),
        ("least film thickness", 0.06159, 1.0 - max(eccentricity), UPWIND),
    )
    for quantity, expected, obtained, missed in rows:
        validation(
            case="Dynamically loaded journal bearing",
            source="Ausas, Jai and Buscaglia 2009, own solution on 200 x 20 cells",
            quantity=quantity,
            unit="1",
            expected=expected,
            obtained=obtained,
            relative_tolerance=0.01,
            missed=missed,
        )
