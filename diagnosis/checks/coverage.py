"""Coverage of a recording: inputs that never change, and too few outputs to distinguish a sensor from the pump."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diagnosis.recording.line_pressures import NOISE
from diagnosis.recording.model import DataNote, NoteKind, RecordedChannel, Recording, reading_sigma
from diagnosis.recording.units import channel_unit, reading
from system.bench.outputs import SIMULATED
from system.inputs.channels import INPUTS, ChannelName
from system.inputs.units import Dimension

MOVED = 0.02  # of the largest reading: least change of an input
WARMED = 2.0  # K, of a temperature
FEWEST = 3  # least number of points of a recording


def coverage(recording: Recording) -> Iterator[DataNote]:
    """Yield a warning of points that are all equal, notes on constant inputs and a single output; a fault without any
    recorded input or trace, which is a curve by itself.
    """
    inputs = [channel for channel in recording.channels if channel.name in INPUTS and _is_read(recording, channel)]
    moved = [channel for channel in inputs if _moves(recording, channel)]
    stays = [channel for channel in inputs if channel not in moved]
    if len(recording.steady.values) >= FEWEST and not moved:
        kind = NoteKind.WARNED if stays or recording.traces else NoteKind.FAULT
        yield DataNote(kind, None, (), _alike(recording, stays))
    elif fixed := [one for one in stays if one.name in (ChannelName.SPEED, ChannelName.P_OUT)]:
        text = f"{_levels(recording, fixed)} at all points: effects that differ only by how they grow with it are alike"
        yield DataNote(NoteKind.NOTED, fixed[0].name if len(fixed) == 1 else None, (), text)
    outputs = [channel for channel in recording.channels if channel.name in SIMULATED]
    if len(outputs) == 1 and not recording.traces:
        (one,) = outputs
        others = ", ".join(name.value for name in SIMULATED if name is not one.name)
        text = f"{one.name.value} is the only output: a fault of its sensor may look like the pump's; record {others}"
        yield DataNote(NoteKind.NOTED, one.name, (), text)


def _alike(recording: Recording, stays: list[RecordedChannel]) -> str:
    point = f"all points are one, {_levels(recording, stays)}" if stays else "no input is recorded"
    return (
        f"{point}: a level by itself does not distinguish a tolerance of the pump, a sensor and any effect; "
        "record other pressures, speeds and temperatures"
    )


def _levels(recording: Recording, channels: list[RecordedChannel]) -> str:
    levels = []
    for channel in channels:
        middle = float(np.nanmedian(recording.steady.column(channel.name)))
        unit = channel_unit(channel.name).removesuffix("1")
        levels.append(f"{channel.name.value} {reading(channel.name, middle):.4g} {unit}".rstrip())
    return ", ".join(levels)


def _is_read(recording: Recording, channel: RecordedChannel) -> bool:
    return bool(np.isfinite(recording.steady.column(channel.name)).any())


def _moves(recording: Recording, channel: RecordedChannel) -> bool:
    values = recording.steady.column(channel.name)
    known = values[np.isfinite(values)]
    share = WARMED if channel.name.dimension is Dimension.TEMPERATURE else MOVED * float(np.max(np.abs(known)))
    return bool(np.ptp(known) > max(NOISE * float(np.median(reading_sigma(channel, known))), share))
