"""Compiled integration of one chamber over shaft angle: oil, flows, one implicit step, one revolution.

State: mass over reference density M = V/s(p) in m3, with s(p) the specific volume of the oil relative to zero
gauge pressure, s = exp(-p/K) while it is liquid. Then dM/dphi = -sum(q)/(s w) is conservation of mass and,
divided by M, the corrected Eq. (14). Every q > 0 leaves the chamber and is a volume of liquid at chamber pressure:
beside a cavity too it is liquid that passes ports and gaps, so its mass is q over the s of the liquid.

Method: ESDIRK4(3)6L[2]SA of Kennedy and Carpenter (2003), Applied Numerical Mathematics 44, p. 139: order 4 with
an embedded order 3, L-stable, stiffly accurate, stage order 2 (a chamber open to its port is stiff, and methods
of stage order 1 get its flow wrong by 0.5 % there). The integrals below are advanced with the same weights as M,
so what enters the chamber leaves it to round-off whatever the step.

What varies over the turn comes as periodic cubics on equal intervals of shaft angle, in unit cells: `table` (N, 7,
4) has the gaps' conductances (0-2) and carried flows (3-5) and the growth of the volume by the parts' own motion
(6, m3); `ports` (M, 2, 4) the pressures of delivery and suction port, M = 1 where held.
"""

from __future__ import annotations

import numba
import numpy as np

from system.ports import PORT_SIZE, orifice, orifice_coefficients, section_area

CHAMBER = np.dtype(
    [
        ("shaft_speed", "f8"),
        ("piston_area", "f8"),
        ("stroke_scale", "f8"),
        ("cone_swash_product", "f8"),
        ("dead_volume", "f8"),
        ("bulk_modulus", "f8"),
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

PATHS = 5
"""Ways out of the chamber: delivery port, suction port, then the gaps of piston, slipper, valve plate."""
INTEGRALS = 16
"""Mass out by each path (0-4), work -p dV (5), energy left in each path (6-10), work of moving walls (11-13),
energy carried into delivery and suction port (14, 15)."""
WAYS = 12
STAGES = 6

# Butcher table: row i holds a_ij, the last row is also b; ERROR is b minus the embedded weights.
GAMMA = 0.25
WEIGHTS = np.array([82889 / 524892, 0.0, 15625 / 83664, 69875 / 102672, -2260 / 8211, 0.25])
EMBEDDED = np.array(
    [
        4586570599 / 29645900160,
        0.0,
        178811875 / 945068544,
        814220225 / 1159782912,
        -3700637 / 11593932,
        61727 / 225920,
    ]
)
TABLEAU = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.25, 0.25, 0.0, 0.0, 0.0, 0.0],
        [8611 / 62500, -1743 / 31250, 0.25, 0.0, 0.0, 0.0],
        [5012029 / 34652500, -654441 / 2922500, 174375 / 388108, 0.25, 0.0, 0.0],
        [15267082809 / 155376265600, -71443401 / 120774400, 730878875 / 902184768, 2285395 / 8070912, 0.25, 0.0],
        list(WEIGHTS),
    ]
)
NODES = np.array([0.0, 0.5, 83 / 250, 31 / 50, 17 / 20, 1.0])
ERROR = WEIGHTS - EMBEDDED

CAVITY_PRESSURE = 1e3 - 101325.0
"""Gauge pressure in Pa at which a cavity opens (1 kPa absolute): oil bears no tension. Its vapour pressure is
lower still, and dissolved air leaves it earlier; neither moves a chamber pressure that is shown in bar."""
CAVITY_SOFTNESS = 1e3
"""Fall of the pressure in Pa below CAVITY_PRESSURE while the void grows to the oil's own volume."""

OK, NO_STAGE, STEP_TOO_SMALL = 0, 1, 2
NEWTON_LIMIT = 100
NEWTON_TOLERANCE = 1e-12  # of the bulk modulus: some mPa, far below the width of any orifice's laminar range
SMALLEST_STEP = 1e-12  # rad
FIRST_STEP = 1e-3  # rad
CAVITY_STEP = 1e-4  # rad; no longer step may open or close a cavity, where dp/dphi jumps unseen by the mass

_records = numba.from_dtype(CHAMBER)[::1]
_f8, _vector, _matrix, _cubics = numba.f8, numba.f8[::1], numba.f8[:, ::1], numba.f8[:, :, ::1]


