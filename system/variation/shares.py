"""Shares of the dimensions in the scatter of a series, and the gain by a tighter tolerance.

A quadratic surface is fitted to the pumps of the series; Sobol' shares (2001) are those of the surface, by the
estimators of `scipy.stats.sobol_indices` (Saltelli et al. 2010). On the pumps themselves the same shares would need
some hundred times as many.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

import numpy as np
from scipy.special import ndtri
from scipy.stats import qmc, sobol_indices

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.variation.sampling import Series, groups, score_columns, score_count, values_of
from system.variation.scatter import CONFIDENCE, QUANTILES, Interval

SAMPLES = 2**13
"""Rows of either sample of a Sobol' estimate, a power of two; a quarter of them in each repeat."""
REPEATS = 40
"""Series drawn anew from the pumps (bootstrap) for the intervals."""
PER_TERM = 3
"""Pumps for each coefficient of the surface, at least."""
FOLDS = 5
TIGHTER = 2.0 / 3.0
"""A tolerance tightened by a third."""


@dataclass(frozen=True)
class Surface:
    """Quadratic surface of M numbers over k dimensions: coefficients (T, M) of products of standardised dimensions.

    held_out: share of each number's variance (M,) that it predicts on pumps that it was not fitted to.
    """

    centre: Array
    scale: Array
    coefficients: Array
    held_out: Array

    def at(self, values: Array) -> Array:
        """Return the numbers (N, M) of dimensions (N, k)."""
        return np.asarray(_terms((values - self.centre) / self.scale) @ self.coefficients)


@dataclass(frozen=True)
class Share:
    """Share of a group of dimensions in a number's variance: alone (first), and with all its interactions (total).

    width, mean: change of the 5 to 95 % width and of the mean of the number with the tolerances of the group tightened
    by a third. names: of the group, one unless dimensions are correlated.
    """

    names: tuple[str, ...]
    first: Interval
    total: Interval
    width: Interval
    mean: Interval


def pumps_needed(dimensions: int) -> int:
    """Return the least number of pumps from which a surface over so many dimensions follows."""
    return PER_TERM * (dimensions + 1) * (dimensions + 2) // 2


def fitted_surface(values: Array, numbers: Array) -> Surface:
    """Return the surface through numbers (N, M) at dimensions (N, k). Raises InputError for too few pumps."""
    needed = pumps_needed(values.shape[1])
    if len(values) < needed:
        raise InputError("series", f"{len(values)} pumps with a result", f"{needed} at least for a quadratic surface")
    centre, scale = values.mean(axis=0), values.std(axis=0)
    terms = _terms((values - centre) / scale)
    folds, missed = np.arange(len(values)) % FOLDS, np.zeros(numbers.shape[1])
    for fold in range(FOLDS):
        kept = folds != fold
        own = np.linalg.lstsq(terms[kept], numbers[kept])[0]
        missed += np.sum((numbers[~kept] - terms[~kept] @ own) ** 2, axis=0)
    variance = np.sum((numbers - numbers.mean(axis=0)) ** 2, axis=0)
    held_out = 1.0 - np.divide(missed, variance, out=np.ones_like(missed), where=variance > 0.0)
    return Surface(centre, scale, np.asarray(np.linalg.lstsq(terms, numbers)[0], dtype=float), held_out)


def _terms(standard: Array) -> Array:
    """Return 1, all dimensions and all their products in pairs, (N, T)."""
    pairs = combinations_with_replacement(range(standard.shape[1]), 2)
    products = [standard[:, i] * standard[:, j] for i, j in pairs]
    return np.column_stack([np.ones(len(standard)), standard, *products])


def shares(series: Series, numbers: Array, seed: int) -> tuple[Surface, list[list[Share]]]:
    """Return the surface of the numbers (N, M) of a series, and of each number the shares by group.

    Intervals cover the uncertainty by the pumps drawn and by the estimator's own sample, by REPEATS of both. Correlated
    dimensions count as one group: their variance cannot be separated.
    """
    surface, random = fitted_surface(series.values, numbers), np.random.default_rng(seed)
    best, repeats = _estimates(series, surface, SAMPLES, random), []
    for _ in range(REPEATS):
        rows = random.integers(0, len(numbers), len(numbers))
        terms = _terms((series.values[rows] - surface.centre) / surface.scale)
        again = replace(surface, coefficients=np.asarray(np.linalg.lstsq(terms, numbers[rows])[0], dtype=float))
        repeats.append(_estimates(series, again, SAMPLES // 4, random))
    names = [tuple(series.drawing.names[k] for k in group) for group in groups(series.drawing)]
    low, high = np.quantile(np.array(repeats), (0.5 - 0.5 * CONFIDENCE, 0.5 + 0.5 * CONFIDENCE), axis=0)
    return surface, [
        [Share(own, *(_interval(best[:, m, g], low[:, m, g], high[:, m, g]))) for g, own in enumerate(names)]
        for m in range(numbers.shape[1])
    ]


def _interval(best: Array, low: Array, high: Array) -> Sequence[Interval]:
    """Return first, total, width, mean."""
    return [
        Interval(*map(float, ends)) for ends in zip(best, np.minimum(low, best), np.maximum(high, best), strict=True)
    ]


def _estimates(series: Series, surface: Surface, count: int, random: np.random.Generator) -> Array:
    """Return (4, M, groups): first and total share, change of width and of mean by a tighter tolerance."""
    drawing, together = series.drawing, groups(series.drawing)
    own = score_count(drawing)
    cube = qmc.Sobol(2 * own, rng=random).random(count)
    scores = np.split(ndtri(np.clip(cube, 1e-12, 1.0 - 1e-12)), 2, axis=1)
    values = [values_of(drawing, own) for own in scores]
    of_a, of_b = (surface.at(own) for own in values)
    middle, mixed, tighter = values[0].mean(axis=0), [], []
    for group in together:
        swapped, narrow = scores[0].copy(), values[0].copy()
        columns = [column for own in group for column in score_columns(drawing, own)]
        swapped[:, columns] = scores[1][:, columns]
        narrow[:, group] = middle[group] + TIGHTER * (narrow[:, group] - middle[group])
        mixed.append(surface.at(values_of(drawing, swapped)))
        tighter.append(surface.at(narrow))
    first, total = _sobol(of_a, of_b, mixed)
    change = [(_width(one) - _width(of_a), one.mean(axis=0) - of_a.mean(axis=0)) for one in tighter]
    width, mean = (np.stack([one[k] for one in change], axis=-1) for k in range(2))
    return np.stack([first, total, width, mean])


def _sobol(of_a: Array, of_b: Array, mixed: Sequence[Array]) -> tuple[Array, Array]:
    """Return first and total shares (M, groups) of numbers (n, M) of two samples and of the mixed ones, one a group.

    A number without scatter has shares of zero.
    """
    first, total = (np.zeros((of_a.shape[1], len(mixed))) for _ in range(2))
    vary = np.ptp(of_a, axis=0) > 1e-12 * np.abs(of_a).max(axis=0)
    if np.any(vary):
        own = {"f_A": of_a[:, vary].T, "f_B": of_b[:, vary].T, "f_AB": np.stack([one[:, vary].T for one in mixed])}
        found = sobol_indices(func=own, n=len(of_a))
        first[vary], total[vary] = (np.reshape(one, (-1, len(mixed))) for one in (found.first_order, found.total_order))
    return first, total


def _width(numbers: Array) -> Array:
    return np.asarray(np.diff(np.quantile(numbers, (QUANTILES[0], QUANTILES[-1]), axis=0), axis=0)[0])
