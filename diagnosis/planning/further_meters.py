"""Further meters of a bench, and what each is worth beside a campaign: the pairs that it tells apart."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.planning.apart import Contest, all_pairs
from diagnosis.planning.further import DRAINS
from diagnosis.planning.responses import Foreseen, White, foresee_traces
from diagnosis.report.format import PLACES
from diagnosis.thresholds import FormLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.work.progress import Report, silent

TRACED = 4
"""Points of the campaign at which a transducer records the chamber."""
WORDS = {
    ChannelName.Q_OUT: "a meter of the delivery flow",
    ChannelName.Q_IN: "a meter of the inlet flow",
    ChannelName.Q_CASE: "a meter of the case drain",
    ChannelName.TORQUE: "a torque meter",
    ChannelName.T_CASE: "a thermometer in the case drain",
}


@dataclass(frozen=True)
class FurtherMeter:
    """A meter that the bench lacks: the responses of the bench with it, or its own readings beside any campaign."""

    name: str
    words: str
    white: White | None = None
    beside: White | None = None

    def added_to(self, contest: Contest) -> Contest:
        """The contest with the meter."""
        if self.white is not None:
            return replace(contest, white=self.white)
        return contest if self.beside is None else replace(contest, beside=(*contest.beside, self.beside))


@dataclass(frozen=True)
class MeterWorth:
    """A further meter: pairs that are apart only with it, and (S, S) distances with it."""

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
) -> tuple[FurtherMeter, ...]:
    """Every meter that a bench of these channels lacks; a transducer at TRACED points of the campaign."""
    return tuple(_further(foreseen, channels, campaign, thresholds, report))


def _further(
    foreseen: Foreseen, channels: Collection[str], campaign: NDArray[np.int64], thresholds: Thresholds, report: Report
) -> Iterator[FurtherMeter]:
    for name, words in WORDS.items():
        if name.value not in channels:
            yield FurtherMeter(name.value, words, foreseen.responses.white({*channels, name.value}))
    for gap, drain in DRAINS.items():
        if drain not in channels:
            words = f"a metered drain of {PLACES[gap]} alone"
            yield FurtherMeter(drain, words, foreseen.responses.white({*channels, drain}))
    pressure = foreseen.points.p_out[campaign]
    some = campaign[np.argsort(pressure, kind="stable")][np.linspace(0, len(campaign) - 1, TRACED).round().astype(int)]
    traces = foresee_traces(foreseen, tuple(int(at) for at in np.unique(some)), thresholds, report)
    words = f"the chamber pressure over the turn, at {len(np.unique(some))} points"
    yield FurtherMeter(ChannelName.P_CHAMBER.value, words, beside=traces)


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
