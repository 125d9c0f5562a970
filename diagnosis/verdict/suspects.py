"""Suspects: single readings far from their neighbours, judged by the explanations that have been fitted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.checks.outliers import is_alone, scaled_places
from diagnosis.detect.contrasts import contrasts
from diagnosis.explain.ranked import Explanation
from diagnosis.recording.model import DataNote, NoteKind
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.row_numbers import table_rows
from reynolds.numerics.arrays import Array
from system.effects.effect import Kind
from system.estimation.posterior import settled


@dataclass(frozen=True)
class Suspect:
    """A reading that the checks keep as a suspect: point and channel of the study, both from 0."""

    point: int
    channel: int


def suspects(study: Study) -> tuple[Suspect, ...]:
    """The suspects among the readings of a study."""
    place = {row - 1: point for point, row in enumerate(table_rows(study.recording).tolist())}
    return tuple(
        Suspect(place[row], study.channels.index(note.channel))
        for note in study.recording.notes
        if note.kind is NoteKind.SUSPECT and note.channel in study.channels
        for row in note.points
        if row in place
    )


def unexplained(study: Study, explanations: Sequence[Explanation], thresholds: Thresholds) -> tuple[DataNote, ...]:
    """Notes that put aside the suspects that no likely explanation explains; points by rows of the table, from 0.

    A suspect stays where a likely explanation leaves less than `outlier` sigma of it, or less than `explained` of the
    square without an explanation, and where readings beside it in its channel deviate too (`checks.outliers`).
    """
    asked, limits = suspects(study), thresholds.data
    if not asked:
        return ()
    null = next(each for each in explanations if each.hypothesis.kind is Kind.NO_MISMATCH)
    before = deviations(study, null)
    left = [deviations(study, each) for each in _likely(explanations, thresholds)]
    rows, places = table_rows(study.recording), scaled_places(study.recording)

    def notes() -> Iterator[DataNote]:
        for one in asked:
            least = min(left, key=lambda each: abs(each[one.point, one.channel]))
            off = float(abs(least[one.point, one.channel]))
            slight = off <= limits.outlier or off**2 < limits.explained * before[one.point, one.channel] ** 2
            if not slight and is_alone(one.point, least[:, one.channel], places):
                text = f"off by {off:.0f} sigma under every likely explanation, its neighbours are not: read it again"
                yield DataNote(NoteKind.REMOVED, study.channels[one.channel], (int(rows[one.point]) - 1,), text)

    return tuple(notes())


def remaining(study: Study, explanation: Explanation, thresholds: Thresholds) -> Iterator[str]:
    """Suspects that an explanation leaves, as text."""
    asked = suspects(study)
    left = deviations(study, explanation) if asked else np.zeros((0, 0))
    for one in asked:
        off = float(left[one.point, one.channel])
        if abs(off) > thresholds.data.outlier:
            row = table_rows(study.recording)[one.point]
            yield f"{study.channels[one.channel].value} stays {off:+.0f} sigma off at point {row}"


def deviations(study: Study, explanation: Explanation) -> Array:
    """(N, C), each reading's deviation from an explanation in sigma, left out of the fit; 0 without a reading.

    The score of a shift of this reading alone, z: without the reading the objective falls by z^2 (mean-shift model;
    Cook and Weisberg 1982, section 2.2.2). About the prior mean where the explanation has no fit.
    """
    fit = study.base if explanation.posterior is None else settled(explanation.posterior)
    single = np.eye(len(study.axes))
    return np.stack([contrasts(fit, at).z(single) for at in range(len(study.channels))], axis=1)


def _likely(explanations: Sequence[Explanation], thresholds: Thresholds) -> list[Explanation]:
    """Refitted explanations that are possible, the best of all refits at least."""
    fitted = [each for each in explanations if each.posterior is not None]
    best = max(fitted, key=lambda each: each.log_weight)
    return [each for each in fitted if each is best or each.probability >= thresholds.name.possible]
