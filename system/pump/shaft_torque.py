"""The torque on the shaft from the forces on the rotating group: the moment of the swash plate's forces on it.

Block, pistons and slippers turn as one. The external forces are the swash plate's pressure and friction on each
slipper, and the friction of valve plate, ball guide and bearings; pressure in the block has no moment about the shaft.
Hence, with r the ball's place, lift the plate's normal force, T its friction, M the joint's friction moment on the
slipper and z the shaft's axis (the plate's pressure and friction hold the slipper's moments about the ball, hence M),

    torque = sum over chambers of z . [r x (lift n - T) + M + r x m_s a_s + r_c x m_p a_p] + rubbing about z.

No power, work or flow enters: against the sum of all sinks this is a check of the energy balance, not its definition.
The slipper's moments of inertia and the growth of its film are neglected, as in `gaps.loads.ball_joint`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.chamber.cycle import ChamberCycle
from system.pump.chamber.problem import ChamberProblem
from system.pump.chamber.setup import periodic_values
from system.pump.laws.directions import plate_axes
from system.pump.laws.friction_pairs import FrictionPairs, Pair, PairLoss, over_chambers
from system.pump.laws.kinematics import (
    SwashDrive,
    ball_radius,
    piston_acceleration,
    piston_velocity,
    slipper_sliding_velocity,
)
from system.work.means import mean_of

AT_REST = 1e-9
"""Part of the largest speed below which a part is at rest and its loss gives no force."""
ABOUT_SHAFT = (Pair.VALVE_PLATE_CYLINDER, Pair.BALL_GUIDE_RETAINER, Pair.FRONT_BEARING, Pair.REAR_BEARING)
"""Pairs with friction about the shaft: their torque is loss over shaft speed."""


@dataclass(frozen=True)
class GroupMasses:
    """Masses (kg) of one piston and one slipper; piston_centre m: its centre of mass, from the ball inwards."""

    piston: float
    slipper: float
    piston_centre: float = 0.0


@dataclass(frozen=True)
class ChamberForces:
    """Forces on one piston and its slipper over N shaft angles, without the reactions.

    along_bore (N,) N on the piston, out of the block: pressure and friction; on_slipper (2, N) N of the plate along its
    steepest line and tilt axis; joint (N,) N m: friction moment of the joint on the slipper about the shaft.
    """

    along_bore: Array
    on_slipper: Array
    joint: Array


def chamber_torque(
    drive: SwashDrive, shaft_angle: Array, shaft_speed: float, masses: GroupMasses, forces: ChamberForces
) -> Array:
    """Torque (N,) N m that one piston with its slipper requires of the shaft at shaft angles (N,) rad.

    The joint's force follows from the slipper's balance in the plate and the piston's along its bore, the lift from the
    slipper's across the plate (as `gaps.loads.ball_joint.ball_forces`, all angles at once). A frictionless massless
    piston under a force F requires -F R sin(phi) tan(gamma) on a cylindrical block. Validity: constant shaft speed.
    """
    outward = np.stack([np.cos(shaft_angle), np.sin(shaft_angle), np.zeros_like(shaft_angle)])
    onward = np.stack([-outward[1], outward[0], outward[2]])
    cone, plate = drive.bore_cone_angle, plate_axes(drive)
    bore = np.sin(cone) * outward + np.array([[0.0], [0.0], [np.cos(cone)]])
    radius = ball_radius(drive, shaft_angle)
    velocity = piston_velocity(drive, shaft_angle, shaft_speed)
    along = piston_acceleration(drive, shaft_angle, shaft_speed)
    coriolis = 2.0 * shaft_speed * velocity * np.sin(cone) * onward
    ball = along * bore + coriolis - shaft_speed**2 * radius * outward
    centre_radius = radius - masses.piston_centre * np.sin(cone)
    centre = along * bore + coriolis - shaft_speed**2 * centre_radius * outward
    rubbing = plate[:2].T @ forces.on_slipper
    in_plate = masses.slipper * ball - rubbing
    pushed = forces.along_bore - masses.piston * _dot(centre, bore)
    lift = (pushed - _dot(in_plate, bore)) / (plate[2] @ bore)
    turning = _dot(lift * plate[2][:, None] - rubbing + masses.slipper * ball, onward)
    return np.asarray(radius * turning + centre_radius * masses.piston * _dot(centre, onward) + forces.joint)


def forces_by_loss(
    problem: ChamberProblem, cycle: ChamberCycle, pairs: FrictionPairs, masses: GroupMasses
) -> ChamberForces:
    """The forces behind a cycle's pressure and the losses of its pairs.

    A loss at a sliding speed is a force loss/speed against it; the drag flow C of moving walls pulls them with C (p -
    p_case)/speed: the pull of the gap's pressure gradient. The joint of a slipper that does not turn against its plate
    has a friction torque loss/w about the shaft.
    """
    angle, speed = cycle.shaft_angle, problem.shaft_speed
    above = cycle.pressure - problem.case_pressure
    dragged = periodic_values(problem.leaks.drag_flow, angle.size) * above
    velocity = piston_velocity(problem.drive, angle, speed)
    sliding = slipper_sliding_velocity(problem.drive, angle, speed)
    piston = _whole(pairs.piston_cylinder) - dragged[0]
    slipper = _whole(pairs.slipper_swash_plate) - dragged[1]
    return ChamberForces(
        along_bore=problem.piston_area * above - _force(piston, velocity),
        on_slipper=-_force(slipper, np.hypot(*sliding)) * sliding / np.hypot(*sliding),
        joint=_whole(pairs.piston_slipper_socket) / speed,
    )


def shaft_torque(
    problems: Sequence[ChamberProblem],
    cycles: Sequence[ChamberCycle],
    pairs: Sequence[FrictionPairs],
    masses: Sequence[GroupMasses],
    pistons: int,
    ring_drag_power: float,
) -> Array:
    """Torque (N,) N m of the shaft over the cycles' shaft angles, all chambers, from `forces_by_loss`.

    Of one chamber for all, or of each. ring_drag_power in W: drag power of the block over the valve plate.
    """
    speed = problems[0].shaft_speed
    one = [
        chamber_torque(problem.drive, cycle.shaft_angle, speed, mass, forces_by_loss(problem, cycle, own, mass))
        for problem, cycle, own, mass in zip(problems, cycles, pairs, masses, strict=True)
    ]
    mean = mean_of(pairs)
    rubbed = sum(mean.loss(pair).count * _whole(mean.loss(pair)) for pair in ABOUT_SHAFT) - ring_drag_power
    return np.asarray(over_chambers(one, pistons) + rubbed / speed)


def _whole(loss: PairLoss) -> Array:
    return loss.coulomb + loss.viscous


def _force(power: Array, speed: Array) -> Array:
    """Power over speed; zero where the part is at rest."""
    force = np.zeros_like(speed)
    np.divide(power, speed, out=force, where=np.abs(speed) > AT_REST * np.max(np.abs(speed)))
    return force


def _dot(one: Array, two: Array) -> Array:
    """Scalar products of vectors (3, N)."""
    return np.asarray(np.sum(one * two, axis=0))
