"""Draw docs/architecture.svg: the rooms of the packages by layer, and the ways of the data through them.

    python docs/site/house.py

Rooms and layers are those of the import-linter contracts in pyproject.toml.
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PICTURE = ROOT / "docs" / "architecture.svg"
PACKAGES = ("swashfilm", "diagnosis", "system", "gaps", "reynolds")
PURPOSE = {
    "swashfilm": "reads, writes, shows",
    "diagnosis": "recording to verdict",
    "system": "the pump",
    "gaps": "the three gaps",
    "reynolds": "one thin film",
}
RULE = "A room imports from rooms to its left and from packages below, never the other way."
OPENED = "swashfilm.runs"
"""The room whose own rooms are drawn."""


@dataclass(frozen=True)
class Way:
    """A way of the data: its name, colour and rooms in the order in which the data passes them."""

    name: str
    colour: str
    rooms: tuple[str, ...]


WAYS = (
    Way("film case", "#1764ab", (
        "swashfilm.case", "reynolds.problem", "reynolds.fem", "reynolds.equation", "reynolds.linear",
        "reynolds.solve", "reynolds.thermal", "swashfilm.runs.film", "swashfilm.output",
    )),
    Way("pump file", "#b4520a", (
        "system.inputs", "system.pump_file", "system.description", "system.pump", "system.films", "system.points",
        "system.maps", "swashfilm.runs.pump", "swashfilm.output",
    )),
    Way("gap", "#2d7d32", (
        "gaps.shapes", "gaps.walls", "gaps.films", "gaps.loads", "gaps.revolution", "system.films",
        "system.points",
    )),
    Way("recording", "#7b3294", (
        "diagnosis.recording", "diagnosis.checks", "diagnosis.study", "system.bench", "diagnosis.detect",
        "diagnosis.explain", "diagnosis.verdict", "diagnosis.report", "swashfilm.runs.diagnose",
    )),
)  # fmt: skip
WIDE, TALL, STEP_X, STEP_Y, LEFT, BAND, BADGE, ROWS = 94, 40, 102, 48, 118, 24, 7, 3


def rooms_of(package: str) -> list[list[str]]:
    """Rooms of a package by layer, lowest first; raises StopIteration for a package without contract."""
    linted = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    contract = next(one for one in linted["contracts"] if one.get("containers") == [package])
    layers = [[room.strip() for room in layer.split("|")] for layer in reversed(contract["layers"])]
    found = [[f"{package}.{room}" for room in layer if not room.startswith("__")] for layer in layers]
    opened = [list(_opened(layer)) for layer in found]
    return [layer[at : at + ROWS] for layer in opened for at in range(0, len(layer), ROWS)]


def _opened(layer: list[str]) -> Iterator[str]:
    for room in layer:
        inside = sorted((ROOT / room.replace(".", "/")).glob("*/__init__.py")) if room == OPENED else ()
        yield from (f"{room}.{one.parent.name}" for one in inside) if inside else (room,)


def picture() -> str:
    """The picture as SVG: a band a package, a column a layer, numbered badges for the ways."""
    parts: list[str] = []
    badges = _badges()
    top = 58
    right = LEFT
    for package in PACKAGES:
        columns = rooms_of(package)
        rows = max(map(len, columns))
        height = rows * STEP_Y + BAND
        right = max(right, LEFT + len(columns) * STEP_X)
        parts.append(_band(package, top, height))
        for at, column in enumerate(columns):
            for row, room in enumerate(column):
                here = badges.pop(room, [])
                parts.append(_room(room, LEFT + at * STEP_X, top + BAND / 2 + row * STEP_Y, here))
        top += height + 8
    if badges:
        raise ValueError(f"no such rooms: {', '.join(badges)}")
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {right + 12} {top + 20}" font-family="sans-serif">'
    ground = f'<rect width="{right + 12}" height="{top + 20}" fill="white"/>'
    foot = _text(LEFT, top + 8, RULE, 12)
    lines = [head, ground, _legend(), *(part.replace("RIGHT", str(right - 4)) for part in parts), foot, "</svg>"]
    return "\n".join(lines) + "\n"


def _badges() -> dict[str, list[tuple[str, int]]]:
    """Colour and number of every badge, by room."""
    found: dict[str, list[tuple[str, int]]] = {}
    for way in WAYS:
        for number, room in enumerate(way.rooms, start=1):
            found.setdefault(room, []).append((way.colour, number))
    return found


def _legend() -> str:
    parts = [_text(12, 30, "Ways of the data:", 13)]
    for at, way in enumerate(WAYS):
        x = LEFT + 40 + at * 150
        parts += [_badge(x, 26, way.colour, "1"), _badge(x + 17, 26, way.colour, "2"), _text(x + 32, 30, way.name, 13)]
    return "\n".join(parts)


def _band(package: str, top: float, height: float) -> str:
    frame = f'<rect x="6" y="{top}" width="RIGHT" height="{height}" rx="6" fill="#f3f5f6" stroke="#c9d1d6"/>'
    return "\n".join([
        frame, _text(16, top + 28, package, 15, "bold"), _text(16, top + 44, PURPOSE[package], 10),
    ])  # fmt: skip


def _room(room: str, x: float, y: float, badges: list[tuple[str, int]]) -> str:
    box = f'<rect x="{x}" y="{y}" width="{WIDE}" height="{TALL}" rx="4" fill="white" stroke="#8b979f"/>'
    name = _text(x + 6, y + 15, "/".join(room.split(".")[1:]), 12)
    shown = [
        _badge(x + 13 + at * (2 * BADGE + 3), y + 28, colour, str(number)) for at, (colour, number) in enumerate(badges)
    ]
    return "\n".join([box, name, *shown])


def _badge(x: float, y: float, colour: str, text: str) -> str:
    circle = f'<circle cx="{x}" cy="{y}" r="{BADGE}" fill="{colour}"/>'
    return circle + f'<text x="{x}" y="{y + 3.5}" font-size="10" fill="white" text-anchor="middle">{text}</text>'


def _text(x: float, y: float, text: str, size: int, weight: str = "normal") -> str:
    return f'<text x="{x}" y="{y}" font-size="{size}" font-weight="{weight}" fill="#1c2328">{escape(text)}</text>'


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8")
    sys.exit(0)
