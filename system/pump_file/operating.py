"""Checks of the operating point: can the pump be run there, and is it within its rating and its model?"""

import math
from collections.abc import Iterator
from dataclasses import replace

from reynolds.errors import InputError
from reynolds.laws.oil import walther
from system.description.lines import LineKind, ripple_faults
from system.description.parts import RetainerKind
from system.description.pump import OperatingSection, PumpDescription
from system.inputs.faults import Fault
from system.inputs.units import Dimension, format_quantity, to_absolute, to_gauge
from system.pump.laws.kinematics import ball_acceleration_along_bore, crossed_drive, drive_at_ratio, least_ratio
from system.pump.lumped import SAMPLES_PER_PITCH, block_spring, piston_area
from system.pump.operating import OperatingPoint
from system.pump_file.check import CheckReport, CheckWarning, Finding, angle, checks_in, needs, pressure, run_checks

# Below this an oil has given off its dissolved air and its light fractions boil; a mineral oil itself boils below
# 0.1 kPa at 50 degC. The model is one of liquid oil: assumption, order of magnitude.
CAVITATION_PRESSURE_ABS = 5e3
# Requirement of makers of axial piston pumps for a suction line, 0.8 bar absolute: below it chambers fill in part.
FILLING_PRESSURE_ABS = 80e3
# Limit of the case of an axial piston pump, for its shaft seal, as makers commonly quote it (A4VG, as recalled; the
# original was not at hand): 3 bar absolute in continuous operation, 6 bar absolute at a cold start.
CASE_PRESSURE_ABS = 600e3
# Of its volume; a mineral oil (1.4 to 2 GPa, stiffer as it is pressed) is not compressed so far by any pump.
LARGE_COMPRESSION = 0.1
VISCOSITY_KEYS = (
    "oil.kinematic_viscosity_40C",
    "oil.kinematic_viscosity_100C",
    "operating.temperature",
    "oil.density",
    "oil.bulk_modulus",
    "oil.specific_heat",
)
"""Keys that the oil's viscosity at the operating temperature needs."""
# Makers' limits of a mineral oil in an axial piston pump, m2/s: Bosch Rexroth, RE 92714 (A10VSO, 10.2014): 10 to 400
# in continuous operation, up to 1600 at a cold start, for minutes and without load.
THINNEST = 10e-6
THICKEST = 400e-6
THICKEST_AT_START = 1600e-6


def _above_cavitation(path: str, value: float) -> Iterator[Finding]:
    if to_absolute(value) <= CAVITATION_PRESSURE_ABS:
        yield Fault(
            path,
            f"{pressure(value)} gauge, {pressure(to_absolute(value))} absolute: the oil cavitates",
            f"more than {pressure(to_gauge(CAVITATION_PRESSURE_ABS))} gauge "
            f"({pressure(CAVITATION_PRESSURE_ABS)} absolute)",
            "pressures are gauge (atmosphere = 0) unless the key ends in _abs",
        )


@needs("operating.pressure")
def delivery_is_above_cavitation(pump: PumpDescription) -> Iterator[Finding]:
    """Liquid oil at the delivery port."""
    yield from _above_cavitation("operating.pressure", pump.operating.pressure)


@needs("operating.inlet_pressure")
def inlet_is_above_cavitation(pump: PumpDescription) -> Iterator[Finding]:
    """Liquid oil at the inlet, and enough pressure there to fill the chambers."""
    value = pump.operating.inlet_pressure
    yield from _above_cavitation("operating.inlet_pressure", value)
    if CAVITATION_PRESSURE_ABS < to_absolute(value) < FILLING_PRESSURE_ABS:
        yield CheckWarning(
            "operating.inlet_pressure",
            f"{pressure(to_absolute(value))} absolute",
            f"{pressure(FILLING_PRESSURE_ABS)} absolute (chambers may fill in part, which is not modelled)",
            "raise the inlet pressure, or take flow as an upper bound",
        )


@needs("operating.case_pressure")
def case_has_the_pressure_of_a_housing(pump: PumpDescription) -> Iterator[Finding]:
    """Liquid oil in the case, where every film ends, at a pressure that a shaft seal bears."""
    value = pump.operating.case_pressure
    yield from _above_cavitation("operating.case_pressure", value)
    if to_absolute(value) > CASE_PRESSURE_ABS:
        yield CheckWarning(
            "operating.case_pressure",
            f"{pressure(value)} gauge, {pressure(to_absolute(value))} absolute",
            f"{pressure(CASE_PRESSURE_ABS)} absolute, what shaft seals bear at a cold start",
            "check the unit: bar, not MPa?",
        )


