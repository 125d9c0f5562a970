"""Compiled periodic revolutions of one chamber at many operating points, one after the other."""

from __future__ import annotations

import numba
import numpy as np

from system.chamber_kernel import OK, revolution, slaved_pressure
from system.chamber_state_kernels import PATHS

NOT_PERIODIC = 3
"""Status beside those of `chamber_kernel`."""
RUN_IN_NODES = 6


@numba.njit(cache=True, error_model="numpy")
def chamber_map(
    chambers, tables, ports, nodes, firsts, wheres, tolerance, periodicity, turns, pressures, totals, statuses
):
    """The periodic revolution of the chamber at each of P points: `chamber.solve_cycle`'s without its checks.

    chambers (P,) of CHAMBER, tables (P, N, 7, 4), ports (P, M, 2, 4): the points' constants; nodes: their nodes
    end to end, those of point i from firsts[i] to firsts[i + 1]; wheres (P, samples): where in nodes[1:] the
    samples lie. A point is periodic when its pressure changes over a turn by no more than `periodicity` times
    its port pressure difference, within `turns`. Filled: pressures (P, samples) Pa, totals (P, 2 INTEGRALS),
    statuses (P,).
    """
    longest = 0
    for point in range(chambers.size):
        longest = max(longest, firsts[point + 1] - firsts[point])
    course, rates, passed = np.empty(longest), np.empty((longest, PATHS)), np.empty((longest, PATHS))
    for point in range(chambers.size):
        own = nodes[firsts[point] : firsts[point + 1]]
        count = own.size - 1
        given = chambers[point : point + 1], tables[point], ports[point]
        filled = course[:count], rates[:count], passed[:count], totals[point]
        limit = periodicity * (abs(chambers[point].delivery_pressure - chambers[point].inlet_pressure) + 1e5)
        start = run_in(given, own, tolerance, totals[point])
        statuses[point] = NOT_PERIODIC
        for _ in range(turns):
            status = revolution(*given, own, start, tolerance, *filled)[3]
            if status != OK:
                statuses[point] = status
                break
            change = course[count - 1] - start
            start = course[count - 1]
            if abs(change) <= limit:
                statuses[point] = OK
                break
        for sample in range(wheres.shape[1]):
            pressures[point, sample] = course[wheres[point, sample]]


@numba.njit(cache=True, error_model="numpy")
def run_in(given, nodes, tolerance, totals):
    """A pressure at nodes[0] that an open port has already made its own; the inlet's where there is none."""
    before = nodes[-RUN_IN_NODES:] - 2.0 * np.pi
    start, found = slaved_pressure(*given, before[0])
    if found:
        pressures, rates, passed = (
            np.empty(RUN_IN_NODES),
            np.empty((RUN_IN_NODES, PATHS)),
            np.empty((RUN_IN_NODES, PATHS)),
        )
        filled = pressures[: RUN_IN_NODES - 1], rates[: RUN_IN_NODES - 1], passed[: RUN_IN_NODES - 1]
        status = revolution(*given, before, start, tolerance, *filled, totals)[3]
        if status == OK:
            return pressures[RUN_IN_NODES - 2]
    return given[0][0].inlet_pressure
