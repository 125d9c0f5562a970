"""Run of a plan: readings predicted, points chosen, then summary, tables and page."""

from __future__ import annotations

from pathlib import Path
from time import process_time
from typing import Any

from diagnosis.planning.plan import plan_campaign
from diagnosis.planning.responses import foresee
from diagnosis.planning.suspects import entries_of, meter_of, possible_suspects, suspect_name
from diagnosis.thresholds import load_thresholds
from swashfilm.output.run_folder import write_json
from swashfilm.runs.plan.case import PlanCase
from swashfilm.runs.plan.files import write_tables
from swashfilm.runs.plan.page import write_plan_page
from swashfilm.runs.plan.summary import plan_summary
from system.effects.catalogue.entries import CATALOGUE
from system.inputs.faults import Fault, InputFaults
from system.pump_file.file import resolved_toml
from system.work.progress import Report


def run_plan(case: PlanCase, folder: Path, report: Report) -> dict[str, Any]:
    """Plan a test; write summary.json, apart.csv, points.csv, sensors.csv, never.csv and the page.

    Returns the summary. Raises InputFaults where fewer than two of the suspects change any reading, NotConverged where
    a point cannot be simulated.
    """
    begun, thresholds = process_time(), load_thresholds()
    (folder / "input.toml").write_text(case.given, encoding="utf-8")
    (folder / "resolved.toml").write_text(resolved_toml(case.pump), encoding="utf-8")
    catalogue = CATALOGUE if case.names is None else entries_of(case.names)
    foreseen = foresee(case.pump, case.asked.points, case.meters, case.tolerances, thresholds, catalogue, report)
    known = {suspect_name(one): one for one in possible_suspects(foreseen, thresholds)}
    on_bench = [
        name for name, one in known.items() if (meter := meter_of(one)) is None or meter.value in case.asked.channels
    ]
    names = on_bench if case.names is None else [name for name in case.names if name in known]
    unseen = () if case.names is None else tuple(name for name in case.names if name not in known)
    if len(names) < 2:
        found = f"{', '.join(unseen)}: no meter shows it at any point"
        raise InputFaults("command line", [Fault("--suspects", found, "two at least that a bench can show")])
    plan = plan_campaign(foreseen, case.asked, [known[name] for name in names], thresholds, report)
    summary = plan_summary(case, plan, unseen, process_time() - begun)
    write_json(folder / "summary.json", summary)
    write_tables(folder, summary)
    write_plan_page(folder)
    return summary
