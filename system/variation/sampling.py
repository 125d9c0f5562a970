"""Pumps of a series: dimensions drawn from their distributions, correlated, fits paired by class."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

from reynolds.numerics.arrays import Array
from system.description.drawn import SIGMAS, Drawing, Drawn, DrawnFit
from system.description.keys import pump_keys
from system.description.pump import PumpDescription
from system.description.tolerance import Shape
from system.pump_file.file import Variant

FILMS = ("piston.radial_clearance", "slipper.film_thickness")
"""Films whose leakage goes with their cube, one for each piston of a pump."""


@dataclass(frozen=True)
class Series:
    """Pumps of a series: `values` (N, k) in SI of the k dimensions of a drawing, in the order of its names."""

    drawing: Drawing
    values: Array

    def variants(self, pump: PumpDescription) -> Iterator[Variant]:
        """Yield each pump's values by path; dimensions of several paths change them in proportion."""
        known = pump_keys(pump)
        for row in self.values:
            found: dict[str, float] = {}
            for one, value in zip(self.drawing.members, row, strict=True):
                first = known[one.keys[0]].value
                found |= {
                    path: float(value * (known[path].value / first if len(one.keys) > 1 else 1.0)) for path in one.keys
                }
            yield tuple(found.items())


def drawn_series(drawing: Drawing, count: int, seed: int) -> Series:
    """Return `count` independent pumps of a series, drawn by a generator of this seed."""
    scores = np.random.default_rng(seed).standard_normal((count, score_count(drawing)))
    return Series(drawing, values_of(drawing, scores))


def score_count(drawing: Drawing) -> int:
    """Return the number of independent normal scores of one pump: of each part one, of a fit two."""
    return sum(_widths(drawing))


def score_columns(drawing: Drawing, column: int) -> list[int]:
    """Return the columns of the scores from which a column of the values is made, its correlation left out."""
    widths = _widths(drawing)
    first = sum(widths[:column])
    return list(range(first, first + widths[column]))


def _widths(drawing: Drawing) -> list[int]:
    return [one.parts * one.scores for one in drawing.members]


def values_of(drawing: Drawing, scores: Array) -> Array:
    """Return the dimensions (N, k) of independent normal scores (N, `score_count`).

    Correlated dimensions are of correlated normal scores, each then of its own distribution (a Gaussian copula). Of
    several parts the value is that of `alike`.
    """
    scores, own = scores.copy(), len(drawing.dimensions)
    if own:
        first = [score_columns(drawing, column)[0] for column in range(own)]
        scores[:, first] = scores[:, first] @ np.linalg.cholesky(drawing.matrix()).T
    columns = []
    for column, one in enumerate(drawing.members):
        each = np.split(scores[:, score_columns(drawing, column)], one.parts, axis=1)
        parts = [_value(one, part[:, 0]) if isinstance(one, Drawn) else fit_values(one, part) for part in each]
        columns.append(alike(one.name, np.stack(parts, axis=1)))
    return np.column_stack(columns)


def alike(path: str, values: Array) -> Array:
    """Return the value (N,) of equal parts that replaces parts of values (N, parts): their mean.

    Of a film or clearance the cube root of the mean cube, by which the parts leak the same. Where a part has no size,
    0 or below, its value: no pump has it.
    """
    least = values.min(axis=1)
    mean = np.cbrt(np.mean(values**3, axis=1)) if path in FILMS else values.mean(axis=1)
    return np.where((least <= 0.0) & (values.shape[1] > 1), least, mean)


def _value(drawn: Drawn, score: Array) -> Array:
    if drawn.shape is not Shape.NORMAL:
        return quantile(drawn.shape, drawn.least, drawn.most, drawn.peak, ndtr(score))
    if np.isfinite(drawn.least):
        low, high = (ndtr(_score(drawn, end)) for end in (drawn.least, drawn.most))
        score = ndtri(low + (high - low) * ndtr(score))
    if drawn.logarithmic:
        return np.asarray(drawn.middle * np.exp(drawn.sigma / drawn.middle * score))
    return np.asarray(drawn.middle + drawn.sigma * score)


