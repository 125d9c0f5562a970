"""The command `swashfilm run`: what it takes, and what it prints."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.physics_switches import add_switches
from swashfilm.console.command import Command
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.inputs import COMMAND_LINE, expect, given_text
from swashfilm.console.terminal import show, show_table
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import with_point

if TYPE_CHECKING:
    from system.description.pump import PumpDescription

_TEMPERATURE = "operating.temperature"
_OVERRIDES = {
    "--speed": ("operating.speed", "2100rpm", "shaft speed"),
    "--pressure": ("operating.pressure", "350bar", "delivery pressure, gauge"),
    "--displacement": ("operating.displacement_ratio", "1.0", "share of the full displacement"),
    "--temperature": (_TEMPERATURE, "50degC", "temperature of the oil in the case"),
    "--inlet-pressure": ("operating.inlet_pressure", "25bar", "pressure at the inlet, gauge"),
    "--case-pressure": ("operating.case_pressure", "1.5bar", "pressure in the case, gauge"),
}
_FIDELITIES = [fidelity.value for fidelity in Fidelity]


def add_run_options(command: argparse.ArgumentParser) -> None:
    """Give the command what it takes."""
    command.add_argument(
        "pump", nargs="?", default="ref90", metavar="PUMP", help="built-in name (ref90) or pump file"
    )
    for option, (_, example, what) in _OVERRIDES.items():
        command.add_argument(option, metavar=example, help=f"{what}; the pump's own where left out")
    command.add_argument(
        "--fidelity",
        metavar=f"{{{','.join(_FIDELITIES)}}}",
        default=Fidelity.FILMS.value,
        help="films of given thickness, as a table has learnt them, at given positions (films), or floating",
    )
    command.add_argument(
        "--table", type=Path, metavar="FILE.json", help="response table in place of the kept one of this pump"
    )
    command.add_argument("--steps", metavar="N", help="floating gaps: angles of a turn that are reported (360)")
    command.add_argument(
        "--finer", metavar="X", help="floating gaps: times the usual cells each way (.5; --rigid: 1)"
    )
    add_switches(command)


def run_pump_command(options: argparse.Namespace) -> int:
    """Run `swashfilm run` and return its exit code; raises InputFaults with what is wrong in pump and options."""
    pump = _pump(options)
    stated, _ = _overrides(options)
    from swashfilm.console.floating_options import floating_options
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.pump.floating import show_floating
    from swashfilm.runs.pump.page import efficiency_rows, headline_rows, pair_rows
    from swashfilm.runs.pump.run import run_pump
    from system.points.floating_kinds import work_of
    from system.work.processes import cores

    given = given_text(options.pump, stated)
    if options.fidelity == Fidelity.FLOATING.value and (times := work_of(pump)) > 1.0:
        show(f"chambers differ: their floating gaps take about {times:.0f} times as long as alike ones")
    with run_folder(pump.name, options.output) as folder, progress(1, f"run {pump.name}") as report:
        fidelity, floating = Fidelity(options.fidelity), floating_options(options)
        summary = run_pump(pump, given, fidelity, folder, report, options.table, floating, cores() > 1)
    show_table(f"Pump {pump.name}", headline_rows(summary))
    show_table("Efficiencies: paper's Eqs. (3)-(5), ISO 4391/4409", efficiency_rows(summary))
    show_table("Friction pairs: Coulomb, viscous, total, share", pair_rows(summary))
    if fidelity is Fidelity.FLOATING:
        show_floating(summary)
    if "table" in summary:
        from swashfilm.runs.table.summary import TOLD_HEAD, told_rows

        show_table(
            f"Gaps by a table of the {summary['table']['source']} fidelity", [TOLD_HEAD, *told_rows(summary)]
        )
    for warning in summary["warnings"]:
        show(f"warning: {warning}")
    show(f"results in {final_folder(folder)}")
    return 0


def _pump(options: argparse.Namespace) -> PumpDescription:
    """The pump that a command line means; raises InputFaults with what is wrong in file and options together."""
    from swashfilm.console.floating_options import alike_faults, floating_faults
    from system.pump.film_thickness import moved_to
    from system.pump_file.file import load_pump

    stated, faults = _overrides(options)
    if options.fidelity not in _FIDELITIES:
        nearest = nearest_choice(options.fidelity, _FIDELITIES)
        faults.append(Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(_FIDELITIES)}", nearest))
    elif options.table and options.fidelity != Fidelity.TABLE.value:
        faults.append(Fault("--table", f"beside --fidelity {options.fidelity}", "no table, or --fidelity table"))
    expect(options.pump, "pump", "film")
    try:
        pump = load_pump(options.pump, stated)
    except InputFaults as reason:
        raise _at_options(reason, stated, faults) from None
    reads = options.fidelity in (Fidelity.LUMPED.value, Fidelity.FILMS.value)
    if reads and _TEMPERATURE in stated and pump.physics.thermal_clearance is not None:
        pump = moved_to(load_pump(options.pump), pump.operating)
    faults += floating_faults(options, pump, options.fidelity)
    if options.fidelity in (Fidelity.FILMS.value, Fidelity.TABLE.value):
        faults += alike_faults(pump)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return pump


def pump_faults(options: argparse.Namespace, words: Sequence[str]) -> list[Fault]:
    """What is wrong with the pump and its options, beside options that are not known."""
    before = words[words.index(options.pump) - 1] if options.pump in words else ""
    if before.startswith("-"):
        options.pump = "ref90"  # the word was the value of an unknown option
    try:
        _pump(options)
    except InputFaults as reason:
        return list(reason.faults)
    return []


def _overrides(options: argparse.Namespace) -> tuple[dict[str, object], list[Fault]]:
    """What the options put in place of the pump's own operating point, as a pump file would have it."""
    stated: dict[str, object] = {}
    faults = []
    for option, (path, example, what) in _OVERRIDES.items():
        text = getattr(options, option[2:].replace("-", "_"))
        if text is None:
            continue
        stated[path] = text
        if option == "--displacement":
            try:
                stated[path] = float(text)
            except ValueError:
                wanted = f"{what}, a bare number such as {example}"
                faults.append(Fault(option, repr(text), wanted, with_point(text)))
                del stated[path]
    return stated, faults


def _at_options(reason: InputFaults, stated: dict[str, object], faults: list[Fault]) -> InputFaults:
    """The faults of a pump, those of overridden values told at their options."""
    option_of = {path: option for option, (path, _, _) in _OVERRIDES.items() if path in stated}
    moved = [Fault(option_of.get(f.path, f.path), f.found, f.expected, f.nearest) for f in reason.faults]
    all_ours = all(fault.path in _OVERRIDES for fault in moved)
    return InputFaults(COMMAND_LINE if all_ours else reason.source, [*faults, *moved], reason.lines)


COMMAND = Command(
    "run",
    "one operating point of a pump: three gaps, chambers, losses",
    add_run_options,
    run_pump_command,
    faults=pump_faults,
)
