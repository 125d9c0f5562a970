"""Rows of cells, as text files and workbooks hold them, to named columns of numbers."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from datetime import datetime
from functools import cache
from itertools import takewhile

import numpy as np

from diagnosis.recording.tables.stamps import seconds_of
from diagnosis.recording.tables.table import TableColumns, TableFault
from reynolds.numerics.arrays import Array

GAPS = frozenset({"", "-", "--", "nan", "na", "n/a", "null", "none", "#n/a", "inf", "-inf"})
"""Cells, in small letters, that mean no reading."""
SUMMARIES = frozenset({
    "mean", "average", "avg", "median", "min", "minimum", "max", "maximum", "std", "stdev", "std dev", "sigma",
    "rms", "sum", "total", "count", "range", "mittel", "mittelwert", "summe", "streuung", "moyenne", "media",
    "promedio",
})  # fmt: skip
"""Names of summary rows below a table, which are no readings, in small letters."""
_POINT = re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+|\d{1,3}(,\d{3})+\.\d*)(e[+-]?\d+)?\s*", re.IGNORECASE)
_COMMA = re.compile(r"\s*[+-]?(\d+,?\d*|,\d+|\d{1,3}(\.\d{3})+,\d*)(e[+-]?\d+)?\s*", re.IGNORECASE)
_NUMBER = {".": _POINT, ",": _COMMA}
_PARTED = {".": re.compile(r"\s*[+-]?[1-9]\d{0,2}(,\d{3})+\s*"), ",": re.compile(r"\s*[+-]?[1-9]\d{0,2}(\.\d{3})+\s*")}
"""Whole numbers with parted thousands, by the decimal sign of the table."""
_BARE_THOUSANDS = re.compile(r"\s*[+-]?\d{4}")
_OTHER = {".": ",", ",": "."}


def columns_of(rows: Iterable[Sequence[object]], decimal: str) -> TableColumns:
    """Return the columns of rows of cells: text, numbers, times or None.

    The head is the first row of the most frequent length that is text throughout; of several such rows one below the
    other that with the most names, since titles of groups and units are fewer. Rows above it are left out, and a row
    below it without any number (units, as loggers write them), and rows at the end that begin with the name of a
    summary (`SUMMARIES`), where no row above does. A cell that is no number is nan; a column of dates or times of day
    becomes seconds from its first. Raises TableFault for no head or a name that occurs in it twice.
    """
    table = [[_bare(cell) for cell in row] for row in rows]
    table = [row for row in table if any(cell != "" for cell in row)]
    if not table:
        raise TableFault("an empty table", "a head with column names and rows of numbers")
    width = Counter(len(row) for row in table).most_common(1)[0][0]
    start = next((k for k, row in enumerate(table) if len(row) == width and _is_head(row, decimal)), None)
    if start is None:
        raise TableFault(f"no head in rows of {width} cells", "a row of column names above the numbers")
    titles = list(takewhile(lambda row: len(row) == width and _is_head(row, decimal), table[start:]))
    start += max(range(len(titles)), key=lambda k: len({cell for cell in titles[k] if cell}))
    head = [str(cell).strip() for cell in table[start]]
    if twice := [name for name, count in Counter(head).items() if count > 1 and name]:
        raise TableFault(f"the column {twice[0]!r} twice", "every column name once")
    body, notes = table[start + 1 :], []
    units: dict[str, str] = {}
    if start:
        notes.append(f"{start} row{'s' * (start > 1)} above the head left out")
    if body and all(_number(cell, decimal) is None for cell in body[0]) and any(str(c).strip() for c in body[0]):
        notes.append(f"the row below the head holds no number and is left out: {', '.join(map(str, body[0]))}")
        units |= {name: str(cell).strip("[]() ") for name, cell in zip(head, body[0], strict=False) if cell}
        body = body[1:]
    if below := _summaries(body):
        names = ", ".join(str(next(filter(None, row))) for row in body[-below:])
        notes.append(f"{below} rows below the readings left out: {names}")
        body = body[:-below]
    if ragged := [k for k, row in enumerate(body, start=1) if len(row) != width]:
        raise TableFault(f"row {ragged[0]} below the head with {len(body[ragged[0] - 1])} cells", f"{width} cells")
    values, words, signs = {}, {}, cache(lambda: decimal_cells(cell for row in body for cell in row))
    for place, name in enumerate(head):
        if name:
            cells = [row[place] for row in body]
            values[name], note = _column(cells, decimal, signs)
            notes += [f"column {name!r}: {note}"] if note else []
            if np.isnan(values[name]).all():
                words[name] = tuple(map(str, cells))
    return TableColumns(values, tuple(notes), units, words)


def _summaries(body: Sequence[Sequence[object]]) -> int:
    """Number of rows at the end that are sums or means of those above."""
    named = [str(next(filter(None, row), "")).lower().rstrip(":.") in SUMMARIES for row in body]
    count = next((k for k, one in enumerate(reversed(named)) if not one), len(named))
    return count if not any(named[: len(named) - count]) and count < len(named) else 0


def is_number(cell: str, decimal: str) -> bool:
    """True for the text of a number with this decimal sign; the other one may separate its thousands: 1.499,8."""
    return _NUMBER[decimal].fullmatch(cell) is not None


def decimal_cells(cells: Iterable[object]) -> Mapping[str, int]:
    """Number of cells that are numbers with one decimal sign alone, by that sign: not 1.500, which may be 1500."""
    texts = [cell for cell in cells if isinstance(cell, str)]
    return {
        sign: sum(is_number(text, sign) and not (is_number(text, other) or _is_parted(text, other)) for text in texts)
        for sign, other in _OTHER.items()
    }


def _is_parted(cell: object, decimal: str) -> bool:
    """True for the text of a whole number with parted thousands: 1.500 where the decimal sign is a comma."""
    return isinstance(cell, str) and _OTHER[decimal] in cell and _PARTED[decimal].fullmatch(cell) is not None


def _bare(cell: object) -> object:
    """A cell, with an empty text for None and nan."""
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return ""
    return cell.strip() if isinstance(cell, str) else cell


def _is_head(row: Sequence[object], decimal: str) -> bool:
    """True for a row of names: text in most cells, and no number."""
    named = [cell for cell in row if isinstance(cell, str) and cell]
    return len(named) > len(row) / 2 and all(_number(cell, decimal) is None for cell in row)


def _number(cell: object, decimal: str) -> float | None:
    if isinstance(cell, (bool, datetime)):
        return None
    if isinstance(cell, (int, float)):
        return float(cell)
    text = str(cell)
    if not is_number(text, decimal) and not _is_parted(text, decimal):
        return None
    return float(text.replace(".", "").replace(",", ".") if decimal == "," else text.replace(",", ""))


def _column(cells: Sequence[object], decimal: str, signs: Callable[[], Mapping[str, int]]) -> tuple[Array, str]:
    """A column's numbers, and notes on it; signs: `decimal_cells` of the table."""
    numbers = [_number(cell, decimal) for cell in cells]
    parted = [_is_parted(cell, decimal) for cell in cells]
    if any(parted) and not _parts_thousands(cells, decimal, signs()):
        numbers = [None if apart else number for number, apart in zip(numbers, parted, strict=True)]
    has_number = any(number is not None for number in numbers)
    if not has_number and (told := seconds_of(cells)) is not None:
        return told[0], f"{told[1]}, taken as seconds from the first"
    odd = sorted({str(c) for c, n in zip(cells, numbers, strict=True) if n is None and str(c).lower() not in GAPS})
    count = sum(n is None and str(c).lower() not in GAPS for c, n in zip(cells, numbers, strict=True))
    words = f"{count} cells that are no number taken as gaps ({', '.join(odd[:3])})" if odd else ""
    return np.array([math.nan if number is None else number for number in numbers], dtype=float), words


def _parts_thousands(cells: Sequence[object], decimal: str, signs: Mapping[str, int]) -> bool:
    """True for a column that parts the thousands of its whole numbers.

    No cell with digits has four in a row before its decimal sign, or is a number of another form; the decimal sign is
    that of the table by other cells, or whole numbers below a thousand stand beside.
    """
    texts = [cell for cell in cells if isinstance(cell, str) and any(sign.isdigit() for sign in cell)]
    whole = [text for text in texts if not _is_parted(text, decimal)]
    fits = all(is_number(text, decimal) and not _BARE_THOUSANDS.match(text) for text in whole)
    shown = signs[decimal] > 0 or any(text.strip("+- ").isdigit() for text in whole)
    return fits and shown and signs[decimal] >= signs[_OTHER[decimal]]
