"""A recording accepted for a pump: read, checked against the pump, refused with every fault at once."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from diagnosis.checks.check import check_recording, too_few, too_smooth
from diagnosis.checks.notes import point_ranges
from diagnosis.recording.model import DataNote, NoteKind, Recording
from diagnosis.recording.reader import read_recording
from diagnosis.study.model import Study
from diagnosis.thresholds import load_thresholds
from system.inputs.faults import Fault, InputFaults
from system.pump_file.file import KnownPump, builtin_pumps, load_known_pump

GRADE_BAND = 0.101
"""Of the viscosity of an ISO grade, with a margin for rounding in a file."""
_GRADE = re.compile(r"\bVG\s*(\d+)", re.IGNORECASE)


def accepted_recording(source: Recording | Path | str, known: KnownPump) -> Recording:
    """A recording that `checked_recording` has returned, or the checked recording of a path."""
    return source if isinstance(source, Recording) else checked_recording(source, known)


def checked_recording(path: Path | str, known: KnownPump | None = None) -> Recording:
    """The recording of a path, checked against its pump: the given pump, or the built-in pump that it names.

    Raises InputFaults with every fault of the files and of the readings.
    """
    recording = read_recording(path)
    if known is None and recording.pump in builtin_pumps():
        known = load_known_pump(recording.pump)
    displacement = None if known is None else known.pump.pump.displacement
    recording = check_recording(recording, displacement, load_thresholds().data)
    recording = replace(recording, notes=(*recording.notes, *contradictions(recording, known)))
    faults = [note for note in recording.notes if note.kind is NoteKind.FAULT]
    if faults:
        raise InputFaults(str(path), [_fault(note) for note in faults])
    return recording


def contradictions(recording: Recording, known: KnownPump | None) -> Iterator[DataNote]:
    """Notes where the recording names another pump, or an oil of another grade, than the pump that it is compared with.

    ISO 3448 allows a grade 10 % either side of its viscosity at 40 degC. An oil without a grade in its name is not
    checked.
    """
    if known is None:
        return
    if recording.pump not in ("", known.pump.name):
        text = f"the recording is of {recording.pump}; it is compared with {known.pump.name}"
        yield DataNote(NoteKind.WARNED, None, (), text)
    grade = _GRADE.search(recording.oil)
    own = 1e6 * known.pump.oil.kinematic_viscosity_40C
    if grade is not None and not 1.0 - GRADE_BAND <= own / float(grade[1]) <= 1.0 + GRADE_BAND:
        text = (
            f"the recording was made with {recording.oil}; the pump's file has an oil of {own:.3g} mm2/s at 40 degC. "
            "Leakage and friction go with the viscosity: correct the one that is wrong"
        )
        yield DataNote(NoteKind.WARNED, None, (), text)


def refuse_too_few(study: Study) -> None:
    """Raises InputFaults for a study with no more readings than parameters."""
    few = too_few(study.recording, len(study.simulator.parameters))
    if few is not None:
        raise InputFaults(study.recording.title, [Fault("recording", few.text, "more readings than parameters")])


def refuse_too_smooth(study: Study, least_chi2: float) -> None:
    """Raises InputFaults for readings with far less scatter about the fit than their noise."""
    smooth = too_smooth(study.base.objective, study.base.residual.size, least_chi2)
    if smooth is not None:
        raise InputFaults(study.recording.title, [Fault("recording", smooth.text, "readings with the noise stated")])


def _fault(note: DataNote) -> Fault:
    """A note as a fault of its channel; the text behind a semicolon, a remedy, is the nearest choice."""
    where = f"channel.{note.channel.value}" if note.channel else "recording"
    found, _, mend = note.text.partition("; ")
    at = f"point {point_ranges(note.points)}: " if note.points else ""
    return Fault(where, at + found, "readings as they were taken, with their units", mend.removesuffix("?"))
