"""Operating points at which a varied pump is solved, with the share of the time of each."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.maps.duty import Cycle, node_weights
from system.maps.plan import MapPlan
from system.pump.operating import OperatingPoint, operating_point

_ASKED = tuple(own.name for own in fields(OperatingPoint) if own.name != "viscosity")


@dataclass(frozen=True)
class Sites:
    """Operating points (P) and their weights (P,), of sum 1; words: their origin."""

    points: tuple[OperatingPoint, ...]
    weights: Array
    words: str

    def of(self, pump: PumpDescription) -> tuple[OperatingPoint, ...]:
        """Return the points of another pump: viscosities are those of its oil. Raises ValueError as its law."""
        asked = ({name: getattr(point, name) for name in _ASKED} for point in self.points)
        return tuple(operating_point(pump, **each) for each in asked)


def plan_sites(plan: MapPlan) -> Sites:
    """Return the points of a plan, each of the same weight."""
    count = len(plan.points)
    words = "one operating point" if count == 1 else f"{count} operating points, means"
    return Sites(plan.points, np.full(count, 1.0 / count), words)


def cycle_sites(plan: MapPlan, cycle: Cycle) -> Sites:
    """Return the points of a plan with weights by which their sum is the mean over a duty cycle.

    Between the levels numbers are interpolated as those of a map. Raises InputFaults for a cycle that leaves the plan's
    box.
    """
    weights = node_weights(plan.axes, cycle)
    time, count = cycle.duration, len(plan.points)
    words = f"a duty cycle of {time:.6g} s, means; numbers of the worst point over all {count} points"
    return Sites(plan.points, weights, words)
