"""Spins of piston and slipper about their own axes: stated, or what ball joint and films leave them."""

from __future__ import annotations

import math

import numpy as np

from gaps.ball_joint import Spins, bore_drag, free_spins, land_drag
from system.description import PumpDescription
from system.directions import plate_axes
from system.kinematics import SwashDrive, stroke
from system.lumped import piston_area, piston_stand_out
from system.operating import OperatingPoint


def spins(pump: PumpDescription, point: OperatingPoint, drive: SwashDrive) -> Spins:
    """Spins (rad/s) of the piston relative to the block and of the slipper in space, constant over the turn.

    spin_ratio times shaft speed where stated; where left out, that at which the joint's friction and the films'
    drags balance (`gaps.ball_joint.free_spins`). The friction is that of the turn's mean force, Ap (mean of both
    ports' pressures - p_case)/cos(g); drags are Petroff's of a centred piston at mid stroke and of the slipper's
    parallel lands at `film_thickness`; the bore stands along the shaft, as the cone's mean over the turn does.
    """
    speed, part, slipper = point.shaft_speed, pump.piston, pump.slipper
    stated = [None if ratio is None else ratio * speed for ratio in (part.spin_ratio, slipper.spin_ratio)]
    piston_spin, slipper_spin = stated
    if piston_spin is not None and slipper_spin is not None:
        return Spins(piston_spin, slipper_spin)
    above = 0.5 * (point.delivery_pressure + point.inlet_pressure) - point.case_pressure
    force = piston_area(pump) * abs(above) / math.cos(drive.swash_angle)
    engaged = part.engaged_length - piston_stand_out(pump, drive) - 0.5 * stroke(drive)
    length = min(engaged, part.guide_length or engaged)
    lands = (land_drag(point.viscosity, *land, slipper.film_thickness) for land in slipper.lands.radii)
    return free_spins(
        bore_axis=np.array([0.0, 0.0, 1.0]),
        plate_normal=plate_axes(drive)[2],
        shaft_speed=speed,
        friction=pump.friction.piston_slipper_socket * force * slipper.ball_joint_radius,
        piston_drag=bore_drag(point.viscosity, pump.pump.piston_diameter, length, part.radial_clearance),
        slipper_drag=math.fsum(lands),
        stated=(piston_spin, slipper_spin),
    )
