"""A recording held against the simulation of its pump: from two files to a diagnosis in a run folder."""

from __future__ import annotations

from pathlib import Path

from diagnosis.ask import with_next_point
from diagnosis.data_checks import check_recording, too_few
from diagnosis.diagnose import diagnose_study
from diagnosis.prepare import prepare
from diagnosis.readings import bench_points
from diagnosis.recording import NoteKind, Recording
from diagnosis.recording_reader import read_recording
from diagnosis.scant_pump import KnownPump
from diagnosis.study import Study
from diagnosis.thresholds import load_thresholds
from diagnosis.verdict import Diagnosis
from reynolds.oil import walther
from swashfilm.diagnose_files import note_text, write_diagnosis_files
from swashfilm.progress import Report
from system.extended_pump import extended_pump
from system.faults import Fault, InputFaults
from system.pump_file import resolved_toml
from system.tolerances import tolerances


def checked_recording(path: Path, known: KnownPump) -> Recording:
    """The recording of a path, checked against the pump; raises InputFaults where nothing can be made of it."""
    recording = check_recording(read_recording(path), known.pump.pump.displacement)
    faults = [note for note in recording.notes if note.kind is NoteKind.FAULT]
    if faults:
        told = [
            Fault("recording", note_text(note), "readings as they were taken, with their units") for note in faults
        ]
        raise InputFaults(str(path), told)
    return recording


def run_diagnosis(known: KnownPump, recording: Recording, folder: Path, report: Report) -> Diagnosis:
    """Diagnose a checked recording and fill a run folder. Raises NotConverged where no fit comes about."""
    pump, thresholds = known.pump, load_thresholds()
    allowed, taken = tolerances(pump)
    study = prepare(pump, recording, allowed, thresholds)
    few = too_few(study.recording, len(study.simulator.parameters))
    if few is not None:
        raise InputFaults(recording.title, [Fault("recording", few.text, "more readings than parameters")])
    points, _ = bench_points(study.recording, pump)
    viscosity = walther(points.T_case, pump.oil.fluid) * pump.oil.density
    found = diagnose_study(study, viscosity, thresholds, report)
    found = with_next_point(study, pump, found, thresholds)
    (folder / "resolved.toml").write_text(resolved_toml(pump), encoding="utf-8")
    _write_extended(folder, study, found, known)
    assumptions = [str(one) for one in (*known.assumptions, *taken)]
    write_diagnosis_files(folder, study, found, thresholds, assumptions)
    return found


def _write_extended(folder: Path, study: Study, found: Diagnosis, known: KnownPump) -> None:
    """Write pump_extended.toml, the pump as the claimed explanation has it; nothing where nothing is claimed."""
    if not found.effects:
        return
    names = (parameter.name for parameter in found.after.parameters)
    values = dict(zip(names, (float(value) for value in found.after.values), strict=True))
    pump = extended_pump(known.pump, values, found.hypotheses[0].hypothesis.laws)
    (folder / "pump_extended.toml").write_text(resolved_toml(pump), encoding="utf-8")
