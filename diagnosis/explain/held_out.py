"""Prediction of points not used in a fit: regions with a veto, and random fifths."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from diagnosis.explain.model_error import by_form
from diagnosis.explain.ranked import HeldOut
from diagnosis.study.model import Study
from diagnosis.thresholds import HeldOutLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.estimation.folds import left_out, log_predictive
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName

Marks = NDArray[np.bool_]

THIRD = 1.0 / 3.0  # of a scaled axis -1 .. 1: points beyond it are in an outer third
PARTS = 5


def held_out(
    study: Study, null: Posterior, own: Posterior, thresholds: Thresholds, rival: Posterior | None = None
) -> HeldOut:
    """Gains of an explanation over the null in regions left out, and residuals of random fifths left out.

    rival: for an explanation by a wrong value, the null within its tolerances (`refit.within_tolerance`). The gains are
    over this fit, and only `beyond_chance` vetoes: both are of one form, and several small losses are the cost of the
    wider prior.

    The gain of a fold is the ln ratio of the two joint predictive densities of its readings, each fit repeated
    without them by one linear step. For the veto (`has_veto`) gains are divided by the error of form (`by_form`).
    RMS in SI; `noise`: of repeatability and inputs alone.
    """
    less = rival or null
    folds = regions(study, (less, own), thresholds.heldout)
    gains = {name: _density(own, points) - _density(less, points) for name, points in folds.items()}
    form_factor = by_form(own.log_evidence - null.log_evidence, thresholds)
    veto = has_veto if rival is None else beyond_chance
    vetoed = veto(np.array(list(gains.values())) / form_factor, thresholds.heldout)
    fifths = _fifths(len(study.axes), thresholds.seeds.locate)
    measured = study.observations.measured

    def rms(residual: Array) -> dict[ChannelName, float]:
        return {
            name: float(np.sqrt(np.mean(residual[measured[:, at], at] ** 2)))
            for at, name in enumerate(study.channels)
            if measured[:, at].any()
        }

    how = f"gains: left out one by one: {', '.join(folds) or 'no region'}; residuals: random fifths of the points"
    after = left_out(own, fifths)
    return HeldOut(gains, rms(left_out(null, fifths)), rms(after), rms(own.whitening.sigma), vetoed, how)


def regions(study: Study, fits: tuple[Posterior, ...], limits: HeldOutLimits) -> Mapping[str, Marks]:
    """Points (N,) of each region by name: outer thirds of the map's axes, at most half of all points.

    A region is excluded if a parameter of one of the fits would be undetermined without it: it tests the prior.
    """
    speed, pressure, stroke, warmth = study.axes.T
    all_regions = {
        "high pressure": pressure > THIRD,
        "low speed": speed < -THIRD,
        "high speed": speed > THIRD,
        "part stroke": stroke < -THIRD,
        "hot": warmth > THIRD,
        "cold": warmth < -THIRD,
    }
    return {
        name: points
        for name, points in all_regions.items()
        if limits.least_points <= points.sum() <= len(points) / 2
        and not any(_tests_a_prior(fit, _rows(fit, points), limits) for fit in fits)
    }


def has_veto(gains: Array, limits: HeldOutLimits) -> bool:
    """True if regions veto: by more than chance allows for so many, or by several losses that gains do not outweigh."""
    negative = np.count_nonzero(gains < limits.negative_gain)
    outweighed = negative >= limits.veto_regions and gains.sum() < 0.0
    return bool(outweighed or beyond_chance(gains, limits))


def beyond_chance(gains: Array, limits: HeldOutLimits) -> bool:
    """True if the regions lose more than chance allows for so many.

    Under a true explanation exp(-gain) has a mean of at most 1 in each region, and so has its mean over all regions: it
    exceeds K with a chance of 1/K at most (Markov), for any number of regions.
    """
    return bool(gains.size and logsumexp(-gains) - np.log(gains.size) > -limits.veto_gain)


def _rows(posterior: Posterior, points: Marks) -> Marks:
    """Whitened rows (n,) of the points."""
    return points[posterior.whitening.rows[:, 0]]


def _tests_a_prior(posterior: Posterior, rows: Marks, limits: HeldOutLimits) -> bool:
    rest = posterior.slopes[~rows]
    without = np.diag(np.linalg.inv(rest.T @ rest + np.eye(rest.shape[1])))
    return bool(np.any((without > limits.open) & (np.diag(posterior.covariance) < limits.half * without)))


def _density(posterior: Posterior, points: Marks) -> float:
    """ln of the joint density of the points' readings in SI, up to a constant that all fits share."""
    white = np.log(np.einsum("nii->ni", posterior.whitening.factors))[points]
    return log_predictive(posterior, _rows(posterior, points)) + float(white.sum())


def _fifths(points: int, seed: int) -> NDArray[np.int64]:
    return np.random.default_rng(seed).permutation(np.arange(points) % PARTS)
