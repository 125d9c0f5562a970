"""Channels whose unit changes at one row: a level that jumps by the ratio of two units while others do not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.recording.breaks.level_step import LEFT, LevelStep, law_of, level_step
from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.units import OTHER_UNITS
from reynolds.numerics.arrays import Array
from system.inputs.sections.values import PURE_UNITS
from system.inputs.units import Dimension, unit_scale

AGREES = 1.5  # times the residual of a free step
POSITIVE = 0.98  # of readings whose logarithm is taken


@dataclass(frozen=True)
class UnitChange:
    """A channel with another unit than the stated one in one part: rows from `row` on (behind), or those before."""

    channel: ChannelForm
    row: int
    unit: str
    behind: bool

    @property
    def text(self) -> str:
        """Rows, counted from 1, and both units."""
        part, rest = f"from row {self.row + 1} on", f"up to row {self.row}"
        if not self.behind:
            part, rest = rest, part
        return f"readings {part} that fit '{self.unit}', {rest} '{self.channel.unit}'"


def unit_changes(readings: Array, channels: Sequence[ChannelForm]) -> Iterator[UnitChange]:
    """Yield the channel whose unit changes: readings (N, C) in SI as stated, rows in the order of their table.

    The step of its logarithm (of a temperature the step itself) is certain, and conversion of one part from another
    unit (`OTHER_UNITS`) removes it. Of several the one whose law improves most: the others follow it.
    """
    found = [change for k in range(len(channels)) for change in _changes(k, readings, channels)]
    if found:
        yield min(found, key=lambda each: each[0])[1]


def _changes(k: int, readings: Array, channels: Sequence[ChannelForm]) -> Iterator[tuple[float, UnitChange]]:
    """(remaining share of squares, change) of the units that correct a channel."""
    form = channels[k]
    dimension = form.name.dimension
    law = law_of(readings, np.flatnonzero(np.arange(len(channels)) != k))
    numbers = (readings[:, k] - form.offset) / form.factor
    step = level_step(_level(form.factor * numbers + _zero(form), dimension), law)
    if step is None or not step.is_certain:
        return
    scales = _scales(dimension)
    for unit, (factor, offset) in scales.items():
        if (factor, offset) == scales.get(form.unit):
            continue
        zero = offset if dimension is Dimension.TEMPERATURE else _zero(form)
        for behind in (True, False):
            part = (np.arange(len(numbers)) >= step.row) == behind
            mended = np.where(part, factor * numbers + zero, form.factor * numbers + _zero(form))
            left = _left(_level(mended, dimension), law, step)
            if left is not None and left <= min(LEFT * step.of_law, AGREES * step.squares):
                yield left / step.of_law, UnitChange(form, step.row, unit, behind)


def _scales(dimension: Dimension | None) -> Mapping[str, tuple[float, float]]:
    """(factor, offset) of the units of a dimension, of a pure number its own; none of a dimension without others."""
    if dimension is None:
        return {unit: (factor, 0.0) for unit, factor in PURE_UNITS.items()}
    return {unit: unit_scale(unit, dimension) for unit in OTHER_UNITS.get(dimension, ())}


def _zero(form: ChannelForm) -> float:
    """Zero of the unit: of a pressure none, since its logarithm counts from the zero of the file."""
    return form.offset if form.name.dimension is Dimension.TEMPERATURE else 0.0


def _level(values: Array, dimension: Dimension | None) -> Array:
    """Logarithm (N,) of readings, nan where these are not positive; all nan where many are not; temperatures in K."""
    if dimension is Dimension.TEMPERATURE:
        return values
    known = np.isfinite(values)
    positive = known & (np.where(known, values, -1.0) > 0.0)
    if not known.any() or positive.sum() < POSITIVE * known.sum():
        return np.full(len(values), np.nan)
    return np.log(np.where(positive, values, np.nan))


def _left(values: Array, law: Array, step: LevelStep) -> float | None:
    """Sum of squares of corrected values about the law alone; None where a certain step remains at the same row."""
    again = level_step(values, law)
    if again is None:
        return None
    remains = abs(again.row - step.row) <= 1 and abs(again.size) > 0.2 * abs(step.size)
    return None if remains else again.of_law
