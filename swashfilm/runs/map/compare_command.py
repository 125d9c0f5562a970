"""Command `swashfilm compare`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.terminal import show_result
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path

if TYPE_CHECKING:
    from swashfilm.runs.map.compare import Known
    from system.description.pump import PumpDescription
    from system.maps.duty import Cycle
    from system.maps.plan import MapAxis


def add_compare_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    for name, words in (("one", "A"), ("other", "B")):
        command.add_argument(
            name, metavar=words, help="run folder of a map or its map.nc; or a pump, whose lumped map is computed"
        )
    command.add_argument("--cycle", type=Path, metavar="CYCLE.csv", help="duty cycle, to compare over it too")


def run_compare_command(options: argparse.Namespace) -> int:
    """Run `swashfilm compare` and return its exit code; raise InputFaults with every fault of both."""
    from swashfilm.console.assumed import show_assumed
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.map.result import CompareRun

    asked = compare_case(options)
    for name in asked.names:
        show_assumed(name)
    with run_folder(asked.name, options.output, workbook=options.excel) as folder:
        asked.run(folder)
        found = CompareRun.opened(folder)
    show_result(found, folder)
    return 0


@dataclass(frozen=True)
class CompareCase:
    """Two maps to compare, their names on the command line, and a duty cycle or None."""

    names: tuple[str, str]
    both: tuple[Known, Known]
    cycle: Cycle | None

    @property
    def name(self) -> str:
        """Name of the run."""
        return f"compare-{self.both[0][0].name}-{self.both[1][0].name}"

    def run(self, folder: Path) -> None:
        """Compare the maps and write the files of the run folder."""
        from swashfilm.runs.map.compare import run_compare
        from system.maps.compare import compare

        one, other = self.both
        run_compare(compare(one[0], other[0], (one[1], other[1])), self.names, self.both, self.cycle, folder)


def compare_case(options: argparse.Namespace) -> CompareCase:
    """Return the case of a command line; raise InputFaults with every fault of maps, pumps and cycle."""
    from swashfilm.runs.map.cycle_file import read_cycle
    from system.maps.compare import common_axes

    both = _both(options.one, options.other)
    cycle = None if options.cycle is None else read_cycle(options.cycle, common_axes(both[0][0], both[1][0]))
    return CompareCase((options.one, options.other), both, cycle)


def _both(one: str, other: str) -> tuple[Known, Known]:
    """Return both maps; that of a pump is computed over the axes of the other map, or of the paper's plan.

    Raises InputFaults with every fault of both.
    """
    from swashfilm.runs.map.files import map_file, read_map
    from system.maps.plan import paper_axes
    from system.pump_file.file import load_pump

    loaded: list[Known | PumpDescription] = []
    wrong: list[InputFaults] = []
    for name in (one, other):
        try:
            loaded.append(load_pump(name) if _is_pump(name) else read_map(map_file(Path(name))))
        except InputFaults as reason:
            wrong.append(reason)
    if len(wrong) == 1:
        raise wrong[0]
    if wrong:
        faults = [
            replace(fault, path=f"{letter}: {fault.path}")
            for letter, reason in zip("AB", wrong, strict=True)
            for fault in reason.faults
        ]
        raise InputFaults(f"{one} and {other}", faults)
    axes = next((known[0].axes for known in loaded if isinstance(known, tuple)), paper_axes())
    maps = [known if isinstance(known, tuple) else _lumped_map(known, axes) for known in loaded]
    return maps[0], maps[1]


def _is_pump(name: str) -> bool:
    from system.pump_file.file import builtin_pumps

    path = Path(name)
    if name in builtin_pumps() or path.suffix == ".toml":
        return True
    if not path.exists():
        near = nearest_choice(name, builtin_pumps()) or nearest_path(path)
        fault = Fault("map or pump", f"'{name}'", "the run folder of a map, its map.nc, or a pump", near)
        raise InputFaults("command line", [fault])
    return False


def _lumped_map(pump: PumpDescription, axes: tuple[MapAxis, ...]) -> Known:
    """Return the lumped map of a pump; raise InputFaults where a point cannot be solved."""
    from system.maps.data import map_data
    from system.maps.plan import map_plan
    from system.maps.point import LumpedSolver, MapWork
    from system.work.tasks import done_part

    plan = map_plan(pump, axes)
    if faults := plan.checked().faults:
        raise InputFaults(pump.name, faults)
    work = MapWork(pump, LumpedSolver())
    return map_data(plan, work, tuple(done_part(work, point) for point in plan.points)), None


COMMAND = Command(
    "compare", "two maps or pumps side by side, also over a cycle", add_compare_options, run_compare_command
)
