"""Readings left out of a fit: by levels of an axis, and their prediction by the fit without them."""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from reynolds.numerics.arrays import Array
from system.estimation.posterior import Posterior


def predictive(posterior: Posterior, rows: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Residual (m,) and joint covariance (m, m), whitened, of the rows where `rows` (n,) is true, not fitted.

    One linear step from the full peak without these rows: precision H - A_f^T A_f, covariance 1 + A_f C A_f^T.
    The joint covariance matters: the error that the rows share through the parameters is one error, not many.
    Exact for linear readings whose noise has no memory across the rows.
    """
    fold, rest = posterior.slopes[rows], posterior.slopes[~rows]
    factor = cho_factor(rest.T @ rest + np.eye(posterior.xi.size))
    step = cho_solve(factor, rest.T @ posterior.residual[~rows] - posterior.xi)
    covariance = np.eye(len(fold)) + fold @ cho_solve(factor, fold.T)
    return posterior.residual[rows] - fold @ step, covariance


def log_predictive(posterior: Posterior, rows: NDArray[np.bool_]) -> float:
    """ln of the joint density of the rows not fitted, without the m ln(2 pi)/2 that all hypotheses share."""
    residual, covariance = predictive(posterior, rows)
    squares = residual @ cho_solve(cho_factor(covariance), residual)
    return -0.5 * float(squares) - 0.5 * float(np.linalg.slogdet(covariance)[1])


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
