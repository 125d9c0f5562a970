"""Comparison of hypotheses: evidence of a fit, scores and evidences of columns outside the fit.

A column v is the whitened change of all readings by one spread of a parameter that the fit does not have. With the
fit's slopes A, precision H = A^T A + 1 and residual r everything follows from g = v.r and G = v.(v - A H^-1 A^T v):
linear and Gaussian, exact where the readings are linear in the parameters. All evidences are natural logarithms.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import inf, log, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.special import log_ndtr, logsumexp

from reynolds.numerics.arrays import Array
from system.estimation.posterior import Posterior

NOTHING_LEFT = 1e-12  # of a column's square: less is round-off of taking the fitted parameters out


class Sign(Enum):
    """Permitted sign of the size of an effect."""

    POSITIVE = "positive"
    NEGATIVE = "negative"
    EITHER = "either"


@dataclass(frozen=True)
class Score:
    """A column against a residual, the fitted parameters projected out.

    z: size over sigma; size, sigma in spreads of the column's parameter; projected: the whitened column (n,) less the
    part that the fitted parameters absorb. A column that they absorb completely has z = size = 0, sigma = inf.
    """

    z: float
    size: float
    sigma: float
    projected: Array


def score(posterior: Posterior, column: Array) -> Score:
    """Score test of one column (n,) (Rao 1948): z = g / sqrt G, size = g / G, sigma = 1 / sqrt G."""
    projected = project(posterior, column)
    content = float(column @ projected)
    if content <= NOTHING_LEFT * float(column @ column):
        return Score(0.0, 0.0, inf, projected)
    agreement = float(column @ posterior.residual)
    return Score(agreement / sqrt(content), agreement / content, 1.0 / sqrt(content), projected)


def project(posterior: Posterior, columns: Array) -> Array:
    """Whitened columns (n,) or (n, m) less the part that the fitted parameters absorb: v - A H^-1 A^T v."""
    taken = cho_solve(cho_factor(posterior.precision), posterior.slopes.T @ columns)
    return columns - posterior.slopes @ taken


def mixture_evidence(found: Score, widths: Sequence[float], sign: Sign) -> float:
    """ln evidence for a column over none, its size of prior N(0, w^2) averaged over the widths w (in spreads).

    For one width, V = 1/(G + 1/w^2) and m = V g: g^2 V / 2 - ln(1 + w^2 G) / 2, and with a sign
    + ln 2 + ln Phi(m / sqrt V) (docs/theory.md, Naming what was left out).
    """
    if found.sigma == inf:
        return 0.0
    content = found.sigma**-2
    agreement = found.size * content * (-1.0 if sign is Sign.NEGATIVE else 1.0)
    width = np.asarray(widths, dtype=float)
    variance = 1.0 / (content + width**-2)
    each = 0.5 * agreement**2 * variance - 0.5 * np.log1p(width**2 * content)
    if sign is not Sign.EITHER:
        each += log(2.0) + log_ndtr(agreement * np.sqrt(variance))
    return float(logsumexp(each)) - log(width.size)


def multiplier_evidence(posterior: Posterior, columns: Array, widths: Sequence[float]) -> float:
    """ln evidence for m columns (n, m) together over none, each of prior N(0, w^2), averaged over the widths w.

    For one width g^T (1/w^2 + G)^-1 g / 2 - ln det(1 + w^2 G) / 2 with g = V^T r, G = V^T P V.
    """
    return _averaged(columns.T @ posterior.residual, columns.T @ project(posterior, columns), widths)


def family_evidences(
    posterior: Posterior, columns: Array, families: Sequence[NDArray[np.int64]], widths: Sequence[float]
) -> Array:
    """(F,), `multiplier_evidence` of each family of the columns (n, m), given by its places."""
    agreement, content = columns.T @ posterior.residual, columns.T @ project(posterior, columns)
    found = [_by_width(agreement[own], content[np.ix_(own, own)], widths) for own in families]
    return np.asarray(logsumexp(np.array(found), axis=1)) - log(len(widths))


def taken_up(posterior: Posterior, columns: Array, widths: Sequence[float]) -> float:
    """Nats of the objective that columns (n, m) absorb, g^T (1/w^2 + G)^-1 g / 2, at the width of most evidence."""
    width = max(widths, key=lambda width: multiplier_evidence(posterior, columns, [width]))
    agreement, content = columns.T @ posterior.residual, columns.T @ project(posterior, columns)
    return 0.5 * float(agreement @ np.linalg.solve(content + np.eye(len(content)) / width**2, agreement))


def multiplier_evidences_without(
    posterior: Posterior, columns: Array, parts: NDArray[np.int64], widths: Sequence[float]
) -> Array:
    """(P,), `multiplier_evidence` without the readings of one part at a time, in the order of the parts' numbers.

    `parts` (n,) numbers the readings. The fit without a part is repeated in its linear form; the fit must be at
    the peak of that form (`linear_posterior`, `settled`).
    """
    count = posterior.xi.size
    whole = np.column_stack((posterior.slopes, columns, posterior.residual))
    products = whole.T @ whole
    products[:count, :count] += np.eye(count)
    products[:count, -1] -= posterior.xi
    found = []
    for part in np.unique(parts):
        own = whole[parts == part]
        left = products - own.T @ own
        taken = cho_solve(cho_factor(left[:count, :count]), left[:count, count:])
        rest = left[count:, count:] - left[:count, count:].T @ taken
        found.append(_averaged(rest[:-1, -1], rest[:-1, :-1], widths))
    return np.array(found)


def _averaged(agreement: Array, content: Array, widths: Sequence[float]) -> float:
    """ln evidence of columns with g = `agreement` (m,) and G = `content` (m, m), averaged over prior widths."""
    return float(logsumexp(_by_width(agreement, content, widths))) - log(len(widths))


def _by_width(agreement: Array, content: Array, widths: Sequence[float]) -> Array:
    """The same for each prior width, (W,)."""
    level, axes = np.linalg.eigh(0.5 * (content + content.T))
    level = np.maximum(level, 0.0)
    along = (axes.T @ agreement) ** 2
    width = np.asarray(widths, dtype=float)[:, None]
    return np.asarray(0.5 * (along / (width**-2 + level) - np.log1p(width**2 * level)).sum(axis=1))
