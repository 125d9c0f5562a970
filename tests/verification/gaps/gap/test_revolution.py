"""Gap over the revolution: periodic floating films.

A plate on a spring and an oil film against its closed form; a journal with a cavity against a march of many turns.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from gaps import Accuracy, GapRevolution, Schedule, evenly, run_revolution
from reynolds import (
    ALEXANDER_2,
    ZERO,
    Array,
    Cavitation,
    Cell,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Floating,
    FloatingStage,
    Held,
    Outer,
    boundary_flows,
    film,
    film_space,
    integrate,
    nodes_only,
    rectangle,
    ring,
    solve_stage,
    started,
    steady,
)
from reynolds.floating.start import places_of, restarted
from reynolds.numerics.dirk import within

LENGTH, WIDTH, THICKNESS, VISCOSITY, SPEED = 0.01, 0.002, 1e-5, 0.03, 220.0
DAMPING = VISCOSITY * LENGTH**3 * WIDTH / THICKNESS**3  # N s/m, of a strip open at both ends
SWAY = 0.2  # N: a thousandth of the film
CLOSE = Accuracy(closed=1e-7)


def _strip() -> FilmSpace:
    return film_space(rectangle((LENGTH, WIDTH), (32, 1), cell=Cell.QUADRILATERAL, periodic_y=True))


def _plate(space: FilmSpace, stiffness: float) -> Floating:
    """h = q, on a spring without force at THICKNESS, pulled by SWAY cos wt."""
    shape = replace(_flat(space), film=replace(_flat(space).film, thickness=ZERO))
    slopes = np.array([[-stiffness]])

    def outer(time: float, q: Array, rate: Array) -> Outer:
        return Outer(SWAY * np.cos(SPEED * time) - stiffness * (q - THICKNESS), slopes, np.zeros((1, 1)))

    return Floating("plate", lambda t: shape, lambda t: np.ones((len(space.vertices), 1)), outer)


def _flat(space: FilmSpace) -> FilmProblem:
    return FilmProblem(space, film(THICKNESS, VISCOSITY), {"left": Held(0.0), "right": Held(0.0)}, Cavitation.NONE)


def _swayed(
    share: float, schedule: Schedule, look: Callable[[FloatingStage], float] | None = None, **options
) -> GapRevolution[float]:
    """The plate's revolution, for a spring of `share` times the film's c w; reports the film's power by itself."""
    space = _strip()
    floating = _plate(space, share * DAMPING * SPEED)
    start = np.array([1.001 * THICKNESS])
    return run_revolution(
        FilmSolver(space), floating, schedule, start, look or _power, **{"accuracy": CLOSE, **options}
    )


def _power(stage: FloatingStage) -> float:
    return float(stage.film_force @ stage.rate)


@pytest.mark.parametrize("share", [0.02, 1.0, 20.0])
def test_plate_on_a_spring(share, validation):
    """c h' + k h = W cos wt, found from far away in two turns and a third that shows it."""
    found = _swayed(share, evenly(SPEED, 90, keep=1))
    wave = 2.0 * np.mean((found.positions[:, 0] - THICKNESS) * np.exp(-1j * found.angles))
    exact = SWAY / (DAMPING * SPEED * (share + 1j))
    source = "closed form: c h' + k h = W cos wt"
    # Cells 1/32 (squared), steps 2 pi/90 (squared, over three), and the film's stiffening by a thousandth.
    tolerance = 2e-3
    validation(
        case="Plate on a spring and an oil film, over the revolution",
        source=source,
        quantity=f"amplitude, k/(c w) = {share:g}",
        unit="m",
        expected=abs(exact),
        obtained=abs(wave),
        relative_tolerance=tolerance,
    )
    validation(
        case="Plate on a spring and an oil film, over the revolution",
        source=source,
        quantity=f"phase, k/(c w) = {share:g}",
        unit="rad",
        expected=np.angle(exact),
        obtained=np.angle(wave),
        tolerance=tolerance,
    )
    validation(
        case="Plate on a spring and an oil film, over the revolution",
        source=source,
        quantity=f"left of a disturbance, k/(c w) = {share:g}",
        unit="1",
        expected=np.exp(-2.0 * np.pi * share),
        obtained=found.closing.multipliers[0].real,
        tolerance=tolerance,
    )
    assert found.closing.turns <= 3
    assert found.turn.step_error < 1.0


