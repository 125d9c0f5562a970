"""The lag of the delivery meter between steady points: by their times, in the order of these."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bench_pump import BENCH

from diagnosis import Recording, Study, load_thresholds, prepare, read_recording
from diagnosis.detect.mismatch import detect
from diagnosis.next_point.operating_box import pump_box, rig_box
from diagnosis.verdict.row_numbers import table_rows
from reynolds import Array
from system import ChannelName, LumpedBench, load_pump, tolerances
from system.bench.sensors import lag_parameter

LIMITS = load_thresholds()
PUMP = load_pump(BENCH)
OPEN = Path(__file__).parents[4] / "examples" / "recordings" / "open-01"
LAG = "Q_out.lag"
MINUTE = 1.0 / 60.0  # h


def _timed(hours: Array, lag: float = 20.0, order: Array | None = None) -> Recording:
    """A third of a recorded map at these times in h, without traces; lag: one sigma of the delivery meter's, in s."""
    read = read_recording(OPEN)
    steady = read.steady.at(slice(None, None, 3))
    steady = replace(steady, hours=hours[: len(steady.hours)])
    channels = tuple(replace(one, lag=lag) if one.name is ChannelName.Q_OUT else one for one in read.channels)
    return replace(read, steady=steady if order is None else steady.at(order), channels=channels, traces=())


def _study(recording: Recording) -> Study:
    return prepare(PUMP, recording, tolerances(PUMP)[0], LIMITS)


def _column(study: Study) -> Array:
    return study.base.slopes[:, study.base.index(LAG)]


def _names(study: Study) -> set[str]:
    return {one.name for one in study.simulator.parameters}


EVEN = MINUTE * np.arange(200.0)


def test_rows_in_any_order_are_one_recording_in_the_order_of_their_times() -> None:
    """Sorted by delivery pressure, as tables are: the same parameters and slopes, points named by their own rows."""
    recording = _timed(EVEN)
    order = np.argsort(recording.steady.column(ChannelName.P_OUT), kind="stable")
    one, other = _study(recording), _study(_timed(EVEN, order=order))
    assert _column(other) == pytest.approx(_column(one), rel=1e-9, abs=1e-9)
    assert np.all(np.diff(other.recording.steady.hours) > 0.0)
    assert np.all(table_rows(other.recording) - 1 == np.argsort(order))
    told = [note.text for note in other.recording.notes]
    assert any("not in the order of their times" in text for text in told)
    assert not any("in the order of their times" in note.text for note in one.recording.notes)


def test_points_of_one_time_have_no_lag() -> None:
    """Two rows of one stamp: their readings are their own, which is told; the other slopes are as large as before."""
    hours = EVEN.copy()
    hours[11] = hours[10]
    found = _study(_timed(hours))
    assert np.linalg.norm(_column(found)) < 1.2 * np.linalg.norm(_column(_study(_timed(EVEN))))
    (told,) = [note for note in found.recording.notes if "no lag is reckoned" in note.text]
    assert told.channel is ChannelName.Q_OUT
    assert told.text.startswith("1 point")


def test_a_lag_is_kept_where_points_follow_within_some_of_it() -> None:
    """By a change of one spread, 20 s: at zero lag no reading feels it. A minute is near enough, an hour is not."""
    near = _study(_timed(EVEN))
    assert LAG in _names(near)
    assert np.linalg.norm(_column(near)) > 3.0
    assert LAG not in _names(_study(_timed(60.0 * EVEN)))


def test_a_lag_in_the_readings_is_the_strongest_candidate() -> None:
    """Readings with 40 s of a lag, points a minute apart: its score stands before those of all others."""
    recording = _timed(EVEN)
    own = lag_parameter(ChannelName.Q_OUT, 20.0)
    bench = LumpedBench(PUMP, _study(recording).simulator.points, (ChannelName.Q_OUT,), (own,))
    lagging = bench.difference(np.zeros(1), np.array([40.0]))[:, 0]
    values = recording.steady.values.copy()
    values[:, list(ChannelName).index(ChannelName.Q_OUT)] += lagging
    found = detect(_study(replace(recording, steady=replace(recording.steady, values=values))), LIMITS)
    assert found.chance < LIMITS.mismatch.chance
    assert found.strongest[0][0].parameter == LAG


@pytest.mark.parametrize("box", [rig_box(_timed(EVEN), PUMP), pump_box(PUMP)])
def test_settled_points_to_come_have_no_lag(box) -> None:
    """They are a grid, of which no point follows another: the forecast of each is that of the point by itself."""
    levels = [np.array([0.9, 1.0]) * ends[1] for ends in box.ends]
    own = lag_parameter(ChannelName.Q_OUT, 20.0)
    bench = LumpedBench(PUMP, box.points(levels), (ChannelName.Q_OUT,), (own,))
    assert bench.predict(np.array([40.0])) == pytest.approx(bench.predict(np.zeros(1)), rel=1e-12)
