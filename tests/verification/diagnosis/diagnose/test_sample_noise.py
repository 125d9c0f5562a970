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


def less_slow_waves(noise):
    past = np.linspace(0.0, 1.0, SAMPLES)
    columns = np.column_stack([np.cos(np.pi * order * past) for order in range(7)])
    return noise - columns @ np.linalg.lstsq(columns, noise, rcond=None)[0]


@pytest.mark.parametrize(
    ("memory", "share", "within"), [(1.0, 0.0, 0.15), (5.0, 1.0, 0.15), (30.0, 1.0, 0.25), (100.0, 0.15, 0.3)]
)
def test_standard_error_of_a_mean(memory, share, within):
    """Over ten draws the means of 50 samples scatter as it says, noise with a memory beside white noise."""
    found, scatter = [], []
    for seed in range(10):
        rng = np.random.default_rng(seed)
        noise = SIGMA * (
            np.sqrt(1.0 - share) * rng.standard_normal(SAMPLES) + np.sqrt(share) * first_order(memory, rng)
        )
        found.append(sample_noise(less_slow_waves(noise), np.arange(SAMPLES), SAMPLES).of_mean(np.arange(PART)))
        scatter.append(np.mean(noise.reshape(-1, PART).mean(axis=1) ** 2))
    assert np.mean(found) == pytest.approx(np.sqrt(np.mean(scatter)), rel=within)


def test_samples_far_apart_are_worth_more_than_neighbours():
    noise = sample_noise(less_slow_waves(first_order(20.0, np.random.default_rng(1))), np.arange(SAMPLES), SAMPLES)
    assert noise.of_mean(np.arange(0, 5000, 100)) < 0.5 * noise.of_mean(np.arange(50))


def test_readings_without_noise_have_none():
    assert sample_noise(np.zeros(100), np.arange(100), 100).of_mean(np.arange(10)) == 0.0
