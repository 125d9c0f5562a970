"""Pumps whose chambers differ: the mean of pumps that are alike, and once a turn in what pulses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from system import PumpDescription, load_pump, lumped_point, operating_point
from system.pump.chamber_kinds import kinds
from system.pump.laws.friction_pairs import over_chambers

CLEARANCE = load_pump(BENCH).piston.radial_clearance
PISTONS = 9
THROTTLED = {"delivery_line.kind": "orifice", "delivery_line.volume": "0.5 L"}


def with_clearances(clearances: dict[int, float], stated: dict[str, str] | None = None) -> PumpDescription:
    """REF90 with radial clearances (m) of single pistons."""
    pump = load_pump(BENCH, stated or {})
    singles = {k: replace(pump.piston, radial_clearance=c) for k, c in clearances.items()}
    return replace(pump, single_pistons=tuple(singles.items()))


def point(pump: PumpDescription):
    return lumped_point(pump, operating_point(pump))


def test_parts_that_say_the_same_are_of_one_kind():
    assert kinds(load_pump(BENCH)).of_chamber == (0,)
    assert kinds(with_clearances(dict.fromkeys(range(1, 10), CLEARANCE))).alike
    assert kinds(with_clearances(dict.fromkeys(range(1, 10), 2.0 * CLEARANCE))).alike
    found = kinds(with_clearances({3: 2.0 * CLEARANCE, 7: 2.0 * CLEARANCE}))
    assert found.of_chamber == (0, 0, 1, 0, 0, 0, 1, 0, 0)
    assert found.chambers(1) == (2, 6)
    assert found.by_chamber("ab") == tuple("aabaaabaa")


def test_chambers_add_each_at_its_own_angle():
    rows = np.random.default_rng(5).normal(size=(3, 12))
    expected = [sum(rows[k, (j + 4 * k) % 12] for k in range(3)) for j in range(12)]
    assert over_chambers(list(rows), 3) == pytest.approx(np.array(expected), rel=1e-13)
    assert over_chambers([rows[0]] * 3, 3) == pytest.approx(over_chambers([rows[0]], 3), rel=1e-13)


@pytest.mark.parametrize("stated", [{}, THROTTLED], ids=["held ports", "throttled delivery"])
def test_chambers_written_out_one_by_one_are_the_pump_that_is_alike(stated):
    """Clearances that differ by rounding alone: nothing changes but the way it is found."""
    alike = point(load_pump(BENCH, stated))
    one_by_one = point(with_clearances({3: CLEARANCE * (1.0 + 1e-12)}, stated))
    assert len(one_by_one.chambers) == PISTONS
    for tell, close in (
        (lambda p: p.bench.delivery_flow, 1e-8),
        (lambda p: p.bench.shaft_torque, 1e-8),
        (lambda p: p.leakage_flow.piston, 1e-7),
        (lambda p: p.power.friction, 1e-8),
    ):
        assert tell(one_by_one) == pytest.approx(tell(alike), rel=close)
    assert one_by_one.shaft_torque == pytest.approx(alike.shaft_torque, rel=1e-5)
    assert one_by_one.delivery.pressure == pytest.approx(alike.delivery.pressure, rel=1e-5)


def test_a_worn_piston_leaks_by_the_cube_and_pulses_once_a_turn():
    """(1 + 1.5 eps^2) c^3: 8 times, less a tenth for the pressure that it loses; the others' stays."""
    alike, worn = point(load_pump(BENCH, THROTTLED)), point(with_clearances({3: 2.0 * CLEARANCE}, THROTTLED))
    leaked = np.array([float(one.outflow.piston) for one in worn.chambers]) / float(alike.cycle.outflow.piston)
    assert leaked[2] == pytest.approx(8.0, rel=0.02)
    assert np.delete(leaked, 2) == pytest.approx(np.ones(PISTONS - 1), rel=2e-3)
    assert worn.leakage_flow.piston == pytest.approx(leaked.mean() * alike.leakage_flow.piston, rel=1e-6)
    orders = np.abs(np.fft.rfft([alike.delivery.line_flow, worn.delivery.line_flow]))
    assert orders[0, 1] < 1e-9 * orders[0, 0] < orders[1, 1]
    assert worn.checks.energy_balance_error < 1e-4
    assert worn.checks.mass_balance_error < 1e-9
