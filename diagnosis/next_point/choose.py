"""The next test: points, and a meter if needed, at which two explanations differ most.

The gain of readings is the divergence of the two predictive distributions (Kullback and Leibler 1951; Box and Hill
1967). One point is proposed if it decides between the two, else up to POINTS different ones, chosen together as those
of a campaign are (`diagnosis.next_point.discrimination`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np
from numpy.typing import NDArray

from diagnosis.next_point.discrimination import added_points, promise
from diagnosis.next_point.forecast import Contender, Forecast, Foretold, Outlook, outlook, predicted, readings
from diagnosis.next_point.meters import WORDS
from diagnosis.next_point.operating_box import BenchBox, rows
from diagnosis.recording.model import RecordedChannel
from diagnosis.study.model import Study
from diagnosis.thresholds import NextPointLimits
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints, operating_at
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.inputs.units import Dimension, format_quantity
from system.pump.operating import OperatingPoint

LOOKED_AT = 48  # points whose slopes are computed: those where the predictions differ most
LEVELS = (6, 6, 3, 3, 2)  # of speed, delivery pressure, displacement ratio, case temperature, inlet pressure of the box
POINTS = 3  # largest number of points of a test
LEAST = 0.02  # least predicted gain of a further point, nats


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
    """The best test of a box for two explanations, and the odds after `limits.readings` readings at each of its points.

    point, others: the points, the one of the largest gain first; point.temperature: of the case; inlet_temperature: in
    K, by the recording's difference to the case; meter: the additional meter that it needs, or None. between: the two
    as text, the likelier first; separates: their ids. before: ln odds of the first against the second by the recording;
    gain: mean gain of the readings in nats; after: mean ln odds for the true one; chance: of odds of 20 to 1 for it,
    each the lesser of both cases (first or second true). repeats: readings at each point for a gain of `limits.enough`,
    None if `limits.most_repeats` do not reach it. expected: the reading in which the two differ most at `point`;
    ranked: all points with a computed gain by themselves, the best first; note: the reason for no point farther out, as
    text; beyond: the box exceeds the recorded range.
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
    others: tuple[RankedPoint, ...] = ()
    meter: RecordedChannel | None = None
    beyond: bool = False
    note: str = ""

    @property
    def settles(self) -> bool:
        """True if odds of 20 to 1 are likely after the readings, whichever of the two is true."""
        return self.chance >= self.limits.promised

    @property
    def is_open(self) -> bool:
        """True if the odds of the two by the recording are below 20 to 1."""
        return abs(self.before) < self.limits.settled

    @property
    def varies_inlet(self) -> bool:
        """True if the inlet pressure is an axis of the box."""
        return len(self.box.ends) > 4

    @property
    def places(self) -> tuple[RankedPoint, ...]:
        """All points of the test."""
        return (RankedPoint(self.point, self.inlet_temperature, self.gain), *self.others)

    @property
    def readings(self) -> int:
        """Readings of the whole test."""
        return self.limits.readings * (1 + len(self.others))

    @property
    def meter_words(self) -> str:
        """The meter that the bench needs in addition, in words; empty without one."""
        return "" if self.meter is None else WORDS[self.meter.name]


def next_point(
    study: Study, pump: PumpDescription, box: BenchBox, first: Contender, second: Contender, limits: NextPointLimits
) -> NextPoint:
    """The points of a box at which readings of the present bench separate two explanations best."""
    return _Ground.of(study, pump, box, (first, second), limits, ()).test(())


def metered_test(
    study: Study,
    pump: PumpDescription,
    box: BenchBox,
    first: Contender,
    second: Contender,
    limits: NextPointLimits,
    further: Sequence[RecordedChannel],
) -> NextPoint:
    """The best test of a box with one of some further meters: that of the largest chance of a decision."""
    ground = _Ground.of(study, pump, box, (first, second), limits, tuple(further))
    return max((ground.test((one,)) for one in further), key=lambda test: (test.chance, test.after))


