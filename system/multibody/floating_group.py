"""Forces between all parts where the gaps float: friction and pressure are those of the solved films."""

import numpy as np

from reynolds.numerics.arrays import Array
from system.multibody.joints import SetLoads
from system.multibody.rotating_group import ChamberLoads, JointForces, joined, levers, turning_group
from system.points.floating import FloatingKind, FloatingPoint
from system.pump.chamber_kinds import kinds
from system.pump.shaft_torque import GroupMasses


def floating_joint_forces(found: FloatingPoint) -> JointForces:
    """The forces between all parts of a pump with floating gaps; spins of piston and slipper included."""
    pump = found.rotor.pump
    group = turning_group(pump, found.rotor.point)  # as the gaps float: the stroke that effects leave
    each = [_loads(kind, group.ball.axis, group.plate_axes) for kind in found.kinds]
    return joined(group, kinds(pump).by_chamber(each), found.pump_point)


def _loads(kind: FloatingKind, axis: Array, plate_axes: Array) -> ChamberLoads:
    """Result of `drives.group_balance`: the piston's balance along its bore, friction in the plate."""
    pump = kind.rotor.pump
    masses = GroupMasses(pump.piston.mass, pump.slipper.mass, kind.parts.piston.centre_of_mass)
    at = kind.drives.group
    along = np.sum((at.forces.ball - at.inertia[:, 0]) * axis.T, axis=-1)
    in_plate = at.plate - (at.plate @ plate_axes[2])[:, None] * plate_axes[2]
    known = SetLoads(along, in_plate.T, at.ball_moment.T)
    return ChamberLoads(masses, levers(pump, kind.rotor.point), known)
