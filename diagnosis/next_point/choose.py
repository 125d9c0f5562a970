"""The next point to record, at which two explanations differ most, and the odds after readings there.

The gain of readings at a point is the divergence of the two predictive distributions (Kullback and Leibler 1951;
Box and Hill 1967).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np

from diagnosis.next_point.discrimination import promise
from diagnosis.next_point.forecast import Contender, Forecast, forecasts, predicted, readings
from diagnosis.next_point.operating_box import BenchBox, rows
from diagnosis.study.model import Study
from diagnosis.thresholds import NextPointLimits
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints, operating_at
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.inputs.units import Dimension, format_quantity
from system.pump.operating import OperatingPoint

LOOKED_AT = 48  # points whose slopes are computed: those where the predictions differ most
LEVELS = (6, 6, 3, 3)  # of speed, delivery pressure, displacement ratio, case temperature over the box


@dataclass(frozen=True)
class RankedPoint:
    """A point and the least gain of readings there in nats; temperatures as in `NextPoint`."""

    point: OperatingPoint
    inlet_temperature: float
    gain: float


@dataclass(frozen=True)
class ExpectedReading:
    """The reading in which two explanations differ most at a point: by the first, by the second, SI.

    apart: difference in sigma of one reading.
    """

    channel: str
    dimension: Dimension | None
    first: float
    second: float
    apart: float

    @property
    def texts(self) -> tuple[str, str]:
        """Both values with their unit."""
        one, other = (
            f"{value:.4g}" if self.dimension is None else format_quantity(value, self.dimension, digits=4)
            for value in (self.first, self.second)
        )
        return one, other


@dataclass(frozen=True)
class NextPoint:
    """The best point of a box for two explanations, and the odds after `limits.readings` readings there.

    point.temperature: of the case; inlet_temperature: in K, by the recording's difference to the case. between: the two
    as text, the likelier first; separates: their ids. before: ln odds of the first against the second by the recording;
    gain: mean gain of the readings in nats; after: mean ln odds for the true one; chance: of odds of 20 to 1 for it,
    each the lesser of both cases (first or second true). repeats: readings for a gain of `limits.enough`, None if
    `limits.most_repeats` do not reach it. expected: the reading in which the two differ most there; ranked: all points
    with a computed gain, this one first; instead: another test that settles the two, as text; beyond: the box exceeds
    the recorded range.
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
    expected: ExpectedReading
    limits: NextPointLimits
    ranked: tuple[RankedPoint, ...] = ()
    beyond: bool = False
    instead: str = ""

    @property
    def settles(self) -> bool:
        """True if odds of 20 to 1 are likely after the readings, whichever of the two is true."""
        return self.chance >= self.limits.promised

    @property
    def is_open(self) -> bool:
        """True if the odds of the two by the recording are below 20 to 1."""
        return abs(self.before) < self.limits.settled


def next_point(
    study: Study, pump: PumpDescription, box: BenchBox, first: Contender, second: Contender, limits: NextPointLimits
) -> NextPoint:
    """The point of a box at which `limits.readings` readings separate two explanations best."""
    points = box.points(tuple(_levels(*ends, count) for ends, count in zip(box.ends, LEVELS, strict=True)))
    best = np.sort(np.argsort(_separation(study, first, second, points))[::-1][:LOOKED_AT])
    some = rows(points, best)
    found = forecasts(study, first, second, some)
    gains = promise(np.zeros(1), found.gain(limits.readings)[None], np.inf)
    order = np.argsort(gains)[::-1]
    at = int(order[0])
    ranked = tuple(
        RankedPoint(operating_at(pump, some, place), float(some.T_in[place]), float(gains[place])) for place in order
    )
    before = log(first.probability / second.probability)
    there = found.at(at)
    after, chance = _led_to(there, before, limits)
    return NextPoint(
        box=box,
        point=ranked[0].point,
        inlet_temperature=ranked[0].inlet_temperature,
        between=(first.text, second.text),
        separates=tuple(dict.fromkeys((*first.effects, *second.effects))),
        before=before,
        gain=float(gains[at]),
        after=after,
        chance=chance,
        repeats=next((n for n in range(1, limits.most_repeats + 1) if there.gain(n) >= limits.enough), None),
        expected=_expected(study, first, second, rows(some, np.array([at]))),
        limits=limits,
        ranked=ranked,
    )


def _led_to(forecast: Forecast, before: float, limits: NextPointLimits) -> tuple[float, float]:
    """ln odds for the true explanation after the readings, chance of `settled`, each the lesser of both cases."""
    cases = list(zip((before, -before), forecast.odds(limits.readings), strict=True))
    after = min(odds + float(gain.mean) for odds, gain in cases)
    return after, min(float(gain.chance(limits.settled - odds)) for odds, gain in cases)


def _levels(lower: float, upper: float, count: int) -> Array:
    return np.linspace(lower, upper, count) if upper > lower else np.array([lower])


def _separation(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Array:
    """(N,), sum over the channels of the squared difference of the two predictions, in sigma of a reading."""
    one, other = (predicted(contender, points) for contender in (first, second))
    read = readings(study, one)
    squares = np.where(read.measured, ((one - other) / read.sigma) ** 2, 0.0)
    return np.asarray(squares.sum(axis=1), dtype=float)


def _expected(study: Study, first: Contender, second: Contender, point: BenchPoints) -> ExpectedReading:
    """The reading in which the two differ most at the point."""
    one, other = (predicted(contender, point)[0] for contender in (first, second))
    read = readings(study, one[None])
    apart = np.where(read.measured[0], np.abs(other - one) / read.sigma[0], 0.0)
    most = int(np.argmax(apart))
    channel = read.channels[most]
    return ExpectedReading(channel.name, channel.dimension, float(one[most]), float(other[most]), float(apart[most]))
