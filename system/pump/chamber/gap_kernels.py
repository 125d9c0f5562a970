"""Compiled difference of two chambers that differ in their gaps: linear in the pressure, along a solved one's steps.

    dM'/dphi = -(q' + k p')/(s w),   p' = M'/(dM/dp),   q' = q(p, other) - q(p, solved),   k = dq/dp of the other

by an implicit Euler step per step of the trail, stable where an open port is stiff. The gaps' additional outflow is the
mean over the step; the ports' own flows, which their viscosity changes, are those at its end.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np

from system.pump.chamber import layout as col
from system.pump.chamber.kernels import BEGIN, KEPT, LENGTH, STAGE, STAGES
from system.pump.chamber.layout import GAPS, INTEGRALS, PATHS, PORTS, WAYS
from system.pump.chamber.state_kernels import integral_rates, oil_of, oil_volume, outflows, volume, ways_out
from system.pump.chamber.trail_kernels import run_in_row

END = STAGE + KEPT * (STAGES - 1)
"""Column of the pressure at the end of a step of a trail."""
MEAN = np.full(INTEGRALS, 0.5)
MEAN[[col.OUTFLOW + port for port in range(PORTS)] + [col.PATH_ENERGY + port for port in range(PORTS)]] = 0.0
MEAN[col.PORT_ENERGY :] = 0.0
"""Weight of a step's beginning in the mean of each integral's rate: zero where it includes the ports' stiff flows."""


@numba.njit(cache=True, error_model="numpy", nogil=True)
def gaps_map(constants, tables, ports, others, other_tables, trail, begins, changes):
    """Fill changes (P, INTEGRALS): integrals of a turn of the other chambers less those of the solved ones.

    constants (P,), tables (P, N, 7, 4), ports, trail, begins: as given to and returned by `chamber_map`; others,
    other_tables: the same of chambers with these ports and this volume.
    """
    for point in range(constants.size):
        one = slice(point, point + 1)
        given = constants[one], tables[point], others[one], other_tables[point], ports[point]
        steps = trail[begins[point] : begins[point + 1]]
        start = turn_change(*given, steps[run_in_row(steps) :], 0.0, changes[point])
        turn_change(*given, steps, start, changes[point])


@numba.njit(cache=True, error_model="numpy")
def turn_change(chamber, table, other, other_table, ports, trail, mass, change):
    """Fill the change (INTEGRALS,) over the steps of a trail (T, TRAIL), from a change of mass in m3 at its beginning.

    Returned: the change of mass at its end. At the first step an open port determines the change of pressure, so that
    its end is used for its mean.
    """
    oil, speed = oil_of(chamber), chamber[0].shaft_speed
    ways, flows, own = np.empty(WAYS), np.empty(PATHS), np.empty(PATHS)
    before, after, rates = np.empty(INTEGRALS), np.empty(INTEGRALS), np.empty(INTEGRALS)
    leaked = 0.0
    change[:] = 0.0
    for row in range(trail.shape[0]):
        length, pressure = trail[row, LENGTH], trail[row, END]
        angle, areas = trail[row, BEGIN] + length, trail[row, END + 1 : END + KEPT]
        content, swell = volume(chamber, table, angle)
        specific, flowing, compressibility = oil_volume(pressure, oil)
        ways_out(chamber, table, ports, angle, areas[col.DELIVERY], areas[col.SUCTION], ways)
        outflows(chamber, pressure, ways, own)
        integral_rates(chamber, pressure, specific, swell, ways, own, before)
        ways_out(other, other_table, ports, angle, areas[col.DELIVERY], areas[col.SUCTION], ways)
        delivery, suction, slope = outflows(other, pressure, ways, flows)
        last, leaked, at_ports = leaked, 0.0, 0.0
        for port in range(PORTS):
            at_ports += flows[port] - own[port]
        for gap in range(PORTS, PATHS):
            leaked += flows[gap] - own[gap]
        lost = length * (0.5 * (leaked + (last if row else leaked)) + at_ports) / (flowing * speed)
        soft = content * compressibility / (specific * specific)
        moved = (mass - lost) / (soft + length * slope / (flowing * speed))
        mass = soft * moved
        flows[col.DELIVERY] += delivery * moved
        flows[col.SUCTION] += suction * moved
        for gap in range(GAPS):
            flows[col.FIRST_GAP + gap] += ways[col.CONDUCTANCE + gap] * moved
        integral_rates(other, pressure + moved, oil_volume(pressure + moved, oil)[0], swell, ways, flows, after)
        if row == 0:
            rates[:] = after - before
        for k in range(INTEGRALS):
            rate = after[k] - before[k]
            change[k] += length * (rate + MEAN[k] * (rates[k] - rate))
            rates[k] = rate
    return mass