@numba.njit(numba.types.UniTuple(_f8, 3)(_f8, _f8), cache=True)
def oil_state(pressure, bulk_modulus):
    """Specific volume s (relative), its compressibility -ds/dp in 1/Pa, flow energy h = integral of s dp in Pa.

    Liquid of constant bulk modulus; below CAVITY_PRESSURE oil and cavity together, nearly at that pressure.
    """
    if pressure >= CAVITY_PRESSURE:
        specific = np.exp(-pressure / bulk_modulus)
        return specific, specific / bulk_modulus, bulk_modulus * (1.0 - specific)
    liquid = np.exp(-CAVITY_PRESSURE / bulk_modulus)
    below = CAVITY_PRESSURE - pressure
    compressibility = liquid / CAVITY_SOFTNESS
    energy = bulk_modulus * (1.0 - liquid) - below * (liquid + 0.5 * compressibility * below)
    return liquid + compressibility * below, compressibility, energy


@numba.njit(_f8(_f8, _f8), cache=True)
def liquid_volume(pressure, bulk_modulus):
    """Specific volume (relative) of what passes ports and gaps: liquid, also beside a cavity in the chamber."""
    return np.exp(-max(pressure, CAVITY_PRESSURE) / bulk_modulus)


@numba.njit(numba.types.UniTuple(_f8, 2)(_cubics, _f8, numba.i8), cache=True)
def periodic(cubics, shaft_angle, row):
    """Value and slope per radian of one row of periodic cubics at a shaft angle."""
    count = cubics.shape[0]
    x = shaft_angle / (2.0 * np.pi) * count
    cell = int(np.floor(x))
    x -= cell
    k = cubics[cell % count, row]
    value = k[0] + x * (k[1] + x * (k[2] + x * k[3]))
    return value, (k[1] + x * (2.0 * k[2] + 3.0 * x * k[3])) * count / (2.0 * np.pi)


@numba.njit(numba.types.UniTuple(_f8, 2)(_records, _cubics, _f8), cache=True)
def volume(chamber, table, shaft_angle):
    """Chamber volume V0 + Ap S + growth in m3 and dV/dphi in m3/rad; Eqs. (18), (6), (7)."""
    c = chamber[0]
    t = c.cone_swash_product
    cosine = np.cos(shaft_angle)
    swing = 1.0 + t * cosine
    scale = c.piston_area * c.stroke_scale
    growth, swell = periodic(table, shaft_angle, 6)
    content = c.dead_volume + scale * (1.0 - cosine) / ((1.0 + t) * swing)
    return content + growth, scale * np.sin(shaft_angle) / (swing * swing) + swell


@numba.njit(numba.void(_records, _cubics, _cubics, _f8, _vector), cache=True)
def openings(chamber, table, ports, shaft_angle, out):
    """What lets oil out at a shaft angle, WAYS numbers.

    Conductances (0-2) and carried flows (3-5) of the gaps; then both orifice coefficients of the delivery (6, 7)
    and of the suction port (8, 9), and the pressures in Pa behind them (10, 11).
    """
    c = chamber[0]
    for i in range(6):
        out[i] = periodic(table, shaft_angle, i)[0]
    out[10], out[11] = periodic(ports, shaft_angle, 0)[0], periodic(ports, shaft_angle, 1)[0]
    law = (c.flow_coefficient, c.density, c.kinematic_viscosity, c.critical_reynolds)
    out[6], out[7] = orifice_coefficients(section_area(shaft_angle, c.delivery_port), *law)
    out[8], out[9] = orifice_coefficients(section_area(shaft_angle, c.suction_port), *law)


@numba.njit(numba.types.UniTuple(_f8, 2)(_records, _f8, _vector, _vector), cache=True)
def outflows(chamber, pressure, ways, flows):
    """Fill the volume flows in m3/s of the five paths; return their sum and its slope in m3/(s Pa)."""
    c = chamber[0]
    flows[0], slope_delivery = orifice(pressure - ways[10], ways[6], ways[7])
    flows[1], slope_suction = orifice(pressure - ways[11], ways[8], ways[9])
    total, slope = flows[0] + flows[1], slope_delivery + slope_suction
    for gap in range(3):
        flows[2 + gap] = ways[gap] * (pressure - c.case_pressure) + ways[3 + gap]
        total += flows[2 + gap]
        slope += ways[gap]
    return total, slope


