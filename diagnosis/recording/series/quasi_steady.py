"""Quasi-steady points of a series that never rests: ramps, stairs, sweeps, warm-up.

Each output's response is estimated and removed (`meter_response`). Samples near each other in inputs and time are one
point; its standard error follows from the noise of single samples and its correlation (`sample_noise`). Inputs stay as
read. The case's thermometer lags the oil: outputs follow T + tau dT/dt. A smooth law of all inputs fits equally well
with any tau, since pressure warms the oil; so tau is assumed here, and fitted with the pump.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2
from scipy.signal import savgol_filter

from diagnosis.recording.series.meter_response import (
    NORMAL,
    Mask,
    MeterResponse,
    meter_response,
    past_share,
    smooth_columns,
)
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, ChannelName
from system.inputs.units import Dimension

POINTS = 64
FEWEST = 8  # samples of a point
RATE_SAMPLES = 9  # of the local line of which a rate is the slope
STEEP = 0.03  # of the range a second: faster is a jump, not a ramp
MOVES = 12.0  # an input moves whose range exceeds this multiple of its scatter; that of noise alone exceeds five
THERMOMETER = 25.0  # s, lag of the case's: seconds of a bare one in the stream, a minute in its well
HELD = 0.9  # of a point's samples: fewer readings of a channel make no mean
ROUNDING = 1e-9
SEED = 20


@dataclass(frozen=True)
class QuasiSteady:
    """N points from a series of C channels.

    means, errors: (N, C), SI, of steady state, and their standard errors; nan where a channel does not follow;
    directions: (N, C, N), errors of two points correlate by the product of theirs; time: (N,), s; meters: response of
    each output by its column; warming: (N,), K/s by which T_case as read rises; left: share of samples put aside.
    """

    means: Array
    errors: Array
    directions: Array
    time: Array
    meters: dict[int, MeterResponse]
    warming: Array
    left: float


def quasi_steady(
    time: Array, readings: Array, names: Sequence[ChannelName], thermometer: float = THERMOMETER
) -> QuasiSteady:
    """Points of readings (T, C) in SI of the channels `names` at even times (T,) in s, nan in gaps.

    thermometer: lag of the case's, s. An output with fewer than `FEWEST` readings has no mean at any point. Raises
    ValueError for fewer than `FEWEST` samples without gaps and jumps of the inputs.
    """
    if len(time) < FEWEST:
        raise ValueError(f"{len(time)} samples")
    inputs = [k for k, name in enumerate(names) if name in INPUTS]
    rate, usable = _calm(time, readings, names)
    usable &= np.all(np.isfinite(readings[:, inputs]), axis=1)
    if usable.sum() < FEWEST:
        raise ValueError(f"{usable.sum()} samples without gaps and jumps")
    warming, found, readings = np.zeros(len(time)), readings[usable], readings.copy()
    if ChannelName.T_CASE in names:
        case, step = names.index(ChannelName.T_CASE), float(np.median(np.diff(time)))
        warming = _rate(readings[:, case], step)
        readings[:, case] = ahead_of(readings[:, case], thermometer / step)
    moving, past = _moving(readings[:, inputs]), past_share(time)
    known = usable[:, None] & np.isfinite(readings)
    outputs = [k for k in range(len(names)) if k not in inputs and known[:, k].sum() >= FEWEST]
    storing = {k: rate if names[k] is ChannelName.Q_OUT else None for k in outputs}
    meters = {
        k: meter_response(readings[:, k], time, moving, storing[k], known[:, k], _is_flow(names[k])) for k in outputs
    }
    cell = _cells(np.column_stack([moving, 2.0 * past - 1.0])[usable])
    centre = _means(np.column_stack([moving, past])[usable], cell)[0]
    shapes = smooth_columns(moving, past)[usable]
    of_centre = smooth_columns(centre[:, :-1], centre[:, -1])[cell]
    for k, meter in meters.items():
        found[:, k] = meter.steady[usable] + (of_centre - shapes) @ meter.law  # a law that bends within a cell
    kept = np.bincount(cell) >= FEWEST
    order = np.flatnonzero(kept)[np.argsort(centre[kept, -1])]
    means = _means(found, cell)[0][order]
    rising = _means(warming[usable, None], cell)[0][order, 0]
    belongs = np.zeros((len(order), len(time)), dtype=bool)
    belongs[:, usable] = order[:, None] == cell
    errors, directions = _errors(meters, means, belongs)
    middle = time[0] + centre[order, -1] * float(time[-1] - time[0])
    return QuasiSteady(means, errors, directions, middle, meters, rising, 1.0 - float(usable.mean()))


def _errors(meters: Mapping[int, MeterResponse], means: Array, belongs: Mask) -> tuple[Array, Array]:
    """Standard errors (N, C) of means (N, C) over the samples (N, T) that belong to them, and directions (N, C, N)."""
    errors, directions = np.where(np.isfinite(means), 0.0, np.nan), np.zeros((*means.shape, len(means)))
    for k, meter in meters.items():
        rows = np.flatnonzero(np.isfinite(means[:, k]))
        there = belongs[rows] & np.isfinite(meter.steady)
        errors[rows, k], directions[rows, k, : len(rows)] = _shared(meter, there.astype(float))
    return errors, directions


def _shared(meter: MeterResponse, there: Array) -> tuple[Array, Array]:
    """Standard errors (n,) of means over samples (n, T), and directions (n, n) whose products are correlations."""
    covariance = meter.of_means(there / there.sum(axis=1, keepdims=True))
    errors = np.sqrt(np.diag(covariance))
    scale = np.where(errors > 0.0, errors, 1.0)
    correlation = covariance / np.outer(scale, scale)
    np.fill_diagonal(correlation, 1.0 + ROUNDING)
    return errors, np.linalg.cholesky(correlation)


def ahead_of(values: Array, lag: float) -> Array:
    """Values (T,) before a first-order lag of some samples, x = y + lag dy/dt, y smoothed so that its noise stays."""
    if lag == 0.0:
        return values
    known = np.isfinite(values)
    filled = np.interp(np.arange(len(values)), np.flatnonzero(known), values[known])
    wanted = 2 * int(np.ceil(0.5 * (12.0 * lag**2) ** (1.0 / 3.0))) + 1
    window = min(max(wanted, RATE_SAMPLES), (len(values) - 1) // 2 * 2 + 1)
    smooth, slope = (savgol_filter(filled, window, 2, deriv=order) for order in (0, 1))
    return np.where(known, smooth + lag * slope, np.nan)


def _is_flow(name: ChannelName) -> bool:
    return name.dimension is Dimension.VOLUME_FLOW


def _calm(time: Array, readings: Array, names: Sequence[ChannelName]) -> tuple[Array, Mask]:
    """Rate (T,) of the delivery pressure in Pa/s, and the samples (T,) at which it does not jump."""
    if ChannelName.P_OUT not in names:
        return np.zeros(len(time)), np.ones(len(time), dtype=bool)
    pressure = readings[:, names.index(ChannelName.P_OUT)]
    if np.isfinite(pressure).sum() < FEWEST:
        return np.zeros(len(time)), np.isfinite(pressure)
    rate = _rate(pressure, float(np.median(np.diff(time))))
    return rate, np.abs(rate) < STEEP * max(float(np.nanmax(np.abs(pressure))), 1.0)


def _rate(values: Array, raster: float) -> Array:
    """Slope of a local line, per s."""
    known = np.isfinite(values)
    filled = np.interp(np.arange(len(values)), np.flatnonzero(known), values[known])
    window = min(RATE_SAMPLES, (len(values) - 1) // 2 * 2 + 1)
    return np.asarray(savgol_filter(filled, window, 1, deriv=1, delta=raster))


def _moving(inputs: Array) -> Array:
    """Inputs that move, scaled to [-1, 1], (T, m); gaps filled with the last reading's line."""
    found = []
    for column in inputs.T:
        known = np.isfinite(column)
        if known.sum() < FEWEST:
            continue
        scatter = NORMAL * float(np.median(np.abs(np.diff(column[known])))) / np.sqrt(2.0)
        low, high = np.percentile(column[known], [0.5, 99.5])
        if high - low > MOVES * max(scatter, 1e-9 * abs(high)):
            filled = np.interp(np.arange(len(column)), np.flatnonzero(known), column[known])
            found.append(2.0 * (filled - low) / (high - low) - 1.0)
    return np.column_stack(found) if found else np.zeros((len(inputs), 0))


def _cells(places: Array) -> NDArray[np.int64]:
    """Number of the cell of each sample: nearest of about POINTS centres among the places (T, m)."""
    count = max(1, min(POINTS, len(places) // (2 * FEWEST)))
    _, cell = kmeans2(places, count, minit="++", seed=SEED)
    return np.asarray(np.unique(cell, return_inverse=True)[1], dtype=np.int64)


def _means(values: Array, cell: NDArray[np.int64]) -> tuple[Array, Array]:
    """Means (N, C) over cells, nan where a channel has too few readings, and the numbers of readings behind them."""
    samples, known = np.bincount(cell), np.isfinite(values)
    numbers: Array = np.column_stack([np.bincount(cell, weights=column.astype(float)) for column in known.T])
    sums = np.column_stack([np.bincount(cell, weights=column) for column in np.where(known, values, 0.0).T])
    whole = numbers >= HELD * samples[:, None]
    return np.divide(sums, numbers, out=np.full_like(sums, np.nan), where=whole), numbers
