"""Command `swashfilm optimise`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_floating_options
from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE
from swashfilm.console.settings import add_set_option, set_values_of
from swashfilm.console.terminal import show, show_result
from swashfilm.runs.map.command import WORTH_TELLING, process_faults
from swashfilm.runs.variation.options import varied_executor
from system.inputs.faults import InputFaults

if TYPE_CHECKING:
    from swashfilm.runs.variation.optimise.case import OptimiseCase
    from system.work.tasks import Executor

EXAMPLE = "optimise.generations=80"
NOTHING_FEASIBLE = 3


def add_optimise_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("case", type=Path, metavar="CASE.toml", help="dimensions, objectives and constraints")
    add_set_option(command, "the case", EXAMPLE)
    command.add_argument(
        "--choose", metavar="WHAT",
        help="the design that is written as chosen.toml: knee, an objective whose best it is, or a row of pareto.csv",
    )  # fmt: skip
    add_floating_options(command)
    command.add_argument("--workers", metavar="N", help="processes that solve designs side by side (all cores)")
    command.add_argument("--cluster", metavar="ADDRESS", help="Dask scheduler; its workers solve designs")
    command.add_argument("--resume", type=Path, metavar="DIR", help="run folder with solved designs of this run")


def run_optimise_command(options: argparse.Namespace) -> int:
    """Run `swashfilm optimise` and return its exit code: 3 where no design is feasible.

    Raises InputFaults with every fault, and NotConverged.
    """
    from swashfilm.console.assumed import show_assumed_in
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.variation.optimise.result import OptimiseRun
    from swashfilm.runs.variation.optimise.run import run_optimise

    case = optimise_case(options)
    show_assumed_in(options.case)
    _show_cost(case)
    with (
        run_folder(case.name, options.output, workbook=options.excel) as folder,
        design_executor(options, case) as executor,
        progress(case.search.trials(case.problem), case.name) as report,
    ):
        run_optimise(case, folder, executor, report)
        found = OptimiseRun.opened(folder)
    show_result(found, folder)
    if found.summary["internal_error"]:
        return 1
    return 0 if found.summary["chosen"]["feasible"] else NOTHING_FEASIBLE


def optimise_case(options: argparse.Namespace) -> OptimiseCase:
    """Return the optimisation of a command line; raise InputFaults with every fault of options or file."""
    from swashfilm.runs.variation.optimise.case import load_optimisation

    if faults := process_faults(options, options.cluster):
        raise InputFaults(COMMAND_LINE, faults)
    return load_optimisation(options.case, set_values_of(options, EXAMPLE), options)


def checked_words(path: Path, stated: Mapping[str, object]) -> str:
    """Return the requests of a file with other values of keys, a line each; raise InputFaults with every fault."""
    parser = argparse.ArgumentParser()
    add_optimise_options(parser)
    case = optimise_case(parser.parse_args([str(path), *(f"--set={key}={one}" for key, one in stated.items())]))
    own, search = case.problem, case.search
    lines = [f"{case.varied.fidelity.value}, {len(case.varied.work.sites.points)} operating points"]
    lines += [
        f"vary {' with '.join(one.paths)} {one.key.shown(one.low)} to {one.key.shown(one.high)}" for one in own.space
    ]
    lines += [f"{one.measure.words}: {one.aim.value}" for one in own.objectives]
    lines += [one.text for one in own.constraints]
    lines.append(f"search by {search.method.value}: {search.why}; about {search.trials(own)} designs")
    return "\n".join(lines)


@contextmanager
def design_executor(options: argparse.Namespace, case: OptimiseCase) -> Iterator[Executor]:
    """Yield the executor of designs: processes of this machine, or workers of a cluster."""
    if options.cluster is None:
        with varied_executor(options, case.varied.seconds(case.search.trials(case.problem))) as executor:
            yield executor
        return
    from system.work.cluster import cluster

    with cluster(options.cluster) as executor:
        yield executor


def _show_cost(case: OptimiseCase) -> None:
    """Print the estimated time of a long run."""
    trials = case.search.trials(case.problem)
    if (seconds := case.varied.seconds(trials)) > WORTH_TELLING:
        points = len(case.varied.work.sites.points)
        at = f"{points} point{'s' if points > 1 else ''}"
        long = f"{seconds / 3600.0:.1f} h" if seconds > 7200.0 else f"{seconds / 60.0:.0f} min"
        what = f"{trials} designs at {at}, {case.varied.fidelity.value}"
        show(f"{what}: about {long} of processor time; --resume continues")


COMMAND = Command(
    "optimise", "dimensions of a pump between bounds, by objectives under constraints: a Pareto set",
    add_optimise_options, run_optimise_command,
)  # fmt: skip
