"""Regions of the map: thirds of each axis with a significant mismatch, and the box of a channel's mismatch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from diagnosis.detect.contrasts import Contrasts
from diagnosis.study.map_axes import bound_text, inside
from diagnosis.thresholds import LocateLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

Places = NDArray[np.int64]
Marks = NDArray[np.bool_]


@dataclass(frozen=True)
class MapRegion:
    """Part of the map with a significant mismatch of a channel: bounds in SI by input name, contrast in sigma, text."""

    channel: ChannelName
    lower: Mapping[str, float]
    upper: Mapping[str, float]
    contrast: float
    text: str


def flagged(
    by_channel: Mapping[ChannelName, Contrasts], axes: Mapping[ChannelName, Array], thresholds: Thresholds
) -> tuple[MapRegion, ...]:
    """The significant thirds of all axes and channels, strongest first; `flag_rate` of them falsely, at most.

    Benjamini and Hochberg (1995), two-sided.
    """
    regions = [
        region
        for channel, found in by_channel.items()
        for axis, values in axes.items()
        for region in _thirds(channel, found, axis, values, thresholds.locate.least_points)
    ]
    ranked = sorted(regions, key=lambda region: -abs(region.contrast))
    p_values = np.array([2.0 * norm.sf(abs(region.contrast)) for region in ranked])
    allowed = thresholds.mismatch.flag_rate * np.arange(1, len(ranked) + 1) / max(len(ranked), 1)
    holds = np.flatnonzero(p_values <= allowed)
    return tuple(ranked[: holds[-1] + 1]) if holds.size else ()


def densest_region(
    channel: ChannelName, found: Contrasts, pattern: Array, axes: Mapping[ChannelName, Array], limits: LocateLimits
) -> MapRegion | None:
    """The box of half lines in which the channel's mismatch lies; None where it fills the map.

    Among the boxes whose z^2 is at least `region_share` of the best, those of fewest bounds; of these the greatest
    z^2. A free zero gives a box and its complement the same contrast: only boxes count inside which `pattern`
    (N,), the missing part in sigma, is the greater.
    """
    if not axes:
        return None
    sides = [_half_lines(axis, values, limits.edges) for axis, values in axes.items()]
    chosen, marks = _all_boxes(sides, axes)
    z = found.z(marks.astype(float))
    count = marks.sum(axis=0)
    within = pattern**2 @ marks >= np.mean(pattern**2) * count
    squares = np.where(within & (count >= limits.least_points), z**2, 0.0)
    bounds = (chosen > 0).sum(axis=0)
    good = squares >= limits.region_share * squares.max()
    best = int(np.argmax(np.where(good & (bounds == bounds[good].min()), squares, -1.0)))
    picked = [side[number] for side, number in zip(sides, chosen[:, best], strict=True)]
    return _region(channel, picked, float(z[best]))


def strongest_region(
    channel: ChannelName, found: Contrasts, pattern: Array, axes: Mapping[ChannelName, Array], limits: LocateLimits
) -> MapRegion | None:
    """The box of half lines nearest to the points with `pattern` (N,) at least `strong` of its maximum.

    pattern: addition of an explanation to the channel, in sigma. Nearest: points in both over points in one
    (Jaccard 1912), less `bound` for each bound. None where no box is nearer than the whole map.
    """
    if not axes:
        return None
    sides = [_half_lines(axis, values, limits.edges) for axis, values in axes.items()]
    chosen, marks = _all_boxes(sides, axes)
    strong = np.abs(pattern) >= limits.strong * np.abs(pattern).max()
    both = strong.astype(float) @ marks
    count = marks.sum(axis=0)
    overlap = both / (count + strong.sum() - both) - limits.bound * (chosen > 0).sum(axis=0)
    best = int(np.argmax(np.where(count >= limits.least_points, overlap, -np.inf)))
    picked = [side[number] for side, number in zip(sides, chosen[:, best], strict=True)]
    return _region(channel, picked, float(found.z(marks[:, best : best + 1].astype(float))[0]))


@dataclass(frozen=True)
class _HalfLine:
    """Part of an axis: all of it, below an edge, or above."""

    axis: ChannelName
    lower: float | None = None
    upper: float | None = None

    @property
    def bounded(self) -> bool:
        return self.lower is not None or self.upper is not None

    @property
    def text(self) -> str:
        return bound_text(self.axis, self.lower, self.upper)


def _region(channel: ChannelName, picked: Sequence[_HalfLine], contrast: float) -> MapRegion | None:
    """The box of one part of each axis, None where it is the whole map."""
    bounded = [part for part in picked if part.bounded]
    if not bounded:
        return None
    lower = {part.axis.value: part.lower for part in bounded if part.lower is not None}
    upper = {part.axis.value: part.upper for part in bounded if part.upper is not None}
    return MapRegion(channel, lower, upper, contrast, ", ".join(part.text for part in bounded))


def _half_lines(axis: ChannelName, values: Array, parts: int) -> list[_HalfLine]:
    edges = _edges(values, parts)
    return [
        _HalfLine(axis),
        *(_HalfLine(axis, lower=edge) for edge in edges),
        *(_HalfLine(axis, upper=edge) for edge in edges),
    ]


def _edges(values: Array, parts: int) -> list[float]:
    """Edges of `parts` with about the same number of points, each in the widest gap nearby."""
    ordered = np.sort(values)
    gaps = np.diff(ordered)
    reach = max(len(values) // (2 * parts), 1)
    found = set()
    for part in range(1, parts):
        middle = part * len(values) // parts
        first = max(middle - reach, 0)
        near = gaps[first : middle + reach]
        if near.size and near.max() > 0:
            at = first + int(near.argmax())
            found.add(float(0.5 * (ordered[at] + ordered[at + 1])))
    return sorted(found)


def _all_boxes(sides: list[list[_HalfLine]], axes: Mapping[ChannelName, Array]) -> tuple[Places, Marks]:
    """All combinations of half lines: numbers (axes, boxes), 0 for a whole axis, and points within (N, boxes)."""
    numbers = np.indices([len(side) for side in sides]).reshape(len(sides), -1)
    patterns = np.ones((len(next(iter(axes.values()))), numbers.shape[1]), dtype=bool)
    for side, number in zip(sides, numbers, strict=True):
        patterns &= np.stack([_holds(part, axes) for part in side], axis=1)[:, number]
    return numbers, patterns


def _holds(part: _HalfLine, axes: Mapping[ChannelName, Array]) -> Marks:
    lower = {} if part.lower is None else {part.axis.value: part.lower}
    upper = {} if part.upper is None else {part.axis.value: part.upper}
    return inside(axes, lower, upper)


def _thirds(
    channel: ChannelName, found: Contrasts, axis: ChannelName, values: Array, least_points: int
) -> list[MapRegion]:
    edges = np.linspace(values.min(), values.max(), 4)[1:3]
    regions = []
    for lower, upper in ((None, edges[0]), (edges[0], edges[1]), (edges[1], None)):
        low = {} if lower is None else {axis.value: float(lower)}
        high = {} if upper is None else {axis.value: float(upper)}
        within = inside({axis: values}, low, high)
        if within.sum() >= least_points:
            contrast = float(found.z(within.astype(float)[:, None])[0])
            text = bound_text(axis, low.get(axis.value), high.get(axis.value))
            regions.append(MapRegion(channel, low, high, contrast, text))
    return regions
