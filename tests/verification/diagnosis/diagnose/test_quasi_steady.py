"""Quasi-steady points: lag, dead band, storage and noise of made ramps come back, and the steady readings with them."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.form import SeriesSection, TimeColumnSection
from diagnosis.recording.series.meter_response import meter_response, robust
from diagnosis.recording.series.points import series_points
from diagnosis.recording.series.quasi_steady import quasi_steady
from system import ChannelName

STEP, SAMPLES, SIGMA = 1.0, 4000, 0.01
P, T_CASE, FLOW = 0, 1, 2
NAMES = (ChannelName.P_OUT, ChannelName.T_CASE, ChannelName.Q_CASE)


def lagging(values, seconds):
    """First-order lag by the exact step response of each sample."""
    left = np.exp(-STEP / seconds)
    found = values.copy()
    for k in range(1, len(values)):
        found[k] = left * found[k - 1] + (1.0 - left) * values[k]
    return found


def series(lag=5.0, thermal=40.0, band=0.0, storage=0.0, seed=3):
    """Time, readings (T, 3) of pressure, case temperature and a leakage p exp((T - 40)/30), and the steady leakage."""
    time = STEP * np.arange(SAMPLES)
    ramp = np.abs((time / 150.0) % 2.0 - 1.0)
    pressure = 20e5 + 220e5 * np.clip(1.4 * ramp - 0.2, 0.0, 1.0)
    gap = 50.0 - 28.0 * np.exp(-time / 1500.0) + 4.0 * pressure / 240e5
    steady = pressure / 240e5 * np.exp((gap - 40.0) / 30.0)
    read = lagging(steady, lag) if lag else steady
    read = np.maximum(read - storage * np.gradient(pressure, STEP), band)
    noise = SIGMA * np.random.default_rng(seed).standard_normal(SAMPLES)
    return time, np.column_stack([pressure, lagging(gap, thermal) if thermal else gap, read + noise]), steady


def response(cut_off=0.0, **made):
    """Response to a series, of a meter that shows 0 below its cut-off; and the steady leakage."""
    time, readings, steady = series(thermal=0.0, **made)
    readings[:, FLOW] = np.where(readings[:, FLOW] < cut_off, 0.0, readings[:, FLOW])
    scaled = 2.0 * (readings[:, :2] - readings[:, :2].min(axis=0)) / np.ptp(readings[:, :2], axis=0) - 1.0
    rate = np.gradient(readings[:, P], STEP)
    return meter_response(readings[:, FLOW], time, scaled, rate, np.ones(SAMPLES, bool), True), steady


@pytest.mark.parametrize("lag", [0.0, 4.0, 8.0])
def test_lag_comes_back_and_the_reading_is_that_of_steady_state(lag):
    found, steady = response(lag=lag)
    assert found.noise.sigma == pytest.approx(SIGMA, rel=0.05)
    of_mean = np.sqrt(found.noise.of_means(np.full((1, 100), 0.01))[0, 0])
    assert of_mean == pytest.approx(0.1 * SIGMA, rel=0.3)  # what the law leaves of the leakage counts as noise
    assert np.isnan(found.band)
    assert np.std(found.steady - steady) < 1.1 * SIGMA


@pytest.mark.parametrize("lag", [0.0, 2.0])
def test_lag_of_a_noisy_meter_is_found_in_a_fast_series(lag):
    """Ramps of 60 s at 100 Hz: the lag shifts a reading by a fifteenth of the noise of a sample."""
    step, noise = 0.01, np.random.default_rng(11)
    time = step * np.arange(60000)
    pressure = np.abs((time / 60.0) % 2.0 - 1.0)
    left = np.exp(-step / lag) if lag else 0.0
    read = lfilter([1.0 - left], [1.0, -left], pressure, zi=[left * pressure[0]])[0]
    read += 0.5 * noise.standard_normal(time.size)
    found = meter_response(read, time, 2.0 * pressure[:, None] - 1.0, None, np.ones(time.size, bool), False)
    assert found.lag == pytest.approx(lag, abs=0.5)


def test_dead_band_is_found_and_its_readings_are_put_aside():
    found, steady = response(lag=0.0, band=0.12)
    assert found.band == pytest.approx(0.12, abs=3.0 * SIGMA)
    assert np.isnan(found.steady[steady < 0.1]).mean() > 0.95
    assert np.isfinite(found.steady[steady > 0.18]).all()
    assert np.isnan(response(lag=0.0, band=0.0)[0].band)


def test_a_meter_that_shows_0_below_its_cut_off_is_followed_down_to_it():
    found, steady = response(lag=0.0, cut_off=0.12)
    assert found.band == pytest.approx(0.12, abs=SIGMA)
    assert np.isnan(found.steady[steady < 0.1]).mean() > 0.95
    assert np.isfinite(found.steady[steady > 0.18]).all()
    followed = np.isfinite(found.steady)
    assert np.std(found.steady[followed] - steady[followed]) < 1.1 * SIGMA


def test_storage_is_taken_out():
    found, steady = response(lag=0.0, storage=2e-8)
    assert found.storage == pytest.approx(2e-8, rel=0.1)
    assert np.std(found.steady - steady) < 1.1 * SIGMA


@pytest.mark.parametrize("thermal", [20.0, 40.0])
def test_the_oil_is_as_warm_as_read_and_what_it_rose_in_the_lag(thermal):
    found = quasi_steady(*series(lag=0.0, thermal=thermal)[:2], NAMES)
    pressure, temperature, _ = found.means.T
    gap = 50.0 - 28.0 * np.exp(-found.time / 1500.0) + 4.0 * pressure / 240e5
    late = found.time > 200.0
    assert np.std((temperature + thermal * found.warming - gap)[late]) < 0.5 * np.std((temperature - gap)[late])


def test_points_are_means_of_steady_state_with_their_standard_errors():
    time, readings, _ = series(thermal=20.0)
    found = quasi_steady(time, readings, NAMES, thermometer=20.0)
    pressure, temperature, leakage = found.means.T
    misfit = leakage - pressure / 240e5 * np.exp((temperature + 20.0 * found.warming - 40.0) / 30.0)
    assert len(found.means) > 50
    assert 0.5 < np.nanstd(misfit / found.errors[:, FLOW]) < 2.5
    assert np.all(np.diff(found.time) >= 0.0)


def swinging(rng, lag=0.0):
    """Response of a meter of 100 + 50 x, whose noise wanders, to x that swings faster and faster; x and the truth."""
    time = np.arange(2000.0)
    swing = -np.cos(2.0 * np.pi * time / 160.0 * (1.0 + time / time[-1]))
    truth = 100.0 + 50.0 * swing
    read = lagging(truth, lag) if lag else truth
    wander = 60.0 ** np.array([0.0, -0.5]) @ rng.standard_normal((2, time.size)) + lagging(
        rng.standard_normal(2000), 60.0
    )
    scaled, rate = swing[:, None], np.gradient(5e6 * swing)
    return (
        [meter_response(read + wander, time, scaled, of, np.ones(2000, bool), False) for of in (None, rate)],
        swing,
        truth,
    )


@pytest.mark.parametrize("lag", [0.0, 8.0])
def test_what_lag_and_storage_are_not_known_by_is_noise_of_the_means(lag):
    """The size of the swing in steady readings: as far off, over many benches, as its standard error tells."""
    off = []
    for seed in range(12):
        found, swing, truth = swinging(np.random.default_rng(seed), lag)
        share = (swing - swing.mean()) / np.sum((swing - swing.mean()) ** 2)
        off.append([share @ (one.steady - truth) / np.sqrt(one.of_means(share[None])[0, 0]) for one in found])
    assert 0.5 < np.sqrt(np.mean(np.square(off))) < 1.6


def test_gaps_and_jumps_are_put_aside_and_few_samples_refused():
    time, readings, _ = series()
    readings[1000:1100] = np.nan
    found = quasi_steady(time, readings, NAMES)
    assert found.left == pytest.approx(100.0 / SAMPLES, abs=0.005)
    readings[3:] = np.nan
    with pytest.raises(ValueError, match="samples without gaps"):
        quasi_steady(time, readings, NAMES)
    for few in (1, 4, 7):
        with pytest.raises(ValueError, match=f"{few} samples"):
            quasi_steady(time[:few], readings[:few], NAMES)


def test_a_robust_fit_keeps_off_outliers():
    x = np.linspace(-1.0, 1.0, 200)
    values = 2.0 + 3.0 * x
    values[::20] += 50.0
    size, _ = robust(np.column_stack([np.ones(200), x]), values)
    assert size == pytest.approx([2.0, 3.0], abs=0.05)


@pytest.mark.parametrize(("rest", "steady"), [(280, True), (60, False)])
def test_stairs_are_steady_points_where_they_rest_for_half_of_the_series(rest, steady):
    """Five pressures for `rest` s each, with ramps of 100 s between them."""
    places = np.concatenate([[(rest + 100) * k, (rest + 100) * k + rest] for k in range(5)])
    time = np.arange(float(places[-1]))
    level = np.interp(time, places, np.repeat([50e5, 150e5, 250e5, 100e5, 200e5], 2))
    noise = np.random.default_rng(5).standard_normal((2, len(time)))
    readings = np.column_stack([level + 1e4 * noise[0], 1e-12 * level + 1e-7 * noise[1]])
    forms = [ChannelForm(name, name.value, "", 1.0, 0.0, *[None] * 7) for name in (NAMES[P], NAMES[FLOW])]
    found = series_points(SeriesSection(time=TimeColumnSection(column="t", unit="s")), time, readings, forms)
    if steady:
        assert " steady points from 7" in found.notes[-1]
    else:
        assert any("quasi-steady points from" in note for note in found.notes)