def test_oil_returns_and_work_is_spent():
    """Over the turn as much oil leaves as enters, and the load's work is what the film takes."""
    found = _swayed(1.0, evenly(SPEED, 120, keep=1))
    instants = found.turn.instants
    drained = _swayed(1.0, evenly(SPEED, 120, keep=1), look=lambda stage: sum(boundary_flows(stage.solution).values()))
    flow = np.array([instant.report for instant in drained.turn.instants])
    assert abs(flow.sum()) < 1e-5 * np.abs(flow).sum()
    load = np.array([SWAY * np.cos(instant.angle) * instant.rate[0] for instant in instants])
    assert -np.sum([instant.report for instant in instants]) == pytest.approx(load.sum(), rel=1e-3)
    assert load.sum() > 0.0


def test_what_is_reported_and_kept():
    schedule = replace(evenly(SPEED, 24), breaks=np.radians([33.0, 200.0]), keep=8)
    found = _swayed(1.0, schedule)
    np.testing.assert_array_equal(found.angles, schedule.angles)
    assert found.angles[-1] == 2.0 * np.pi
    assert sorted(found.turn.films) == [schedule.angles[7], schedule.angles[15], schedule.angles[23]]
    assert set(schedule.breaks / SPEED) <= set(found.turn.times)
    least = found.least_film
    assert least.film_thickness_min == pytest.approx(found.positions.min(), rel=1e-9)
    assert least.mean_film == pytest.approx(least.position[0], rel=1e-9)
    assert found.films_solved >= 2 * len(found.turn.times) * found.closing.turns
    np.testing.assert_allclose(least.film_force + least.outer_force, 0.0, atol=1e-6 * SWAY)


def test_between_its_steps():
    """Angles inside a step have its motion, and what passes between them adds up to what passes in all."""
    accuracy = Accuracy(step=0.0, floor=1e-10, closed=1e-7)
    wide, fine = (_swayed(1.0, evenly(SPEED, 360, keep=keep), accuracy=accuracy) for keep in (60, 1))
    assert len(wide.turn.times) < 120
    np.testing.assert_array_equal(wide.angles, fine.angles)
    sway = np.ptp(fine.positions)
    np.testing.assert_allclose(wide.positions, fine.positions, atol=1e-2 * sway)
    forces = np.array([[at.film_force[0] for at in one.turn.instants] for one in (wide, fine)])
    np.testing.assert_allclose(*forces, atol=1e-2 * np.ptp(forces))
    few = _swayed(1.0, evenly(SPEED, 6, keep=1), accuracy=accuracy)
    np.testing.assert_array_equal(few.turn.times, wide.turn.times)
    spent = [np.mean([at.passed for at in one.turn.instants]) for one in (wide, few)]
    assert spent[0] == pytest.approx(spent[1], rel=1e-9)


def test_a_break_beside_a_node_is_one():
    """A break that round-off parts from an even angle is no step of its own."""
    even = evenly(SPEED, 180)
    beside = np.nextafter(2.0 * np.pi * np.arange(1, 24) / 24, 7.0)  # the turn of wide steps has these angles
    assert np.diff(replace(even, breaks=beside).wide.nodes).min() > 0.1 / SPEED
    kept = np.nextafter(even.kept, 7.0)
    np.testing.assert_array_equal(replace(even, breaks=kept).nodes, even.nodes)


def test_goes_on_from_another():
    first = _swayed(0.02, evenly(SPEED, 60))
    again = _swayed(0.02, evenly(SPEED, 60), before=first)
    assert again.closing.turns == 1
    np.testing.assert_allclose(again.positions, first.positions, atol=2e-3 * THICKNESS)


def test_a_turn_joins_the_one_before():
    """Where a film forgets its start, the turn that shows that the one before closes ends as soon as they meet."""
    first = _swayed(4.0, evenly(SPEED, 90, keep=1))
    looks: list[float] = []

    def look(stage: FloatingStage) -> float:
        looks.append(stage.time)
        return _power(stage)

    joined = _swayed(4.1, evenly(SPEED, 90, keep=1), look, before=first)
    assert joined.closing.turns == 2
    assert 2 * 90 < len(looks) < 3 * 90  # two stages a step of one whole turn, and of less than half of the next
    whole = _swayed(4.1, evenly(SPEED, 90, keep=1))
    np.testing.assert_allclose(joined.positions, whole.positions, atol=CLOSE.closed * THICKNESS)
    np.testing.assert_array_equal(joined.angles, whole.angles)
    assert sorted(joined.turn.films) == sorted(whole.turn.films)
    assert np.diff(joined.turn.times).min() > 0.0
    passed = np.array([[at.passed for at in one.turn.instants] for one in (joined, whole)])
    np.testing.assert_allclose(*passed, rtol=1e-4, atol=1e-3 * np.abs(passed).max())


