"""Rivals from statistics on a study of steady points: Kennedy-O'Hagan, localise and test, embedded discrepancy."""

from __future__ import annotations

from warnings import catch_warnings, simplefilter

import numpy as np
from numpy.typing import NDArray
from proof.outcome import Rival
from scipy.optimize import minimize_scalar
from scipy.stats import false_discovery_control, norm
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern

from diagnosis.study.model import SUBJECTS, Study
from reynolds.numerics.arrays import Array
from system.estimation.evidence import score

TRIED = 5
"""Columns of the largest score that are tried together with a discrepancy."""
LOCALISED = 10
"""Effects that one half of the points proposes to the other."""
FALSE_DISCOVERIES = 0.05
HEIGHT, LENGTH = (1e-2, 1e3), (0.2, 10.0)
"""Bounds of a discrepancy's variance over that of the noise, and of its lengths on axes scaled to [-1, 1]."""
LARGEST_SPREAD = 1e3
SEED = 25


def rivals(study: Study) -> dict[str, Rival]:
    """The finding of each method, by the name of its entry."""
    return {
        "kennedy-ohagan": kennedy_ohagan(study),
        "localise-and-test": localise_and_test(study),
        "embedded-discrepancy": embedded_discrepancy(study),
    }


def kennedy_ohagan(study: Study) -> Rival:
    """Model, model with one more effect, and each with a smooth discrepancy (Kennedy and O'Hagan 2001), by Schwarz.

    The discrepancy of a channel is a Gaussian process whose variance and lengths maximise the likelihood; a channel has
    it where Schwarz' criterion (1978) falls. The criterion chooses among all models.
    """
    base = study.base
    found = {at: score(base, each.column) for at, each in enumerate(study.candidates)}
    best, named = _smooth(study, base.residual), tuple[str, ...]()
    alarm = best > 0.0
    for at in sorted(found, key=lambda one: -abs(found[one].z))[:TRIED]:
        own = found[at]
        gain = 0.5 * own.z**2 - 0.5 * np.log(base.residual.size)
        gain += _smooth(study, base.residual - own.size * own.projected)
        if gain > best:
            best, named, alarm = gain, (study.candidates[at].entry.id.value,), True
    return Rival(bool(alarm), named)


def _smooth(study: Study, white: Array) -> float:
    """Gain of ln likelihood by discrepancies of the steady channels, less Schwarz' penalty; 0 where none gains."""
    whitening, measured = study.base.whitening, study.observations.measured
    residual = whitening.unwhiten(white) / whitening.sigma
    whole = 0.0
    for at in range(len(study.channels)):
        rows = measured[:, at]
        own, places = residual[rows, at], study.axes[rows]
        kernel = ConstantKernel(1.0, HEIGHT) * Matern(np.ones(places.shape[1]), LENGTH, nu=1.5)
        with catch_warnings():
            simplefilter("ignore", ConvergenceWarning)  # at a bound: no discrepancy, or one of noise
            process = GaussianProcessRegressor(kernel, alpha=1.0).fit(places, own)
        plain = -0.5 * (own @ own + own.size * np.log(2.0 * np.pi))
        gain = process.log_marginal_likelihood_value_ - plain
        whole += max(0.0, gain - 0.5 * kernel.theta.size * np.log(own.size))
    return whole


def localise_and_test(study: Study) -> Rival:
    """One half of the points proposes effects, the other tests them: the strongest of its discoveries, if any.

    Halves are drawn at random, so that no reading is used twice; false discoveries by Benjamini and Hochberg 1995.
    """
    points = study.base.whitening.rows[:, 0]
    first = np.random.default_rng(SEED).permutation(int(points.max()) + 1) % 2 == 0
    proposed: dict[str, tuple[float, int]] = {}
    for at, z in enumerate(_scores(study, first[points])):
        name = study.candidates[at].entry.id.value
        proposed[name] = max(proposed.get(name, (0.0, at)), (abs(z), at))
    chosen = sorted(proposed, key=lambda name: -proposed[name][0])[:LOCALISED]
    tested = _scores(study, ~first[points])
    chances = np.array([2.0 * norm.sf(abs(tested[proposed[name][1]])) for name in chosen])
    if false_discovery_control(chances).min() > FALSE_DISCOVERIES:
        return Rival(False, ())
    return Rival(True, (chosen[int(np.argmin(chances))],))


def _scores(study: Study, rows: Array) -> list[float]:
    """z of each candidate by some of the rows (n,), with the parameters fitted to them."""
    base = study.base
    offset, slopes = (base.residual + base.slopes @ base.xi)[rows], base.slopes[rows]
    columns = np.stack([each.column[rows] for each in study.candidates], axis=1)
    precision = slopes.T @ slopes + np.eye(base.xi.size)
    left = columns - slopes @ np.linalg.solve(precision, slopes.T @ columns)
    content = (columns * left).sum(axis=0)
    usable = content > 1e-6 * (columns**2).sum(axis=0)
    return list(np.where(usable, left.T @ offset, 0.0) / np.sqrt(np.where(usable, content, 1.0)))


def embedded_discrepancy(study: Study) -> Rival:
    """The parameter that would have to vary from point to point (Sargsyan, Najm and Ghanem 2015), if any.

    Each parameter in turn is N(0, s^2) anew at each point, s by the largest likelihood; Schwarz' criterion decides,
    with the number of parameters that are tried in its penalty (Chen and Chen 2008).
    """
    base, points = study.base, study.base.whitening.rows[:, 0]
    gains = []
    for slope in base.slopes.T:
        agreement = np.bincount(points, slope * base.residual)
        content = np.bincount(points, slope * slope)
        gains.append(_varying(agreement, content))
    best = int(np.argmax(gains))
    if gains[best] < 0.5 * np.log(base.residual.size) + np.log(len(gains)):
        return Rival(False, ())
    name = base.parameters[best].name
    ids = [one.value for one, subject in SUBJECTS.items() if name == subject or name.startswith(f"{subject}.")]
    return Rival(True, tuple(ids[:1]))


def _varying(agreement: NDArray[np.number], content: NDArray[np.number]) -> float:
    """Largest gain of ln likelihood over s of a parameter that is N(0, s^2) at each point."""

    def loss(log_variance: float) -> float:
        variance = np.exp(log_variance)
        return float(0.5 * (np.log1p(variance * content) - variance * agreement**2 / (1.0 + variance * content)).sum())

    bounds = (-2.0 * np.log(LARGEST_SPREAD), 2.0 * np.log(LARGEST_SPREAD))
    return max(0.0, -float(minimize_scalar(loss, bounds=bounds, method="bounded").fun))
