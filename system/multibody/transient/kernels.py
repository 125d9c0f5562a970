"""Compiled solution of a pump whose swash plate swings: chambers, actuator and plate over equal steps of shaft
angle.

Chambers and actuator conserve the mass of their oil as the chamber kernels do, by their implicit method of order 4;
over a step the plate is known to second order, g + g' t + g'' t^2/2. The plate follows virtual work on its tilt,

    (I + m sum s_g^2) g'' = sum s_g [A (p - p_case) + f - m (s_phiphi w^2 + 2 s_phig w g' + s_gg g'^2
                            - w^2 sin b (R + s sin b))] + M_actuator - M_spring - c g' - M_t g'/(g'^2 + r^2)^(1/2)

by velocity Verlet, order 2. f is the friction of a piston in its bore. Stops are plastic: while the moment presses
the plate on one, it rests, and the moment on the stop is reported.

Effects of [physics] come as a table over a piston's own angle, (ACTING, M) at M equidistant angles from 0: factors on
the conductances of the gaps, on Coulomb friction and shear of the piston, and its additional friction in W. The plate
under the pistons may tilt less than the plate at its actuator, by a droop (rad) that changes evenly over a step.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np

from system.multibody.plate_kernels import axial
from system.pump.chamber import layout as col
from system.pump.chamber.kernels import GAMMA, LEFT, NODES, STAGES, TABLEAU, WEIGHTS, fill_stage, stage_pressure
from system.pump.chamber.layout import INTEGRALS, PATHS, WAYS
from system.pump.chamber.state_kernels import oil_energy, oil_of, oil_volume, outflows, port_ways
from system.pump.ports.areas import orifice_coefficients, section_area

PLATE = np.dtype(
    [
        ("pistons", "i8"),
        ("pitch_radius", "f8"),
        ("cone", "f8"),
        ("cross", "f8"),
        ("pivot_offset", "f8"),
        ("inner_place", "f8"),
        ("angle_min", "f8"),
        ("angle_max", "f8"),
        ("inertia", "f8"),
        ("damping", "f8"),
        ("rubbing", "f8"),
        ("rubbing_rate", "f8"),
        ("mass", "f8"),
        ("engaged_length", "f8"),
        ("overhang", "f8"),
        ("friction", "f8"),
        ("shear", "f8"),
        ("slide", "f8"),
        ("piston_leak", "f8"),
        ("slipper_leak", "f8"),
        ("ring_leak", "f8"),
        ("drag_area", "f8"),
        ("sense", "f8"),
        ("arm", "f8"),
        ("actuator_area", "f8"),
        ("actuator_volume", "f8"),
        ("actuator_orifice", "f8"),
        ("actuator_leak", "f8"),
        ("spring_rate", "f8"),
        ("spring_force", "f8"),
    ],
    align=True,
)
"""Constants of plate, actuator and pistons, SI, as the compiled code reads them.

