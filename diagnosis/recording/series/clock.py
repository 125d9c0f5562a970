"""Clock of a series: a rising time from stamps that are missing, repeat, fall or jump."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.recording.series.stretches import Mask
from diagnosis.recording.tables.table import TableFault
from reynolds.numerics.arrays import Array

PAUSE = 5.0  # usual steps without a row from which a pause is reported, and that are left where the clock jumps
LEAP = 3.0  # times the recorded duration: a longer pause is a clock that was set forward
FALLS, FALL_SHARE = 3, 0.01  # of a clock that was set back; rows in no order fall more often
FEW = 8  # steps on either side of a jump for the usual one
NAMED = 3  # places of one kind listed in a note
UNITS = (60.0, 1e3, 3600.0)  # of two units of time, one over the other
SERIAL, SHORT = (3e4, 6e4), 1e-2  # of days since 1900: those of 1982 to 2064; steps of a quarter of an hour, as days
SAME = 0.05  # of such a ratio, to which a change of the usual step agrees


@dataclass(frozen=True)
class ClockedSeries:
    """Time (T,) in s that rises from row to row, readings (T, C) at it, and notes on the clock as text."""

    time: Array
    readings: Array
    notes: tuple[str, ...]


def clocked(time: Array, readings: Array) -> ClockedSeries:
    """The rows of a series in a time that rises: stamps (R,) in s, readings (R, C).

    Rows without a stamp are left out, rows of one stamp are averaged. Where the clock is set back, or forward by more
    than `LEAP` times the recorded duration, the rows behind follow after `PAUSE` usual steps. Raises TableFault for a
    column without times, for times in no order, and for a clock that jumps and then counts in another unit.
    """
    expected = "times that rise from row to row: numbers, or stamps such as '2024-05-02 08:15:30' and '08:15:30'"
    known = np.flatnonzero(np.isfinite(time))
    steps = np.diff(time[known])
    if not np.any(steps > 0.0):
        falls_alone = bool(np.any(steps < 0.0))
        found = "no time that rises" if len(known) else "no number in the column of time"
        raise TableFault(found, expected, "rows sorted by their time" if falls_alone else "")
    usual = float(np.median(steps[steps > 0.0]))
    if usual < SHORT and SERIAL[0] < time[known[0]] < SERIAL[1]:
        raise TableFault(f"times from {time[known[0]]:.6g} s in steps of {usual:.3g} s, as days of a spreadsheet have",
                         expected, "time.unit = 'd'")  # fmt: skip
    falls, pauses = steps < 0.0, steps > PAUSE * usual
    if falls.sum() > max(FALLS, FALL_SHARE * len(steps)):
        row = int(known[np.argmax(falls) + 1]) + 1
        raise TableFault(f"time that does not rise at row {row} and at {int(falls.sum()) - 1} more", expected)
    _refuse_other_unit(steps, known, falls | pauses)
    recorded = float(steps[~falls & ~pauses].sum())
    leaps = pauses & (steps > LEAP * recorded)
    shift = np.cumsum(np.where(falls | leaps, PAUSE * usual - steps, 0.0))
    risen = time[known] + np.concatenate([[0.0], shift])
    notes = tuple(_notes(time[known], known, falls, leaps, pauses & ~leaps, len(time)))
    return ClockedSeries(*_averaged(risen, readings[known]), notes)


def _refuse_other_unit(steps: Array, rows: NDArray[np.int64], jumps: Mask) -> None:
    """Raise TableFault where the usual step behind a jump of the clock is that before it in another unit of time."""
    inner = np.flatnonzero(jumps[1:-1]) + 1
    if not inner.size:
        return
    one, other = _usual_until(steps)[inner - 1], _usual_until(steps[::-1])[::-1][inner + 1]
    ratio = np.maximum(one, other) / np.minimum(one, other)
    changed = np.any([np.abs(ratio / unit - 1.0) < SAME for unit in UNITS], axis=0)
    if changed.any():
        at = int(np.argmax(changed))
        row = int(rows[inner[at] + 1]) + 1
        found = f"time steps of {one[at]:.3g} s up to row {row - 1} and of {other[at]:.3g} s from row {row} on"
        raise TableFault(found, "one unit of time in all rows")


def _usual_until(steps: Array) -> Array:
    """Median of the positive steps from the first to each (n,); nan where they are fewer than `FEW`."""
    positive = pd.Series(np.where(steps > 0.0, steps, np.nan))
    return np.asarray(positive.expanding(FEW).median(), dtype=float)


def _averaged(time: Array, readings: Array) -> tuple[Array, Array]:
    """Distinct times, and the means of the readings at each; a single reading to the last bit."""
    first = np.concatenate([[True], np.diff(time) > 0.0])
    if first.all():
        return time, readings
    place = np.cumsum(first) - 1
    known = np.isfinite(readings)
    numbers, sums = (np.zeros((int(place[-1]) + 1, readings.shape[1])) for _ in range(2))
    np.add.at(numbers, place, known)
    np.add.at(sums, place, np.where(known, readings, 0.0))
    return time[first], np.divide(sums, numbers, out=np.full_like(sums, np.nan), where=numbers > 0)


def _notes(time: Array, rows: NDArray[np.int64], falls: Mask, leaps: Mask, pauses: Mask, count: int) -> Iterator[str]:
    if len(rows) < count:
        yield f"rows without a time: {count - len(rows)}, left out"
    repeated = int(np.sum(np.diff(time) == 0.0))
    if repeated:
        yield f"rows that repeat the time of the row before: {repeated}, averaged with it"
    follows = f"what follows is taken as {PAUSE:g} steps later"
    for marks, words, more in ((falls, "the clock falls", follows), (leaps, "the clock leaps", follows)):
        places = [f"from {time[k]:g} s to {time[k + 1]:g} s at row {rows[k + 1] + 1}" for k in np.flatnonzero(marks)]
        if places:
            yield f"{words} {_listed(places)}: {more}"
    places = [f"from {time[k]:g} s to {time[k + 1]:g} s" for k in np.flatnonzero(pauses)]
    if places:
        yield f"nothing is recorded {_listed(places)}"


def _listed(places: Sequence[str]) -> str:
    """The first places, and the number of the others."""
    rest = f" and {len(places) - NAMED} times more" if len(places) > NAMED else ""
    return ", ".join(places[:NAMED]) + rest
