"""Where a mismatch sits: channel and region, component, shaft angle, time. Needs no catalogue."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from diagnosis.detect import Region
from system.channels import ChannelName
from system.components import Component


class TimeKind(Enum):
    """How a mismatch goes with the order of the points."""

    DRIFT = "drift"
    ONSET = "onset"


@dataclass(frozen=True)
class AngleWindow:
    """Shaft angles in rad from start to end where a trace stands out, and the events of the ports within."""

    start: float
    end: float
    p_value: float
    events: tuple[str, ...]


@dataclass(frozen=True)
class TimeMark:
    """A drift or an onset at point `at` of the order."""

    kind: TimeKind
    at: int
    p_value: float


@dataclass(frozen=True)
class Location:
    """components: ln evidence of each, best first; tie: those that cannot be told from the best."""

    channels: tuple[ChannelName, ...]
    region: Region | None
    components: tuple[tuple[Component, float], ...]
    tie: tuple[Component, ...]
    angle: AngleWindow | None
    time: TimeMark | None