@dataclass(frozen=True)
class _Ground:
    """The points of a box at which two explanations are predicted: those where they differ most."""

    pump: PumpDescription
    box: BenchBox
    points: BenchPoints
    outlook: Outlook
    two: tuple[Contender, Contender]
    limits: NextPointLimits

    @classmethod
    def of(
        cls,
        study: Study,
        pump: PumpDescription,
        box: BenchBox,
        two: tuple[Contender, Contender],
        limits: NextPointLimits,
        further: tuple[RecordedChannel, ...],
    ) -> _Ground:
        """The ground of a box, with the readings of further meters too."""
        axes = zip(box.ends, LEVELS, strict=False)
        points = box.points(tuple(_levels(*ends, count) for ends, count in axes))
        apart = _separation(study, *two, points, further)
        some = rows(points, np.sort(np.argsort(apart)[::-1][:LOOKED_AT]))
        return cls(pump, box, some, outlook(study, *two, some, further), two, limits)

    def test(self, meters: tuple[RecordedChannel, ...]) -> NextPoint:
        """The best test with some of the further meters."""
        first, second = self.two
        foretold = self.outlook.foretold(meters)
        gains = promise(np.zeros(1), foretold.each().gain(self.limits.readings)[None], np.inf)
        before = log(first.probability / second.probability)
        chosen = self._chosen(foretold, gains, before)
        found = foretold.together(chosen)
        after, chance = _led_to(found, before, self.limits)
        at, *others = (self._ranked(int(place), gains) for place in chosen)
        return NextPoint(
            box=self.box,
            point=at.point,
            inlet_temperature=at.inlet_temperature,
            between=(first.text, second.text),
            separates=tuple(dict.fromkeys((*first.effects, *second.effects))),
            before=before,
            gain=float(found.gain(self.limits.readings)),
            after=after,
            chance=chance,
            repeats=_repeats(found, self.limits),
            expected=_expected(self.outlook, int(chosen[0]), meters),
            limits=self.limits,
            ranked=tuple(self._ranked(int(place), gains) for place in np.argsort(gains)[::-1]),
            others=tuple(others),
            meter=meters[0] if meters else None,
        )

    def _chosen(self, foretold: Foretold, gains: Array, before: float) -> NDArray[np.int64]:
        """The points of the test: the best alone if it decides the two or they are decided, else up to POINTS."""
        best = np.array([np.argmax(gains)])
        settled = _led_to(foretold.together(best), before, self.limits)[1] >= self.limits.promised
        if settled or abs(before) >= self.limits.settled:
            return best
        none, once = np.zeros(len(gains), dtype=np.int64), np.ones(len(gains), dtype=np.int64)
        added = added_points(_TestPoints(foretold, self.limits.readings), none, once, POINTS, LEAST).points
        return np.array(sorted(added, key=lambda at: -gains[at]) or best, dtype=np.int64)

    def _ranked(self, place: int, gains: Array) -> RankedPoint:
        point = operating_at(self.pump, self.points, place)
        return RankedPoint(point, float(self.points.T_in[place]), float(gains[place]))


@dataclass(frozen=True)
class _TestPoints:
    """Points of a test for one pair (`diagnosis.next_point.discrimination.Campaign`), each read `readings` times."""

    foretold: Foretold
    readings: int

    def total(self, counts: NDArray[np.int64]) -> float:
        """Nats of the counted points together."""
        chosen = np.flatnonzero(counts)
        return float(self.foretold.together(chosen).gain(self.readings)) if chosen.size else 0.0

    def promised(self, counts: NDArray[np.int64]) -> Array:
        """(N,), nats that each point adds to the counted ones."""
        chosen, every = np.flatnonzero(counts), np.arange(len(counts))
        beside = np.column_stack([np.tile(chosen, (len(counts), 1)), every])
        return np.asarray(self.foretold.together(beside).gain(self.readings) - self.total(counts))


def _repeats(found: Forecast, limits: NextPointLimits) -> int | None:
    return next((n for n in range(1, limits.most_repeats + 1) if found.gain(n) >= limits.enough), None)


def _led_to(forecast: Forecast, before: float, limits: NextPointLimits) -> tuple[float, float]:
    """ln odds for the true explanation after the readings, chance of `settled`, each the lesser of both cases."""
    cases = list(zip((before, -before), forecast.odds(limits.readings), strict=True))
    after = min(odds + float(gain.mean) for odds, gain in cases)
    return after, min(float(gain.chance(limits.settled - odds)) for odds, gain in cases)


def _levels(lower: float, upper: float, count: int) -> Array:
    return np.linspace(lower, upper, count) if upper > lower else np.array([lower])


def _separation(
    study: Study, first: Contender, second: Contender, points: BenchPoints, further: tuple[RecordedChannel, ...]
) -> Array:
    """(N,), sum over the channels of the squared difference of the two predictions, in sigma of a reading."""
    one, other = (predicted(contender, points, further) for contender in (first, second))
    read = readings(study, one, further=further)
    squares = np.where(read.measured, ((one - other) / read.sigma) ** 2, 0.0)
    return np.asarray(squares.sum(axis=1), dtype=float)


def _expected(found: Outlook, place: int, meters: tuple[RecordedChannel, ...]) -> ExpectedReading:
    """The reading in which the two differ most at a point: of the added meter, if any."""
    count = len(found.study.channels)
    read = [count + found.further.index(one) for one in meters] or list(range(count))
    one, other = found.first[place], found.second[place]
    new = readings(found.study, found.first, further=found.further)
    apart = np.where(new.measured[place], np.abs(other - one) / new.sigma[place], 0.0)
    most = max(read, key=lambda at: apart[at])
    channel = new.channels[most]
    return ExpectedReading(channel.name, channel.dimension, float(one[most]), float(other[most]), float(apart[most]))
