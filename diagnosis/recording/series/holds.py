"""Meters that hold: a reading that stays constant while other channels indicate a change.

A run of equal readings is suspect if it is improbable: m of T readings repeat each other T a^(m-1) times, a being the
share of equal pairs elsewhere. It is a hold if the channel would have moved there, by a smooth law of the other
channels and time, fitted to its other readings, beyond that law's own scatter and the step of the readings. At the
least or largest reading of a channel a hold is an end of its range.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.recording.series.meter_response import NORMAL, past_share, robust, smooth_columns
from diagnosis.recording.series.stretches import Mask, equal_runs, stretches, times
from diagnosis.recording.units import channel_unit, difference, difference_unit, reading
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, ChannelName
from system.inputs.units import Dimension

LEAST = 8  # readings of a hold
CHANCE = 1e-3  # probability of a run of that length anywhere in the series
ALIVE = 0.9  # share of equal pairs elsewhere, above which a channel is set rather than measured
ELSEWHERE = 0.2  # of the readings: least share of those that are no suspects
CLEAR = 5.0  # spreads of the law by which a channel would have moved
STEPS = 2.0  # of the readings, which a law need not follow
MOST = 0.8  # quantile of the departures in a run that decides
HELD = 0.5  # of its readings: least share of a channel in use
PER_TERM = 3  # samples a term of the law
SHOWN = 0.1  # of its range: least change of an input meanwhile to be listed


@dataclass(frozen=True)
class HeldReadings:
    """A column of a series that holds `level` (SI) in some stretches; departure: median of the law there less the
    level, SI; is_end: the level is the least or largest reading of the column.
    """

    column: int
    level: float
    found: tuple[slice, ...]
    departure: float
    is_end: bool


def without_holds(time: Array, readings: Array, names: Sequence[ChannelName]) -> tuple[Array, tuple[str, ...]]:
    """Readings (T, C) in SI without those that a meter or the whole logger holds, and notes; even times (T,) in s.

    The least readings of a flow meter below which the flow falls are its dead band and remain (`meter_response`).
    """
    notes, kept = [], readings.copy()
    frozen = suspects(equal_runs(readings)) if readings.shape[1] > 1 else ()
    if frozen:
        notes.append(f"every channel repeats its reading {times(time, frozen)}: the logger hangs, put aside")
        for stretch in frozen:
            kept[stretch.start + 1 : stretch.stop] = np.nan
    for one in held_readings(time, kept, names):
        is_flow = names[one.column].dimension is Dimension.VOLUME_FLOW
        if one.is_end and one.departure < 0.0 and is_flow:
            continue
        notes.append(_note(one, time, kept, names))
        for stretch in one.found:
            kept[stretch, one.column] = np.nan
    return kept, tuple(notes)


def held_readings(time: Array, readings: Array, names: Sequence[ChannelName]) -> Iterator[HeldReadings]:
    """Yield the holds in a series (T, C), SI, by column and level."""
    for k in range(len(names)):
        column = readings[:, k]
        found = suspects(equal_runs(column))
        if found:
            yield from _confirmed(k, found, time, readings)


def suspects(runs: Sequence[slice]) -> tuple[slice, ...]:
    """Runs of equal readings that are longer than probable; none for a channel that is set, not measured."""
    lengths = np.array([run.stop - run.start for run in runs])
    total, long = int(lengths.sum()), np.zeros(len(lengths), dtype=bool)
    while True:
        rows, count = int(lengths[~long].sum()), int((~long).sum())
        if rows < max(ELSEWHERE * total, LEAST):
            return ()
        alike = max(1.0 - count / rows, 1.0 / rows)
        by_chance = 1.0 + np.log(total / CHANCE) / -np.log(alike)
        longer = lengths >= max(LEAST, by_chance)
        if np.array_equal(longer, long) or (long & ~longer).any():
            break
        long = longer
    return tuple(run for run, one in zip(runs, long, strict=True) if one) if alike < ALIVE else ()


def _confirmed(k: int, found: Sequence[slice], time: Array, readings: Array) -> Iterator[HeldReadings]:
    """The suspects of a column from which the law departs, levels joined."""
    column, law = readings[:, k], _law_columns(k, time, readings)
    suspect = np.zeros(len(column), dtype=bool)
    for run in found:
        suspect[run] = True
    fitted = ~suspect & np.isfinite(column) & np.all(np.isfinite(law), axis=1)
    if fitted.sum() < PER_TERM * law.shape[1]:
        return
    size, residual = robust(law[fitted], column[fitted])
    magnitude = np.abs(residual)
    spread = max(NORMAL * float(np.median(magnitude)), float(np.quantile(magnitude, 0.9)) / 1.64)
    changes = np.abs(np.diff(column[np.isfinite(column)]))
    limit = CLEAR * spread + STEPS * float(changes[changes > 0.0].min(initial=np.inf))
    departures = law @ size - column
    held = [run for run in found if _departs(departures[run], limit)]
    for level in np.unique([column[run.start] for run in held]):
        stays = tuple(run for run in held if column[run.start] == level)
        middle = float(np.nanmedian(np.concatenate([departures[run] for run in stays])))
        end = np.nanmax(column) if middle > 0.0 else np.nanmin(column)
        is_end = bool(level == end)
        if is_end:
            stays = stretches(column == level)
        yield HeldReadings(k, float(level), stays, middle, is_end)


def _departs(departures: Array, limit: float) -> bool:
    known = np.abs(departures[np.isfinite(departures)])
    return len(known) >= LEAST and bool(np.quantile(known, MOST) > limit)


def _law_columns(k: int, time: Array, readings: Array) -> Array:
    """Terms (T, m) of the other channels, scaled, and of time (`smooth_columns`); nan in their gaps."""
    others = [
        column
        for j, column in enumerate(readings.T)
        if j != k and np.isfinite(column).mean() > HELD and np.nanmax(column) > np.nanmin(column)
    ]
    scaled = [2.0 * (column - np.nanmin(column)) / np.ptp(column[np.isfinite(column)]) - 1.0 for column in others]
    return smooth_columns(np.column_stack(scaled) if scaled else np.empty((len(time), 0)), past_share(time))


def _note(one: HeldReadings, time: Array, readings: Array, names: Sequence[ChannelName]) -> str:
    name = names[one.column]
    level = f"{reading(name, one.level):.4g} {channel_unit(name)}".removesuffix(" 1")
    when = times(time, one.found)
    if one.is_end:
        which = "most" if one.departure > 0.0 else "least"
        return f"{name.value} stays at {level}, the {which} that it reads, {when}: an end of its range, put aside"
    marks = np.zeros(len(time), dtype=bool)
    for stretch in one.found:
        marks[stretch] = True
    return f"{name.value} holds {level} {when}{_mover(one.column, marks, readings, names)}: put aside"


def _mover(column: int, marks: Mask, readings: Array, names: Sequence[ChannelName]) -> str:
    """The channel that changes by most of its range meanwhile, an input before an output, as text."""

    def moved(j: int, within: Mask) -> float:
        known = readings[within & np.isfinite(readings[:, j]), j]
        return float(np.ptp(known)) if len(known) else 0.0

    def share(j: int) -> float:
        return moved(j, marks) / max(moved(j, np.ones_like(marks)), 1e-300)

    others = [j for j in range(len(names)) if j != column]
    if not others:
        return ""
    inputs = [j for j in others if names[j] in INPUTS and share(j) > SHOWN]
    most = max(inputs or others, key=share)
    unit = difference_unit(names[most]).removesuffix("1")
    return f" while {names[most].value} moves by {difference(names[most], moved(most, marks)):.3g} {unit}".rstrip()
