"""Drives of the three gaps: forces between the parts over a turn, from chamber pressure and friction.

Every sampled shaft angle has the balance of forces of piston and slipper with the ball joint between them
(`gaps.loads.ball_joint`); from it follow the loads on bore, swash plate and valve plate. Friction of films comes from
the revolutions before (`Rubbing`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gaps.films.block import BlockDrive, wrench_about
from gaps.films.over_turn import OverTurn, PeriodicCurve
from gaps.films.piston import PistonDrive, PistonShape
from gaps.films.slipper import PocketOrifice, Retainer, SlipperDrive, SlipperShape, face_force, face_inertia, pressed_by
from gaps.loads.ball_joint import (
    BallForces,
    DrivenBody,
    ball_forces,
    ball_friction,
    lateral_force,
    lateral_moment,
    relative_spin,
    swept_acceleration,
)
from reynolds.numerics.arrays import Array
from system.description.parts import RetainerKind
from system.films.parts import FloatingParts
from system.films.places import ball_centre
from system.films.rotor import Rotor, travel
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.land_losses import bore_table
from system.pump.laws.directions import bore_axis, bore_sides, plate_axes
from system.pump.laws.kinematics import (
    piston_acceleration,
    piston_velocity,
    slipper_acceleration,
    slipper_sliding_velocity,
)
from system.pump.laws.retainer import tipping_share
from system.pump.lumped import block_spring, piston_area


@dataclass(frozen=True)
class Rubbing:
    """Friction of the films on the parts in the turn before, over (N,) shaft angles; zero at first.

    piston: force (N,) N along the bore, out of the block; piston_moment (N, 2) N m about axes across the bore;
    slipper: force (N, 2) N of its film along the plate's axes.
    """

    piston: Array
    piston_moment: Array
    slipper: Array


def no_rubbing(count: int) -> Rubbing:
    """Films without friction."""
    return Rubbing(np.zeros(count), np.zeros((count, 2)), np.zeros((count, 2)))


@dataclass(frozen=True)
class GroupInstant:
    """One piston with its slipper at a shaft angle.

    forces at the joint; ball_moment (3,) N m of its friction on the slipper; joint_loss W, what that takes;
    pressed (2,) N m: int p (x, y) dA that the slipper's film must give; held N, force of the spring on the slipper
    besides `forces.lift`; inertia (2, 3) N of piston and slipper, -m a; plate (3,) N of the swash plate on the
    slipper; places (3, 3) m of both centres of mass and of the middle of the slipper's face; couple (3,) N m of the
    plate's force about that middle, finite where its lift passes through zero.
    """

    forces: BallForces
    ball_moment: Array
    joint_loss: float
    pressed: Array
    held: float
    inertia: Array
    plate: Array
    places: Array
    couple: Array


def group_instant(
    rotor: Rotor, parts: FloatingParts, angle: float, pressure: float, rubbing: tuple[float, Array]
) -> GroupInstant:
    """The balance of piston and slipper at a shaft angle (rad) and chamber pressure (Pa).

    `rubbing`: force N of the bore's film along the piston, and force (2,) N of the plate's film on the slipper.
    """
    pump, drive, speed = rotor.pump, rotor.drive, rotor.point.shaft_speed
    axis, plate = bore_axis(drive, angle), plate_axes(drive)
    normal, ball = plate[2], ball_centre(rotor, angle)
    along = piston_velocity(drive, angle, speed), piston_acceleration(drive, angle, speed)
    piston_place = ball - parts.piston.centre_of_mass * axis
    piston_rate = swept_acceleration(piston_place, axis, float(along[0]), float(along[1]), speed)
    in_plate = slipper_acceleration(drive, angle, speed)
    slipper_rate = in_plate @ plate[:2]
    drag, friction = rubbing
    push = (piston_area(pump) * (pressure - rotor.point.case_pressure) + drag) * axis
    forces = ball_forces(
        axis, normal, DrivenBody(pump.piston.mass, piston_rate, push),
        DrivenBody(pump.slipper.mass, slipper_rate, friction @ plate[:2]),
    )  # fmt: skip
    spin = relative_spin(axis, normal, speed, rotor.spins.piston, rotor.spins.slipper)
    moment = ball_friction(
        pump.friction.piston_slipper_socket, float(np.linalg.norm(forces.ball)), pump.slipper.ball_joint_radius,
        spin, speed,
    )  # fmt: skip
    inertia = pump.slipper.mass * in_plate
    pressed = pressed_by(
        inertia, pump.slipper.centre_of_mass_to_ball, friction, parts.slipper.ball_height, moment @ plate[:2].T
    )
    held = _spring_share(rotor, parts)
    lift = forces.lift + held
    face = ball + parts.slipper.ball_height * normal
    return GroupInstant(
        forces=forces,
        ball_moment=moment,
        joint_loss=-float(moment @ spin),
        pressed=pressed,
        held=held,
        inertia=-np.stack([pump.piston.mass * piston_rate, pump.slipper.mass * slipper_rate]),
        plate=friction @ plate[:2] - lift * normal,
        places=np.stack([piston_place, ball + pump.slipper.centre_of_mass_to_ball * normal, face]),
        couple=np.cross(pressed @ plate[:2], -normal),
    )


def _spring_share(rotor: Rotor, parts: FloatingParts) -> float:
    """Force (N) of the block's spring on a slipper, through the retainer."""
    if parts.slipper.retainer.kind is not RetainerKind.SPRING:
        return 0.0
    return float(block_spring(rotor.pump) / (rotor.pump.pump.pistons * np.cos(rotor.drive.swash_angle)))


