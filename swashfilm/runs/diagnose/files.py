"""Files of a diagnosis in its run folder, for programs and for the page."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from diagnosis.checks.notes import note_text
from diagnosis.procedure.compared import NO_COMPARISON, WITH, WITHOUT, FilmComparison, PumpComparison
from diagnosis.recording.model import NoteKind
from diagnosis.recording.units import channel_unit, reading
from diagnosis.report.answer import PlainAnswer
from diagnosis.report.hidden import HEAD, hidden_rows
from diagnosis.report.json_file import write_diagnosis
from diagnosis.report.tables import (
    hypothesis_rows,
    next_point_head,
    next_point_rows,
    parameter_rows,
    pull_sums,
    residual_rows,
    steady_rows,
)
from diagnosis.report.trace_tables import trace_residual_rows
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis
from swashfilm.formats.versions import headed
from swashfilm.output.run_folder import write_json
from swashfilm.output.tables import parted, read_csv, write_csv
from system.inputs.channels import ChannelName

KIND = "diagnosis"
CHANGE_HEAD = ("quantity", "unit", WITHOUT, WITH, "change")
FILM_HEAD = ("quantity", "unit", *(f"{kind}_{name}" for kind in ("lumped", "films") for name in (WITHOUT, WITH)))
"""Columns of a table without rows."""
TRACES = "trace_residuals.csv"
"""Table of the traces in the run folder of a recording, as residuals.csv is of the steady readings."""
HIDDEN = "hidden.csv"
"""Table of the effects that are not claimed, at the largest size that the recording allows."""


def write_diagnosis_files(
    folder: Path,
    study: Study,
    diagnosis: Diagnosis,
    answer: PlainAnswer,
    assumptions: Sequence[str] = (),
    comparison: PumpComparison = NO_COMPARISON,
) -> None:
    """Write diagnosis.json, summary.json, and eight tables (of traces a ninth) into a run folder.

    answer: the diagnosis in plain words; assumptions: of the pump; comparison: the pump without and with the finding.
    """
    write_rows(folder / "steady.csv", steady_rows(study.recording))
    write_rows(folder / "residuals.csv", residual_rows(study, diagnosis))
    if study.traces:
        write_rows(folder / TRACES, with_stated(study, trace_residual_rows(study, diagnosis)))
    write_rows(folder / "hypotheses.csv", hypothesis_rows(diagnosis))
    write_rows(folder / "parameters.csv", parameter_rows(diagnosis))
    write_rows(folder / HIDDEN, hidden_rows(study, diagnosis), HEAD)
    write_rows(folder / "next_points.csv", next_point_rows(diagnosis.next_point), next_point_head())
    write_rows(folder / "changes.csv", change_rows(comparison), CHANGE_HEAD)
    write_rows(folder / "films.csv", film_rows(comparison.films), FILM_HEAD)
    write_diagnosis(folder / "diagnosis.json", diagnosis, answer)
    summary = diagnosis_summary(study, diagnosis, assumptions)
    write_json(folder / "summary.json", summary | {"runs": comparison.text, "films": comparison.films.text})


def change_rows(comparison: PumpComparison) -> Iterator[Mapping[str, str]]:
    """Rows of quantity, unit, without, with, change."""
    for one in comparison.changes:
        yield {
            "quantity": one.quantity, "unit": one.unit, WITHOUT: f"{one.without:.6g}", WITH: f"{one.found:.6g}",
            "change": f"{one.found - one.without:.3g}",
        }  # fmt: skip


def film_rows(comparison: FilmComparison) -> Iterator[Mapping[str, str]]:
    """Rows of quantity, unit, lumped_NAME and films_NAME: by closed-form laws, and by films."""
    for one in comparison.changes:
        lumped = {f"lumped_{name}": f"{value:.6g}" for name, value in one.lumped.items()}
        films = {f"films_{name}": f"{value:.6g}" for name, value in one.films.items()}
        yield {"quantity": one.quantity, "unit": one.unit, **lumped, **films}


def with_stated(study: Study, rows: Iterable[Mapping[str, str]]) -> Iterator[Mapping[str, str]]:
    """The rows of the traces with the pressure of the pump within its tolerances, fitted to the traces alone."""
    stated = np.concatenate([trace.block.mean - trace.residual for trace in study.traces])
    head = f"stated [{channel_unit(ChannelName.P_CHAMBER)}]"
    for row, pressure in zip(rows, stated, strict=True):
        yield {**row, head: f"{reading(ChannelName.P_CHAMBER, float(pressure)):.6g}"}


def diagnosis_summary(study: Study, diagnosis: Diagnosis, assumptions: Sequence[str]) -> dict[str, Any]:
    """Content of summary.json: the recording, its data notes, assumptions, hash of the thresholds."""
    before, after = pull_sums(diagnosis.before, diagnosis.after)
    recording = study.recording
    return {
        **headed(KIND),
        "name": recording.title,
        "pump": recording.pump,
        "oil": recording.oil,
        "points": len(recording.steady.values),
        "channels": [channel.name.value for channel in recording.channels],
        "warnings": [note.text for note in recording.notes if note.kind is NoteKind.WARNED],
        "data_notes": [note_text(note) for note in recording.notes if note.kind is not NoteKind.WARNED],
        "assumptions": list(assumptions),
        "squared_pulls": {"before": before, "after": after},
        "thresholds_sha256": diagnosis.thresholds.digest,
        "seconds": diagnosis.effort.seconds,
    }


def write_rows(path: Path, rows: Iterable[Mapping[str, str]], head: Sequence[str] = ()) -> None:
    """Write rows of one set of columns as CSV; head: the columns without rows."""
    listed = list(rows)
    names = list(listed[0]) if listed else list(head)
    write_csv(path, names, ([row[name] for name in names] for row in listed))


def head_of(row: Mapping[str, str], name: str) -> str:
    """Return the head of the column `name` of a table, with its unit; raise KeyError without one."""
    for head in row:
        if parted(head)[0] == name:
            return head
    raise KeyError(name)


def read_rows(path: Path) -> list[dict[str, str]]:
    """Rows of a file by `write_rows`."""
    head, *rows = read_csv(path)
    return [dict(zip(head, row, strict=True)) for row in rows]
