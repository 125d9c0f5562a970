"""Points left out together: levels of a map's axis, and the predictions of a fit without them."""

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.estimation.posterior import Posterior
from system.estimation.predictive import predictive

MOST_LEVELS = 20
APART = 4.0  # of the least gap between levels over the largest within one: below it there are no levels
SAME = 1e-6  # of the whole range: closer values are equal


def levels(values: Array) -> NDArray[np.int64]:
    """The level (N,) of each value, from 0 for the least: set points that readings scatter about.

    Among the gaps of the sorted values those between levels are much larger: the limit is where a gap is the
    largest multiple of the next smaller one, APART times at least. Values without such a break, or all equal, are
    one level. A level has two values on average at least, and there are MOST_LEVELS at most.
    """
    order = np.argsort(values, kind="stable")
    span = float(np.ptp(values))
    gaps = np.diff(values[order])
    most = min(MOST_LEVELS, len(values) // 2) - 1
    found = np.zeros(len(values), dtype=np.int64)
    if span == 0.0 or most < 1:
        return found
    falling = np.maximum(np.sort(gaps)[::-1], SAME * span)
    ratio = falling[:most] / falling[1 : most + 1]
    last = int(np.argmax(ratio))
    if ratio[last] < APART:
        return found
    edge = np.sqrt(falling[last] * falling[last + 1])
    found[order] = np.concatenate(([0], np.cumsum(gaps > edge)))
    return found


def left_out(posterior: Posterior, parts: NDArray[np.int64]) -> Array:
    """Residuals (N, C) in SI of each point, predicted by the fit without its part; `parts` (N,) numbers them.

    Each fit is repeated by one linear step (`predictive`).
    """
    white = np.zeros_like(posterior.residual)
    own = parts[posterior.whitening.rows[:, 0]]
    for part in np.unique(own):
        white[own == part] = predictive(posterior, own == part)[0]
    return posterior.whitening.unwhiten(white)
