"""Command line: parser of all commands.

argparse prints the help within 0.3 s; a command imports its own modules when it runs.
"""

import argparse
from collections.abc import Sequence
from typing import Any, NoReturn

from swashfilm.cli import check, doctor, report, schema
from swashfilm.cli.new import command as new
from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE
from swashfilm.console.pressures import pressures_of
from swashfilm.console.terminal import show
from swashfilm.runs.calibrate import command as calibrate
from swashfilm.runs.compare import command as compare
from swashfilm.runs.diagnose import command as diagnose
from swashfilm.runs.export import command as export
from swashfilm.runs.film import command as film
from swashfilm.runs.map import command as operating_map
from swashfilm.runs.map.duty import command as duty
from swashfilm.runs.plan import command as plan
from swashfilm.runs.pump import command as run
from swashfilm.runs.reference import coefficients_command as coefficients, command as reference
from swashfilm.runs.reproduce import command as reproduce
from swashfilm.runs.table import command as table
from swashfilm.runs.transient import command as transient
from swashfilm.runs.variation.optimise import command as optimise
from swashfilm.runs.variation.sensitivity import command as sensitivity
from swashfilm.runs.variation.tolerance import command as tolerance
from system.inputs.faults import Fault, InputFaults, nearest_choice

_MODULES = (
    run, film, table, transient, operating_map, duty, compare, sensitivity, tolerance, optimise, export, plan,
    diagnose,
    calibrate, reference, coefficients, reproduce, report, new, check, doctor, schema,
)  # fmt: skip
COMMANDS: dict[str, Command] = {module.COMMAND.name: module.COMMAND for module in _MODULES}


def run_command(words: Sequence[str]) -> int:
    """Run the command that the words name and return its exit code; exceptions of its parts pass through."""
    options = parse(words)
    if options.command is None:
        build_parser().print_help()
        return 0
    with pressures_of(options):
        return COMMANDS[options.command].run(options)


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Return the options of a command line; raise InputFaults with every unknown word."""
    _check_command(words)
    options, unknown = build_parser().parse_known_args(list(words))
    if unknown:
        # A word after an unknown option is most likely its value: not a second fault.
        reported = [word for word in unknown if word.startswith("-")] or unknown
        known = options_of(options.command)
        faults = [_unknown(known, word) for word in reported]
        more = COMMANDS[options.command].faults(options, words) if options.command else []
        raise InputFaults(COMMAND_LINE, faults + more)
    return options


class _Parser(argparse.ArgumentParser):
    """Argument parser that raises its errors as InputFaults."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:
        """Return the options and the unknown words; an argument that may be left out may stand behind options.

        Before Python 3.13 argparse treats such an argument as left out where an option stands before it.
        """
        found, unknown = super().parse_known_args(args, namespace)
        if len(unknown) == 1 and not unknown[0].startswith("-"):
            for action in self._actions:
                if action.nargs == "?" and not action.option_strings and getattr(found, action.dest) is None:
                    setattr(found, action.dest, unknown.pop())
                    break
        return found, unknown

    def error(self, message: str) -> NoReturn:
        """Raise InputFaults with argparse's message as a fault of the command line."""
        what, _, rest = message.partition(": ")
        if what == "the following arguments are required":
            fault = Fault(rest, "missing", f"see {self.prog} --help")
        elif "expected one argument" in rest:
            name = what.removeprefix("argument ").split("/")[-1]
            fault = Fault(name, "no value", "a value", f"one that starts with - is written {name}=VALUE")
        else:
            fault = Fault(what.removeprefix("argument "), rest or message, f"see {self.prog} --help")
        raise InputFaults(COMMAND_LINE, [fault])


class _Version(argparse.Action):
    """Print the version, which is read only here."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        from importlib.metadata import version

        show(f"swashfilm {version('swashfilm')}")
        parser.exit()


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    parser = _Parser(
        prog="swashfilm",
        description="Lubrication gaps and losses of swash-plate axial piston pumps.",
        epilog="Every command has its own --help. --debug shows the traceback of an internal error.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and end")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for name, command in COMMANDS.items():
        described = f"{command.summary[0].upper()}{command.summary[1:]}."
        own = commands.add_parser(name, help=command.summary, description=described, allow_abbrev=False)
        command.complete(own)
    return parser


def _check_command(words: Sequence[str]) -> None:
    name = next((word for word in words if not word.startswith("-")), None)
    if name is not None and not words[0].startswith("-") and name not in COMMANDS:
        fault = Fault("command", f"'{name}'", f"one of {', '.join(COMMANDS)}", nearest_choice(name, COMMANDS))
        raise InputFaults(COMMAND_LINE, [fault])


def options_of(name: str | None) -> list[str]:
    """Return the options of a command (None: of the program itself), help last."""
    if name is None:
        return ["--version", "--help"]
    parser = argparse.ArgumentParser(add_help=False)
    COMMANDS[name].complete(parser)
    return [*(option for action in parser._actions for option in action.option_strings), "--help"]


def _unknown(known: Sequence[str], word: str) -> Fault:
    """Return the fault of a word that no option or argument accepts."""
    kind = "unknown option" if word.startswith("-") else "one word too many"
    name = word.partition("=")[0]
    return Fault(name, kind, f"one of {', '.join(known)}", nearest_choice(name, known))
