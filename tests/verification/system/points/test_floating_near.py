"""A floating point from its neighbour's motion: the same point, in fewer films; and the same on finer levels."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest

from gaps.films.physics import Effect, Physics
from reynolds import FilmNotConverged
from swashfilm.case.gap.revolution import refined_options
from swashfilm.runs.pump.refine import point_numbers, refine_point
from system import RIGID, FloatingOptions, floating_point, load_pump, operating_point
from system.points.floating import FloatingPoint
from system.points.table import sources
from system.points.table.sources import FloatingSolver
from system.pump.assembly import PointWarning, Remark
from system.pump.operating import OperatingPoint

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


@pytest.mark.long
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


@dataclass(frozen=True)
class Means:
    """What a row changes of a solved point."""

    point: OperatingPoint
    warnings: tuple[Remark, ...] = ()


@dataclass(frozen=True)
class Solved:
    """A stand-in for a floating point."""

    pump_point: Means


def test_a_row_starts_from_its_neighbour_and_says_where_one_leads_nowhere(monkeypatch):
    asked: list[object] = []
    points = [operating_point(PUMP, delivery_pressure=pressure) for pressure in (10e6, 12e6, 35e6)]

    def solved(pump, point, options, near=None):
        asked.append(near and near.pump_point.point)
        if near is not None and point is points[2]:
            raise FilmNotConverged("no motion", "another start")
        return Solved(Means(point))

    monkeypatch.setattr(sources, "floating_point", solved)
    row = FloatingSolver(COARSE).row()
    found = [row.floating(PUMP, at).pump_point for at in points]
    assert [one.point for one in found] == points
    assert asked == [None, points[0], points[1], None]
    assert [len(one.warnings) for one in found] == [0, 0, 1]
    (told,) = found[2].warnings
    assert told.warning is PointWarning.START_REFUSED
    assert "12 MPa, 2100 r/min and 100% stroke, led to no motion here (no motion. Try: another start)" in told.text
    assert row.row().last is None


def test_a_point_that_is_the_first_of_its_row_fails_by_itself(monkeypatch):
    def unsolved(*_, near=None):
        raise FilmNotConverged("no motion", "another start")

    monkeypatch.setattr(sources, "floating_point", unsolved)
    with pytest.raises(FilmNotConverged, match="no motion"):
        FloatingSolver(COARSE).row().floating(PUMP, operating_point(PUMP))


def test_levels_halve_cells_and_angles_and_quarter_the_steps_error():
    found = refined_options(COARSE)
    assert found.steps == 2 * COARSE.steps
    assert found.accuracy.step == COARSE.accuracy.step / 4.0
    assert refined_options(FloatingOptions()).piston_cells == tuple(
        2 * cells for cells in FloatingOptions().piston_cells
    )


@pytest.mark.slow
def test_refinement_tells_order_and_bar_of_each_number(first, twice):
    """Any points serve as levels: these differ by their pressure, and then by their start."""
    levels = iter(twice)
    told = refine_point(first, 3, lambda options, near, report: next(levels), lambda *_: None)
    assert len(told.dofs) == 3
    assert {"shaft_torque_Nm", "overall_efficiency", "film_least_m.slipper", "loss_W.valve_plate"} <= set(told.numbers)
    assert all(len(number.values) == 3 for number in told.numbers.values())
