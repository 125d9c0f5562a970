"""Steady windows of time series, repeatability from repeats, and traces averaged with the shaft."""

import numpy as np
import pytest

from diagnosis.recording.replicates import repeatability, set_points
from diagnosis.recording.series.points import on_raster
from diagnosis.recording.series.steadiness import SteadyRule, effective_number, is_steady, steady_stretches
from diagnosis.recording.tables.table import TableFault
from diagnosis.recording.traces import synchronous_mean
from system.inputs.units import TURN

RULE = SteadyRule(samples=100, limit=3.0)


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
    refused = [not is_steady(_noise(rng, 100, memory)[:, None], np.zeros(1), RULE) for _ in range(400)]
    assert np.mean(refused) <= most


@pytest.mark.parametrize("shape", ["ramp", "step", "bump"])
def test_what_moves_is_not_steady(shape):
    rng = np.random.default_rng(5)
    place = np.linspace(0.0, 1.0, 100)
    courses = {"ramp": place, "step": (place > 0.5) * 1.0, "bump": np.abs(place - 0.5) < 0.25}
    moving = 3.0 * courses[shape][:, None]
    kept = [is_steady(moving + _noise(rng, 100)[:, None], np.zeros(1), RULE) for _ in range(100)]
    assert np.mean(kept) < 0.05


def test_what_is_harmless_is_steady_however_sure():
    ramp = np.linspace(0.0, 0.9, 100)[:, None] + 1e-3 * np.random.default_rng(6).standard_normal((100, 1))
    assert is_steady(ramp, np.array([1.0]), RULE)
    assert not is_steady(ramp, np.array([0.5]), RULE)


@pytest.mark.parametrize("value", [0.28, 0.51, 0.77, 1.0 / 3.0])
def test_a_commanded_value_without_noise_is_steady(value):
    """Means over tenths differ from it by rounding."""
    assert is_steady(np.full((100, 1), value), np.zeros(1), RULE)


def test_stretches_are_the_plateaus_and_nothing_between():
    rng = np.random.default_rng(7)
    levels = np.repeat([10.0, 20.0, 15.0, 30.0], 400)
    ramped = np.concatenate([levels[:400], np.linspace(10, 20, 150), levels[400:]])
    course = ramped + 0.1 * rng.standard_normal(len(ramped))
    found = steady_stretches(course[:, None], np.array([0.05]), RULE)
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
