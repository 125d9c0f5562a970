"""The command line: what the commands are called, what they take, and what they print.

argparse, because the help must stand within 0.3 s; a command's own imports wait until it runs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from swashfilm.cli_calibrate import CALIBRATE_OPTIONS, add_calibrate_options, run_calibrate_command
from swashfilm.cli_coefficients import COEFFICIENT_OPTIONS, add_coefficient_options, run_coefficients_command
from swashfilm.cli_diagnose import (
    add_diagnose_options,
    check_recording_command,
    is_recording,
    run_diagnose_command,
)
from swashfilm.cli_reference import add_reference_options, run_reference_command
from swashfilm.cli_report import run_report
from swashfilm.cli_table import TABLE_OPTIONS, add_table_options, run_table_command
from swashfilm.cli_transient import add_transient_options, run_transient_command
from swashfilm.fidelity import Fidelity
from swashfilm.physics_switches import SWITCHES, add_switches
from swashfilm.terminal import show, show_table
from system.faults import Fault, InputFaults, nearest_choice
from system.units import with_point

if TYPE_CHECKING:
    from system.description import PumpDescription

COMMAND_LINE = "command line"
_OVERRIDES = {
    "--speed": ("operating.speed", "2100rpm", "shaft speed"),
    "--pressure": ("operating.pressure", "350bar", "delivery pressure, gauge"),
    "--displacement": ("operating.displacement_ratio", "1.0", "share of the full displacement"),
    "--temperature": ("operating.temperature", "50degC", "temperature of the oil in the case"),
    "--inlet-pressure": ("operating.inlet_pressure", "25bar", "pressure at the inlet, gauge"),
    "--case-pressure": ("operating.case_pressure", "1.5bar", "pressure in the case, gauge"),
}
_FILM_OPTIONS = ["--refine", "--csv", "--resume", "--workers", "--animate", *SWITCHES]
_FIDELITIES = [fidelity.value for fidelity in Fidelity]


def run_command(words: Sequence[str]) -> int:
    """Run the command that the words name and return its exit code; raises what its parts raise.

    Words that are no command of ours raise InputFaults, every one that is not known at once.
    """
    parser = build_parser()
    _check_command(parser, words)
    options, unknown = parser.parse_known_args(list(words))
    if unknown:
        # A word after an unknown option is most likely its value: no fault of its own.
        told = [word for word in unknown if word.startswith("-")] or unknown
        faults = [_unknown(options.command, word) for word in told]
        raise InputFaults(
            COMMAND_LINE, faults + (_pump_faults(options, words) if options.command == "run" else [])
        )
    if options.command is None:
        parser.print_help()
        return 0
    return int(_COMMANDS[options.command](options))


class _Parser(argparse.ArgumentParser):
    """An argument parser that raises its complaint as a fault."""

    def error(self, message: str) -> NoReturn:
        what, _, rest = message.partition(": ")
        if what == "the following arguments are required":
            fault = Fault(rest, "nothing", f"see {self.prog} --help")
        elif "expected one argument" in rest:
            name = what.removeprefix("argument ").split("/")[-1]
            fault = Fault(name, "no value", "a value", f"one that starts with - is written {name}=VALUE")
        else:
            fault = Fault(what.removeprefix("argument "), rest or message, f"see {self.prog} --help")
        raise InputFaults(COMMAND_LINE, [fault])


class _Version(argparse.Action):
    """Print the version, which is looked up only now."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        from importlib.metadata import version

        show(f"swashfilm {version('swashfilm')}")
        parser.exit()


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    parser = _Parser(
        prog="swashfilm",
        description="Lubrication gaps and losses of swash-plate axial piston pumps.",
        epilog="Every command has its own --help. --debug shows the traceback of an internal error.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and end")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    run = _command(commands, "run", "one operating point of a pump: three gaps, chambers, losses")
    run.add_argument("pump", nargs="?", default="ref90", metavar="PUMP", help="built-in name (ref90) or pump file")
    for option, (_, example, what) in _OVERRIDES.items():
        run.add_argument(option, metavar=example, help=f"{what}; the pump's own where left out")
    run.add_argument(
        "--fidelity",
        metavar=f"{{{','.join(_FIDELITIES)}}}",
        default=Fidelity.FILMS.value,
        help="films of given thickness, as a table has learnt them, at given positions (films), or floating",
    )
    run.add_argument(
        "--table", type=Path, metavar="FILE.json", help="response table in place of the kept one of this pump"
    )
    run.add_argument("--steps", metavar="N", help="floating gaps: angles of a turn that are reported (360)")
    run.add_argument("--finer", metavar="X", help="floating gaps: times the usual cells each way (.5; --rigid: 1)")
    add_switches(run)
    _output(run)
    film = _command(commands, "film", "one film: a free one or a gap of a pump")
    film.add_argument("case", type=Path, metavar="CASE.toml", help="the film case")
    film.add_argument(
        "--refine", metavar="N", help="solve on N meshes, each twice finer, and tell order and limit"
    )
    film.add_argument(
        "--resume", type=Path, metavar="DIR", help="of a study: take finished points from this folder"
    )
    film.add_argument("--workers", metavar="N", help="of a study: processes that solve points side by side (1)")
    film.add_argument("--csv", action="store_true", help="write the fields as a table too, fields.csv")
    film.add_argument(
        "--animate", action="store_true", help="of a revolution: a moving picture, animation.gif (.mp4 by ffmpeg)"
    )
    add_switches(film)
    _output(film)
    table = _command(
        commands, "table", "condense a pump's gaps into a response table, for runs of --fidelity table"
    )
    add_table_options(table)
    _output(table)
    transient = _command(commands, "transient", "displacement in time: plate, actuator and chambers of a pump")
    add_transient_options(transient)
    _output(transient)
    diagnose = _command(
        commands,
        "diagnose",
        "where a recording and the simulation of its pump part: by what, how sure",
    )
    add_diagnose_options(diagnose)
    _output(diagnose)
    calibrate = _command(commands, "calibrate", "coefficients of a pump by a recording, with their widths")
    add_calibrate_options(calibrate)
    _output(calibrate)
    reference = _command(commands, "reference", "what the film equation leaves out at steps, grooves and orifices")
    add_reference_options(reference)
    _output(reference)
    coefficients = _command(commands, "coefficients", "a port's flow coefficient out of a computed flow")
    add_coefficient_options(coefficients)
    report = _command(commands, "report", "make the report of a run folder anew")
    report.add_argument("folder", type=Path, metavar="DIR", help="the run folder")
    check = _command(commands, "check", "validate a pump file, case or recording without running it")
    check.add_argument("file", metavar="FILE", help="pump file, built-in pump, any case, or recording")
    _command(commands, "doctor", "what this machine offers: packages, caches, graphics")
    return parser


