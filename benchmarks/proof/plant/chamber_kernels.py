"""One chamber over a turn as a balance of mass: pressure from density, two implicit stages a step.

Alexander's SDIRK2 (1977), L-stable and stiffly accurate, so that a chamber wide open to its port settles in a
step; mass that leaves by each way is summed with the state's own weights, so that the turn closes to rounding.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from __future__ import annotations

import numpy as np
from numba import njit

GAMMA = 1.0 - 1.0 / np.sqrt(2.0)
ATMOSPHERE = 101325.0
VAPOUR = 3.0e3  # Pa absolute below which the oil cavitates
SOFTNESS = 2.0e3  # Pa by which a cavitating chamber's density falls by e
TURN = 2.0 * np.pi
MOST_TURNS = 60
CLOSED = 1.0e-8  # of the chamber's mass: largest difference between the end and the start of a turn
SUCTION, DELIVERY, PISTON, PLATE = 0, 1, 2, 3


@njit(cache=True, error_model="numpy")
def density(pressure, oil):
    """kg/m3 at Pa absolute; oil = (density, modulus, its rise with pressure, air share, pressure of solution).

    Murnaghan's law (exponential where the modulus does not rise); air follows a polytrope of 1.2 and, after Henry,
    decreases towards the pressure at which all is dissolved.
    """
    base, modulus, rise, air, dissolved = oil
    above = max(pressure, VAPOUR)
    if rise > 1e-9:
        liquid = base * (1.0 + rise * (above - ATMOSPHERE) / modulus) ** (1.0 / rise)
    else:
        liquid = base * np.exp((above - ATMOSPHERE) / modulus)
    if air > 0.0 and above < dissolved:
        free = air * (1.0 - above / dissolved) * (ATMOSPHERE / above) ** (1.0 / 1.2)
        liquid = 1.0 / (1.0 / liquid + free / base)
    return liquid * np.exp((pressure - above) / SOFTNESS)


@njit(cache=True, error_model="numpy")
def opening(angle, ports):
    """Area in m2 of a port at an angle from its dead centre; ports = (5 angles, groove, kidney, ..)."""
    turned = (angle + 0.5 * np.pi) % TURN - 0.5 * np.pi
    if turned <= ports[0] or turned >= ports[4]:
        return 0.0
    if turned < ports[1]:
        return ports[5] * ((turned - ports[0]) / (ports[1] - ports[0])) ** 2
    if turned < ports[2]:
        return ports[5] + (ports[6] - ports[5]) * (turned - ports[1]) / (ports[2] - ports[1])
    if turned <= ports[3]:
        return ports[6]
    return ports[6] * (ports[4] - turned) / (ports[4] - ports[3])


@njit(cache=True, error_model="numpy")
def through_port(pressure, outside, area, ports, viscosity, oil):
    """Mass flow out of the chamber, kg/s: an orifice, laminar at small Reynolds number. ports[7:9] = Cd, Re."""
    if area <= 0.0:
        return 0.0
    drop = pressure - outside
    upstream = density(max(pressure, outside), oil)
    width = np.sqrt(4.0 * area / np.pi)
    laminar = (ports[8] * viscosity / (ports[7] * width)) ** 2 / (2.0 * upstream)
    speed = ports[7] * np.sqrt(2.0 / upstream) * drop / (drop * drop + laminar * laminar) ** 0.25
    return upstream * area * speed


@njit(cache=True, error_model="numpy")
def at_table(table, top, pressure):
    """Linear in a table over 0 .. top Pa (above the case); antisymmetric below 0."""
    size = table.shape[0] - 1
    x = abs(pressure) / top * size
    left = min(int(x), size - 1)
    found = table[left] + (x - left) * (table[left + 1] - table[left])
    return found if pressure >= 0.0 else -found


@njit(cache=True, error_model="numpy")
def flows(pressure, angle, length, dragged, state, ports, tables, oil, found):
    """Fill `found` with the mass flows (kg/s) out of the chamber by its four ways."""
    case, inlet, outlet, viscosity, top = state
    found[SUCTION] = through_port(pressure, inlet, opening(angle, ports), ports, viscosity, oil)
    found[DELIVERY] = through_port(pressure, outlet, opening(angle - np.pi, ports), ports, viscosity, oil)
    above = pressure - case
    found[PISTON] = at_table(tables[0], top, above) / length + density(pressure, oil) * dragged
    found[PLATE] = at_table(tables[1], top, above)


@njit(cache=True, error_model="numpy")
def settle(start, held, step, volume, angle, length, dragged, state, ports, tables, oil, found):
    """Pressure at which density(p) volume + step sum(flows) = held: a stage, by Newton between closing bounds."""
    low, high, pressure = -1.0e6, 4.0e8, start
    for _ in range(60):
        flows(pressure, angle, length, dragged, state, ports, tables, oil, found)
        excess = density(pressure, oil) * volume + step * found.sum() - held
        if excess > 0.0:
            high = pressure
        else:
            low = pressure
        nudge = 1.0 + 1e-7 * abs(pressure)
        flows(pressure + nudge, angle, length, dragged, state, ports, tables, oil, found)
        slope = (density(pressure + nudge, oil) * volume + step * found.sum() - held - excess) / nudge
        following = pressure - excess / slope if slope > 0.0 else 0.5 * (low + high)
        if following <= low or following >= high:
            following = 0.5 * (low + high)
        if abs(following - pressure) < 1e-3 + 1e-10 * abs(pressure):
            pressure = following
            break
        pressure = following
    flows(pressure, angle, length, dragged, state, ports, tables, oil, found)
    return pressure


@njit(cache=True, error_model="numpy")
def turn(angle, course, speed, state, ports, tables, oil, pressures, out):
    """March turns until one closes: pressures (M,) at the ends of its steps, out (5,) kg by four ways, work in J.

    angle (M + 1,) from wide-open suction on, where the chamber begins at its port's pressure: it returns there after
    one turn, unless it did not fill. course (2 M + 1, 4): volume (m3), its slope (m3/rad), sealing length (m), dragged
    flow (m3/rad) at angle[0] and at the two stages of each step.
    """
    found = np.zeros(4)
    taken = density(state[1], oil) * (course[0, 1] - course[0, 3]) * speed
    pressure = settle(state[1], -taken, 1.0, 0.0, angle[0], course[0, 2], course[0, 3] * speed, state, ports,
                      tables, oil, found)  # fmt: skip
    mass = density(pressure, oil) * course[0, 0]
    for _ in range(MOST_TURNS):
        begun = mass
        pressure, mass = march(pressure, mass, angle, course, speed, state, ports, tables, oil, pressures, out)
        if abs(mass - begun) <= CLOSED * begun:
            return
    out[:] = np.nan


@njit(cache=True, error_model="numpy")
def march(pressure, mass, angle, course, speed, state, ports, tables, oil, pressures, out):
    """One turn from a pressure and a mass: those at its end; fills `pressures` and `out`."""
    first, second = np.zeros(4), np.zeros(4)
    out[:] = 0.0
    for k in range(pressures.shape[0]):
        h = angle[k + 1] - angle[k]
        share = GAMMA * h / speed
        one, two = course[2 * k + 1], course[2 * k + 2]
        within = angle[k] + GAMMA * h
        middle = settle(pressure, mass, share, one[0], within, one[2], one[3] * speed, state, ports, tables, oil,
                        first)  # fmt: skip
        rest = (1.0 - GAMMA) * h / speed
        left = mass - rest * first.sum()
        pressure = settle(middle, left, share, two[0], angle[k + 1], two[2], two[3] * speed, state, ports, tables,
                          oil, second)  # fmt: skip
        mass -= rest * first.sum() + share * second.sum()
        out[:4] += rest * first + share * second
        out[4] -= h * ((1.0 - GAMMA) * middle * one[1] + GAMMA * pressure * two[1])
        pressures[k] = pressure
    return pressure, mass


@njit(cache=True, error_model="numpy")
def turns(angle, courses, speeds, states, ports, tables, oil, pressures, out):
    """`turn` of each point and distinct piston: courses (N, P, 2 M + 1, 4), tables (N, P, 2, S), out (N, P, 5)."""
    for i in range(courses.shape[0]):
        for j in range(courses.shape[1]):
            turn(angle, courses[i, j], speeds[i], states[i], ports, tables[i, j], oil, pressures[i, j], out[i, j])
