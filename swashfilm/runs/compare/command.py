"""Command `swashfilm compare`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.inputs import COMMAND_LINE, whole
from swashfilm.console.settings import add_set_option
from swashfilm.console.terminal import show_result
from swashfilm.runs.map.command import FIDELITIES, MOST_WORKERS, add_map_options, map_case
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.compare.run import Side, SideToSolve
    from system.maps.duty import Cycle
    from system.maps.plan import MapAxis

LETTERS = ("A", "B")


def add_compare_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    for name, words in zip(("one", "other"), LETTERS, strict=True):
        command.add_argument(
            name, metavar=words, help="run folder of a map or its map.nc; or a pump, whose map is solved"
        )
    command.add_argument("--cycle", type=Path, metavar="CYCLE.csv", help="duty cycle, to compare over it too")
    command.add_argument(
        "--fidelity", metavar=f"{{{','.join(one.value for one in FIDELITIES)}}}",
        help="fidelity of the map of a pump, as of swashfilm map (lumped)",
    )  # fmt: skip
    add_set_option(command, "B, a pump")
    command.add_argument("--workers", metavar="N", help="processes that solve points side by side (all cores)")


def run_compare_command(options: argparse.Namespace) -> int:
    """Run `swashfilm compare` and return its exit code; raise InputFaults with every fault of both."""
    from swashfilm.console.assumed import show_assumed
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.compare.result import CompareRun

    asked = compare_case(options)
    for name in (options.one, options.other):
        show_assumed(name)
    with (
        run_folder(asked.name, options.output, workbook=options.excel) as folder,
        progress(asked.points, asked.name) as report,
    ):
        asked.run(folder, report)
        found = CompareRun.opened(folder)
    show_result(found, folder)
    return 0


@dataclass(frozen=True)
class CompareCase:
    """Two maps to compare, each read or to solve, the processes to solve with, and a duty cycle or None."""

    both: tuple[Side | SideToSolve, Side | SideToSolve]
    workers: int
    cycle: Cycle | None

    @property
    def name(self) -> str:
        """Name of the run."""
        return f"compare-{'-'.join(side.name for side in self.both)}"

    @property
    def points(self) -> int:
        """Number of points to solve."""
        return sum(side.points for side in self.both)

    def run(self, folder: Path, report: Report = silent) -> None:
        """Solve the maps of pumps in the folders A and B, compare, and write the files of the run folder."""
        from swashfilm.runs.compare.run import run_compare

        one, other = (
            side.solved(folder / letter, self.workers, report) for side, letter in zip(self.both, LETTERS, strict=True)
        )
        run_compare((one, other), self.cycle, folder)


def compare_case(options: argparse.Namespace) -> CompareCase:
    """Return the case of a command line; raise InputFaults with every fault of maps, pumps, options and cycle."""
    from swashfilm.runs.map.duty.cycle_file import read_cycle
    from system.maps.compare import common_axes
    from system.work.processes import cores

    names = (options.one, options.other)
    pumps = [_is_pump(name) for name in names]
    faults = [*_option_faults(options, pumps)]
    workers = whole(faults, "--workers", options.workers, cores(), (1, MOST_WORKERS))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    both = _both(options, names, pumps)
    cycle = None if options.cycle is None else read_cycle(options.cycle, common_axes(both[0].axes, both[1].axes))
    return CompareCase(both, workers, cycle)


def _option_faults(options: argparse.Namespace, pumps: Sequence[bool]) -> Iterator[Fault]:
    """Yield the faults of options."""
    words = [one.value for one in FIDELITIES]
    if options.fidelity is not None and options.fidelity not in words:
        near = nearest_choice(options.fidelity, words)
        yield Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(words)}", near)
    if options.fidelity is not None and not any(pumps):
        yield Fault("--fidelity", "beside two maps", "a pump as A or B, whose map is solved")
    if options.set and not pumps[1]:
        yield Fault("--set", f"beside the map {options.other}", "a pump as B, whose keys it sets")


def _both(
    options: argparse.Namespace, names: tuple[str, str], pumps: Sequence[bool]
) -> tuple[Side | SideToSolve, Side | SideToSolve]:
    """Return both maps; that of a pump has the axes of the other map, or the usual levels of A.

    Raises InputFaults with every fault of both.
    """
    found: dict[int, Side | SideToSolve] = {}
    wrong: dict[int, InputFaults] = {}
    for k in sorted(range(len(names)), key=lambda k: pumps[k]):
        axes = next((side.axes for side in found.values()), None)
        try:
            found[k] = _to_solve(names[k], axes, options, k) if pumps[k] else _read(names[k])
        except InputFaults as reason:
            wrong[k] = reason
    if wrong:
        faults = [
            replace(fault, path=f"{LETTERS[k]}: {fault.path}") for k in sorted(wrong) for fault in wrong[k].faults
        ]
        raise InputFaults(" and ".join(names), faults)
    return found[0], found[1]


def _read(name: str) -> Side:
    """Return the map of a path; raise InputFaults without one."""
    from swashfilm.runs.compare.run import Side
    from swashfilm.runs.map.files import map_file, read_map
    from system.pump_file.file import builtin_pumps

    if not Path(name).exists():
        near = nearest_choice(name, builtin_pumps()) or nearest_path(Path(name))
        fault = Fault("map or pump", f"'{name}'", "the run folder of a map, its map.nc, or a pump", near)
        raise InputFaults(COMMAND_LINE, [fault])
    return Side(name, *read_map(map_file(Path(name))))


def _to_solve(name: str, axes: Sequence[MapAxis] | None, options: argparse.Namespace, side: int) -> SideToSolve:
    """Return the map of a pump to solve, with the options of `swashfilm map`; B with the values of --set."""
    from swashfilm.runs.compare.run import SideToSolve

    parser = argparse.ArgumentParser()
    add_map_options(parser)
    stated = options.set if side == 1 else []
    words = [name, "--fidelity", options.fidelity or Fidelity.LUMPED.value, *(f"--set={one}" for one in stated)]
    given = f"{name} with {', '.join(stated)}" if stated else name
    return SideToSolve(given, map_case(parser.parse_args(words), axes))


def _is_pump(name: str) -> bool:
    from system.pump_file.file import builtin_pumps

    return name in builtin_pumps() or Path(name).suffix == ".toml"


COMMAND = Command(
    "compare", "two maps or pumps side by side, also over a cycle", add_compare_options, run_compare_command
)
