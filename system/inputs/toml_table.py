"""Reading a TOML case: values with their units from tables, and every fault of the file at once."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Any, TypeVar

from reynolds.numerics.files import read_text
from system.inputs.faults import Fault, InputFaults, UnknownKey, key_lines, nearest_choice, nearest_path, stated
from system.inputs.units import with_point

Choice = TypeVar("Choice", bound=Enum)
DEEPEST = 20
"""Tables and lists inside each other, and names of a dotted key."""
_NAME = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')"""
_LONG_KEY = re.compile(rf"(?<![\w-]){_NAME}(?:[ \t]*+\.[ \t]*+{_NAME}){{{DEEPEST}}}")
_WIDEST = 2**63
_INNER_COMMA = re.compile(r"([\w-]+)\s*=\s*([+-]?\d+,\d+)(?=\s*[,}])")


def read_toml(path: Path) -> tuple[str, dict[str, Any]]:
    """The text of a TOML file and its tables; raises InputFaults for a file that is absent or no TOML."""
    try:
        text = read_text(path)
    except FileNotFoundError:
        fault = Fault("file", "no such file", "an existing TOML file", nearest_path(path))
        raise InputFaults(str(path), [fault]) from None
    except (OSError, UnicodeDecodeError) as reason:
        raise InputFaults(str(path), [Fault("file", f"cannot be read: {reason}", "TOML in UTF-8")]) from None
    return text, toml_tables(str(path), text)


def toml_tables(source: str, text: str) -> dict[str, Any]:
    """The tables of a TOML text; raises InputFaults, naming the `source`, for another text."""
    try:
        return parse_toml(text)
    except ValueError as reason:
        at = re.search(r"at line (\d+)", str(reason))
        lines = text.splitlines()
        number = int(at[1]) if at else len(lines)
        near = _with_points(lines[number - 1]) if lines else ""
        expected = "TOML 1.0, decimals with a point" if near else "TOML 1.0"
        fault = Fault("file", f"not valid TOML: {reason}", expected, near)
        raise InputFaults(source, [fault], {"file": number}) from None


def _with_points(line: str) -> str:
    """The probable meaning of a value of a line that has a decimal comma, also within braces; empty without one."""
    value = line.partition("=")[2].partition("#")[0].strip()
    if not value.startswith("{"):
        return with_point(value)
    found = _INNER_COMMA.search(value)
    return f"{found[1]} = {with_point(found[2])}" if found else ""


def parse_toml(text: str) -> dict[str, Any]:
    """The tables of a TOML text.

    Raises ValueError for another text, for one nested more than DEEPEST times, and for a whole number of more than 64
    bits, which TOML does not have.
    """
    if found := _LONG_KEY.search(text):  # the parser needs time and memory by the square of a key's names
        raise ValueError(f"a key of more than {DEEPEST} names (at line {_line(text, found.start())})")
    try:
        tables = tomllib.loads(text)
    except RecursionError:
        raise ValueError("nested too deep") from None
    except tomllib.TOMLDecodeError:
        raise
    except ValueError:  # Python's limit on the digits of a whole number
        raise ValueError("a whole number of thousands of digits") from None
    _hold_values(tables)
    return tables


def _hold_values(tables: dict[str, Any]) -> None:
    """Raise ValueError for a value nested too deep, or a whole number that is too large; each with its key."""
    todo: list[tuple[str, Any, int]] = [(key, value, 1) for key, value in tables.items()]
    while todo:
        path, value, depth = todo.pop()
        if depth > DEEPEST:
            raise ValueError(f"{path} is nested more than {DEEPEST} times")
        if isinstance(value, dict):
            todo += [(f"{path}.{key}", one, depth + 1) for key, one in value.items()]
        elif isinstance(value, list):
            todo += [(path, one, depth + 1) for one in value]
        elif isinstance(value, int) and not -_WIDEST <= value < _WIDEST:
            raise ValueError(f"{path} is a whole number of more than 64 bits")


def _line(text: str, place: int) -> int:
    return text.count("\n", 0, place) + 1


def fault_lines(text: str, faults: Iterable[Fault]) -> dict[str, int]:
    """Line of every fault's path in a TOML text, or of the entry or table that holds it."""
    lines = key_lines(text)
    for fault in faults:
        path = fault.path.partition("[")[0]
        while path and path not in lines:
            path = path.rpartition(".")[0]
        if path:
            lines[fault.path] = lines[path]
    return lines


def quoted(text: str) -> str:
    """A TOML basic string of one line."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


@dataclass
class Table:
    """One table being read: returns SI values and collects its faults.

    `faults` is shared by all tables of a file. A requested key is known; `close` adds faults for the others.
    """

    path: str
    values: Mapping[str, Any]
    faults: list[Fault]
    asked: list[str] = field(default_factory=list)

    def get(self, key: str) -> Any:
        """The raw value of a key, None if it is absent; the key is known from then on."""
        if key not in self.asked:
            self.asked.append(key)
        return self.values.get(key)

    def fault(self, key: str, found: str, expected: str, nearest: str = "") -> None:
        """Add a fault of one key."""
        self.faults.append(Fault(self.name(key), found, expected, nearest))

    def name(self, key: str) -> str:
        """Path of a key in the file."""
        return f"{self.path}.{key}" if self.path else key

    def table(self, key: str, *, needed: str = "") -> Table | None:
        """The table under a key, or None: with a fault where it is no table, or absent and `needed` (why)."""
        raw = self.get(key)
        if isinstance(raw, dict):
            return Table(self.name(key), raw, self.faults)
        if raw is not None or needed:
            self.fault(key, stated(raw), f"a table [{self.name(key)}] {needed}".rstrip())
        return None

    def choice(self, key: str, kind: type[Choice], default: Choice | None = None) -> Choice | None:
        """One of an Enum's values; None after a fault."""
        raw = self.get(key)
        if raw is None and default is not None:
            return default
        for member in kind:
            if raw == member.value:
                return member
        names = [str(member.value) for member in kind]
        nearest = nearest_choice(str(raw or ""), names)
        self.fault(key, stated(raw), f"one of {', '.join(map(repr, names))}", nearest)
        return None

    def close(self) -> None:
        """Add a fault for every key that was not requested, with the nearest known one."""
        for key in self.values:
            if key not in self.asked:
                self.faults.append(UnknownKey.among(self.name(key), key, self.asked))
