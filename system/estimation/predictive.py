"""Readings that took no part in a fit, as the fit predicts them."""

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
