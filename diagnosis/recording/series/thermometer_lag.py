"""Lag of the case's thermometer behind the oil of the gaps, in a series whose pressure moves.

Leakage follows the viscosity in the gaps. A thermometer in the case, and the case's own oil, follow the gaps' losses
with a time constant: T_gap = T + tau dT/dt. Tau is that with which readings are nearest to a smooth law of pressure and
this one temperature.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import savgol_filter

from diagnosis.recording.series.meter_response import Mask, best_lag, lagged, misfit, past_share, smooth_columns
from reynolds.numerics.arrays import Array

LAGS = (4.0, 8.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 128.0)  # s
METER_LAGS = (0.0, 1.0, 2.0, 4.0, 8.0)  # samples by which an output may lag itself
THINNED = 3  # every third sample suffices
WINDOW = 13  # samples of the local parabola whose slope is dT/dt


def thermometer_lag(
    temperature: Array, others: Array, outputs: Array, time: Array, usable: Mask
) -> tuple[float, Array]:
    """Lag in s, and temperature (T,) in K without it; 0 and the temperature itself where none fits better.

    temperature: (T,) K at even times (T,) s; others: (T, m), all other inputs but temperatures, scaled; outputs:
    (T, C), SI; usable: (T,), samples that count.
    """
    step = float(np.median(np.diff(time)))
    window = min(WINDOW, (len(time) - 1) // 2 * 2 + 1)
    known = np.isfinite(temperature)
    whole = np.interp(time, time[known], temperature[known])
    slope = savgol_filter(whole, window, min(2, window - 1), deriv=1, delta=step)
    past, used = past_share(time), usable & (np.arange(len(time)) % THINNED == 0)

    def score(lag: float) -> float:
        led = whole + lag * slope
        low, high = np.percentile(led[usable], [0.5, 99.5])
        scaled = 2.0 * (led - low) / max(high - low, 1e-9) - 1.0
        inputs = np.column_stack([others, scaled])
        columns = [smooth_columns(lagged(inputs, samples), past)[used] for samples in METER_LAGS]
        reached = [min(misfit(column, y) for column in columns) for y in outputs[used].T]
        return float(np.exp(np.mean(np.log(np.maximum(reached, 1e-300)))))

    found = best_lag(score, [lag for lag in LAGS if lag >= step])
    return found, np.asarray(temperature + found * slope)
