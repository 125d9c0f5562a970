"""Load, torque and friction of a pump's gap: of a piston those of its cylinder, of the others with pocket and ports."""

import numpy as np
import pytest
from bench_pump import BENCH

import swashfilm as sf
from swashfilm.case.file import load_case

PISTON = f"""
format = 1
[film]
gap = "piston"
pump = "{BENCH}"
shaft_angle = "270 deg"
chamber_pressure = "200 bar"
[position]
eccentricity_ratio = 0.6
"""
FACE = PISTON.partition("[position]")[0].replace('chamber_pressure = "200 bar"\n', "") + "[position]\n"
SLIPPER = FACE.replace("piston", "slipper") + 'film_thickness = "12 um"\nslope_x = "0.02 deg"\n'
PLATE = FACE.replace("piston", "valve_plate") + 'film_thickness = "8 um"\n'


@pytest.fixture(scope="module")
def piston():
    return sf.film(PISTON)


def test_the_load_of_a_piston_is_the_vector_around_it(piston):
    """The integral over the unrolled sheet is no force: it counts what presses from both sides."""
    found = piston.summary
    assert not {"load_N", "moment_x_Nm", "moment_y_Nm"} & set(found)
    along = found["bearing_load_N"] * np.cos(np.radians(found["attitude_angle_deg"]))
    assert along == pytest.approx(abs(found["carried_load_N"]), rel=0.02)  # eccentric towards its load


def test_the_torque_on_a_piston_is_about_its_axis(piston):
    found = piston.summary
    radius = found["cylinder_radius_m"]
    assert found["friction_torque_moving_Nm"] == pytest.approx(radius * found["friction_force_moving_N"][0], rel=1e-12)


def test_sensitivities_of_a_piston_are_those_of_its_vector(piston):
    with pytest.raises(sf.InputFaults, match="'load'"):
        sf.film(PISTON, sensitivity="load")
    (found,) = sf.film(PISTON, sensitivity="bearing_load").summary["sensitivity"]["outputs"].values()
    assert found["value"] == pytest.approx(piston.summary["bearing_load_N"], rel=1e-9)


@pytest.mark.parametrize("text", [PISTON, SLIPPER, PLATE])
def test_friction_of_a_gap_counts_by_the_load_that_it_carries(tmp_path, text):
    """Friction coefficient times Hersey's length: both by the supported load, with pocket, kidneys and contact."""
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    case, found = load_case(path), sf.film(text).summary
    viscosity, load = case.rotor.point.viscosity, found["carried_load_N"]
    speed = found["friction_power_W"] / (found["friction_coefficient"] * load)
    turning = case.rotor.point.shaft_speed
    assert 0.01 * turning < speed < 0.06 * turning  # m, from the stroke of a piston to the radius of the plate
    area = found["hersey_number_m"] * load / (viscosity * speed)
    assert 1e-4 < area < 1e-2  # a film, not 1e6 times its viscosity under the webs
