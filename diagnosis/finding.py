"""A recording diagnosed against its pump: study, verdict, next point, the pump without and with the finding."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from diagnosis.procedure.compared import PumpComparison
from diagnosis.procedure.cost import cost_words
from diagnosis.procedure.next_test import with_next_point
from diagnosis.procedure.pump_comparison import claimed_pump, compare_pumps
from diagnosis.procedure.recorded import diagnose_recording
from diagnosis.recording.model import Recording
from diagnosis.report.answer import PlainAnswer, plain_answer
from diagnosis.report.hidden import HiddenEffect, hidden_effects
from diagnosis.report.measure import NO_NEXT_POINT
from diagnosis.study.acceptance import accepted_recording, refuse_too_few, refuse_too_smooth
from diagnosis.study.model import Study
from diagnosis.study.prepare import prepare
from diagnosis.study.scaled.levels import at_level
from diagnosis.thresholds import Thresholds, load_thresholds
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from diagnosis.verdict.row_numbers import by_table_rows
from reynolds.errors import InputError, NotConverged
from system.description.pump import PumpDescription
from system.description.tolerances import tolerances
from system.effects.catalogue.entries import CATALOGUE
from system.effects.effect import Kind
from system.effects.extension import Entry
from system.points.table.film_physics import FilmModel
from system.pump_file.file import KnownPump, known_pump
from system.work.progress import Report, silent


@dataclass(frozen=True)
class DiagnosisResult:
    """A diagnosis with all its inputs.

    assumptions: of the pump and of its tolerances, as text; extended_pump: the pump with the claimed effects, None
    without a claim; comparison: the pump without and with it at one operating point; answer: in plain words.
    """

    pump: PumpDescription
    study: Study
    diagnosis: Diagnosis
    assumptions: tuple[str, ...]
    extended_pump: PumpDescription | None
    comparison: PumpComparison

    @cached_property
    def answer(self) -> PlainAnswer:
        """The diagnosis in plain words."""
        return plain_answer(self.study, self.diagnosis, cost_words(self.comparison))

    @cached_property
    def hidden(self) -> tuple[HiddenEffect, ...]:
        """Effects that are not claimed, each at the largest size that the recording allows."""
        return hidden_effects(self.study, self.diagnosis)


def diagnose(
    pump: PumpDescription | KnownPump,
    recording: Recording | Path | str,
    report: Report = silent,
    workers: int = 1,
    catalogue: tuple[Entry, ...] = CATALOGUE,
    films: FilmModel | None = None,
) -> DiagnosisResult:
    """Diagnose a recording of a pump; `workers` processes fit hypotheses side by side.

    films: floating ones of the simulation, whose `catalogue` of hypotheses is used.

    recording: a path, or a result of `checked_recording`. Raises InputFaults for a recording with faults, too few or
    too smooth readings; NotConverged where no fit converges.
    """
    known, thresholds = known_pump(pump), load_thresholds()
    candidates = catalogue if films is None else films.catalogue
    allowed, assumed = tolerances(known.pump)
    accepted = accepted_recording(recording, known)
    known, accepted = at_level(known, accepted, allowed)
    described = known.pump

    def prepared(usable: Recording) -> Study:
        study = prepare(described, usable, allowed, thresholds, candidates, known.scant, films)
        refuse_too_few(study)
        refuse_too_smooth(study, thresholds.data.least_chi2)
        return study

    study, found = diagnose_recording(described, accepted, prepared, thresholds, report, workers)
    found = by_table_rows(_with_next_point(study, described, found, thresholds), study.recording)
    return DiagnosisResult(
        pump=described,
        study=study,
        diagnosis=found,
        assumptions=tuple(str(one) for one in (*known.assumptions, *assumed)),
        extended_pump=claimed_pump(described, found, films) if found.effects else None,
        comparison=compare_pumps(described, study, found, report, films),
    )


def _with_next_point(study: Study, pump: PumpDescription, found: Diagnosis, thresholds: Thresholds) -> Diagnosis:
    """The diagnosis with the next point to record; without one, the reason is a note.

    Unknown physics has none: the rivals are effects that do not explain the mismatch.
    """
    if found.kind is Kind.UNKNOWN_PHYSICS and found.status is VerdictStatus.NAMED:
        return found
    try:
        return with_next_point(study, pump, found, thresholds)
    except (NotConverged, InputError) as reason:
        return replace(found, notes=(*found.notes, f"{NO_NEXT_POINT}: {reason}"))
