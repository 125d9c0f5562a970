"""Steady windows of time series, repeatability from repeats, and traces averaged with the shaft."""

import numpy as np
import pytest

from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.form import SeriesSection, TimeColumnSection
from diagnosis.recording.replicates import repeatability, set_points
from diagnosis.recording.series.points import on_raster, series_points, with_short_gaps_filled
from diagnosis.recording.series.steadiness import (
    Repeatability,
    SteadyRule,
    effective_number,
    is_steady,
    steady_stretches,
)
from diagnosis.recording.tables.table import TableFault
from diagnosis.recording.traces import synchronous_mean
from system import ChannelName
from system.inputs.units import TURN

RULE = SteadyRule(samples=100, limit=3.0)


def _known(sigma, relative=0.0):
    return Repeatability(np.array([sigma]), np.array([relative]))


UNKNOWN = _known(0.0)


def _noise(rng, count, memory=0.0):
    """Noise of unit variance and first order."""
    shocks = rng.standard_normal(count) * np.sqrt(1.0 - memory**2)
    noise = np.empty(count)
    noise[0] = rng.standard_normal()
    for k in range(1, count):
        noise[k] = memory * noise[k - 1] + shocks[k]
    return noise


@pytest.mark.parametrize(("memory", "most"), [(0.0, 0.03), (0.6, 0.05)])
def test_noise_alone_is_steady(memory, most):
    """Two tests of three standard errors: 0.5 % of white windows; memory is estimated, which costs a little."""
    rng = np.random.default_rng(4)
    refused = [not is_steady(_noise(rng, 100, memory)[:, None], UNKNOWN, RULE) for _ in range(400)]
    assert np.mean(refused) <= most


@pytest.mark.parametrize("shape", ["ramp", "step", "bump"])
def test_what_moves_is_not_steady(shape):
    rng = np.random.default_rng(5)
    place = np.linspace(0.0, 1.0, 100)
    courses = {"ramp": place, "step": (place > 0.5) * 1.0, "bump": np.abs(place - 0.5) < 0.25}
    moving = 3.0 * courses[shape][:, None]
    kept = [is_steady(moving + _noise(rng, 100)[:, None], UNKNOWN, RULE) for _ in range(100)]
    assert np.mean(kept) < 0.05


def test_what_is_harmless_is_steady_however_sure():
    ramp = np.linspace(0.0, 0.9, 100)[:, None] + 1e-3 * np.random.default_rng(6).standard_normal((100, 1))
    assert is_steady(ramp, _known(1.0), RULE)
    assert not is_steady(ramp, _known(0.5), RULE)


@pytest.mark.parametrize("value", [0.28, 0.51, 0.77, 1.0 / 3.0])
def test_a_commanded_value_without_noise_is_steady(value):
    """Means over tenths differ from it by rounding."""
    assert is_steady(np.full((100, 1), value), UNKNOWN, RULE)


def test_stretches_are_the_plateaus_and_nothing_between():
    rng = np.random.default_rng(7)
    levels = np.repeat([10.0, 20.0, 15.0, 30.0], 400)
    ramped = np.concatenate([levels[:400], np.linspace(10, 20, 150), levels[400:]])
    course = ramped + 0.1 * rng.standard_normal(len(ramped))
    found = steady_stretches(course[:, None], _known(0.05), RULE)
    means = [np.mean(course[s]) for s in found]
    assert np.allclose(sorted(set(np.round(means, 0))), [10, 15, 20, 30])
    for stretch, mean in zip(found, means, strict=True):
        assert abs(mean - np.median(ramped[stretch])) < 0.05
    assert sum(s.stop - s.start for s in found) > 0.75 * len(levels)


@pytest.mark.parametrize("memory", [0.0, 0.5, 0.8])
def test_effective_number_is_that_of_the_means_variance(memory):
    """Variance of the mean of n samples of first-order noise is 1/n_eff, to the scatter of 400 means (7 %)."""
    rng = np.random.default_rng(8)
    courses = [_noise(rng, 400, memory) for _ in range(400)]
    told = np.mean([1.0 / effective_number(course) for course in courses])
    assert told == pytest.approx(np.var([course.mean() for course in courses]), rel=0.25)


