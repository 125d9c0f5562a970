"""Command `swashfilm reference`: its options, its output."""

import argparse
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.settings import add_set_option, set_values_of
from swashfilm.console.terminal import show, show_result

EXAMPLE = "reference.cells=24"


def add_reference_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("case", type=Path, metavar="CASE.toml", help="a step, groove, orifice or slot")
    add_set_option(command, "the case", EXAMPLE)


def run_reference_command(options: argparse.Namespace) -> int:
    """Run `swashfilm reference` and return its exit code; raise InputFaults with every fault of the file."""
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.reference.case import load_reference
    from swashfilm.runs.reference.result import ReferenceRun
    from swashfilm.runs.reference.run import run_reference

    case = load_reference(options.case, set_values_of(options, EXAMPLE))
    with (
        run_folder(f"reference-{case.name}", options.output, workbook=options.excel) as folder,
        progress(len(case.passages), f"reference {case.name}") as report,
    ):
        run_reference(case, folder, report)
        found = ReferenceRun.opened(folder)
    show_result(found, folder)
    show(f"coefficients in {final_folder(folder) / found.summary['table']}")
    return 0


COMMAND = Command(
    "reference",
    "flow through steps, grooves and orifices beyond the film equation",
    add_reference_options,
    run_reference_command,
)
