"""Numbers that follow from the chamber's pressure: against forces of the rotating group and closed forms."""

from types import SimpleNamespace

import numpy as np
import pytest

from swashfilm.runs.pump.summary import pump_summary
from system.inputs.units import TURN
from system.multibody.rotating_group import joint_forces
from system.points.lumped import lumped_point
from system.points.table import sources
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.laws.kinematics import SwashDrive, drive_at_ratio
from system.pump.lumped import full_drive, piston_area
from system.pump.operating import operating_point
from system.pump_file.file import load_pump
from system.variation.chamber_numbers import flow_numbers, pressure_moment, pressure_numbers, slipper_balance

ANGLES = np.linspace(0.0, TURN, 360, endpoint=False)


@pytest.mark.parametrize(("cross", "displacement"), [("0 deg", "89.86 cm3/rev"), ("3 deg", "91.31 cm3/rev")])
def test_moment_is_that_of_the_forces(cross, displacement):
    """At a crawl without friction the moment that holds the plate is that of the pressures, with a cross angle too."""
    coefficients = ("piston_cylinder", "piston_slipper_socket", "slipper_swash_plate", "ball_guide_retainer")
    smooth = {f"friction.{name}": 0.0 for name in coefficients}
    pump = load_pump("ref90", smooth | {"pump.cross_angle": cross, "pump.displacement": displacement})
    point = operating_point(pump, shaft_speed=2.0, delivery_pressure=35e6)
    found = lumped_point(pump, point)
    held = joint_forces(pump, found).plate.control
    drive = drive_at_ratio(full_drive(pump), point.displacement_ratio)
    force = piston_area(pump) * (found.cycle.pressure - point.case_pressure)
    own = pressure_moment(drive, found.cycle.shaft_angle, force, pump.pump.pistons)
    assert -own == pytest.approx(held, abs=0.01 * np.ptp(held))


def test_moment_of_one_force():
    """A cylindrical block at the inner dead centre: M = -F R/cos^2(gamma), towards a smaller angle."""
    force = np.where(np.arange(360) == 0, 1e3, 0.0)
    moment = pressure_moment(SwashDrive(0.05, 0.0, np.radians(20.0)), ANGLES, force, 9)
    assert moment[0] == pytest.approx(-1e3 * 0.05 / np.cos(np.radians(20.0)) ** 2)


def test_rate_and_cavity_of_a_known_course():
    """A sine's rate is omega a/sqrt(2); a tenth of the turn at the cavity's pressure is a share of 0.1."""
    pump = load_pump("ref90")
    point = operating_point(pump, shaft_speed=100.0)
    sine = pressure_numbers(pump, point, 10e6 + 5e6 * np.sin(ANGLES))
    assert sine["pressure_rate"] == pytest.approx(100.0 * 5e6 / np.sqrt(2.0), rel=1e-4)
    assert (sine["cavitated_share"], sine["chamber_pressure_peak"]) == pytest.approx((0.0, 15e6))
    empty = np.where(np.arange(360) < 36, CAVITY_PRESSURE, 1e6)
    assert pressure_numbers(pump, point, empty)["cavitated_share"] == pytest.approx(0.1)


def test_balance_of_a_slipper():
    """A wide bore leaves the whole pressure in the pocket; a bore as resistant as the lands half of it."""
    pump = load_pump("ref90")
    drive, own = full_drive(pump), pump.slipper
    wide = load_pump("ref90", {"slipper.orifice_diameter": "8 mm"})
    whole = own.lands.effective_area * np.cos(drive.swash_angle) / piston_area(pump)
    assert slipper_balance(wide, drive) == pytest.approx(whole, rel=1e-6)
    equal = (128.0 * own.film_thickness**3 * own.orifice_length / (6.0 * own.lands.log_ratio)) ** 0.25
    half = load_pump("ref90", {"slipper.orifice_diameter": f"{equal * 1e3} mm"})
    assert slipper_balance(half, drive) == pytest.approx(0.5 * whole, rel=1e-6)


def test_flow_back():
    """Net flow through a port is the flow in its sense less that against it."""
    pump = load_pump("ref90")
    found = lumped_point(pump, operating_point(pump))
    flow, back = found.cycle.flow, flow_numbers(found)
    forth = found.pistons * np.mean(np.maximum(flow.delivery, 0.0))
    assert forth - back["reverse_flow.delivery"] == pytest.approx(found.pistons * np.mean(flow.delivery))
    into = found.pistons * np.mean(np.maximum(-flow.suction, 0.0))
    assert into - back["reverse_flow.inlet"] == pytest.approx(-found.pistons * np.mean(flow.suction))
    assert back["reverse_flow.delivery"] > 0.0


def test_ripples_are_those_that_a_run_tells():
    """Of the flow between port and line, at the pressure of the port."""
    pump = load_pump("ref90")
    found = lumped_point(pump, operating_point(pump))
    told, own = pump_summary(pump, found, None, [])["ripple"], flow_numbers(found)
    for port in ("delivery", "inlet"):
        assert own[f"{port}_flow_ripple"] == told[f"{port}_flow_peak_to_peak_m3_per_s"]


def test_load_that_is_left_to_others():
    """Of loads of 10 and 1000 N carried to 5 and 900 N, 100 of 1000 N are left; contact of 20 beside 100 N likewise."""
    films = [SimpleNamespace(required_load=need, carried_load=has) for need, has in ((10.0, 5.0), (1000.0, 900.0))]
    assert sources._carried(films) == pytest.approx(0.9)
    instants = [
        SimpleNamespace(contact_force=np.array([rubs, 0.0]), outer_force=np.array([-pressed, 0.0]))
        for rubs, pressed in ((0.0, 100.0), (20.0, 80.0))
    ]
    assert sources._by_film(instants) == pytest.approx(0.8)
