"""Draws of one case: the same for the same kind and number, independent of other changes."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from typing import TypeVar

import numpy as np

Choice = TypeVar("Choice")


class Draw:
    """Random numbers of a case."""

    def __init__(self, kind: str, number: int):
        self._rng = np.random.default_rng([zlib.crc32(kind.encode()), number])

    def chance(self, share: float) -> bool:
        """True in a `share` of the cases."""
        return bool(self._rng.random() < share)

    def sign(self) -> int:
        """One or minus one."""
        return 1 if self.chance(0.5) else -1

    def even(self, least: float, most: float) -> float:
        """A number of three digits, evenly between two bounds."""
        return _short(self._rng.uniform(least, most))

    def wide(self, least: float, most: float) -> float:
        """A number of three digits whose logarithm lies evenly between those of two bounds."""
        return _short(float(np.exp(self._rng.uniform(np.log(least), np.log(most)))))

    def whole(self, least: int, most: int) -> int:
        """A whole number, both bounds included."""
        return int(self._rng.integers(least, most + 1))

    def one_of(self, choices: Sequence[Choice]) -> Choice:
        """One of some choices."""
        return choices[int(self._rng.integers(len(choices)))]


def _short(value: float) -> float:
    return float(f"{value:.3g}")