def _score(drawn: Drawn, value: float) -> float:
    """Return the standard score of a value of a normal or log-normal dimension."""
    if drawn.logarithmic:
        return float(np.log(value / drawn.middle) / (drawn.sigma / drawn.middle))
    return (value - drawn.middle) / drawn.sigma


def quantile(shape: Shape, least: float, most: float, peak: float, share: Array) -> Array:
    """Return the values (N,) below which a share (N,) of a distribution lies.

    Normal: limits are SIGMAS standard deviations from the middle; peak: of a triangle.
    """
    width = most - least
    match shape:
        case Shape.NORMAL:
            return np.asarray(0.5 * (least + most) + 0.5 * width / SIGMAS * ndtri(share))
        case Shape.UNIFORM:
            return np.asarray(least + width * share)
    rising = (peak - least) / width
    low = least + width * np.sqrt(share * rising)
    return np.asarray(np.where(share < rising, low, most - width * np.sqrt((1.0 - share) * (1.0 - rising))))


def below(shape: Shape, least: float, most: float, value: Array) -> Array:
    """Return the share (N,) of a distribution below values (N,), a triangle's peak in the middle."""
    middle, half = 0.5 * (least + most), 0.5 * (most - least)
    place = np.clip((value - middle) / half, -1.0, 1.0)
    match shape:
        case Shape.NORMAL:
            return np.asarray(ndtr(SIGMAS * (value - middle) / half))
        case Shape.UNIFORM:
            return np.asarray(0.5 * (1.0 + place))
    return np.asarray(np.where(place < 0.0, 0.5 * (1.0 + place) ** 2, 1.0 - 0.5 * (1.0 - place) ** 2))


def fit_values(fit: DrawnFit, scores: Array) -> Array:
    """Return radial clearances (N,) in m of scores (N, 2): holes, and shafts of the same class.

    Classes divide either tolerance into equal widths; diameters beyond the limits belong to the outer ones. A shaft of
    a class is one of the series whose diameter lies in it.
    """
    hole = quantile(fit.shape, *fit.hole, 0.5 * sum(fit.hole), ndtr(scores[:, 0]))
    edges = np.linspace(*fit.hole, fit.classes + 1)[1:-1]
    number = np.searchsorted(edges, hole)
    bounds = np.linspace(*fit.shaft, fit.classes + 1)
    ends = below(fit.shape, *fit.shaft, bounds)
    ends[0], ends[-1] = 0.0, 1.0
    share = ends[number] + (ends[number + 1] - ends[number]) * ndtr(scores[:, 1])
    shaft = quantile(fit.shape, *fit.shaft, 0.5 * sum(fit.shaft), share)
    return np.asarray(0.5 * (hole - shaft))


def groups(drawing: Drawing) -> list[list[int]]:
    """Return the columns of the values that scatter together, group by group: each correlated set, each other alone."""
    left, found = set(range(len(drawing.names))), []
    at = {name: place for place, name in enumerate(drawing.names)}
    pairs = [(at[one], at[other]) for (one, other), value in drawing.correlation.items() if value != 0.0]
    for first in range(len(drawing.names)):
        if first not in left:
            continue
        group = {first}
        while more := {b for pair in pairs for a, b in (pair, pair[::-1]) if a in group and b not in group}:
            group |= more
        left -= group
        found.append(sorted(group))
    return found


def part_of(drawing: Drawing, names: Collection[str]) -> Drawing:
    """Return the drawing of some of its dimensions; the others do not scatter."""
    dimensions = tuple(one for one in drawing.dimensions if one.name in names)
    fits = tuple(one for one in drawing.fits if one.name in names)
    correlation = {pair: value for pair, value in drawing.correlation.items() if set(pair) <= set(names)}
    return Drawing(dimensions, fits, correlation, drawing.unused)
