"""A pump file written in full: each value with its unit and meaning, the assumed ones with reason and tolerance."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from system.inputs.sections.fields import fields_of
from system.inputs.sections.json_schema import described
from system.inputs.toml_table import quoted
from system.pump_file.scaled.completed import OPEN, SCALED, TAKEN, WIDE, Completed
from system.pump_file.tables import TABLES

_MARKS = {
    SCALED: "assumed: scaled from ref90",
    TAKEN: "assumed: ref90's",
    WIDE: "assumed: wide",
    OPEN: "assumed: of an open circuit",
}
_FILMS = ("piston.radial_clearance", "slipper.film_thickness", "valve_plate.film_thickness")
_TOLERANCES = {
    **dict.fromkeys(_FILMS, "film_thickness"),
    "piston.eccentricity_ratio": "eccentricity_ratio",
    "oil.bulk_modulus": "bulk_modulus",
    "pump.dead_volume": "dead_volume",
    "ports.flow_coefficient": "flow_coefficient",
    **{f"friction.{pair}": "friction" for pair in ("piston_cylinder", "piston_slipper_socket", "slipper_swash_plate")},
    "friction.valve_plate_cylinder": "friction",
    "friction.ball_guide_retainer": "guide_friction",
    **{f"friction.{end}_bearing": "bearing_friction" for end in ("front", "rear")},
}
"""Key of [tolerance] with one sigma of a value."""
_ABSOLUTE = "eccentricity_ratio"
_COLUMN = 44  # of the comments


def written_pump(pump: Completed, head: Sequence[str]) -> str:
    """Return the pump file of completed tables, with a head of comments; it loads to the pump of these tables."""
    marks = {one.path: _MARKS[one.reason] for one in pump.assumptions}
    rows = [*(f"# {line}".rstrip() for line in head), f"name = {quoted(pump.tables['name'])}"]
    rows.append(f"format = {pump.tables['format']}")
    for name, model in TABLES.items():
        if name in pump.tables:
            rows += ["", f"[{name}]{'':{max(1, _COLUMN - len(name) - 2)}}# {_title(model)}"]
            rows += _rows(name, model, pump.tables, marks)
    return "\n".join(rows) + "\n"


def _rows(name: str, model: type[Any], tables: Mapping[str, Any], marks: Mapping[str, str]) -> Iterator[str]:
    """Yield the lines of one table."""
    fields = fields_of(model)
    for key, value in tables[name].items():
        meaning = fields[key].meaning if key in fields else "in place of the two viscosities"
        path = f"{name}.{key}"
        inner = next(iter(value), "") if isinstance(value, dict) else ""
        mark = marks.get(f"{path}.{inner}" if inner else path, "")
        words = "; ".join(part for part in (meaning, mark + _sigma(path, tables["tolerance"], mark)) if part)
        yield f"{f'{key} = {_text(value)} ':{_COLUMN}}" + (f"# {words}" if words else "")


def _title(model: type[Any]) -> str:
    """Return the meaning of a table, the first clause of its docstring."""
    return re.split(r"[;,] |(?<![ .])\. ", described(model).rstrip("."), maxsplit=1)[0]


def _sigma(path: str, tolerance: Mapping[str, Any], mark: str) -> str:
    """Return one sigma of an assumed value, where [tolerance] has one of it."""
    key = _TOLERANCES.get(path)
    if not mark or key is None:
        return ""
    return f" +- {tolerance[key]:g}" if key == _ABSOLUTE else f" +- {tolerance[key]:.0%}"


def _text(value: object) -> str:
    """Return a value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_text(own)}" for key, own in value.items()) + " }"
    return quoted(value) if isinstance(value, str) else str(value)
