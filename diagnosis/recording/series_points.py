"""Steady points out of a time series: common raster, steady stretches, one mean each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.form import SeriesSection
from diagnosis.recording.steadiness import SteadyRule, effective_number, steady_stretches
from diagnosis.recording.tables.table import TableFault
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS

SETTLING = 3.0  # lags of a channel left out at the beginning of a stretch


@dataclass(frozen=True)
class SeriesPoints:
    """Means (N, C) of C channels over N steady stretches, standard error of each, samples behind it, and times.

    hours: (N,), middle of the stretch, h from the first; note: the procedure as text.
    """

    means: Array
    errors: Array
    effective: Array
    hours: Array
    note: str


def series_points(form: SeriesSection, time: Array, readings: Array, channels: Sequence[ChannelForm]) -> SeriesPoints:
    """Return the steady points of a series: time (T,) in s, readings (T, C) in SI, columns as `channels`.

    `SteadyRule` of the measured inputs decides which stretches are steady. The first `SETTLING` times the largest lag
    of a stretch are left out. Raises TableFault for time that does not rise and a series without a steady stretch.
    """
    time, readings, raster = on_raster(time, readings, form.raster or 0.0)
    stated = form.steady
    rule = SteadyRule(round(stated.window / raster), stated.slope)
    if rule.samples < 8:
        raise TableFault(
            f"a window of {rule.samples} samples of {raster:g} s", "at least 8 samples a window", f'"{8 * raster:g} s"'
        )
    inputs = [k for k, channel in enumerate(channels) if channel.name in INPUTS] or list(range(len(channels)))
    sigma = np.array([channels[k].sigma or 0.0 for k in inputs])
    settling = int(np.ceil(SETTLING * max(channel.lag or 0.0 for channel in channels) / raster))
    steady = [slice(s.start + settling, s.stop) for s in steady_stretches(readings[:, inputs], sigma, rule)]
    steady = [s for s in steady if s.stop - s.start >= rule.samples // 2]
    if not steady:
        names = ", ".join(channels[k].name.value for k in inputs)
        found = f"no stretch of {stated.window:g} s in which {names} are steady"
        raise TableFault(found, "steady stretches", "a shorter steady.window or a larger steady.slope")
    means = np.array([np.nanmean(readings[s], axis=0) for s in steady])
    worth = np.array([[_worth(column) for column in readings[s].T] for s in steady])
    spread = np.array([np.nanstd(readings[s], axis=0, ddof=1) for s in steady])
    middle = np.array([0.5 * (time[s.start] + time[s.stop - 1]) for s in steady])
    share = sum(s.stop - s.start for s in steady) / len(time)
    note = (
        f"{len(steady)} steady points from {share:.0%} of the series: windows of {stated.window:g} s in which "
        f"slope and bow of every input stay below {stated.slope:g} standard errors or below its repeatability"
    )
    return SeriesPoints(means, spread / np.sqrt(worth), np.min(worth, axis=1), (middle - middle[0]) / 3600.0, note)


def on_raster(time: Array, readings: Array, raster: float) -> tuple[Array, Array, float]:
    """Return time, readings and step in s of a series on an even raster: means over each step.

    raster 0: the median step of the series; steps without a sample are gaps (nan). Raises TableFault where time
    does not rise or a raster is finer than the series.
    """
    steps = np.diff(time)
    if len(time) < 2 or not np.all(np.isfinite(time)) or np.any(steps <= 0.0):
        place = int(np.argmax(~(steps > 0.0))) + 2 if len(steps) else 1
        raise TableFault(f"time that does not rise at row {place}", "times that rise from row to row")
    own = float(np.median(steps))
    if raster and raster < 0.999 * own:
        raise TableFault(f"a raster of {raster:g} s", f"at least {own:g} s, the step of the series")
    width = raster or own
    place = np.floor((time - time[0]) / width + 1e-6).astype(np.int64)
    count = int(place[-1]) + 1
    known = np.isfinite(readings)
    numbers = np.zeros((count, readings.shape[1]))
    sums = np.zeros_like(numbers)
    np.add.at(numbers, place, known)
    np.add.at(sums, place, np.where(known, readings, 0.0))
    means = np.divide(sums, numbers, out=np.full_like(sums, np.nan), where=numbers > 0)
    return time[0] + width * np.arange(count), means, width


def _worth(column: Array) -> float:
    """Independent samples of a column that may have gaps."""
    known = column[np.isfinite(column)]
    return effective_number(known) if len(known) > 2 else 1.0
