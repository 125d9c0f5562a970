"""Command `swashfilm table`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_floating_options, switched_keys
from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, option_value, whole
from swashfilm.console.settings import add_set_option, set_values
from swashfilm.console.terminal import show_result
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import QuantityError, parse_share

if TYPE_CHECKING:
    from swashfilm.runs.table.gap_case import GapTableCase
    from system.description.pump import PumpDescription
    from system.points.table.build import Range, TableCase
    from system.work.progress import Report

_SOURCE = "fixed"
MOST = 10000  # points, or processes
RANGES = {
    "--speed": ("operating.speed", "500rpm..2500rpm", "shaft speeds (0.2 .. 1.2 of the rated one)"),
    "--pressure": (
        "operating.pressure", "5MPa..40MPa",
        "delivery pressures, gauge (0.05 above inlet and case .. 1.15 of the rated one)",
    ),
    "--displacement": ("operating.displacement_ratio", "0.1..1.0", "fractions of the full displacement (0.1 .. 1)"),
    "--temperature": (
        "operating.temperature", "20degC..100degC", "temperatures, for the oil's viscosity (20 .. 100 degC)",
    ),
}  # fmt: skip
"""Key of the pump file, example and meaning of each input of a table; a single value keeps it constant."""
HELD = {
    "--inlet-pressure": ("operating.inlet_pressure", "25bar", "pressure at the inlet, gauge"),
    "--case-pressure": ("operating.case_pressure", "1.5bar", "pressure in the case, gauge"),
}


def add_table_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument(
        "pump", metavar="PUMP", help="built-in name (ref90) or pump file; or a gap's case with a table [table]"
    )
    for option, (_, example, what) in RANGES.items():
        command.add_argument(option, metavar=example, help=f"{what}; one value: constant")
    for option, (_, example, what) in HELD.items():
        command.add_argument(option, metavar=example, help=f"{what}; default: that of the pump file")
    command.add_argument(
        "--vary", action="append", default=[], metavar="KEY=A..B",
        help="range of a dimension that the films depend on, such as piston.radial_clearance=12um..16um; KEY alone: "
        "the range of its tolerance; may be repeated",
    )  # fmt: skip
    add_set_option(command, "the pump file or the case")
    command.add_argument(
        "--source", metavar="{fixed,floating}", default=_SOURCE, help="fidelity of the solved points (fixed)"
    )
    add_floating_options(command)
    command.add_argument(
        "--points", metavar="N", help="points to fit, with the corners of the box (120 for four inputs)"
    )
    command.add_argument("--held-out", metavar="N", help="points that determine the error (a quarter of these)")
    command.add_argument("--workers", metavar="N", help="processes that solve points side by side (1)")


def run_table_command(options: argparse.Namespace) -> int:
    """Run `swashfilm table` and return its exit code; raise InputFaults with every fault of options and file."""
    asked = table_case(options)
    from swashfilm.console.assumed import show_assumed
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import Interrupted, run_folder
    from swashfilm.runs.table.result import TableRun

    if not is_film_case(options.pump):
        show_assumed(options.pump)
    with (
        run_folder(f"table-{asked.name}", options.output, workbook=options.excel) as folder,
        progress(asked.points, f"table {asked.name}") as report,
    ):
        try:
            asked.run(folder, report)
        except KeyboardInterrupt:
            raise Interrupted(None, "solved points are kept; the same command continues from them") from None
        found = TableRun.opened(folder)
    show_result(found, folder)
    return 0


@dataclass(frozen=True)
class NamedTable:
    """A table to build: its name, its number of points, and the function that fills a run folder."""

    name: str
    points: int
    run: Callable[[Path, Report], object]


def table_case(options: argparse.Namespace) -> NamedTable:
    """Return the table of a command line, of a pump or of a gap's case; raise InputFaults with every fault."""
    from swashfilm.runs.table.run import run_table

    if is_film_case(options.pump):
        from swashfilm.runs.table.gap_run import run_gap_table

        gap, workers = _gap_case(options)
        return NamedTable(gap.name, gap.learnt + gap.held_out, partial(run_gap_table, gap, workers=workers))
    case, workers = _case(options)
    points = case.learnt + case.held_out
    return NamedTable(case.pump.name, points, partial(run_table, case, workers=workers))


def is_film_case(path: str) -> bool:
    """Return whether the path is a film case, not a pump file."""
    from system.inputs.toml_table import read_toml

    return Path(path).is_file() and bool({"film", "gap"} & set(read_toml(Path(path))[1]))


