"""Flows and torque of a pump at the points of a bench map, before sensors read them, and their parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.chamber_map import Courses
from system.bench.setting import Setting
from system.effects.effect import BenchState, Effects
from system.effects.friction import rubbed
from system.effects.outside import outside
from system.inputs.channels import ChannelName
from system.inputs.units import TURN
from system.pump.chamber.layout import CARRIED_ENERGY, DELIVERY, GAPS, PATH_ENERGY, PISTON, PORTS, SUCTION, WORK
from system.pump.laws.friction_pairs import FrictionPairs, Pair, PairLoss
from system.pump.lumped import lumped_pairs

SIMULATED = (ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE, ChannelName.TORQUE)
"""Outputs that the lumped bench knows, in the order of `truth`."""


@dataclass(frozen=True)
class Affected:
    """What laws change at a setting, and the state they have seen."""

    effects: Effects
    state: BenchState


@dataclass(frozen=True)
class Solved:
    """A map at given values: as it is without laws of what physics left out (`plain`), and with them."""

    plain: Setting
    plain_courses: Courses
    setting: Setting
    courses: Courses
    affected: Affected | None


def losses(solved: Solved) -> FrictionPairs:
    """Losses of the seven pairs, (N, M) W, with what laws change of them."""
    at = solved.setting
    found = lumped_pairs(at.pump, at.point, at.motion, solved.courses)
    return found if solved.affected is None else rubbed(found, solved.affected.effects)


def pair_torque(setting: Setting, loss: PairLoss) -> Array:
    """Mean torque (N,) N m on the shaft of all pairs of a kind."""
    power = loss.count * np.mean(loss.coulomb + loss.viscous + np.zeros_like(setting.motion.velocity), axis=-1)
    return np.asarray(power / np.ravel(setting.point.shaft_speed))


def truth(solved: Solved) -> Array:
    """Delivery, inlet and drain flow in m3/s at their own port's pressure and shaft torque in N m, (N, 4).

    As `assembly.put_together` reads one point: flows by the chambers' oil, torque by the pistons' work less what
    carried oil gives back, and by friction.
    """
    flows, torque = _chambers(solved.setting, solved.courses)
    found, affected = losses(solved), solved.affected
    torque = torque + sum(pair_torque(solved.setting, found.loss(pair)) for pair in Pair)
    read = np.column_stack([*flows, torque])
    if affected is None:
        return read
    beside = outside(affected.effects, affected.state)
    read += np.column_stack([beside.delivery, beside.inlet, beside.drain, beside.torque])
    read[:, 0] *= affected.effects.delivery_reading
    return read


def throttling_torque(setting: Setting, courses: Courses) -> Array:
    """Torque (N,) N m that throttling in both ports takes."""
    return np.asarray(
        setting.pump.pump.pistons / TURN * courses.totals[:, PATH_ENERGY : PATH_ENERGY + PORTS].sum(axis=1)
    )


def _chambers(setting: Setting, courses: Courses) -> tuple[tuple[Array, Array, Array], Array]:
    """Flows at the ports and the drain, and the torque of the pistons' work less that of carried oil."""
    point, totals, pistons = setting.point, courses.totals, setting.pump.pump.pistons
    rate = pistons * np.ravel(point.shaft_speed) / TURN
    modulus = setting.problem.chambers["bulk_modulus"]
    volume = {
        name: np.exp(-np.ravel(getattr(point, name)) / modulus)
        for name in ("delivery_pressure", "inlet_pressure", "case_pressure")
    }
    flows = (
        rate * totals[:, DELIVERY] * volume["delivery_pressure"],
        -rate * totals[:, SUCTION] * volume["inlet_pressure"],
        rate * totals[:, PISTON : PISTON + GAPS].sum(axis=1) * volume["case_pressure"],
    )
    return flows, pistons / TURN * (
        totals[:, WORK] - totals[:, CARRIED_ENERGY : CARRIED_ENERGY + GAPS].sum(axis=1)
    )
