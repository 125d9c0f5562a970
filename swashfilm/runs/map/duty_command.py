"""The command `swashfilm duty`: what it takes, and what it prints."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from swashfilm.console.command import Command
from swashfilm.console.terminal import show, show_table


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
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.map.cycle_file import read_cycle
    from swashfilm.runs.map.duty import (
        EFFICIENCY_HEAD,
        ENERGY_HEAD,
        efficiency_rows,
        energy_rows,
        held_inputs,
        marked_rows,
        run_duty,
    )
    from swashfilm.runs.map.files import map_file, read_map

    data, error = read_map(map_file(options.map))
    cycle = read_cycle(options.cycle, data.axes)
    with run_folder(f"duty-{data.name}", options.output) as folder:
        shutil.copy(options.cycle, folder / "cycle.csv")
        summary = run_duty(data, error, cycle, folder)
    show_table(f"Duty of {data.name}, {summary['duration_s']:.6g} s", [ENERGY_HEAD, *energy_rows(summary)])
    show_table("Mean efficiency", [EFFICIENCY_HEAD, *efficiency_rows(summary)])
    if summary["marked"]:
        show_table("Time between points that carry a warning", marked_rows(summary))
    if held := held_inputs(data):
        show(f"held by the map: {held}")
    show(f"results in {final_folder(folder)}")
    return 0


COMMAND = Command(
    "duty", "what a pump takes and loses over a cycle, by a map of it", add_duty_options, run_duty_command
)
