"""A transient of displacement, from case to run folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from swashfilm.output.run_folder import write_json
from swashfilm.runs.transient.case import StatedTransient
from swashfilm.runs.transient.data import transient_dataset, transient_summary, write_course
from system.multibody.transient.solver import run_transient


def run_stated_transient(stated: StatedTransient, folder: Path) -> dict[str, Any]:
    """Run a transient and fill its folder; return the summary. Raises what `run_transient` raises.

    Files: input.toml, resolved.toml, course.csv, results.nc, summary.json, report.html.
    """
    (folder / "input.toml").write_text(stated.text, encoding="utf-8")
    (folder / "resolved.toml").write_text(stated.resolved, encoding="utf-8")
    found = run_transient(stated.asked)
    data = transient_dataset(found, stated.name)
    data.to_netcdf(folder / "results.nc", engine="h5netcdf")
    write_course(folder, data)
    summary = transient_summary(found, stated.name, data)
    write_json(folder / "summary.json", summary)
    from swashfilm.runs.transient.page import write_transient_page

    write_transient_page(folder)
    return summary