@needs("operating.pressure", "operating.inlet_pressure")
def pump_raises_pressure(pump: PumpDescription) -> Iterator[Finding]:
    """The delivery pressure is above the inlet pressure: the machine pumps."""
    delivery, inlet = pump.operating.pressure, pump.operating.inlet_pressure
    if delivery <= inlet:
        yield Fault(
            "operating.pressure",
            f"{pressure(delivery)} gauge",
            f"more than inlet_pressure, {pressure(inlet)} gauge (motoring is not modelled)",
        )


@needs("operating.pressure", "pump.rated_pressure")
def pressure_is_within_rating(pump: PumpDescription) -> Iterator[Finding]:
    """The delivery pressure does not exceed the rated one."""
    if pump.operating.pressure > pump.pump.rated_pressure:
        yield beyond_rated_pressure(pump.operating.pressure, pump.pump.rated_pressure)


def beyond_rated_pressure(delivery: float, rated: float) -> CheckWarning:
    """Return the warning of a delivery pressure above the rated one, Pa."""
    return CheckWarning(
        "operating.pressure",
        f"{pressure(delivery)} gauge",
        f"rated_pressure, {pressure(rated)} (films and coefficients are extrapolated)",
        "stay below it, or state a higher rated_pressure where the pump is made for it",
    )


@needs("operating.pressure", "oil.bulk_modulus")
def oil_is_little_compressed(pump: PumpDescription) -> Iterator[Finding]:
    """The delivery pressure is small against the bulk modulus, which is assumed constant."""
    ratio = pump.operating.pressure / pump.oil.bulk_modulus
    if ratio > LARGE_COMPRESSION:
        yield CheckWarning(
            "oil.bulk_modulus",
            f"{format_quantity(pump.oil.bulk_modulus, Dimension.MODULUS, digits=4)}, {1.0 / ratio:.3g} times the "
            f"delivery pressure of {pressure(pump.operating.pressure)}",
            f"{1.0 / LARGE_COMPRESSION:g} times (oil pressed by a tenth: its modulus is no constant there)",
            "check the unit: GPa, not MPa?",
        )


@needs("operating.speed", "pump.rated_speed")
def speed_is_within_rating(pump: PumpDescription) -> Iterator[Finding]:
    """The shaft turns, and not faster than rated."""
    speed, rated = pump.operating.speed, pump.pump.rated_speed
    if not speed > 0.0:
        yield Fault("operating.speed", format_quantity(speed, Dimension.ANGULAR_SPEED, digits=4), "more than 0 rpm")
    elif speed > rated:
        yield beyond_rated_speed(speed, rated)


def beyond_rated_speed(speed: float, rated: float) -> CheckWarning:
    """Return the warning of a shaft speed above the rated one, rad/s."""
    shown, limit = (format_quantity(one, Dimension.ANGULAR_SPEED, digits=4) for one in (speed, rated))
    return CheckWarning(
        "operating.speed",
        shown,
        f"rated_speed, {limit} (films and coefficients are extrapolated)",
        "stay below it, or state a higher rated_speed where the pump is made for it",
    )


@needs("operating.displacement_ratio")
def displacement_ratio_is_possible(pump: PumpDescription) -> Iterator[Finding]:
    """The displacement ratio is above 0 (no stroke, no pump) and at most 1 (full swash angle)."""
    ratio = pump.operating.displacement_ratio
    if not 0.0 < ratio <= 1.0:
        yield Fault("operating.displacement_ratio", f"{ratio:g}", "more than 0 and at most 1 (full displacement)")


@needs(*VISCOSITY_KEYS)
def oil_has_a_viscosity(pump: PumpDescription) -> Iterator[Finding]:
    """The oil thins from 40 to 100 degC, and Walther's law holds at the operating temperature."""
    temperature = pump.operating.temperature
    try:
        fluid = pump.oil.fluid
    except InputError as reason:
        yield Fault(
            "oil.kinematic_viscosity_100C", reason.found, f"{reason.expected}: an oil that thins from 40 to 100 degC"
        )
        return
    try:
        walther(temperature, fluid)
    except InputError as reason:
        shown = format_quantity(temperature, Dimension.TEMPERATURE, digits=4)
        yield Fault("operating.temperature", shown, f"where the oil's law holds: {reason.expected}")


@needs(*VISCOSITY_KEYS)
def oil_is_neither_thick_nor_thin(pump: PumpDescription) -> Iterator[Finding]:
    """The oil's viscosity at the operating temperature is one that makers of pumps allow."""
    temperature = pump.operating.temperature
    try:
        viscosity = float(walther(temperature, pump.oil.fluid))
    except InputError:  # `oil_has_a_viscosity` reports such an oil
        return
    if THINNEST <= viscosity <= THICKEST:
        return
    found, thin, thick, start = (
        format_quantity(value, Dimension.KINEMATIC_VISCOSITY, digits=3)
        for value in (viscosity, THINNEST, THICKEST, THICKEST_AT_START)
    )
    at = format_quantity(temperature, Dimension.TEMPERATURE, digits=4)
    if viscosity < THINNEST:
        limit, remedy = f"{thin}, least in continuous operation", "a lower temperature or a thicker oil"
    else:
        limit = f"{thick}, largest in continuous operation (at a cold start without load {start})"
        remedy = "a higher temperature or a thinner oil"
        if viscosity > THICKEST_AT_START:
            remedy = f"{remedy}: no pump starts so, and the oil's law, stated at 40 and 100 degC, is extrapolated"
    yield CheckWarning("operating.temperature", f"at {at} the oil has {found}", limit, remedy)


