"""Command `swashfilm new`: writes a commented file to start from, of a pump, a recording or a film."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, option_value
from swashfilm.console.terminal import show
from system.inputs.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from swashfilm.cli.new.file import NewFile

KINDS = ("pump", "recording", "film")
_OF_PUMP = {
    "--displacement": ("71cm3/rev", "displacement of a turn"),
    "--pistons": ("9", "number of pistons"),
    "--oil": ("ISO VG 46", "ISO grade, or the viscosities at 40 and 100 degC: '46 mm2/s, 6.8 mm2/s'"),
    "--speed": ("2600rpm", "rated speed"),
    "--pressure": ("350bar", "rated pressure, gauge"),
}
_OF = {
    "pump": (*_OF_PUMP, "--circuit", "--output"),
    "recording": ("--circuit", "--part", "--output"),
    "film": ("--output",),
}
"""Options of each kind of file."""


def run_new_command(options: argparse.Namespace) -> int:
    """Run `swashfilm new` and return its exit code; raise InputFaults with every fault of the options."""
    file = new_file(options, asks=sys.stdin.isatty() and sys.stdout.isatty())
    file.write()
    show(f"{file.path} is written")
    for line in file.told:
        show(line)
    return 0


def new_file(options: argparse.Namespace, asks: bool = False) -> NewFile:
    """Return the file of a command line, not yet written; raise InputFaults with every fault of the options.

    asks: values of a pump that the options lack are requested on the terminal; else each is a fault.
    """
    if options.kind not in KINDS:
        nearest = nearest_choice(options.kind, KINDS)
        raise InputFaults(COMMAND_LINE, [Fault("WHAT", repr(options.kind), f"one of {', '.join(KINDS)}", nearest)])
    from swashfilm.cli.new.file import place_faults

    path, option = _place(options)
    faults = [*_beside(options), *place_faults(path, option)]
    found = _found(options, path, faults, asks)
    if faults or found is None:
        raise InputFaults(COMMAND_LINE, faults)
    return found


def _found(options: argparse.Namespace, path: Path, faults: list[Fault], asks: bool) -> NewFile | None:
    """Return the file of a kind; None with faults added."""
    if options.kind == "film":
        from swashfilm.cli.new.film import new_film

        return new_film(options.of, path, faults)
    if options.kind == "recording":
        from swashfilm.cli.new.recording import new_recording

        return new_recording(options.of, options.part, options.circuit, path, faults)
    from swashfilm.cli.new.pump import new_pump

    if options.of is not None:
        faults.append(Fault("OF", repr(options.of), "nothing behind 'new pump'", f"-o {Path(options.of).stem}.toml"))
    given = {option: option_value(options, option) for option in (*_OF_PUMP, "--circuit")}
    return new_pump(given, path, faults, asks)


def _place(options: argparse.Namespace) -> tuple[Path, str]:
    """Return the place of the file, and the argument that states it."""
    if options.kind == "recording":
        own = options.output is not None
        return options.output or Path(options.of or ".").parent / "recording.toml", "--output" if own else "TABLE"
    usual = "pump" if options.kind == "pump" else options.of or "film"
    return options.output or Path(f"{usual}.toml"), "--output"


def _beside(options: argparse.Namespace) -> list[Fault]:
    """Return the faults of options that are of another kind of file."""
    own = _OF[options.kind]
    others = dict.fromkeys(option for known in _OF.values() for option in known if option not in own)
    return [
        Fault(option, f"an option beside {options.kind}", f"no {option}, or one of {', '.join(own)}")
        for option in others
        if option_value(options, option) is not None
    ]


def _faults(options: argparse.Namespace, words: Sequence[str]) -> list[Fault]:
    """Return the faults of the options, without those of unknown ones."""
    try:
        new_file(options)
    except InputFaults as reason:
        return list(reason.faults)
    return []


def _add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("kind", metavar="WHAT", help=f"one of {', '.join(KINDS)}")
    what = "recording: the table (.csv, .xlsx, .tdms, .mf4, .mat, .parquet); film: its kind, such as step_pad"
    command.add_argument("of", nargs="?", metavar="OF", help=what)
    for option, (example, words) in _OF_PUMP.items():
        command.add_argument(option, metavar=f"'{example}'" if " " in example else example, help=f"pump: {words}")
    command.add_argument("--circuit", metavar="{open,closed}", help="pump, recording: the circuit")
    command.add_argument("--part", metavar="NAME", help="recording: sheet, group or variable of a table with several")
    what = "the file (default pump.toml, KIND.toml); a recording's lies beside its table (default recording.toml)"
    command.add_argument("-o", "--output", type=Path, metavar="FILE.toml", help=what)


COMMAND = Command(
    "new", "write a commented file to start from: a pump, a recording or a film", _add_options, run_new_command,
    in_folder=False, faults=_faults,
)  # fmt: skip
