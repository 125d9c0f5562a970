"""Points of a bench by the recorded inputs, and assumed values of the others."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.missing_inputs import Origin, origin
from diagnosis.recording.model import DataNote, NoteKind, Recording
from diagnosis.recording.units import channel_unit, difference, difference_unit, reading
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.bench.sensors import taken_parameter
from system.description.pump import PumpDescription
from system.estimation.parameters import Parameter
from system.inputs.channels import INPUTS, ChannelName

WARMER = 5.0  # K, of case and inlet one for the other: a case is warmer by the losses
WARMTH = 10.0  # K, where neither is measured
DRIVE, SETTING = 0.02, 0.01  # of a speed: the slip of a motor; of a stroke that a stop holds
RELIEF = 0.1  # of a pressure that a relief valve holds: charge, delivery
TANK, DRAIN = 0.1e5, 0.5e5  # Pa: level and suction line, drain line


@dataclass(frozen=True)
class AssumedInput:
    """An input that is not recorded: its value in SI, or the channel read in its place; one sigma in SI."""

    channel: ChannelName
    value: float | ChannelName
    sigma: float

    @property
    def text(self) -> str:
        """The assumption as text, with one sigma."""
        name = self.channel
        sigma = f"+- {difference(name, self.sigma):.2g}"
        if isinstance(self.value, ChannelName):
            other = f"{self.value.value} {sigma} {difference_unit(name)}"
            return f"{name.value} is not measured: assumed equal to {other}"
        unit = "" if channel_unit(name) == "1" else f" {channel_unit(name)}"
        return f"{name.value} is not measured: assumed {reading(name, self.value):.4g} {sigma}{unit}"


def measured(recording: Recording, names: Iterable[ChannelName]) -> tuple[ChannelName, ...]:
    """Those of the channels for which the recording has a sigma and a reading."""
    return tuple(
        name
        for name in names
        if recording.channel(name) is not None and np.any(np.isfinite(recording.steady.column(name)))
    )


def complete(recording: Recording) -> Recording:
    """The recording without points at which a measured input is missing; a note lists them."""
    missing = np.zeros(len(recording.steady.values), dtype=bool)
    for name in measured(recording, INPUTS):
        missing |= ~np.isfinite(recording.steady.column(name))
    if not missing.any():
        return recording
    gone = tuple(int(point) for point in np.flatnonzero(missing))
    lost = " (with a trace)" if any(missing[trace.point] for trace in recording.traces) else ""
    note = DataNote(NoteKind.REMOVED, None, gone, f"an input of these points is missing{lost}")
    return replace(_of_points(recording, np.flatnonzero(~missing)), notes=(*recording.notes, note))


def in_time(recording: Recording) -> Recording:
    """The recording with its points in the order of their times, where all have one; a note if their rows are not."""
    hours = recording.steady.hours
    if not np.isfinite(hours).all() or np.all(np.diff(hours) >= 0.0):
        return recording
    order = np.argsort(hours, kind="stable")
    note = DataNote(NoteKind.NOTED, None, (), "rows are not in the order of their times: points are put in that order")
    found = _of_points(recording, order)
    return replace(found, steady=replace(found.steady, rows=order), notes=(*recording.notes, note))


def _of_points(recording: Recording, points: NDArray[np.int64]) -> Recording:
    """The recording of some of its points, in their order here, with their traces."""
    place = {int(point): at for at, point in enumerate(points)}
    traces = tuple(replace(one, point=place[one.point]) for one in recording.traces if one.point in place)
    return replace(recording, steady=recording.steady.at(points), traces=traces)


def assumed_inputs(recording: Recording, pump: PumpDescription) -> tuple[AssumedInput, ...]:
    """Assumed value of every input that the recording lacks.

    Its value is that of its `origin`.
    """
    known = measured(recording, INPUTS)
    return tuple(_assumed_input(recording, pump, name, known) for name in INPUTS if name not in known)


def assumed_parameters(recording: Recording, pump: PumpDescription) -> tuple[Parameter, ...]:
    """CHANNEL.zero of every input that the recording lacks: excess of the assumed value, at all points."""
    return tuple(taken_parameter(one.channel, one.sigma) for one in assumed_inputs(recording, pump))


def bench_points(recording: Recording, pump: PumpDescription) -> tuple[BenchPoints, tuple[DataNote, ...]]:
    """The points to simulate, by readings and `assumed_inputs`, and these in words."""
    count = len(recording.steady.values)
    columns: dict[str, Array] = {name.value: recording.steady.column(name) for name in measured(recording, INPUTS)}
    assumed = assumed_inputs(recording, pump)
    for one in assumed:
        value = one.value
        column = recording.steady.column(value) if isinstance(value, ChannelName) else np.full(count, value)
        columns[one.channel.value] = column
    steady, order = recording.steady, np.arange(count, dtype=float)
    warming = np.zeros(count) if steady.warming is None else steady.warming
    points = BenchPoints(**columns, hours=steady.hours, order=order, warming=warming)
    return points, tuple(DataNote(NoteKind.NOTED, one.channel, (), one.text) for one in assumed)


def _assumed_input(
    recording: Recording, pump: PumpDescription, name: ChannelName, known: tuple[ChannelName, ...]
) -> AssumedInput:
    stated, where = pump.operating, origin(name, known, recording.circuit)
    if isinstance(where, ChannelName):
        return AssumedInput(name, where, WARMER)
    if where is Origin.AMBIENT:
        return AssumedInput(name, 0.0, TANK)
    match name:
        case ChannelName.SPEED:
            return AssumedInput(name, stated.speed, DRIVE * stated.speed)
        case ChannelName.DISPLACEMENT_RATIO:
            return AssumedInput(name, stated.displacement_ratio, SETTING)
        case ChannelName.P_OUT:
            return AssumedInput(name, stated.pressure, RELIEF * stated.pressure)
        case ChannelName.P_IN:
            return AssumedInput(name, stated.inlet_pressure, max(RELIEF * stated.inlet_pressure, TANK))
        case ChannelName.P_CASE:
            return AssumedInput(name, stated.case_pressure, DRAIN)
        case _:
            return AssumedInput(name, stated.temperature, WARMTH)
