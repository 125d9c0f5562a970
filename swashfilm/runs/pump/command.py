"""Command `swashfilm run`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import SWITCHES, add_floating_options
from swashfilm.console.command import Command
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.inputs import COMMAND_LINE, expect, given_text, option_value, whole
from swashfilm.console.settings import LEVELS_EXAMPLE, add_pump_argument, add_set_option, set_values
from swashfilm.console.terminal import show, show_result
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import QuantityError, parse_share

if TYPE_CHECKING:
    from swashfilm.runs.pump.run import PumpCase
    from swashfilm.runs.pump.vary.points import PumpStudy

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
    add_pump_argument(command)
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
    add_set_option(command)
    what = f"solve over levels of a key of the pump file, such as {LEVELS_EXAMPLE}; may be repeated: a grid"
    command.add_argument("--vary", action="append", default=[], metavar="KEY=A..B:N", help=what)
    command.add_argument("--resume", type=Path, metavar="DIR", help="of --vary: run folder with finished points")
    command.add_argument("--workers", metavar="N", help="of --vary: processes that solve points side by side (1)")
    add_floating_options(command)


def run_pump_command(options: argparse.Namespace) -> int:
    """Run `swashfilm run` and return its exit code; raise InputFaults with every fault of pump and options."""
    if options.vary:
        return _run_varied(options)
    case = pump_case(options)
    from swashfilm.console.assumed import show_assumptions
    from swashfilm.console.progress import BeforeWriting, progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.pump.run import WRITING, solve_pump, unfinished_kept
    from system.points.floating_kinds import work_of

    show_assumptions(options.pump, case.assumptions)
    name = case.pump.name
    if case.fidelity is Fidelity.FLOATING and (times := work_of(case.pump)) > 1.0:
        show(f"chambers differ: their floating gaps take about {times:.0f} times as long as identical ones")
    with run_folder(name, options.output, workbook=options.excel) as folder, progress(0, f"run {name}") as report:
        solving = BeforeWriting(report, WRITING)
        with unfinished_kept(case, folder) as solved:
            found = solve_pump(case, solving, solved)
        solving.writing()
        added = found.write(folder)
    show_result(found, folder, added)
    return 0


def _run_varied(options: argparse.Namespace) -> int:
    """Run `swashfilm run --vary` and return its exit code."""
    study, workers = varied_case(options)
    from swashfilm.console.points import ended
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.pump.vary.result import VariedRun, run_varied

    with (
        run_folder(study.name, options.output, workbook=options.excel) as folder,
        progress(len(study.points), f"vary {study.name}") as report,
    ):
        run_varied(study, folder, report, resumed=options.resume, workers=workers)
    found = VariedRun.opened(final_folder(folder))
    show_result(found, folder)
    return ended(found.summary)


def varied_case(options: argparse.Namespace) -> tuple[PumpStudy, int]:
    """Return the pump over the keys of --vary, and the number of processes; raise InputFaults with every fault."""
    from swashfilm.case.study import Combine
    from swashfilm.runs.pump.vary.axes import pump_faults as faults_of_points, vary_axes
    from swashfilm.runs.pump.vary.points import PumpStudy

    faults: list[Fault] = []
    workers = whole(faults, "--workers", options.workers, 1, (1, 64), "a number of processes")
    if options.refine is not None:
        faults.append(Fault("--refine", "beside --vary", "one of the two"))
    axes = vary_axes(options.vary, faults)
    faults += [*_beside_levels([axis.key for axis in axes], options), *_fidelity_faults(options)]
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    one = argparse.Namespace(**{**vars(options), "vary": [], "workers": None, "resume": None})
    case_of = partial(pump_case, one)
    name = f"{Path(options.pump).stem}-vary"
    study = PumpStudy(name, "", axes, Combine.ALL, case_of, Fidelity(options.fidelity))
    if faults := faults_of_points(axes, study.points, case_of):
        raise InputFaults(COMMAND_LINE, faults)
    return replace(study, text=_solved_with(options) + given_text(options.pump, _overrides(options)[0])), workers


def _fidelity_faults(options: argparse.Namespace) -> list[Fault]:
    """Return the fault of --fidelity, if it is none."""
    if options.fidelity in _FIDELITIES:
        return []
    nearest = nearest_choice(options.fidelity, _FIDELITIES)
    return [Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(_FIDELITIES)}", nearest)]


def _solved_with(options: argparse.Namespace) -> str:
    """Return comments with the levels of --vary and the fidelity with its options, which no pump file states."""
    flags = [switch for switch in SWITCHES if option_value(options, switch)]
    values = ((option, option_value(options, option)) for option in ("--fidelity", "--table", "--steps", "--finer"))
    words = [
        *(f"{text} in levels" for text in options.vary),
        *(f"{option} {value}" for option, value in values if value),
    ]
    return "".join(f"# command line: {text}\n" for text in (*words, *flags))


def pump_case(options: argparse.Namespace, values: Mapping[str, object] | None = None) -> PumpCase:
    """Return the case of a command line; raise InputFaults with every fault of pump file and options.

    values: of keys of the pump file, beside those of the options.
    """
    from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options
    from swashfilm.runs.pump.run import PumpCase
    from system.pump.film_thickness import moved_to
    from system.pump_file.file import load_known_pump, load_pump
    from system.work.processes import cores

    stated, faults = _overrides(options)
    stated |= values or {}
    faults += [
        Fault(option, "without --vary", "--vary KEY=A..B:N")
        for option in ("--resume", "--workers")
        if option_value(options, option)
    ]
    if unknown := _fidelity_faults(options):
        faults += unknown
    elif options.table and options.fidelity != Fidelity.TABLE.value:
        faults.append(Fault("--table", f"beside --fidelity {options.fidelity}", "no table, or --fidelity table"))
    expect(options.pump, "pump", "film")
    try:
        known = load_known_pump(options.pump, stated)
    except InputFaults as reason:
        raise _at_options(reason, options, faults) from None
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
    faults: list[Fault] = []
    stated = set_values(options.set, faults)
    for option, (path, example, what) in _OVERRIDES.items():
        text = option_value(options, option)
        if text is None:
            continue
        if path in stated:
            faults.append(Fault(option, f"{text!r} beside --set {path}={stated[path]}", "one of the two"))
        stated[path] = text
        if option == "--displacement":
            try:
                stated[path] = parse_share(text)
            except QuantityError as reason:
                wanted = f"{what}, {reason.expected}, such as {example}"
                faults.append(Fault(option, reason.found, wanted, reason.nearest))
                del stated[path]
    return stated, faults


def _given_options(options: argparse.Namespace) -> dict[str, str]:
    """Return the options of the command line that replace a value of the pump file, by its path."""
    return {path: option for option, (path, _, _) in _OVERRIDES.items() if option_value(options, option) is not None}


def _beside_levels(keys: Sequence[str], options: argparse.Namespace) -> list[Fault]:
    """Return the faults of keys of --vary that another option gives one value."""
    given = {path: f"--set {path}" for path in set_values(options.set, [])} | _given_options(options)
    return [Fault(f"--vary {key}", f"beside {given[key]}", "one of the two") for key in keys if key in given]


def _at_options(reason: InputFaults, options: argparse.Namespace, faults: list[Fault]) -> InputFaults:
    """Return the faults of a pump, those of replaced values at their options."""
    option_of = _given_options(options)
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
