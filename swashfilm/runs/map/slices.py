"""Slices of an operating map: the two axes of a picture, the levels of all others, and their words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.shown import titled
from system.maps.data import MapData
from system.maps.interpolation import weights
from system.maps.plan import MapInput, reading_levels

FINE = 25
"""Number of points along an axis for drawing contours."""
MOST_PANELS = 6
"""Largest number of levels of a further axis that are drawn."""
AT_LAST = (MapInput.SPEED, MapInput.PRESSURE, MapInput.RATIO)
"""Inputs that a slice holds at their last level; it holds the others at their first."""


@dataclass(frozen=True)
class Slice:
    """Two axes of a map by their index, and the constant level of each other axis."""

    across: int
    up: int
    held: tuple[int, ...]

    def of(self, values: Array) -> Array:
        """Return the values on the slice, (levels up, levels across)."""
        index: list[Any] = list(self.held)
        index[self.across] = index[self.up] = slice(None)
        found = np.asarray(values[tuple(index)])
        return found if self.up < self.across else found.T


def main_slice(data: MapData) -> Slice | None:
    """Return the slice over the first two inputs with several levels, speed before pressure before displacement.

    None where fewer than two inputs have several levels.
    """
    wide = varied(data)
    return Slice(_place(data, wide[0]), _place(data, wide[1]), held_levels(data)) if len(wide) > 1 else None


def further_slices(data: MapData, piece: Slice) -> tuple[Slice, ...]:
    """Return a slice for each other level of the next input with several levels; at most MOST_PANELS - 1, evenly."""
    third = third_input(data)
    if third is None:
        return ()
    place = _place(data, third)
    others = [level for level in range(data.shape[place]) if level != piece.held[place]]
    count = min(len(others), MOST_PANELS - 1)
    chosen = [others[k] for k in np.unique(np.linspace(0, len(others) - 1, count).round().astype(int))]
    return tuple(
        Slice(piece.across, piece.up, (*piece.held[:place], level, *piece.held[place + 1 :])) for level in chosen
    )


def third_input(data: MapData) -> MapInput | None:
    """Return the third input with several levels, or None."""
    return next(iter(varied(data)[2:]), None)


def varied(data: MapData) -> list[MapInput]:
    """Return the inputs with several levels."""
    return [axis.input for axis in data.axes if len(axis.values) > 1]


def held_levels(data: MapData) -> tuple[int, ...]:
    """Return the level of each input at which a slice holds it."""
    return tuple(len(axis.values) - 1 if axis.input in AT_LAST else 0 for axis in data.axes)


def held_words(data: MapData, piece: Slice) -> str:
    """Return the constant inputs of a slice that have several levels in the map, `at displacement ratio 1, ..`."""
    levels = {
        axis.input: axis.values[level]
        for k, (axis, level) in enumerate(zip(data.axes, piece.held, strict=True))
        if k not in (piece.across, piece.up) and len(axis.values) > 1
    }
    return f"at {place_words(levels)}" if levels else ""


def place_words(levels: Mapping[MapInput, float]) -> str:
    """Return levels of inputs in words: `1000 r/min, 30 MPa, full displacement`."""
    return ", ".join(_level_words(given, value) for given, value in levels.items()) or "the one point"


def _level_words(given: MapInput, value: float) -> str:
    if given.dimension is None:
        return "full displacement" if value == 1.0 else f"{100.0 * value:.4g} % displacement"
    shown = given.text(value)
    match given:
        case MapInput.TEMPERATURE:
            return f"oil of {shown}"
        case MapInput.INLET_PRESSURE:
            return f"{shown} at the inlet"
        case _:
            return shown


def place_of(data: MapData, index: tuple[int, ...]) -> str:
    """Return a point of the map in words, inputs with several levels only."""
    wide = varied(data)
    levels = {axis.input: axis.values[k] for axis, k in zip(data.axes, index, strict=True) if axis.input in wide}
    return place_words(levels)


def _place(data: MapData, given: MapInput) -> int:
    return [axis.input for axis in data.axes].index(given)


def grids(data: MapData, piece: Slice) -> tuple[Array, Array]:
    """Return both inputs of a slice at its points, in the units that people read, (levels up, levels across)."""
    across, up = (reading_levels(data.axes[place]) for place in (piece.across, piece.up))
    x, y = np.meshgrid(across, up)
    return x, y


def shown(data: MapData, piece: Slice, field: Array) -> Array:
    """Return a field of a slice at FINE points along each axis; at its own levels where a result is missing."""
    if not np.all(np.isfinite(field)):
        return np.ma.masked_invalid(field)
    across, up = (
        weights(axis, np.linspace(axis.values[0], axis.values[-1], FINE))
        for axis in (data.axes[place] for place in (piece.across, piece.up))
    )
    return np.asarray(up @ field @ across.T)


def axis_label(data: MapData, place: int) -> str:
    """Return the name of an axis with its unit."""
    axis = data.axes[place]
    return titled(axis.input.words, axis.input.shown.unit)
