"""The next point to record: where two explanations part the most."""

from __future__ import annotations

from dataclasses import dataclass

from system.operating import OperatingPoint
from system.physics.effects import EffectId


@dataclass(frozen=True)
class NextPoint:
    """A point, the ids it separates, the gain of one reading in nats, repeats to be sure, and why in words."""

    point: OperatingPoint
    separates: tuple[EffectId, ...]
    gain: float
    repeats: int
    why: str
