"""Sphinx extension: the plain prose of docstrings as reStructuredText."""

from __future__ import annotations

import re
from itertools import groupby
from typing import Any

CODE = re.compile(r"`+([^`]+)`+")
MARKUP = re.compile(r"([*|\\`_])")


def setup(app: Any) -> dict[str, bool]:
    """Register the conversion with autodoc."""
    app.connect("autodoc-process-docstring", convert)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def convert(_app: Any, _kind: str, _name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Replace the lines of a docstring by reStructuredText with the same words.

    Text in backquotes becomes code, an indented block becomes a literal block, and characters that
    reStructuredText would read as markup are escaped.
    """
    found: list[str] = []
    for indented, group in groupby(lines, lambda line: line.startswith("  ")):
        block = list(group)
        found += ["", "::", "", *block, ""] if indented else plain("\n".join(block)).split("\n")
    lines[:] = found


def plain(text: str) -> str:
    """Prose with its code marked and its other special characters escaped."""
    parts = CODE.split(text)
    parts[::2] = [MARKUP.sub(r"\\\1", prose) for prose in parts[::2]]
    parts[1::2] = [rf"\ ``{' '.join(code.split())}``\ " for code in parts[1::2]]
    return "".join(parts)
