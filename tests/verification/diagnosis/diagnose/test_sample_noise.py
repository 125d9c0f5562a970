"""Noise of samples from what a smooth law leaves: the scatter of means of made noise comes back."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.recording.series.sample_noise import sample_noise

SAMPLES, PART, SIGMA = 6000, 50, 0.2


def first_order(memory, rng):
    left = np.exp(-1.0 / memory)
    begin = [left * rng.standard_normal()]
    return lfilter([np.sqrt(1.0 - left**2)], [1.0, -left], rng.standard_normal(SAMPLES), zi=begin)[0]


def found(noise):
    """The noise of what a law of slow waves and of a sweep leaves of it."""
    past = np.linspace(0.0, 1.0, SAMPLES)
    sweep = np.cos(40.0 * np.pi * past)
    columns = np.column_stack([*(np.cos(np.pi * order * past) for order in range(7)), sweep, sweep**2, sweep * past])
    residual = noise - columns @ np.linalg.lstsq(columns, noise, rcond=None)[0]
    return sample_noise(residual, columns, np.arange(SAMPLES), SAMPLES)


def mean_of(noise, places):
    """Standard error of the mean of samples at these places."""
    shares = np.zeros((1, SAMPLES))
    shares[0, places] = 1.0 / len(places)
    return float(np.sqrt(noise.of_means(shares)[0, 0]))


@pytest.mark.parametrize(
    ("memory", "share", "within"), [(1.0, 0.0, 0.15), (5.0, 1.0, 0.15), (30.0, 1.0, 0.25), (100.0, 0.15, 0.3)]
)
def test_standard_error_of_a_mean(memory, share, within):
    """Over ten draws the means of 50 samples scatter as it says, noise with a memory beside white noise."""
    errors, scatter = [], []
    for seed in range(10):
        rng = np.random.default_rng(seed)
        noise = SIGMA * (
            np.sqrt(1.0 - share) * rng.standard_normal(SAMPLES) + np.sqrt(share) * first_order(memory, rng)
        )
        single = found(noise)
        assert single.correlation[0] == pytest.approx(1.0)
        assert single.sigma == pytest.approx(noise.std(), rel=within)
        errors.append(mean_of(single, np.arange(PART)))
        scatter.append(np.mean(noise.reshape(-1, PART).mean(axis=1) ** 2))
    assert np.mean(errors) == pytest.approx(np.sqrt(np.mean(scatter)), rel=within)


def test_samples_far_apart_are_worth_more_than_neighbours():
    noise = found(first_order(20.0, np.random.default_rng(1)))
    assert mean_of(noise, np.arange(0, 5000, 100)) < 0.5 * mean_of(noise, np.arange(50))


def test_means_of_neighbours_correlate():
    """Means of 50 samples of a noise with a memory of 100: one beside the other alike, ten farther on not."""
    noise = found(first_order(100.0, np.random.default_rng(2)))
    shares = np.kron(np.eye(SAMPLES // PART), np.full(PART, 1.0 / PART))
    covariance = noise.of_means(shares)
    correlation = covariance / covariance[0, 0]
    assert correlation[0, 1] == pytest.approx(0.6, abs=0.15)
    assert correlation[0, 10] < 0.1


def test_readings_without_noise_have_none():
    none = sample_noise(np.zeros(100), np.ones((100, 1)), np.arange(100), 100)
    assert none.of_means(np.full((1, 100), 0.01))[0, 0] == 0.0
