"""Run of a sensitivity: derivatives, then summary, table, data set and page."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.console.fidelity import Fidelity
from swashfilm.console.schemas import write_new
from swashfilm.formats.versions import headed
from swashfilm.output.run_folder import write_json
from swashfilm.runs.variation.case import VariedCase
from swashfilm.runs.variation.options import known_measures
from swashfilm.runs.variation.sensitivity.files import DATA, TABLE, write_data, write_table
from swashfilm.runs.variation.sensitivity.page import write_sensitivity_page
from swashfilm.runs.variation.words import change_text, percent_of, size_text, where
from system.pump_file.file import resolved_toml
from system.variation.differences import Verdict
from system.variation.sensitivity import Accuracy, KeySlopes, Sensitivity, one_sided, sensitivity
from system.work.kept_results import POINTS, points_of_run
from system.work.progress import Report
from system.work.tasks import Executor

ACCURACY = {
    Fidelity.LUMPED: Accuracy(step=0.01, noise=1e-6, rounds=2),
    Fidelity.TABLE: Accuracy(step=0.01, noise=1e-5, rounds=2),
    Fidelity.FIXED: Accuracy(step=0.02, noise=1e-5, rounds=1),
    Fidelity.FLOATING: Accuracy(step=0.05, noise=1e-4, rounds=1),
}
"""Steps of each fidelity: the wider, the larger the noise of its solvers."""


def run_sensitivity(case: VariedCase, folder: Path, executor: Executor, report: Report) -> dict[str, Any]:
    """Differentiate a pump; write points/, summary.json, sensitivity.csv, results.nc and the page; return the summary.

    Raises NotConverged where the pump as stated has no result.
    """
    (folder / "input.toml").write_text(case.given, encoding="utf-8")
    write_new(folder / "resolved.toml", "pump", resolved_toml(case.pump))
    found = sensitivity(
        case.work,
        case.keys,
        known_measures(case.fidelity),
        ACCURACY[case.fidelity],
        folder / POINTS,
        executor,
        report,
        points_of_run(case.resume) if case.resume else None,
    )
    summary = sensitivity_summary(case, found)
    write_json(folder / "summary.json", summary)
    write_table(folder / TABLE, found)
    write_data(folder / DATA, case, found)
    write_sensitivity_page(folder)
    return summary


def sensitivity_summary(case: VariedCase, found: Sensitivity) -> dict[str, Any]:
    """Return the summary: SI, a derivative by SI unit of its dimension; None where it has no number."""
    return {
        **headed("sensitivity"),
        "name": case.pump.name,
        **where(case),
        "measures": {
            one.name: {"words": one.words, "unit": one.unit, "value": float(value)}
            for one, value in zip(found.measures, found.middle, strict=True)
        },
        "dimensions": [_row(one, found) for one in found.slopes],
        "one_sided": [one.key.path for one in one_sided(found)],
        "refused": [{"key": one.key.path, "value": one.key.text, "reason": one.reason} for one in found.refused],
        "held_by_fidelity": list(case.fixed),
        "accuracy": vars(ACCURACY[case.fidelity]),
        "warnings": [
            *case.input_warnings,
            *(f"{name}: it comes up at the pump as stated; see swashfilm run" for name in found.warnings),
        ],
        "internal_error": found.internal,
        "cost": {"pumps": found.solved, "processor_s": found.seconds},
    }


def _row(one: KeySlopes, found: Sensitivity) -> dict[str, Any]:
    key, smooth = one.key, one.verdict == Verdict.SMOOTH
    numbers = zip(found.measures, one.value, one.error, one.verdict, strict=True)
    derivatives = {
        measure.name: {
            "derivative": float(value) if known is Verdict.SMOOTH else 0.0 if known is Verdict.NO_EFFECT else None,
            "error": None if known is Verdict.NOT_SMOOTH else float(error),
            "verdict": known.value,
        }
        for measure, value, error, known in numbers
    }
    return {
        "key": key.path,
        "value": key.value,
        "unit": key.dimension.si_unit if key.dimension else "1",
        "text": key.text,
        "change": one.unit,
        "change_text": change_text(key),
        "percent": percent_of(key),
        "sigma": one.sigma,
        "sigma_text": None if one.sigma is None else size_text(key, one.sigma),
        "side": one.stencil.side.value,
        "step": one.stencil.step,
        "has_effect": bool(np.any(smooth) or np.any(one.verdict == Verdict.NOT_SMOOTH)),
        "measures": derivatives,
    }
