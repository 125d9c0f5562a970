"""Compiled periodic revolutions of one chamber at many operating points, one after the other."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np

from system.pump.chamber.kernels import OK, TRAIL, revolution, slaved_pressure
from system.pump.chamber.layout import INTEGRALS, PATHS
from system.pump.chamber.problem import pressure_span
from system.pump.chamber.state_kernels import oil_change, oil_of
from system.pump.chamber.trail_kernels import NOT_PERIODIC, RUN_IN, follow_turn, sample

ROOM = 256
"""Steps of a turn with space at first; the space grows with more."""


@numba.njit(cache=True, error_model="numpy", nogil=True)
def chamber_map(constants, tables, ports, nodes, firsts, control, pressures, totals, statuses):
    """The periodic revolution of the chamber at each of P points: `cycle.solve_cycle`'s without its checks.

    constants (P,) of CHAMBER, tables (P, N, 7, 4), ports (P, M, 2, 4): the points' constants; nodes: their nodes end to
    end, those of point i from firsts[i] to firsts[i + 1]; control: tolerance, periodicity, turns. A point is periodic
    when `oil_change` over a turn is no more than `periodicity` times its port pressure difference, within `turns`.
    Filled: pressures (P, samples) Pa at equidistant angles from 0, totals (P, 2 INTEGRALS), statuses (P,). Returned:
    the steps of all points end to end, (T, TRAIL), and where each one's begin, (P + 1,).
    """
    trail, begins = np.empty((ROOM * constants.size, TRAIL)), np.zeros(constants.size + 1, np.int64)
    for point in range(constants.size):
        given = constants[point : point + 1], tables[point], ports[point]
        own = nodes[firsts[point] : firsts[point + 1]]
        begin, filled = begins[point], room(own.size - 1, totals[point])
        _, steps, _, _, statuses[point] = periodic(given, own, control, (*filled, trail[begin:]))
        if begin + steps > trail.shape[0]:
            trail = np.concatenate((trail[:begin], np.empty((2 * (begin + steps), TRAIL))))
            _, steps, _, _, statuses[point] = periodic(given, own, control, (*filled, trail[begin:]))
        begins[point + 1] = begin + steps
        if statuses[point] == OK:
            sample(trail[begin : begin + steps], pressures[point])
    return trail[: begins[-1]].copy(), begins


@numba.njit(cache=True, error_model="numpy")
def room(count, totals):
    """Arrays that `revolution` fills over so many nodes, without the trail."""
    return np.empty(count), np.empty((count, PATHS)), np.empty((count, PATHS)), totals


@numba.njit(cache=True, error_model="numpy", nogil=True)
def beside_map(constants, tables, ports, nodes, firsts, control, trail, begins, pressures, totals, statuses):
    """`chamber_map` of chambers that differ little from those whose `trail` and `begins` it has returned.

    They use those steps; points without convergence on them are solved by themselves. Returned: their number.
    """
    along, alone = np.empty((np.max(np.diff(begins)), TRAIL)), 0
    for point in range(constants.size):
        given = constants[point : point + 1], tables[point], ports[point]
        steps = trail[begins[point] : begins[point + 1]]
        limit = turn_limit(constants[point], control[1])
        own = totals[point, :INTEGRALS]
        statuses[point] = follow_turn(given, steps, control[0], limit, control[2], along, own)
        if statuses[point] == OK:
            sample(along[: steps.shape[0]], pressures[point])
        else:
            own_nodes = firsts[point : point + 2] - firsts[point]
            begin = nodes[firsts[point] : firsts[point + 1]]
            one = slice(point, point + 1)
            chamber_map(
                constants[one], tables[one], ports[one], begin, own_nodes, control, pressures[one], totals[one],
                statuses[one],
            )  # fmt: skip
            alone += 1
    return alone


@numba.njit(cache=True, error_model="numpy")
def turn_limit(chamber, periodicity):
    """`oil_change` over a turn (Pa) of one that is periodic."""
    return periodicity * pressure_span(chamber.delivery_pressure, chamber.inlet_pressure)


@numba.njit(cache=True, error_model="numpy")
def periodic(given, nodes, control, filled):
    """The periodic revolution of one chamber; `filled` are the last five arguments of `revolution`.

    control: tolerance, periodicity, turns. Returned: turns; of the last one its steps and its
    change of mass in m3; `oil_change` over it in Pa; status.
    """
    tolerance, periodicity, turns = control
    limit = turn_limit(given[0][0], periodicity)
    start = run_in(given, nodes, tolerance, filled[3])
    steps, drift, change = 0, 0.0, np.inf
    for turn in range(1, turns + 1):
        drift, steps, status = revolution(*given, nodes, start, tolerance, *filled)
        if status != OK:
            return turn, steps, drift, change, status
        end = filled[0][nodes.size - 2]
        change, start = oil_change(start, end, oil_of(given[0])), end
        if abs(change) <= limit:
            return turn, steps, drift, change, OK
    return turns, steps, drift, change, NOT_PERIODIC


@numba.njit(cache=True, error_model="numpy")
def run_in(given, nodes, tolerance, totals):
    """The pressure at nodes[0] set by an open port, independent of history; the inlet's without an open port."""
    begin = nodes[-1] - RUN_IN
    before = np.concatenate((np.array([begin]), nodes[nodes > begin])) - 2.0 * np.pi
    start, found = slaved_pressure(*given, before[0])
    if found:
        count = before.size - 1
        filled = room(count, totals)
        status = revolution(*given, before, start, tolerance, *filled, np.empty((0, TRAIL)))[2]
        if status == OK:
            return filled[0][count - 1]
    return given[0][0].inlet_pressure
