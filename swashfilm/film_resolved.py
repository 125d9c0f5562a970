"""A film case written back: every key, defaults filled in, units named."""

from __future__ import annotations

from swashfilm.film_statement import BoundaryStatement, FilmStatement, Velocity
from swashfilm.gap_case import FORMAT
from system.units import Dimension, format_quantity


def resolved_text(stated: FilmStatement) -> str:
    """A case file that gives this very case."""
    entries = {
        "mesh": stated.mesh.text,
        "order": stated.order,
        "thickness": f'"{stated.thickness}"  # m',
        "velocity": f"{_vector(stated.velocity)}  # m/s",
        "velocity_fixed": f"{_vector(stated.velocity_fixed)}  # m/s",
        "squeeze": f'"{stated.squeeze}"  # m/s',
        "viscosity": f'"{stated.viscosity}"  # Pa s',
        "cavitation": f'"{stated.cavitation.value}"',
        "cavitation_pressure": _pressure(stated.cavitation_pressure),
    }
    rows = [f"format = {FORMAT}", "", "[film]", *(f"{key} = {value}" for key, value in entries.items())]
    rows += ["", "[boundary]  # what is not named is closed"]
    rows += [f'"{name}" = {{ {_boundary(entry)} }}' for name, entry in stated.boundary.items()]
    return "\n".join(rows) + "\n"


def _boundary(entry: BoundaryStatement) -> str:
    return f"pressure = {_pressure(entry.pressure)}, film_fraction = {entry.film_fraction!r}"


def _vector(parts: Velocity) -> str:
    return f'["{parts[0]}", "{parts[1]}"]'


def _pressure(value: float) -> str:
    return f'"{format_quantity(value, Dimension.PRESSURE)}"'