def _gap_case(options: argparse.Namespace) -> tuple[GapTableCase, int]:
    """Return the gap's table of a command line, and the number of workers; raise InputFaults with every fault."""
    from swashfilm.runs.table.gap_case import load_gap_table

    given = {option: option_value(options, option) for option in [*RANGES, *HELD, "--steps", "--finer"]}
    given["--source"] = None if options.source == _SOURCE else options.source
    given["--vary"] = options.vary[0] if options.vary else None
    stated = "a key of [table] or of the case"
    faults = [Fault(name, "an option beside a gap's case", stated) for name, text in given.items() if text]
    case = load_gap_table(Path(options.pump), switched_keys(options), set_values(options.set, faults))
    learnt, held_out, workers = _counts(options, faults, len(case.axes))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return replace(case, learnt=learnt, held_out=held_out), workers


def _case(options: argparse.Namespace) -> tuple[TableCase, int]:
    """Return the case of a command line, and the number of workers; raise InputFaults with every fault."""
    from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options
    from swashfilm.runs.table.dimensions import varied_axes
    from system.points.table import sources as table_sources
    from system.points.table.build import TableCase, table_axes
    from system.points.table.response_table import INPUTS
    from system.points.table.sources import Source

    faults: list[Fault] = []
    single = {option for option in RANGES if _is_single(option_value(options, option))}
    counts = _counts(options, faults, max(1, len(RANGES) - len(single) + len(options.vary)))
    ranges = _ranges(options, faults, single)
    sources = [source.value for source in Source]
    if options.source not in sources:
        nearest = nearest_choice(options.source, sources)
        faults.append(Fault("--source", repr(options.source), f"one of {', '.join(sources)}", nearest))
    if len(single) == len(RANGES) and not options.vary:
        faults.append(Fault(", ".join(RANGES), "single values only", "at least one range"))
    pump = _pump(options, faults, single)
    faults = [*floating_faults(options, pump, options.source, "--source"), *alike_faults(pump)]
    dimensions = varied_axes(options.vary, pump, faults)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    solver = table_sources.solver_of(Source(options.source), floating_options(options, pump))
    held = [name for name, option in zip(INPUTS, RANGES, strict=True) if option in single]
    speeds, pressures, ratios, temperatures = ranges
    axes = (*table_axes(pump, speeds, pressures, ratios, temperatures, held), *dimensions)
    return TableCase(pump, solver, axes, *counts[:2]), counts[2]


def _is_single(text: str | None) -> bool:
    """Return whether an option states one value."""
    from swashfilm.console.levels import dashed_range

    return text is not None and ".." not in text and not dashed_range(text)


def _counts(options: argparse.Namespace, faults: list[Fault], inputs: int) -> tuple[int, int, int]:
    """Return the numbers of fitted and held-out points and of workers."""
    from system.work.sampled_points import FEWEST_HELD_OUT, usual_counts

    learnt, held_out = usual_counts(inputs)
    return (
        whole(faults, "--points", options.points, learnt, (2 ** (inputs + 1), MOST)),
        whole(faults, "--held-out", options.held_out, held_out, (FEWEST_HELD_OUT, MOST)),
        whole(faults, "--workers", options.workers, 1, (1, MOST)),
    )


def _pump(options: argparse.Namespace, faults: list[Fault], single: Collection[str]) -> PumpDescription:
    """Return the pump with the constant inputs of a table; raise InputFaults where it or `faults` has any."""
    from system.pump_file.file import load_pump

    keys = HELD | {option: RANGES[option] for option in single}
    stated = set_values(options.set, faults)
    stated |= {path: text for option, (path, *_) in keys.items() if (text := option_value(options, option)) is not None}
    if "--displacement" in single:
        try:
            stated["operating.displacement_ratio"] = parse_share(options.displacement)
        except QuantityError as reason:
            faults.append(Fault("--displacement", reason.found, f"{reason.expected}, such as 0.8", reason.nearest))
            del stated["operating.displacement_ratio"]
    try:
        pump = load_pump(options.pump, stated)
    except InputFaults as reason:
        option_of = {path: option for option, (path, *_) in keys.items()}
        moved = [Fault(option_of.get(f.path, f.path), f.found, f.expected, f.nearest) for f in reason.faults]
        raise InputFaults(reason.source, [*faults, *moved], reason.lines) from None
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return pump


def _ranges(options: argparse.Namespace, faults: list[Fault], single: Collection[str]) -> list[Range | None]:
    from swashfilm.console.levels import range_of
    from system.inputs.units import Dimension

    dimensions = (Dimension.ANGULAR_SPEED, Dimension.PRESSURE, None, Dimension.TEMPERATURE)
    return [
        range_of(faults, option, text, dimension, example)
        if option not in single and (text := option_value(options, option)) is not None
        else None
        for (option, (_, example, _)), dimension in zip(RANGES.items(), dimensions, strict=True)
    ]


COMMAND = Command(
    "table", "response table of a pump's gaps, for runs of --fidelity table", add_table_options, run_table_command
)
