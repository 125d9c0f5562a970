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
class GroupBalance:
    """One piston with its slipper at shaft angles (N,).

    forces at the joint; ball_moment (N, 3) N m of its friction on the slipper; joint_loss (N,) W, what that takes;
    pressed (N, 2) N m: int p (x, y) dA that the slipper's film must give; held N, force of the spring on the slipper
    besides `forces.lift`; inertia (N, 2, 3) N of piston and slipper, -m a; plate (N, 3) N of the swash plate on the
    slipper; places (N, 3, 3) m of both centres of mass and of the middle of the slipper's face; couple (N, 3) N m of
    the plate's force about that middle, finite where its lift passes through zero.
    """

    forces: BallForces
    ball_moment: Array
    joint_loss: Array
    pressed: Array
    held: float
    inertia: Array
    plate: Array
    places: Array
    couple: Array

    @property
    def forces_there(self) -> Array:
        """Forces (N, 3, 3) N at `places`: of inertia on both parts, of the swash plate."""
        return np.concatenate([self.inertia, self.plate[:, None]], axis=1)


def group_balance(
    rotor: Rotor, parts: FloatingParts, angle: Array, pressure: Array, drag: Array, friction: Array
) -> GroupBalance:
    """The balance of piston and slipper at shaft angles (N,) rad and chamber pressures (N,) Pa.

    drag (N,) N of the bore's film along the piston; friction (N, 2) N of the plate's film on the slipper.
    """
    pump, drive, speed = rotor.pump, rotor.drive, rotor.point.shaft_speed
    axis, plate = bore_axis(drive, angle), plate_axes(drive)
    normal, ball = plate[2], ball_centre(rotor, angle)
    along = piston_velocity(drive, angle, speed), piston_acceleration(drive, angle, speed)
    piston_place = ball - parts.piston.centre_of_mass * axis
    piston_rate = swept_acceleration(piston_place, axis, *along, speed)
    in_plate = slipper_acceleration(drive, angle, speed).T
    slipper_rate = in_plate @ plate[:2]
    push = (piston_area(pump) * (pressure - rotor.point.case_pressure) + drag)[:, None] * axis
    forces = ball_forces(
        axis, normal, DrivenBody(pump.piston.mass, piston_rate, push),
        DrivenBody(pump.slipper.mass, slipper_rate, friction @ plate[:2]),
    )  # fmt: skip
    spin = relative_spin(axis, normal, speed, rotor.spins.piston, rotor.spins.slipper)
    moment = ball_friction(
        pump.friction.piston_slipper_socket, np.linalg.norm(forces.ball, axis=-1), pump.slipper.ball_joint_radius,
        spin, speed,
    )  # fmt: skip
    inertia = pump.slipper.mass * in_plate
    pressed = pressed_by(
        inertia, pump.slipper.centre_of_mass_to_ball, friction, parts.slipper.ball_height, moment @ plate[:2].T
    )
    held = _spring_share(rotor, parts)
    lift = forces.lift + held
    face = ball + parts.slipper.ball_height * normal
    return GroupBalance(
        forces=forces,
        ball_moment=moment,
        joint_loss=-np.sum(moment * spin, axis=-1),
        pressed=pressed,
        held=held,
        inertia=-np.stack([pump.piston.mass * piston_rate, pump.slipper.mass * slipper_rate], axis=1),
        plate=friction @ plate[:2] - lift[:, None] * normal,
        places=np.stack([piston_place, ball + pump.slipper.centre_of_mass_to_ball * normal, face], axis=1),
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
    """The drives of the three gaps at one chamber pressure, and the balance from which they follow."""

    piston: PistonDrive
    slipper: SlipperDrive
    block: BlockDrive
    group: GroupBalance


def drives(rotor: Rotor, parts: FloatingParts, shaft_angle: Array, pressure: Array, rubbing: Rubbing) -> Drives:
    """Drives from the chamber pressure (N,) Pa at equidistant shaft angles (N,) rad, N a multiple of the pistons.

    A chamber that cavitates is within a kilopascal of the cavity's pressure, which films have then.
    """
    pressure = np.maximum(pressure, CAVITY_PRESSURE)
    group = group_balance(rotor, parts, shaft_angle, pressure, rubbing.piston, rubbing.slipper)
    chamber = PeriodicCurve(shaft_angle, pressure)
    return Drives(
        piston=_piston_drive(rotor, parts, shaft_angle, chamber, group, rubbing),
        slipper=_slipper_drive(rotor, parts, shaft_angle, chamber, group),
        block=block_drive(rotor, parts, shaft_angle, (pressure,), (group,)),
        group=group,
    )


def _piston_drive(
    rotor: Rotor, parts: FloatingParts, angles: Array, chamber: OverTurn, group: GroupBalance, rubbing: Rubbing
) -> PistonDrive:
    pump, point, guide = rotor.pump, rotor.point, parts.piston.guide_length
    sides, ball = bore_sides(rotor.drive, angles), -(pump.piston.overhang + travel(rotor, angles))
    joint = lateral_force(guide, ball, -np.matvec(sides, group.forces.ball))
    mass = lateral_force(guide, ball + parts.piston.centre_of_mass, np.matvec(sides, group.inertia[:, 0]))
    turned = lateral_moment(guide, rubbing.piston_moment - np.matvec(sides, group.ball_moment))
    return PistonDrive(
        shaft_speed=point.shaft_speed,
        viscosity=point.viscosity,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        piston_spin=point.shaft_speed + rotor.spins.piston,
        bore_spin=point.shaft_speed,
        chamber_pressure=chamber,
        reach=lambda angle: pump.piston.engaged_length - travel(rotor, angle),
        velocity=lambda angle: piston_velocity(rotor.drive, angle, point.shaft_speed),
        outer=PeriodicCurve(angles, joint + mass + turned),
    )


def _slipper_drive(
    rotor: Rotor, parts: FloatingParts, angles: Array, chamber: OverTurn, group: GroupBalance
) -> SlipperDrive:
    pump, point, outer_radius = rotor.pump, rotor.point, slipper_shape(rotor, parts).outer_radius
    outer = face_force(outer_radius, group.forces.lift + group.held, group.pressed)
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
    rotor: Rotor, parts: FloatingParts, angles: Array, pressure: Sequence[Array], groups: Sequence[GroupBalance]
) -> BlockDrive:
    """Pressing forces on the block: pressures (N,) Pa and balances over a chamber's own angles (N,) rad.

    Of one chamber for all, or of each.
    """
    point, pistons = rotor.point, rotor.pump.pump.pistons
    step, height = len(angles) // pistons, parts.block.spline_height
    by_chamber = [
        wrench_about(one.places, one.forces_there, height) + np.pad(one.couple[:, :2], ((0, 0), (1, 0)))
        for one in groups
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
