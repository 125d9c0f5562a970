"""Command `swashfilm export`: its options, its faults, its output."""

import argparse
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.terminal import show, show_table


def add_export_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("map", type=Path, metavar="MAP", help="run folder of a map, or its map.nc")
    command.add_argument("--to", required=True, metavar="FORMAT", help="modelica, matlab, amesim, fmu or csv")
    command.add_argument(
        "-o", "--output", type=Path, metavar="FILE",
        help="file with the ending .mo, .mat, .data, .fmu or .csv (default: the pump's name in the working folder); "
        "several files of a format differ in what follows its name",
    )  # fmt: skip


def run_export_command(options: argparse.Namespace) -> int:
    """Run `swashfilm export` and return its exit code; raise InputFaults with every fault of options and map."""
    from swashfilm.runs.export.write import export_of

    asked = export_of(options.map, options.to, options.output)
    written = asked.write()
    points = f"{asked.data.solved.size} points, {asked.data.words}"
    show_table(f"Map of {asked.data.name}, {points}: {asked.to.words}", [(str(path),) for path in written.paths])
    for warning in written.warnings:
        show(f"warning: {warning}")
    return 0


COMMAND = Command(
    "export", "a map as tables of Modelica, MATLAB, Amesim or CSV, or as FMU", add_export_options, run_export_command,
    in_folder=False,
)  # fmt: skip
