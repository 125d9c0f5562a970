"""Points from a time series: means over steady stretches, or quasi-steady means if these are too few."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.form import SeriesSection, SteadinessSection
from diagnosis.recording.series.clock import clocked
from diagnosis.recording.series.holds import without_holds
from diagnosis.recording.series.meter_response import MeterResponse
from diagnosis.recording.series.quasi_steady import FEWEST, THERMOMETER, quasi_steady
from diagnosis.recording.series.standstill import without_standstill
from diagnosis.recording.series.steadiness import Repeatability, SteadyRule, effective_number, steady_stretches
from diagnosis.recording.series.stretches import bridged, stretches
from diagnosis.recording.tables.table import TableFault
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, ChannelName

LEAST_STEADY = 0.5  # of a series in steady stretches: below it, all of the series is read as quasi-steady
MOST_POINTS = 160  # steady stretches: more are repeats of each other, and a fit needs minutes
MISSTATED = 2.0  # times the scatter, or one over this: a repeatability that the data contradict
ZERO_OF_BAND = 0.1  # of a dead band: a low-flow cut-off is set at some five times the limit of a meter's zero
SETTLING = 3.0  # lags of a channel omitted at the beginning of a stretch
SHORT_GAP = 2  # samples lost in a row that a line replaces in a moving series


@dataclass(frozen=True)
class SeriesPoints:
    """Means (N, C) of C channels at N points, standard error of each, and times.

    directions: (N, C, K), of quasi-steady points, whose errors correlate by the products of theirs; hours: (N,), middle
    of the samples, h from the first; zeros: (C,), one sigma of a zero that the series shows at least, SI; quasi:
    quasi-steady points, whose noise is `errors`; warming: (N,), K/s of T_case, None for steady points; notes: the
    procedure as text.
    """

    means: Array
    errors: Array
    directions: Array | None
    hours: Array
    zeros: Array
    quasi: bool
    warming: Array | None
    notes: tuple[str, ...]


def series_points(form: SeriesSection, time: Array, readings: Array, channels: Sequence[ChannelForm]) -> SeriesPoints:
    """Points of a series: time (T,) in s, readings (T, C) in SI, columns as `channels`.

    `SteadyRule` of the measured inputs determines the steady stretches. The first `SETTLING` times the largest lag of a
    stretch are omitted. Where the stretches hold less than `LEAST_STEADY` of the series, or are more than
    `MOST_POINTS`, points are quasi-steady means (`quasi_steady`). Raises TableFault for times in no order, a pump that
    never turns, and for a series of fewer than `FEWEST` samples.
    """
    clock = clocked(time, readings)
    time, rastered, raster = on_raster(clock.time, clock.readings, form.raster or 0.0)
    readings, put_aside = without_what_is_no_reading(time, rastered, [channel.name for channel in channels])
    notes = (*clock.notes, *put_aside)
    steady = _steady_stretches(form, raster, readings, channels)
    at_work = int(np.any(np.isfinite(readings), axis=1).sum())
    if not steady or len(steady) > MOST_POINTS or sum(s.stop - s.start for s in steady) < LEAST_STEADY * at_work:
        found = _quasi_steady_points(time, with_short_gaps_filled(rastered, readings), channels)
        return replace(found, notes=(*notes, *found.notes))
    means, errors = (np.array(each) for each in zip(*(_mean(readings[s]) for s in steady), strict=True))
    middle = np.array([0.5 * (time[s.start] + time[s.stop - 1]) for s in steady])
    share = sum(s.stop - s.start for s in steady) / len(time)
    rule = (
        f"{len(steady)} steady points from {share:.0%} of the series: windows of {form.steady.window:g} s in "
        f"which slope and bow of every input stay below {form.steady.slope:g} standard errors or its repeatability"
    )
    hours = (middle - middle[0]) / 3600.0
    return SeriesPoints(means, errors, None, hours, np.zeros(len(channels)), False, None, (*notes, rule))


def without_what_is_no_reading(
    time: Array, readings: Array, names: Sequence[ChannelName]
) -> tuple[Array, tuple[str, ...]]:
    """Readings (T, C) without those of a pump at rest and of meters that hold, and notes; even times (T,) in s."""
    readings, of_rest = without_standstill(time, readings, names)
    readings, of_holds = without_holds(time, readings, names)
    return readings, (*of_rest, *of_holds)


def with_short_gaps_filled(rastered: Array, readings: Array) -> Array:
    """Readings (T, C) with lines across gaps of `SHORT_GAP` samples at most; not across readings put aside.

    rastered: (T, C), before readings were put aside.
    """
    filled = readings.copy()
    for column, before in zip(filled.T, rastered.T, strict=True):
        short = np.zeros(len(column), dtype=bool)
        for gap in stretches(~np.isfinite(column)):
            short[gap] = gap.stop - gap.start <= SHORT_GAP and not np.isfinite(before[gap]).any()
        column[:] = bridged(column, short)
    return filled


def _steady_stretches(
    form: SeriesSection, raster: float, readings: Array, channels: Sequence[ChannelForm]
) -> list[slice]:
    """Stretches in which all inputs rest, without their first part with lagging outputs."""
    rule = SteadyRule(round(form.steady.window / raster), form.steady.slope)
    if rule.samples < FEWEST and form.steady.window != SteadinessSection().window:
        found = f"a window of {rule.samples} samples of {raster:g} s"
        raise TableFault(found, f"at least {FEWEST} samples a window", f'"{FEWEST * raster:g} s"')
    if rule.samples < FEWEST:
        return []
    inputs = [k for k, channel in enumerate(channels) if channel.name in INPUTS] or list(range(len(channels)))
    noise = Repeatability(*np.array([channels[k].repeatability for k in inputs]).T)
    settling = int(np.ceil(SETTLING * max(channel.lag or 0.0 for channel in channels) / raster))
    steady = [slice(s.start + settling, s.stop) for s in steady_stretches(readings[:, inputs], noise, rule)]
    steady = [s for s in steady if s.stop - s.start >= rule.samples // 2]
    return steady


def _quasi_steady_points(time: Array, readings: Array, channels: Sequence[ChannelForm]) -> SeriesPoints:
    """Quasi-steady means of a series without rest, and notes on storage, samples put aside, misstated noise."""
    try:
        stated = next((one.lag for one in channels if one.name is ChannelName.T_CASE and one.lag), THERMOMETER)
        found = quasi_steady(time, readings, [channel.name for channel in channels], stated)
    except ValueError as reason:
        raise TableFault(str(reason), f"at least {FEWEST} samples of a series") from reason
    notes = (
        f"{len(found.means)} quasi-steady points from {1.0 - found.left:.0%} of the series: samples of like inputs and "
        "time are one point; lag of the meters and storage of line and chambers are estimated and taken out",
        *(_meter_note(channels[k], meter) for k, meter in found.meters.items()),
    )
    zeros = np.zeros(len(channels))
    for k, meter in found.meters.items():
        zeros[k] = ZERO_OF_BAND * np.nan_to_num(meter.band)
    hours = (found.time - found.time[0]) / 3600.0
    return SeriesPoints(found.means, found.errors, found.directions, hours, zeros, True, found.warming, notes)


def _meter_note(channel: ChannelForm, meter: MeterResponse) -> str:
    """Scatter, lag and dead band of a meter; its stated repeatability where the readings contradict it."""
    parts = [f"its samples scatter by {meter.noise.sigma / channel.factor:.3g} {channel.unit} (one sigma)"]
    if meter.lag > 0.0:
        parts.append(f"it lags by {meter.lag:.3g} s")
    if np.isfinite(meter.band):
        level = f"{(meter.band - channel.offset) / channel.factor:.3g} {channel.unit}"
        parts.append(f"below its dead band, {level}, readings are put aside")
    stated = channel.sigma
    if stated and not meter.noise.sigma / MISSTATED < stated < meter.noise.sigma * MISSTATED:
        parts.append(f"{stated / channel.factor:.3g} {channel.unit} is stated, which contradicts: the scatter is used")
    return f"{channel.name.value}: {'; '.join(parts)}"


def on_raster(time: Array, readings: Array, raster: float) -> tuple[Array, Array, float]:
    """Return time, readings and step in s of a series on an even raster: means over each step.

    raster 0: the median step of the series. A step holds the samples from half a sample before its beginning, so that
    stamps may be rounded or uneven by as much; steps without a sample are gaps (nan). Raises TableFault where time does
    not rise or a raster is finer than the series.
    """
    steps = np.diff(time)
    if len(time) < 2 or not np.all(np.isfinite(time)) or np.any(steps <= 0.0):
        place = int(np.argmax(~(steps > 0.0))) + 2 if len(steps) else 1
        raise TableFault(f"time that does not rise at row {place}", "times that rise from row to row")
    own = float(np.median(steps))
    if raster and raster < 0.999 * own:
        raise TableFault(f"a raster of {raster:g} s", f"at least {own:g} s, the step of the series")
    width = raster or own
    place = np.floor((time - time[0] + 0.5 * own) / width).astype(np.int64)
    count = int(place[-1]) + 1
    known = np.isfinite(readings)
    numbers = np.zeros((count, readings.shape[1]))
    sums = np.zeros_like(numbers)
    np.add.at(numbers, place, known)
    np.add.at(sums, place, np.where(known, readings, 0.0))
    means = np.divide(sums, numbers, out=np.full_like(sums, np.nan), where=numbers > 0)
    return time[0] + width * np.arange(count), means, width


def _mean(stretch: Array) -> tuple[Array, Array]:
    """Means (C,) of a stretch (T, C) over its readings, and their standard errors; nan without two."""
    means, errors = np.full((2, stretch.shape[1]), np.nan)
    for k, column in enumerate(stretch.T):
        known = column[np.isfinite(column)]
        if len(known) > 1:
            worth = effective_number(known) if len(known) > 2 else 1.0
            means[k], errors[k] = np.mean(known), np.std(known, ddof=1) / np.sqrt(worth)
    return means, errors
