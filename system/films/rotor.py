"""A pump's rotating group at an operating point, and the ring of its valve plate."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gaps.loads.ball_joint import Spins
from gaps.shapes.valve_plate_ring import ValvePlateGeometry
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.films.spins import SpinTorques, estimated_torques, spins
from system.pump.laws.kinematics import SwashDrive, drive_at_ratio, piston_displacement
from system.pump.lumped import full_drive, piston_stand_out
from system.pump.operating import OperatingPoint


@dataclass(frozen=True)
class Rotor:
    """A pump at an operating point, its drive set to the displacement ratio.

    spin_torques: of solved films, which determine free spins; None before any is solved.
    """

    pump: PumpDescription
    point: OperatingPoint
    full: SwashDrive
    drive: SwashDrive
    spin_torques: SpinTorques | None = None

    @cached_property
    def spins(self) -> Spins:
        """Spins of piston and slipper (`system.films.spins`)."""
        return spins(self.pump, self.point, self.drive, self.spin_torques or self.estimated_torques)

    @property
    def estimated_torques(self) -> SpinTorques:
        """Torques that determine free spins before any film is solved."""
        return estimated_torques(self.pump, self.point, self.drive)


def rotor(pump: PumpDescription, point: OperatingPoint) -> Rotor:
    """The rotating group of a pump at an operating point."""
    full = full_drive(pump)
    return Rotor(pump, point, full, drive_at_ratio(full, point.displacement_ratio))


def travel(rotor: Rotor, shaft_angle: Array | float) -> Array:
    """Way of the piston (...) m beyond its innermost place at full displacement, at shaft angles (...) rad."""
    return np.asarray(piston_stand_out(rotor.pump, rotor.drive) + piston_displacement(rotor.drive, shaft_angle))


def engaged_share(rotor: Rotor, guide_length: float, shaft_angles: Array) -> Array:
    """Share (n,) of a piston's guide (m) that its film fills at shaft angles (n,) rad, from the case edge inwards.

    1 where the piston reaches through; else the film's inner end is the piston's own.
    """
    return np.minimum((rotor.pump.piston.engaged_length - travel(rotor, shaft_angles)) / guide_length, 1.0)


def valve_plate_geometry(pump: PumpDescription, turned: float = 0.0) -> ValvePlateGeometry:
    """The valve plate's ring; its ports' arcs follow from the opening angles and the block kidney's arc.

    A port opens when the kidney's leading edge reaches it (end of the groove) and shuts when the trailing edge
    leaves it. `turned` (rad): the drive's `dead_centre_shift`, without effect on radii.
    """
    part, half = pump.valve_plate, 0.5 * pump.valve_plate.kidney_arc
    sides = tuple(zip(pump.ports.sides, (0.0, np.pi), strict=True))
    suction, delivery = ((dead + side.groove_end + half, dead + side.kidney_end - half) for side, dead in sides)
    return ValvePlateGeometry(
        land_radii=(part.land_radius_1, part.land_radius_2, part.land_radius_3, part.land_radius_4),
        pistons=pump.pump.pistons,
        kidney_arc=part.kidney_arc,
        suction_arc=suction,
        delivery_arc=delivery,
        webs=tuple((start + dead, end + dead) for side, dead in sides for start, end in side.web_spans),
        turned=turned,
        pads=part.bearing_pads,
        sphere=part.sphere,
    )
