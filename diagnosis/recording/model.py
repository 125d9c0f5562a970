"""Recording: channels with their noise, steady points, traces over shaft angle, notes on the data."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName


class Circuit(Enum):
    """Hydraulic circuit of the pump."""

    OPEN = "open"
    CLOSED = "closed"


class NoteKind(Enum):
    """Kind of a note on the data; WARNED: reported first, as it limits every answer."""

    FAULT = "fault"
    REMOVED = "removed"
    SUSPECT = "suspect"
    NOTED = "noted"
    WARNED = "warned"


@dataclass(frozen=True)
class DataNote:
    """One note on the data: channel (None: several), points (rows from 0), and text."""

    kind: NoteKind
    channel: ChannelName | None
    points: tuple[int, ...]
    text: str


@dataclass(frozen=True)
class RecordedChannel:
    """A channel of the file: column and unit there; the rest in SI.

    One sigma of repeatability is sigma + sigma_relative x reading; quantum: step of the reading; lag in s; gain_sigma
    (relative) and zero_sigma (SI): one sigma of the calibration. `assumed` lists the fields that the file does not
    state.
    """

    name: ChannelName
    column: str
    unit: str
    sigma: float
    sigma_relative: float
    quantum: float
    lag: float
    gain_sigma: float
    zero_sigma: float
    assumed: tuple[str, ...]


def reading_sigma(channel: RecordedChannel, readings: Array) -> Array:
    """Return one sigma of repeatability of readings, both in SI: sigma + sigma_relative |reading|."""
    return channel.sigma + channel.sigma_relative * np.abs(readings)


@dataclass(frozen=True)
class SteadyTable:
    """N steady points in the order of measurement.

    values: (N, len(ChannelName)) in SI, pressures gauge, columns in the order of ChannelName, nan = not measured;
    repeats: (N,), points of one number repeat one set point; hours: (N,), h from the first point, nan = not known;
    errors: (N, len(ChannelName)), one sigma in SI of points that are means over a moving series; nan where a point has
    the repeatability of its channel. directions: (N, len(ChannelName), K), the errors of two such points have the
    scalar product of theirs as correlation; None where all points are independent. warming: (N,), K/s by which T_case
    rises at points of a moving series; None at rest. rows: (N,), places from 0 that the points have in the table as
    read, where that is in another order; None where it is not.
    """

    values: Array
    repeats: NDArray[np.int64]
    hours: Array
    errors: Array
    directions: Array | None = None
    warming: Array | None = None
    rows: NDArray[np.int64] | None = None

    def at(self, rows: NDArray[np.int64] | NDArray[np.bool_] | slice) -> SteadyTable:
        """The table of some of its points."""
        directions, warming = (None if of is None else of[rows] for of in (self.directions, self.warming))
        places = None if self.rows is None else self.rows[rows]
        return SteadyTable(
            self.values[rows], self.repeats[rows], self.hours[rows], self.errors[rows], directions, warming, places
        )

    def correlation(self, name: ChannelName) -> Array | None:
        """Correlation (N, N) of the errors of a channel's points; None where they are independent."""
        if self.directions is None:
            return None
        own = self.directions[:, list(ChannelName).index(name)]
        found = own @ own.T
        return np.asarray(found + np.diag(np.where(np.diag(found) > 0.0, 0.0, 1.0)))

    def column(self, name: ChannelName) -> Array:
        """Readings (N,) of one channel in SI."""
        return self.values[:, list(ChannelName).index(name)]


@dataclass(frozen=True)
class TraceBlock:
    """Chamber pressure over one turn at the steady point `point`: angle (K,) in rad from the inner dead centre.

    mean: (K,), Pa gauge, over `cycles` turns; covariance_factor: (K, r), the mean's covariance is factor factor^T;
    None where single cycles are not known.
    """

    point: int
    angle: Array
    mean: Array
    covariance_factor: Array | None
    cycles: int


@dataclass(frozen=True)
class Recording:
    """A recording as read: SI, pressures gauge. `pump` and `oil` are those named in its file, or empty."""

    title: str
    pump: str
    oil: str
    circuit: Circuit
    channels: tuple[RecordedChannel, ...]
    steady: SteadyTable
    traces: tuple[TraceBlock, ...]
    notes: tuple[DataNote, ...]

    def channel(self, name: ChannelName) -> RecordedChannel | None:
        """The channel of a name, None where it is not measured."""
        return next((channel for channel in self.channels if channel.name is name), None)


def point_sigma(recording: Recording, channel: RecordedChannel) -> Array:
    """One sigma (N,) of a channel's readings in SI: of the mean where points are means, else repeatability."""
    errors = recording.steady.errors[:, list(ChannelName).index(channel.name)]
    repeatability = reading_sigma(channel, recording.steady.column(channel.name))
    return np.where(np.isfinite(errors), errors, repeatability)
