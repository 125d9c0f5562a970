"""The command `swashfilm compare`: what it takes, and what it prints."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.terminal import show, show_table
from system.faults import Fault, InputFaults, nearest_choice, nearest_path

if TYPE_CHECKING:
    from system.map_data import MapData
    from system.map_interpolation import MapError
    from system.map_plan import MapAxis

COMPARE_OPTIONS = ["--cycle"]


def add_compare_options(command: argparse.ArgumentParser) -> None:
    """Give the command what it takes."""
    for name, words in (("one", "A"), ("other", "B")):
        command.add_argument(
            name, metavar=words, help="run folder of a map or its map.nc; or a pump, whose lumped map is made"
        )
    command.add_argument("--cycle", type=Path, metavar="CYCLE.csv", help="compare over this duty cycle too")


def run_compare_command(options: argparse.Namespace) -> int:
    """Run `swashfilm compare` and return its exit code; raises InputFaults with what is wrong in either."""
    from swashfilm.compare_run import DIFFERENCE_HEAD, DUTY_HEAD, difference_rows, duty_rows, run_compare
    from swashfilm.cycle_file import read_cycle
    from swashfilm.run_folder import final_folder, run_folder
    from system.map_compare import common_axes, compare

    one, other = _both(options.one, options.other)
    cycle = None
    if options.cycle is not None:
        cycle = read_cycle(options.cycle, common_axes(one[0], other[0]))
    found = compare(one[0], other[0], (one[1], other[1]))
    with run_folder(f"compare-{one[0].name}-{other[0].name}", options.output) as folder:
        summary = run_compare(found, (options.one, options.other), (one, other), cycle, folder)
    show_table(f"{options.one} and {options.other}", [DIFFERENCE_HEAD, *difference_rows(summary)])
    if summary["duty"]:
        show_table("Over the cycle", [DUTY_HEAD, *duty_rows(summary)])
    show(f"results in {final_folder(folder)}")
    return 0


def _both(one: str, other: str) -> tuple[tuple[MapData, MapError | None], tuple[MapData, MapError | None]]:
    """Both maps; a pump's is made over the axes of the other, or of the paper's plan."""
    from system.map_plan import paper_axes

    named = {name: _map_of(name) for name in (one, other) if not _is_pump(name)}
    axes = next(iter(named.values()))[0].axes if named else paper_axes()
    made = {name: named.get(name) or _lumped_map(name, axes) for name in (one, other)}
    return made[one], made[other]


def _is_pump(name: str) -> bool:
    from system.pump_file import builtin_pumps

    path = Path(name)
    if name in builtin_pumps() or path.suffix == ".toml":
        return True
    if not path.exists():
        near = nearest_choice(name, builtin_pumps()) or nearest_path(path)
        fault = Fault("A, B", f"'{name}'", "the run folder of a map, its map.nc, or a pump", near)
        raise InputFaults("command line", [fault])
    return False


def _map_of(name: str) -> tuple[MapData, MapError | None]:
    from swashfilm.map_files import map_file, read_map

    return read_map(map_file(Path(name)))


def _lumped_map(name: str, axes: tuple[MapAxis, ...]) -> tuple[MapData, None]:
    """A pump's map, solved here; raises InputFaults where a point cannot be."""
    from system.map_data import map_data
    from system.map_plan import map_plan
    from system.map_point import LumpedSolver, MapWork
    from system.pump_file import load_pump
    from system.work import done_part

    pump = load_pump(name)
    plan = map_plan(pump, axes)
    if faults := plan.checked().faults:
        raise InputFaults(name, faults)
    work = MapWork(pump, LumpedSolver())
    return map_data(plan, work, tuple(done_part(work, point) for point in plan.points)), None