def slipper_retainer(rotor: Rotor, parts: FloatingParts) -> Retainer:
    """The retainer over a slipper: a fixed plate, or one that the spring presses on the others.

    Under the latter each slipper carries its part of the spring force; up to the force that tips the plate about the
    opposite slippers it is as stiff as a fixed one, and then yields as the spring does, reduced by the smaller rise of
    its middle.
    """
    of, tilt = parts.slipper.retainer, rotor.drive.swash_angle
    if of.kind is not RetainerKind.SPRING:
        return Retainer(of.clearance, of.stiffness)
    arm = tipping_share(rotor.pump.pump.pistons) / float(np.cos(tilt))
    more = arm * block_spring(rotor.pump) - _spring_share(rotor, parts)
    return Retainer(of.clearance, of.stiffness, more, arm**2 * rotor.pump.ball_guide.spring_stiffness)


@dataclass(frozen=True)
class Drives:
    """The drives of the three gaps at one chamber pressure, and the balances (N,) from which they follow."""

    piston: PistonDrive
    slipper: SlipperDrive
    block: BlockDrive
    group: tuple[GroupInstant, ...]


def drives(rotor: Rotor, parts: FloatingParts, shaft_angle: Array, pressure: Array, rubbing: Rubbing) -> Drives:
    """Drives from the chamber pressure (N,) Pa at equidistant shaft angles (N,) rad, N a multiple of the pistons.

    A chamber that cavitates is within a kilopascal of the cavity's pressure, which films have then.
    """
    pressure = np.maximum(pressure, CAVITY_PRESSURE)
    group = tuple(
        group_instant(rotor, parts, float(a), float(p), (float(rubbing.piston[k]), rubbing.slipper[k]))
        for k, (a, p) in enumerate(zip(shaft_angle, pressure, strict=True))
    )
    chamber = PeriodicCurve(shaft_angle, pressure)
    return Drives(
        piston=_piston_drive(rotor, parts, shaft_angle, chamber, group, rubbing),
        slipper=_slipper_drive(rotor, parts, shaft_angle, chamber, group),
        block=block_drive(rotor, parts, shaft_angle, (pressure,), (group,)),
        group=group,
    )


