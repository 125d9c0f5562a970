"""Compiled state of one chamber at a shaft angle: oil, volume, outflow paths, flows and their energy.

State: mass over reference density M = V/s(p) in m3, with s(p) the specific volume of the oil relative to zero
gauge pressure, s = exp(-p/K) while it is liquid without air. Then dM/dphi = -sum(q)/(s w) is conservation of mass and,
divided by M, the corrected Eq. (14). Every q > 0 leaves the chamber and is a volume of oil at chamber pressure, with
its bubbles: beside a cavity too it is oil that passes ports and gaps, so its mass is q over the s of that.

Quantities that vary over the turn are periodic cubics on equal intervals of shaft angle, in unit cells: `table` (N,
TABLE, 4) has the gaps' conductances and drag flows and the growth of the volume by the parts' own motion in m3; `ports`
(M, 2, 4) the pressures of delivery and suction port, M = 1 where held. `layout` names the columns.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np

from system.inputs.units import STANDARD_ATMOSPHERE
from system.pump.chamber import layout as col
from system.pump.chamber.layout import CAVITY_PRESSURE, CAVITY_SOFTNESS, PATHS
from system.pump.ports.areas import FLOW_FROM, PORT_SIZE, orifice, orifice_coefficients, section_area
from system.pump.ports.flow_coefficients import flow_scale, with_factor

CHAMBER = np.dtype(
    [
        ("shaft_speed", "f8"),
        ("piston_area", "f8"),
        ("stroke_scale", "f8"),
        ("cone_swash_product", "f8"),
        ("dead_volume", "f8"),
        ("bulk_modulus", "f8"),
        ("free_air", "f8"),
        ("air_exponent", "f8"),
        ("density", "f8"),
        ("kinematic_viscosity", "f8"),
        ("flow_coefficient", "f8"),
        ("critical_reynolds", "f8"),
        ("delivery_pressure", "f8"),
        ("inlet_pressure", "f8"),
        ("case_pressure", "f8"),
        ("delivery_port", "f8", (PORT_SIZE,)),
        ("suction_port", "f8", (PORT_SIZE,)),
    ],
    align=True,
)
"""Constants of one chamber at one operating point, SI, as the compiled code reads them."""

records = numba.from_dtype(CHAMBER)[::1]
f8, vector, cubics = numba.f8, numba.f8[::1], numba.f8[:, :, ::1]
oils = numba.types.UniTuple(f8, 3)


@numba.njit(oils(records), cache=True, error_model="numpy")
def oil_of(chamber):
    """A chamber's oil for the functions of its volume and energy: modulus, free air, exponent of the air."""
    c = chamber[0]
    return c.bulk_modulus, c.free_air, c.air_exponent


@numba.njit(numba.types.UniTuple(f8, 3)(f8, oils), cache=True, error_model="numpy")
def oil_volume(pressure, oil):
    """Specific volumes (relative) of the oil with its cavity and of the flowing oil, and -ds/dp of the former in 1/Pa.

    Liquid of constant bulk modulus with bubbles, s = exp(-p/K) + x (p0/(p + p0))^m; below CAVITY_PRESSURE oil and
    cavity together, nearly at that pressure. Oil in ports and gaps has no cavity, but the bubbles.
    """
    modulus, air, exponent = oil
    above = max(pressure, CAVITY_PRESSURE)
    flowing = np.exp(-above / modulus)
    compressibility = flowing / modulus
    if air > 0.0:
        absolute = above + STANDARD_ATMOSPHERE
        bubbles = air * (STANDARD_ATMOSPHERE / absolute) ** exponent
        flowing += bubbles
        compressibility += exponent * bubbles / absolute
    if pressure >= CAVITY_PRESSURE:
        return flowing, flowing, compressibility
    compressibility = flowing / CAVITY_SOFTNESS
    return flowing + compressibility * (CAVITY_PRESSURE - pressure), flowing, compressibility


@numba.njit(f8(f8, f8, oils), cache=True, error_model="numpy")
def oil_change(start, end, oil):
    """Change of a chamber's oil over a turn that leads from one pressure to another, in Pa.

    Of liquid the change of its pressure. Beside a cavity the pressure hardly depends on the amount of oil; there the
    change of pressure is that by which liquid would hold as much more: K dM/M.
    """
    return oil[0] * (oil_volume(start, oil)[0] / oil_volume(end, oil)[0] - 1.0)


