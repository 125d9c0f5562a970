"""Chamber pressure over the turn in a case: the pump's own cycle, rows, a file, or one value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gaps.films.over_turn import TURN, PeriodicCurve
from reynolds.numerics.arrays import Array
from system.films.rotor import Rotor
from system.inputs.faults import InputFaults, nearest_choice
from system.inputs.sections.fields import Points
from system.inputs.sections.point_files import read_rows
from system.inputs.sections.values import listed_rows
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension, QuantityError, format_quantity, parse_quantity
from system.points.film_effects import closed_laws
from system.points.lumped import lumped_point
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.lumped import piston_motion

CYCLE = "cycle"
LEAST_ROWS = 4
LAYOUTS = tuple(
    Points((Dimension.ANGLE, Dimension.PRESSURE), heads, ("180 deg", "35 MPa"))
    for heads in (("angle", "pressure"), ("shaft angle", "chamber pressure"))
)
_EXPECTED = f'"{CYCLE}", a pressure, pressures at equal steps from 0 deg, rows of angle and pressure, a CSV file'
Row = tuple[float, ...]


@dataclass(frozen=True)
class ChamberPressure:
    """Rows of shaft angle (rad) and pressure (Pa) of one chamber; no rows: the pump's own lumped cycle, with those
    effects of its [physics] that floating films do not solve.

    `text`: its entry in a case. Between rows the pressure is a `PeriodicCurve` (`gaps.films.over_turn`); one is
    constant over the turn.
    """

    text: str
    rows: tuple[Row, ...] = ()

    def over_turn(self, rotor: Rotor) -> tuple[Array, Array]:
        """Return N equidistant shaft angles (N,) rad, N a multiple of the pistons, and pressures (N,) Pa.

        Raises NotConverged where the pump's own cycle does not become periodic.
        """
        if not self.rows:
            cycle = lumped_point(closed_laws(rotor.pump, floating=True), rotor.point).cycle
            return cycle.shaft_angle, cycle.pressure
        angles = piston_motion(rotor.pump, rotor.point).shaft_angle
        if len(self.rows) == 1:
            return angles, np.full(len(angles), self.rows[0][1])
        course = PeriodicCurve(*np.array(self.rows).T)
        return angles, np.array([float(course(angle)) for angle in angles])


def read_chamber_pressure(film: Table, folder: Path) -> ChamberPressure | None:
    """Return the pressure of the key `chamber_pressure`, by default the pump's cycle; None with faults listed."""
    raw = film.get("chamber_pressure")
    if raw is None or raw == CYCLE:
        return ChamberPressure(quoted(CYCLE))
    try:
        rows = _rows(raw, folder)
    except QuantityError as reason:
        near = nearest_choice(raw, [CYCLE]) if isinstance(raw, str) else ""
        film.fault("chamber_pressure", reason.found, reason.expected, near or reason.nearest)
        return None
    except InputFaults as reason:
        for fault in reason.faults:
            film.fault("chamber_pressure", f"{fault.path}: {fault.found}", fault.expected, fault.nearest)
        return None
    if (checked := _checked(film, rows)) is None:
        return None
    if isinstance(raw, str) and len(checked) > 1:
        return ChamberPressure(quoted(str(folder / raw)), checked)
    if len(checked) == 1:
        return ChamberPressure(quoted(format_quantity(checked[0][1], Dimension.PRESSURE)), checked)
    shown = (
        f'["{format_quantity(angle, Dimension.ANGLE)}", "{format_quantity(pressure, Dimension.PRESSURE)}"]'
        for angle, pressure in checked
    )
    return ChamberPressure(f"[{', '.join(shown)}]", checked)


def _rows(raw: object, folder: Path) -> tuple[Row, ...]:
    """Return angles and pressures of a case's entry; raise QuantityError for an entry of another form."""
    if isinstance(raw, str) and raw.lower().endswith(".csv"):
        return read_rows(folder / raw, LAYOUTS)
    if isinstance(raw, str):
        try:
            return ((0.0, parse_quantity(raw, Dimension.PRESSURE)),)
        except QuantityError as reason:
            raise QuantityError(reason.found, _EXPECTED, reason.nearest) from None
    if isinstance(raw, list) and raw and all(isinstance(entry, str) for entry in raw):
        return tuple((TURN * k / len(raw), parse_quantity(entry, Dimension.PRESSURE)) for k, entry in enumerate(raw))
    if isinstance(raw, list) and raw and all(isinstance(entry, list) for entry in raw):
        return listed_rows(raw, LAYOUTS[:1])
    raise QuantityError(repr(raw), _EXPECTED)


def _checked(film: Table, rows: Sequence[Row]) -> tuple[Row, ...] | None:
    """Return the rows of one turn without a last row that closes it; None with the faults listed."""
    faults = len(film.faults)
    if len(rows) > 1 and np.isclose(rows[-1][0] - rows[0][0], TURN) and rows[-1][1] == rows[0][1]:
        rows = rows[:-1]
    angles, pressures = np.array(rows).reshape(-1, 2).T
    if len(rows) != 1 and len(rows) < LEAST_ROWS:
        film.fault("chamber_pressure", f"{len(rows)} rows", f"{LEAST_ROWS} or more over the turn, or one pressure")
    elif not np.all(np.diff(angles) > 0.0) or angles[-1] - angles[0] >= TURN:
        shown = ", ".join(format_quantity(float(angle), Dimension.ANGLE, digits=4) for angle in angles[:6])
        found = f"angles {shown}{', ..' if len(angles) > 6 else ''}"
        film.fault("chamber_pressure", found, "angles that rise, within one turn")
    if len(rows) and (lowest := float(pressures.min())) < CAVITY_PRESSURE:
        found, least = (format_quantity(value, Dimension.PRESSURE) for value in (lowest, CAVITY_PRESSURE))
        film.fault("chamber_pressure", found, f"at least {least}, at which a cavity opens")
    return tuple(rows) if len(film.faults) == faults else None
