"""Cases of a split: those of the proof's three plants, one plant after the other, with draws of their own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from enum import Enum
from itertools import count

from proof.cases import Case, cases
from proof.parts import Part, Plant
from proof.wide.case import WideCase


class Split(Enum):
    """Parts of the benchmark: answers beside the recordings, or sealed."""

    DEVELOPMENT = "development"
    TEST = "test"


SEEDS = {Split.DEVELOPMENT: 71, Split.TEST: 72}
"""Beginnings of the cases' seeds; the proof's own are 52 and 53."""
PARTS = {
    Plant.FIRST: (Part.NULL, Part.GRADED, Part.SENSOR, Part.UNKNOWN, Part.GRADED, Part.PAIR, Part.PARAMETER),
    Plant.OTHER: (Part.OTHER_NULL, Part.OTHER_GRADED, Part.OTHER_SENSOR, Part.OTHER_UNKNOWN, Part.OTHER_GRADED,
                  Part.OTHER_PAIR, Part.OTHER_PARAMETER),
    Plant.ROUGH: (Part.ROUGH_NULL, Part.ROUGH_EFFECT, Part.ROUGH_SENSOR, Part.ROUGH_UNKNOWN, Part.ROUGH_EFFECT,
                  Part.ROUGH_PAIR, Part.ROUGH_TRIPLE),
}  # fmt: skip
"""Parts in their turn: one null in seven, two single effects."""


def chosen(seed: int, recordings: int) -> list[Case | WideCase]:
    """Return so many cases, the plants in turn, each by its parts in turn; a seed draws the same ones."""
    found: list[Case | WideCase] = []
    for case in _in_turn(seed):
        found.append(case)
        if len(found) == recordings:
            break
    return found


def most(seed: int) -> int:
    """Return the number of cases that there are."""
    return sum(len(cases(part, seed)) for parts in PARTS.values() for part in dict.fromkeys(parts))


def _in_turn(seed: int) -> Iterator[Case | WideCase]:
    """Yield each case once; a part without further cases is skipped."""
    taken: Counter[Part] = Counter()
    known = {part: cases(part, seed) for parts in PARTS.values() for part in parts}
    for turn in count():
        if all(taken[part] == len(own) for part, own in known.items()):
            return
        for parts in PARTS.values():
            part = parts[turn % len(parts)]
            if taken[part] < len(known[part]):
                yield known[part][taken[part]]
                taken[part] += 1
