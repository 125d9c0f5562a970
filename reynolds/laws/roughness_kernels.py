"""Mean gap and sliding stress of rough walls, point by point, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from math import erfc, exp, log, pi, sqrt

import numpy as np
from numba import njit

FAR = 9.0  # standard deviations: beyond, less than 1e-18 of the heights reach over
TOUCHING = np.array([-55, 132, 345, -160, -405, 60, 147]) / 60.0
FREE = np.array([0, 66, 0, -80, 0, 30]) / 15.0
MOMENTS = np.cumprod([1.0] + [(k - 0.5) / (k + 3.5) for k in range(1, 18)])
"""E[s^2k] of heights of density (35/32)(1 - s^2)^3."""


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def cut_off(gap, sigma, mean, share):
    """mean = sigma (H N(H) + n(H)) and share = N(H) of H = gap/sigma: normal distribution N and density n."""
    for i in range(len(gap)):
        ratio = gap[i] / sigma
        if ratio > FAR:
            mean[i], share[i] = gap[i], 1.0
        else:
            share[i] = 0.5 * erfc(-ratio / sqrt(2.0))
            mean[i] = sigma * (ratio * share[i] + exp(-0.5 * ratio * ratio) / sqrt(2.0 * pi))


@njit(inline="always")
def _polynomial(coefficients, x):
    """Value and slope of sum_k c_k x^k."""
    value = slope = 0.0
    for k in range(len(coefficients) - 1, -1, -1):
        slope = slope * x + value
        value = value * x + coefficients[k]
    return value, slope


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def sliding_stress(ratio, value, slope):
    """h E[1/hT] and its slope over h/sigma = ratio > 0, heights as `MOMENTS` has them: see `patir_cheng.phi_f`."""
    for i in range(len(ratio)):
        z = ratio[i] / 3.0
        if z > 3.0:  # the closed form loses digits there
            inverse = 1.0 / (z * z)
            mean, rise = _polynomial(MOMENTS, inverse)
            value[i], slope[i] = mean, -2.0 * inverse / z * rise / 3.0
            continue
        gap = 1.0 - z * z
        if z <= 1.0:
            rest, rise = _polynomial(TOUCHING, z)
            cut = log(300.0 * (z + 1.0))
            rise += gap * gap * (gap / (z + 1.0) - 6.0 * z * cut)
        else:
            z = max(z, 1.0 + 1e-9)
            rest, rise = _polynomial(FREE, z)
            cut = log((z + 1.0) / (z - 1.0))
            rise += gap * gap * (2.0 - 6.0 * z * cut)
        total = gap * gap * gap * cut + rest
        value[i], slope[i] = 35.0 / 32.0 * z * total, 35.0 / 32.0 * (total + z * rise) / 3.0