@numba.njit(f8(f8, f8, f8, oils), cache=True, error_model="numpy")
def oil_energy(pressure, specific, flowing, oil):
    """Flow energy h = integral of s dp in Pa from zero gauge pressure, of oil of these specific volumes."""
    modulus, air, exponent = oil
    above = max(pressure, CAVITY_PRESSURE)
    energy = modulus * (1.0 - np.exp(-above / modulus))
    if air > 0.0:
        grown, left = np.log(1.0 + above / STANDARD_ATMOSPHERE), 1.0 - exponent
        energy += air * STANDARD_ATMOSPHERE * (np.expm1(left * grown) / left if left > 1e-9 else grown)
    if pressure >= CAVITY_PRESSURE:
        return energy
    return energy - 0.5 * (CAVITY_PRESSURE - pressure) * (flowing + specific)


@numba.njit(f8(f8, oils), cache=True, error_model="numpy")
def energy_at(pressure, oil):
    """`oil_energy` at a pressure."""
    specific, flowing, _ = oil_volume(pressure, oil)
    return oil_energy(pressure, specific, flowing, oil)


@numba.njit(numba.types.Tuple((numba.i8, f8))(numba.i8, f8), cache=True, error_model="numpy")
def cell(count, shaft_angle):
    """The one of `count` equal intervals of a turn that an angle lies in, and where in it, 0 to 1."""
    x = shaft_angle * (count / (2.0 * np.pi))
    whole = int(np.floor(x))
    return whole % count, x - whole


@numba.njit(f8(cubics, numba.i8, numba.i8, f8), cache=True, error_model="numpy")
def cubic(table, at, row, x):
    """Value of a row of periodic cubics, x of the way through interval `at`."""
    return table[at, row, 0] + x * (table[at, row, 1] + x * (table[at, row, 2] + x * table[at, row, 3]))


@numba.njit(numba.types.UniTuple(f8, 2)(records, cubics, f8), cache=True, error_model="numpy")
def volume(chamber, table, shaft_angle):
    """Chamber volume V0 + Ap S + growth in m3 and dV/dphi in m3/rad; Eqs. (18), (6), (7)."""
    c = chamber[0]
    t = c.cone_swash_product
    cosine = np.cos(shaft_angle)
    swing = 1.0 + t * cosine
    scale = c.piston_area * c.stroke_scale
    count = table.shape[0]
    at, x = cell(count, shaft_angle)
    grown = table[at, col.GROWTH]
    swell = (grown[1] + x * (2.0 * grown[2] + 3.0 * x * grown[3])) * count / (2.0 * np.pi)
    content = c.dead_volume + scale * (1.0 - cosine) / ((1.0 + t) * swing)
    return content + cubic(table, at, col.GROWTH, x), scale * np.sin(shaft_angle) / (swing * swing) + swell


@numba.njit(numba.void(records, f8, f8, vector), cache=True, error_model="numpy")
def port_ways(chamber, delivery_area, suction_area, out):
    """Fill the part of `ways_out` from the ports' areas (m2): ORIFICE, AREA and FLOW_SCALE."""
    c = chamber[0]
    law = (c.flow_coefficient, c.density, c.kinematic_viscosity, c.critical_reynolds)
    out[col.ORIFICE], out[col.ORIFICE + 1] = orifice_coefficients(delivery_area, *law)
    out[col.ORIFICE + 2], out[col.ORIFICE + 3] = orifice_coefficients(suction_area, *law)
    out[col.AREA + col.DELIVERY], out[col.AREA + col.SUCTION] = delivery_area, suction_area
    viscosity = c.kinematic_viscosity
    tables = c.delivery_port[FLOW_FROM:], c.suction_port[FLOW_FROM:]
    out[col.FLOW_SCALE + col.DELIVERY] = flow_scale(delivery_area, c.density, viscosity, tables[0])
    out[col.FLOW_SCALE + col.SUCTION] = flow_scale(suction_area, c.density, viscosity, tables[1])


