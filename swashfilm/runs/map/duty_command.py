"""The command `swashfilm duty`: what it takes, and what it prints."""

from __future__ import annotations

import argparse
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.terminal import show, show_result


def add_duty_options(command: argparse.ArgumentParser) -> None:
    """Give the command what it takes."""
    command.add_argument("map", type=Path, metavar="MAP", help="run folder of a map, or its map.nc")
    command.add_argument(
        "cycle",
        type=Path,
        metavar="CYCLE.csv",
        help="columns time, speed, pressure, displacement ratio; units in []",
    )


def run_duty_command(options: argparse.Namespace) -> int:
    """Run `swashfilm duty` and return its exit code; raises InputFaults with what is wrong in map and cycle."""
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.map.cycle_file import read_cycle
    from swashfilm.runs.map.duty import held_inputs, run_duty
    from swashfilm.runs.map.files import map_file, read_map
    from swashfilm.runs.map.result import DutyRun

    data, error = read_map(map_file(options.map))
    cycle = read_cycle(options.cycle, data.axes)
    with run_folder(f"duty-{data.name}", options.output) as folder:
        run_duty(data, error, cycle, options.cycle, folder)
        found = DutyRun.opened(folder)
    if held := held_inputs(data):
        show(f"held by the map: {held}")
    show_result(found, folder)
    return 0


COMMAND = Command(
    "duty", "what a pump takes and loses over a cycle, by a map of it", add_duty_options, run_duty_command
)
