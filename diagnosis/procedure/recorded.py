"""Diagnosis of a recording, and again without suspects that no likely explanation explains."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from diagnosis.checks.check import with_notes
from diagnosis.procedure.stages import diagnose_study
from diagnosis.recording.model import Recording
from diagnosis.study.inputs import bench_points
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from diagnosis.verdict.suspects import unexplained
from reynolds.laws.oil import walther
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.work.progress import Report, silent

Prepared = Callable[[Recording], Study]


def diagnose_recording(
    pump: PumpDescription,
    recording: Recording,
    prepared: Prepared,
    thresholds: Thresholds,
    report: Report = silent,
    workers: int = 1,
) -> tuple[Study, Diagnosis]:
    """The study of a checked recording and its diagnosis without the next point.

    Suspects are used at first: they may be physics. Those that no likely explanation explains are put aside, with
    notes, and the rest is diagnosed again. Raises as `prepared` and `diagnose_study`.
    """
    study = prepared(recording)
    found = diagnose_study(study, _viscosity(study, pump), thresholds, report, workers)
    aside = unexplained(study, found.hypotheses, thresholds)
    if not aside:
        return study, found
    study = prepared(with_notes(recording, aside))
    return study, diagnose_study(study, _viscosity(study, pump), thresholds, report, workers)


def _viscosity(study: Study, pump: PumpDescription) -> Array:
    """(N,) in Pa s, of the oil at the case's temperature."""
    points, _ = bench_points(study.recording, pump)
    return np.asarray(walther(points.T_case, pump.oil.fluid) * pump.oil.density)
