"""Leakage and friction of the three gaps by a response table, at one operating point or at N of them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.points.table.means import GAP_PAIRS, LawMoments, law_moments, plate_flow
from system.pump.chamber.problem import LeakTable
from system.pump.laws.friction_pairs import FrictionPairs, Pair, PairLoss
from system.pump.laws.kinematics import Number
from system.pump.lumped import PistonMotion, Pressed, lumped_leaks, lumped_pairs
from system.pump.operating import OperatingPoint

Means = Mapping[str, Any]
"""Outputs of a response table by name, at one point (float) or at N (N,)."""
LEAST_FACTOR = 1e-3
"""Of the lumped law's conductance: a conductance is positive, so that factors on it have an inverse."""
LEAST_CONTACT = 1e-4
"""Of a gap's loss."""


@dataclass(frozen=True)
class PortDraws:
    """Flow from delivery and suction port into the valve plate's film, m3/s at port pressure; of one point or (N,)."""

    delivery: Any
    suction: Any


def gap_leaks(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], cycle: Pressed, means: Means
) -> LeakTable:
    """Flow out of a chamber into each gap, of the table's mean and drag power: a G (p - p_case) + b C + c.

    G and C are the lumped law's, moments those at the pressure of its own cycle. The piston's drag flow is b C, the
    others' is c. A conductance is positive: where drag exceeds the whole flow, a is LEAST_FACTOR and c keeps the mean
    flow. One point: (3, M); N points: (N, 3, M).
    """
    law = lumped_leaks(pump, point, motion)
    moments = law_moments(law, pump, point, cycle.pressure)
    flow = moments.flow * _by_gap(means, "leakage")
    drag_ratio = _by_gap(means, "carried")
    above, one = (np.asarray(each)[..., None] for each in (moments.above, moments.one))
    constant = drag_ratio * moments.power / above
    constant[..., 0] = 0.0
    by_pressure = flow - constant * one
    answering = np.maximum(by_pressure / moments.flow, LEAST_FACTOR)
    constant += (by_pressure - answering * moments.flow) / one
    return LeakTable(
        answering[..., None] * law.conductance, drag_ratio[..., None] * law.drag_flow + constant[..., None]
    )


def gap_losses(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], cycle: Pressed, means: Means
) -> FrictionPairs[Number]:
    """The lumped pairs at the pressure of a cycle, those of gaps and joints with the table's means.

    The table learns a gap's loss less the power that dragged oil returns, by the power of the lumped law's moments. A
    gap's contact has LEAST_CONTACT of its loss at least, so that factors on it have an inverse.
    """
    by_law = lumped_pairs(pump, point, motion, cycle)
    moments = law_moments(lumped_leaks(pump, point, motion), pump, point, cycle.pressure)
    losses = {
        pair.value: _with_mean(by_law.loss(pair), _mean_loss(pump, by_law.loss(pair), moments, gap, k, means),
                               np.maximum(means[f"{gap}.contact_share"], LEAST_CONTACT))
        for k, (gap, pair) in enumerate(GAP_PAIRS.items())
    }  # fmt: skip
    joint = by_law.piston_slipper_socket
    losses[Pair.PISTON_SLIPPER_SOCKET.value] = _with_mean(joint, means["socket.friction"] * joint.mean, 1.0)
    return replace(by_law, **losses)


def port_draws(pump: PumpDescription, point: OperatingPoint[Number], means: Means) -> PortDraws:
    """Flow from the ports into the valve plate's film."""
    scale = plate_flow(pump, point)
    return PortDraws(scale * means["valve_plate.delivery_draw"], scale * means["valve_plate.suction_draw"])


def _by_gap(means: Means, name: str) -> Array:
    """An output of the three gaps, (3,) or (N, 3)."""
    return np.stack([np.asarray(means[f"{gap}.{name}"], dtype=float) for gap in GAP_PAIRS], axis=-1)


def _mean_loss(pump: PumpDescription, law: PairLoss[Any], moments: LawMoments, gap: str, row: int, means: Means) -> Any:
    returned = pump.pump.pistons * moments.power[..., row]
    return means[f"{gap}.friction"] * law.mean + means[f"{gap}.carried"] * returned


def _with_mean(law: PairLoss[Any], mean: Any, contact: Any) -> PairLoss[Any]:
    """A pair with another mean (W, of all), and the law's course of its Coulomb and viscous parts over the angle."""
    one = mean / law.count
    return PairLoss(law.count, _scaled(law.coulomb, contact * one), _scaled(law.viscous, (1.0 - contact) * one))


def _scaled(course: Array, mean: Any) -> Array:
    """A course over the angle with another mean; constant where it is zero (a coefficient of 0)."""
    own, wanted = np.mean(course, axis=-1)[..., None], np.asarray(mean)[..., None]
    return np.where(own > 0.0, course * wanted / np.where(own > 0.0, own, 1.0), wanted)
