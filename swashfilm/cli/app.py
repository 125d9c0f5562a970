"""The command line: what the commands are called, what they take, and what they print.

argparse, because the help must stand within 0.3 s; a command's own imports wait until it runs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from swashfilm.cli.check import run_check_command
from swashfilm.cli.report import run_report
from swashfilm.console.inputs import COMMAND_LINE
from swashfilm.console.terminal import show, show_table
from swashfilm.runs.calibrate.command import (
    CALIBRATE_OPTIONS,
    add_calibrate_options,
    run_calibrate_command,
)
from swashfilm.runs.diagnose.command import (
    DIAGNOSE_OPTIONS,
    add_diagnose_options,
    run_diagnose_command,
)
from swashfilm.runs.film.command import FILM_OPTIONS, add_film_options, run_film
from swashfilm.runs.map.command import MAP_OPTIONS, add_map_options, run_map_command
from swashfilm.runs.map.compare_command import (
    COMPARE_OPTIONS,
    add_compare_options,
    run_compare_command,
)
from swashfilm.runs.map.duty_command import add_duty_options, run_duty_command
from swashfilm.runs.pump.command import RUN_OPTIONS, add_run_options, pump_faults, run_pump_command
from swashfilm.runs.reference.coefficients_command import (
    COEFFICIENT_OPTIONS,
    add_coefficient_options,
    run_coefficients_command,
)
from swashfilm.runs.reference.command import add_reference_options, run_reference_command
from swashfilm.runs.reproduce.command import (
    REPRODUCE_OPTIONS,
    add_reproduce_options,
    run_reproduce_command,
)
from swashfilm.runs.table.command import TABLE_OPTIONS, add_table_options, run_table_command
from swashfilm.runs.transient.command import add_transient_options, run_transient_command
from system.inputs.faults import Fault, InputFaults, nearest_choice


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
        raise InputFaults(COMMAND_LINE, faults + (pump_faults(options, words) if options.command == "run" else []))
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
    add_run_options(run)
    _output(run)
    film = _command(commands, "film", "one film: a free one or a gap of a pump")
    add_film_options(film)
    _output(film)
    table = _command(
        commands, "table", "condense a pump's gaps into a response table, for runs of --fidelity table"
    )
    add_table_options(table)
    _output(table)
    transient = _command(commands, "transient", "displacement in time: plate, actuator and chambers of a pump")
    add_transient_options(transient)
    _output(transient)
    operating_map = _command(
        commands, "map", "a pump over speed, pressure, displacement, temperature, inlet pressure"
    )
    add_map_options(operating_map)
    _output(operating_map)
    duty = _command(commands, "duty", "what a pump takes and loses over a cycle, by a map of it")
    add_duty_options(duty)
    _output(duty)
    compare = _command(commands, "compare", "two maps or pumps side by side, over a cycle too")
    add_compare_options(compare)
    _output(compare)
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
    reproduce = _command(commands, "reproduce", "the paper's figures: its statements beside the same numbers here")
    add_reproduce_options(reproduce)
    _output(reproduce)
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
    own = {
        "run": RUN_OPTIONS,
        "film": FILM_OPTIONS,
        "table": TABLE_OPTIONS,
        "transient": [],
        "calibrate": CALIBRATE_OPTIONS,
        "reference": [],
        "coefficients": COEFFICIENT_OPTIONS,
        "map": MAP_OPTIONS,
        "duty": [],
        "compare": COMPARE_OPTIONS,
        "diagnose": DIAGNOSE_OPTIONS,
        "reproduce": REPRODUCE_OPTIONS,
    }
    if command in own:
        options = [*own[command], "-o", "--output", "--help"]
    else:
        options = ["--help"] if command else ["--help", "--version"]
    kind = "unknown option" if word.startswith("-") else "a word too many"
    name = word.partition("=")[0]
    return Fault(name, kind, f"one of {', '.join(options)}", nearest_choice(name, options))


def _doctor(options: argparse.Namespace) -> int:
    from swashfilm.cli.doctor import examine, is_well

    findings = examine()
    show_table("Doctor", [(finding.what, finding.text) for finding in findings])
    for finding in findings:
        if finding.remedy:
            sys.stderr.write(f"{finding.what}: {finding.remedy}\n")
    return 0 if is_well(findings) else 1


_COMMANDS = {
    "run": run_pump_command,
    "film": run_film,
    "table": run_table_command,
    "transient": run_transient_command,
    "map": run_map_command,
    "duty": run_duty_command,
    "compare": run_compare_command,
    "diagnose": run_diagnose_command,
    "calibrate": run_calibrate_command,
    "reference": run_reference_command,
    "coefficients": run_coefficients_command,
    "reproduce": run_reproduce_command,
    "report": run_report,
    "check": run_check_command,
    "doctor": _doctor,
}
