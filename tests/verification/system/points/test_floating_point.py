"""Pump with floating gaps: agreement of gaps and chambers, power balance."""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import NotConverged
from system import RIGID, FloatingOptions, FloatingPoint, PumpDescription, floating_point, load_pump, operating_point
from system.points.floating import FRICTION_TOLERANCE, PRESSURE_TOLERANCE
from system.points.floating_exchange import leak_table, leakage_heat

STEPS = 72
pytestmark = pytest.mark.slow


def pump() -> PumpDescription:
    return load_pump("ref90", {"operating.pressure": "10 MPa"})


@pytest.fixture(scope="module")
def found() -> FloatingPoint:
    return floating_point(pump(), operating_point(pump()), FloatingOptions(RIGID, steps=STEPS, finer=0.35))


@pytest.mark.long
def test_gaps_and_chambers_agree(found):
    last = found.rounds[-1]
    assert last.pressure_change <= PRESSURE_TOLERANCE
    assert last.friction_change <= FRICTION_TOLERANCE
    assert last.settled
    assert len(found.kinds[0].gaps.piston.turn.instants) == STEPS
    assert len(found.kinds[0].gaps.block.turn.instants) == STEPS // found.rotor.pump.pump.pistons
    table = leak_table(found.kinds[0].gaps)
    assert table.drag_flow.shape == (3, STEPS)
    assert found.pump_point.leaks.drag_flow == pytest.approx(table.drag_flow, rel=1e-12)


@pytest.mark.long
def test_power_is_accounted_for(found, energy_balances):
    """Torque from forces, heat from the films' fields: neither knows of the other.

    What is left is forces between 72 angles a turn: five times less than the project asks for.
    """
    energy_balances(case="REF90 floating, coarse films, 10 MPa, 2100 r/min: balances", checks=found.pump_point.checks)


@pytest.mark.long
def test_oil_is_kept_by_each_gap(found):
    """Inflow equals outflow over the march, as nearly as turns close and films follow their slopes."""
    missing = found.mass_balance_error
    assert missing.piston < 0.01
    assert missing.slipper < 0.01
    assert missing.valve_plate < 0.01


@pytest.mark.long
def test_friction_is_that_of_the_films(found):
    """No coefficient of [friction] stands beside the films of the three gaps."""
    point, pistons = found.pump_point, found.rotor.pump.pump.pistons
    instants = found.kinds[0].gaps.piston.turn.instants
    rubbed = pistons * np.mean([instant.passed.heat.rubbing for instant in instants])
    sheared = pistons * np.mean([instant.passed.heat.shear for instant in instants])
    assert point.pairs.piston_cylinder.mean_coulomb == pytest.approx(rubbed, rel=1e-9)
    assert point.pairs.piston_cylinder.mean_viscous == pytest.approx(sheared, rel=1e-9)
    assert point.power.leakage == leakage_heat(found.kinds[0].gaps, pistons)


def test_rounds_that_do_not_settle_say_so(monkeypatch):
    monkeypatch.setattr("system.points.floating.ROUND_LIMIT", 1)
    with pytest.raises(NotConverged, match="after 1 rounds"):
        floating_point(pump(), operating_point(pump()), FloatingOptions(RIGID, steps=36, finer=0.25))
