"""Response of a meter to a series that never rests: dead band, lag, storage, noise.

A reading at time t is that of steady state at inputs that the meter follows with a lag, less what line and chambers
hold back in proportion to the pressure's rate:

    y(t) = g(u_tau(t), t) - s dp/dt + e(t),   tau du_tau/dt = u - u_tau

g: a smooth function of the moving inputs u and, slowly, of time; e: noise with memory. Least squares with Huber's
(1964) weights at the lag that fits best. The steady reading is y + g(u, t) - g(u_tau, t) + s dp/dt.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.signal import lfilter

from diagnosis.recording.series.sample_noise import SampleNoise, sample_noise
from reynolds.numerics.arrays import Array

Mask = NDArray[np.bool_]
ROUNDS = 6
HUBER = 1.5
NORMAL = 1.4826  # standard deviation of a normal distribution per median magnitude
LAGS = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0)  # samples
LOW = 0.3  # share of the least readings by which a dead band is sought
LEAST_PILE = 0.005  # share of readings in it
MOST_BAND = 0.3  # of the largest reading
NEARER = 0.995  # of the misfit without lag: a lag that does not improve it counts as zero
CLEAR = 2.0  # sigma above the dead band from which a reading counts


@dataclass(frozen=True)
class MeterResponse:
    """Response of a channel. steady: (T,), readings of steady state, SI, nan within the dead band; band: SI, nan where
    there is none; lag: s; storage: s of the equation, SI; noise: of single samples; law: coefficients of
    `smooth_columns`, SI.
    """

    steady: Array
    band: float
    lag: float
    storage: float
    noise: SampleNoise
    law: Array


def meter_response(
    values: Array, time: Array, moving: Array, rate: Array, usable: Mask, may_be_dead: bool
) -> MeterResponse:
    """Response of readings (T,) in SI at even times (T,) s to inputs (T, m) scaled to [-1, 1] and the pressure's
    rate (T,) in Pa/s; `usable` (T,): samples that count. may_be_dead: a flow meter, which may have a dead band.
    """
    rates = rate[usable, None] if np.any(rate) else np.empty((int(usable.sum()), 0))
    known, past = values[usable], past_share(time)

    def columns(lag: float) -> Array:
        return np.column_stack([smooth_columns(lagged(moving, lag), past)[usable], rates])

    at_once = columns(0.0)
    follows = follows_down(known, at_once, dead_band(known, at_once)) if may_be_dead else np.ones(len(known), bool)
    lag = best_lag(lambda samples: misfit(columns(samples)[follows], known[follows]))
    followed = columns(lag)
    band = dead_band(known, followed) if may_be_dead else np.nan
    follows = follows_down(known, followed, band)
    size, residual = robust(followed[follows], known[follows])
    smooth = at_once.shape[1] - rates.shape[1]
    at_rest = (at_once - followed)[:, :smooth] @ size[:smooth] - rates @ size[smooth:]
    steady = np.full(len(values), np.nan)
    steady[usable] = np.where(follows, known + at_rest, np.nan)
    noise = sample_noise(residual, followed[follows], np.flatnonzero(usable)[follows], len(values))
    storage = -float(size[-1]) if rates.size else 0.0
    return MeterResponse(steady, band, lag * float(np.median(np.diff(time))), storage, noise, size[:smooth])


def best_lag(score: Callable[[float], float], tried: Sequence[float] = LAGS) -> float:
    """Lag of the least score, refined between its neighbours of those tried; 0 where no lag betters that of none."""
    scores = [score(lag) for lag in tried]
    if not scores or min(scores) > NEARER * score(0.0):
        return 0.0
    at = int(np.argmin(scores))
    between = (tried[at - 1] if at else 0.0), tried[min(at + 1, len(tried) - 1)]
    refined = minimize_scalar(
        score, bounds=between, method="bounded", options={"maxiter": 8, "xatol": 0.02 * tried[at]}
    )
    return float(refined.x) if refined.fun < scores[at] else float(tried[at])


def dead_band(values: Array, columns: Array) -> float:
    """Reading (SI) that a meter shows for all that is less, nan where it follows down to its least reading.

    Largest level L at the lower end such that readings are L where a smooth law, fitted to those above L alone, is
    lower by more than one and a half times `CLEAR` sigma.
    """
    top, found = float(np.max(values)), np.nan
    for level in np.unique(np.quantile(values, np.geomspace(LEAST_PILE, 0.5 * LOW, 10))):
        above = values > level
        if not 0.0 < level < MOST_BAND * top or above.mean() > 1.0 - LEAST_PILE:
            continue
        size, residual = robust(columns[above], values[above])
        sigma = NORMAL * float(np.median(np.abs(residual)))
        below = columns @ size < level - 1.5 * CLEAR * sigma
        if below.mean() >= LEAST_PILE and abs(float(np.median(values[below])) - level) < CLEAR * sigma:
            found = float(level)
    return found


def robust(columns: Array, values: Array) -> tuple[Array, Array]:
    """Least squares with Huber's weights: coefficients (m,) of columns (T, m), and residuals (T,)."""
    scale = np.maximum(np.abs(columns).max(axis=0), 1e-300)
    scaled, weight = columns / scale, np.ones(len(values))
    size, residual = np.zeros(columns.shape[1]), values
    for _ in range(ROUNDS):
        weighted = scaled * weight[:, None]
        size = np.linalg.lstsq(weighted.T @ scaled, weighted.T @ values, rcond=1e-12)[0]
        residual = values - scaled @ size
        spread = NORMAL * float(np.median(np.abs(residual)))
        if spread == 0.0:
            break
        weight = np.minimum(1.0, HUBER * spread / np.maximum(np.abs(residual), 1e-300))
    return size / scale, residual


def smooth_columns(moving: Array, past: Array) -> Array:
    """Polynomials of third degree of the inputs (T, m) with products, and slow cosines of the past share (T,) of time,
    0 to 1.
    """
    columns = [np.ones(len(past))]
    count = moving.shape[1]
    for a in range(count):
        columns += [moving[:, a], moving[:, a] ** 2, moving[:, a] ** 3]
        columns += [moving[:, a] * moving[:, b] for b in range(a)]
        columns += [moving[:, a] ** 2 * moving[:, b] for b in range(count) if b != a]
    columns += [np.cos(np.pi * order * past) for order in range(1, 7)]
    return np.column_stack(columns)


def past_share(time: Array) -> Array:
    """Share (T,) of a series that is past, 0 to 1."""
    return np.asarray((time - time[0]) / max(float(time[-1] - time[0]), 1e-300))


def lagged(moving: Array, samples: float) -> Array:
    """Inputs behind a first-order lag of some samples, at rest before the first."""
    if samples == 0.0:
        return moving
    left = float(np.exp(-1.0 / samples))
    return np.asarray(lfilter([1.0 - left], [1.0, -left], moving, axis=0, zi=left * moving[:1])[0])


def follows_down(values: Array, columns: Array, band: float) -> Mask:
    """True for values (n,) clear of a dead band, all where it is nan; columns (n, m): of a smooth law of them."""
    if not np.isfinite(band):
        return np.ones(len(values), dtype=bool)
    spread = NORMAL * float(np.median(np.abs(robust(columns, values)[1])))
    return np.asarray(values > band + CLEAR * spread)


def misfit(columns: Array, values: Array) -> float:
    """Mean magnitude of the residuals of a robust fit of columns (T, m) to values (T,)."""
    return float(np.abs(robust(columns, values)[1]).mean())