def _piston_drive(
    rotor: Rotor, parts: FloatingParts, angles: Array, chamber: OverTurn, group: tuple[GroupInstant, ...],
    rubbing: Rubbing,
) -> PistonDrive:  # fmt: skip
    pump, point = rotor.pump, rotor.point
    outer = np.empty((len(angles), 4))
    for k, (angle, at) in enumerate(zip(angles, group, strict=True)):
        sides = bore_sides(rotor.drive, float(angle))
        ball = -(pump.piston.overhang + travel(rotor, float(angle)))
        joint = lateral_force(parts.piston.guide_length, ball, -sides @ at.forces.ball)
        mass = lateral_force(parts.piston.guide_length, ball + parts.piston.centre_of_mass, sides @ at.inertia[0])
        turned = lateral_moment(parts.piston.guide_length, rubbing.piston_moment[k] - sides @ at.ball_moment)
        outer[k] = joint + mass + turned
    return PistonDrive(
        shaft_speed=point.shaft_speed,
        viscosity=point.viscosity,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        piston_spin=point.shaft_speed + rotor.spins.piston,
        bore_spin=point.shaft_speed,
        chamber_pressure=chamber,
        reach=lambda angle: np.asarray(pump.piston.engaged_length - travel(rotor, angle)),
        velocity=lambda angle: piston_velocity(rotor.drive, angle, point.shaft_speed),
        outer=PeriodicCurve(angles, outer),
    )


def _slipper_drive(
    rotor: Rotor, parts: FloatingParts, angles: Array, chamber: OverTurn, group: tuple[GroupInstant, ...]
) -> SlipperDrive:
    pump, point, outer_radius = rotor.pump, rotor.point, slipper_shape(rotor, parts).outer_radius
    outer = np.array([face_force(outer_radius, at.forces.lift + at.held, at.pressed) for at in group])
    return SlipperDrive(
        shaft_speed=point.shaft_speed,
        viscosity=point.viscosity,
        density=pump.oil.density,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        spin=rotor.spins.slipper,
        chamber_pressure=chamber,
        sliding=lambda angle: slipper_sliding_velocity(rotor.drive, angle, point.shaft_speed),
        outer=PeriodicCurve(angles, outer),
        retainer=slipper_retainer(rotor, parts),
        inertia=face_inertia(
            outer_radius,
            pump.piston.mass + pump.slipper.mass,
            pump.slipper.mass,
            pump.slipper.centre_of_mass_to_ball,
            rotor.drive.swash_angle,
        ),
    )


def block_drive(
    rotor: Rotor,
    parts: FloatingParts,
    angles: Array,
    pressure: Sequence[Array],
    groups: Sequence[tuple[GroupInstant, ...]],
) -> BlockDrive:
    """Pressing forces on the block: pressures (N,) Pa and balances (N,) over a chamber's own angles (N,) rad.

    Of one chamber for all, or of each.
    """
    point, pistons = rotor.point, rotor.pump.pump.pistons
    step, height = len(angles) // pistons, parts.block.spline_height
    by_chamber = [
        np.array(
            [
                wrench_about(at.places, np.vstack([at.inertia, at.plate]), height) + np.array([0.0, *at.couple[:2]])
                for at in group
            ]
        )
        for group in groups
    ]
    press = sum(np.roll(by_chamber[k % len(groups)], -k * step, axis=0) for k in range(pistons))
    held = np.maximum(np.stack(pressure, axis=-1), CAVITY_PRESSURE)
    chamber = PeriodicCurve(angles, held[:, 0] if len(pressure) == 1 else held)
    if parts.slipper.retainer.kind is not RetainerKind.SPRING:
        # Then the slippers do not transmit the spring's force to the swash plate: the shaft bears it.
        press = press - np.array([block_spring(rotor.pump), 0.0, 0.0])
    return BlockDrive(
        shaft_speed=point.shaft_speed,
        viscosity=point.viscosity,
        suction_pressure=point.inlet_pressure,
        delivery_pressure=point.delivery_pressure,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        chamber_pressure=chamber,
        press=PeriodicCurve(angles, np.asarray(press)),
        spline_height=parts.block.spline_height,
    )


def piston_shape(rotor: Rotor, parts: FloatingParts) -> PistonShape:
    """The piston and its guide."""
    return PistonShape(
        rotor.pump.pump.piston_diameter, rotor.pump.piston.radial_clearance, parts.piston.guide_length,
        parts.piston.piston, parts.piston.bore,
    )  # fmt: skip


def slipper_shape(rotor: Rotor, parts: FloatingParts) -> SlipperShape:
    """The slipper's face and feed."""
    slipper = rotor.pump.slipper
    flow_coefficient = parts.slipper.orifice_flow_coefficient
    orifice = PocketOrifice(slipper.orifice_diameter, slipper.orifice_length, flow_coefficient, bore_table(slipper))
    return SlipperShape(slipper.lands, orifice, parts.slipper.face)
