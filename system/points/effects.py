"""Effects of [physics] at one operating point, chambers and losses of which are those of any fidelity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.applied import displaced, effects_at
from system.effects.effect import Effects
from system.effects.gap_states import bench_state
from system.effects.outside import outside
from system.effects.switched import stated_laws
from system.pump.bench import NOTHING_OUTSIDE, Outside
from system.pump.chamber.cycle import ChamberCycle
from system.pump.lumped import piston_motion
from system.pump.operating import OperatingPoint, columns
from system.work.means import mean_of


def point_effects(pump: PumpDescription, point: OperatingPoint, cycle: ChamberCycle) -> Effects[float]:
    """What [physics] changes at one point, over the angles of a cycle without any effect."""
    at, row = columns(point), _Row(cycle.pressure[None])
    return effects_at(pump, at, piston_motion(pump, at), row, stated_laws(pump), np.zeros(1)).effects.at(0)


def with_stroke(point: OperatingPoint, effects: Sequence[Effects[float]]) -> OperatingPoint:
    """The point with the stroke that effects leave, mean of the chambers' effects; as it is without any."""
    return displaced(point, float(np.mean([one.ideal for one in effects]))) if effects else point


def mean_outside(
    pump: PumpDescription, point: OperatingPoint, effects: Sequence[Effects[float]]
) -> Outside[float]:
    """What passes the chambers by at a point, mean of the chambers' effects."""
    state = bench_state(pump, point, 0.0)
    return mean_of([outside(one, state) for one in effects]) if effects else NOTHING_OUTSIDE


@dataclass(frozen=True)
class _Row:
    """A cycle's pressure as a map of one point has it, (1, M)."""

    pressure: Array
