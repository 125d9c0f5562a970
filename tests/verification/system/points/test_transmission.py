"""Hydrostatic transmission: a pump and a motor in a closed circuit, against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from system import load_pump, operating_point, slipper_conductance, transmission, valve_plate_conductance
from system.points.transmission import Transmission

PUMP = Path(__file__).resolve().parents[4] / "examples" / "pumps" / "hst196.toml"
TIGHT = {
    "piston.radial_clearance": "0.01 um",
    "slipper.film_thickness": "0.01 um",
    "valve_plate.film_thickness": "0.01 um",
}
STIFF = {"oil.bulk_modulus": "1e6 GPa"}
WIDE_PORTS = {"ports.kidney_area": "328 mm2", "ports.flow_coefficient": 1.0}
# Each port is shut over 1 deg about its dead centre, over which a piston moves 8e-5 of its stroke.
TIMING = 2e-4


def couple(overrides: dict[str, object], **point: float) -> Transmission:
    pump = load_pump(PUMP, {**WIDE_PORTS, **overrides})
    return transmission(pump, pump, operating_point(pump, **point))


@pytest.mark.parametrize("share", [0.3, 1.3])
def test_compression_alone(share, validation):
    """r = rho low/rho high: a pump's chamber delivers r V_max - V_min, a motor's takes V_max - r V_min."""
    swept = load_pump(PUMP).pump.displacement / 9.0
    dead = share * swept
    found = couple({**TIGHT, "pump.dead_volume": f"{dead * 1e6} cm3"})
    point = found.pump.point
    r = np.exp(-(point.delivery_pressure - point.inlet_pressure) / 1.5e9)
    largest = dead + swept
    validation(
        case="Hydrostatic transmission of two like machines",
        source="closed form: mass of the oil in a chamber at either dead centre",
        quantity=f"speed ratio, compression alone, dead volume {share:g} of the swept one",
        unit="1",
        expected=(r * largest - dead) / (largest - r * dead),
        obtained=found.speed_ratio,
        tolerance=TIMING,
    )
    assert found.volumetric_efficiency == pytest.approx(found.speed_ratio, rel=1e-12)
    assert found.motor.bench.inlet_flow == pytest.approx(found.pump.bench.delivery_flow, rel=1e-7)


def test_a_motor_is_told_as_one():
    """Its efficiencies as a pump are void since its oil drives it, not since it leaks."""
    motor = couple({}).motor
    assert motor.bench.shaft_power < 0.0
    (told,) = (one for one in motor.warnings if one.warning.value == "no_delivery")
    assert "the oil drives the shaft" in told.text
    assert "leakage" not in told.text


def test_leakage_alone(validation):
    """The leakage of the chambers at high pressure, half of them at a time, is lost twice: 1 - z G (p - p_case)/Q."""
    found = couple({**TIGHT, **STIFF, "slipper.film_thickness": "15 um", "valve_plate.film_thickness": "15 um"})
    pump, point = load_pump(PUMP), found.pump.point
    plate, slipper = pump.valve_plate, pump.slipper
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, plate.land_radius_4)
    conductance = valve_plate_conductance(radii, 15e-6, 9, point.viscosity) + slipper_conductance(
        slipper.lands.log_ratio, 15e-6, slipper.orifice_diameter, slipper.orifice_length, point.viscosity
    )
    lost = 4.5 * conductance * (point.delivery_pressure - point.case_pressure)
    ideal = found.pump.geometric_displacement * point.shaft_speed / (2.0 * np.pi)
    validation(
        case="Hydrostatic transmission of two like machines",
        source="closed form: leakage of the chambers at high pressure",
        quantity="speed ratio, leakage alone",
        unit="1",
        expected=1.0 - 2.0 * lost / ideal,
        obtained=found.speed_ratio,
        tolerance=TIMING,
    )


def test_a_pump_that_swings_in_drives_slower():
    """Half the displacement, less than half the speed: the same leaks weigh twice as much."""
    half, full = couple({}, displacement_ratio=0.5), couple({})
    assert full.motor.bench.shaft_power < 0.0 < full.pump.bench.shaft_power
    assert half.speed_ratio < 0.5 * full.speed_ratio
    assert half.volumetric_efficiency == pytest.approx(2.0 * half.speed_ratio, rel=1e-9)
    lost, at_full = 1.0 - half.volumetric_efficiency, 1.0 - full.volumetric_efficiency
    assert at_full < lost < 2.0 * at_full  # of the compression only the pump's own weighs more


def test_a_pump_that_delivers_nothing_is_refused():
    with pytest.raises(ValueError, match=r"transmission: the pump delivers .* less than the motor loses"):
        couple({"valve_plate.film_thickness": "100 um", "slipper.film_thickness": "60 um"}, shaft_speed=20.0)
