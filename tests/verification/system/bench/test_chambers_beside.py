"""Chambers that go along the steps of others that differ little: differences in which the steps' errors cancel."""

from dataclasses import replace

import numpy as np
import pytest

from reynolds.errors import NotConverged
from system import BenchPoints, load_pump
from system.bench.chamber_map import Courses, MapProblem, beside, other_gaps, solve_map
from system.bench.setting import setting
from system.pump.chamber import layout as col
from system.pump.chamber.layout import PATHS
from system.work.threads import side_by_side

PUMP = load_pump("ref90")
TOLERANCE = 1e-5


def _problem(**changed) -> MapProblem:
    speed = np.array([1000.0, 2100.0, 2100.0, 600.0]) * np.pi / 30.0
    whole = np.ones(4)
    points = BenchPoints(
        speed + changed.get("speed", 0.0), np.array([1.0, 0.4, 0.7, 0.28]),
        np.array([5e6, 35e6, 20e6, 30e6]) + changed.get("p_out", 0.0),
        2.5e6 * whole, 0.15e6 * whole, 323.0 * whole, 320.0 * whole, np.arange(4.0), np.arange(4.0), 0.0 * whole,
    )  # fmt: skip
    values = {name: value for name, value in changed.items() if name not in ("speed", "p_out")}
    return setting(PUMP, points, values, 10).problem


def _shown(courses: Courses) -> np.ndarray:
    """Mass out by both ports and work (N, 3): what flows and torque are read from."""
    totals = courses.totals
    return np.column_stack([totals.outflow.delivery, totals.outflow.suction, totals.indicated_work])


@pytest.mark.parametrize(
    "changed",
    [{"p_out": 1e5}, {"speed": 0.3}, {"dead_volume": 1.01 * PUMP.pump.dead_volume}, {"displacement": 1.002}],
    ids=lambda one: next(iter(one)),
)
def test_differences_are_those_of_fine_steps(changed):
    """At equal steps errors cancel: 0.5 % of the largest change of a flow, all within the tolerance."""
    before, after = _problem(), _problem(**changed)
    fine = [_shown(solve_map(PUMP, problem, 1e-9)) for problem in (before, after)]
    courses = solve_map(PUMP, before, TOLERANCE)
    along = _shown(beside(PUMP, courses, after, TOLERANCE)) - _shown(courses)
    expected = fine[1] - fine[0]
    off = np.abs(along - expected)
    assert np.all(off[:, :2].max(axis=0) < 5e-3 * np.abs(expected[:, :2]).max(axis=0))
    assert np.all(off < TOLERANCE * np.abs(fine[0]))


def test_pressure_between_steps_is_that_of_fine_steps():
    """Every second sample lies within a step: within 30 times the tolerance of a step, its mean within one."""
    problem = _problem()
    found, fine = (solve_map(PUMP, problem, tolerance).pressure for tolerance in (TOLERANCE, 1e-9))
    off = (found - fine) / np.ptp(fine, axis=1)[:, None]
    assert np.abs(off).max() < 30.0 * TOLERANCE
    assert np.abs(off.mean(axis=1)).max() < TOLERANCE


def test_the_same_chambers_have_the_same_courses():
    problem = _problem()
    courses = solve_map(PUMP, problem, TOLERANCE)
    again = beside(PUMP, courses, problem, TOLERANCE)
    span = np.ptp(courses.pressure, axis=1)[:, None]
    assert np.abs(again.pressure - courses.pressure).max() < 10.0 * TOLERANCE * span.max()
    assert _shown(again) == pytest.approx(_shown(courses), rel=1e-6)


def test_chambers_too_unlike_are_solved_for_themselves():
    """Steps of a soft chamber are too long for a stiff one; its courses are those of the map to the last digit."""
    soft = _problem(bulk_modulus=0.4 * PUMP.oil.bulk_modulus)
    stiff = _problem(bulk_modulus=2.0 * PUMP.oil.bulk_modulus)
    led = beside(PUMP, solve_map(PUMP, soft, TOLERANCE), stiff, TOLERANCE)
    alone = solve_map(PUMP, stiff, TOLERANCE)
    solved = np.all(_shown(led) == _shown(alone), axis=1)
    assert np.any(solved)
    assert np.all(led.pressure[solved] == alone.pressure[solved])
    assert _shown(led) == pytest.approx(_shown(alone), rel=1e-4)


