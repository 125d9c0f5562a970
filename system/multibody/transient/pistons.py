"""All pistons of a pump at instants of a transient: motion, pressure, and their torque.

Arrays (T, z) over T instants and z chambers, chamber k at shaft angle + (k - 1) pitch.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.multibody.kinematics import SHAFT, Plate, axial_rates, ball_motion, bore_axes, cross, dot
from system.multibody.plate_motion import Mechanism
from system.multibody.transient import kernels as kernel
from system.multibody.transient.setup import bore_circle, inner_place
from system.pump.laws.kinematics import SwashDrive, stroke
from system.pump.lumped import PistonMotion, full_drive
from system.pump.operating import OperatingPoint


@dataclass(frozen=True)
class Group:
    """A pump at its point with its mechanism: shaft speed, port pressures and temperature are constant."""

    pump: PumpDescription
    point: OperatingPoint
    parts: Mechanism


@dataclass(frozen=True)
class Instants:
    """T instants: shaft_angle (T,) rad, rows (T, COLUMNS) of the course, pressure (T, z) Pa."""

    shaft_angle: Array
    rows: Array
    pressure: Array

    @property
    def own_angle(self) -> Array:
        """Angle (T, z) rad of each chamber from the plate's own inner dead centre."""
        pistons = self.pressure.shape[1]
        return np.asarray(self.shaft_angle[:, None] + TURN * np.arange(pistons) / pistons)

    @property
    def tilt(self) -> Array:
        """Angle (T,) rad of the plate under the pistons."""
        return np.asarray(self.rows[:, kernel.ANGLE] - self.rows[:, kernel.DROOP])


@dataclass(frozen=True)
class Pistons:
    """All pistons at T instants: motion; way_by_angle m/rad, along the bore by shaft angle; inertia N m against the
    shaft."""

    motion: PistonMotion[Array]
    way_by_angle: Array
    inertia: Array


def pistons_at(group: Group, instants: Instants) -> Pistons:
    """The pistons under the plate as it is tilted and swings at each instant."""
    pump, speed, circle = group.pump, group.point.shaft_speed, bore_circle(group.pump, group.parts)
    angle, rows = instants.own_angle, instants.rows
    shape, pistons = angle.shape, angle.shape[1]
    rate = rows[:, kernel.RATE] - rows[:, kernel.DROOP_RATE]
    tilt = Plate(*(np.repeat(one, pistons) for one in (instants.tilt, rate, rows[:, kernel.ACCELERATION])))
    flat = angle.ravel()
    rates, ball = axial_rates(circle, tilt, flat), ball_motion(circle, tilt, flat, speed)
    turning = rates.phi * bore_axes(circle.cone, flat) + cross(SHAFT, ball.place)
    inertia = (pump.piston.mass + pump.slipper.mass) * dot(ball.acceleration, turning)
    normal = np.stack([np.sin(tilt.angle), -np.tan(circle.cross) * np.cos(tilt.angle), np.cos(tilt.angle)])
    sliding = cross(ball.velocity, normal / np.sqrt(dot(normal, normal)))
    out = rates.place.reshape(shape) - inner_place(pump, group.parts)
    whole = np.hypot(np.tan(instants.tilt), np.tan(circle.cross))
    motion: PistonMotion[Array] = PistonMotion(
        SwashDrive(circle.pitch_radius, circle.cone, np.arctan(whole)[:, None]),
        angle,
        ball.way.reshape(shape),
        dot(ball.acceleration, ball.axis).reshape(shape),
        np.linalg.norm(sliding, axis=0).reshape(shape),
        pump.piston.engaged_length - out,
        pump.piston.overhang + out,
    )
    return Pistons(motion, rates.phi.reshape(shape), inertia.reshape(shape))


def stroke_ratio(pump: PumpDescription, tilt: Array) -> Array:
    """Stroke over the full stroke (T,) at tilts (T,) rad, negative over centre."""
    full = full_drive(pump)
    whole = np.hypot(np.tan(tilt), np.tan(pump.pump.cross_angle or 0.0))
    drive = SwashDrive(full.pitch_radius, full.bore_cone_angle, np.arctan(whole))
    return np.asarray(np.where(tilt < 0.0, -1.0, 1.0) * stroke(drive) / stroke(full))
