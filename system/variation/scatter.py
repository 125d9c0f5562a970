"""Scatter of a series: quantiles and shares of pumps beyond a limit, with their sampling error."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from scipy.special import betaincinv
from scipy.stats import binom

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.variation.measures import Measure

QUANTILES = (0.05, 0.5, 0.95)
CONFIDENCE = 0.95
FEWEST = 100
"""Pumps from which 5 and 95 % follow."""


@dataclass(frozen=True)
class Interval:
    """A number and the interval that holds it with CONFIDENCE."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Scatter:
    """Scatter of a number over a series: mean, standard deviation, quantiles of QUANTILES with their intervals."""

    mean: float
    deviation: float
    quantiles: tuple[Interval, ...]

    @property
    def width(self) -> float:
        """From the 5 % to the 95 % quantile."""
        return self.quantiles[-1].value - self.quantiles[0].value


def scatter(values: Array) -> Scatter:
    """Return the scatter of independent numbers (N,). Raises InputError for fewer than FEWEST."""
    if len(values) < FEWEST:
        raise InputError("series", f"{len(values)} pumps with a result", f"{FEWEST} at least: 5 and 95 % are tails")
    return Scatter(
        float(np.mean(values)), float(np.std(values, ddof=1)), tuple(_quantile(values, p) for p in QUANTILES)
    )


def _quantile(values: Array, share: float) -> Interval:
    """Return a quantile with its distribution-free interval: between two order statistics (David, Nagaraja 2003)."""
    ordered, count = np.sort(values), len(values)
    ends = binom.ppf((0.5 * (1.0 - CONFIDENCE), 0.5 * (1.0 + CONFIDENCE)), count, share).astype(int)
    low, high = np.clip((ends[0] - 1, ends[1]), 0, count - 1)
    return Interval(float(np.quantile(ordered, share)), float(ordered[low]), float(ordered[high]))


class Bound(Enum):
    """Sense of a limit."""

    LEAST = ">="
    MOST = "<="


@dataclass(frozen=True)
class Limit:
    """A limit of a measure that every pump has to keep, SI; text: as it was stated."""

    measure: Measure
    bound: Bound
    value: float
    text: str

    def missed(self, values: Array) -> np.ndarray:
        """Return the mask of numbers (N,) that miss the limit."""
        return np.asarray(values < self.value if self.bound is Bound.LEAST else values > self.value)


def share_of(marked: np.ndarray) -> Interval:
    """Return the share of pumps that are marked (N,), with Clopper's and Pearson's interval (1934)."""
    count, found = len(marked), int(np.sum(marked))
    tail = 0.5 * (1.0 - CONFIDENCE)
    low = 0.0 if found == 0 else float(betaincinv(found, count - found + 1, tail))
    high = 1.0 if found == count else float(betaincinv(found + 1, count - found, 1.0 - tail))
    return Interval(found / count, low, high)
