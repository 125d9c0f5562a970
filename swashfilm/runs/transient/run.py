"""A transient of displacement, from case to result."""

from pathlib import Path

from swashfilm.console.assumed import scaled_warning
from swashfilm.output.data.files import write_netcdf
from swashfilm.output.run_folder import write_json
from swashfilm.runs.transient.case import StatedTransient
from swashfilm.runs.transient.data import transient_dataset, transient_summary, write_course
from swashfilm.runs.transient.page import write_transient_page
from swashfilm.runs.transient.result import TransientRun
from system.multibody.transient.solver import run_transient


def solve_transient(stated: StatedTransient) -> TransientRun:
    """Solve a transient; raise as `run_transient`.

    Its run folder holds input.toml, resolved.toml, course.csv, results.nc, summary.json, report.html.
    """
    found = run_transient(stated.asked)
    data = transient_dataset(found, stated.name)
    summary = transient_summary(found, stated.name, data)
    summary["assumptions"] += map(str, stated.assumptions)
    summary["warnings"] += scaled_warning(stated.assumptions)

    def write(folder: Path) -> tuple[str, ...]:
        (folder / "input.toml").write_text(stated.text, encoding="utf-8")
        (folder / "resolved.toml").write_text(stated.resolved, encoding="utf-8")
        write_netcdf(data, folder / "results.nc", "transient")
        write_course(folder, data)
        write_json(folder / "summary.json", summary)
        write_transient_page(folder)
        return ()

    return TransientRun(summary, write, lambda: data)