def test_raster_takes_means_and_leaves_gaps():
    time = np.array([0.0, 0.1, 0.2, 0.3, 0.9, 1.0])
    even, means, step = on_raster(time, np.arange(6.0)[:, None], 0.2)
    assert step == 0.2
    assert np.allclose(means[[0, 1], 0], [0.5, 2.5])
    assert np.isnan(means[2:4, 0]).all()
    assert len(even) == len(means)
    with pytest.raises(TableFault, match="row 3"):
        on_raster(np.array([0.0, 1.0, 1.0, 2.0]), np.zeros((4, 1)), 0.0)


def test_repeatability_without_what_follows_the_inputs():
    """Sixty repeats, inputs set anew each time: sigma to three of its own errors, 1/sqrt(2 dof)."""
    rng = np.random.default_rng(9)
    numbers = set_points(np.repeat(np.arange(20.0), 4))
    inputs = 100.0 + np.repeat(rng.uniform(0, 50, 20), 4) + rng.standard_normal(80)
    readings = 3.0 * inputs + 0.1 * rng.standard_normal(80)
    found = repeatability(readings, inputs[:, None], numbers)
    assert found == pytest.approx(0.1, rel=3.0 / np.sqrt(2 * 59))
    assert repeatability(readings, np.empty((80, 0)), numbers) > 1.0
    assert repeatability(readings[:6], np.empty((6, 0)), numbers[:6]) is None
    assert len(np.unique(set_points(np.array([1.0, np.nan, 1.0, np.nan])))) == 3


def test_synchronous_mean_and_its_covariance():
    """Forty noisy cycles at jittered angles: mean to its own error, covariance factor to scatter."""
    rng = np.random.default_rng(10)
    rows, cycles, sigma = 180, 40, 0.5
    angle = np.mod(TURN * (np.arange(rows * cycles) / rows) + rng.uniform(0, 1e-3, rows * cycles), TURN)
    course = 10.0 * np.sin(angle)
    block = synchronous_mean(3, angle, course + sigma * rng.standard_normal(rows * cycles), None)
    assert (block.point, block.cycles, len(block.angle)) == (3, cycles, rows)
    error = block.mean - 10.0 * np.sin(block.angle)
    assert np.sqrt(np.mean(error**2)) == pytest.approx(sigma / np.sqrt(cycles), rel=0.2)
    scatter = np.sqrt(np.mean(np.sum(block.covariance_factor**2, axis=1)))
    assert scatter == pytest.approx(sigma / np.sqrt(cycles), rel=0.2)


def test_one_cycle_has_no_covariance_and_part_of_a_turn_no_mean():
    angle = np.linspace(0.0, TURN, 720, endpoint=False)
    block = synchronous_mean(0, angle, np.cos(angle), None)
    assert block.covariance_factor is None
    assert np.allclose(block.mean, np.cos(block.angle), atol=1e-12)
    with pytest.raises(TableFault, match="no whole turn"):
        synchronous_mean(0, angle[:500], np.cos(angle[:500]), None)


@pytest.mark.parametrize("first", [0.0, 3.0])
def test_a_turn_may_begin_anywhere_and_angles_may_count_on(first):
    """Three turns from 0 or 3 rad on, wrapped or counted on: three cycles of the same course."""
    angle = first + TURN * np.arange(3 * 180) / 180
    for given in (angle, np.mod(angle, TURN)):
        block = synchronous_mean(0, given, np.cos(given), None)
        assert (block.cycles, len(block.angle)) == (3, 180)
        assert np.allclose(block.mean, np.cos(block.angle), atol=1e-3)


def test_degrees_stated_as_radians_are_no_turn():
    with pytest.raises(TableFault, match="no whole turn"):
        synchronous_mean(0, np.arange(0.0, 360.0, 0.5), np.zeros(720), None)


LEVELS = (50e5, 150e5, 250e5, 100e5, 200e5)
PLATEAU, RAMP = 600, 100


