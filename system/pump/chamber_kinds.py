"""Pumps whose chambers differ: `[piston.3]` beside `[piston]`.

Such a pump is the mean of z pumps with equal chambers, each with the piston and slipper of one chamber: flows, powers
and torques of chambers add. Chambers with the same parts are of one kind; where all are, one chamber is solved for all.
Results by chamber are a tuple: of one where all are equal, else of z, chamber 1 first.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

from system.description.pump import PumpDescription

Of = TypeVar("Of")


@dataclass(frozen=True)
class Kinds:
    """The kinds of chambers that a pump has: `pumps`, one a kind with equal chambers; the kind `of_chamber` 1, 2, ..

    The most common kind comes first.
    """

    pumps: tuple[PumpDescription, ...]
    of_chamber: tuple[int, ...]

    @property
    def alike(self) -> bool:
        """True if all chambers are of one kind."""
        return len(self.pumps) == 1

    def hold_alike(self) -> None:
        """Raise ValueError where chambers differ."""
        if not self.alike:
            raise ValueError("chambers: found single pistons or slippers, expected chambers that are alike")

    def chambers(self, kind: int) -> tuple[int, ...]:
        """The chambers of a kind, from 0."""
        return tuple(k for k, of in enumerate(self.of_chamber) if of == kind)

    def by_chamber(self, by_kind: Sequence[Of]) -> tuple[Of, ...]:
        """Values of the kinds, one for each chamber."""
        return tuple(by_kind[of] for of in self.of_chamber)


def kinds(pump: PumpDescription) -> Kinds:
    """The kinds of a pump's chambers; equal single parts are of one kind."""
    own = [pump.of_chamber(number) for number in range(1, pump.pump.pistons + 1)]
    found = [one for k, one in enumerate(own) if one not in own[:k]]
    found.sort(key=own.count, reverse=True)
    of_chamber = (0,) if len(found) == 1 else tuple(found.index(one) for one in own)
    return Kinds(tuple(found), of_chamber)
