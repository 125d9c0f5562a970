"""Floating gaps of chambers that differ: written out one by one as alike, a worn piston, the block over the turn.

Coarse films, two rounds of gaps and chambers.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gaps import Accuracy
from system import RIGID, FloatingOptions, FloatingPoint, PumpDescription, floating_point, load_pump, operating_point
from system.points.floating import PRESSURE_TOLERANCE

ROUGHLY = FloatingOptions(
    RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.1, floor=1e-7, closed=0.5, reach=1.0), keep=6
)
PUMP = load_pump("ref90", {"operating.pressure": "5 MPa"})
CLEARANCE = PUMP.piston.radial_clearance
WORN, WEAR = 2, 2.0  # chamber 3
pytestmark = pytest.mark.long


def with_clearance(clearance: float) -> PumpDescription:
    """The pump with another radial clearance (m) of the third piston."""
    third = replace(PUMP.piston, radial_clearance=clearance)
    return replace(PUMP, single_pistons=((WORN + 1, third),))


@pytest.fixture(scope="module")
def found():
    """The point of a pump after two rounds, the second closer."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("system.points.floating.PRESSURE_TOLERANCE", 1.0)
        patch.setattr("system.points.floating.FRICTION_TOLERANCE", 1.0)
        patch.setattr("system.points.floating.SPIN_TOLERANCE", 10.0)
        pumps = PUMP, with_clearance(CLEARANCE * (1.0 + 1e-12)), with_clearance(WEAR * CLEARANCE)
        return [floating_point(pump, operating_point(pump), ROUGHLY) for pump in pumps]


def leaked(point: FloatingPoint) -> np.ndarray:
    """Leakage of each chamber's piston in a turn (m3)."""
    return np.array([float(one.outflow.piston) for one in point.pump_point.chambers])


def torque_of_pistons(point: FloatingPoint) -> float:
    """Mean torque (N m) of the shaft but for the block's film."""
    found = point.pump_point
    return float(np.mean(found.shaft_torque)) - found.pairs.valve_plate_cylinder.mean / found.point.shaft_speed


def test_chambers_written_out_are_the_pump_that_is_alike(found):
    """Pistons and slippers of the first round are the same; the block has not closed, by a turn here and a pitch there.

    In the second round it acts on them by the chambers' pressure.
    """
    alike, written, _ = found
    assert [kind.chambers for kind in written.kinds] == [(0, 1, 3, 4, 5, 6, 7, 8), (WORN,)]
    assert len(written.kinds[0].gaps.block.turn.instants) == ROUGHLY.steps
    assert leaked(written) == pytest.approx(np.full(9, leaked(alike)[0]), rel=1e-3)
    one, other = alike.pump_point, written.pump_point
    assert other.bench.delivery_flow == pytest.approx(one.bench.delivery_flow, rel=1e-4)
    (first, _), (same, _) = alike.rounds, written.rounds
    assert same.friction_change == pytest.approx(first.friction_change, rel=1e-9)
    assert same.spin_change == pytest.approx(first.spin_change, rel=1e-9)
    assert other.pairs.piston_cylinder.mean == pytest.approx(one.pairs.piston_cylinder.mean, rel=1e-4)
    assert other.pairs.slipper_swash_plate.mean == pytest.approx(one.pairs.slipper_swash_plate.mean, rel=1e-4)


def test_a_worn_piston_leaks_by_the_cube_and_the_rest_stays(found):
    alike, _, worn = found
    more = leaked(worn) / leaked(alike)[0]
    assert more[WORN] == pytest.approx(WEAR**3, rel=0.25)
    assert np.delete(more, WORN) == pytest.approx(np.ones(8), rel=1e-2)
    assert worn.pump_point.leakage_flow.piston > alike.pump_point.leakage_flow.piston
    orders = np.abs(np.fft.rfft(worn.pump_point.delivery_flow_ripple))
    assert orders[1] > 1e-6 * orders[0]


def test_power_is_accounted_for(found):
    """A coarse round: what remains is that pressures are those of the round before."""
    alike, written, worn = (one.pump_point.checks for one in found)
    assert written.energy_balance_error == pytest.approx(alike.energy_balance_error, abs=1e-3)
    assert worn.energy_balance_error == pytest.approx(alike.energy_balance_error, abs=2e-3)
    assert worn.mass_balance_error < 1e-9


def test_a_worn_pump_comes_to_its_end(tmp_path):
    """Gaps and chambers agree at rated pressure, the worn piston's wear as a trace, askew, beside more clearance.

    Only its own film leaks more. Its chambers cavitate about 180 deg, where their slippers leave the plate: what
    holds them there decides whether the chambers' pressure settles.
    """
    places = np.arange(0.0, 70.01, 0.1)  # mm
    heights = 40.0 - 0.2 * places - 6.0 * np.maximum(1.0 - places / 12.0, 0.0) ** 2  # um
    rows = "\n".join(f"{place},{height}" for place, height in zip(places, heights, strict=True))
    (tmp_path / "worn.csv").write_text(f"place [mm],height [um]\n{rows}\n", "utf-8")
    trace = {"trace": str(tmp_path / "worn.csv"), "level": "line", "unworn": [["20 mm", "70 mm"]], "cutoff": "6 mm"}
    worn = load_pump("ref90", {"piston.3": {"radial_clearance": "18 um", "profile": trace}})
    found = floating_point(worn, operating_point(worn), FloatingOptions(RIGID, steps=36, finer=0.25))
    assert [len(kind.chambers) for kind in found.kinds] == [8, 1]
    assert found.rounds[-1].pressure_change <= PRESSURE_TOLERANCE
    assert found.pump_point.checks.energy_balance_error < 1e-3
    flows = leaked(found)
    assert np.delete(flows, WORN) == pytest.approx(np.full(8, flows[0]), rel=1e-3)
    assert 1.5 * flows[0] < flows[WORN] < 4.0 * flows[0]
    for kind in found.kinds:
        rise = max(at.position[0] + np.hypot(*at.position[1:]) for at in kind.gaps.slipper.turn.instants)
        assert rise < 2.0 * kind.parts.slipper.retainer.clearance
