"""Command `swashfilm run`: its options, its faults, its output."""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_floating_options
from swashfilm.console.command import Command
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.inputs import COMMAND_LINE, expect, given_text, option_value, whole
from swashfilm.console.terminal import show, show_result
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import with_point

if TYPE_CHECKING:
    from swashfilm.runs.pump.run import PumpCase

_TEMPERATURE = "operating.temperature"
_OVERRIDES = {
    "--speed": ("operating.speed", "2100rpm", "shaft speed"),
    "--pressure": ("operating.pressure", "350bar", "delivery pressure, gauge"),
    "--displacement": ("operating.displacement_ratio", "1.0", "fraction of the full displacement"),
    "--temperature": (_TEMPERATURE, "50degC", "temperature of the oil in the case"),
    "--inlet-pressure": ("operating.inlet_pressure", "25bar", "pressure at the inlet, gauge"),
    "--case-pressure": ("operating.case_pressure", "1.5bar", "pressure in the case, gauge"),
}
_FIDELITIES = [fidelity.value for fidelity in Fidelity]


def add_run_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("pump", nargs="?", default="ref90", metavar="PUMP", help="built-in name (ref90) or pump file")
    for option, (_, example, what) in _OVERRIDES.items():
        command.add_argument(option, metavar=example, help=f"{what}; default: that of the pump file")
    what = (
        "films of given thickness (lumped), solved at given positions (fixed), at positions by balance of forces "
        "(floating), or by a response table (table)"
    )
    metavar = f"{{{','.join(_FIDELITIES)}}}"
    command.add_argument("--fidelity", metavar=metavar, default=Fidelity.FLOATING.value, help=what)
    what = "response table in place of the stored one of this pump"
    command.add_argument("--table", type=Path, metavar="FILE.json", help=what)
    what = "floating gaps: solve N times, cells, angles and steps each twice finer; report order and limit"
    command.add_argument("--refine", metavar="N", help=what)
    what = "another value of a key of the pump file, such as valve_plate.film_thickness=10um; may be repeated"
    command.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help=what)
    add_floating_options(command)


def run_pump_command(options: argparse.Namespace) -> int:
    """Run `swashfilm run` and return its exit code; raise InputFaults with every fault of pump and options."""
    case = pump_case(options)
    from swashfilm.console.assumed import show_assumptions
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.pump.run import solve_pump, unfinished_kept
    from system.points.floating_kinds import work_of

    show_assumptions(options.pump, case.assumptions)
    name = case.pump.name
    if case.fidelity is Fidelity.FLOATING and (times := work_of(case.pump)) > 1.0:
        show(f"chambers differ: their floating gaps take about {times:.0f} times as long as identical ones")
    with run_folder(name, options.output) as folder, progress(1, f"run {name}") as report:
        with unfinished_kept(case, folder) as solved:
            found = solve_pump(case, report, solved)
        added = found.write(folder)
    show_result(found, folder, added)
    return 0


def pump_case(options: argparse.Namespace) -> PumpCase:
    """Return the case of a command line; raise InputFaults with every fault of pump file and options."""
    from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options
    from swashfilm.runs.pump.run import PumpCase
    from system.pump.film_thickness import moved_to
    from system.pump_file.file import load_known_pump, load_pump
    from system.work.processes import cores

    stated, faults = _overrides(options)
    if options.fidelity not in _FIDELITIES:
        nearest = nearest_choice(options.fidelity, _FIDELITIES)
        faults.append(Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(_FIDELITIES)}", nearest))
    elif options.table and options.fidelity != Fidelity.TABLE.value:
        faults.append(Fault("--table", f"beside --fidelity {options.fidelity}", "no table, or --fidelity table"))
    expect(options.pump, "pump", "film")
    try:
        known = load_known_pump(options.pump, stated)
    except InputFaults as reason:
        raise _at_options(reason, stated, faults) from None
    own = pump = known.pump
    if _TEMPERATURE in stated and pump.physics.thermal_clearance is not None:
        own = load_pump(options.pump, {path: value for path, value in stated.items() if path != _TEMPERATURE})
        pump = moved_to(own, pump.operating)
    faults += floating_faults(options, pump, options.fidelity)
    levels = whole(faults, "--refine", options.refine, 1, (2, 4), "a number of levels")
    if levels > 1 and options.fidelity != Fidelity.FLOATING.value:
        faults.append(Fault("--refine", f"beside --fidelity {options.fidelity}", "--fidelity floating"))
    if options.fidelity == Fidelity.TABLE.value:
        faults += alike_faults(pump)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    given, fidelity = given_text(options.pump, stated), Fidelity(options.fidelity)
    return PumpCase(
        pump, given, fidelity, options.table, floating_options(options, pump), cores() > 1, levels, own,
        known.assumptions,
    )  # fmt: skip


def pump_faults(options: argparse.Namespace, words: Sequence[str]) -> list[Fault]:
    """Return the faults of the pump and its options, without those of unknown options."""
    before = words[words.index(options.pump) - 1] if options.pump in words else ""
    if before.startswith("-"):
        options.pump = "ref90"  # the word is the value of an unknown option
    try:
        pump_case(options)
    except InputFaults as reason:
        return list(reason.faults)
    return []


def _overrides(options: argparse.Namespace) -> tuple[dict[str, object], list[Fault]]:
    """Return the entries of the pump file that the options replace, and the faults of the options."""
    stated: dict[str, object] = {}
    faults = []
    for text in options.set:
        key, equals, value = text.partition("=")
        if not (equals and key.strip() and value.strip()):
            faults.append(Fault("--set", repr(text), "KEY=VALUE, such as valve_plate.film_thickness=10um"))
        else:
            stated[key.strip()] = toml_value(value.strip())
    for option, (path, example, what) in _OVERRIDES.items():
        text = option_value(options, option)
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


def toml_value(text: str) -> object:
    """Return the value of a TOML text; text that is not a TOML value, such as `10um`, is a string."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def _at_options(reason: InputFaults, stated: dict[str, object], faults: list[Fault]) -> InputFaults:
    """Return the faults of a pump, those of replaced values at their options."""
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
