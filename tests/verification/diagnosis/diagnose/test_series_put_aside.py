"""Samples of a series that are no readings: clock, hangs, ends of range and rest are found, sound ones are kept."""

from time import process_time

import numpy as np
import pytest

from diagnosis.recording.series.clock import clocked
from diagnosis.recording.series.holds import without_holds
from diagnosis.recording.series.standstill import without_standstill
from diagnosis.recording.tables.table import TableFault
from system import ChannelName

NAMES = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.T_CASE, ChannelName.Q_CASE, ChannelName.TORQUE)
SPEED, P, T, Q, M = range(5)
TIME = np.arange(3000.0)


def series(seed=1):
    """Ramps of pressure while the case warms up: readings (T, 5) with noise and steps as loggers write them."""
    rng = np.random.default_rng(seed)
    pressure = 20e5 + 220e5 * np.abs((TIME / 300.0) % 2.0 - 1.0)
    warm = 330.0 - 25.0 * np.exp(-TIME / 1500.0)
    leakage = 3e-5 * pressure / 240e5 * np.exp((warm - 320.0) / 30.0)
    readings = np.column_stack([157.0 + 0 * TIME, pressure, warm, leakage, 9.5e-6 * pressure + 5.0])
    noise, step = np.array([0.05, 2e4, 0.05, 1e-7, 0.3]), np.array([0.01, 1e3, 0.1, 1e-8, 0.1])
    return np.round((readings + noise * rng.standard_normal(readings.shape)) / step) * step


@pytest.mark.parametrize("seed", range(4))
def test_sound_series_are_kept(seed):
    readings = series(seed)
    readings[:, SPEED] = 157.0  # set, not measured
    readings[:, T] = np.round(readings[:, T])  # a step of 1 K
    for find in (without_holds, without_standstill):
        kept, notes = find(TIME, readings, NAMES)
        assert notes == ()
        assert np.array_equal(kept, readings)


def test_values_that_a_logger_repeats_ten_times_are_kept():
    readings = series()
    readings[:, T] = np.repeat(readings[::10, T], 10)
    assert without_holds(TIME, readings, NAMES)[1] == ()


@pytest.mark.parametrize("channel", [P, Q, M])
def test_a_meter_that_hangs_is_put_aside_with_time_and_mover(channel):
    readings = series()
    readings[1200:1400, channel] = readings[1200, channel]
    kept, (note,) = without_holds(TIME, readings, NAMES)
    assert np.isnan(kept[1201:1400, channel]).all()
    assert np.isnan(kept).sum() < 205
    assert note.startswith(f"{NAMES[channel].value} holds ")
    assert "to 1399 s while" in note


@pytest.mark.parametrize(("at", "samples", "found"), [(1410, 12, True), (210, 8, False)])
def test_a_hang_is_told_where_the_meter_would_have_moved_clearly(at, samples, found):
    """The flow moves by its noise with each sample as the case is warm, by half of that as it is cold."""
    readings = series()
    readings[at : at + samples, Q] = readings[at, Q]
    assert bool(without_holds(TIME, readings, NAMES)[1]) is found


def test_a_lost_signal_and_an_end_of_range_are_put_aside():
    readings = series()
    readings[500:700, Q] = 0.0
    top = np.quantile(readings[:, M], 0.8)
    readings[:, M] = np.minimum(readings[:, M], top)
    kept, notes = without_holds(TIME, readings, NAMES)
    assert np.isnan(kept[500:700, Q]).all()
    assert np.isnan(kept[readings[:, M] == top, M]).all()
    assert any("torque stays at" in note and "the most that it reads" in note for note in notes)


def test_a_dead_band_of_a_flow_meter_is_left_to_its_response():
    readings = series()
    readings[:, Q] = np.maximum(readings[:, Q], 6e-6)
    assert without_holds(TIME, readings, NAMES)[1] == ()


def test_a_logger_that_hangs_is_put_aside():
    readings = series()
    readings[1000:1040] = readings[1000]
    kept, (note,) = without_holds(TIME, readings, NAMES)
    assert np.isnan(kept[1001:1040]).all()
    assert "every channel repeats its reading from 1000 s to 1039 s" in note