@numba.njit(numba.types.Tuple((_f8, _f8, numba.b1))(_records, _f8, _f8, _f8, _f8, _vector, _vector), cache=True)
def stage_pressure(chamber, guess, content, mass, weight, ways, flows):
    """Pressure with V = s(p) (mass - weight sum(q)/s_liquid(p)), its stiffness ratio, and whether it was found.

    `weight` is gamma times the step over the shaft speed; `flows` holds the path flows at the pressure returned.
    The equation rises strictly with p wherever anything depends on p at all, so Newton inside a shrinking bracket
    finds its one root.
    """
    bulk = chamber[0].bulk_modulus
    low, high, pressure = -np.inf, np.inf, guess
    for _ in range(NEWTON_LIMIT):
        total, slope = outflows(chamber, pressure, ways, flows)
        specific, compressibility, _h = oil_state(pressure, bulk)
        mixed = specific / liquid_volume(pressure, bulk)  # 1 but where a cavity is open
        rest = content - mass * specific + weight * total * mixed
        if rest > 0.0:
            high = pressure
        else:
            low = pressure
        stiff = weight * slope * mixed
        soft = mass * compressibility
        if mixed > 1.0:
            soft -= weight * total * mixed * compressibility / specific
        if soft + stiff <= 0.0:
            break
        change = rest / (soft + stiff)
        new = pressure - min(max(change, -0.1 * bulk), 0.1 * bulk)
        close = abs(change) <= NEWTON_TOLERANCE * bulk
        if not close and (new <= low or new >= high):
            new = 0.5 * (low + high)
        pressure = new
        if close:
            outflows(chamber, pressure, ways, flows)
            return pressure, stiff / max(soft, 1e-300), True
    return pressure, 0.0, False


@numba.njit(numba.void(_records, _f8, _f8, _vector, _vector, _vector), cache=True)
def integral_rates(chamber, pressure, swell, ways, flows, out):
    """Rates per radian of the integrals, in the order of INTEGRALS; `swell` is dV/dphi.

    The energy left in a path is its mass flow times h(p) - h(p_outside): what throttling and leaking turn into
    heat. Walls that carry oil do the same work on the carried part, kept apart because it is not a loss.
    """
    c = chamber[0]
    energy = oil_state(pressure, c.bulk_modulus)[2]
    case = energy - oil_state(c.case_pressure, c.bulk_modulus)[2]
    per_radian = 1.0 / (liquid_volume(pressure, c.bulk_modulus) * c.shaft_speed)
    for path in range(PATHS):
        out[path] = flows[path] * per_radian
        out[6 + path] = out[path] * case
    for port in range(2):
        behind = oil_state(ways[10 + port], c.bulk_modulus)[2]
        out[6 + port] = out[port] * (energy - behind)
        out[14 + port] = out[port] * behind
    for gap in range(3):
        out[11 + gap] = ways[3 + gap] * per_radian * case
    out[5] = -pressure * swell


@numba.njit(
    numba.types.Tuple((_f8, _f8, _f8, numba.b1))(_records, _cubics, _cubics, _f8, _f8, _f8, _f8, _matrix),
    cache=True,
)
def step(chamber, table, ports, shaft_angle, length, mass, pressure, rates):
    """One step: new mass, new pressure, error of the mass (filtered for stiffness), success.

    `rates` (STAGES x INTEGRALS) brings the rates at the start in its first row and holds every stage's after; the
    last row is the solution at the step's end.
    """
    c = chamber[0]
    ways = np.empty(WAYS)
    flows = np.empty(PATHS)
    weight = GAMMA * length / c.shaft_speed
    stiffness = 0.0
    for stage in range(1, STAGES):
        angle = shaft_angle + NODES[stage] * length
        content, swell = volume(chamber, table, angle)
        openings(chamber, table, ports, angle, ways)
        base = mass
        for path in range(PATHS):
            for earlier in range(stage):
                base -= length * TABLEAU[stage, earlier] * rates[earlier, path]
        pressure, stiffness, found = stage_pressure(chamber, pressure, content, base, weight, ways, flows)
        if not found:
            return mass, pressure, 0.0, False
        integral_rates(chamber, pressure, swell, ways, flows, rates[stage])
    new_mass, error = mass, 0.0
    for path in range(PATHS):
        for stage in range(STAGES):
            new_mass -= length * WEIGHTS[stage] * rates[stage, path]
            error -= length * ERROR[stage] * rates[stage, path]
    return new_mass, pressure, error / (1.0 + stiffness), True


