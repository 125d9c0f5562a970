"""Command of the program: its name, its options, and its function."""

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from swashfilm.console.pressures import add_units_option
from system.inputs.faults import Fault


def no_faults(options: argparse.Namespace, words: Sequence[str]) -> list[Fault]:
    """Return no fault: the command checks only unknown options."""
    return []


@dataclass(frozen=True)
class Command:
    """A command of `swashfilm`.

    add: adds its options to a parser; run: runs it and returns the exit code; in_folder: it has -o DIR for its run
    folder, and with it --excel and --units; faults: further faults, reported together with unknown options.
    """

    name: str
    summary: str
    add: Callable[[argparse.ArgumentParser], None]
    run: Callable[[argparse.Namespace], int]
    in_folder: bool = True
    faults: Callable[[argparse.Namespace, Sequence[str]], list[Fault]] = no_faults

    def complete(self, parser: argparse.ArgumentParser) -> None:
        """Add every option of the command to a parser."""
        self.add(parser)
        if self.in_folder:
            parser.add_argument(
                "-o", "--output", type=Path, metavar="DIR", help="run folder (default runs/NAME-N, the next free N)"
            )
            parser.add_argument("--excel", action="store_true", help="write the tables also as a workbook, NAME.xlsx")
            add_units_option(parser)
