"""The command `swashfilm transient`: displacement in time."""

from __future__ import annotations

import argparse
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.terminal import show, show_table


def add_transient_options(command: argparse.ArgumentParser) -> None:
    """Give the command what it takes."""
    command.add_argument("case", type=Path, metavar="CASE.toml", help="the transient case")


def run_transient_command(options: argparse.Namespace) -> int:
    """Run `swashfilm transient` and return its exit code; raises InputFaults with what is wrong in the file."""
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.transient.case import load_transient
    from swashfilm.runs.transient.page import transient_rows, turn_rows
    from swashfilm.runs.transient.run import run_stated_transient

    stated = load_transient(options.case)
    with run_folder(stated.name, options.output) as folder:
        summary = run_stated_transient(stated, folder)
    show_table(f"Transient {stated.name}", transient_rows(summary))
    show_table("Means over a turn", [("", "the first", "the last"), *turn_rows(summary)])
    for taken in summary["assumptions"]:
        show(f"taken: {taken}")
    for warning in summary["warnings"]:
        show(f"warning: {warning}")
    show(f"results in {final_folder(folder)}")
    return 0


COMMAND = Command(
    "transient",
    "displacement in time: plate, actuator and chambers of a pump",
    add_transient_options,
    run_transient_command,
)
