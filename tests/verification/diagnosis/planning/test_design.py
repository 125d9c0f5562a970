"""Meters that a plan asks for: those that tell most pairs, the points chosen anew beside them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diagnosis import load_thresholds
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.planning.apart import Contest, all_pairs
from diagnosis.planning.design import Asked, Desk, reading_order
from diagnosis.planning.further_meters import FurtherMeter, traced_points
from diagnosis.planning.responses import White
from diagnosis.planning.suspects import Suspect
from reynolds import Array
from system import BenchPoints, ChannelName, EffectId
from system.effects.effect import Kind

POINTS = 6
EFFECTS = (EffectId.CHURNING, EffectId.SEAL_DRAG, EffectId.TORQUE_OFFSET)


def _suspect(at: int) -> Suspect:
    truth = np.zeros(len(EFFECTS))
    truth[at] = 1.0
    own = Hypothesis((EFFECTS[at],), None, Kind.MISSING_PHYSICS, (), (), 0.0)
    return Suspect(f"s{at}", f"s{at}", own, ((at,),), truth, 0.01, False, "")


def _white(*channels: Array) -> White:
    """Channels (N, Q), a reading of each at every point; nothing else is uncertain."""
    columns = np.stack(channels, axis=1)
    return White(np.zeros((*columns.shape[:2], 1)), columns)


def _points(count: int) -> BenchPoints:
    column = np.arange(count, dtype=float)
    return BenchPoints(*(column for _ in range(10)))


def _desk(meters: int) -> Desk:
    """One planned reading at the first point, two more allowed at any."""
    asked = Asked(_points(1), np.ones(1, dtype=np.int64), _points(POINTS - 1), ("Q_out",), 2, meters=meters)
    nothing: Any = None
    return Desk(nothing, asked, load_thresholds())


ALIKE = np.ones((POINTS, 3))
LARGE = np.zeros((POINTS, 3))
LARGE[:, 2] = 9.0
ALL = np.outer(np.ones(POINTS), [0.0, 9.0, -9.0])


@pytest.fixture
def contest() -> Contest:
    """Three suspects that one channel does not part."""
    return Contest(_white(ALIKE), [_suspect(at) for at in range(3)], np.full(3, 10.0), np.zeros(3))


def _further(channel: ChannelName, column: Array) -> FurtherMeter:
    return FurtherMeter(channel, beside=White(np.zeros((2, 1, 1)), column[:2, None, :]))


def test_the_meter_that_tells_most_pairs_is_asked_for(contest: Contest) -> None:
    """One meter shows the third suspect alone, the other tells all three from each other."""
    desk = _desk(1)
    own = desk.designed(contest, set(all_pairs(3)))
    assert own.told == ()
    one, every = _further(ChannelName.Q_IN, LARGE), _further(ChannelName.P_CHAMBER, ALL)
    found = desk.equipped(contest, own, (one, every))
    assert found is not None
    assert [meter.channel for meter in found.meters] == [ChannelName.P_CHAMBER]
    assert len(found.told) > len(desk.told(one.added_to(contest), one.added_to(contest).apart(own.counts)))
    assert found.counts.sum() <= 3


def test_no_meter_is_asked_for_that_tells_nothing(contest: Contest) -> None:
    desk = _desk(2)
    own = desk.designed(contest, set(all_pairs(3)))
    assert desk.equipped(contest, own, (_further(ChannelName.Q_IN, ALIKE),)) is None
    assert desk.equipped(contest, own, ()) is None
    assert _desk(0).equipped(contest, own, (_further(ChannelName.P_CHAMBER, ALL),)) is None


def test_readings_of_one_point_are_spread_over_the_order() -> None:
    """Three readings of the second point stand a third of the campaign apart, from its own place on."""
    counts, points = np.array([1, 3, 0, 1]), BenchPoints(*(np.array([0.1, 0.2, 0.3, 0.7]) for _ in range(10)))
    found = reading_order(counts, points)
    assert sorted(found) == [0, 1, 1, 1, 3]
    assert found.tolist() == [0, 1, 1, 3, 1]


def test_traces_are_recorded_over_the_range_of_pressure() -> None:
    pressure, campaign = np.array([9.0, 1.0, 5.0, 7.0, 3.0, 2.0]), np.array([0, 1, 2, 3, 4])
    assert traced_points(pressure, campaign).tolist() == [0, 1, 3, 4]
