"""Findings of the proof beside the verdict: the truth's own fit, the turn, points recorded afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis import BenchBox, Explanation, RecordedChannel
from diagnosis.explain.hypotheses import Hypothesis, together
from system import ChannelName, EffectId, Gap, Kind, entry_of


@pytest.fixture
def made(proof: SimpleNamespace) -> Iterator[SimpleNamespace]:
    """A case of thirteen points with a leaking case drain meter, and its recording."""
    whole = proof.campaigns.campaigns()["map"]
    points = replace(whole.points, **{name: value[::9] for name, value in vars(whole.points).items()})
    proof.campaigns.campaigns()["few"] = replace(whole, name="few", points=points, traces=())
    fault = next(one for one in proof.cases.SENSORS if one.id == "Q_case_offset")
    case = proof.cases.Case(proof.cases.Part.SENSOR, "few", 11, (fault,), 8.0)
    yield SimpleNamespace(case=case, made=proof.recordings.make(case))
    del proof.campaigns.campaigns()["few"]


def _weighed(effect: EffectId, gap: Gap | None) -> Explanation:
    law = next(one for one in entry_of(effect).extensions if one.pair is gap)
    own = Hypothesis((effect,), gap, Kind.MISSING_PHYSICS, law.parameters, (), 0.0, (law,))
    return Explanation(own, 0.0, True, None, 0.0, 0.0, None)


def test_the_truth_is_known_among_explanations(proof: SimpleNamespace) -> None:
    """By its effects in any order and its gap; another gap, one of two, a bent law are not the truth."""
    opening = _weighed(EffectId.ELASTIC_OPENING, Gap.SLIPPER)
    churning = _weighed(EffectId.CHURNING, None)
    both = replace(churning, hypothesis=together(churning.hypothesis, opening.hypothesis, 1.0))
    truth = proof.outcome.Outcome(
        name="", part="pair", campaign="map", seed=1, asked=10.0, score=10.0, sizes={}, truth="missing_physics",
        effects=("elastic_opening", "churning"), pairs=("slipper", None), shares={},
    )  # fmt: skip
    alone = replace(truth, effects=("elastic_opening",), pairs=("slipper",))
    known = proof.oracle.is_of_truth
    assert known(both, truth)
    assert known(opening, alone)
    assert not known(opening, truth)
    assert not known(opening, replace(alone, pairs=("piston",)))
    assert not known(replace(opening, hypothesis=replace(opening.hypothesis, other_form=True)), alone)


def test_a_turn_is_told_across_the_dead_centre(proof: SimpleNamespace) -> None:
    """A bump from 350 to 10 deg in one of two traces: the window that holds four fifths of its square."""
    angle = 0.5 * np.pi + np.linspace(0.0, 2.0 * np.pi, 361)[1:]
    away = np.degrees((angle + np.pi) % (2.0 * np.pi) - np.pi)
    bump = np.where(np.abs(away) <= 10.0, 1e6, 0.0)
    sound = SimpleNamespace(angle=angle, pressure=np.zeros((2, 360)))
    moved = SimpleNamespace(angle=angle, pressure=np.stack([np.zeros(360), bump]))
    start, end = np.degrees(proof.recordings.moved_turn(moved, sound, (0, 1)))
    assert start == pytest.approx(350.0, abs=0.1)
    assert end == pytest.approx(6.0, abs=0.1)
    assert proof.recordings.moved_turn(moved, sound, (0,)) is None


def test_sensors_afterwards_are_as_they_were(proof: SimpleNamespace, made: SimpleNamespace) -> None:
    """The mean of many readings at one point is off by the campaign's own calibration and fault, at its end."""
    count, name, found = 2000, "Q_case", made.made
    whole = proof.campaigns.campaigns()["few"]
    points = replace(whole.points, **{one: np.repeat(value[:1], count) for one, value in vars(whole.points).items()})
    flow = np.full(count, 2e-5)
    truth = SimpleNamespace(Q_out=flow, Q_in=flow, Q_case=flow, torque=flow)
    columns = proof.sensors.read_after(
        replace(whole, points=points), points, truth, found.faults, found.readings.calibrations,
        np.random.default_rng(1),
    )  # fmt: skip
    meter, own = proof.sensors.METERS[name], found.readings.calibrations[name]
    true = (flow[0] + found.faults[0].zero) / meter.scale
    sigma = (meter.sigma + meter.relative * true) * np.sqrt(1.03 * (1.0 + 0.3) / (1.0 - 0.3) / count)
    expected = true * (1.0 + own.gain) + own.zero + 0.5 * own.drift
    assert columns[name].mean() == pytest.approx(expected, abs=4.0 * sigma)


def test_a_point_is_recorded_where_it_was_asked(proof: SimpleNamespace, made: SimpleNamespace) -> None:
    """Inputs as read stand within their noise of the place; the drain carries the fault it has."""
    ends = ((100.0, 200.0), (5e6, 35e6), (0.3, 1.0), (320.0, 330.0))
    box = BenchBox(ends, 2.4e6, 0.15e6, 3.0, (13.0, 1.0))
    study = SimpleNamespace(channels=(ChannelName.Q_OUT, ChannelName.Q_CASE))
    place = (150.0, 20e6, 0.8, 326.0)
    rng = np.random.default_rng(4)
    rig = proof.trial._rig(made.case, made.made)
    points, values = proof.worth._recorded(study, box, [place], rig, 3, rng, ())
    assert values.shape == (3, 2)
    assert points.speed == pytest.approx(150.0, abs=0.6)
    assert points.p_out == pytest.approx(20e6, abs=4e5)
    assert points.p_in == pytest.approx(2.4e6, abs=6e4)
    assert np.all(points.displacement_ratio == 0.8)
    sound = replace(rig, faults=())
    _, without = proof.worth._recorded(study, box, [place], sound, 3, np.random.default_rng(4), ())
    step = 10.0 ** -proof.sensors.METERS["Q_case"].digits * proof.sensors.METERS["Q_case"].scale
    fault = made.made.faults[0].zero
    assert values[:, 1] - without[:, 1] == pytest.approx(fault, rel=0.05, abs=2.0 * step)


def test_a_meter_that_is_asked_for_reads_at_all_its_points(proof: SimpleNamespace, made: SimpleNamespace) -> None:
    """Two points three times each; one gap drains less than the case, the uncoupled shaft shows no torque."""
    box = BenchBox(((100.0, 200.0), (5e6, 35e6), (0.3, 1.0), (320.0, 330.0)), 2.4e6, 0.15e6, 3.0, (13.0, 1.0))
    study = SimpleNamespace(channels=(ChannelName.Q_CASE,))
    places = [(150.0, 20e6, 0.8, 326.0), (200.0, 30e6, 1.0, 326.0)]
    rig = replace(proof.trial._rig(made.case, made.made), faults=())
    for channel in (ChannelName.Q_SLIPPER, ChannelName.TORQUE_UNCOUPLED):
        meter = RecordedChannel(channel, "", "", 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, ())
        points, values = proof.worth._recorded(study, box, places, rig, 3, np.random.default_rng(4), (meter,))
        assert values.shape == (6, 2)
        assert points.p_out == pytest.approx(np.repeat([20e6, 30e6], 3), abs=4e5)
        if channel is ChannelName.Q_SLIPPER:
            assert np.all((values[:, 1] > 0.0) & (values[:, 1] < values[:, 0]))
        else:
            assert values[:, 1] == pytest.approx(0.0, abs=2.0)
