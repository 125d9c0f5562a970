"""The ceiling of the proof's names: each plant as its own simulator.

A recording is the white shift of the concealed causes, as in the score z, and noise of unit size. It is explained by as
many of the plant's own laws, faults and wrong parts as are concealed, each by its shift at z = 8 and of free size, an
effect's not negative. The truth is right where no other set of ids gains more by over 3 nats, the gap of a class, and
where each cause adds more than its odds before any reading. Physics in no catalogue is recognised where no law of the
plant comes within 3 nats of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial
from itertools import combinations
from math import log
from statistics import mean

import numpy as np
from numpy.typing import NDArray

from diagnosis.thresholds import load_thresholds

from . import cases as first
from .other import cases as other
from .other.sizing import MOST_FAULT, sized as sized_other, white_shift as shift_of_other
from .parts import Part, Plant
from .recordings import sized as sized_first, white_shift as shift_of_first
from .rough import cases as rough
from .rough.recordings import drawn_bench
from .rough.sizing import noise, sized as sized_rough, white_shift as shift_of_rough, whitening_of
from .told import Told, told
from .wide.case import Secret, What, WideCase
from .wide.gates import BOTH, CLEAR

Array = NDArray[np.float64]
TITLE = "Ceiling: each plant as its own simulator"
TEXT = """How often names are right for one who has the plant's own laws, all that the score z takes as uncertain, and
the number of causes. A recording is the shift of what is concealed and noise. Every law, fault and wrong part of the
plant is a rival, by its shift at z = 8. A class counts as above: no rival gains more by over 3 nats. The program has
laws of another form and lets leakage and friction depart from them over the map. On pumps known by their type plate
it also takes meters to be of their stated class. What it misses below these numbers is lost there."""
ROWS = (
    "top-1 at z >= 8",
    "top-1 at z = 5",
    "both of two effects, z >= 10 each",
    "unknown physics recognised at z >= 8",
)
ALONE, PAIR, UNKNOWN = range(3)
KINDS = {
    Part.GRADED: ALONE, Part.PARAMETER: ALONE, Part.SENSOR: ALONE, Part.PAIR: PAIR, Part.UNKNOWN: UNKNOWN,
    Part.OTHER_GRADED: ALONE, Part.OTHER_PARAMETER: ALONE, Part.OTHER_SENSOR: ALONE, Part.OTHER_PAIR: PAIR,
    Part.OTHER_UNKNOWN: UNKNOWN, Part.ROUGH_EFFECT: ALONE, Part.ROUGH_SENSOR: ALONE, Part.ROUGH_PAIR: PAIR,
    Part.ROUGH_UNKNOWN: UNKNOWN,
}  # fmt: skip
CASES = 30  # of each part, from its first
DRAWS = 200
SIZE = 8.0
TINY = 1e-9
SEEN = 1.0  # score below which a rival is not visible
Shift = Callable[[float], Array]


@dataclass(frozen=True)
class Law:
    """One possible cause: its id, its white shift (N,), whether its size may be negative."""

    id: str
    shift: Array
    is_signed: bool


@dataclass(frozen=True)
class Posed:
    """A case: its causes at their sizes, and the least of their scores; rivals at SIZE."""

    causes: tuple[Law, ...]
    score: float
    rivals: tuple[Law, ...]


def ceiling() -> Told:
    """The section of the page: a row a gate, a column a plant."""
    seed = load_thresholds().seeds.proof
    columns = [_of_plant(plant, seed) for plant in Plant]
    rows = tuple((name, *(column[k] for column in columns)) for k, name in enumerate(ROWS))
    return told(TITLE, TEXT, ("gate", "first plant", "other laws", "rough"), rows)


def right(posed: Posed, rng: np.random.Generator) -> float:
    """Share of DRAWS recordings in which the truth is named, by the number of its causes."""
    readings = _readings(posed, rng)
    truth = {one.id for one in posed.causes}
    own = _gain(posed.causes, readings)
    rivals = [one for one in posed.rivals if one.id not in truth]
    sets = combinations((*posed.causes, *rivals), len(posed.causes))
    beaten = np.max([_gain(each, readings) for each in sets if {one.id for one in each} != truth], axis=0)
    limits = load_thresholds()
    each = log(limits.prior.none / limits.prior.missing_physics * len({one.id for one in posed.rivals}))
    without = np.max([_gain(some, readings) for some in combinations(posed.causes, len(posed.causes) - 1)], axis=0)
    return float(np.mean((own >= beaten - limits.name.class_gap) & (own - without > each)))


def recognised(posed: Posed, rng: np.random.Generator) -> float:
    """Share of DRAWS recordings in which no rival comes near the concealed cause."""
    readings = _readings(posed, rng)
    nearest = np.max([_gain((one,), readings) for one in posed.rivals], axis=0)
    return float(np.mean(_gain(posed.causes, readings) > nearest + load_thresholds().name.odds))


def _readings(posed: Posed, rng: np.random.Generator) -> Array:
    shift = np.sum([one.shift for one in posed.causes], axis=0)
    return np.asarray(shift + rng.normal(size=(DRAWS, shift.size)))


def _gain(laws: Sequence[Law], readings: Array) -> Array:
    """Gain (M,) in log likelihood by the best sizes; by the best alone if one is negative and must not be."""
    if not laws:
        return np.zeros(len(readings))
    columns = np.stack([one.shift / np.linalg.norm(one.shift) for one in laws], axis=1)
    along = readings @ columns
    signed = np.array([one.is_signed for one in laws])
    alone = np.where(signed, along, np.maximum(along, 0.0)) ** 2
    sizes = np.linalg.lstsq(columns, readings.T, rcond=None)[0].T
    together = np.einsum("mk,mk->m", sizes, along)
    return np.asarray(0.5 * np.where((signed | (sizes >= 0.0)).all(axis=1), together, alone.max(axis=1)))


def _of_plant(plant: Plant, seed: int) -> tuple[str, ...]:
    """The shares of one plant in the order of ROWS."""
    rng = np.random.default_rng(seed)
    found: tuple[list[float], ...] = ([], [], [], [])
    for part, kind in KINDS.items():
        for case in first.cases(part, seed)[:CASES] if part.plant is plant else ():
            posed = _posed(case)
            if kind == UNKNOWN and posed.score >= CLEAR:
                found[3].append(recognised(posed, rng))
            elif kind == PAIR and posed.score >= BOTH:
                found[2].append(right(posed, rng))
            elif kind == ALONE and len(posed.causes) == 1 and posed.score >= CLEAR:
                found[0].append(right(posed, rng))
            elif kind == ALONE and len(posed.causes) == 1 and posed.score >= 4.5:
                found[1].append(right(posed, rng))
    return tuple(f"{mean(each):.1%} of {len(each)} cases" if each else "no case" for each in found)


def _posed(case: first.Case | WideCase) -> Posed:
    if isinstance(case, first.Case):
        return _of_first(case)
    return _of_other(case) if case.part.plant is Plant.OTHER else _of_rough(case)


def _of_first(case: first.Case) -> Posed:
    factors, scores = sized_first(case)
    causes = tuple(
        Law(one.id, shift_of_first(case.campaign, one, factor), not _is_effect(one))
        for one, factor in zip(case.concealed, factors, strict=True)
    )
    return Posed(causes, min(scores), _rivals_of_first(case.campaign))


def _is_effect(one: first.Concealed) -> bool:
    return one.fault is None and one.wrong is None


@cache
def _rivals_of_first(campaign: str) -> tuple[Law, ...]:
    known = (*first.PHYSICS, *first.PARAMETERS, *first.SENSORS)
    able = [one for one in known if campaign in first.NEEDS.get(one.label, (campaign,))]
    shifts = (_at_size(partial(shift_of_first, campaign, one), one.most) for one in able)
    return _seen(zip((one.id for one in able), shifts, (not _is_effect(one) for one in able), strict=True))


def _of_other(case: WideCase) -> Posed:
    factors, scores = sized_other(case)
    return Posed(
        _causes(case, factors, partial(shift_of_other, case.campaign)), min(scores), _rivals_of_other(case.campaign)
    )


@cache
def _rivals_of_other(campaign: str) -> tuple[Law, ...]:
    known = (*other.EFFECTS, *other.PARTS, *other.FAULTS)
    able = [one for one in known if campaign in other.NEEDS.get(one.label, (campaign,))]
    return _rivals(able, partial(shift_of_other, campaign))


def _of_rough(case: WideCase) -> Posed:
    bench, _ = drawn_bench(case, np.random.default_rng(case.seed))
    white = whitening_of(bench, noise(bench))
    factors, scores, _ = sized_rough(case, bench)
    able = [
        one
        for one in (*rough.EFFECTS, *rough.FAULTS)
        if one.what is What.EFFECT or one.label.split(".")[0] in bench.meters
    ]

    def shift(one: Secret, factor: float) -> Array:
        return shift_of_rough(bench, white, one, factor)

    return Posed(_causes(case, factors, shift), min(scores), _rivals(able, shift))


def _causes(case: WideCase, factors: Sequence[float], shift: Callable[[Secret, float], Array]) -> tuple[Law, ...]:
    return tuple(
        Law(one.id, shift(one, factor), one.what is not What.EFFECT)
        for one, factor in zip(case.secrets, factors, strict=True)
    )


def _rivals(able: Sequence[Secret], shift: Callable[[Secret, float], Array]) -> tuple[Law, ...]:
    shifts = (_at_size(partial(shift, one), min(one.most, MOST_FAULT)) for one in able)
    return _seen(zip((one.id for one in able), shifts, (one.what is not What.EFFECT for one in able), strict=True))


def _at_size(shift: Shift, most: float) -> Array:
    """The shift at about SIZE, by one step in proportion."""
    first = shift(min(1.0, most))
    return shift(min(min(1.0, most) * SIZE / max(float(np.linalg.norm(first)), TINY), most))


def _seen(laws: Iterator[tuple[str, Array, bool]]) -> tuple[Law, ...]:
    return tuple(Law(*each) for each in laws if np.linalg.norm(each[1]) >= SEEN)
