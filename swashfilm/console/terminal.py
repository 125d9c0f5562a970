"""Output of the commands: tables with units, coloured on a terminal and plain in a log."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.output.run_folder import final_folder
from swashfilm.output.tables import aligned
from system.inputs.faults import printable

if TYPE_CHECKING:
    from swashfilm.output.result import Result


def show(text: str) -> None:
    """Print one line or block to the standard output."""
    sys.stdout.write(printable(text) + "\n")


def show_at_once(text: str) -> None:
    """Print one line to the standard output without delay, for programs that read it."""
    show(text)
    sys.stdout.flush()


def show_table(title: str, rows: Iterable[Sequence[str]]) -> None:
    """Print rows of (name, value with its unit): a rich table on a terminal, aligned plain lines elsewhere."""
    listed = [tuple(map(printable, row)) for row in rows]
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table(title=title, title_justify="left", show_header=False)
        for row in listed:
            table.add_row(*(Text(cell) for cell in row))
        Console().print(table)
        return
    show("\n".join([title, *aligned(listed)]))


def show_result(found: Result, place: Path, added: Sequence[str] = (), before: Sequence[str] = ()) -> None:
    """Print a run's tables, its warnings and those `added`, without those shown `before`, and its folder."""
    for title, rows in found.tables():
        show_table(title, rows)
    for warning in [*found.warnings, *added]:
        if warning not in before:
            show(f"warning: {warning}")
    show(f"results in {final_folder(place)}")
