"""Command `swashfilm sensitivity`: its options and its output."""

import argparse
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.points import EXIT_INTERNAL
from swashfilm.console.terminal import show, show_result
from swashfilm.runs.map.command import WORTH_TELLING
from swashfilm.runs.variation.options import add_varied_options, varied_executor

if TYPE_CHECKING:
    from swashfilm.runs.variation.case import VariedCase


def run_sensitivity_command(options: argparse.Namespace) -> int:
    """Run `swashfilm sensitivity` and return its exit code, 1 after an internal error at a pump.

    Raises InputFaults with every fault, and NotConverged.
    """
    from swashfilm.console.assumed import show_assumed
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.variation.case import varied_case
    from swashfilm.runs.variation.sensitivity.result import SensitivityRun
    from swashfilm.runs.variation.sensitivity.run import run_sensitivity
    from system.variation.sensitivity import variants_needed

    case = varied_case(options)
    show_assumed(options.pump)
    pumps = variants_needed(len(case.keys))
    show_cost(case, pumps)
    name = f"sensitivity-{case.pump.name}"
    with (
        run_folder(name, options.output, workbook=options.excel) as folder,
        varied_executor(options, case.seconds(pumps)) as executor,
        progress(pumps, name) as report,
    ):
        run_sensitivity(case, folder, executor, report)
        found = SensitivityRun.opened(folder)
    show_result(found, folder)
    return EXIT_INTERNAL if found.summary["internal_error"] else 0


def show_cost(case: "VariedCase", pumps: int) -> None:
    """Print the estimated time of a long run."""
    if (seconds := case.seconds(pumps)) > WORTH_TELLING:
        points = len(case.work.sites.points)
        show(
            f"{pumps} pumps at {points} point{'s' if points > 1 else ''}, {case.fidelity.value}: about "
            f"{seconds / 60.0:.0f} min of processor time; --resume continues"
        )


COMMAND = Command(
    "sensitivity", "what a change of each dimension of a pump costs", add_varied_options, run_sensitivity_command
)