def test_steps_by_their_error():
    """Half the tolerance of a step brings the motion nearer to that of the finest steps."""
    fine = _swayed(1.0, evenly(SPEED, 720, keep=1)).positions[179::180]
    gaps = []
    for floor in (3e-11, 3e-12):
        accuracy = Accuracy(step=0.0, floor=floor, closed=1e-7)
        found = _swayed(1.0, evenly(SPEED, 4), accuracy=accuracy)
        gaps.append(float(np.abs(found.positions - fine).max()))
        assert gaps[-1] < len(found.turn.times) * floor
    assert gaps[1] < 0.5 * gaps[0]


def _journal(space: FilmSpace) -> Floating:
    """A journal under a load that turns half as fast as it does, and swells: h = 1 + X cos + Y sin, JFO."""
    angle = 2.0 * np.pi * space.vertices[:, 0]
    modes = np.column_stack([np.cos(angle), np.sin(angle)])
    shape = FilmProblem(
        space, film(1.0, 1.0 / 6.0, velocity_moving=(np.ones((1, 1)), ZERO)), {"bottom": Held(0.0075), "top": Held(0.0)}
    )

    def load(time: float) -> Outer:
        return steady(0.004 * (1.2 + np.sin(2.0 * np.pi * time)) * np.array([1.0, 0.3 * np.cos(2.0 * np.pi * time)]))

    return Floating("journal", lambda t: shape, lambda t: modes, lambda t, q, rate: load(t))


def test_journal_with_a_cavity():
    """The turn that closes is the one that many turns lead to, and its multipliers are how fast they do."""
    space = film_space(rectangle((1.0, 0.1), (16, 2), cell=Cell.QUADRILATERAL, periodic_x=True))
    floating, solver = _journal(space), FilmSolver(space)
    accuracy = Accuracy(step=0.0, floor=5e-3, closed=1e-6)
    found = run_revolution(
        solver, floating, evenly(2.0 * np.pi, 8), np.array([0.3, 0.3]), lambda stage: None, accuracy=accuracy
    )
    assert found.closing.turns <= 6
    assert any(instant.cavitated_area_fraction > 0.05 for instant in found.turn.instants)
    # One more turn from beside it, with the same steps: ends beside it by the slopes.
    nudge = np.array([1e-5, -2e-5])
    ends = []
    for side in (1.0, -1.0):
        begin = restarted(floating, 0.0, found.turn.last, found.turn.end + side * nudge)
        *_, taken = integrate(ALEXANDER_2, partial(solve_stage, solver, floating), begin, found.turn.times, nodes_only)
        ends.append(taken.state.q)
    np.testing.assert_allclose((ends[0] - ends[1]) / 2.0, found.turn.slopes @ nudge, atol=2e-3 * 2e-5)


def test_refused():
    space = _strip()
    plate = _plate(space, 1e5)
    with pytest.raises(FilmInputError, match="revolution: angles"):
        run_revolution(FilmSolver(space), plate, Schedule(SPEED, np.array([1.0, 0.5])), np.array([1e-5]), _power)
    with pytest.raises(FilmInputError, match="walls apart"):
        run_revolution(FilmSolver(space), plate, evenly(SPEED, 10), np.array([-1e-5]), _power)
    end = started(plate, 0.0, np.array([1e-5]))
    solve = partial(solve_stage, FilmSolver(space), plate)
    *_, taken = integrate(ALEXANDER_2, solve, end, [1e-4], within(1e-8))
    with pytest.raises(FilmInputError, match="plate, start of a turn"):
        restarted(plate, 0.0, taken.state, np.array([-1e-5]))


def test_a_plate_without_spring_never_closes():
    """Pushed down for ever, it sinks for ever."""
    space = _strip()
    plate = replace(_plate(space, 0.0), outer_at=lambda t, q, rate: steady(np.array([-5.0])))
    with pytest.raises(FilmNotConverged, match="not periodic after 30 turns"):
        run_revolution(FilmSolver(space), plate, evenly(SPEED, 4), np.array([1e-5]), _power)


def test_places_of_a_mesh_that_turned_by_a_pitch():
    """A ring of nine alike sectors: what its film holds goes over to the sector before."""
    space = film_space(ring(np.array([0.03, 0.035, 0.05]), 18))
    assert np.array_equal(places_of(space, space).unknowns, np.arange(space.size))
    c, s = np.cos(2.0 * np.pi / 9.0), np.sin(2.0 * np.pi / 9.0)
    turned = space.moved(space.vertices @ np.array([[c, s], [-s, c]]))
    seats = places_of(space, turned).unknowns
    field = np.empty(space.size)
    field[turned.vertex_dofs] = np.arctan2(*turned.vertices.T[::-1])
    there = np.arctan2(*space.vertices.T[::-1])
    np.testing.assert_allclose(np.exp(1j * field[seats][space.vertex_dofs]), np.exp(1j * there), atol=1e-12)
    with pytest.raises(FilmInputError, match="mesh at the end of a turn"):
        places_of(space, space.moved(1.01 * space.vertices))
