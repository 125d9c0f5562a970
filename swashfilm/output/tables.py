"""Tables of text: title and rows, every number with its unit."""

from collections.abc import Sequence

Table = tuple[str, Sequence[Sequence[str]]]
"""Title and rows of cells."""


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return rows of text as lines of aligned columns, two blanks before and between."""
    columns = max((len(row) for row in rows), default=0)
    widths = [max(len(row[k]) for row in rows if len(row) > k) for k in range(columns)]
    return [
        "  " + "  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=False)).rstrip() for row in rows
    ]
