"""A floating point from its neighbour's motion: the same point, in fewer films; and the same on finer levels."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gaps.films.physics import Effect, Physics
from reynolds import FilmNotConverged
from swashfilm.runs.pump.refine import point_numbers, refine_point, refined
from system import RIGID, FloatingOptions, floating_point, load_pump, operating_point
from system.points.floating import FloatingPoint
from system.points.table import sources
from system.points.table.sources import FloatingSolver

COARSE = FloatingOptions(RIGID, steps=36, finer=0.25)
STILL = {f"{part}.spin_ratio": 0.0 for part in ("piston", "slipper")}  # free spins take more rounds
PUMP = load_pump("ref90", {"operating.pressure": "10 MPa", **STILL})


def point_at(pressure: float, near: FloatingPoint | None = None) -> FloatingPoint:
    return floating_point(PUMP, operating_point(PUMP, delivery_pressure=pressure), COARSE, near=near)


@pytest.fixture(scope="module")
def first() -> FloatingPoint:
    return point_at(10e6)


@pytest.fixture(scope="module")
def twice(first: FloatingPoint) -> tuple[FloatingPoint, FloatingPoint]:
    """A point without a start, and from its neighbour."""
    return point_at(12e6), point_at(12e6, first)


@pytest.mark.slow
def test_a_neighbour_leads_to_the_same_point(twice):
    cold, near = twice
    films = [sum(one.films_solved for one in found.rounds) for found in (cold, near)]
    assert films[1] < 0.8 * films[0]
    for name, value in point_numbers(cold).items():
        if "contact" not in name:  # milliwatts
            loose = 0.03 if "leak" in name or "least" in name else 5e-3
            assert point_numbers(near)[name] == pytest.approx(value, rel=loose, abs=2e-8), name


@pytest.mark.slow
def test_a_neighbour_leads_to_a_finer_mesh_and_more_angles(first):
    finer = floating_point(PUMP, operating_point(PUMP), replace(COARSE, steps=54, finer=0.375), near=first)
    assert finer.rounds[0].pressure_change < first.rounds[0].pressure_change


@pytest.mark.long
def test_a_neighbour_without_pressure_difference_of_its_ports_leads_on():
    idle = point_at(PUMP.operating.inlet_pressure)
    assert point_at(4e6, idle).rounds[-1].settled


@pytest.mark.long
def test_a_neighbour_with_elastic_walls_leads_to_less_pressure():
    """Elastic walls that 35 MPa has opened would meet deeply under a full film without pressure."""
    soft = FloatingOptions(Physics().without(Effect.HEAT), steps=36, finer=0.25)
    pump = load_pump("ref90", STILL)
    high = floating_point(pump, operating_point(pump), soft)
    lower = floating_point(pump, operating_point(pump, delivery_pressure=30e6), soft, near=high)
    assert lower.rounds[0].pressure_change < high.rounds[0].pressure_change


def test_a_row_starts_from_its_neighbour_and_does_without_one_that_leads_nowhere(monkeypatch):
    asked: list[object] = []

    def solved(pump, point, options, near=None):
        asked.append(near)
        if near is not None and point == 3:
            raise FilmNotConverged("no motion", "another start")
        return f"point {point}"

    monkeypatch.setattr(sources, "floating_point", solved)
    monkeypatch.setattr(sources, "solved_means", lambda found: found)
    row = FloatingSolver(COARSE).row()
    assert [row.solve(PUMP, at) for at in (1, 2, 3)] == ["point 1", "point 2", "point 3"]
    assert asked == [None, "point 1", "point 2", None]
    assert row.row().last is None


def test_levels_halve_cells_and_angles_and_quarter_the_steps_error():
    found = refined(COARSE)
    assert found.steps == 2 * COARSE.steps
    assert found.accuracy.step == COARSE.accuracy.step / 4.0
    assert refined(FloatingOptions()).piston_cells == tuple(2 * cells for cells in FloatingOptions().piston_cells)


@pytest.mark.slow
def test_refinement_tells_order_and_bar_of_each_number(first, twice):
    """Any points serve as levels: these differ by their pressure, and then by their start."""
    levels = iter(twice)
    told = refine_point(first, 3, lambda options, near, report: next(levels), lambda *_: None)
    assert len(told.dofs) == 3
    assert {"shaft_torque_Nm", "overall_efficiency", "film_least_m.slipper", "loss_W.valve_plate"} <= set(told.numbers)
    assert all(len(number.values) == 3 for number in told.numbers.values())