Leaks: piston times engaged length m4/(s Pa), slipper and ring m3/(s Pa); drag_area m2 (drag flow per velocity);
shear of a piston N s/m2; slide m/s, below which friction fades; inner_place m, of the inner dead centre at the
largest angle; rubbing N m of the trunnion, fading below rubbing_rate rad/s; sense 1 for an actuator that strokes
the plate up, -1 down.
"""

ATTEMPTS = 10
"""Newton's method may oscillate about a narrow port's laminar range and converge slowly: an attempt starts at the last
iterate of the one before."""
COLUMNS = 18
TIME, ANGLE, RATE, ACCELERATION, CONTROL, ACTUATOR, MOMENT_PRESSURE, MOMENT_INERTIA = range(8)
MOMENT_FRICTION, MOMENT_ACTUATOR, MOMENT_SPRING, MOMENT_DRAG, MOMENT_STOP, DELIVERY, SUCTION, CASE = range(8, 16)
DROOP, DROOP_RATE = range(16, 18)
"""Columns of the course: s, rad, rad/s, rad/s2, Pa, Pa, N m; the flows out of the chambers over the step that ends
there, m3/s at zero gauge pressure; the droop, rad, and its rate over that step, rad/s."""
ACTING = 6
COULOMB, VISCOUS, ADDED = 3, 4, 5
"""Rows of the effects behind those of the conductances."""
FROM, TO, STEP, DROOPED, DROOPS = range(5)
"""Inputs of a step: control pressure at begin and end Pa, its length s, droop at its begin rad, rad/s."""


@numba.njit(cache=True, error_model="numpy")
def tilt_at(plate, tilt, time):
    """Angle and rate at a time (s) into a step, between the stops; tilt (3,) at its begin."""
    p = plate[0]
    angle = tilt[0] + time * (tilt[1] + 0.5 * time * tilt[2])
    if angle > p.angle_max:
        return p.angle_max, 0.0
    if angle < p.angle_min:
        return p.angle_min, 0.0
    return angle, tilt[1] + time * tilt[2]


@numba.njit(cache=True, error_model="numpy")
def acting_at(acting, row, shaft_angle):
    """A row of the effects at a piston's own angle (rad), linear between the table's angles."""
    count = acting.shape[1]
    place = shaft_angle / (2.0 * np.pi) * count
    cell = np.floor(place)
    share, k = place - cell, int(cell) % count
    return acting[row, k] + share * (acting[row, (k + 1) % count] - acting[row, k])


@numba.njit(cache=True, error_model="numpy")
def piston_at(chamber, plate, acting, shaft_angle, angle, rate, ways):
    """Content (m3) of a chamber and its growth (m3/rad) under a plate; fills ways as `openings` of the chamber does."""
    c, p = chamber[0], plate[0]
    place, by_phi, by_g, _, _, _ = axial(shaft_angle, angle, p.pitch_radius, p.cone, p.cross, p.pivot_offset)
    out = place - p.inner_place
    way = by_phi + by_g * rate / c.shaft_speed
    ways[col.CONDUCTANCE] = p.piston_leak / (p.engaged_length - out)
    ways[col.CONDUCTANCE + 1], ways[col.CONDUCTANCE + 2] = p.slipper_leak, p.ring_leak
    for gap in range(col.GAPS):
        ways[col.CONDUCTANCE + gap] *= acting_at(acting, gap, shaft_angle)
    ways[col.DRAG_FLOW] = p.drag_area * way * c.shaft_speed
    ways[col.DRAG_FLOW + 1], ways[col.DRAG_FLOW + 2] = 0.0, 0.0
    ports = section_area(shaft_angle, c.delivery_port), section_area(shaft_angle, c.suction_port)
    port_ways(chamber, ports[0], ports[1], ways)
    ways[col.BEHIND], ways[col.BEHIND + 1] = c.delivery_pressure, c.inlet_pressure
    return c.dead_volume + c.piston_area * out, c.piston_area * way


@numba.njit(cache=True, error_model="numpy")
def actuator_reach(plate, angle):
    """Way (m) of the actuator's piston from its innermost place."""
    p = plate[0]
    if p.sense > 0.0:
        return p.arm * (np.sin(angle) - np.sin(p.angle_min))
    return p.arm * (np.sin(p.angle_max) - np.sin(angle))


@numba.njit(cache=True, error_model="numpy")
def actuator_at(chamber, plate, angle, rate, control, ways):
    """The same of the actuator: its orifice replaces the delivery port, its leak the piston's."""
    c, p = chamber[0], plate[0]
    ways[:] = 0.0
    ways[col.CONDUCTANCE] = p.actuator_leak
    law = (c.flow_coefficient, c.density, c.kinematic_viscosity, c.critical_reynolds)
    ways[col.ORIFICE], ways[col.ORIFICE + 1] = orifice_coefficients(p.actuator_orifice, *law)
    ways[col.ORIFICE + 3] = 1.0
    ways[col.BEHIND], ways[col.BEHIND + 1] = control, c.case_pressure
    swept = p.sense * p.actuator_area * p.arm * np.cos(angle) * rate
    return p.actuator_volume + p.actuator_area * actuator_reach(plate, angle), swept / c.shaft_speed


@numba.njit(cache=True, error_model="numpy")
def content_at(chamber, plate, acting, which, shaft_angle, tilt, time, imposed, ways):
    """Content and growth of compartment `which` at a time into a step: a chamber, or the actuator after them
    all."""
    angle, rate = tilt_at(plate, tilt, time)
    if which == plate[0].pistons:
        control = imposed[FROM] + time / imposed[STEP] * (imposed[TO] - imposed[FROM])
        return actuator_at(chamber, plate, angle, rate, control, ways)
    own = shaft_angle + time * chamber[0].shaft_speed + 2.0 * np.pi * which / plate[0].pistons
    angle -= imposed[DROOPED] + time * imposed[DROOPS]
    return piston_at(chamber, plate, acting, own, angle, rate - imposed[DROOPS], ways)


