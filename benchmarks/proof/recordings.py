"""From a case to its recording: sized, drawn, run, read."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .campaigns import campaigns, held
from .cases import Case, Concealed
from .plant.bench import run
from .plant.hidden import NOTHING, Hidden
from .plant.machine import Array, Machine, drawn, ref90
from .sensors import Fault, Readings, read, set_in_truth
from .sizing import repeatability, shift, size_for, typical, z_of

STEPS = 360  # of a turn: .004 L/min, .02 N m from 720, a tenth of the noise


@dataclass(frozen=True)
class Made:
    """A recording with the truth behind it: the score reached, sizes of what is concealed, shares of the channels
    in the square of the shift (in sigma), and the machine as it was.
    """

    readings: Readings
    score: float
    sizes: dict[str, float]
    shares: dict[str, float]
    machine: Machine


def make(case: Case) -> Made:
    """The recording of a case: the same for the same case."""
    rng = np.random.default_rng(case.seed)
    factors, scores = sized(case)
    hidden, faults = _together(case.concealed, factors)
    machine = _worn(drawn(ref90(), rng), case.concealed, factors)
    campaign = campaigns()[case.campaign]
    at = held(campaign, rng)
    truth = run(machine, set_in_truth(at, rng), hidden, STEPS)
    readings = read(campaign, at, truth, faults, rng)
    sizes = {one.label: factor * _size(one) for one, factor in zip(case.concealed, factors, strict=True)}
    moved = shift(case.campaign, hidden, faults, _worn(typical(), case.concealed, factors))
    return Made(readings, float(np.sqrt(np.sum(np.square(scores)))), sizes, _shares(case, moved), machine)


def sized(case: Case) -> tuple[list[float], list[float]]:
    """Factors by which each concealed thing has the score asked for (0: its own size), and scores reached."""

    def score(one: Concealed, factor: float) -> float:
        hidden, faults = _together((one,), [factor])
        return z_of(case.campaign, shift(case.campaign, hidden, faults, _worn(typical(), (one,), [factor])))

    if case.score == 0.0:
        return [1.0 for _ in case.concealed], [score(one, 1.0) for one in case.concealed]
    found = [
        size_for(case.score, lambda f, one=one: score(one, f), _start(one), one.most) for one in case.concealed
    ]
    return [factor for factor, _ in found], [reached for _, reached in found]


def _start(one: Concealed) -> float:
    return 0.2 if one.wrong is not None else 1.0


def _together(concealed: tuple[Concealed, ...], factors: list[float]) -> tuple[Hidden, tuple[Fault, ...]]:
    hidden, faults = NOTHING, []
    for one, factor in zip(concealed, factors, strict=True):
        changed = {k: v for k, v in vars(one.hidden.scaled(factor)).items() if v != 0.0}
        hidden = replace(hidden, **changed)
        if one.fault is not None:
            faults.append(one.fault.scaled(factor))
    return hidden, tuple(faults)


def _worn(machine: Machine, concealed: tuple[Concealed, ...], factors: list[float]) -> Machine:
    """The machine with its wrong parts: exp(factor) times what the drawing says."""
    for one, factor in zip(concealed, factors, strict=True):
        if one.wrong is not None:
            part, sign = one.wrong
            machine = replace(machine, **{part: getattr(ref90(), part) * float(np.exp(sign * factor))})
    return machine


def _size(one: Concealed) -> float:
    """The size at factor 1, SI."""
    if one.wrong is not None:
        return one.wrong[1]
    if one.fault is not None:
        return one.fault.gain or one.fault.zero or one.fault.drift
    return max(vars(one.hidden).values(), key=abs)


def _shares(case: Case, moved: Array) -> dict[str, float]:
    campaign = campaigns()[case.campaign]
    strength = ((moved / repeatability(case.campaign)) ** 2).sum(axis=0)
    total = strength.sum()
    shares = strength / total if total > 0.0 else strength
    return dict(zip(campaign.outputs, (float(one) for one in shares), strict=True))
