"""Response of a meter to a series that never rests: dead band, lag, storage, noise.

A reading at time t is that of steady state at inputs that the meter follows with a lag, less the oil that line and
chambers store in proportion to the pressure's rate:

    y(t) = g(u_tau(t), t) - s dp/dt + e(t),   tau du_tau/dt = u - u_tau

g: a smooth function of the moving inputs u and, slowly, of time; e: noise with memory; s >= 0, of delivery alone.
Least squares with Huber's (1964) weights at the lag that fits best. The steady reading is y + g(u, t) - g(u_tau, t)
+ s dp/dt.

A lag and a storage of -tau dg/dp have the same effect to first order. Both together change an oscillation of frequency
w by tau^2 w^2, which looks like physics: the better fit is used. Law, lag and storage are estimates, so that the noise
of a mean of steady readings is (a + a M B) e. Here a are its shares of the samples, B e is the error of the estimates
by the noise e, and M B e the resulting error of the steady readings.
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
REFINED = 3  # Gauss-Newton steps of a lag, whose error after a search by misfit exceeds its sigma
HUBER = 1.5
NORMAL = 1.4826  # standard deviation of a normal distribution per median magnitude
LAGS = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0)  # samples
LONGEST = 16.0  # lags of at most the series' length over this are tried
BLOCKS = 2000  # means of samples by which lag and storage are judged: what single samples hide in their noise
LOW = 0.3  # share of the least readings by which a dead band is sought
LEAST_PILE = 0.005  # share of readings in it
MOST_BAND = 0.3  # of the largest reading
NEARER = 0.995  # of the misfit without lag: a lag that does not improve it counts as zero
CLEAR = 2.0  # sigma above the dead band from which a reading counts


@dataclass(frozen=True)
class MeterResponse:
    """Response of a channel. steady: (T,), readings of steady state, SI, nan within the dead band; band: SI, nan
    without one; lag: s; storage: s of the equation, SI; noise: of single samples; law: coefficients of
    `smooth_columns`, SI; moves: (T, m), M of the noise of means; by: (m, T), its B.
    """

    steady: Array
    band: float
    lag: float
    storage: float
    noise: SampleNoise
    law: Array
    moves: Array
    by: Array

    def of_means(self, shares: Array) -> Array:
        """Covariance (N, N) of means of steady readings with shares (N, T) of the samples."""
        return self.noise.of_means(shares + shares @ self.moves @ self.by)


def meter_response(
    values: Array, time: Array, moving: Array, rate: Array | None, usable: Mask, may_be_dead: bool
) -> MeterResponse:
    """Response of readings (T,) in SI at even times (T,) s to inputs (T, m) scaled to [-1, 1] and the pressure's rate
    (T,) in Pa/s, None without storage before the meter; `usable` (T,): samples that count. may_be_dead: a flow meter,
    which may have a dead band.
    """
    known, past = values[usable], past_share(time)

    def columns(lag: float) -> Array:
        return smooth_columns(lagged(moving, lag), past)[usable]

    at_once = columns(0.0)
    follows = follows_down(known, at_once, dead_band(known, at_once)) if may_be_dead else np.ones(len(known), bool)

    def missed(samples: float) -> float:
        return misfit(block_means(columns(samples)[follows]), block_means(known[follows]))

    lag = best_lag(missed, _tried(len(values)))
    held = np.zeros(len(known)) if rate is None else -rate[usable]
    values_of, columns_of, stored = (block_means(one[follows]) for one in (known, at_once, held))
    storage = _storage(values_of, columns_of, stored, missed(lag))
    lag = 0.0 if storage > 0.0 else _refined(lag, lambda samples: columns(samples)[follows], known[follows])
    followed, known = columns(lag), known - storage * held
    band = dead_band(known, followed) if may_be_dead else np.nan
    follows = follows_down(known, followed, band)
    law, residual = robust(followed[follows], known[follows])
    changes = held if storage > 0.0 else (columns(lag + 1.0) - followed) @ law
    steady, counts = np.full(len(values), np.nan), np.flatnonzero(usable)[follows]
    steady[usable] = np.where(follows, known + (at_once - followed) @ law, np.nan)
    moves, by = np.zeros((len(values), len(law) + 1)), np.zeros((len(law) + 1, len(values)))
    moves[usable] = np.column_stack([at_once - followed, -changes])
    by[:, counts] = _by_each_reading(np.column_stack([followed, changes])[follows])
    noise = sample_noise(residual, followed[follows], counts, len(values))
    return MeterResponse(steady, band, lag * float(np.median(np.diff(time))), storage, noise, law, moves, by)


def _refined(lag: float, columns: Callable[[float], Array], values: Array) -> float:
    """Lag nearer to that of least squares, by Gauss-Newton steps; columns: of a law by the lag. One of 0 stays."""
    for _ in range(REFINED if lag > 0.0 else 0):
        followed = columns(lag)
        changes = (columns(lag + 1.0) - followed) @ robust(followed, values)[0]
        lag = max(lag + float(robust(np.column_stack([followed, changes]), values)[0][-1]), 0.5 * lag)
    return lag


def _tried(samples: int) -> tuple[float, ...]:
    """Lags to try, in samples: longer ones for a longer series."""
    more = np.log2(samples / LONGEST / LAGS[-1])
    return (*LAGS, *(LAGS[-1] * 2.0**power for power in range(1, int(max(more, 0.0)) + 1)))


def block_means(samples: Array) -> Array:
    """Means (at most BLOCKS, ..) of equal numbers of samples (T, ..) one after the other; few samples themselves."""
    each = -(-len(samples) // BLOCKS)
    if each <= 1:
        return samples
    starts = np.arange(0, len(samples), each)
    counts = np.diff([*starts, len(samples)])
    return np.asarray(np.add.reduceat(samples, starts) / counts.reshape(-1, *[1] * (samples.ndim - 1)))


def _storage(values: Array, columns: Array, held: Array, least: float) -> float:
    """Storage by its column `held` (n,) beside a law's (n, m); 0 where values (n,) agree to `least` without it."""
    if not np.any(held):
        return 0.0
    both = np.column_stack([columns, held])
    return max(float(robust(both, values)[0][-1]), 0.0) if misfit(both, values) < least else 0.0