@numba.njit(numba.void(_records, _cubics, _cubics, _f8, _f8, _vector), cache=True)
def rates_at(chamber, table, ports, shaft_angle, pressure, out):
    """Rates of the integrals at a shaft angle and pressure: the first row that `step` needs."""
    ways, flows = np.empty(WAYS), np.empty(PATHS)
    openings(chamber, table, ports, shaft_angle, ways)
    outflows(chamber, pressure, ways, flows)
    integral_rates(chamber, pressure, volume(chamber, table, shaft_angle)[1], ways, flows, out)


@numba.njit(numba.types.Tuple((_f8, numba.b1))(_records, _cubics, _cubics, _f8), cache=True)
def slaved_pressure(chamber, table, ports, shaft_angle):
    """Pressure at which the outflow just equals the displacement, and whether there is one.

    What an open port forces on the chamber whatever it did before: where a revolution is best begun.
    """
    c = chamber[0]
    ways, flows = np.empty(WAYS), np.empty(PATHS)
    openings(chamber, table, ports, shaft_angle, ways)
    swept = volume(chamber, table, shaft_angle)[1] * c.shaft_speed
    pressure, _, found = stage_pressure(chamber, c.inlet_pressure, swept, 0.0, 1.0, ways, flows)
    return pressure, found


@numba.njit(
    numba.types.Tuple((_f8, numba.i8, numba.i8, numba.i8))(
        _records, _cubics, _cubics, _vector, _f8, _f8, _vector, _matrix, _matrix, _vector
    ),
    cache=True,
)
def revolution(chamber, table, ports, nodes, pressure, tolerance, pressures, path_rates, passed, totals):
    """One turn from a pressure at nodes[0]: mass at the end less that at the start, steps taken, refused, status.

    Steps end on every node (ascending shaft angles over one turn, breaks of the ports among them). `pressures`,
    `path_rates` (mass per radian by path) and `passed` (mass by path since nodes[0]) receive the solution at
    nodes[1:], `totals` (2 x INTEGRALS) the integrals and the sums of their local error estimates. Every step keeps
    the error of p, and of the work and throttling energy relative to one stroke's, below `tolerance` times the
    port pressure difference.
    """
    c = chamber[0]
    begin = volume(chamber, table, nodes[0])[0] / oil_state(pressure, c.bulk_modulus)[0]
    mass = begin
    scale = tolerance * (abs(c.delivery_pressure - c.inlet_pressure) + 1e5)
    work_scale = scale * c.piston_area * 2.0 * c.stroke_scale
    rates = np.empty((STAGES, INTEGRALS))
    rates_at(chamber, table, ports, nodes[0], pressure, rates[0])
    totals[:] = 0.0
    taken, refused, wish = 0, 0, FIRST_STEP
    for node in range(1, nodes.size):
        angle = nodes[node - 1]
        while angle < nodes[node]:
            length = min(wish, nodes[node] - angle)
            state = mass, pressure
            new_mass, new_pressure, error, fine = step(chamber, table, ports, angle, length, *state, rates)
            size = abs(error) / new_mass * c.bulk_modulus / scale
            for k in range(5, 8):
                slip = 0.0
                for stage in range(STAGES):
                    slip += length * ERROR[stage] * rates[stage, k]
                size = max(size, abs(slip) / work_scale)
            if length > CAVITY_STEP and (pressure < CAVITY_PRESSURE) != (new_pressure < CAVITY_PRESSURE):
                size = max(size, 1e3)
            if not fine or size > 1.0:
                refused += 1
                wish = length * (max(0.2, 0.9 * size**-0.25) if fine else 0.25)
                if wish < SMALLEST_STEP:
                    return mass - begin, taken, refused, STEP_TOO_SMALL if fine else NO_STAGE
                continue
            for k in range(INTEGRALS):
                for stage in range(STAGES):
                    totals[k] += length * WEIGHTS[stage] * rates[stage, k]
                    totals[INTEGRALS + k] += length * ERROR[stage] * rates[stage, k]
            rates[0] = rates[STAGES - 1]
            mass, pressure = new_mass, new_pressure
            taken += 1
            angle = nodes[node] if length >= nodes[node] - angle else angle + length
            grown = length * min(4.0, 0.9 * max(size, 1e-4) ** -0.25)
            wish = max(wish, grown) if length < wish else grown
        pressures[node - 1] = pressure
        path_rates[node - 1] = rates[0, :PATHS]
        passed[node - 1] = totals[:PATHS]
    return mass - begin, taken, refused, OK
