"""Checks of a recording before any simulation: faults, and readings that are put aside."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from diagnosis.checks.coverage import coverage
from diagnosis.checks.outliers import outliers
from diagnosis.checks.readings import impossible
from diagnosis.checks.sensors import copies, low_resolution, noiseless, repeated_rows, stuck, stuck_inputs
from diagnosis.checks.units import implausible, trace_sizes
from diagnosis.recording.model import DataNote, NoteKind, Recording
from diagnosis.recording.units import difference, difference_unit
from diagnosis.thresholds import DataLimits
from system.bench.outputs import METERED, SIMULATED
from system.inputs.channels import ChannelName

MOST_POINTS = 1000
"""Of a table of steady points: a fit takes time as their number, tests of drift and place as its cube."""
ROUGH, TOGETHER, ROUGH_ALONE = 1.4, 3, 2.0
"""Scatter in multiples of the repeatability: of all channels too much, of TOGETHER channels at least; of one alone."""
VARIED = 2.0
"""Ratio of flow over displacement ratio between points: more than leakage explains: the speed varied."""


def check_recording(recording: Recording, displacement: float | None, limits: DataLimits) -> Recording:
    """Return the recording with notes on its readings, and nan for readings that are put aside.

    displacement: of the pump in m3/rev, a reference of flow and torque; None if unknown. FAULT: the recording
    cannot be used before it is corrected (units, a channel that copies another, no noise at all). REMOVED: these
    readings are not used (slips, a stuck sensor). SUSPECT: kept until explanations have been fitted. NOTED:
    information.
    """
    recording = with_notes(recording, [*_too_many(recording), *_gaps(recording), *impossible(recording)])
    with np.errstate(divide="ignore", invalid="ignore"):
        recording = with_notes(recording, [*implausible(recording, displacement), *trace_sizes(recording)])
    recording = with_notes(recording, _speed(recording))
    for find in (coverage, low_resolution, stuck, stuck_inputs, repeated_rows, copies, noiseless):
        recording = with_notes(recording, find(recording))
    return with_notes(recording, outliers(recording, limits))


def _too_many(recording: Recording) -> Iterable[DataNote]:
    """A fault of a recording with more points than a diagnosis can take."""
    count = len(recording.steady.values)
    if count > MOST_POINTS:
        every = -(-count // MOST_POINTS)
        text = f"{count} steady points, of which a diagnosis takes {MOST_POINTS} at most"
        mend = f"keep one row in {every}, the means of rows that repeat a set point, or read samples as a [series]"
        yield DataNote(NoteKind.FAULT, None, (), f"{text}; {mend}")


def too_few(recording: Recording, parameters: int) -> DataNote | None:
    """Return the fault of a recording with no more simulated readings than parameters; None if it has more."""
    readings = sum(int(np.isfinite(recording.steady.column(name)).sum()) for name in METERED)
    if readings > parameters:
        return None
    points = len(recording.steady.values)
    at = "one operating point, inputs do not move" if points == 1 else f"{points} operating points"
    count = f"{readings} readings of flows and torque at {at}, for {parameters} parameters"
    text = f"{count}: record other pressures, speeds and temperatures"
    return DataNote(NoteKind.FAULT, None, (), text)


def too_smooth(chi2: float, readings: int, least: float) -> DataNote | None:
    """Return the fault of readings with far less scatter about a fit than their noise; None with enough scatter.

    chi2: of all readings; below `least` of their number they are simulated, smoothed, or better than stated.
    """
    if chi2 >= least * readings:
        return None
    return DataNote(
        NoteKind.FAULT,
        None,
        (),
        f"chi2 {chi2 / readings:.2g} per reading: they scatter by far less than their repeatability. Simulated or "
        "smoothed readings have no noise of their own; of measured ones, state the sigma that repeats show",
    )


def understated(scatter: Mapping[ChannelName, float]) -> bool:
    """True for readings all of which scatter more than their repeatability about any smooth law of the inputs.

    Physics shows in some channels and is smooth; a repeatability that is too small shows in all and is not. scatter: in
    multiples of the usual repeatability, of channels with enough readings to tell.
    """
    return len(scatter) >= TOGETHER and min(scatter.values()) >= ROUGH


def too_rough(scatter: Mapping[ChannelName, float], sigma: Mapping[ChannelName, float]) -> Iterator[DataNote]:
    """Yield the warning of readings that scatter more than their repeatability (sigma, SI) about any smooth law.

    Where all do, the scatter is used in its place. scatter as `understated` has it.
    """
    every = understated(scatter)
    rough = {name: size for name, size in scatter.items() if every or size >= ROUGH_ALONE}
    if not rough:
        return
    sizes = ", ".join(
        f"{name.value} {size:.1f} times ({difference(name, size * sigma[name]):.2g} {difference_unit(name)})"
        for name, size in rough.items()
    )
    text = f"readings scatter more than their repeatability about any smooth law of the inputs: {sizes}"
    used = "; this scatter is used" if every else ""
    yield DataNote(NoteKind.WARNED, None, (), f"{text}{used}; state the sigma that repeated points show")


def with_notes(recording: Recording, notes: Iterable[DataNote]) -> Recording:
    """The recording with notes added; readings of channels in removing notes become nan."""
    found = tuple(notes)
    values = recording.steady.values.copy()
    for note in found:
        if note.kind is NoteKind.REMOVED and note.channel is not None:
            values[list(note.points), list(ChannelName).index(note.channel)] = np.nan
    steady = replace(recording.steady, values=values)
    return replace(recording, steady=steady, notes=(*recording.notes, *found))


def _speed(recording: Recording) -> Iterable[DataNote]:
    """A recording without its speed is of one speed; a flow that contradicts this is a fault."""
    if recording.channel(ChannelName.SPEED) is not None or recording.channel(ChannelName.Q_OUT) is None:
        return
    ratio = recording.steady.column(ChannelName.DISPLACEMENT_RATIO)
    flow = recording.steady.column(ChannelName.Q_OUT) / np.where(np.isfinite(ratio), ratio, 1.0)
    known = flow[np.isfinite(flow) & (flow > 0.0)]
    if known.size and known.max() > VARIED * known.min():
        text = (
            f"speed is not recorded, and Q_out over displacement_ratio varies {known.max() / known.min():.1f} "
            "times: more than leakage explains. Add the speed, or keep to points of one speed"
        )
        yield DataNote(NoteKind.FAULT, ChannelName.SPEED, (), text)


def _gaps(recording: Recording) -> Iterable[DataNote]:
    """Notes on channels with missing readings; a channel without any is a fault, and so is no output."""
    if not any(recording.channel(name) is not None for name in SIMULATED):
        names = ", ".join(name.value for name in SIMULATED)
        yield DataNote(NoteKind.FAULT, None, (), f"none of {names} is recorded; record at least one of them")
    for channel in recording.channels:
        if channel.name in (ChannelName.ANGLE, ChannelName.P_CHAMBER, ChannelName.TORQUE_UNCOUPLED):
            continue
        missing = np.flatnonzero(~np.isfinite(recording.steady.column(channel.name)))
        count = len(recording.steady.values)
        if len(missing) == count:
            yield DataNote(NoteKind.FAULT, channel.name, (), f"{channel.name.value} has no reading at any point")
        elif len(missing):
            points = tuple(int(point) for point in missing)
            text = f"{channel.name.value} is missing at {len(missing)} of {count} points"
            yield DataNote(NoteKind.NOTED, channel.name, points, text)
