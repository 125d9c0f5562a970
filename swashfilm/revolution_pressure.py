"""The pressure of a chamber over the turn, as a case gives it: the pump's own cycle, rows, a file, one value."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gaps.course import TURN, Course
from reynolds.mesh import Array
from swashfilm.case_table import Table, quoted
from system.chamber_kernel import CAVITY_PRESSURE
from system.faults import nearest_choice
from system.instants import Rotor
from system.lumped import lumped_point, piston_motion
from system.units import Dimension, QuantityError, format_quantity, parse_quantity

CYCLE = "cycle"
LEAST_ROWS = 4
_EXPECTED = (
    f'"{CYCLE}", a pressure, pressures at equal steps from 0 deg, rows of angle and pressure, or a CSV file'
)
_COLUMNS = {"shaft_angle": Dimension.ANGLE, "chamber_pressure": Dimension.PRESSURE}
_SHORT = {"angle": "shaft_angle", "pressure": "chamber_pressure"}
Row = tuple[float, float]


@dataclass(frozen=True)
class ChamberPressure:
    """Rows of shaft angle (rad) and pressure (Pa) of one chamber; none: the pump's own lumped cycle.

    `text` is what gives it in a case. Between rows it is a `gaps.course.Course`; one row holds over the turn.
    """

    text: str
    rows: tuple[Row, ...] = ()

    def over_turn(self, rotor: Rotor) -> tuple[Array, Array]:
        """Equidistant shaft angles (N,) rad, a multiple of the pistons, and the pressures (N,) Pa there.

        Raises NotConverged where the pump's own cycle does not become periodic.
        """
        if not self.rows:
            cycle = lumped_point(rotor.pump, rotor.point).cycle
            return cycle.shaft_angle, cycle.pressure
        angles = piston_motion(rotor.pump, rotor.point).shaft_angle
        if len(self.rows) == 1:
            return angles, np.full(len(angles), self.rows[0][1])
        course = Course(*np.array(self.rows).T)
        return angles, np.array([float(course(angle)) for angle in angles])


def read_chamber_pressure(film: Table, folder: Path) -> ChamberPressure | None:
    """The pressure that `chamber_pressure` gives, the pump's own cycle where left out; None with faults told."""
    raw = film.get("chamber_pressure")
    if raw is None or raw == CYCLE:
        return ChamberPressure(quoted(CYCLE))
    if isinstance(raw, str) and raw.lower().endswith(".csv"):
        return _of_file(film, folder / raw)
    if isinstance(raw, str):
        return _held(film, raw)
    if not isinstance(raw, list) or not raw:
        film.fault("chamber_pressure", repr(raw), _EXPECTED)
        return None
    rows = _listed(film, raw)
    if rows is None or (checked := _checked(film, rows)) is None:
        return None
    shown = ", ".join(
        f'["{format_quantity(angle, Dimension.ANGLE)}", "{format_quantity(pressure, Dimension.PRESSURE)}"]'
        for angle, pressure in checked
    )
    return ChamberPressure(f"[{shown}]", checked)


def _held(film: Table, raw: str) -> ChamberPressure | None:
    """One pressure over the turn."""
    try:
        pressure = parse_quantity(raw, Dimension.PRESSURE)
    except QuantityError as reason:
        film.fault("chamber_pressure", reason.found, _EXPECTED, nearest_choice(raw, [CYCLE]) or reason.nearest)
        return None
    checked = _checked(film, [(0.0, pressure)])
    return ChamberPressure(quoted(format_quantity(pressure, Dimension.PRESSURE)), checked) if checked else None


def _listed(film: Table, raw: Sequence[Any]) -> list[Row] | None:
    """Rows as they are listed: [angle, pressure] each, or pressures at equal steps of the turn."""
    pairs = any(isinstance(entry, list) for entry in raw)
    angles: list[float | None] = [TURN * k / len(raw) for k in range(len(raw))]
    pressures: list[float | None] = []
    for k, entry in enumerate(raw):
        name = f"chamber_pressure[{k}]"
        if pairs and not (isinstance(entry, list) and len(entry) == 2):
            film.fault(name, repr(entry), 'a row of angle and pressure, such as ["180 deg", "35 MPa"]')
            pressures.append(None)
            continue
        named = dict(zip((f"{name}[0]", f"{name}[1]"), entry, strict=True)) if pairs else {name: entry}
        reader = Table(film.path, named, film.faults)
        if pairs:
            angles[k] = reader.quantity(f"{name}[0]", Dimension.ANGLE)
        pressures.append(reader.quantity(list(named)[-1], Dimension.PRESSURE))
    if None in angles or None in pressures:
        return None
    return [(float(a or 0.0), float(p or 0.0)) for a, p in zip(angles, pressures, strict=True)]


