"""Further meters of a bench, and the gain of each beside a campaign: the pairs that it separates."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.next_point.meters import WORDS
from diagnosis.planning.apart import Contest, all_pairs
from diagnosis.planning.responses import Foreseen, White, foresee_traces
from diagnosis.thresholds import FormLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.work.progress import Report, silent

BESIDE = (ChannelName.P_CHAMBER, ChannelName.TORQUE_UNCOUPLED)
"""Meters that read beside the points of a campaign, not at each of them."""
TRACED = 4
"""Points of the campaign at which a transducer records the chamber."""
UNCOUPLED = 2
"""Readings of the torque meter without the pump: before the campaign and after it."""


@dataclass(frozen=True)
class FurtherMeter:
    """A meter that the bench lacks: the responses of the bench with it, or its own readings beside any campaign.

    points: those of the campaign at which it reads beside.
    """

    channel: ChannelName
    white: White | None = None
    beside: White | None = None
    points: tuple[int, ...] = ()

    @property
    def name(self) -> str:
        """Name of its channel."""
        return self.channel.value

    @property
    def words(self) -> str:
        """The meter in words."""
        return WORDS[self.channel]

    def added_to(self, contest: Contest) -> Contest:
        """The contest with the meter."""
        if self.white is not None:
            return replace(contest, white=self.white)
        return contest if self.beside is None else replace(contest, beside=(*contest.beside, self.beside))

    def on(self, foreseen: Foreseen, channels: Collection[str]) -> FurtherMeter:
        """The same meter of a bench with other channels."""
        if self.white is None:
            return self
        return replace(self, white=foreseen.responses.white({*channels, self.name}))


@dataclass(frozen=True)
class MeterWorth:
    """A further meter: pairs that are separated only with it, and (S, S) distances with it."""

    name: str
    words: str
    pairs: tuple[tuple[int, int], ...]
    distances: Array


def further_meters(
    foreseen: Foreseen,
    channels: Collection[str],
    campaign: NDArray[np.int64],
    thresholds: Thresholds,
    report: Report = silent,
    known: Collection[str] | None = None,
) -> tuple[FurtherMeter, ...]:
    """The meters that a bench of these channels lacks; of those that are `known` by name, if names are stated."""
    lacking = (one for one in WORDS if one.value not in channels and (known is None or one.value in known))
    return tuple(
        further_meter(one, foreseen, read_at_points(channels), campaign, thresholds, report) for one in lacking
    )


def read_at_points(channels: Collection[str]) -> tuple[str, ...]:
    """The channels of a bench that are read at each point."""
    beside = {one.value for one in BESIDE}
    return tuple(name for name in channels if name not in beside)


def with_beside(
    contest: Contest,
    foreseen: Foreseen,
    channels: Collection[str],
    campaign: NDArray[np.int64],
    thresholds: Thresholds,
    report: Report = silent,
) -> Contest:
    """The contest with the meters of a bench of these channels that read beside its points."""
    read = read_at_points(channels)
    for one in BESIDE:
        if one.value in channels:
            contest = further_meter(one, foreseen, read, campaign, thresholds, report).added_to(contest)
    return contest


def further_meter(
    own: ChannelName,
    foreseen: Foreseen,
    channels: Collection[str],
    campaign: NDArray[np.int64],
    thresholds: Thresholds,
    report: Report,
) -> FurtherMeter:
    """A meter beside a bench that reads these channels at each point.

    A transducer reads the chamber at TRACED points of the campaign; the torque meter UNCOUPLED times without the pump.
    """
    if own is ChannelName.P_CHAMBER:
        points = tuple(int(at) for at in traced_points(foreseen.points.p_out, campaign))
        return FurtherMeter(own, beside=foresee_traces(foreseen, channels, points, thresholds, report), points=points)
    if own is ChannelName.TORQUE_UNCOUPLED:
        alone = foreseen.responses.white({own.value})
        some = slice(0, UNCOUPLED)
        return FurtherMeter(own, beside=White(alone.slopes[some], alone.columns[some]))
    return FurtherMeter(own, foreseen.responses.white({*channels, own.value}))


def traced_points(pressure: Array, campaign: NDArray[np.int64]) -> NDArray[np.int64]:
    """At most TRACED points of a campaign whose delivery pressures spread over its range; pressure: of all points."""
    rising = campaign[np.argsort(pressure[campaign], kind="stable")]
    return np.unique(rising[np.linspace(0, len(rising) - 1, TRACED).round().astype(int)])


def meter_worths(
    contest: Contest,
    told: frozenset[tuple[int, int]],
    counts: NDArray[np.int64],
    meters: Sequence[FurtherMeter],
    wanted: float,
    limits: FormLimits,
    report: Report = silent,
) -> tuple[MeterWorth, ...]:
    """Pairs that each meter adds to those `told` by so many readings (N,), the best first."""
    found = []
    for number, meter in enumerate(meters):
        report(number, len(meters), f"campaign with {meter.words}")
        apart = meter.added_to(contest).apart(counts)
        with_it = contest.told(apart, wanted, limits)
        pairs = [pair for pair in all_pairs(len(with_it)) if with_it[pair] and pair not in told]
        found.append(MeterWorth(meter.name, meter.words, tuple(pairs), apart.distances))
    return tuple(sorted(found, key=lambda one: -len(one.pairs)))
