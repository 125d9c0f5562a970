"""Free spins of floating gaps: films and ball joint agree on them, or power would come from nowhere.

A piston that touches its bore is held there by more than the shear of its oil. Coarse films, pressure and friction
of the chambers let be.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps import Accuracy
from system import (
    RIGID,
    FloatingOptions,
    FloatingPoint,
    bore_axis,
    floating_point,
    load_pump,
    operating_point,
    resolved_toml,
)
from system.points.floating import SPIN_TOLERANCE
from system.points.floating_exchange import spin_torques

ROUGHLY = FloatingOptions(
    RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.05, floor=1e-8, closed=0.1, reach=1.0), keep=6
)
pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def found(tmp_path_factory) -> FloatingPoint:
    """ref90 at 5 MPa without its spin ratios, once its spins have settled."""
    rows = resolved_toml(load_pump("ref90", {"operating.pressure": "5 MPa"})).splitlines()
    path = tmp_path_factory.mktemp("free") / "pump.toml"
    path.write_text("\n".join(row for row in rows if not row.startswith("spin_ratio")), "utf-8")
    pump = load_pump(path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("system.points.floating.PRESSURE_TOLERANCE", 1.0)
        patch.setattr("system.points.floating.FRICTION_TOLERANCE", 1.0)
        return floating_point(pump, operating_point(pump), ROUGHLY)


def test_films_and_joint_hold_the_spins(found):
    """The torque of the films at these spins equals that of the joint: the spins are a solution."""
    kind = found.kinds[0]
    speed, spins = kind.rotor.point.shaft_speed, kind.rotor.spins
    assert found.rounds[-1].spin_change <= SPIN_TOLERANCE
    assert abs(spins.piston) > 0.01 * speed
    torque = np.mean([instant.passed.friction.torque for instant in kind.gaps.piston.turn.instants])
    held = spin_torques(kind.gaps, kind.rotor, kind.drives.group)
    assert torque * spins.piston < 0.0
    assert abs(torque) < held.friction.mean()
    moment = kind.drives.group.ball_moment
    axes = bore_axis(kind.rotor.drive, 2.0 * np.pi * np.arange(len(moment)) / len(moment))
    given = -np.mean(np.sum(moment * axes, axis=1))
    assert given == pytest.approx(-torque, rel=0.1)  # a joint that nearly sticks: steep in its spin
    assert held.drags[0] > kind.rotor.estimated_torques.drags[0]  # contact holds it besides the shear of its oil


def test_power_is_accounted_for(found):
    """Spins of centred pistons' drag would leave a tenth of the shaft power without a source."""
    assert found.pump_point.checks.energy_balance_error < 1e-3


def test_pistons_that_circle_in_their_bores_settle():
    """At 28 % stroke in hot oil turns circle the periodic motion widely: Newton's step leads to it from within."""
    pump = load_pump("ref90")
    hot = operating_point(pump, displacement_ratio=0.28, temperature=343.15)
    settled = floating_point(pump, hot, FloatingOptions())
    assert settled.rounds[-1].settled
    assert settled.pump_point.checks.energy_balance_error < 5e-4
