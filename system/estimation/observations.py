"""Readings and their noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.inputs.units import Dimension

BLOCKS = 10  # of readings without regions of their own


@dataclass(frozen=True)
class Channel:
    """One channel of readings: its name and its dimension (None: a pure number)."""

    name: str
    dimension: Dimension | None


@dataclass(frozen=True)
class Observations:
    """N points by C channels, all in SI; rows are in the order of recording.

    values, sigma: (N, C), reading and one sigma of its repeatability; nan = not measured. inputs, input_sigma: names of
    the M inputs that were measured too, and one sigma of each, (N, M). quantum: (C,), the step of a digital reading, 0
    without one. blocks: (N,) integers, points of one block are close to each other (region of the map, stretch of
    time). memory: coefficients of an autoregressive noise along the rows (of consecutive points of a time series), the
    nearest first; empty: the noise of each point is independent. correlation: of each channel (N, N), known correlation
    of the readings' own noise between points, in place of `memory`; or None.
    """

    channels: tuple[Channel, ...]
    values: Array
    sigma: Array
    inputs: tuple[str, ...]
    input_sigma: Array
    quantum: Array
    blocks: NDArray[np.int64]
    memory: tuple[float, ...] = ()
    correlation: tuple[Array, ...] = ()

    def __post_init__(self) -> None:
        """Raise InputError for arrays of inconsistent shapes and for a reading without a noise."""
        points, channels = len(self.values), len(self.channels)
        shapes = (
            ("values", self.values.shape, (points, channels)),
            ("sigma", self.sigma.shape, (points, channels)),
            ("input_sigma", self.input_sigma.shape, (points, len(self.inputs))),
            ("quantum", self.quantum.shape, (channels,)),
            ("blocks", self.blocks.shape, (points,)),
            *((f"correlation[{at}]", own.shape, (points, points)) for at, own in enumerate(self.correlation)),
            ("correlation", (len(self.correlation),), (channels if self.correlation else 0,)),
        )
        for name, found, expected in shapes:
            if found != expected:
                raise InputError(f"observations.{name}", f"shape {found}", f"shape {expected}")
        if not np.all(self.sigma[self.measured] > 0):
            raise InputError("observations.sigma", "a reading without a positive sigma", "one sigma for each reading")

    @property
    def measured(self) -> NDArray[np.bool_]:
        """(N, C), true where there is a reading."""
        return np.isfinite(self.values)

    def without(self, rows: NDArray[np.bool_]) -> Observations:
        """The same, as if the points where `rows` (N,) is true had not been measured; N stays."""
        return replace(self, values=np.where(rows[:, None], np.nan, self.values))


def independent_observations(names: Sequence[str], values: Array, sigma: Array) -> Observations:
    """Readings (N, C) of channels by name, with independent noise of one sigma (C,), inputs being known exactly.

    A tenth of the rows, in their order, is one block.
    """
    points = len(values)
    return Observations(
        channels=tuple(Channel(name, None) for name in names),
        values=values,
        sigma=np.broadcast_to(sigma, values.shape).copy(),
        inputs=(),
        input_sigma=np.zeros((points, 0)),
        quantum=np.zeros(len(names)),
        blocks=np.arange(points) * BLOCKS // max(points, 1),
    )