def test_rest_is_put_aside_by_speed_or_by_flow():
    readings = series()
    readings[800:900, SPEED] = 0.1
    kept, (note,) = without_standstill(TIME, readings, NAMES)
    assert np.isnan(kept[797:903]).all()
    assert np.isfinite(kept[:790]).all()
    assert "speed is below" in note
    assert "from 800 s to 899 s" in note
    flow = (ChannelName.P_OUT, ChannelName.Q_OUT, ChannelName.DISPLACEMENT_RATIO)
    idle = np.column_stack([readings[:, P], np.where(TIME < 100, 0.0, 2e-3), np.where(TIME < 50, 0.0, 1.0)])
    kept, (note,) = without_standstill(TIME, idle, flow)
    assert "from 50 s to 99 s" in note  # before, the swash plate is at zero
    with pytest.raises(TableFault, match="at 0 throughout"):
        without_standstill(TIME, 0.0 * readings, NAMES)


@pytest.mark.parametrize("rows", range(1, 9))
def test_rest_in_a_series_of_a_few_rows_keeps_their_number(rows):
    readings = series()[:rows]
    readings[0, SPEED] = 0.1
    kept, _ = without_standstill(TIME[:rows], readings, NAMES)
    assert kept.shape == readings.shape
    assert np.flatnonzero(np.isnan(kept[:, SPEED])).tolist() == list(range(min(rows, 4 if rows > 1 else 0)))


def test_a_clock_that_is_set_repeats_or_stops_gives_a_time_that_rises():
    time, readings = TIME.copy(), series()
    time[1000:] -= 700.0
    time[1500:] += 1e9
    time[2000:] += 60.0
    time[[300, 600]] = time[299], np.nan
    found = clocked(time, readings)
    assert np.all(np.diff(found.time) > 0.0)
    assert len(found.time) == len(TIME) - 2
    assert found.time[-1] == pytest.approx(TIME[-1] + 60.0 + 8.0)
    assert np.allclose(found.readings[299], readings[299:301].mean(axis=0))
    whole = "; ".join(found.notes)
    for words in ("falls from 999 s to 300 s at row 1001", "leaps from 799 s", "row 1501", "nothing is recorded from"):
        assert words in whole
    sound = clocked(TIME, readings)
    assert sound.notes == ()
    assert np.array_equal(sound.readings, readings)
    assert np.array_equal(sound.time, TIME)


@pytest.mark.parametrize("share", [60.0, 1e-3, 1.0, 7.0])
def test_a_clock_that_counts_in_another_unit_behind_a_jump_is_refused(share):
    """Minutes or milliseconds behind seconds; a clock set back or a slower logger changes no unit."""
    steps = np.where(np.arange(100) < 50, 2.0, 2.0 / share)
    time = np.cumsum(steps) - np.where(np.arange(100) < 50, 0.0, 90.0)
    if share < 1.0:
        time += np.where(np.arange(100) < 50, 0.0, 1e5)
    if share in (60.0, 1e-3):
        with pytest.raises(TableFault, match=r"up to row 50 and of .* from row 51 on"):
            clocked(time, np.zeros((100, 1)))
    else:
        assert np.all(np.diff(clocked(time, np.zeros((100, 1))).time) > 0.0)


def test_a_clock_of_many_pauses_takes_time_as_its_rows():
    """A million rows with a pause after every fortieth, in seconds; each pause by itself would take an hour."""
    steps = np.where(np.arange(1_000_000) % 40 == 0, 60.0, 1.0)
    begun = process_time()
    found = clocked(np.cumsum(steps), np.zeros((len(steps), 1)))
    assert process_time() - begun < 20.0
    assert len(found.time) == len(steps)


@pytest.mark.parametrize("few", [slice(47, None), slice(0, 53)])
def test_a_few_steps_beside_a_jump_tell_no_unit(few):
    """Three steps of two minutes and then of two seconds: a slow start or end of a logger."""
    steps = np.where(np.arange(100) < 50, 120.0, 2.0)
    time = (np.cumsum(steps) + np.where(np.arange(100) < 50, 0.0, 1e5))[few]
    assert np.all(np.diff(clocked(time, np.zeros((len(time), 1))).time) > 0.0)


@pytest.mark.parametrize(
    ("time", "words"),
    [
        (np.full(50, np.nan), "no number in the column"),
        (np.zeros(50), "no time that rises"),
        (np.arange(50.0)[::-1], "does not|no time"),
        (np.array([0.0, 10.0, 30.0, *np.tile([20.0, 10.0, 40.0, 30.0], 12)]), "does not rise at row 4 and at 35 more"),
    ],
)
def test_columns_that_are_no_time_are_refused(time, words):
    with pytest.raises(TableFault, match=words):
        clocked(time, np.zeros((50, 1)))


def test_rows_that_run_backwards_are_to_be_sorted():
    with pytest.raises(TableFault) as fault:
        clocked(np.arange(50.0)[::-1], np.zeros((50, 1)))
    assert fault.value.nearest == "rows sorted by their time"
