"""Text of a resolved film case: every key, defaults filled in, with units."""

from __future__ import annotations

from swashfilm.case.gap.instant import FORMAT
from swashfilm.case.statement import FilmStatement, Velocity
from swashfilm.case.tables.boundary import BoundaryStatement
from swashfilm.case.tables.constants import constant_rows
from swashfilm.case.tables.load import load_rows
from system.inputs.sections.writer import section_rows
from system.inputs.units import Dimension, format_quantity


def resolved_text(stated: FilmStatement) -> str:
    """Return the text of this case."""
    film = {
        "mesh": stated.mesh.text,
        "order": stated.order,
        "thickness": f'"{stated.thickness}"  # m',
        "velocity": f"{_vector(stated.velocity)}  # m/s",
        "velocity_fixed": f"{_vector(stated.velocity_fixed)}  # m/s",
        "cavitation": f'"{stated.cavitation.value}"',
        "cavitation_pressure": _pressure(stated.cavitation_pressure),
    }
    if stated.load:
        film |= load_rows(stated.load)
    if stated.time:
        film["initial_film_fraction"] = f'"{stated.initial_film_fraction}"'
    else:
        film["squeeze"] = f'"{stated.squeeze}"  # m/s'
    if stated.oil is None or stated.oil.kinematic is None:
        film["viscosity"] = f'"{stated.viscosity}"  # Pa s'
    rows = [f"format = {FORMAT}", "", "[film]", *(f"{key} = {value}" for key, value in film.items())]
    rows += ["", *constant_rows(stated.constants)] if stated.constants else []
    rows += ["", "[boundary]  # boundaries not named are closed"]
    rows += [f'"{name}" = {{ {_boundary(entry)} }}' for name, entry in stated.boundary.items()]
    if stated.oil:
        rows += section_rows("oil", stated.oil)
    rows += section_rows("thermal", stated.thermal) if stated.thermal else []
    rows += section_rows("elastic", stated.elastic.stated) if stated.elastic else []
    rows += stated.rough.rows if stated.rough else []
    rows += section_rows("time", stated.time) if stated.time else []
    return "\n".join(rows) + "\n"


def _boundary(entry: BoundaryStatement) -> str:
    text = f'pressure = "{entry.pressure}", film_fraction = {entry.film_fraction!r}'
    if entry.temperature is None:
        return text
    return f'{text}, temperature = "{format_quantity(entry.temperature, Dimension.TEMPERATURE)}"'


def _vector(parts: Velocity) -> str:
    return f'["{parts[0]}", "{parts[1]}"]'


def _pressure(value: float) -> str:
    return f'"{format_quantity(value, Dimension.PRESSURE)}"'
