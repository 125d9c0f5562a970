"""Command `swashfilm transient`: displacement in time."""

import argparse
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.settings import add_set_option, set_values_of
from swashfilm.console.terminal import show_result

EXAMPLE = 'pump.actuator.spring_rate="20 N/mm"'


def add_transient_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("case", type=Path, metavar="CASE.toml", help="the transient case")
    add_set_option(command, "the case", EXAMPLE)


def run_transient_command(options: argparse.Namespace) -> int:
    """Run `swashfilm transient` and return its exit code; raise InputFaults with every fault of the file."""
    from swashfilm.console.assumed import show_assumed_in
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.transient.case import load_transient
    from swashfilm.runs.transient.run import solve_transient

    stated = load_transient(options.case, set_values_of(options, EXAMPLE))
    show_assumed_in(options.case)
    with run_folder(stated.name, options.output, workbook=options.excel) as folder:
        found = solve_transient(stated)
        found.write(folder)
    show_result(found, folder)
    return 0


COMMAND = Command(
    "transient",
    "displacement in time: plate, actuator and chambers of a pump",
    add_transient_options,
    run_transient_command,
)
