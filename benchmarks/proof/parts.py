"""Parts of the proof, and the plant that each runs."""

from __future__ import annotations

from enum import Enum


class Plant(Enum):
    """Makers of recordings: nothing is common to two of them."""

    FIRST = "first"
    OTHER = "other"
    ROUGH = "rough"


class Part(Enum):
    """Kinds of cases, by the plant and by the truth."""

    NULL = "null"
    GRADED = "graded"
    PAIR = "pair"
    PARAMETER = "parameter"
    SENSOR = "sensor"
    UNKNOWN = "unknown"
    TRACE = "trace"
    OTHER_NULL = "other-null"
    OTHER_GRADED = "other-graded"
    OTHER_PAIR = "other-pair"
    OTHER_TRIPLE = "other-triple"
    OTHER_PARAMETER = "other-parameter"
    OTHER_SENSOR = "other-sensor"
    OTHER_UNKNOWN = "other-unknown"
    ROUGH_NULL = "rough-null"
    ROUGH_EFFECT = "rough-effect"
    ROUGH_PAIR = "rough-pair"
    ROUGH_TRIPLE = "rough-triple"
    ROUGH_SENSOR = "rough-sensor"
    ROUGH_UNKNOWN = "rough-unknown"

    @property
    def plant(self) -> Plant:
        """The plant whose recordings the part is made of."""
        return plant_of(self.value)


def plant_of(part: str) -> Plant:
    """The plant of a part by its name."""
    return next((one for one in (Plant.OTHER, Plant.ROUGH) if part.startswith(f"{one.value}-")), Plant.FIRST)
