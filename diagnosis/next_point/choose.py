"""The next point to record: where two explanations part the most, and whether three readings there settle them.

What readings at a point would tell is the divergence of the two predictive distributions (Kullback and Leibler
1951; Box and Hill 1967).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np

from diagnosis.next_point.forecast import Contender, Forecast, forecasts, foretold, readings
from diagnosis.next_point.operating_box import BenchBox, rows
from diagnosis.study.model import Study
from diagnosis.thresholds import NextPointLimits
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints, operating_at
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.inputs.units import Dimension, format_quantity
from system.pump.operating import OperatingPoint

LOOKED_AT = 48  # points whose slopes are asked for: those where the predictions part the most
LEVELS = (6, 6, 3, 3)  # of speed, delivery pressure, displacement ratio, case temperature over the box


@dataclass(frozen=True)
class RankedPoint:
    """A point and the nats that readings there bring at least; temperatures as of a `NextPoint`."""

    point: OperatingPoint
    inlet_temperature: float
    gain: float


@dataclass(frozen=True)
class NextPoint:
    """The best point of a box for two explanations, and the odds after `limits.readings` readings there.

    point.temperature is that of the case; inlet_temperature, in K, what it goes with in the recording. between:
    the two in words, the likelier first; separates: their ids. before: ln odds of the first against the second by
    the recording; gain: nats that the readings bring on average, whichever of the two is true; after: ln odds for
    the true one that they lead to on average, and chance of odds of 20 to 1 for it, each the lesser of both cases.
    repeats: readings that bring `limits.enough` nats, None where `limits.most_repeats` do not;
    why: in words; ranked: all points whose gain was asked for, this one first; instead: what would settle the two
    where the point does not, in words; beyond: the box goes beyond what was recorded.
    """

    box: BenchBox
    point: OperatingPoint
    inlet_temperature: float
    between: tuple[str, str]
    separates: tuple[EffectId, ...]
    before: float
    gain: float
    after: float
    chance: float
    repeats: int | None
    why: str
    limits: NextPointLimits
    ranked: tuple[RankedPoint, ...] = ()
    beyond: bool = False
    instead: str = ""

    @property
    def settles(self) -> bool:
        """Whether the point is said to settle the two: odds of 20 to 1 are likely, whichever of them is true."""
        return self.chance >= self.limits.promised

    @property
    def is_open(self) -> bool:
        """Whether the recording leaves the odds of the two below 20 to 1."""
        return abs(self.before) < self.limits.settled


def next_point(
    study: Study,
    pump: PumpDescription,
    box: BenchBox,
    first: Contender,
    second: Contender,
    limits: NextPointLimits,
) -> NextPoint:
    """The point of a box at which `limits.readings` readings separate two explanations best."""
    points = box.points(tuple(_levels(*ends, count) for ends, count in zip(box.ends, LEVELS, strict=True)))
    best = np.sort(np.argsort(_parting(study, first, second, points))[::-1][:LOOKED_AT])
    some = rows(points, best)
    found = list(forecasts(study, first, second, some))
    gains = [forecast.gain(limits.readings) for forecast in found]
    order = np.argsort(gains)[::-1]
    at = int(order[0])
    ranked = tuple(
        RankedPoint(operating_at(pump, some, place), float(some.T_in[place]), gains[place]) for place in order
    )
    before = log(first.probability / second.probability)
    after, chance = _led_to(found[at], before, limits)
    return NextPoint(
        box=box,
        point=ranked[0].point,
        inlet_temperature=ranked[0].inlet_temperature,
        between=(first.text, second.text),
        separates=tuple(dict.fromkeys((*first.effects, *second.effects))),
        before=before,
        gain=gains[at],
        after=after,
        chance=chance,
        repeats=next((n for n in range(1, limits.most_repeats + 1) if found[at].gain(n) >= limits.enough), None),
        why=_why(study, first, second, rows(some, np.array([at]))),
        limits=limits,
        ranked=ranked,
    )


def _led_to(forecast: Forecast, before: float, limits: NextPointLimits) -> tuple[float, float]:
    """ln odds for the true explanation after the readings, chance of `settled`, each the lesser of both cases."""
    cases = list(zip((before, -before), forecast.brought(limits.readings), strict=True))
    after = min(odds + told.mean for odds, told in cases)
    return after, min(told.chance(limits.settled - odds) for odds, told in cases)


def _levels(lower: float, upper: float, count: int) -> Array:
    return np.linspace(lower, upper, count) if upper > lower else np.array([lower])


def _parting(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Array:
    """(N,), sum over the channels of the squared difference of the two predictions, in sigma of a reading."""
    one, other = (foretold(contender, points) for contender in (first, second))
    read = readings(study, one)
    squares = np.where(read.measured, ((one - other) / read.sigma) ** 2, 0.0)
    return np.asarray(squares.sum(axis=1), dtype=float)


def _why(study: Study, first: Contender, second: Contender, point: BenchPoints) -> str:
    """In words: the channel in which the two part the most at the point, and by how much."""
    one, other = (foretold(contender, point)[0] for contender in (first, second))
    read = readings(study, one[None])
    apart = np.where(read.measured[0], np.abs(other - one) / read.sigma[0], 0.0)
    most = int(np.argmax(apart))
    channel = read.channels[most]
    told = [_told(value[most], channel.dimension) for value in (one, other)]
    return (
        f"there {channel.name} is {told[0]} by {first.text} and {told[1]} by {second.text}, "
        f"{apart[most]:.1f} sigma of one reading apart"
    )


def _told(value: float, dimension: Dimension | None) -> str:
    return f"{value:.4g}" if dimension is None else format_quantity(float(value), dimension, digits=4)
