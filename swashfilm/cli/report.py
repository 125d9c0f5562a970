"""Command `swashfilm report`: the page of a run folder, written again."""

import argparse
import traceback
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE
from swashfilm.console.pressures import add_units_option
from swashfilm.console.terminal import show
from system.inputs.faults import Fault, InputFaults, nearest_path

PAGES = {
    "calibration": "swashfilm.runs.calibrate.page.write_calibrate_page",
    "diagnosis": "swashfilm.runs.diagnose.page.write_diagnose_page",
    "film": "swashfilm.runs.film.page.write_film_page",
    "film_revolution": "swashfilm.runs.film.revolution.page.write_revolution_page",
    "film_study": "swashfilm.runs.film.series.page.write_study_page",
    "pump_study": "swashfilm.runs.film.series.page.write_study_page",
    "plan": "swashfilm.runs.plan.page.write_plan_page",
    "pump": "swashfilm.runs.pump.page.write_pump_page",
    "comparison": "swashfilm.runs.compare.page.write_compare_page",
    "duty": "swashfilm.runs.map.duty.page.write_duty_page",
    "map": "swashfilm.runs.map.page.write_map_page",
    "gap_table": "swashfilm.runs.table.page.write_table_page",
    "optimisation": "swashfilm.runs.variation.optimise.page.write_optimise_page",
    "reference": "swashfilm.runs.reference.page.write_reference_page",
    "reproduction": "swashfilm.runs.reproduce.page.write_reproduce_page",
    "response_table": "swashfilm.runs.table.page.write_table_page",
    "sensitivity": "swashfilm.runs.variation.sensitivity.page.write_sensitivity_page",
    "tolerance": "swashfilm.runs.variation.tolerance.page.write_tolerance_page",
    "transient": "swashfilm.runs.transient.page.write_transient_page",
}
"""Page writer of a run, by the `kind` in its summary.json."""
EXPECTED = "files as a run of this version wrote them, in a folder that can be written to"


def run_report(options: argparse.Namespace) -> int:
    """Run `swashfilm report` and return its exit code; raise InputFaults for a folder without a finished run."""
    folder = options.folder
    try:
        page = _page_of(folder)(folder)
    except InputFaults:
        raise
    except (ArithmeticError, AttributeError, LookupError, OSError, TypeError, ValueError) as reason:
        raise InputFaults(str(folder), _faults(folder, reason)) from reason
    show(f"report in {page}")
    return 0


def _faults(folder: Path, reason: Exception) -> list[Fault]:
    """Return the differences of the summary from its schema; without any, the fault that the page found."""
    from swashfilm.formats.check import summary_faults
    from swashfilm.output.page import read_summary

    return summary_faults(folder / "summary.json", read_summary(folder)) or [Fault("DIR", _told(reason), EXPECTED)]


def _told(reason: Exception) -> str:
    """Return the fault of a file that a page found, and the part of the page with it."""
    places = [frame for frame in traceback.extract_tb(reason.__traceback__) if "swashfilm" in frame.filename]
    place = f", in {Path(places[-1].filename).name} line {places[-1].lineno}" if places else ""
    return f"{type(reason).__name__}: {reason}{place}"


def _page_of(folder: Path) -> Callable[[Path], Path]:
    """Return the function that writes the page of a run folder."""
    from swashfilm.output.page import read_summary

    if not (folder / "summary.json").exists():
        fault = Fault("DIR", f"no {folder / 'summary.json'}", "the folder of a finished run", nearest_path(folder))
        raise InputFaults(COMMAND_LINE, [fault])
    kind = read_summary(folder)["kind"]
    if kind not in PAGES:
        expected = f"one of {', '.join(PAGES)}"
        raise InputFaults(str(folder), [Fault("summary.json", f"kind {kind!r}", expected)])
    module, _, name = PAGES[kind].rpartition(".")
    return getattr(import_module(module), name)


def _add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("folder", type=Path, metavar="DIR", help="the run folder")
    add_units_option(command)


COMMAND = Command("report", "write the report of a run folder again", _add_options, run_report, in_folder=False)
