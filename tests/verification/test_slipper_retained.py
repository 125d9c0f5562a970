"""A slipper pulled off its plate with more than its share of the spring: the retainer behind the spring holds it.

Open circuit, beyond the rated speed: inertia and the case's pressure pull where the suction stroke begins.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps.schedule import Accuracy
from gaps.seen import Active
from gaps.slipper_motion import retainer_force
from reynolds.errors import FilmNotConverged
from system.floating_drives import drives, no_rubbing, slipper_retainer
from system.floating_gaps import FloatingOptions, slipper_revolution
from system.floating_parts import floating_parts
from system.gap_films import RIGID
from system.instants import rotor
from system.lumped_point import lumped_point
from system.operating import operating_point
from system.pump_file import load_pump

COARSE = FloatingOptions(RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.1, floor=1e-7, closed=0.1))
FAST = {"operating.speed": "2800 rpm", "operating.pressure": "10 MPa", "operating.inlet_pressure": "0 bar"}
pytestmark = pytest.mark.slow


def turned(stated):
    """Retainer, drive and revolution of the slipper alone, over its pump's own cycle."""
    pump = load_pump("ref90_floating", stated)
    cycle = lumped_point(pump, operating_point(pump)).cycle
    at, parts = rotor(pump, operating_point(pump)), floating_parts(pump)
    drive = drives(at, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size)).slipper
    return slipper_retainer(at, parts), drive, slipper_revolution(at, parts, drive, COARSE)


def test_a_retainer_that_the_spring_presses_holds_a_slipper():
    """Where it rises most the retainer bears what pulls, and what case and cavity suck besides.

    That is no more than a film and a pocket at vacuum do; the plate is far from tipping.
    """
    retainer, drive, found = turned(FAST)
    assert retainer.limit == pytest.approx((0.4845 - 1.0 / 9.0) * 1080.0 / np.cos(np.radians(16.2)), rel=1e-3)
    rims = [at.position[0] + np.hypot(*at.position[1:]) for at in found.turn.instants]
    top = found.turn.instants[int(np.argmax(rims))]
    assert retainer.clearance < max(rims) < retainer.clearance + 2.0 * retainer.limit / retainer.stiffness
    assert Active.RETAINER in top.seen.active
    pull = float(np.asarray(drive.outer(top.angle))[0])
    held = -float(retainer_force(retainer, top.position).force[0])
    sucked = np.pi * 14e-3**2 * (drive.case_pressure - drive.cavitation_pressure)
    assert pull > 0.0
    assert held < pull + sucked
    assert held < retainer.limit


def test_a_spring_that_holds_no_retainer_is_told():
    with pytest.raises(FilmNotConverged, match=r"pulled off its plate with \d+.* N beyond the spring's share"):
        turned(FAST | {"ball_guide.spring_preload": "100 N"})
