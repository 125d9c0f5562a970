"""From a case to its recording: sized, drawn, run, read."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from .campaigns import campaigns, held
from .cases import Case, Concealed
from .other.plant.rig import Readout
from .plant.bench import Truth, run
from .plant.hidden import NOTHING, Hidden
from .plant.machine import Array, Machine, drawn, ref90
from .sensors import TRACE_NOISE, Fault, Readings, read, set_in_truth
from .sizing import repeatability, shift, size_for, typical, white

STEPS = 360  # of a turn: .004 L/min, .02 N m from 720, a tenth of the noise
TURN = 2.0 * np.pi
BULK = 0.8  # of a square, by which a window is stated


@dataclass(frozen=True)
class Made:
    """A recording with the truth behind it.

    score: reached; sizes: of the concealed causes; shift: of each channel's readings at the set points, in sigma of a
    reading; turn: shaft angles in rad between which the chamber's pressure is shifted, None without a trace. machine,
    hidden, faults, setting (relative error of strokes): the rig, for further points.
    """

    readings: Readings
    score: float
    sizes: dict[str, float]
    shift: dict[str, Array]
    turn: tuple[float, float] | None
    machine: Machine
    hidden: Hidden
    faults: tuple[Fault, ...]
    setting: float

    @property
    def shares(self) -> dict[str, float]:
        """Of the channels in the square of the shift."""
        strength = {name: float(np.sum(moved**2)) for name, moved in self.shift.items()}
        total = sum(strength.values()) or 1.0
        return {name: one / total for name, one in strength.items()}


def make(case: Case) -> Made:
    """The recording of a case: the same for the same case."""
    rng = np.random.default_rng(case.seed)
    factors, scores = sized(case)
    hidden, faults = _together(case.concealed, factors)
    sound = drawn(ref90(), rng)
    machine = _worn(sound, case.concealed, factors)
    campaign = campaigns()[case.campaign]
    at = held(campaign, rng)
    there = set_in_truth(at, rng)
    truth = run(machine, there, hidden, STEPS)
    return Made(
        readings=read(campaign, at, truth, faults, rng),
        score=float(np.sqrt(np.sum(np.square(scores)))),
        sizes={one.label: factor * _size(one) for one, factor in zip(case.concealed, factors, strict=True)},
        shift=_shift(case, hidden, faults, _worn(typical(), case.concealed, factors)),
        turn=moved_turn(truth, run(sound, there, NOTHING, STEPS), campaign.traces) if campaign.traces else None,
        machine=machine,
        hidden=hidden,
        faults=faults,
        setting=float(there.ratio[0] - at.ratio[0]),
    )


def moved_turn(truth: Truth | Readout, sound: Truth | Readout, points: tuple[int, ...]) -> tuple[float, float] | None:
    """The narrowest window of shaft angle, rad, that holds BULK of the square by which pressures differ.

    Of the trace with the largest shift; None where all shifts are below a sensor's noise.
    """
    apart = (truth.pressure - sound.pressure)[list(points)]
    most = apart[int(np.argmax(np.abs(apart).max(axis=1)))]
    if np.abs(most).max() < TRACE_NOISE:
        return None
    held_by = np.concatenate([[0.0], np.cumsum(np.tile(most**2, 2))])
    ends = np.searchsorted(held_by, held_by[: most.size] + BULK * np.sum(most**2))
    first = int(np.argmin(ends - np.arange(most.size)))
    last = (int(ends[first]) - 1) % most.size
    return float(truth.angle[first] % TURN), float(truth.angle[last] % TURN)


def sized(case: Case) -> tuple[list[float], list[float]]:
    """Factors at which each concealed cause has the requested score (0: its own size), and scores reached."""

    def score(one: Concealed, factor: float) -> float:
        return float(np.linalg.norm(white_shift(case.campaign, one, factor)))

    if case.score == 0.0:
        return [1.0 for _ in case.concealed], [score(one, 1.0) for one in case.concealed]
    found = [size_for(case.score, partial(score, one), _start(one), one.most) for one in case.concealed]
    return [factor for factor, _ in found], [reached for _, reached in found]


def white_shift(campaign: str, one: Concealed, factor: float) -> Array:
    """Shift of the readings of a campaign by one concealed cause, in units of the total uncertainty, (N C,)."""
    hidden, faults = _together((one,), [factor])
    return white(campaign, shift(campaign, hidden, faults, _worn(typical(), (one,), [factor])))


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
    """The machine with its wrong parts: exp(factor) times the value of the drawing."""
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


def _shift(case: Case, hidden: Hidden, faults: tuple[Fault, ...], machine: Machine) -> dict[str, Array]:
    moved = shift(case.campaign, hidden, faults, machine) / repeatability(case.campaign)
    return dict(zip(campaigns()[case.campaign].outputs, moved.T, strict=True))
