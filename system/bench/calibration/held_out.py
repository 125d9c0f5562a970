"""Calibration: prediction of held-out levels by a fitted pump and by the loss models of the literature."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.bench.loss_models.bench import MODELLED, loss_model_bench, modelled
from system.bench.loss_models.catalogue import LOSS_MODELS
from system.bench.loss_models.model import LossModel, LossModelName
from system.bench.loss_models.orders import polymod_for
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.estimation.fit import maximum_posterior
from system.estimation.folds import left_out, levels
from system.estimation.observations import Observations
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName

PHYSICS = "physics"
"""Name of the fitted pump among the models."""


class Split(Enum):
    """Points held out together: none, or one after the other the levels of an axis."""

    NONE = "none"
    SPEED = "speed"
    PRESSURE = "pressure"
    DISPLACEMENT = "displacement"


@dataclass(frozen=True)
class HeldOutRow:
    """RMS error of a model in a channel, SI, and the rms of the noise there.

    split NONE: of the fitted points; else of levels left out one by one. coefficients: number in the model for the
    channel, 0 for physics, whose parameters are common to all.
    """

    model: str
    split: Split
    channel: ChannelName
    rms: float
    noise: float
    coefficients: int


def split_levels(points: BenchPoints) -> Mapping[Split, NDArray[np.int64]]:
    """Levels (N,) of each axis that has more than one; NONE is not among them."""
    axes = {
        Split.SPEED: points.speed,
        Split.PRESSURE: points.p_out - points.p_in,
        Split.DISPLACEMENT: points.displacement_ratio,
    }
    found = {split: levels(axis) for split, axis in axes.items()}
    return {split: level for split, level in found.items() if level.max() > 0}


def physics_rows(posterior: Posterior, observations: Observations, points: BenchPoints) -> tuple[HeldOutRow, ...]:
    """The fitted pump's rows in the channels that loss models give; fits repeated by one linear step.

    Raises InputError where delivery flow or torque was not measured.
    """
    modelled(observations)
    misses = {Split.NONE: observations.values - posterior.predictions}
    misses |= {split: left_out(posterior, level) for split, level in split_levels(points).items()}
    names = [channel.name for channel in observations.channels]
    own = [names.index(channel.value) for channel in MODELLED]
    sigma = posterior.whitening.sigma[:, own]
    measured = observations.measured[:, own]
    return tuple(
        row for split, miss in misses.items() for row in _rows(PHYSICS, split, miss[:, own], sigma, measured, (0, 0))
    )


def model_rows(
    name: LossModelName,
    pump: PumpDescription,
    points: BenchPoints,
    inputs: tuple[ChannelName, ...],
    observations: Observations,
) -> tuple[HeldOutRow, ...]:
    """A loss model's rows: fitted anew without each level, Polymod's orders chosen anew too.

    Raises InputError where delivery flow or torque was not measured.
    """
    own = modelled(observations)

    def fitted(readings: Observations) -> tuple[LossModel, Posterior]:
        model = LOSS_MODELS[name] if name in LOSS_MODELS else polymod_for(pump, points, inputs, readings)
        return model, maximum_posterior(loss_model_bench(model, pump, points, inputs), readings)

    model, whole = fitted(own)
    sigma, measured = whole.whitening.sigma, own.measured
    counts = len(model.flow), len(model.torque)
    rows = [*_rows(name.value, Split.NONE, own.values - whole.predictions, sigma, measured, counts)]
    for split, level in split_levels(points).items():
        miss = np.full_like(own.values, np.nan)
        for one in np.unique(level):
            without = level == one
            miss[without] = (own.values - fitted(own.without(without))[1].predictions)[without]
        rows += _rows(name.value, split, miss, sigma, measured, counts)
    return tuple(rows)


def _rows(
    model: str, split: Split, miss: Array, sigma: Array, measured: NDArray[np.bool_], coefficients: Sequence[int]
) -> list[HeldOutRow]:
    def rms(values: Array, at: int) -> float:
        return float(np.sqrt(np.mean(values[measured[:, at], at] ** 2)))

    return [
        HeldOutRow(model, split, channel, rms(miss, at), rms(sigma, at), coefficients[at])
        for at, channel in enumerate(MODELLED)
    ]
