"""Flows and torque of a pump at the points of a bench map, before sensors read them."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.chamber_map import Courses
from system.bench.setting import Setting
from system.description.gap import Gap
from system.effects.applied import Affected
from system.effects.friction import rubbed
from system.effects.outside import outside
from system.inputs.channels import ChannelName
from system.inputs.units import TURN
from system.pump.bench import NOTHING_OUTSIDE
from system.pump.laws.friction_pairs import FrictionPairs, Pair
from system.pump.lumped import lumped_pairs
from system.pump.power import bench_reading, chamber_exchange, gap_leakage, metered

SIMULATED = (ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE, ChannelName.TORQUE)
"""Flows and torque of the whole pump, as the lumped bench computes them."""
DRAINS = {
    Gap.PISTON: ChannelName.Q_PISTON,
    Gap.SLIPPER: ChannelName.Q_SLIPPER,
    Gap.VALVE_PLATE: ChannelName.Q_VALVE_PLATE,
}
"""Channel of each gap's own drain: its leakage, which is part of the case drain's flow too."""
METERED = (*SIMULATED, *DRAINS.values(), ChannelName.TORQUE_UNCOUPLED)
"""All channels of the lumped bench, in the order of `Solved.truth`."""


@dataclass(frozen=True)
class Solved:
    """A map at given values: without laws of missing physics (`plain`), and with them.

    `plain_courses()` solves the map without them at its first call.
    """

    plain: Setting
    plain_courses: Callable[[], Courses]
    setting: Setting
    courses: Courses
    affected: Affected | None

    @cached_property
    def truth(self) -> Array:
        """Flows in m3/s at their own port's pressure and torque in N m, (N, C) in the order of METERED.

        A shaft without a coupling has no torque.
        """
        at, totals, pistons = self.setting.problem.chamber, self.courses.totals, self.setting.pump.pump.pistons
        rate, changed = pistons * at.shaft_speed / TURN, self.affected
        exchange = chamber_exchange(totals, rate)
        added = NOTHING_OUTSIDE if changed is None else outside(changed.effects, changed.state)
        found = metered(bench_reading(at, totals, pistons, losses(self).power, exchange, added), added)
        leaks, none = gap_leakage(at, totals, rate, exchange), np.zeros_like(rate)
        drained = (getattr(leaks, gap.value) + none for gap in DRAINS)
        flows = found.delivery_flow, found.inlet_flow, found.drain_flow
        return np.column_stack([*flows, found.shaft_torque, *drained, none])


def losses(solved: Solved) -> FrictionPairs[Array]:
    """Losses of the seven pairs, (N, M) W, with the changes by laws."""
    at = solved.setting
    found = lumped_pairs(at.pump, at.point, at.motion, solved.courses)
    return found if solved.affected is None else rubbed(found, solved.affected.effects)


def coefficient_losses(solved: Solved) -> FrictionPairs[Array]:
    """The losses without the friction that laws add: their Coulomb part is proportional to the pairs' coefficients."""
    changed = solved.affected
    if changed is None:
        return losses(solved)
    bare = replace(changed.effects, extra_coulomb=np.zeros_like(changed.effects.extra_coulomb))
    return losses(replace(solved, affected=replace(changed, effects=bare)))


def shear_torques(solved: Solved) -> Array:
    """Shear torque (N, P) of the films, N m: viscous loss over speed, a column for each pair that has one."""
    pairs, speed = losses(solved), solved.setting.problem.chamber.shaft_speed
    sheared = np.stack([pairs.loss(pair).mean_viscous / speed for pair in Pair], axis=1)
    return sheared[:, sheared.any(axis=0)]


def throttling_torque(setting: Setting, courses: Courses) -> Array:
    """Torque (N,) N m of throttling in both ports."""
    return np.asarray(setting.pump.pump.pistons / TURN * courses.totals.path_energy.ports)
