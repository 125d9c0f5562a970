"""The readings of a recording as observations: values with their noise, and the noise of the inputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.model import RecordedChannel, Recording, point_sigma
from diagnosis.study.map_axes import scaled_axes
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.estimation.observations import Channel, Observations
from system.inputs.channels import ChannelName

THIRD = 1.0 / 3.0  # of an axis scaled to [-1, 1], on either side of its middle


def observations(
    recording: Recording, channels: tuple[ChannelName, ...], inputs: tuple[ChannelName, ...]
) -> Observations:
    """The readings of some channels with their repeatability, and the noise of the inputs.

    Blocks are the cells of thirds of the map's axes: points of one block are near each other. Raises
    InputError for a channel that was not measured.
    """
    steady = recording.steady
    stated = [_channel(recording, name) for name in channels]
    values = np.stack([steady.column(name) for name in channels], axis=1)
    sigma = np.stack([point_sigma(recording, one) for one in stated], axis=1)
    input_sigma = np.zeros((len(values), len(inputs)))
    for at, name in enumerate(inputs):
        one = _channel(recording, name)
        input_sigma[:, at] = np.hypot(point_sigma(recording, one), one.quantum / np.sqrt(12.0))
    return Observations(
        channels=tuple(Channel(name.value, name.dimension) for name in channels),
        values=values,
        sigma=sigma,
        inputs=tuple(name.value for name in inputs),
        input_sigma=input_sigma,
        quantum=np.array([one.quantum for one in stated]),
        blocks=_cells(scaled_axes(recording)),
        correlation=tuple(found for found in map(steady.correlation, channels) if found is not None),
    )


def _channel(recording: Recording, name: ChannelName) -> RecordedChannel:
    found = recording.channel(name)
    if found is None:
        raise InputError("recording", f"no channel {name.value}", "a channel that was measured")
    return found


def _cells(axes: Array) -> NDArray[np.int64]:
    thirds = np.digitize(axes, [-THIRD, THIRD])
    return np.asarray(np.unique(thirds, axis=0, return_inverse=True)[1], dtype=np.int64).ravel()
