"""Command `swashfilm duty`: its options, its faults, its output."""

import argparse
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.terminal import show, show_result


def add_duty_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("map", type=Path, metavar="MAP", help="run folder of a map, or its map.nc")
    command.add_argument(
        "cycle", type=Path, metavar="CYCLE.csv", help="columns time, speed, pressure, displacement ratio; units in []"
    )


def run_duty_command(options: argparse.Namespace) -> int:
    """Run `swashfilm duty` and return its exit code; raise InputFaults with every fault of map and cycle."""
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.duty.cycle_file import read_cycle
    from swashfilm.runs.duty.result import DutyRun
    from swashfilm.runs.duty.run import run_duty
    from swashfilm.runs.map.files import map_file, read_map

    data, error = read_map(map_file(options.map))
    cycle = read_cycle(options.cycle, data.axes)
    with run_folder(f"duty-{data.name}", options.output, workbook=options.excel) as folder:
        run_duty(data, error, cycle, options.cycle, folder)
        found = DutyRun.opened(folder)
    if held := found.summary["held"]:
        show(f"constant in the map: {held}")
    show_result(found, folder)
    return 0


COMMAND = Command("duty", "energies and losses of a pump over a cycle, by its map", add_duty_options, run_duty_command)