@numba.njit(cache=True, error_model="numpy")
def advance(chamber, plate, acting, which, shaft_angle, tilt, imposed, state, stages, totals):
    """One step of a compartment's oil: state (2,) mass m3 and pressure Pa; False where a stage has no pressure.

    stages as `step` of the chamber has them; `integral_rates` adds to totals (INTEGRALS,).
    """
    length = imposed[STEP] * chamber[0].shaft_speed
    ways, flows = np.empty(WAYS), np.empty(PATHS)
    _, swell = content_at(chamber, plate, acting, which, shaft_angle, tilt, 0.0, imposed, ways)
    pressure = state[1]
    outflows(chamber, pressure, ways, flows)
    fill_stage(chamber, pressure, oil_volume(pressure, oil_of(chamber))[0], swell, ways, flows, stages[0])
    for stage in range(1, STAGES):
        time = NODES[stage] * imposed[STEP]
        content, swell = content_at(chamber, plate, acting, which, shaft_angle, tilt, time, imposed, ways)
        base = state[0]
        for earlier in range(stage):
            base -= length * TABLEAU[stage, earlier] * stages[earlier, LEFT]
        for _ in range(ATTEMPTS):
            pressure, specific, _s, found = stage_pressure(
                chamber, pressure, content, base, GAMMA * imposed[STEP], 0.0, ways, flows
            )
            if found:
                break
        if not found:
            return False
        fill_stage(chamber, pressure, specific, swell, ways, flows, stages[stage])
    for stage in range(STAGES):
        state[0] -= length * WEIGHTS[stage] * stages[stage, LEFT]
        for one in range(INTEGRALS):
            totals[one] += length * WEIGHTS[stage] * stages[stage, one]
    state[1] = pressure
    return True


@numba.njit(cache=True, error_model="numpy")
def moments(chamber, plate, acting, shaft_angle, angle, rate, states, row):
    """Fill the row's moments (N m) on the plate; return their sum and the inertia they accelerate (kg m2)."""
    c, p = chamber[0], plate[0]
    speed, out = c.shaft_speed, np.sin(p.cone)
    under, swings = angle - row[DROOP], rate - row[DROOP_RATE]
    lean = np.sqrt(np.tan(under) ** 2 + np.tan(p.cross) ** 2)
    row[MOMENT_PRESSURE : MOMENT_STOP + 1] = 0.0
    turned = p.inertia
    for k in range(p.pistons):
        own = shaft_angle + 2.0 * np.pi * k / p.pistons
        place, by_phi, by_g, by_phi_phi, by_phi_g, by_g_g = axial(
            own, under, p.pitch_radius, p.cone, p.cross, p.pivot_offset
        )
        gain = by_phi_phi * speed**2 + 2.0 * by_phi_g * speed * swings + by_g_g * swings**2
        gain -= speed**2 * out * (p.pitch_radius + place * out)
        push = c.piston_area * (states[k, 1] - c.case_pressure)
        moved = place - p.inner_place
        engaged, way = p.engaged_length - moved, by_phi * speed + by_g * swings
        lever = 1.0 + 2.0 * (p.overhang + moved) / engaged
        sliding = np.sqrt(way**2 + p.slide**2)
        drag = p.friction * acting_at(acting, COULOMB, own) * abs(push - p.mass * gain) * lean * lever / sliding
        drag += acting_at(acting, ADDED, own) / sliding**2 + p.shear * acting_at(acting, VISCOUS, own) * engaged
        row[MOMENT_PRESSURE] += by_g * push
        row[MOMENT_INERTIA] -= by_g * p.mass * gain
        row[MOMENT_FRICTION] -= by_g * drag * way
        turned += p.mass * by_g**2
    lever, reach = p.sense * p.arm * np.cos(angle), actuator_reach(plate, angle)
    row[MOMENT_ACTUATOR] = lever * p.actuator_area * (states[p.pistons, 1] - c.case_pressure)
    row[MOMENT_SPRING] = -lever * (p.spring_force + p.spring_rate * reach)
    row[MOMENT_DRAG] = -p.damping * rate - p.rubbing * rate / np.sqrt(rate**2 + p.rubbing_rate**2)
    return np.sum(row[MOMENT_PRESSURE:MOMENT_STOP]), turned


@numba.njit(cache=True, error_model="numpy")
def resting(plate, angle, moment):
    """True if a moment presses the plate on a stop that it touches."""
    p = plate[0]
    return (angle >= p.angle_max and moment > 0.0) or (angle <= p.angle_min and moment < 0.0)


@numba.njit(cache=True, error_model="numpy")
def swing(chamber, plate, acting, shaft_angle, tilt, step, states, row):
    """Move the plate over a step (s) of Verlet's rule; tilt (3,) is that of its end, the row filled.

    Returns the loss of momentum at a stop, kg m2/s.
    """
    p = plate[0]
    angle = tilt[0] + step * (tilt[1] + 0.5 * step * tilt[2])
    met = min(max(angle, p.angle_min), p.angle_max)
    rate = tilt[1] + step * tilt[2]
    struck = met != angle
    moment, turned = moments(chamber, plate, acting, shaft_angle, met, 0.0 if struck else rate, states, row)
    taken, gain = 0.0, moment / turned
    if struck:
        taken, rate = turned * rate, 0.0
    else:
        rate = tilt[1] + 0.5 * step * (tilt[2] + gain)
    if resting(plate, met, moment):
        row[MOMENT_STOP] = -moment
        rate, gain = 0.0, 0.0
    tilt[0], tilt[1], tilt[2] = met, rate, gain
    return taken


