"""Quantiles and shares of pumps with their intervals, and the two ways of solving the points of a series."""

import numpy as np
import pytest

from reynolds.errors import InputError
from system import load_pump, map_plan
from system.description.drawing import drawing_of
from system.maps.plan import MapAxis, MapInput
from system.maps.point import LumpedSolver
from system.variation.chamber_numbers import OF_FLOW, OF_PRESSURE
from system.variation.measures import MEASURES, NUMBERS, Needs, measures_of, point_numbers
from system.variation.sampling import part_of
from system.variation.scatter import Bound, Limit, scatter, share_of
from system.variation.sites import plan_sites
from system.variation.solving import VariedWork
from system.variation.together import TogetherSolver, solves_together
from system.variation.tolerance import tolerance
from system.work.processes import ProcessPool
from system.work.progress import silent

PUMP = load_pump("ref90")
LEVELS = (MapAxis(MapInput.SPEED, (100.0, 200.0)), MapAxis(MapInput.RATIO, (0.3, 1.0)),
          MapAxis(MapInput.PRESSURE, (1e7, 3e7)))  # fmt: skip


def test_intervals_of_quantiles_hold_the_true_ones():
    """In about 95 of 100 series of a known distribution."""
    random, held = np.random.default_rng(1), np.zeros(3)
    for _ in range(400):
        own = scatter(random.random(300)).quantiles
        held += [one.low <= exact <= one.high for one, exact in zip(own, (0.05, 0.5, 0.95), strict=True)]
    assert np.all(held / 400 > 0.92)


def test_scatter_of_a_normal_number():
    found = scatter(np.random.default_rng(2).normal(5.0, 2.0, 200_000))
    assert found.mean == pytest.approx(5.0, abs=0.02)
    assert found.deviation == pytest.approx(2.0, rel=0.01)
    assert found.width == pytest.approx(2.0 * 2.0 * 1.6449, rel=0.01)


def test_shares_by_clopper_and_pearson():
    """Against tabulated intervals: 0 and 5 of 100, and all of them."""
    none, five, every = (share_of(np.arange(100) < count) for count in (0, 5, 100))
    assert (none.low, none.high) == (0.0, pytest.approx(0.0362, abs=1e-4))
    assert (five.low, five.high) == (pytest.approx(0.0164, abs=1e-4), pytest.approx(0.1128, abs=1e-4))
    assert (every.low, every.high) == (pytest.approx(0.9638, abs=1e-4), 1.0)


def test_too_few_for_tails():
    with pytest.raises(InputError, match="99 pumps"):
        scatter(np.zeros(99))


def test_points_together_are_the_points_by_themselves():
    plan = map_plan(PUMP, LEVELS)
    each = np.array([point_numbers(PUMP, LumpedSolver().solve(PUMP, point)) for point in plan.points], dtype=float)
    together = np.array(TogetherSolver().solve_all(PUMP, plan.points), dtype=float)
    for at, name in enumerate(NUMBERS):
        if name in OF_FLOW or name.startswith("load_carried"):
            assert np.all(np.isnan(together[:, at]))
        else:
            loose = 2e-3 if name in OF_PRESSURE else 1e-5  # those of sampled angles
            assert together[:, at] == pytest.approx(each[:, at], rel=loose, abs=loose * np.abs(each[:, at]).max()), name


def test_pumps_that_are_not_solved_together():
    assert solves_together(PUMP)
    line = {"delivery_line.kind": "orifice", "delivery_line.volume": "1 L"}
    assert not solves_together(load_pump("ref90", line))
    assert not solves_together(load_pump("ref90", {"physics.port_short_circuit.area": "0.2 mm2"}))


def series(folder, pump, count=300, limits=()):
    """Pumps whose three films scatter."""
    work = VariedWork(pump, TogetherSolver(), plan_sites(map_plan(pump, LEVELS[2:])))
    measures = measures_of(Needs.PRESSURE)
    films = ("piston.radial_clearance", "slipper.film_thickness", "valve_plate.film_thickness")
    drawing = part_of(drawing_of(pump), films)
    return tolerance(work, drawing, count, 1, measures, limits, folder, ProcessPool(1), silent)


def test_clearance_that_crosses_zero_is_counted(tmp_path):
    """A shaft that may be wider than its hole: those pumps are refused, none is cut to a limit."""
    fit = {"key": "piston.radial_clearance", "shape": "uniform", "hole_least": "22.01 mm", "hole_most": "22.05 mm",
           "shaft_least": "22.00 mm", "shaft_most": "22.02 mm"}  # fmt: skip
    pump = load_pump("ref90", {"tolerance.fit": [fit]})
    found = series(tmp_path, pump)
    refused = sum(found.refused.values())
    # P(hole < shaft), uniform over 40 and 20 um, 10 um in common: (10^2 / 2) / (40 * 20)
    assert refused == pytest.approx(300 * 0.0625, abs=4.0 * np.sqrt(300 * 0.0625))
    assert refused + len(found.numbers) == 300
    assert list(found.refused) == ["piston.radial_clearance"] or "radial_clearance" in next(iter(found.refused))
    column = found.series.values[:, found.series.drawing.names.index("piston.radial_clearance")]
    assert column.min() > 0.0


def test_limits(tmp_path):
    """Of the mean over points, and at one of them or more; the second share is never below the first."""
    measure = MEASURES["drain_flow"]
    limits = [Limit(measure, Bound.MOST, value, "drain") for value in (1e-9, 5.5e-6, 1.0)]
    found = series(tmp_path, PUMP, limits=limits).limits
    assert [one.missing.value for one in found][::2] == [1.0, 0.0]
    assert 0.0 < found[1].missing.value < found[1].anywhere.value < 1.0


def test_too_few_pumps_with_a_result(tmp_path):
    """A shaft that is nearly always wider than its hole."""
    fit = {"key": "piston.radial_clearance", "shape": "uniform", "hole_least": "22.00 mm", "hole_most": "22.02 mm",
           "shaft_least": "22.01 mm", "shaft_most": "22.03 mm"}  # fmt: skip
    with pytest.raises(InputError, match=r"of 200 pumps with a result; the first without: .*radial_clearance"):
        series(tmp_path, load_pump("ref90", {"tolerance.fit": [fit]}), 200)


def test_the_same_seed_draws_the_same_pumps(tmp_path):
    one, other = (series(tmp_path / name, PUMP, 150) for name in ("one", "other"))
    assert np.array_equal(one.numbers, other.numbers, equal_nan=True)
    assert one.shares == other.shares
