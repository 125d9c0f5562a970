"""Report of a gap that finds no film: forces there, and a dimension that mends it."""

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps.films.slipper import Retainer
from gaps.loads.block_tipping import BlockBalance
from system import drives, floating_parts, load_pump, lumped_point, no_rubbing, operating_point, rotor
from system.films.rotor import valve_plate_geometry
from system.points.floating_balance import block_shortfall, piston_shortfall, slipper_shortfall
from system.pump.lumped import piston_area

ANGLE = np.radians(200.0)


@pytest.fixture(scope="module")
def bench():
    """The recordings' pump at 35 MPa: its rotor and the drives of its gaps."""
    pump = load_pump(BENCH)
    point = lumped_point(pump, operating_point(pump, delivery_pressure=35e6))
    group, angles = rotor(pump, point.point), point.cycle.shaft_angle
    return group, drives(group, floating_parts(pump), angles, point.cycle.pressure, no_rubbing(angles.size))


def _with(group, section, **values):
    return replace(group, pump=replace(group.pump, **{section: replace(getattr(group.pump, section), **values)}))


def test_a_slipper_is_told_the_radius_at_which_its_lands_lift_all(bench):
    group, drive = bench[0], bench[1].slipper
    told = slipper_shortfall(group, drive, ANGLE)
    assert told.what.startswith(
        "at 200 deg 14510 N press on, its lands lift 13190 N (90.9 %), and the film has to raise"
    )
    assert told.remedy.startswith("slipper.land_outer_radius near 15.17 mm instead of 14 mm")
    wider = slipper_shortfall(_with(group, "slipper", land_outer_radius=15.17e-3), drive, ANGLE)
    assert "(100 %)" in wider.what


def test_a_slipper_that_is_pulled_off_is_told_what_holds_it(bench):
    """No force presses on that its lands could share: the retainer takes the pull, or nothing does."""
    group, drive = bench[0], bench[1].slipper
    for pull in (0.0, 300.0):
        held = replace(drive, outer=lambda angle, pull=pull: np.array([pull, 1.0, 0.0]), retainer=Retainer(1e-5, 1e8))
        told = slipper_shortfall(group, held, ANGLE)
        assert f"at 200 deg nothing presses the slipper on: {pull:g} N pull it off its plate" in told.what
        assert "retainer.clearance" in told.remedy
    loose = slipper_shortfall(group, replace(held, retainer=None), ANGLE)
    assert loose.what == "at 0 deg the slipper is pulled off its plate with 300 N, and no retainer holds it"
    pressed = replace(held, outer=drive.outer, retainer=None)
    assert "press on, its lands lift" in slipper_shortfall(group, pressed, ANGLE).what


def test_a_block_that_tips_is_told_the_force_that_holds_it(bench):
    """With so much more spring the rest presses at the rim of its face: the balance of moments itself says so."""
    group, drive = bench[0], bench[1].block
    told = block_shortfall(group, drive, ANGLE)
    assert "61.24 mm from the shaft, outside its face of 45.7 mm: it tips" in told.what
    more = float(told.remedy.split("larger by ")[1].split(" N")[0])
    pump, plate = group.pump, group.pump.valve_plate
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, plate.land_radius_4)
    balance = BlockBalance(radii, pump.pump.pistons, piston_area(pump), pump.pump.pitch_radius, plate.sphere)
    places = valve_plate_geometry(pump).kidney_places(ANGLE)
    above = np.array([float(drive.chamber_pressure(at)) for at in places]) - drive.case_pressure
    force, about_x, about_y = np.asarray(drive.press(ANGLE)) + balance.lift(places, above)
    assert balance.pressed_by(more - force, np.hypot(about_x, about_y)) == pytest.approx(45.7e-3, rel=1e-3)


def test_a_block_within_its_face_and_one_that_lifts_off(bench):
    group, drive = bench[0], bench[1].block
    pressed = replace(drive, press=lambda angle: np.asarray(bench[1].block.press(angle)) - np.array([1e5, 0.0, 0.0]))
    assert "tips" not in block_shortfall(group, pressed, ANGLE).what
    lifted = replace(drive, press=lambda angle: np.array([-1e3, 0.0, 0.0]))
    told = block_shortfall(group, lifted, ANGLE)
    assert told.what.endswith("it lifts off")
    assert "narrower lands" in told.remedy
    pulled = replace(drive, press=lambda angle: np.array([50.0, 0.0, 0.0]))
    assert "at 200 deg 50 N pull it off its plate, its lands lift" in block_shortfall(group, pulled, ANGLE).what


def test_a_piston_is_told_the_forces_at_both_ends_of_its_guide(bench):
    group, drive = bench[0], bench[1].piston
    forced = replace(drive, outer=lambda angle: np.array([3e3, 4e3, 0.0, 2e3]))
    told = piston_shortfall(group, forced, ANGLE)
    assert "5000 N at the inner end of its guide and 2000 N at the case edge" in told.what
    guide, diameter = (
        group.pump.piston.guide_length or group.pump.piston.engaged_length,
        group.pump.pump.piston_diameter,
    )
    mean = np.hypot(3e3, 6e3) / (guide * diameter)
    assert f"in the mean {mean / 1e6:.3g} MPa" in told.what
