"""Faults of an input, for its author: where, what was found, what was expected, what to try."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path


@dataclass(frozen=True)
class Fault:
    """One fault: `path` in the file (`section.key`), what was found, what was expected.

    `nearest` names the nearest valid choice, or the remedy; empty without one.
    """

    path: str
    found: str
    expected: str
    nearest: str = ""

    @property
    def line(self) -> str:
        """Place, finding and expectation in one line."""
        return f"{self.path}: {self.found}, expected {self.expected}"


@dataclass(frozen=True)
class UnknownKey(Fault):
    """A key that its table does not have."""

    @classmethod
    def among(cls, path: str, key: str, known: Sequence[str]) -> UnknownKey:
        """The fault of a key at a path of the file, with those that the table has and the nearest of them."""
        return cls(path, "unknown key", f"one of {', '.join(known)}", nearest_choice(key, known))


class InputFaults(Exception):
    """All faults of one input at once. `source` is the file, the built-in name or the command line.

    `lines` gives the line of a path in the file, where it is known; None for a path that is not in the file.
    """

    def __init__(self, source: str, faults: Sequence[Fault], lines: Mapping[str, int | None] | None = None) -> None:
        self.source = source
        self.faults = tuple(faults)
        self.lines = dict(lines or {})
        super().__init__(source, self.faults)

    def __str__(self) -> str:
        """One block of text: the source, then each fault with its line, in the order of the file."""
        count = f"{len(self.faults)} fault" + ("s" if len(self.faults) != 1 else "")
        ordered = sorted(self.faults, key=lambda fault: self._line(fault) or math.inf)
        return "\n".join([f"{self.source}: {count}", *(self._block(fault) for fault in ordered)])

    def _line(self, fault: Fault) -> int | None:
        """Return the line of the path, or of the section that it is missing from."""
        section = fault.path.rpartition(".")[0]
        return self.lines.get(fault.path, self.lines.get(section))

    def _block(self, fault: Fault) -> str:
        line = self._line(fault)
        rows = [
            f"  {_short(fault.path)}" + (f" (line {line})" if line else ""),
            f"    found:    {_short(fault.found)}",
            f"    expected: {fault.expected}",
        ]
        if fault.nearest:
            rows.append(f"    try:      {_short(fault.nearest)}")
        return "\n".join(rows)


def stated(value: object) -> str:
    """Return a value as its file states it: "missing" for None."""
    return "missing" if value is None else repr(value)


_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
LONGEST = 600
"""Largest number of characters of a found value in a message."""
SHORT = 4
"""Characters of a name that is short."""


def printable(text: str) -> str:
    """Return a text with its control signs written out, so that a terminal shows them and does not execute them."""
    return _CONTROL.sub(lambda sign: ascii(sign[0])[1:-1], text)


def one_line(text: object) -> str:
    """Return a text as one line without control signs, as a file of another program may hold it."""
    return printable(" ".join(str(text).split()))


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 40]} .. ({len(text)} characters)"


def nearest_choice(found: str, choices: Iterable[str]) -> str:
    """Return the choice spelt most like `found` (any case), or an empty string without a similar one."""
    if len(found) > LONGEST:
        return ""
    by_lower = {choice.lower(): choice for choice in choices}
    matches = get_close_matches(found.lower(), by_lower, n=1, cutoff=0.6)
    return by_lower[matches[0]] if matches else ""


def nearest_path(path: Path) -> str:
    """Return the path of a file or folder spelt most like one that does not exist, or an empty string.

    Each part of it that is missing is the nearest name in the folder before it; without a similar one, the path ends
    there.
    """
    try:
        return _nearest_path(path)
    except (OSError, ValueError):  # an invalid name, or a folder without permission to list it
        return ""


def _named_like(folder: Path, name: str) -> list[str]:
    """Return the names in a folder that are spelt like one without their suffixes, which many files share.

    Of a short name half suffices, if both begin alike: wear for worn.
    """
    beside = {item.name: item.stem.lower() for item in folder.iterdir()} if folder.is_dir() else {}
    stem = Path(name).stem.lower()
    short = len(stem) <= SHORT
    return [
        one
        for one, other in beside.items()
        if get_close_matches(stem, [other], cutoff=0.5 if short and other[:1] == stem[:1] else 0.6)
    ]


def _nearest_path(path: Path) -> str:
    found, mended = Path(path.anchor), False
    for part in path.parts[1:] if path.anchor else path.parts:
        there = found / part
        if not there.exists():
            near = nearest_choice(part, _named_like(found, part))
            if not near:
                break
            there, mended = found / near, True
        found = there
    return str(found) if mended else ""


_HEADER = re.compile(r"^\s*\[\s*([\w.\-]+)\s*\]")
_LISTED = re.compile(r"^\s*\[\[\s*([\w.\-]+)\s*\]\]")
_KEY = re.compile(r"^\s*([\w.\-]+)\s*=")


def key_lines(text: str) -> dict[str, int]:
    """Return the line number (from 1) of every `section` and `section.key` of a TOML text.

    Plain tables with bare keys, one key a line, are found, those of a list as `section.1`, `section.2`, ..; a path
    written otherwise has no entry.
    """
    lines: dict[str, int] = {}
    listed: Counter[str] = Counter()
    section = ""
    for number, line in enumerate(text.splitlines(), start=1):
        if header := _HEADER.match(line):
            section = header[1]
            lines.setdefault(section, number)
        elif header := _LISTED.match(line):
            listed[header[1]] += 1
            section = f"{header[1]}.{listed[header[1]]}"
            lines[section] = number
        elif key := _KEY.match(line):
            lines.setdefault(f"{section}.{key[1]}" if section else key[1], number)
    return lines
