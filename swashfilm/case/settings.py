"""Values that a command line sets in the tables of a case file."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from system.inputs.toml_table import read_toml

STEP = re.compile(r"([^\[\].]+)(?:\[(\d+)\])?")
"""A step of a dotted key: a name, and the entry of a list."""


def read_set(path: Path, values: Mapping[str, object]) -> tuple[str, dict[str, Any]]:
    """Return text and tables of a case file with other values of dotted keys; raise InputFaults as `read_toml`.

    Values are as written in a file; comments at the end of the text list them.
    """
    text, tables = read_toml(path)
    for key, value in values.items():
        put(tables, key, value)
    return with_comments(text, values), tables


def with_comments(text: str, values: Mapping[str, object]) -> str:
    """Return the text of a file with a comment at its end for each value that the command line sets."""
    if not values:
        return text
    return "".join([f"{text.rstrip()}\n", *(f"# command line: {key} = {value}\n" for key, value in values.items())])


def put(tables: dict[str, Any], key: str, value: Any) -> None:
    """Set a dotted key, such as `film.velocity[0]`; create the tables above it."""
    at: Any = tables
    steps = [match.groups() for step in key.split(".") if (match := STEP.fullmatch(step))]
    for name, _ in steps[:-1]:
        if not isinstance(at.get(name), dict):
            at[name] = {}
        at = at[name]
    name, index = steps[-1]
    if index is None:
        at[name] = value
    elif isinstance(at.get(name), list) and int(index) < len(at[name]):
        at[name][int(index)] = value
    else:
        # Filled up so that the reader of the key names the missing entries.
        at[name] = [None] * int(index) + [value]