@numba.njit(cache=True, error_model="numpy")
def contents(chamber, states):
    """Oil in compartments, m3 at zero gauge pressure, and its elastic energy, J: M (h - p s)."""
    found = np.zeros(2)
    for k in range(states.shape[0]):
        pressure, oil = states[k, 1], oil_of(chamber)
        specific, liquid, _ = oil_volume(pressure, oil)
        found[0] += states[k, 0]
        found[1] += states[k, 0] * (oil_energy(pressure, specific, liquid, oil) - pressure * specific)
    return found


@numba.njit(cache=True, error_model="numpy")
def let_go(chamber, plate, acting, shaft_angle, tilt, states, row, free):
    """Fill the row of a plate that is held; tilt (3,) gets no rate and, if it is `free` now, its acceleration."""
    moment, turned = moments(chamber, plate, acting, shaft_angle, tilt[0], 0.0, states, row)
    tilt[1] = 0.0
    tilt[2] = moment / turned if free and not resting(plate, tilt[0], moment) else 0.0
    row[MOMENT_STOP] = 0.0 if tilt[2] else -moment


@numba.njit(cache=True, error_model="numpy")
def pass_step(chambers, plate, acting, shaft_angle, tilt, imposed, states, stages, totals):
    """Advance all oil over a step, totals (INTEGRALS,) with the chambers'; False where a stage has no pressure."""
    pistons, aside = plate[0].pistons, np.zeros(INTEGRALS)
    for k in range(pistons):
        if not advance(chambers[:1], plate, acting, k, shaft_angle, tilt, imposed, states[k], stages, totals):
            return False
    return advance(chambers[1:], plate, acting, pistons, shaft_angle, tilt, imposed, states[pistons], stages, aside)


@numba.njit(cache=True, error_model="numpy")
def place(chambers, plate, acting, at, tilt, states, row, pressures):
    """Fill the row of an instant and its pressures (z,); return the momentum absorbed by a stop, kg m2/s.

    at: number of the instant, of that at which the plate is released, and the step (s).
    """
    number, free, step = at
    chamber, pistons, taken = chambers[:1], plate[0].pistons, 0.0
    angle = (number - free) * step * chamber[0].shaft_speed
    if number <= free:
        let_go(chamber, plate, acting, angle, tilt, states, row, number == free)
    else:
        taken = swing(chamber, plate, acting, angle, tilt, step, states, row)
    row[TIME], row[ANGLE], row[RATE], row[ACCELERATION] = (number - free) * step, tilt[0], tilt[1], tilt[2]
    row[ACTUATOR] = states[pistons, 1]
    pressures[:] = states[:pistons, 1]
    return taken


@numba.njit(cache=True, error_model="numpy")
def course(chambers, plate, acting, begin, end, held, step, controls, tilt, states, rows, pressures, impulses, totals):
    """Fill rows (N + 1, COLUMNS) and pressures (N + 1, z) behind row `begin` up to row `end`; 0, or a failed step.

    tilt and states (z + 1, 2) go along. chambers (2,): records of the pump's and of the actuator's oil. The plate is
    held for the first `held` steps. controls (N, 2): pressure before the actuator's orifice at begin and end of each
    step; the rows bring their droop. impulses (N,) N m s on stops; totals (INTEGRALS,) of all chambers.
    """
    stages, imposed, one = np.empty((STAGES, INTEGRALS + 2)), np.empty(5), np.empty(INTEGRALS)
    totals[:] = 0.0
    for n in range(begin, end):
        angle = (n - held) * step * chambers[0].shaft_speed
        after = rows[n + 1]
        imposed[FROM], imposed[TO], imposed[STEP] = controls[n, 0], controls[n, 1], step
        imposed[DROOPED], imposed[DROOPS] = rows[n, DROOP], after[DROOP_RATE]
        rows[n, CONTROL], after[CONTROL] = controls[n, 0], controls[n, 1]
        one[:] = 0.0
        if not pass_step(chambers, plate, acting, angle, tilt, imposed, states, stages, one):
            return n + 1
        totals += one
        after[DELIVERY], after[SUCTION] = one[col.OUTFLOW] / step, one[col.OUTFLOW + 1] / step
        after[CASE] = (one[col.PISTON] + one[col.SLIPPER] + one[col.VALVE_PLATE]) / step
        impulses[n] = place(chambers, plate, acting, (n + 1, held, step), tilt, states, after, pressures[n + 1])
    return 0