def _by_each_reading(columns: Array) -> Array:
    """Coefficients (m, n) of columns (n, m) by least squares of a unit of each reading."""
    scale = np.maximum(np.abs(columns).max(axis=0), 1e-300)
    return np.asarray(np.linalg.pinv(columns / scale, rcond=1e-9) / scale[:, None])


def best_lag(score: Callable[[float], float], tried: Sequence[float] = LAGS) -> float:
    """Lag of the least score, refined between its neighbours of those tried; 0 where no lag improves on none."""
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
    """Reading (SI) up to which a meter does not follow, nan where it follows down to its least reading.

    Largest level L at the lower end such that readings are L where a smooth law, fitted to those above L alone, is
    lower by more than one and a half times `CLEAR` sigma. Else, of a meter that shows 0 below its cut-off, the least
    other reading.
    """
    top, found = float(np.max(values)), _cut_off(values)
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


def _cut_off(values: Array) -> float:
    """Least reading (SI) of a flow meter beside those of 0, nan where few are 0."""
    shown = values != 0.0
    return float(values[shown].min()) if 0.0 < shown.mean() <= 1.0 - LEAST_PILE and values.min() == 0.0 else np.nan


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
    """Polynomials of third degree of the inputs (T, m) with products, and slow cosines of the elapsed share (T,) of
    time, 0 to 1.
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
    """Elapsed share (T,) of a series, 0 to 1."""
    return np.asarray((time - time[0]) / max(float(time[-1] - time[0]), 1e-300))


def lagged(moving: Array, samples: float) -> Array:
    """Inputs behind a first-order lag of some samples, at rest before the first."""
    if samples == 0.0:
        return moving
    left = float(np.exp(-1.0 / samples))
    return np.asarray(lfilter([1.0 - left], [1.0, -left], moving, axis=0, zi=left * moving[:1])[0])


def follows_down(values: Array, columns: Array, band: float) -> Mask:
    """True for values (n,) clear of a dead band; all where it is nan, or where none is. columns (n, m): of a smooth law
    of them.
    """
    if not np.isfinite(band):
        return np.ones(len(values), dtype=bool)
    spread = NORMAL * float(np.median(np.abs(robust(columns, values)[1])))
    clear = values > band + CLEAR * spread
    return np.asarray(clear | ~clear.any())


def misfit(columns: Array, values: Array) -> float:
    """Mean magnitude of the residuals of a robust fit of columns (T, m) to values (T,)."""
    return float(np.abs(robust(columns, values)[1]).mean())
