"""Block, ball guide, shaft and swash plate: loads of splines, valve plate, bearings and trunnion.

Wrenches are (6, N): force N and moment N m about the pump's origin, on the shaft's axis in the face of the valve plate,
over N shaft angles. The block is balanced about the shaft and turns with it. The valve plate supports it along the
shaft and about both axes across, the spline sideways and about the shaft. On a spherical valve plate part of the
sideways force is the plate's; here the spline bears all of it. The ball guide moves freely along the shaft.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.parts import Stroking
from system.multibody.joints import wrench
from system.multibody.kinematics import SHAFT
from system.multibody.places import GroupPlaces


@dataclass(frozen=True)
class ShaftDrag:
    """Torques against the turning, (N,) N m: of the valve plate on the block, of both bearings on the shaft."""

    valve_plate: Array
    front: Array
    rear: Array


@dataclass(frozen=True)
class BlockReactions:
    """On the block, wrenches (6, N): of the valve plate with the oil in its ports, of the shaft's spline."""

    valve_plate: Array
    spline: Array


@dataclass(frozen=True)
class ShaftReactions:
    """On the shaft, wrenches (6, N): of both bearings, the front one holding it along; drive torque (N,) N m."""

    front: Array
    rear: Array
    torque: Array


@dataclass(frozen=True)
class PlateReactions:
    """On the swash plate: trunnion, wrench (6, N); actuator, wrench (6, N) of a force along the shaft at its pin;
    control (N,) N m, its moment about the tilt axis, positive to a larger angle."""

    trunnion: Array
    actuator: Array
    control: Array


def block_reactions(on_block: Array, places: GroupPlaces, drag: ShaftDrag) -> BlockReactions:
    """Reactions on the block under all other forces on it, on_block (6, N): pistons, oil over them and spring."""
    force, moment = on_block[:3], on_block[3:]
    sideways = np.stack([-force[0], -force[1], np.zeros_like(force[0])])
    spline = wrench(sideways, places.spline * SHAFT)
    plate = np.zeros_like(on_block)
    plate[2] = -force[2]
    plate[3:5] = -(moment + spline[3:])[:2]
    plate[5] = -drag.valve_plate
    spline[5] = -moment[2] + drag.valve_plate
    return BlockReactions(plate, spline)


def shaft_reactions(on_shaft: Array, places: GroupPlaces, drag: ShaftDrag) -> ShaftReactions:
    """Reactions of bearings and drive on the shaft under on_shaft (6, N), from both splines, and a spring that
    rests on it.

    Moments across are shared by both bearings, F_F (z_F - z_R) = -(M about the rear one).
    """
    force, moment = on_shaft[:3], on_shaft[3:]
    about_rear = moment - np.cross(places.rear * SHAFT, force, axis=0)
    span = places.front - places.rear
    front = np.stack([-about_rear[1] / span, about_rear[0] / span, -force[2]])
    rear = np.stack([-force[0] - front[0], -force[1] - front[1], np.zeros_like(force[2])])
    torque = -moment[2] + drag.front + drag.rear
    return ShaftReactions(
        wrench(front, places.front * SHAFT, -drag.front * SHAFT),
        wrench(rear, places.rear * SHAFT, -drag.rear * SHAFT),
        torque,
    )


def plate_reactions(on_plate: Array, places: GroupPlaces, tilt_axis: Array, swash_angle: float) -> PlateReactions:
    """Reactions on the swash plate at rest under on_plate (6, N): trunnion in the pivot, and actuator at its pin.

    tilt_axis (3,) unit vector; a turn about it makes the swash angle (rad) larger. The pin lies in the plate's plane
    through the tilt axis, `arm` from it, where a push out of the block tilts the plate in its stroking sense.
    """
    pivot = places.pivot * SHAFT
    about_pivot = on_plate[3:] - np.cross(pivot, on_plate[:3], axis=0)
    control = -np.tensordot(tilt_axis, about_pivot, axes=1)
    side = (-1.0 if places.strokes is Stroking.UP else 1.0) * places.arm
    along = np.cross(tilt_axis, SHAFT[:, 0])
    pin = side * (np.cos(swash_angle) * along[:, None] - np.sin(swash_angle) * SHAFT)
    lever = float(tilt_axis @ np.cross(pin[:, 0], SHAFT[:, 0]))
    actuator = wrench(control / lever * SHAFT, pivot + pin)
    force = -on_plate[:3] - actuator[:3]
    held = -about_pivot - np.cross(pin, actuator[:3], axis=0)
    return PlateReactions(wrench(force, pivot, held), actuator, control)