@numba.njit(numba.void(records, cubics, cubics, f8, f8, f8, vector), cache=True, error_model="numpy")
def ways_out(chamber, table, ports, shaft_angle, delivery_area, suction_area, out):
    """Fill the ways out (WAYS,) at a shaft angle at which the ports open these areas (m2)."""
    at, x = cell(table.shape[0], shaft_angle)
    for row in range(2 * col.GAPS):
        out[row] = cubic(table, at, row, x)
    at, x = cell(ports.shape[0], shaft_angle)
    for port in range(col.PORTS):
        out[col.BEHIND + port] = cubic(ports, at, port, x)
    port_ways(chamber, delivery_area, suction_area, out)


@numba.njit(numba.void(records, cubics, cubics, f8, vector), cache=True, error_model="numpy")
def openings(chamber, table, ports, shaft_angle, out):
    """`ways_out` at a shaft angle, with the ports' openings there."""
    c = chamber[0]
    delivery, suction = section_area(shaft_angle, c.delivery_port), section_area(shaft_angle, c.suction_port)
    ways_out(chamber, table, ports, shaft_angle, delivery, suction, out)


@numba.njit(numba.types.UniTuple(f8, 3)(records, f8, vector, vector), cache=True, error_model="numpy")
def outflows(chamber, pressure, ways, flows):
    """Fill the volume flows in m3/s of the five paths; return the slopes in m3/(s Pa) of the ports' and of all."""
    c = chamber[0]
    ahead, behind = pressure - ways[col.BEHIND + col.DELIVERY], pressure - ways[col.BEHIND + col.SUCTION]
    flow, slope = orifice(ahead, ways[col.ORIFICE], ways[col.ORIFICE + 1])
    area, scale = ways[col.AREA + col.DELIVERY], ways[col.FLOW_SCALE + col.DELIVERY]
    flows[col.DELIVERY], delivery = with_factor(flow, slope, ahead, scale, area, c.delivery_port[FLOW_FROM:])
    flow, slope = orifice(behind, ways[col.ORIFICE + 2], ways[col.ORIFICE + 3])
    area, scale = ways[col.AREA + col.SUCTION], ways[col.FLOW_SCALE + col.SUCTION]
    flows[col.SUCTION], suction = with_factor(flow, slope, behind, scale, area, c.suction_port[FLOW_FROM:])
    slope = delivery + suction
    for gap in range(col.GAPS):
        conductance = ways[col.CONDUCTANCE + gap]
        flows[col.FIRST_GAP + gap] = conductance * (pressure - c.case_pressure) + ways[col.DRAG_FLOW + gap]
        slope += conductance
    return delivery, suction, slope


@numba.njit(numba.void(records, f8, f8, f8, vector, vector, vector), cache=True, error_model="numpy")
def integral_rates(chamber, pressure, specific, swell, ways, flows, out):
    """Rates per radian of the integrals, (INTEGRALS,); `swell` is dV/dphi.

    The energy left in a path is its mass flow times h(p) - h(p_outside): the heat of throttling and leakage. The walls
    do the same work on the oil that they drag, counted separately because it is not a loss.
    """
    c = chamber[0]
    oil = oil_of(chamber)
    flowing = specific if pressure >= CAVITY_PRESSURE else oil_volume(CAVITY_PRESSURE, oil)[1]
    energy = oil_energy(pressure, specific, flowing, oil)
    case = energy - energy_at(c.case_pressure, oil)
    per_radian = 1.0 / (flowing * c.shaft_speed)
    for path in range(PATHS):
        out[col.OUTFLOW + path] = flows[path] * per_radian
        out[col.PATH_ENERGY + path] = out[col.OUTFLOW + path] * case
    for port in range(col.PORTS):
        behind = energy_at(ways[col.BEHIND + port], oil)
        out[col.PATH_ENERGY + port] = out[col.OUTFLOW + port] * (energy - behind)
        out[col.PORT_ENERGY + port] = out[col.OUTFLOW + port] * behind
    for gap in range(col.GAPS):
        out[col.DRAG_ENERGY + gap] = ways[col.DRAG_FLOW + gap] * per_radian * case
    out[col.WORK] = -pressure * swell