@pytest.mark.parametrize("share", [1, 3])
def test_threads_change_no_digit(monkeypatch, share):
    """Points of a map are shared out in slices; their steps are put end to end as one thread lays them."""
    problem, other = _problem(), _problem(bulk_modulus=1.01 * PUMP.oil.bulk_modulus)
    thinner = _problem(viscosity=0.99)
    found = []
    for threads in (1, 4):
        monkeypatch.setattr("system.work.threads.cores", lambda threads=threads: threads)
        monkeypatch.setattr("system.bench.chamber_map.FEWEST", share)
        courses = solve_map(PUMP, problem, TOLERANCE)
        found.append((courses, beside(PUMP, courses, other, TOLERANCE), other_gaps(courses, thinner)))
    for one, many in zip(*found, strict=True):
        assert np.array_equal(one.pressure, many.pressure)
        assert np.array_equal(one.integrals, many.integrals)
    assert np.array_equal(found[0][0].steps.trail, found[1][0].steps.trail)
    assert np.array_equal(found[0][0].steps.begins, found[1][0].steps.begins)


def test_a_task_s_fault_is_raised_and_results_keep_their_order(monkeypatch):
    monkeypatch.setattr("system.work.threads.cores", lambda: 3)
    assert np.concatenate(side_by_side(lambda some: np.arange(some.start, some.stop), 20)).tolist() == list(range(20))
    assert side_by_side(lambda some: (some.start, some.stop), 0) == [(0, 0)]

    def faulty(some: slice) -> None:
        if some.stop == 20:
            raise NotConverged("the last one")

    with pytest.raises(NotConverged, match="the last one"):
        side_by_side(faulty, 20)


def test_worn_ports_are_not_gone_along():
    problem = _problem()
    worn = replace(problem, wear=replace(problem.wear, groove_advance=problem.wear.groove_advance + 0.05))
    assert not problem.has_ports_of(worn)


@pytest.mark.parametrize(
    "changed",
    [
        {"film_thickness.piston": 1.001 * PUMP.piston.radial_clearance},
        {"film_thickness.slipper": 1.001 * PUMP.slipper.film_thickness},
        {"film_thickness.valve_plate": 0.999 * PUMP.valve_plate.film_thickness},
        {"viscosity": 1.001},
        {"eccentricity_ratio": PUMP.piston.eccentricity_ratio + 1e-3},
    ],
    ids=lambda one: next(iter(one)),
)
def test_first_order_changes_of_gaps_are_those_of_fine_steps(changed):
    """Oil of the ports and leakage to 1 %; the work to a hundredth of its tolerance."""
    before, after = _problem(), _problem(**changed)
    fine = [solve_map(PUMP, problem, 1e-10).integrals for problem in (before, after)]
    courses = solve_map(PUMP, before, TOLERANCE)
    first_order = other_gaps(courses, after).integrals - courses.integrals
    expected = fine[1] - fine[0]
    off = np.abs(first_order - expected)
    assert np.all(off[:, :PATHS].sum(axis=0) < 0.01 * np.abs(expected[:, [col.DELIVERY]]).sum())
    assert np.all(off[:, col.WORK] < 1e-2 * TOLERANCE * np.abs(fine[0][:, col.WORK]))


def test_first_order_changes_conserve_oil():
    """Added leakage of the gaps is missing at the ports."""
    courses = solve_map(PUMP, _problem(), TOLERANCE)
    thicker = _problem(**{"film_thickness.slipper": 1.05 * PUMP.slipper.film_thickness})
    out = (other_gaps(courses, thicker).integrals - courses.integrals)[:, :PATHS]
    assert np.all(np.abs(out.sum(axis=1)) < 2e-3 * out[:, col.SLIPPER])


def test_courses_beside_others_are_not_gone_along():
    problem = _problem()
    near = beside(PUMP, solve_map(PUMP, problem, TOLERANCE), problem, TOLERANCE)
    for follow in (lambda: other_gaps(near, problem), lambda: beside(PUMP, near, problem, TOLERANCE)):
        with pytest.raises(ValueError, match="expected courses of solve_map"):
            follow()
