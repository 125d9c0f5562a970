"""From a recording to what is simulated and fitted: the points of the bench, and the readings with their noise."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.map_axes import scaled_axes
from diagnosis.recording import Circuit, DataNote, NoteKind, RecordedChannel, Recording, reading_sigma
from reynolds.errors import FilmInputError
from system.bench_points import BenchPoints
from system.channels import INPUTS, ChannelName
from system.description import PumpDescription
from system.estimation.observations import Channel, Observations
from system.kinematics import Array
from system.units import format_quantity

THIRD = 1.0 / 3.0  # of an axis scaled to [-1, 1], on either side of its middle


def measured(recording: Recording, names: Iterable[ChannelName]) -> tuple[ChannelName, ...]:
    """Those of the channels that the recording has a sigma and a reading of."""
    return tuple(
        name
        for name in names
        if recording.channel(name) is not None and np.any(np.isfinite(recording.steady.column(name)))
    )


def complete(recording: Recording) -> Recording:
    """The recording without points at which an input that was measured elsewhere is missing; each is told."""
    missing = np.zeros(len(recording.steady.values), dtype=bool)
    for name in measured(recording, INPUTS):
        missing |= ~np.isfinite(recording.steady.column(name))
    if not missing.any():
        return recording
    gone = tuple(int(point) for point in np.flatnonzero(missing))
    note = DataNote(NoteKind.REMOVED, None, gone, "an input of these points is missing")
    place = np.cumsum(~missing) - 1
    steady = replace(
        recording.steady, **{name: values[~missing] for name, values in vars(recording.steady).items()}
    )
    traces = tuple(
        replace(trace, point=int(place[trace.point])) for trace in recording.traces if not missing[trace.point]
    )
    return replace(recording, steady=steady, traces=traces, notes=(*recording.notes, note))


def bench_points(recording: Recording, pump: PumpDescription) -> tuple[BenchPoints, tuple[DataNote, ...]]:
    """The points to simulate, and what was taken for inputs that the recording lacks.

    These are as [operating] of the pump states them; an inlet pressure of an open circuit is that around; of case
    and inlet temperature the one stands for the other.
    """
    count = len(recording.steady.values)
    known = measured(recording, INPUTS)
    columns: dict[str, Array] = {}
    notes = []
    for name in INPUTS:
        if name in known:
            columns[name.value] = recording.steady.column(name)
            continue
        other = ChannelName.T_IN if name is ChannelName.T_CASE else ChannelName.T_CASE
        if name in (ChannelName.T_CASE, ChannelName.T_IN) and other in known:
            columns[name.value] = recording.steady.column(other)
            text = f"taken as {other.value}"
        else:
            value = _usual(recording, pump, name)
            columns[name.value] = np.full(count, value)
            shown = f"{value:g}" if name.dimension is None else format_quantity(value, name.dimension, 4)
            text = f"taken {shown}"
        notes.append(DataNote(NoteKind.TOLD, name, (), f"{name.value} is not measured: {text}"))
    points = BenchPoints(**columns, hours=recording.steady.hours, order=np.arange(count, dtype=float))
    return points, tuple(notes)


def observations(
    recording: Recording, channels: tuple[ChannelName, ...], inputs: tuple[ChannelName, ...]
) -> Observations:
    """The readings of some channels with their repeatability, and the noise of the inputs.

    Blocks are the cells of thirds of the map's axes: points of one block stand near each other. Raises
    FilmInputError for a channel that was not measured.
    """
    steady = recording.steady
    stated = [_channel(recording, name) for name in channels]
    values = np.stack([steady.column(name) for name in channels], axis=1)
    sigma = np.stack([reading_sigma(one, steady.column(one.name)) for one in stated], axis=1)
    input_sigma = np.zeros((len(values), len(inputs)))
    for at, name in enumerate(inputs):
        one = _channel(recording, name)
        input_sigma[:, at] = np.hypot(reading_sigma(one, steady.column(name)), one.quantum / np.sqrt(12.0))
    return Observations(
        channels=tuple(Channel(name.value, name.dimension) for name in channels),
        values=values,
        sigma=sigma,
        inputs=tuple(name.value for name in inputs),
        input_sigma=input_sigma,
        quantum=np.array([one.quantum for one in stated]),
        blocks=_cells(scaled_axes(recording)),
    )


def _channel(recording: Recording, name: ChannelName) -> RecordedChannel:
    found = recording.channel(name)
    if found is None:
        raise FilmInputError("recording", f"no channel {name.value}", "a channel that was measured")
    return found


def _cells(axes: Array) -> NDArray[np.int64]:
    thirds = np.digitize(axes, [-THIRD, THIRD])
    return np.asarray(np.unique(thirds, axis=0, return_inverse=True)[1], dtype=np.int64).ravel()


def _usual(recording: Recording, pump: PumpDescription, name: ChannelName) -> float:
    stated = pump.operating
    match name:
        case ChannelName.SPEED:
            return stated.speed
        case ChannelName.DISPLACEMENT_RATIO:
            return stated.displacement_ratio
        case ChannelName.P_OUT:
            return stated.pressure
        case ChannelName.P_IN:
            return 0.0 if recording.circuit is Circuit.OPEN else stated.inlet_pressure
        case ChannelName.P_CASE:
            return stated.case_pressure
        case _:
            return stated.temperature
