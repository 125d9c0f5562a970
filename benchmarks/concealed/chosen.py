"""Cases of a split: those of the proof's three plants, one plant after the other, with draws of their own."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from enum import Enum
from itertools import count, islice

from proof.cases import Case, cases
from proof.parts import Part, Plant
from proof.wide.case import WideCase


class Split(Enum):
    """Parts of the benchmark: answers beside the recordings, or sealed."""

    DEVELOPMENT = "development"
    TEST = "test"


SEEDS = {Split.DEVELOPMENT: 71, Split.TEST: 72}
"""Beginnings of the cases' seeds; the proof's own are 52 and 53."""
DRAWS = 100_000
"""Seeds of a split, one a recording."""
PARTS = {
    Plant.FIRST: (Part.NULL, Part.GRADED, Part.SENSOR, Part.UNKNOWN, Part.GRADED, Part.PAIR, Part.PARAMETER),
    Plant.OTHER: (Part.OTHER_NULL, Part.OTHER_GRADED, Part.OTHER_SENSOR, Part.OTHER_UNKNOWN, Part.OTHER_GRADED,
                  Part.OTHER_PAIR, Part.OTHER_PARAMETER),
    Plant.ROUGH: (Part.ROUGH_NULL, Part.ROUGH_EFFECT, Part.ROUGH_SENSOR, Part.ROUGH_UNKNOWN, Part.ROUGH_EFFECT,
                  Part.ROUGH_PAIR, Part.ROUGH_TRIPLE),
}  # fmt: skip
"""Parts in their turn: one null in seven, two single effects."""


def chosen(seed: int, recordings: int | None = None) -> list[Case | WideCase]:
    """Return so many cases, or all, the plants in turn, each by its parts in turn; a seed draws the same ones.

    Each has draws of its own: parts of the proof share some, and two recordings of one pump with the same noise would
    differ by what is concealed alone.
    A null is of a campaign in which other recordings of its plant conceal something: the proof has campaigns of nulls
    alone, whose channels would tell the answer. Where no recording of a plant conceals anything, any null will do.
    """
    known = {part: cases(part, seed) for parts in PARTS.values() for part in parts}
    hiding = defaultdict(set)
    for case in islice(_in_turn(known), recordings):
        if not _is_null(case):
            hiding[case.part.plant].add(case.campaign)

    def is_fair(case: Case | WideCase) -> bool:
        return not _is_null(case) or case.campaign in hiding.get(case.part.plant, {case.campaign})

    fair = {part: [case for case in own if is_fair(case)] for part, own in known.items()}
    found = enumerate(islice(_in_turn(fair), recordings))
    return [replace(case, seed=DRAWS * seed + number) for number, case in found]


def most(seed: int) -> int:
    """Return the number of cases that there are."""
    return len(chosen(seed))


def _is_null(case: Case | WideCase) -> bool:
    return not (case.concealed if isinstance(case, Case) else case.secrets)


def _in_turn(known: Mapping[Part, Sequence[Case | WideCase]]) -> Iterator[Case | WideCase]:
    """Yield each case once; a part without further cases is skipped."""
    taken: Counter[Part] = Counter()
    for turn in count():
        if all(taken[part] == len(own) for part, own in known.items()):
            return
        for parts in PARTS.values():
            part = parts[turn % len(parts)]
            if taken[part] < len(known[part]):
                yield known[part][taken[part]]
                taken[part] += 1
