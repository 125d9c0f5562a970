"""Where a mismatch sits: channel and region, component, shaft angle, time. Needs no catalogue."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from diagnosis.detect import Region
from system.channels import ChannelName
from system.components import Component


class ComponentGroup(Enum):
    """Components that a bench map rarely tells from each other."""

    FILM_LEAKAGE = "leakage of the films"
    CROSS_FLOW = "flow from delivery to inlet"
    DRAIN_FLOW = "flow to the case beside the films"
    DISPLACEMENT = "displacement and compression"
    FRICTION = "friction"
    COMMUTATION = "commutation"
    CASE_DRAG = "drag in the case"
    THERMAL_STATE = "thermal state"
    SENSOR = "a sensor"


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
    """A drift, or an onset at point `at` of the order, of a channel; `parameter`: what wanders with time, if any."""

    kind: TimeKind
    channel: ChannelName
    at: int
    p_value: float
    parameter: str | None


@dataclass(frozen=True)
class Location:
    """components, groups: ln evidence of each, best first; tie: components that cannot be told from the best."""

    channels: tuple[ChannelName, ...]
    region: Region | None
    components: tuple[tuple[Component, float], ...]
    groups: tuple[tuple[ComponentGroup, float], ...]
    tie: tuple[Component, ...]
    angle: AngleWindow | None
    time: TimeMark | None