@needs(
    "operating.displacement_ratio", "pump.cross_angle", "pump.swash_angle_max", "pump.bore_cone_angle",
    "pump.pitch_radius",
)  # fmt: skip
def cross_angle_leaves_the_displacement(pump: PumpDescription) -> Iterator[Finding]:
    """The cross angle is fixed: with it alone the pistons still move."""
    part, ratio = pump.pump, pump.operating.displacement_ratio
    cross = abs(part.cross_angle or 0.0)
    if math.tan(part.bore_cone_angle) * math.hypot(math.tan(part.swash_angle_max), math.tan(cross)) >= 1.0:
        return
    least = least_ratio(crossed_drive(part.pitch_radius, part.bore_cone_angle, part.swash_angle_max, cross))
    if ratio < least:
        expected = f"at least {least:.4g}, what the cross angle of {angle(cross)} displaces alone"
        yield Fault("operating.displacement_ratio", f"{ratio:g}", expected)


@needs("pump.pistons", "operating.speed")
def impedances_reach_the_ripple(pump: PumpDescription) -> Iterator[Finding]:
    """A line of given impedance is known at all harmonics of the ripple that the sampled angles resolve."""
    lowest = pump.pump.pistons * pump.operating.speed / (2.0 * math.pi)
    for name in ("delivery_line", "suction_line"):
        yield from ripple_faults(name, getattr(pump, name), lowest, lowest * (SAMPLES_PER_PITCH // 2))


@needs("operating.inlet_pressure")
def suction_flows_from_its_tank(pump: PumpDescription) -> Iterator[Finding]:
    """A suction orifice of free area lies between a tank and a lower inlet pressure."""
    line, inlet = pump.suction_line, pump.operating.inlet_pressure
    tank = line.tank_pressure
    if line.kind is LineKind.ORIFICE and line.orifice_area is None and tank is not None and tank <= inlet:
        yield Fault("suction_line.tank_pressure", pressure(tank), f"more than inlet_pressure, {pressure(inlet)}")


@needs(
    "operating.speed", "operating.displacement_ratio", "operating.inlet_pressure", "operating.case_pressure",
    "pump.pistons", "pump.piston_diameter", "pump.pitch_radius", "pump.swash_angle_max", "pump.bore_cone_angle",
    "pump.cross_angle", "piston.mass", "slipper.mass", "ball_guide.spring_preload", "ball_guide.spring_stiffness",
    "ball_guide.spring_compression", "retainer.kind",
)  # fmt: skip
def spring_holds_the_slippers(pump: PumpDescription) -> Iterator[Finding]:
    """The spring's share exceeds the force that pulls a slipper off the plate as its piston leaves the inner dead
    centre: inertia, and the case's pressure on the piston over the inlet's.
    """
    part, at = pump.pump, pump.operating
    cross = part.cross_angle or 0.0
    try:
        full = crossed_drive(part.pitch_radius, part.bore_cone_angle, part.swash_angle_max, cross)
        drive = drive_at_ratio(full, at.displacement_ratio)
    except ValueError:  # other checks report such a plate
        return
    inertia = (pump.piston.mass + pump.slipper.mass) * float(ball_acceleration_along_bore(drive, 0.0, at.speed))
    pull = inertia + piston_area(pump) * (at.case_pressure - at.inlet_pressure)
    held = block_spring(pump) / part.pistons
    if pull > held and pump.retainer.kind is not RetainerKind.CLEARANCE:
        yield CheckWarning(
            "ball_guide.spring_preload",
            f"inertia and the case's pressure over the inlet's pull a slipper off its plate with {pull:.4g} N at "
            "the inner dead centre",
            f"the spring's share, {held:.4g} N",
            "a stiffer spring, a lower case_pressure, or retainer.kind = 'clearance'",
        )


OPERATING_CHECKS = checks_in(globals())


def check_operating_point(pump: PumpDescription, point: OperatingPoint) -> CheckReport:
    """Return all faults and doubts about a run of the pump at a point."""
    stated = OperatingSection(
        speed=point.shaft_speed,
        pressure=point.delivery_pressure,
        displacement_ratio=point.displacement_ratio,
        temperature=point.temperature,
        inlet_pressure=point.inlet_pressure,
        case_pressure=point.case_pressure,
    )
    return run_checks(OPERATING_CHECKS, replace(pump, operating=stated))