def _command(commands: Any, name: str, what: str) -> argparse.ArgumentParser:
    added: argparse.ArgumentParser = commands.add_parser(
        name, help=what, description=what.capitalize() + ".", allow_abbrev=False
    )
    return added


def _output(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "-o", "--output", dest="output", type=Path, metavar="DIR", help="run folder (default runs/NAME-N, N fresh)"
    )


def _check_command(parser: argparse.ArgumentParser, words: Sequence[str]) -> None:
    name = next((word for word in words if not word.startswith("-")), None)
    if name is not None and not words[0].startswith("-") and name not in _COMMANDS:
        fault = Fault("command", f"'{name}'", f"one of {', '.join(_COMMANDS)}", nearest_choice(name, _COMMANDS))
        raise InputFaults(COMMAND_LINE, [fault])


def _unknown(command: str | None, word: str) -> Fault:
    """The fault of a word that no option or argument takes."""
    run_options = [*_OVERRIDES, "--fidelity", "--table", "--steps", "--finer", *SWITCHES]
    own = {
        "run": run_options,
        "film": _FILM_OPTIONS,
        "table": TABLE_OPTIONS,
        "transient": [],
        "diagnose": [],
        "calibrate": CALIBRATE_OPTIONS,
        "reference": [],
        "coefficients": COEFFICIENT_OPTIONS,
    }
    if command in own:
        options = [*own[command], "-o", "--output", "--help"]
    else:
        options = ["--help"] if command else ["--help", "--version"]
    kind = "unknown option" if word.startswith("-") else "a word too many"
    name = word.partition("=")[0]
    return Fault(name, kind, f"one of {', '.join(options)}", nearest_choice(name, options))


def _pump(options: argparse.Namespace) -> PumpDescription:
    """The pump that a command line means; raises InputFaults with what is wrong in file and options together."""
    from swashfilm.cli_floating import alike_faults, floating_faults
    from system.pump_file import load_pump

    stated, faults = _overrides(options)
    if options.fidelity not in _FIDELITIES:
        nearest = nearest_choice(options.fidelity, _FIDELITIES)
        faults.append(Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(_FIDELITIES)}", nearest))
    elif options.table and options.fidelity != Fidelity.TABLE.value:
        faults.append(Fault("--table", f"beside --fidelity {options.fidelity}", "no table, or --fidelity table"))
    _expect(options.pump, "pump", "film")
    try:
        pump = load_pump(options.pump, stated)
    except InputFaults as reason:
        raise _at_options(reason, stated, faults) from None
    faults += floating_faults(options, pump, options.fidelity)
    if options.fidelity in (Fidelity.FILMS.value, Fidelity.TABLE.value):
        faults += alike_faults(pump)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return pump


def _expect(path: str | Path, wanted: str, command: str) -> None:
    """Raise InputFaults for a file of the other kind ("pump" or "film"), with the command that takes it."""
    from system.case_table import read_toml

    if not Path(path).is_file():
        return
    _, tables = read_toml(Path(path))
    found = next((kind for kind in ("film", "pump") if isinstance(tables.get(kind), dict)), wanted)
    if found != wanted and "gap" not in tables:
        fault = Fault("file", f"a file with [{found}]", f"a file with [{wanted}]", f"swashfilm {command} {path}")
        raise InputFaults(str(path), [fault])


