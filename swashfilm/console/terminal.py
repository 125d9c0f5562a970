"""What the commands print: tables with units, coloured on a terminal and plain in a log."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence


def show(text: str) -> None:
    """Print one line or block to the standard output."""
    sys.stdout.write(text + "\n")


def show_table(title: str, rows: Iterable[Sequence[str]]) -> None:
    """Print rows of (what, value with its unit): a rich table on a terminal, aligned plain lines elsewhere."""
    listed = [tuple(row) for row in rows]
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table(title=title, title_justify="left", show_header=False)
        for row in listed:
            table.add_row(*(Text(cell) for cell in row))
        Console().print(table)
        return
    show(title)
    columns = max((len(row) for row in listed), default=0)
    widths = [max(len(row[k]) for row in listed if len(row) > k) for k in range(columns)]
    for row in listed:
        show("  " + "  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=False)).rstrip())
