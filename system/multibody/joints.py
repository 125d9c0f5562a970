"""One piston with its slipper: loads of ball joint, bore and swash plate, at all shaft angles of a turn.

Masses act in their centres of mass, without moments of inertia. a is the axis of the bore, n the normal of the
plate away from the block, N the normal force of the plate, T its friction, R and H the normal and tangential
force of the retainer:

    slipper   m_s A   = B + T + H + (R - N) n          piston   m_p a_p = -B + F a + L,   L . a = 0

as `gaps.loads.ball_joint`, with the retainer. F is chamber pressure over the case's on the piston's area and the
friction of the bore. The slipper's motion in the plate gives B there, the piston's along the bore the rest of it.
L acts at two places, the case edge of the guiding land and its inner end, by the moment about the ball; the
plate's moment balances the moments on the slipper about the ball.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.multibody.kinematics import SHAFT, BallMotion, cross, dot, swept
from system.multibody.retainer import Hold
from system.pump.shaft_torque import GroupMasses


@dataclass(frozen=True)
class SetLoads:
    """Known forces on one piston and its slipper over N own shaft angles.

    along_bore (N,) N on the piston, out of the block; rubbing (3, N) N of the plate on the slipper, in the
    plate; joint (3, N) N m of the ball joint's friction on the slipper.
    """

    along_bore: Array
    rubbing: Array
    joint: Array


@dataclass(frozen=True)
class SetForces:
    """Joint forces of one piston and its slipper, over N own shaft angles; vectors (3, N) in the pump's frame.

    ball N, of the piston on the slipper; lift (N,) N, normal force of the plate; plate N, total force of the
    plate on the slipper, and plate_moment N m about the ball; edge, inner N: of the bore on the piston across it,
    at the case edge and the inner end of the guiding land, at edge_place and inner_place m; twist (N,) N m about
    the bore's axis. momentum N and spin N m: m a and its moment about the origin, of both bodies; power W of m a.
    """

    ball: Array
    lift: Array
    plate: Array
    plate_moment: Array
    edge: Array
    inner: Array
    edge_place: Array
    inner_place: Array
    twist: Array
    momentum: Array
    spin: Array
    power: Array


@dataclass(frozen=True)
class Levers:
    """Along a bore from the ball inwards, (N,) m: to the case edge of the guiding land, and that land's length; a
    slipper's centre of mass from the ball, m."""

    overhang: Array
    guided: Array
    slipper_centre: float


def set_forces(
    motion: BallMotion, way_gain: Array, speed: float, normal: Array, masses: GroupMasses, levers: Levers,
    loads: SetLoads, held: Hold,
) -> SetForces:  # fmt: skip
    """The balance of one piston and slipper (file head); normal (3, 1), way_gain (N,) m/s2 along the bore.

    Valid for a plate that faces the bores, n . a > 0.
    """
    axis, ball = motion.axis, motion.place
    slipper = masses.slipper * motion.acceleration
    centre = ball - masses.piston_centre * axis
    piston = masses.piston * swept(centre, axis, motion.way, way_gain, speed)
    in_plate = slipper - loads.rubbing - held.pushing
    in_plate = in_plate - dot(in_plate, normal) * normal
    along = loads.along_bore - dot(piston, axis)
    joint = in_plate + (along - dot(in_plate, axis)) / dot(normal, axis) * normal
    across = piston + joint
    edge, inner, twist = _bore(axis, across - dot(across, axis) * axis, piston, masses, levers, loads)
    lift = dot(joint - slipper, normal) + held.pressing
    slipper_place = ball + levers.slipper_centre * normal
    piston_way = motion.velocity - masses.piston_centre * speed * cross(SHAFT, axis)
    return SetForces(
        ball=joint,
        lift=lift,
        plate=loads.rubbing - lift * normal,
        plate_moment=levers.slipper_centre * cross(normal, slipper) - loads.joint,
        edge=edge,
        inner=inner,
        edge_place=ball - levers.overhang * axis,
        inner_place=ball - (levers.overhang + levers.guided) * axis,
        twist=twist,
        momentum=piston + slipper,
        spin=cross(centre, piston) + cross(slipper_place, slipper),
        power=dot(piston, piston_way) + dot(slipper, motion.velocity),
    )


def _bore(
    axis: Array, side: Array, piston: Array, masses: GroupMasses, levers: Levers, loads: SetLoads
) -> tuple[Array, Array, Array]:
    """Reactions (3, N) at edge and inner end, and the torque (N,) about the axis, that hold a piston in its bore.

    About the ball: a x (c L1 + (c + l) L2) = c_p a x m a_p - M, c to the edge, l of the land, M on the slipper.
    """
    inertia = piston - dot(piston, axis) * axis
    moment = masses.piston_centre * inertia - cross(loads.joint, axis)
    inner = (moment - levers.overhang * side) / levers.guided
    return side - inner, inner, dot(loads.joint, axis)


def wrench(force: Array, place: Array, moment: Array | float = 0.0) -> Array:
    """A force (3, N) N at a place (3, N) or (3, 1) m with a moment N m, as force and moment (6, N) about the
    origin."""
    turning = cross(place, force) + moment
    return np.concatenate([np.broadcast_to(force, turning.shape), turning])
