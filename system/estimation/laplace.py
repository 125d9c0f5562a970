"""Evidence of a fit about its peak, with priors that end at bounds."""

import numpy as np
from scipy.special import log_ndtr

from reynolds.numerics.arrays import Array


def laplace(objective: float, precision: Array) -> float:
    """ln evidence -J/2 - ln det(precision)/2 of a peak (Laplace 1774; MacKay 2003, chapter 27).

    J = r.r + xi.xi; constants that all hypotheses on the same readings share are left out. Exact where the
    readings are linear in the parameters and no bound is near.
    """
    return -0.5 * objective - 0.5 * float(np.linalg.slogdet(precision)[1])


def log_mass(centre: Array, sigma: Array, lowest: Array, highest: Array) -> Array:
    """ln of the mass of N(centre, sigma^2) between two bounds, without loss of digits in either tail."""
    low, high = (lowest - centre) / sigma, (highest - centre) / sigma
    mirrored = low > 0
    low, high = np.where(mirrored, -high, low), np.where(mirrored, -low, high)
    upper, lower = log_ndtr(high), log_ndtr(low)
    mass: Array = upper + np.log1p(-np.exp(lower - upper))
    return mass