def _plateaus(time, sigma=None, relative=None, sway=0.0):
    """Points of a series of five pressures for 60 s each, with ramps of 10 s, at stamps in s; noise of 0.1 bar.

    sway: a swing of the pressure of this share, twice in a plateau.
    """
    count = len(LEVELS) * (PLATEAU + RAMP)
    ends = [(PLATEAU + RAMP) * k + at for k in range(len(LEVELS)) for at in (0, PLATEAU)]
    level = np.interp(np.arange(count), ends, np.repeat(LEVELS, 2)) * (
        1.0 + sway * np.sin(np.arange(count) * 4.0 * np.pi / PLATEAU)
    )
    noise = np.random.default_rng(11).standard_normal((2, count))
    readings = np.column_stack([level + (1e2 if sway else 1e4) * noise[0], 1e-12 * level + 1e-7 * noise[1]])
    kept = np.isfinite(time)
    forms = [
        ChannelForm(ChannelName.P_OUT, "p", "Pa", 1.0, 0.0, sigma, relative, *[None] * 5),
        ChannelForm(ChannelName.Q_CASE, "Q", "m3/s", 1.0, 0.0, *[None] * 7),
    ]
    section = SeriesSection(time=TimeColumnSection(column="t", unit="s"))
    return series_points(section, time[kept], readings[: len(time)][kept], forms)


CLOCK = 0.1 * np.arange(len(LEVELS) * (PLATEAU + RAMP) - RAMP)


@pytest.mark.parametrize(
    "time",
    [
        np.where(np.arange(len(CLOCK)) % 90 == 45, np.nan, CLOCK),
        np.where(np.arange(len(CLOCK)) % 150 < 3, np.nan, CLOCK),
        np.round(1.003 * CLOCK, 1),
        CLOCK + 1e-4 * np.cos(np.arange(len(CLOCK)) ** 2),
    ],
    ids=["every 90th sample lost", "three lost in a row", "stamps rounded", "stamps uneven"],
)
def test_a_clock_with_small_errors_leaves_the_plateaus_whole(time):
    """All five, one of them cut by chance at most: one window in 200 of noise alone counts as moving."""
    found = _plateaus(time)
    assert not found.quasi
    assert len(found.means) <= len(LEVELS) + 1
    assert sorted(set(np.round(found.means[:, 0], -5))) == sorted(LEVELS)


@pytest.mark.parametrize("noise", [(0.3e5, None), (None, 2e-3), (0.05e5, 1.5e-3)])
def test_a_drift_below_the_repeatability_is_steady_however_that_is_stated(noise):
    """A swing of +-0.02 %: by sigma, by a share of the reading, or by both. Without either it is no rest."""
    found = _plateaus(CLOCK, *noise, sway=2e-4)
    assert not found.quasi
    assert found.means[:, 0] == pytest.approx(LEVELS, rel=1e-3)
    assert _plateaus(CLOCK, sway=2e-4).quasi


def test_a_share_of_a_reading_counts_at_the_level_of_the_window():
    """0.5 bar over a window: below a thousandth of 600 bar, not of 60; a stated share of an absolute pressure too."""
    drift = np.linspace(0.0, 0.4e5, 100)[:, None] + 1e2 * np.random.default_rng(6).standard_normal((100, 1))
    for level, steady in ((600e5, True), (60e5, False)):
        assert is_steady(level + drift, _known(0.0, 1e-3), RULE) is steady
    form = ChannelForm(ChannelName.P_IN, "p", "Pa", 1.0, -1e5, None, 0.5, *[None] * 5)
    assert form.repeatability == (0.5e5, 0.5)


def test_only_short_gaps_of_a_moving_series_are_filled_and_nothing_put_aside():
    """Lines across one or two lost samples; three, the ends, and what a check has put aside stay gaps."""
    rastered = np.arange(20.0)[:, None] * np.ones(2)
    for lost in (slice(0, 1), slice(3, 4), slice(6, 8), slice(10, 13)):
        rastered[lost] = np.nan
    readings = rastered.copy()
    readings[16:18, 1] = np.nan
    filled = with_short_gaps_filled(rastered, readings)
    assert np.flatnonzero(np.isnan(filled[:, 0])).tolist() == [0, 10, 11, 12]
    assert np.flatnonzero(np.isnan(filled[:, 1])).tolist() == [0, 10, 11, 12, 16, 17]
    known = np.isfinite(filled)
    assert filled[known] == pytest.approx(np.broadcast_to(np.arange(20.0)[:, None], (20, 2))[known])
