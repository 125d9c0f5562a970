"""Closure of the joints: the external forces on the rotating group against its momentum, and the power balance.

Outside the group (pistons, slippers, retainer, ball guide, spring, block with the oil in it, shaft) are swash
plate, valve plate, bearings and drive. Joints within it cancel if each acts on both its bodies, in one place; the
sums do not contain them.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.multibody.joints import wrench
from system.multibody.kinematics import dot
from system.multibody.rotating_group import JointForces


@dataclass(frozen=True)
class Closure:
    """Largest errors over the turn: of force, of the largest force of the plate on a slipper; of moment, of
    that times the pitch radius; of power, of the mean shaft power."""

    force: float
    moment: float
    power: float


def closure(joints: JointForces) -> Closure:
    """Closure of force, moment and power of the rotating group over the turn; round-off, or a fault."""
    group = joints.group
    from_plate = group.whole([wrench(one.plate, group.ball.place, one.plate_moment) for one in joints.sets])
    outside = from_plate + joints.block.valve_plate + joints.shaft.front + joints.shaft.rear
    outside[5] += joints.shaft.torque
    rate = group.whole([np.concatenate([one.momentum, one.spin]) for one in joints.sets])
    largest = max(float(np.max(np.abs(one.lift))) for one in joints.sets)
    lever = group.drive.pitch_radius
    power = joints.shaft.torque * group.point.shaft_speed
    return Closure(
        force=float(np.max(np.abs(outside - rate)[:3])) / largest,
        moment=float(np.max(np.abs(outside - rate)[3:])) / (largest * lever),
        power=float(np.max(np.abs(power - _taken(joints)))) / float(np.mean(np.abs(power))),
    )


def _taken(joints: JointForces) -> Array:
    """Sinks of the shaft's power (N,) W: the oil, momentum, and each friction by its own speed."""
    group, speed = joints.group, joints.group.point.shaft_speed
    each = [
        one.power
        - own.known.along_bore * group.ball.way
        - dot(own.known.rubbing, group.ball.velocity)
        + speed * own.known.joint[2]
        for own, one in zip(joints.loads, joints.sets, strict=True)
    ]
    turning = speed * (group.plate_axes[2] - np.array([0.0, 0.0, 1.0]))
    guide = -float(joints.guide.moment @ turning)
    drag = joints.drag.valve_plate + joints.drag.front + joints.drag.rear
    return group.whole(each) + guide + speed * drag
