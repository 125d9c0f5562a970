"""Compiled use of the steps that a revolution has taken: the pressure between their ends, and chambers beside.

A chamber that differs little from a solved one uses its steps: none is refused, the ports' areas are known, and every
stage has a good first guess of its pressure. The change is a difference at equal steps, in which their errors cancel
(internal numerical differentiation; Bock 1981, Springer Series in Chemical Physics 18, p. 102).
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np

from system.pump.chamber import layout as col
from system.pump.chamber.kernels import (
    BEGIN,
    COLUMNS,
    ERROR,
    GAMMA,
    KEPT,
    LEFT,
    LENGTH,
    NEWTON_SHARE,
    NO_STAGE,
    NODES,
    OK,
    PRESSURE,
    STAGE,
    STAGES,
    TABLEAU,
    WEIGHTS,
    fill_stage,
    stage_pressure,
    step_size,
)
from system.pump.chamber.layout import INTEGRALS, PATHS, WAYS
from system.pump.chamber.problem import pressure_span
from system.pump.chamber.state_kernels import oil_change, oil_of, oil_volume, outflows, volume, ways_out

NOT_PERIODIC, TOO_ROUGH = 3, 4
"""Statuses beside those of `kernels`."""
RUN_IN = np.pi / 9.0
"""Angle (rad) after which the pressure is set by an open port, independent of history."""
ROUGH = 4.0
"""Error of a step on another chamber's steps, over the allowed one: a few such have no visible effect on a turn."""
BETWEEN = np.array([0, 2, 3, 4, 5])
"""Stages that the pressure within a step runs through; the second is less exact."""


@numba.njit(cache=True, error_model="numpy")
def sample(trail, pressures):
    """Fill the pressures at equidistant angles from 0, by the stages' pressures of a turn (T, TRAIL)."""
    samples = pressures.size
    spacing = 2.0 * np.pi / samples
    first = round(trail[0, BEGIN] / spacing)
    row = 0
    for number in range(1, samples + 1):
        angle = (first + number) * spacing
        while row < trail.shape[0] - 1 and angle > trail[row, BEGIN] + trail[row, LENGTH] * (1.0 + 1e-9):
            row += 1
        share = (angle - trail[row, BEGIN]) / trail[row, LENGTH]
        pressures[(first + number) % samples] = within(trail[row], share)


@numba.njit(cache=True, error_model="numpy")
def within(step, share):
    """Pressure at a share of the way through a step: the polynomial through the stages in BETWEEN."""
    pressure = 0.0
    for one in BETWEEN:
        weight = 1.0
        for other in BETWEEN:
            if other != one:
                weight *= (share - NODES[other]) / (NODES[one] - NODES[other])
        pressure += weight * step[STAGE + KEPT * one]
    return pressure


@numba.njit(cache=True, error_model="numpy")
def follow(chamber, table, ports, trail, pressure, tolerance, along, totals):
    """The steps of a trail (T, TRAIL) from a pressure at their beginning: pressure at the end, status.

    Filled: `along` (T, TRAIL), the steps of this chamber, and totals (INTEGRALS,).
    """
    c = chamber[0]
    scale = tolerance * pressure_span(c.delivery_pressure, c.inlet_pressure)
    work_scale = scale * c.piston_area * 2.0 * c.stroke_scale
    stages, ways, flows = np.empty((STAGES, COLUMNS)), np.empty(WAYS), np.empty(PATHS)
    begin, first = trail[0, BEGIN], trail[0, STAGE + 1 : STAGE + KEPT]
    content, swell = volume(chamber, table, begin)
    specific = oil_volume(pressure, oil_of(chamber))[0]
    ways_out(chamber, table, ports, begin, first[col.DELIVERY], first[col.SUCTION], ways)
    outflows(chamber, pressure, ways, flows)
    fill_stage(chamber, pressure, specific, swell, ways, flows, stages[0])
    mass = content / specific
    totals[:] = 0.0
    for row in range(trail.shape[0]):
        length = trail[row, LENGTH]
        mass, error, fine = step_along(
            chamber, table, ports, trail[row], mass, NEWTON_SHARE * scale, stages, ways, flows
        )
        if not fine:
            return stages[0, PRESSURE], NO_STAGE
        if step_size(c.bulk_modulus * abs(error) / mass / scale, length / work_scale, stages) > ROUGH:
            return stages[0, PRESSURE], TOO_ROUGH
        along[row, :STAGE] = trail[row, :STAGE]
        for stage in range(STAGES):
            share = length * WEIGHTS[stage]
            along[row, STAGE + KEPT * stage] = stages[stage, PRESSURE]
            for k in range(INTEGRALS):
                totals[k] += share * stages[stage, k]
        stages[0] = stages[STAGES - 1]
    return stages[0, PRESSURE], OK


@numba.njit(cache=True, error_model="numpy")
def run_in_row(trail):
    """First row of a trail (T, TRAIL) of those over its last RUN_IN."""
    row = trail.shape[0] - 1
    while row > 0 and trail[row, BEGIN] > trail[-1, BEGIN] + trail[-1, LENGTH] - RUN_IN:
        row -= 1
    return row


@numba.njit(cache=True, error_model="numpy")
def follow_turn(given, trail, tolerance, limit, turns, along, totals):
    """The periodic turn of a chamber beside that whose turn `trail` is, as `follow`: its status.

    Periodic when `oil_change` over it is no more than `limit`; the first is run in at the end of the other's.
    """
    last = run_in_row(trail)
    start, status = follow(*given, trail[last:], trail[last, STAGE], tolerance, along, totals)
    for _ in range(turns):
        if status != OK:
            return status
        end, status = follow(*given, trail, start, tolerance, along, totals)
        change, start = oil_change(start, end, oil_of(given[0])), end
        if abs(change) <= limit:
            return status
    return NOT_PERIODIC


@numba.njit(cache=True, error_model="numpy")
def step_along(chamber, table, ports, kept, mass, close, stages, ways, flows):
    """`kernels.step` with the ports' areas and the first guesses of another chamber's step."""
    angle, length = kept[BEGIN], kept[LENGTH]
    weight = GAMMA * length / chamber[0].shaft_speed
    stiffness = 0.0
    for stage in range(1, STAGES):
        at = angle + NODES[stage] * length
        content, swell = volume(chamber, table, at)
        own = STAGE + KEPT * stage
        areas = kept[own + 1 : own + KEPT]
        ways_out(chamber, table, ports, at, areas[col.DELIVERY], areas[col.SUCTION], ways)
        base = 0.0
        for earlier in range(stage):
            base += TABLEAU[stage, earlier] * stages[earlier, LEFT]
        guess = kept[own] + stages[stage - 1, PRESSURE] - kept[own - KEPT]
        pressure, specific, stiffness, found = stage_pressure(
            chamber, guess, content, mass - length * base, weight, close, ways, flows
        )
        if not found:
            return mass, 0.0, False
        fill_stage(chamber, pressure, specific, swell, ways, flows, stages[stage])
    out, error = 0.0, 0.0
    for stage in range(STAGES):
        out += WEIGHTS[stage] * stages[stage, LEFT]
        error -= ERROR[stage] * stages[stage, LEFT]
    return mass - length * out, length * error / (1.0 + stiffness), True
