"""Where the joints of the rotating group lie: stated by the pump file, or taken and told."""

from __future__ import annotations

from dataclasses import dataclass

from system.assumptions import Assumption, Taken
from system.description import PumpDescription
from system.floating_parts import ball_plane_height, retainer_kind, spline_height
from system.parts_description import RetainerKind
from system.units import Dimension


@dataclass(frozen=True)
class GroupPlaces:
    """Heights (m) over the valve plate: pivot, where the plane of the ball centres cuts the shaft, which is the
    ball guide's centre too; spline, where the shaft holds the block sideways; middles of front and rear
    bearing.

    guide_length m, of the land that guides a piston, from the bore's case edge; None: all of it that is engaged.
    retained: whether the spring presses the slippers through the retainer, or stands on the shaft.
    """

    pivot: float
    spline: float
    front: float
    rear: float
    guide_length: float | None
    retained: bool
    taken: tuple[Assumption, ...]


def group_places(pump: PumpDescription) -> GroupPlaces:
    """The places of a pump's joints, every value stated or taken."""
    taken = Taken()
    pivot = ball_plane_height(pump)
    spline = spline_height(pump, taken)
    rear, front = _bearings(pump, pivot, taken)
    retained = retainer_kind(pump, taken) is RetainerKind.SPRING
    return GroupPlaces(pivot, spline, front, rear, pump.piston.guide_length, retained, tuple(taken.assumptions))


def _bearings(pump: PumpDescription, pivot: float, taken: Taken) -> tuple[float, float]:
    """Heights (m) of rear and front bearing; left out: where a side force in the plane of the ball centres divides
    between them by the stated shares."""
    stated, share = pump.bearings, pump.bearings.front_share
    rear, front = stated.rear_position, stated.front_position
    reason = "where a side force in the plane of the ball centres gives front_share and rear_share"
    if rear is None:
        level = 0.0 if front is None or share == 1.0 else (pivot - share * front) / (1.0 - share)
        why = "in the face of the valve plate" if front is None else reason
        rear = taken.value("bearings.rear_position", None, level, why, Dimension.LENGTH)
    reach = (pivot - rear) / share if share > 0.0 else 2.0 * pivot
    return rear, taken.value("bearings.front_position", front, rear + reach, reason, Dimension.LENGTH)
