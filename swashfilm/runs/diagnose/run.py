"""A recording held against the simulation of its pump: from two files to a diagnosis in a run folder."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from diagnosis.checks.check import check_recording, too_few, too_smooth
from diagnosis.checks.notes import point_ranges
from diagnosis.next_test import with_next_point
from diagnosis.procedure import diagnose_study
from diagnosis.recording.model import DataNote, NoteKind, Recording
from diagnosis.recording.reader import read_recording
from diagnosis.study.inputs import bench_points
from diagnosis.study.model import Study
from diagnosis.study.prepare import prepare
from diagnosis.study.scaled_pump import KnownPump, load_known_pump
from diagnosis.thresholds import Thresholds, load_thresholds
from diagnosis.verdict.diagnosis import Diagnosis, Status
from diagnosis.verdict.row_numbers import by_table_rows
from reynolds.errors import FilmInputError
from reynolds.laws.oil import walther
from swashfilm.runs.diagnose.before_after import claimed_pump, run_both
from swashfilm.runs.diagnose.files import NO_NEXT_POINT, write_diagnosis_files
from swashfilm.runs.diagnose.page import write_diagnose_page
from system.description.pump import PumpDescription
from system.description.tolerances import tolerances
from system.effects.catalogue.entries import CATALOGUE
from system.effects.effect import Kind
from system.effects.extension import Entry
from system.inputs.errors import NotConverged
from system.inputs.faults import Fault, InputFaults
from system.pump_file.file import builtin_pumps, resolved_toml
from system.work.progress import Report

EXTENDED = "pump_extended.toml"
"""In the run folder, where something is claimed: the pump with it."""


def checked_recording(path: Path, known: KnownPump | None = None) -> Recording:
    """The recording of a path, checked against its pump: the one given, or the built-in one that it names.

    Raises InputFaults, every fault at once, where nothing can be made of it.
    """
    recording = read_recording(path)
    if known is None and recording.pump in builtin_pumps():
        known = load_known_pump(recording.pump)
    recording = check_recording(recording, None if known is None else known.pump.pump.displacement)
    recording = replace(recording, notes=(*recording.notes, *other_pump(recording, known)))
    faults = [note for note in recording.notes if note.kind is NoteKind.FAULT]
    if faults:
        raise InputFaults(str(path), [_fault(note) for note in faults])
    return recording


def other_pump(recording: Recording, known: KnownPump | None) -> Iterator[DataNote]:
    """Told where a recording names another pump than the one that it is held against."""
    if known is not None and recording.pump not in ("", known.pump.name):
        text = f"the recording is of {recording.pump}; it is held against {known.pump.name}"
        yield DataNote(NoteKind.TOLD, None, (), text)


def _with_next_point(study: Study, pump: PumpDescription, found: Diagnosis, thresholds: Thresholds) -> Diagnosis:
    """With the next point to record; where none can be foretold without it, and why in the notes.

    Beside unknown physics none is asked for: what could be parted there are effects that explain nothing.
    """
    if found.kind is Kind.UNKNOWN_PHYSICS and found.status is Status.NAMED:
        return found
    try:
        return with_next_point(study, pump, found, thresholds)
    except (NotConverged, FilmInputError) as reason:
        return replace(found, notes=(*found.notes, f"{NO_NEXT_POINT}: {reason}"))


def _fault(note: DataNote) -> Fault:
    """A finding as a fault of its channel; what may mend it, behind a semicolon, is the nearest choice."""
    where = f"channel.{note.channel.value}" if note.channel else "recording"
    found, _, mend = note.text.partition("; ")
    at = f"point {point_ranges(note.points)}: " if note.points else ""
    return Fault(where, at + found, "readings as they were taken, with their units", mend.removesuffix("?"))


def run_diagnosis(
    known: KnownPump,
    recording: Recording,
    folder: Path,
    report: Report,
    workers: int = 1,
    catalogue: tuple[Entry, ...] = CATALOGUE,
) -> Diagnosis:
    """Diagnose a checked recording and fill a run folder, fits in `workers` processes side by side.

    Raises NotConverged where no fit comes about, InputFaults for too few or too smooth readings.
    """
    pump, thresholds = known.pump, load_thresholds()
    allowed, taken = tolerances(pump)
    study = prepare(pump, recording, allowed, thresholds, catalogue)
    few = too_few(study.recording, len(study.simulator.parameters))
    if few is not None:
        raise InputFaults(recording.title, [Fault("recording", few.text, "more readings than parameters")])
    smooth = too_smooth(study.base.objective, study.base.residual.size)
    if smooth is not None:
        raise InputFaults(recording.title, [Fault("recording", smooth.text, "readings with the noise stated")])
    points, _ = bench_points(study.recording, pump)
    viscosity = walther(points.T_case, pump.oil.fluid) * pump.oil.density
    found = diagnose_study(study, viscosity, thresholds, report, workers)
    found = by_table_rows(_with_next_point(study, pump, found, thresholds), study.recording)
    (folder / "resolved.toml").write_text(resolved_toml(pump), encoding="utf-8")
    if found.effects:
        (folder / EXTENDED).write_text(resolved_toml(claimed_pump(pump, found)), encoding="utf-8")
    assumptions = [str(one) for one in (*known.assumptions, *taken)]
    told = run_both(folder, pump, study, found, thresholds, report)
    write_diagnosis_files(folder, study, found, thresholds, assumptions, told)
    write_diagnose_page(folder)
    return found
