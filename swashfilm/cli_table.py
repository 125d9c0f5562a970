"""The command `swashfilm table`: what it takes, and what it prints."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from swashfilm.physics_switches import SWITCHES, add_switches
from swashfilm.terminal import show, show_table
from system.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from system.description import PumpDescription
    from system.table_build import Range, TableCase

COMMAND_LINE = "command line"
RANGES = {
    "--speed": ("500rpm..2500rpm", "shaft speeds (0.2 .. 1.2 of the rated one)"),
    "--pressure": (
        "5MPa..40MPa",
        "delivery pressures, gauge (0.05 beyond inlet and case .. 1.15 of the rated one)",
    ),
    "--displacement": ("0.1..1.0", "shares of the full displacement (0.1 .. 1)"),
    "--temperature": ("20degC..100degC", "temperatures, for the oil's viscosity (20 .. 100 degC)"),
}
HELD = {
    "--inlet-pressure": ("operating.inlet_pressure", "25bar", "pressure at the inlet, gauge"),
    "--case-pressure": ("operating.case_pressure", "1.5bar", "pressure in the case, gauge"),
}
TABLE_OPTIONS = [*RANGES, *HELD, "--source", "--points", "--held-out", "--workers", "--steps", *SWITCHES]


def add_table_options(command: argparse.ArgumentParser) -> None:
    """Give the command what it takes."""
    command.add_argument("pump", metavar="PUMP", help="built-in name (ref90) or pump file")
    for option, (example, what) in RANGES.items():
        command.add_argument(option, metavar=example, help=what)
    for option, (_, example, what) in HELD.items():
        command.add_argument(option, metavar=example, help=f"{what}; the pump's own where left out")
    command.add_argument(
        "--source", metavar="{films,floating}", default="films", help="fidelity to condense (films)"
    )
    command.add_argument("--steps", metavar="N", help="of floating gaps: steps a turn (360)")
    add_switches(command)
    command.add_argument("--points", metavar="N", help="points to learn from, 16 of them corners (120)")
    command.add_argument("--held-out", metavar="N", help="points that the error is taken from (30)")
    command.add_argument("--workers", metavar="N", help="processes that solve points side by side (1)")


def run_table_command(options: argparse.Namespace) -> int:
    """Run `swashfilm table` and return its exit code; raises InputFaults with what is wrong in words and file."""
    from swashfilm.progress import progress
    from swashfilm.run_folder import Interrupted, final_folder, run_folder
    from swashfilm.table_page import error_rows, held_rows
    from swashfilm.table_run import run_table

    case, workers = _case(options)
    name = f"table-{case.pump.name}"
    with (
        run_folder(name, options.output) as folder,
        progress(len(case.points), f"table {case.pump.name}") as report,
    ):
        try:
            summary = run_table(case, folder, report, workers=workers)
        except KeyboardInterrupt:
            raise Interrupted(None, "points solved are kept; the same command goes on with them") from None
    show_table(f"Table of {case.pump.name}", held_rows(summary))
    show_table("Error of held-out points", [("output", "rms", "largest", "at"), *error_rows(summary)])
    for warning in summary["warnings"]:
        show(f"warning: {warning}")
    show(f"results in {final_folder(folder)}")
    return 0


def _case(options: argparse.Namespace) -> tuple[TableCase, int]:
    """The case that a command line means, and how many workers; raises InputFaults with every fault at once."""
    from swashfilm.cli_floating import alike_faults, floating_faults, floating_options
    from system import table_sources
    from system.table_build import HELD_OUT, LEARNT, TableCase, table_axes
    from system.table_sources import Source

    faults: list[Fault] = []
    counts = [
        _count(faults, "--points", options.points, LEARNT, 32),
        _count(faults, "--held-out", options.held_out, HELD_OUT, 2),
        _count(faults, "--workers", options.workers, 1, 1),
    ]
    ranges = _ranges(options, faults)
    sources = [source.value for source in Source]
    if options.source not in sources:
        nearest = nearest_choice(options.source, sources)
        faults.append(Fault("--source", repr(options.source), f"one of {', '.join(sources)}", nearest))
    pump = _pump(options, faults)
    if faults := [*floating_faults(options, pump, options.source, "--source"), *alike_faults(pump)]:
        raise InputFaults(COMMAND_LINE, faults)
    solver = table_sources.solver_of(Source(options.source), floating_options(options))
    return TableCase(pump, solver, table_axes(pump, *ranges), counts[0], counts[1]), counts[2]


def _pump(options: argparse.Namespace, faults: list[Fault]) -> PumpDescription:
    """The pump, with the pressures that a table holds; raises InputFaults where it or `faults` has any."""
    from system.pump_file import load_pump

    stated = {path: text for option, (path, *_) in HELD.items() if (text := _given(options, option)) is not None}
    try:
        pump = load_pump(options.pump, stated)
    except InputFaults as reason:
        option_of = {path: option for option, (path, *_) in HELD.items()}
        moved = [Fault(option_of.get(f.path, f.path), f.found, f.expected, f.nearest) for f in reason.faults]
        raise InputFaults(reason.source, [*faults, *moved], reason.lines) from None
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return pump


def _ranges(options: argparse.Namespace, faults: list[Fault]) -> list[Range | None]:
    from system.units import Dimension

    dimensions = (Dimension.ANGULAR_SPEED, Dimension.PRESSURE, None, Dimension.TEMPERATURE)
    return [
        _range(faults, option, text, dimension, example) if (text := _given(options, option)) is not None else None
        for (option, (example, _)), dimension in zip(RANGES.items(), dimensions, strict=True)
    ]


def _range(faults: list[Fault], option: str, text: str, dimension: object, example: str) -> Range | None:
    """MIN..MAX in SI; None after a fault."""
    from system.units import Dimension, QuantityError, parse_quantity

    ends = text.split("..")
    try:
        if len(ends) != 2:
            raise QuantityError(repr(text), "two ends with .. between them")
        low, high = (
            parse_quantity(end, dimension) if isinstance(dimension, Dimension) else float(end) for end in ends
        )
        if not low < high:
            raise QuantityError(repr(text), "the lower end first")
    except QuantityError as reason:
        faults.append(Fault(option, reason.found, f"{reason.expected}: {example}", reason.nearest))
    except ValueError:
        faults.append(Fault(option, repr(text), f"two bare numbers: {example}"))
    else:
        return low, high
    return None


def _count(faults: list[Fault], option: str, text: str | None, default: int, least: int) -> int:
    if text is None:
        return default
    if text.isdecimal() and least <= int(text) <= 10000:
        return int(text)
    faults.append(Fault(option, repr(text), f"a number, {least} to 10000"))
    return default


def _given(options: argparse.Namespace, option: str) -> str | None:
    found: str | None = getattr(options, option[2:].replace("-", "_"))
    return found
