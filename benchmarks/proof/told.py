"""Sections on recordings that are no cases: tables of their own, kept beside the outcomes."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from reynolds.numerics.files import replaced

from .store import program


@dataclass(frozen=True)
class Told:
    """A section of the page: title, paragraph, head and rows of a table, state of the program that made it."""

    title: str
    text: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    program: str


def keep_told(folder: Path, name: str, told: Told) -> None:
    """Write a section under its name, whole or not at all."""
    folder.mkdir(parents=True, exist_ok=True)
    with replaced(folder / f"{name}.json") as beside:
        beside.write_text(json.dumps(asdict(told), indent=1), encoding="utf-8")


def load_told(folder: Path, name: str) -> Told | None:
    """The section kept under a name, or None."""
    path = folder / f"{name}.json"
    if not path.exists():
        return None
    data = json.loads(path.read_text("utf-8"))
    return Told(**data | {"head": tuple(data["head"]), "rows": tuple(map(tuple, data["rows"]))})


def told(title: str, text: str, head: tuple[str, ...], rows: tuple[tuple[str, ...], ...]) -> Told:
    """A section made by the present program."""
    return Told(title, text, head, rows, program())
