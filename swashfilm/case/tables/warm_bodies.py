"""Wall of [thermal] that is the body of [elastic]: conduction, expansion and heat loss of its faces."""

from __future__ import annotations

from dataclasses import dataclass

from reynolds.bodies.conduction import Convection, HeldTemperature, Surroundings, Thermal
from reynolds.bodies.wall import Body, heated_wall
from reynolds.errors import InputError
from reynolds.fem.space import FilmSpace
from reynolds.thermal.walls import ConductingBody as HeatedBody
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension


@dataclass(frozen=True)
class WarmBody:
    """Conductivity and expansion of a body, its faces' surroundings, and the entry as a case file writes it."""

    thermal: Thermal
    faces: Surroundings
    text: str

    def under(self, body: Body, space: FilmSpace) -> HeatedBody:
        """Return the wall for the film's heat problem; raise InputError for an unknown face."""
        if unknown := [name for name in self.faces if name not in body.mesh.face_names]:
            raise InputError("thermal wall, faces", f"'{unknown[0]}'", f"one of {', '.join(body.mesh.face_names)}")
        found = heated_wall(body, space, self.thermal, self.faces)
        return HeatedBody(found.temperature.reference, found.temperature.matrix, found.deformation)


def read_warm_body(wall: Table) -> WarmBody | None:
    """Return the conducting body of a wall's entry; None with its faults listed."""
    conductivity = wall.positive("thermal_conductivity", Dimension.CONDUCTIVITY)
    expansion = wall.quantity("thermal_expansion", Dimension.TEMPERATURE_COEFFICIENT, 0.0)
    unstrained = wall.positive("unstrained_temperature", Dimension.TEMPERATURE)
    table = wall.table("faces", needed='such as { bottom = { temperature = "40 degC" } }')
    wall.close()
    faces = {name: _face(table, name) for name in table.values} if table else {}
    if table and not faces:
        wall.fault("faces", "none", "at least one, through which the heat leaves")
    if conductivity is None or expansion is None or unstrained is None or not faces:
        return None
    known = {name: face for name, face in faces.items() if face is not None}
    if len(known) < len(faces):
        return None
    return WarmBody(Thermal(conductivity, expansion, unstrained), known, _written(wall.values))


def _face(table: Table, name: str) -> Convection | HeldTemperature | None:
    entry = table.table(name)
    if entry is None:
        return None
    temperature = entry.get("temperature")
    if temperature is not None:
        kelvin = entry.positive("temperature", Dimension.TEMPERATURE)
        entry.close()
        return None if kelvin is None else HeldTemperature(kelvin)
    coefficient = entry.positive("heat_transfer_coefficient", Dimension.HEAT_TRANSFER)
    outer = entry.positive("outer_temperature", Dimension.TEMPERATURE)
    entry.close()
    return None if coefficient is None or outer is None else Convection(coefficient, outer)


def _written(value: object) -> str:
    """Return an entry as one line of a case file."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_written(part)}" for key, part in value.items()) + " }"
    return quoted(value) if isinstance(value, str) else str(value)
