"""Tables in text files: separator and decimal sign are found from the text, with a note, unless stated."""

from __future__ import annotations

import csv
import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections import Counter
from contextlib import suppress
from dataclasses import replace

from diagnosis.recording.tables.cells import columns_of, decimal_cells, is_number
from diagnosis.recording.tables.table import TableColumns, TableFault, TableSource, foreign
from reynolds.numerics.files import LARGEST_DATA, read_bounded

SEPARATORS = {";": "semicolon", "\t": "tab", ",": "comma", "|": "bar"}
_SIGNS = {".": "point", ",": "comma"}
_BEYOND_ASCII = re.compile(rb"[\x80-\xff]+")
LOOKED_AT = 200  # lines from which the form is found


def read_text(source: TableSource) -> TableColumns:
    """Return the columns of a text table; lines that begin with # are left out.

    The separator is the one that splits most lines into the same number of cells, at least two (else the table has one
    column); the decimal sign the one with which more cells are numbers, a comma only if it is no separator. Raises
    TableFault for text that cannot be decoded or a sign that is neither point nor comma.
    """
    text, encoding = _decoded(source)
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    with foreign(source, "a text table"):
        separator = source.separator or _separator(lines[:LOOKED_AT])
        decimal = source.decimal or _decimal(lines[:LOOKED_AT], separator)
    if decimal not in _SIGNS or decimal == separator:
        raise TableFault(f"decimal = {decimal!r}, separator = {separator!r}", "a point or a comma, and another sign")
    if len(separator) != 1:
        raise TableFault(f"separator = {separator!r}", "one sign, such as ';'")
    with foreign(source, "a text table"):
        columns = columns_of(csv.reader(lines, delimiter=separator), decimal)
    found = []
    if not source.separator:
        found.append(f"cells parted by {SEPARATORS[separator]}")
    if not source.decimal:
        found.append(f"decimal {_SIGNS[decimal]}")
    if encoding != "utf-8-sig":
        found.append(f"read as {encoding}, since it is no UTF-8")
    plain = found == ["cells parted by comma", "decimal point"]
    return columns if plain or not found else replace(columns, notes=(", ".join(found), *columns.notes))


def _decoded(source: TableSource) -> tuple[str, str]:
    """The text of a file, and its encoding: by its mark, as UTF-8, else by its bytes beyond ASCII.

    In GBK these are pairs; in Latin-1 no four follow each other.
    """
    raw = read_bounded(source.path, LARGEST_DATA)
    if raw.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        try:
            return raw.decode("utf-16"), "utf-16"
        except UnicodeDecodeError:
            raise TableFault(f"'{source.path.name}', cut-off UTF-16", "a text table in UTF-8") from None
    if b"\0" in raw[:4096]:
        raise TableFault(f"'{source.path.name}', which is no text", "a text table in UTF-8")
    try:
        return raw.decode("utf-8-sig"), "utf-8-sig"
    except UnicodeDecodeError:
        pass
    runs = [len(run) for run in _BEYOND_ASCII.findall(raw)]
    if max(runs) >= 4 and not any(run % 2 for run in runs):
        with suppress(UnicodeDecodeError):
            return raw.decode("gb18030"), "gb18030"
    return raw.decode("latin-1"), "latin-1"


def _separator(lines: list[str]) -> str:
    """The sign that splits most lines equally; of equal ones the first of SEPARATORS."""

    def agreement(sign: str) -> int:
        counts = Counter(len(row) for row in csv.reader(lines, delimiter=sign))
        return max((count for cells, count in counts.items() if cells > 1), default=0)

    best = max(SEPARATORS, key=agreement)
    return best if agreement(best) else ","


def _decimal(lines: list[str], separator: str) -> str:
    """The decimal sign with which alone more cells are numbers; of equal ones that with which more cells are."""
    if separator == ",":
        return "."
    cells = [cell for row in csv.reader(lines, delimiter=separator) for cell in row if cell.strip()]
    alone, point, comma = decimal_cells(cells), *(sum(is_number(cell, sign) for cell in cells) for sign in (".", ","))
    return "," if (alone[","], comma) > (alone["."], point) else "."