def _pump_faults(options: argparse.Namespace, words: Sequence[str]) -> list[Fault]:
    """What is wrong with the pump and its options, beside options that are not known."""
    before = words[words.index(options.pump) - 1] if options.pump in words else ""
    if before.startswith("-"):
        options.pump = "ref90"  # the word was the value of an unknown option
    try:
        _pump(options)
    except InputFaults as reason:
        return list(reason.faults)
    return []


def _run(options: argparse.Namespace) -> int:
    pump = _pump(options)
    stated, _ = _overrides(options)
    from swashfilm.cli_floating import floating_options, show_floating
    from swashfilm.progress import progress
    from swashfilm.pump_page import efficiency_rows, headline_rows, pair_rows
    from swashfilm.pump_run import run_pump
    from swashfilm.run_folder import final_folder, run_folder
    from system.floating_kinds import work_of
    from system.side_by_side import cores

    given = _given_text(options.pump, stated)
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
        from swashfilm.table_told import TOLD_HEAD, told_rows

        show_table(
            f"Gaps by a table of the {summary['table']['source']} fidelity", [TOLD_HEAD, *told_rows(summary)]
        )
    for warning in summary["warnings"]:
        show(f"warning: {warning}")
    show(f"results in {final_folder(folder)}")
    return 0


def _given_text(pump: str, stated: Mapping[str, object]) -> str:
    """The pump file as given, under comments that tell what the command line put in place of its entries."""
    from importlib.resources import files

    from system.pump_file import builtin_pumps

    built_in = files("system").joinpath("pumps", f"{pump}.toml")
    text = built_in.read_text("utf-8") if pump in builtin_pumps() else Path(pump).read_text("utf-8")
    return "".join(f"# command line: {path} = {value}\n" for path, value in stated.items()) + text


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


def _film(options: argparse.Namespace) -> int:
    from swashfilm.cli_film import run_film

    _expect(options.case, "film", "run")
    return run_film(options)


def _check(options: argparse.Namespace) -> int:
    from system.case_table import read_toml
    from system.pump_file import builtin_pumps, check_pump, load_pump, resolved_toml

    is_pump = options.file in builtin_pumps()
    if not is_pump:
        path = Path(options.file)
        tables = {} if is_recording(path, ()) else read_toml(path)[1]
        if is_recording(path, list(tables)):
            check_recording_command(path)
            show(f"{path}: ok")
            return 0
        if "transient" in tables:
            from swashfilm.transient_case import load_transient

            show(load_transient(path).resolved)
            show(f"{path}: ok")
            return 0
        if "reference" in tables:
            from swashfilm.reference_case import load_reference

            show("\n".join(passage.words for passage in load_reference(path).passages))
            show(f"{path}: ok")
            return 0
        is_film = bool({"film", "gap"} & set(tables))
        is_pump = isinstance(tables.get("pump"), dict) and not is_film
        if not is_pump and not is_film:
            fault = Fault(
                "file",
                f"tables {', '.join(tables) or 'none'}",
                "[pump] (a pump file), [film] (a film case), [transient], [reference] or [channel] (a recording)",
            )
            raise InputFaults(options.file, [fault])
    if is_pump:
        pump = load_pump(options.file)
        show(resolved_toml(pump))
        for warning in check_pump(pump).warnings:
            show(f"warning: {warning}")
    else:
        show(_checked_film(Path(options.file), tables))
    show(f"{options.file}: ok")
    return 0


def _checked_film(path: Path, tables: Mapping[str, Any]) -> str:
    """The film case of a file as resolved, of a study or table at its first point; raises InputFaults."""
    from swashfilm.gap_table_case import load_gap_table
    from swashfilm.study_case import StudyCase, load_film

    if "table" in tables:
        asked = load_gap_table(path)
        show(f"a table over {len(asked.axes)} keys")
        return asked.study.case(asked.study.points[0]).resolved
    case = load_film(path)
    if isinstance(case, StudyCase):
        show(f"a study of {len(case.points)} points")
        return case.case(case.points[0]).resolved
    return case.resolved


def _doctor(options: argparse.Namespace) -> int:
    from swashfilm.doctor import examine, is_well

    findings = examine()
    show_table("Doctor", [(finding.what, finding.text) for finding in findings])
    for finding in findings:
        if finding.remedy:
            sys.stderr.write(f"{finding.what}: {finding.remedy}\n")
    return 0 if is_well(findings) else 1


_COMMANDS = {
    "run": _run,
    "film": _film,
    "table": run_table_command,
    "transient": run_transient_command,
    "diagnose": run_diagnose_command,
    "calibrate": run_calibrate_command,
    "reference": run_reference_command,
    "coefficients": run_coefficients_command,
    "report": run_report,
    "check": _check,
    "doctor": _doctor,
}
