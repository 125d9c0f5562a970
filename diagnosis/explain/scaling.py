"""Power law of a mismatch: exponents of speed, pressure, displacement and viscosity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

STEPS = 50
LARGEST_STEP = 1.0  # of an exponent


@dataclass(frozen=True)
class Scaling:
    """Residual of a channel ~ powers of speed, pressure, displacement, viscosity: exponents and their sigma.

    above: the channel reads more than simulated.
    """

    channel: ChannelName
    above: bool
    exponents: Mapping[str, float]
    sigma: Mapping[str, float]


def scaling(
    channel: ChannelName, signal: Array, sigma: Array, coordinates: Mapping[str, Array], least_range: float
) -> Scaling | None:
    """Exponents n_k of signal = C prod x_k^n_k: least squares on the signal itself, part of which may be noise.

    signal, sigma: (N,) in SI; coordinates: (N,) each, positive where a point counts; a coordinate whose values vary by
    less than `least_range` times gets no exponent. Sigma of the exponents is scaled with the residual of the power law
    (Birge 1932), where that is more than noise. None for too few points or without a power law.
    """
    used = np.isfinite(signal) & (sigma > 0)
    for values in coordinates.values():
        used &= values > 0
    moving = {
        name: values[used] for name, values in coordinates.items() if used.any() and moves(values[used], least_range)
    }
    if used.sum() < len(moving) + 2:
        return None
    logs = np.stack([np.ones(int(used.sum())), *(np.log(x / np.median(x)) for x in moving.values())], axis=1)
    fitted = _power_law(signal[used] / sigma[used], logs, 1.0 / sigma[used])
    if fitted is None:
        return None
    exponents, spread = fitted
    names = list(moving)
    return Scaling(
        channel,
        bool(np.sum(signal[used] / sigma[used] ** 2) > 0.0),
        dict(zip(names, exponents[1:].tolist(), strict=True)),
        dict(zip(names, spread[1:].tolist(), strict=True)),
    )


def _power_law(target: Array, logs: Array, weight: Array) -> tuple[Array, Array] | None:
    """ln C and exponents (1 + k,) of sign x exp(logs n) weight = target, and their sigma, or None."""
    sign = float(np.sign(target @ weight))
    start = float(np.log(np.abs(target @ weight) / (weight @ weight) + 1e-300))
    found = np.r_[start, np.zeros(logs.shape[1] - 1)]
    objective = np.inf
    for _ in range(STEPS):
        model = sign * np.exp(logs @ found) * weight
        slopes = model[:, None] * logs
        left = target - model
        step = np.linalg.lstsq(slopes, left, rcond=None)[0]
        step *= min(1.0, LARGEST_STEP / max(float(np.abs(step).max()), 1e-300))
        while True:
            trial = target - sign * np.exp(np.clip(logs @ (found + step), -700.0, 700.0)) * weight
            if trial @ trial <= left @ left or np.abs(step).max() < 1e-9:
                break
            step = 0.5 * step
        found, objective = found + step, float(trial @ trial)
        if np.abs(step).max() < 1e-6:
            break
    else:
        return None
    precision = slopes.T @ slopes
    if np.linalg.cond(precision) > 1e12:
        return None
    excess = max(1.0, objective / max(target.size - found.size, 1))
    return found, np.sqrt(np.diag(np.linalg.inv(precision)) * excess)


def moves(values: Array, least_range: float) -> bool:
    """True if the largest value is more than `least_range` times the smallest."""
    return bool(values.max() > least_range * values.min())
