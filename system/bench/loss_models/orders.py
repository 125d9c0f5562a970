"""Orders of a polynomial by cross-validation: those that best predict the levels left out."""

from dataclasses import astuple
from itertools import product

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.bench.loss_models.bench import loss_model_bench
from system.bench.loss_models.model import LossModel
from system.bench.loss_models.polynomials import Orders, polymod
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.estimation.folds import left_out, levels
from system.estimation.observations import Observations
from system.estimation.posterior import linear_posterior
from system.inputs.channels import ChannelName

HIGHEST = Orders(3, 4, 3)


def polymod_for(
    pump: PumpDescription, points: BenchPoints, inputs: tuple[ChannelName, ...], observations: Observations
) -> LossModel:
    """Polymod of the orders, one set for flow and one for torque, that best predicts these readings.

    Each level of speed, pressure difference and displacement is left out in turn; the orders' misfits there, in sigma,
    are compared. An axis of m levels allows m - 2 at most: with one more a level left out is predicted by a polynomial
    that passes through all others. `observations` are those of `modelled`; points without a reading do not count.
    """
    used = np.asarray(np.any(observations.measured, axis=1))
    axes = (points.speed, points.p_out - points.p_in, points.displacement_ratio)
    parts = [_levels(axis, used) for axis in axes]
    most = [
        min(highest, max(len(np.unique(part[used])) - 2, 0))
        for part, highest in zip(parts, astuple(HIGHEST), strict=True)
    ]
    tried = [Orders(*powers) for powers in product(*(range(min(1, top), top + 1) for top in most))]
    misfits = np.array([_misfit(polymod(o, o), pump, points, inputs, observations, parts) for o in tried])
    flow, torque = (tried[int(np.argmin(misfits[:, channel]))] for channel in range(2))
    return polymod(flow, torque)


def _levels(axis: Array, used: NDArray[np.bool_]) -> NDArray[np.int64]:
    found = np.zeros(len(axis), dtype=np.int64)
    found[used] = levels(axis[used])
    return found


def _misfit(
    model: LossModel,
    pump: PumpDescription,
    points: BenchPoints,
    inputs: tuple[ChannelName, ...],
    observations: Observations,
    parts: list[NDArray[np.int64]],
) -> tuple[float, float]:
    """Sum of the squares of prediction errors, in sigma, of flow and of torque."""
    fit = linear_posterior(loss_model_bench(model, pump, points, inputs), observations)
    sigma, found = fit.whitening.sigma, np.zeros(2)
    for part in parts:
        if np.unique(part).size > 1:
            found += ((left_out(fit, part) / sigma) ** 2).sum(axis=0)
    return float(found[0]), float(found[1])
