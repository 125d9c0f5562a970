"""Checks of a pump whose gaps are to float: each one fails where it should and nowhere else."""

from __future__ import annotations

from pathlib import Path

import pytest
from bench_pump import BENCH

from system import load_pump
from system.pump_file.floating import check_floating


def told(name: str | Path, overrides: dict[str, object] | None = None) -> str:
    return "\n".join(str(warning) for warning in check_floating(load_pump(name, overrides)).warnings)


def test_lands_within_the_pitch_circle_tip():
    """The film lifts 0.933 of the pistons' force, at 36.5 mm; what is left presses beyond the outer land."""
    found = told(BENCH)
    assert "valve_plate.land_radius_4: block tips: at 35 MPa the film's lift is 0.933 of the pistons' force" in found
    assert "36.52 mm from the shaft" in found
    assert "lands about the pitch radius, 45 mm" in found


def test_a_strong_spring_keeps_it_down():
    """Left_out_physics B7: the threshold goes with pressure against the spring."""
    assert "block tips" not in told(BENCH, {"ball_guide.spring_preload": "8 kN"})
    assert "block tips" not in told(BENCH, {"pump.rated_pressure": "4 MPa", "operating.pressure": "4 MPa"})


def test_ref90_has_what_it_needs():
    assert told("ref90") == ""


def test_an_overbalanced_block_lifts_off():
    found = told(BENCH, {"valve_plate.land_radius_4": "50 mm"})
    assert "block lifts off" in found


@pytest.mark.parametrize("shape", ["crown", "rim_relief"])
def test_a_flat_slipper_has_no_wedge(shape):
    assert "slipper.profile: a flat face" in told(BENCH)
    stated: object = "2 um" if shape == "crown" else {"width": "3 mm", "depth": "2 um"}
    assert "flat face" not in told(BENCH, {f"slipper.{shape}": stated})


def test_a_rim_relief_of_no_depth_is_a_flat_face():
    assert "slipper.profile: a flat face" in told("ref90", {"slipper.rim_relief.depth": "0 um"})
