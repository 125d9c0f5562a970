"""Score of the concealed causes in the second plant, by that plant alone: beside noise, tolerances, calibrations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from ..campaigns import campaigns
from ..sensors import METERS, Fault, stated_sigma
from ..wide.case import Secret, What, WideCase
from ..wide.scoring import Whitening, sizes, whitening
from .plant.hidden import NOTHING, Hidden
from .plant.points import Array, Points
from .plant.pump import UNCERTAIN, Pump, varied
from .plant.rig import run

CALIBRATED = ("p_out", "T_case", "ratio")
SCATTERED = ("speed", "p_out", "p_in", "p_case", "T_case")
MOST_FAULT = 1e4  # times the size at factor 1


def concealed(secrets: Sequence[Secret], factors: Sequence[float]) -> tuple[Hidden, tuple[Fault, ...], Pump]:
    """Effects hidden in the plant, faults of its sensors, and the drawing with its wrong parts."""
    hidden, faults, pump = NOTHING, [], Pump()
    for one, factor in zip(secrets, factors, strict=True):
        size = factor * one.size
        if one.what is What.EFFECT:
            hidden = replace(hidden, **{one.label: size})
        elif one.what is What.FAULT:
            channel, error = one.label.split(".")
            faults.append(Fault(channel, **{error: size}))
        else:
            pump = replace(pump, **{one.label: getattr(pump, one.label) * float(np.exp(size))})
    return hidden, tuple(faults), pump


def sized(case: WideCase) -> tuple[list[float], list[float]]:
    """Factors by which each secret, beside the others, has the requested score (0: its own size); scores reached."""

    def white(k: int, factor: float) -> Array:
        return white_shift(case.campaign, case.secrets[k], factor)

    return sizes(case.score, white, [min(one.most, MOST_FAULT) for one in case.secrets])


def white_shift(campaign: str, one: Secret, factor: float) -> Array:
    """Shift of the readings of a campaign by one secret, in units of the total uncertainty, (N C,)."""
    return _whitening(campaign).white(shift(campaign, (one,), (factor,)))


def shift(name: str, secrets: Sequence[Secret], factors: Sequence[float]) -> Array:
    """Shift of the readings of a campaign, (N, C) SI."""
    campaign = campaigns()[name]
    hidden, faults, pump = concealed(secrets, factors)
    at = _points(name)
    for fault in faults:
        if fault.channel in campaign.inputs:
            at = replace(at, **{fault.channel: getattr(at, fault.channel) - fault.zero})
    found, along = _outputs(name, pump, at, hidden), np.linspace(0.0, 1.0, at.speed.size)
    for k, channel in enumerate(campaign.outputs):
        for fault in (one for one in faults if one.channel == channel):
            found[:, k] = found[:, k] * (1.0 + fault.gain) + fault.zero + fault.drift * along
    return found - _nominal(name)


def repeatability(name: str) -> Array:
    """One sigma (N, C) of a campaign's outputs, SI."""
    outputs = campaigns()[name].outputs
    return np.stack([stated_sigma(METERS[one], _nominal(name)[:, k]) for k, one in enumerate(outputs)], axis=1)


@cache
def _nominal(name: str) -> Array:
    return _outputs(name, Pump(), _points(name), NOTHING)


@cache
def _whitening(name: str) -> Whitening:
    at, base, outputs = _points(name), _nominal(name), campaigns()[name].outputs

    def moved(channel: str, change: float) -> Array:
        there = replace(at, **{channel: getattr(at, channel) + change})
        return _outputs(name, Pump(), there, NOTHING) - base

    shared = [_outputs(name, varied(Pump(), part, 1.0), at, NOTHING) - base for part in UNCERTAIN]
    shared += [moved(one, METERS[one].zero * METERS[one].scale) for one in CALIBRATED]
    along = np.linspace(-0.5, 0.5, len(base))
    for k, channel in enumerate(outputs):
        meter = METERS[channel]
        zero = meter.zero * meter.scale
        for pattern in (meter.gain * base[:, k], np.full(len(base), zero), 0.5 * zero * along):
            column = np.zeros_like(base)
            column[:, k] = pattern
            shared.append(column)
    own = [moved(one, METERS[one].sigma * METERS[one].scale) for one in SCATTERED]
    return whitening(repeatability(name), np.stack(shared), np.stack(own))


def _points(name: str) -> Points:
    return Points(**vars(campaigns()[name].points))


def _outputs(name: str, pump: Pump, at: Points, hidden: Hidden) -> Array:
    found = run(pump, at, hidden)
    return np.stack([getattr(found, channel) for channel in campaigns()[name].outputs], axis=1)
