"""Run of a series of pumps: drawn, solved, then summary, tables, data set and page."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from swashfilm.console.schemas import write_new
from swashfilm.output.run_folder import write_json
from swashfilm.runs.variation.case import VariedCase
from swashfilm.runs.variation.tolerance.files import (
    DATA,
    PUMPS_TABLE,
    SHARES_TABLE,
    write_data,
    write_pumps,
    write_shares,
)
from swashfilm.runs.variation.tolerance.page import write_tolerance_page
from swashfilm.runs.variation.tolerance.summary import tolerance_summary
from system.description.drawn import Drawing
from system.pump_file.file import resolved_toml
from system.variation.measures import Measure
from system.variation.scatter import Limit
from system.variation.tolerance import tolerance
from system.work.kept_results import POINTS, points_of_run
from system.work.progress import Report
from system.work.tasks import Executor


@dataclass(frozen=True)
class ToleranceCase:
    """A series to solve: the pump, its operating points, the scattering dimensions, the number of pumps, the limits."""

    varied: VariedCase
    drawing: Drawing
    pumps: int
    seed: int
    limits: tuple[Limit, ...]
    measures: tuple[Measure, ...]


def run_tolerance(case: ToleranceCase, folder: Path, executor: Executor, report: Report) -> dict[str, Any]:
    """Solve a series of pumps; write points/, summary.json, pumps.csv, shares.csv, results.nc and the page.

    Returns the summary. Raises InputError where the geometry or the solver leaves too few pumps.
    """
    varied = case.varied
    (folder / "input.toml").write_text(varied.given, encoding="utf-8")
    write_new(folder / "resolved.toml", "pump", resolved_toml(varied.pump))
    earlier = points_of_run(varied.resume) if varied.resume else None
    found = tolerance(
        varied.work, case.drawing, case.pumps, case.seed, case.measures, case.limits, folder / POINTS, executor,
        report, earlier,
    )  # fmt: skip
    summary = tolerance_summary(varied, case.drawing, case.seed, found)
    write_json(folder / "summary.json", summary)
    write_pumps(folder / PUMPS_TABLE, varied, found)
    write_shares(folder / SHARES_TABLE, found)
    write_data(folder / DATA, varied, found)
    write_tolerance_page(folder)
    return summary
