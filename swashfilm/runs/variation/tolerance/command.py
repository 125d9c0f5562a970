"""Command `swashfilm tolerance`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.inputs import whole
from swashfilm.console.terminal import show_result
from swashfilm.runs.variation.options import add_varied_options, known_measures, varied_executor
from system.inputs.faults import Fault

if TYPE_CHECKING:
    from swashfilm.runs.variation.tolerance.run import ToleranceCase

PUMPS, MOST_PUMPS = 2000, 1_000_000


def add_tolerance_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    add_varied_options(command)
    command.add_argument("--pumps", metavar="N", help=f"pumps of the series ({PUMPS})")
    command.add_argument("--seed", metavar="N", help="of the random numbers (1); the same seed draws the same pumps")
    command.add_argument(
        "--limit", action="append", default=[], metavar="'NAME >= VALUE'",
        help="count the pumps that miss it: 'efficiency >= 88 %%', 'case drain <= 1.5 L/min'; may be repeated",
    )  # fmt: skip


def run_tolerance_command(options: argparse.Namespace) -> int:
    """Run `swashfilm tolerance` and return its exit code; raise InputFaults with every fault."""
    from swashfilm.console.assumed import show_assumed
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.variation.sensitivity.command import show_cost
    from swashfilm.runs.variation.tolerance.result import ToleranceRun
    from swashfilm.runs.variation.tolerance.run import run_tolerance

    case = tolerance_case(options)
    show_assumed(options.pump)
    show_cost(case.varied, case.pumps)
    name = f"tolerance-{case.varied.pump.name}"
    with (
        run_folder(name, options.output, workbook=options.excel) as folder,
        varied_executor(options, case.varied.seconds(case.pumps)) as executor,
        progress(case.pumps, name) as report,
    ):
        run_tolerance(case, folder, executor, report)
        found = ToleranceRun.opened(folder)
    show_result(found, folder)
    return 1 if found.summary["internal_error"] else 0


def tolerance_case(options: argparse.Namespace) -> ToleranceCase:
    """Return the series of a command line; raise InputFaults with every fault."""
    from swashfilm.console.fidelity import Fidelity
    from swashfilm.runs.variation.case import varied_case
    from swashfilm.runs.variation.limits import limit_of
    from swashfilm.runs.variation.tolerance.drawn import chosen_drawing_of, drawing_faults
    from swashfilm.runs.variation.tolerance.run import ToleranceCase

    faults: list[Fault] = []
    fidelities = {one.value: one for one in Fidelity}
    measures = known_measures(fidelities.get(options.fidelity, Fidelity.LUMPED), together=True)
    limits = [limit_of(text, measures, faults) for text in options.limit]
    pumps = whole(faults, "--pumps", options.pumps, PUMPS, (100, MOST_PUMPS), "a number of pumps")
    seed = whole(faults, "--seed", options.seed, 1, (0, 2**31 - 1))
    varied = varied_case(
        options, faults, lambda pump, table: drawing_faults(pump, table, options.keys, pumps, seed), together=True
    )
    kept = tuple(one for one in limits if one is not None)
    return ToleranceCase(varied, chosen_drawing_of(varied.pump, options.keys), pumps, seed, kept, measures)


COMMAND = Command(
    "tolerance", "how a series of pumps scatters by its drawing's tolerances", add_tolerance_options,
    run_tolerance_command,
)  # fmt: skip
