"""A slipper pulled off its plate with more than its share of the spring: the retainer behind the spring holds it.

Open circuit, beyond the rated speed: inertia and the case's pressure pull where the suction stroke begins.
"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from gaps import Accuracy, Active
from gaps.films.slipper import retainer_force
from reynolds import FilmNotConverged
from swashfilm.runs.film.revolution.validity import pulled_together
from system import (
    RIGID,
    FloatingOptions,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    rotor,
    slipper_revolution,
)
from system.films.drives import slipper_retainer

COARSE = FloatingOptions(RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.1, floor=1e-7, closed=0.1))
FAST = {"operating.speed": "2800 rpm", "operating.pressure": "10 MPa", "operating.inlet_pressure": "0 bar"}


def turned(stated):
    """Retainer, drive and revolution of the slipper alone, over its pump's own cycle."""
    pump = load_pump("ref90", stated)
    cycle = lumped_point(pump, operating_point(pump)).cycle
    at, parts = rotor(pump, operating_point(pump)), floating_parts(pump)
    drive = drives(at, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size)).slipper
    return slipper_retainer(at, parts), drive, slipper_revolution(at, parts, drive, COARSE)


@pytest.mark.slow
def test_a_retainer_that_the_spring_presses_holds_a_slipper():
    """Where it rises most the retainer bears what pulls, and what case and cavity suck besides.

    That is no more than a film and a pocket at vacuum do; the plate is far from tipping.
    """
    retainer, drive, found = turned(FAST)
    assert retainer.limit == pytest.approx((0.4845 - 1.0 / 9.0) * 1080.0 / np.cos(np.radians(16.2)), rel=1e-3)
    rims = [at.position[0] + np.hypot(*at.position[1:]) for at in found.turn.instants]
    top = found.turn.instants[int(np.argmax(rims))]
    assert retainer.clearance < max(rims) < retainer.clearance + 2.0 * retainer.limit / retainer.stiffness
    assert Active.RETAINER in top.report.active
    pull = float(np.asarray(drive.outer(top.angle))[0])
    held = -float(retainer_force(retainer, top.position).force[0])
    sucked = np.pi * 14e-3**2 * (drive.case_pressure - drive.cavitation_pressure)
    assert pull > 0.0
    assert held < pull + sucked
    assert held < retainer.limit


@pytest.mark.slow
def test_a_spring_that_holds_no_retainer_is_told():
    with pytest.raises(FilmNotConverged, match=r"pulled off its plate with \d+.* N beyond the spring's share"):
        turned(FAST | {"ball_guide.spring_preload": "100 N"})


def test_slippers_that_pull_together_are_told():
    """150 N each over a third of the turn: of nine slippers four at a time, more than tips the plate."""
    pump = load_pump("ref90", FAST)
    at, parts = rotor(pump, operating_point(pump)), floating_parts(pump)
    clearance = parts.slipper.retainer.clearance

    def told(share: float) -> list[tuple[str, str]]:
        angles = 2.0 * np.pi * np.arange(1, 181) / 180
        rises = np.where(angles < 2.0 * np.pi * share, clearance + 1.5e-6, 0.5 * clearance)
        instants = [SimpleNamespace(position=np.array([rise, 0.0, 0.0])) for rise in rises]
        found = SimpleNamespace(angles=angles, turn=SimpleNamespace(instants=instants))
        return list(pulled_together(SimpleNamespace(rotor=at), parts, found))

    assert told(0.2) == []
    ((name, text),) = told(0.35)
    assert name == "retainer_gives_way"
    assert "600 N" in text
