"""Numbers of a run by a response table, and their error at held-out points of the table.

A table learns ratios to the lumped law, means over the turn. A run by it has further errors: the shape over the
angle, which is the law's, and its chamber pressure. So held-out points are run by the table as well, and their
numbers compared with those solved.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gaps.response import HeldOutError, Measure
from reynolds.numerics.arrays import Array
from system.points.table.means import GAP_PAIRS
from system.pump.assembly import PumpPoint
from system.pump.laws.friction_pairs import Pair

SHAFT_TORQUE, DELIVERY_FLOW, CASE_DRAIN = "shaft_torque", "delivery_flow", "case_drain"
NUMBERS: Mapping[str, str] = {
    SHAFT_TORQUE: "mean, from the forces on the rotating group",
    DELIVERY_FLOW: "out of the delivery port",
    CASE_DRAIN: "what leaks into the case",
    **{f"{gap}.leakage_flow": "of all chambers" for gap in GAP_PAIRS},
    **{f"{gap}.loss": "of the pair, mean" for gap in GAP_PAIRS},
    "socket.loss": "of the ball joints, mean",
}
"""Numbers of a pump's point by name with their meanings, in the order of `pump_numbers`."""


@dataclass(frozen=True)
class NumbersError:
    """Errors of the numbers of runs by a table at the held-out points, in the order of NUMBERS.

    measures: relative, or of the largest where a number is not positive at all points.
    """

    measures: tuple[Measure, ...]
    error: HeldOutError

    def largest(self) -> dict[str, float]:
        """The largest error of each number by name."""
        return {name: float(off) for name, off in zip(NUMBERS, self.error.largest, strict=True)}


def pump_numbers(point: PumpPoint) -> Array:
    """The numbers (r,) of a point, SI."""
    losses = [*GAP_PAIRS.values(), Pair.PISTON_SLIPPER_SOCKET]
    return np.array(
        [
            point.bench.shaft_torque,
            point.bench.delivery_flow,
            point.bench.drain_flow,
            *(getattr(point.leakage_flow, gap) for gap in GAP_PAIRS),
            *(point.pairs.loss(pair).mean for pair in losses),
        ]
    )


def numbers_error(predicted: Array, solved: Array) -> NumbersError:
    """The error of numbers (n, r) by a table against those solved (n, r)."""
    positive, largest = np.all(solved > 0.0, axis=0), np.abs(solved).max(axis=0)
    scale = np.where(positive, solved, np.where(largest > 0.0, largest, 1.0))
    off = np.abs((predicted - solved) / scale)
    return NumbersError(
        tuple(Measure.RELATIVE if one else Measure.OF_LARGEST for one in positive),
        HeldOutError(np.sqrt(np.mean(off**2, axis=0)), np.max(off, axis=0), np.argmax(off, axis=0)),
    )
