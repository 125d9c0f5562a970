"""Drive torque of a transient: pressure and inertia by virtual work on the shaft, friction by the nominal losses.

    T w = sum [m A . dX/dphi w - Ap (p - p_case) s_phi w - q_drag (p - p_case)] + losses of the pairs + T_outside w

over the chambers; X the ball's place, A its acceleration, q_drag the drag flow of the piston through its gap. Losses
are those of `system.pump.lumped` at each instant's tilt, sliding and pressure, with the effects of [physics] there;
T_outside is the torque on the shaft besides the pairs.
"""

import numpy as np

from reynolds.numerics.arrays import Array
from system.effects.friction import rubbed
from system.multibody.transient.effects import Acting
from system.multibody.transient.pistons import Group, Instants, pistons_at
from system.pump.laws.friction_pairs import FrictionPairs, Pair
from system.pump.laws.leakage import piston_drag_flow
from system.pump.lumped import Pressures, lumped_pairs, piston_area
from system.pump.operating import columns


def drive_torque(group: Group, instants: Instants, acting: Acting) -> Array:
    """Torque (T,) N m of the shaft at instants with the effects of their turn."""
    pump, point = group.pump, group.point
    pistons, above = pistons_at(group, instants), instants.pressure - point.case_pressure
    clearance, diameter = pump.piston.radial_clearance, pump.pump.piston_diameter
    dragged = piston_drag_flow(diameter, clearance, pistons.motion.velocity) * above
    pushed = pistons.inertia - piston_area(pump) * above * pistons.way_by_angle - dragged / point.shaft_speed
    losses = lumped_pairs(pump, columns(point), pistons.motion, Pressures(instants.pressure))
    power = _power(rubbed(losses, acting.at_instants(instants)))
    return np.asarray(pushed.sum(axis=1) + power / point.shaft_speed + acting.outside.torque)


def _power(losses: FrictionPairs[Array]) -> Array:
    """All losses (T,) W at each instant."""
    total = np.zeros(losses.piston_cylinder.coulomb.shape[0])
    for pair in Pair:
        own = losses.loss(pair)
        each = own.coulomb + own.viscous
        total += each.sum(axis=1) if own.count > 1 else each[:, 0]
    return total
