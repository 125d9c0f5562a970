"""Maps, readings and simulators of toy pumps whose truth is known, for tests of the diagnosis."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from diagnosis import Circuit, Recording, SteadyTable, load_thresholds
from diagnosis.study.map_axes import AXES
from reynolds import Array
from system import BenchPoints, Channel, ChannelName, Observations

CHANNELS = (ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE)
SIGMA = np.array([0.1, 0.02, 0.3])  # of the channels: L/min, L/min, N m
WARMTHS = (313.0, 333.0, 353.0)  # K
LIMITS = load_thresholds()


def toy_recording(points: int, grid: Sequence[tuple[float, float, float]], seed: int) -> Recording:
    """Points of a grid of speed, pressure and displacement in no order, each at one of the WARMTHS."""
    rng = np.random.default_rng(seed)
    values = np.full((points, len(ChannelName)), np.nan)
    picked = np.array(grid)[rng.permutation(np.arange(points) % len(grid))]
    order = list(ChannelName)
    for axis, column in zip(AXES, (*picked.T, rng.choice(WARMTHS, points)), strict=True):
        values[:, order.index(axis)] = column
    table = SteadyTable(values, np.arange(points), np.full(points, np.nan), np.full_like(values, np.nan))
    return Recording("toy", "toy", "", Circuit.CLOSED, (), table, (), ())


def toy_observations(readings: Array) -> Observations:
    """Readings (N, 3) of the CHANNELS, each with its SIGMA."""
    count = len(readings)
    return Observations(
        channels=tuple(Channel(channel.value, channel.dimension) for channel in CHANNELS),
        values=readings,
        sigma=np.tile(SIGMA, (count, 1)),
        inputs=(),
        input_sigma=np.zeros((count, 0)),
        quantum=np.zeros(3),
        blocks=np.arange(count) // 8,
    )


class ToySimulator:
    """Common parts of toys: inputs without noise, differences outright, neither traces nor other points."""

    def input_slopes(self, values: Array) -> Array:
        """(N, 3, 0)."""
        return np.zeros((*self.predict(values).shape, 0))

    def predict(self, values: Array) -> Array:
        """(N, 3), by each toy."""
        raise NotImplementedError

    def difference(self, values: Array, other: Array) -> Array:
        """(N, 3)."""
        return self.predict(other) - self.predict(values)

    def elsewhere(self, points: BenchPoints) -> ToySimulator:
        """No toy is asked for other points."""
        raise NotImplementedError

    def traces(self, values: Array, points: tuple[int, ...], angles: Array) -> Array:
        """No toy is asked for its chamber."""
        raise NotImplementedError