def _checked(film: Table, rows: Sequence[Row]) -> tuple[Row, ...] | None:
    """The rows of one turn, a last one that closes it left out; None with its fault told."""
    rows = list(rows)
    if len(rows) > 1 and np.isclose(rows[-1][0] - rows[0][0], TURN) and rows[-1][1] == rows[0][1]:
        rows = rows[:-1]
    angles, pressures = np.array(rows).T
    faults = len(film.faults)
    if 1 < len(rows) < LEAST_ROWS:
        film.fault("chamber_pressure", f"{len(rows)} rows", f"{LEAST_ROWS} or more over the turn, or one pressure")
    elif not np.all(np.diff(angles) > 0.0) or angles[-1] - angles[0] >= TURN:
        first, last = (format_quantity(float(end), Dimension.ANGLE) for end in (angles[0], angles[-1]))
        film.fault("chamber_pressure", f"angles from {first} to {last}", "angles that rise, within one turn")
    if (lowest := float(pressures.min())) < CAVITY_PRESSURE:
        found, least = (format_quantity(value, Dimension.PRESSURE) for value in (lowest, CAVITY_PRESSURE))
        film.fault("chamber_pressure", found, f"at least {least}, at which a cavity opens")
    return tuple(rows) if len(film.faults) == faults else None


def _of_file(film: Table, path: Path) -> ChamberPressure | None:
    """The columns of angle and pressure of a CSV file, the unit of each in its head: `shaft_angle [deg]`."""
    try:
        lines = list(csv.reader(path.read_text("utf-8-sig").splitlines()))
    except FileNotFoundError:
        beside = [item.name for item in path.parent.glob("*.csv")] if path.parent.is_dir() else []
        film.fault("chamber_pressure", f"{path}: no such file", "a CSV file", nearest_choice(path.name, beside))
        return None
    except (OSError, UnicodeDecodeError) as reason:
        film.fault("chamber_pressure", f"{path}: cannot be read: {reason}", "a CSV file in UTF-8")
        return None
    places = _columns(lines[0] if lines else [])
    if places is None:
        found = f"{path}: head {', '.join(lines[0]) if lines else 'none'}"
        film.fault("chamber_pressure", found, "columns shaft_angle [deg] and chamber_pressure [MPa], any units")
        return None
    rows = [_row(film, path, number, line, places) for number, line in enumerate(lines[1:], start=2) if line]
    if None in rows or not rows:
        if not rows:
            film.fault("chamber_pressure", f"{path}: no rows", f"{LEAST_ROWS} or more over the turn")
        return None
    checked = _checked(film, [row for row in rows if row])
    return ChamberPressure(quoted(str(path)), checked) if checked else None


def _columns(head: Sequence[str]) -> dict[str, tuple[int, str]] | None:
    """Place and unit of the two columns; None where one is not there."""
    found = {}
    for place, cell in enumerate(head):
        name, _, unit = cell.strip().rstrip("]").partition("[")
        name = name.strip().lower().replace(" ", "_")
        found[_SHORT.get(name, name)] = (place, unit.strip())
    return {name: found[name] for name in _COLUMNS} if set(_COLUMNS) <= set(found) else None


def _row(
    film: Table, path: Path, number: int, line: Sequence[str], places: dict[str, tuple[int, str]]
) -> Row | None:
    """Angle (rad) and pressure (Pa) of a line; None with its fault told."""
    values = []
    for name, (place, unit) in places.items():
        cell = line[place].strip() if place < len(line) else ""
        try:
            values.append(parse_quantity(f"{cell} {unit}", _COLUMNS[name]))
        except QuantityError as reason:
            film.fault("chamber_pressure", f"{path}, line {number}: {reason.found}", reason.expected)
            return None
    return values[0], values[1]
