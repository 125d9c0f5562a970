"""Compiled integration of one chamber over shaft angle: one implicit step, one revolution.

Method: ESDIRK4(3)6L[2]SA of Kennedy and Carpenter (2003), Applied Numerical Mathematics 44, p. 139: order 4 with an
embedded order 3, L-stable, stiffly accurate, stage order 2 (a chamber open to its port is stiff, and methods of stage
order 1 get its flow wrong by 0.5 % there). The integrals below are advanced with the same weights as M, so inflow and
outflow of the chamber balance to round-off for any step. Steps are predicted after Gustafsson (1994), ACM Transactions
on Mathematical Software 20, p. 496: from the growth of the error over the last two.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np

from system.pump.chamber import layout as col
from system.pump.chamber.layout import CAVITY_PRESSURE, INTEGRALS, PATHS, WAYS
from system.pump.chamber.problem import pressure_span
from system.pump.chamber.state_kernels import (
    cubics,
    f8,
    integral_rates,
    oil_of,
    oil_volume,
    openings,
    outflows,
    records,
    vector,
    volume,
)

STAGES = 6
LEFT, PRESSURE, OPEN = INTEGRALS, INTEGRALS + 1, INTEGRALS + 2
COLUMNS = OPEN + col.PORTS
"""Columns of a stage: the columns of `fill_stage`, its integrals' rates, mass out by all paths per radian, pressure;
then the areas of both ports."""
BEGIN, LENGTH, STAGE = 0, 1, 2
KEPT = 1 + col.PORTS
TRAIL = STAGE + KEPT * STAGES
"""Columns of a step that is kept: its begin and its length (rad), of each stage its pressure and its areas."""

# Butcher table: row i holds a_ij, the last row is also b; ERROR is b minus the embedded weights.
GAMMA = 0.25
WEIGHTS = np.array([82889 / 524892, 0.0, 15625 / 83664, 69875 / 102672, -2260 / 8211, 0.25])
EMBEDDED = np.array(
    [4586570599 / 29645900160, 0.0, 178811875 / 945068544, 814220225 / 1159782912, -3700637 / 11593932, 61727 / 225920]
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
FORESEEN = np.array(
    [
        [
            np.prod([(NODES[stage] - NODES[k]) / (NODES[j] - NODES[k]) for k in range(stage) if k != j])
            if j < stage
            else 0.0
            for j in range(STAGES)
        ]
        for stage in range(STAGES)
    ]
)
"""Weights of the stages before it in the polynomial that predicts the pressure of a stage."""

OK, NO_STAGE, STEP_TOO_SMALL = 0, 1, 2
NEWTON_LIMIT = 100
NEWTON_SHARE = 1e-2  # of the error of a step: the last change of a stage's pressure, which flows follow
NEWTON_TOLERANCE = 1e-12  # of the bulk modulus: the same where that is larger; some mPa, well above round-off
SMALLEST_STEP = 1e-12  # rad
SAFETY = 0.8  # of the step whose error would be just the allowed one
FIRST_STEP = 1e-3  # rad
CAVITY_STEP = 1e-4  # rad; no longer step may open or close a cavity, where dp/dphi jumps unseen by the mass

_matrix = numba.f8[:, ::1]


@numba.njit(f8(vector), cache=True, error_model="numpy")
def total_of(flows):
    """Sum over all paths."""
    total = 0.0
    for path in range(PATHS):
        total += flows[path]
    return total


@numba.njit(
    numba.types.Tuple((f8, f8, f8, numba.b1))(records, f8, f8, f8, f8, f8, vector, vector),
    cache=True,
    error_model="numpy",
)
def stage_pressure(chamber, guess, content, mass, weight, close, ways, flows):
    """Pressure with V = s(p) (mass - weight sum(q)/s_liquid(p)), s there, its stiffness ratio, and success.

    `weight` is gamma times the step over the shaft speed; `flows` holds the path flows at the pressure returned. The
    equation rises strictly with p wherever it depends on p, so Newton inside a shrinking bracket finds its one root; a
    change of at most `close` (Pa) is the last, and s and flows follow it by their slopes.
    """
    bulk, oil = chamber[0].bulk_modulus, oil_of(chamber)
    low, high, pressure, sharp = -np.inf, np.inf, guess, NEWTON_TOLERANCE * bulk
    for _ in range(NEWTON_LIMIT):
        delivery, suction, slope = outflows(chamber, pressure, ways, flows)
        total = total_of(flows)
        specific, liquid, compressibility = oil_volume(pressure, oil)
        mixed = specific / liquid if pressure < CAVITY_PRESSURE else 1.0
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
        crosses = (new < CAVITY_PRESSURE) != (pressure < CAVITY_PRESSURE)
        if abs(change) <= (sharp if crosses else max(close, sharp)):
            flows[col.DELIVERY] -= delivery * change
            flows[col.SUCTION] -= suction * change
            for gap in range(col.GAPS):
                flows[col.FIRST_GAP + gap] -= ways[col.CONDUCTANCE + gap] * change
            return new, specific + compressibility * change, stiff / max(soft, 1e-300), True
        if new <= low or new >= high:
            new = 0.5 * (low + high)
        pressure = new
    return pressure, 0.0, 0.0, False


@numba.njit(numba.void(records, f8, f8, f8, vector, vector, vector), cache=True, error_model="numpy")
def fill_stage(chamber, pressure, specific, swell, ways, flows, out):
    """A row of the stages that `step` needs."""
    integral_rates(chamber, pressure, specific, swell, ways, flows, out)
    out[LEFT] = total_of(out)
    out[PRESSURE] = pressure


@numba.njit(
    numba.types.Tuple((f8, f8, numba.b1))(records, cubics, cubics, f8, f8, f8, f8, f8, _matrix, vector, vector),
    cache=True,
    error_model="numpy",
)
def step(chamber, table, ports, shaft_angle, length, mass, slope, close, stages, ways, flows):
    """One step: new mass, error of the mass (filtered for stiffness), success.

    `stages` (STAGES, COLUMNS) brings the start in its first row and holds every stage after: rates of the integrals,
    LEFT, PRESSURE; the last row is the solution at the step's end. `slope`: dp/dphi predicted at the start; `ways` and
    `flows` are work space.
    """
    speed = chamber[0].shaft_speed
    weight = GAMMA * length / speed
    stiffness = 0.0
    for stage in range(1, STAGES):
        angle = shaft_angle + NODES[stage] * length
        content, swell = volume(chamber, table, angle)
        openings(chamber, table, ports, angle, ways)
        base = 0.0
        guess = NODES[1] * length * slope if stage == 1 else 0.0
        for earlier in range(stage):
            base += TABLEAU[stage, earlier] * stages[earlier, LEFT]
            guess += FORESEEN[stage, earlier] * stages[earlier, PRESSURE]
        pressure, specific, stiffness, found = stage_pressure(
            chamber, guess, content, mass - length * base, weight, close, ways, flows
        )
        if not found:
            return mass, 0.0, False
        fill_stage(chamber, pressure, specific, swell, ways, flows, stages[stage])
        for port in range(col.PORTS):
            stages[stage, OPEN + port] = ways[col.AREA + port]
    out, error = 0.0, 0.0
    for stage in range(STAGES):
        out += WEIGHTS[stage] * stages[stage, LEFT]
        error -= ERROR[stage] * stages[stage, LEFT]
    return mass - length * out, length * error / (1.0 + stiffness), True


@numba.njit(numba.types.Tuple((f8, numba.b1))(records, cubics, cubics, f8), cache=True, error_model="numpy")
def slaved_pressure(chamber, table, ports, shaft_angle):
    """Pressure at which the outflow just equals the displacement, and whether there is one.

    The pressure set by an open port, independent of history: the best start of a revolution.
    """
    c = chamber[0]
    ways, flows = np.empty(WAYS), np.empty(PATHS)
    openings(chamber, table, ports, shaft_angle, ways)
    swept = volume(chamber, table, shaft_angle)[1] * c.shaft_speed
    pressure, _, _, found = stage_pressure(chamber, c.inlet_pressure, swept, 0.0, 1.0, 0.0, ways, flows)
    return pressure, found


@numba.njit(f8(records, cubics, f8, f8, f8, f8, f8), cache=True, error_model="numpy")
def to_cavity(chamber, table, shaft_angle, length, mass, new_mass, left):
    """Way in rad into a step, to less than its length, until a cavity opens or has filled.

    The void, V less the liquid at CAVITY_PRESSURE, as a parabola: its value at both ends of the step, its slope at
    the start where oil leaves at the rate `left`.
    """
    liquid = oil_volume(CAVITY_PRESSURE, oil_of(chamber))[0]
    content, swell = volume(chamber, table, shaft_angle)
    void, rate = content - liquid * mass, swell + liquid * left
    last = volume(chamber, table, shaft_angle + length)[0] - liquid * new_mass
    if void * last >= 0.0:
        return 0.2 * length
    bend = (last - void - rate * length) / (length * length)
    q = -0.5 * (rate + np.copysign(np.sqrt(rate * rate - 4.0 * bend * void), rate))
    way = void / q
    return way if 0.0 < way < length else q / bend


@numba.njit(f8(f8, f8, _matrix), cache=True, error_model="numpy")
def step_size(mass_error, work, stages):
    """Error of a step over the allowed one: that of the mass as given, those of the energies times `work`."""
    size = mass_error
    for k in (col.WORK, col.PATH_ENERGY + col.DELIVERY, col.PATH_ENERGY + col.SUCTION):
        slip = 0.0
        for stage in range(STAGES):
            slip += ERROR[stage] * stages[stage, k]
        size = max(size, abs(slip) * work)
    return size


@numba.njit(numba.void(f8, f8, _matrix, vector), cache=True, error_model="numpy")
def keep(angle, length, stages, out):
    """A step as a row of the trail."""
    out[BEGIN], out[LENGTH] = angle, length
    for stage in range(STAGES):
        for k in range(KEPT):
            out[STAGE + KEPT * stage + k] = stages[stage, PRESSURE + k]


@numba.njit(
    numba.types.Tuple((f8, numba.i8, numba.i8))(
        records, cubics, cubics, vector, f8, f8, vector, _matrix, _matrix, vector, _matrix
    ),
    cache=True,
    error_model="numpy",
)
def revolution(chamber, table, ports, nodes, pressure, tolerance, pressures, path_rates, passed, totals, trail):
    """One turn from a pressure at nodes[0]: mass at the end less that at the start, steps taken, status.

    Steps end on every node (ascending shaft angles over one turn, breaks of the ports among them). `pressures`,
    `path_rates` (mass per radian by path) and `passed` (mass by path since nodes[0]) receive the solution at nodes[1:],
    `totals` (2 x INTEGRALS) the integrals and the sums of their local error estimates, `trail` (any number, TRAIL) the
    first steps taken. Every step keeps the error of p, and of the work and throttling energy relative to one stroke's,
    below `tolerance` times the port pressure difference.
    """
    c = chamber[0]
    scale = tolerance * pressure_span(c.delivery_pressure, c.inlet_pressure)
    work_scale = scale * c.piston_area * 2.0 * c.stroke_scale
    stages, ways, flows = np.empty((STAGES, COLUMNS)), np.empty(WAYS), np.empty(PATHS)
    content, swell = volume(chamber, table, nodes[0])
    specific = oil_volume(pressure, oil_of(chamber))[0]
    openings(chamber, table, ports, nodes[0], ways)
    outflows(chamber, pressure, ways, flows)
    fill_stage(chamber, pressure, specific, swell, ways, flows, stages[0])
    for port in range(col.PORTS):
        stages[0, OPEN + port] = ways[col.AREA + port]
    begin = content / specific
    mass, slope = begin, 0.0
    totals[:] = 0.0
    taken, wish = 0, FIRST_STEP
    last_length, last_size = 0.0, 1.0
    for node in range(1, nodes.size):
        angle = nodes[node - 1]
        while angle < nodes[node]:
            length = min(wish, nodes[node] - angle)
            pressure = stages[0, PRESSURE]
            new_mass, error, fine = step(
                chamber, table, ports, angle, length, mass, slope, NEWTON_SHARE * scale, stages, ways, flows
            )
            size = step_size(c.bulk_modulus * abs(error) / new_mass / scale, length / work_scale, stages)
            crosses = (pressure < CAVITY_PRESSURE) != (stages[STAGES - 1, PRESSURE] < CAVITY_PRESSURE)
            if fine and crosses and length > CAVITY_STEP:
                way = to_cavity(chamber, table, angle, length, mass, new_mass, stages[0, LEFT])
                wish = max(min(way, 0.9 * length) - 0.5 * CAVITY_STEP, CAVITY_STEP)
                continue
            if not fine or size > 1.0:
                wish = length * (max(0.2, SAFETY * size**-0.25) if fine else 0.25)
                if wish < SMALLEST_STEP:
                    return mass - begin, taken, STEP_TOO_SMALL if fine else NO_STAGE
                continue
            for stage in range(STAGES):
                share, doubt = length * WEIGHTS[stage], length * ERROR[stage]
                for k in range(INTEGRALS):
                    totals[k] += share * stages[stage, k]
                    totals[INTEGRALS + k] += doubt * stages[stage, k]
            if taken < trail.shape[0]:
                keep(angle, length, stages, trail[taken])
            end = STAGES - 1
            slope = (stages[end, PRESSURE] - stages[end - 1, PRESSURE]) / ((NODES[end] - NODES[end - 1]) * length)
            for k in range(COLUMNS):
                stages[0, k] = stages[end, k]
            mass = new_mass
            taken += 1
            angle = nodes[node] if length >= nodes[node] - angle else angle + length
            size = max(size, 1e-4)
            grown = length * min(4.0, SAFETY * size**-0.25)
            if size > 1e-2 and taken > 1:
                grown = min(grown, SAFETY * length * size**-0.25 * (length / last_length) * (last_size / size) ** 0.25)
            last_length, last_size = length, size
            wish = max(wish, grown) if length < wish else grown
        pressures[node - 1] = stages[0, PRESSURE]
        for path in range(PATHS):
            path_rates[node - 1, path] = stages[0, col.OUTFLOW + path]
            passed[node - 1, path] = totals[col.OUTFLOW + path]
    return mass - begin, taken, OK
