"""Spins of piston and slipper about their own axes: stated, or free between ball joint and films."""

import math
from dataclasses import dataclass

import numpy as np

from gaps.loads.ball_joint import Spins, bore_drag, free_spins, land_drag
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.pump.laws.directions import bore_axis, plate_axes
from system.pump.laws.kinematics import SwashDrive, stroke
from system.pump.lumped import piston_area, piston_stand_out
from system.pump.operating import OperatingPoint

ESTIMATED = 36  # shaft angles at which the joint's axes swing before films are solved


@dataclass(frozen=True)
class SpinTorques:
    """Torques that set spins: friction mu |B| r (n,) N m of the joint at n equidistant shaft angles; drags (N m s) of
    both films, and torques (N m) of the films on parts without spin."""

    friction: Array
    drags: tuple[float, float]
    driven: tuple[float, float] = (0.0, 0.0)


def spins(pump: PumpDescription, point: OperatingPoint, drive: SwashDrive, torques: SpinTorques) -> Spins:
    """Spins (rad/s) of the piston relative to the block and of the slipper in space, constant over the turn.

    spin_ratio times shaft speed where stated; where left out, that at which the joint's friction and the films' drags
    balance (`gaps.loads.ball_joint.free_spins`).
    """
    speed, ratios = point.shaft_speed, (pump.piston.spin_ratio, pump.slipper.spin_ratio)
    piston, slipper = (None if ratio is None else ratio * speed for ratio in ratios)
    if piston is not None and slipper is not None:
        return Spins(piston, slipper)
    angles = TURN * np.arange(len(torques.friction)) / len(torques.friction)
    return free_spins(
        bore_axis=np.array([bore_axis(drive, angle) for angle in angles]),
        plate_normal=plate_axes(drive)[2],
        shaft_speed=speed,
        friction=torques.friction,
        piston_drag=torques.drags[0],
        slipper_drag=torques.drags[1],
        stated=(piston, slipper),
        driven=torques.driven,
    )


def estimated_torques(pump: PumpDescription, point: OperatingPoint, drive: SwashDrive) -> SpinTorques:
    """Torques that set spins before any film is solved.

    The friction is that of the turn's mean force, Ap (mean of both ports' pressures - p_case)/cos(g); drags are
    Petroff's of a centred piston at mid stroke and of the slipper's parallel lands at `film_thickness`.
    """
    part, slipper = pump.piston, pump.slipper
    above = 0.5 * (point.delivery_pressure + point.inlet_pressure) - point.case_pressure
    force = piston_area(pump) * abs(above) / math.cos(drive.swash_angle)
    engaged = part.engaged_length - piston_stand_out(pump, drive) - 0.5 * stroke(drive)
    length = min(engaged, part.guide_length or engaged)
    lands = (land_drag(point.viscosity, *land, slipper.film_thickness) for land in slipper.lands.radii)
    return SpinTorques(
        np.full(ESTIMATED, pump.friction.piston_slipper_socket * force * slipper.ball_joint_radius),
        (bore_drag(point.viscosity, pump.pump.piston_diameter, length, part.radial_clearance), math.fsum(lands)),
    )


def torques_of_films(
    estimated: SpinTorques, friction: Array, turned: Spins, torques: tuple[float, float]
) -> SpinTorques:
    """Torques that set spins, from films solved at spins (rad/s): mean torques (N m) on piston and slipper there.

    A torque against its spin is drag, as far as it exceeds the estimated one; what is left of it the film drives.
    friction as `SpinTorques` has it.
    """
    spun = turned.piston, turned.slipper
    drags = tuple(
        max(least, -torque / spin) if spin else least
        for least, torque, spin in zip(estimated.drags, torques, spun, strict=True)
    )
    driven = tuple(torque + drag * spin for torque, drag, spin in zip(torques, drags, spun, strict=True))
    return SpinTorques(friction, (drags[0], drags[1]), (driven[0], driven[1]))
