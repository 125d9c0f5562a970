"""Drive torque of a transient: pressure and inertia by virtual work on the shaft, friction by the nominal losses.

    T w = sum [m A . dX/dphi w - Ap (p - p_case) s_phi w - q_drag (p - p_case)] + losses of the pairs

over the chambers; X the ball's place, A its acceleration, q_drag the drag flow of the piston through its gap.
Losses are those of `system.pump.lumped` at each instant's tilt, sliding and pressure.
"""

from collections.abc import Iterator

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.units import TURN
from system.multibody.kinematics import SHAFT, Plate, axial_rates, ball_motion, bore_axes, cross, dot
from system.multibody.transient import kernels as kernel
from system.multibody.transient.setup import bore_circle, inner_place
from system.multibody.transient.solver import Transient
from system.pump.laws.friction_pairs import FrictionPairs, Pair
from system.pump.laws.kinematics import SwashDrive
from system.pump.laws.leakage import piston_drag_flow
from system.pump.lumped import PistonMotion, Pressures, lumped_pairs, piston_area
from system.pump.operating import columns

INSTANTS = 1000  # at once, so that long courses fit in memory


def drive_torque(found: Transient) -> Array:
    """Torque (N,) N m of the shaft over the course."""
    return np.concatenate([_torque(found, part) for part in _parts(found.time.size)])


def _parts(count: int) -> Iterator[slice]:
    return (slice(start, start + INSTANTS) for start in range(0, count, INSTANTS))


def _torque(found: Transient, part: slice) -> Array:
    pump, point, circle = found.case.pump, found.case.point, bore_circle(found.case.pump, found.mechanism)
    speed, pistons = point.shaft_speed, pump.pump.pistons
    rows, pressure = found.rows[part], found.pressure[part]
    shape = pressure.shape
    angle = found.shaft_angle[part, None] + TURN * np.arange(pistons) / pistons
    tilt = Plate(*(np.repeat(rows[:, k], pistons) for k in (kernel.ANGLE, kernel.RATE, kernel.ACCELERATION)))
    flat = angle.ravel()
    rates, ball = axial_rates(circle, tilt, flat), ball_motion(circle, tilt, flat, speed)
    mass, area = pump.piston.mass + pump.slipper.mass, piston_area(pump)
    turning = rates.phi * bore_axes(circle.cone, flat) + cross(SHAFT, ball.place)
    inertia = mass * dot(ball.acceleration, turning).reshape(shape)
    above = pressure - point.case_pressure
    clearance, diameter = pump.piston.radial_clearance, pump.pump.piston_diameter
    dragged = piston_drag_flow(diameter, clearance, ball.way.reshape(shape)) * above
    pushed = inertia - area * above * rates.phi.reshape(shape) - dragged / speed
    normal = np.stack([np.sin(tilt.angle), -np.tan(circle.cross) * np.cos(tilt.angle), np.cos(tilt.angle)])
    sliding = cross(ball.velocity, normal / np.sqrt(dot(normal, normal)))
    out = rates.place.reshape(shape) - inner_place(pump, found.mechanism)
    whole = np.hypot(np.tan(rows[:, kernel.ANGLE]), np.tan(circle.cross))
    motion: PistonMotion[Array] = PistonMotion(
        SwashDrive(circle.pitch_radius, circle.cone, np.arctan(whole)[:, None]),
        angle,
        ball.way.reshape(shape),
        dot(ball.acceleration, ball.axis).reshape(shape),
        np.linalg.norm(sliding, axis=0).reshape(shape),
        pump.piston.engaged_length - out,
        pump.piston.overhang + out,
    )
    losses = lumped_pairs(pump, columns(point), motion, Pressures(pressure))
    return np.asarray(pushed.sum(axis=1) + _power(losses) / speed)


def _power(losses: FrictionPairs[Array]) -> Array:
    """All losses (M,) W at each instant."""
    total = np.zeros(losses.piston_cylinder.coulomb.shape[0])
    for pair in Pair:
        own = losses.loss(pair)
        each = own.coulomb + own.viscous
        total += each.sum(axis=1) if own.count > 1 else each[:, 0]
    return total
