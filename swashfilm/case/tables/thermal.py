"""Thermal table of a film case: heat transfer at the walls, and temperature of the entering oil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from typing import Annotated

from reynolds.bodies.conduction import Convection, HeldTemperature, Thermal
from reynolds.bodies.wall import Body, heated_wall
from reynolds.errors import InputError
from reynolds.fem.space import FilmSpace
from reynolds.thermal.energy import Heat
from reynolds.thermal.film_profile import DEFAULT_LEVELS
from reynolds.thermal.walls import Adiabatic, ConductingBody, Convecting, GivenTemperature, Turning, Wall
from swashfilm.case.tables.oil import FilmOilSection
from system.inputs.sections.fields import Conductivity, Limits, Positive, Temperature
from system.inputs.sections.reader import table_section
from system.inputs.toml_table import Table
from system.inputs.units import Dimension

MOST_LEVELS = 12


class PlainWall(Enum):
    """Walls without numbers: no heat flux, or one temperature of a wall that turns fast and takes no heat in all."""

    ADIABATIC = "adiabatic"
    TURNING = "turning"


@dataclass(frozen=True, kw_only=True)
class HeldSection:
    """A surface at this temperature."""

    temperature: Temperature


@dataclass(frozen=True, kw_only=True)
class CooledSection:
    """A surface that its surroundings cool or heat."""

    heat_transfer_coefficient: Annotated[float, Dimension.HEAT_TRANSFER, Positive]
    outer_temperature: Temperature


@dataclass(frozen=True, kw_only=True)
class WarmBodySection:
    """The body of [elastic] on this side: it conducts heat and expands; a face not named passes no heat."""

    thermal_conductivity: Conductivity
    thermal_expansion: Annotated[float, Dimension.TEMPERATURE_COEFFICIENT] = 0.0
    unstrained_temperature: Temperature
    faces: Mapping[str, HeldSection | CooledSection]

    def __post_init__(self) -> None:
        if not self.faces:
            raise InputError("faces", "none", "at least one, through which the heat leaves")

    def under(self, body: Body, space: FilmSpace) -> ConductingBody:
        """Return the wall for the film's heat problem; raise InputError for an unknown face."""
        if unknown := [name for name in self.faces if name not in body.mesh.face_names]:
            raise InputError("thermal wall, faces", f"'{unknown[0]}'", f"one of {', '.join(body.mesh.face_names)}")
        thermal = Thermal(self.thermal_conductivity, self.thermal_expansion, self.unstrained_temperature)
        surroundings = {
            name: HeldTemperature(face.temperature)
            if isinstance(face, HeldSection)
            else Convection(face.heat_transfer_coefficient, face.outer_temperature)
            for name, face in self.faces.items()
        }
        found = heated_wall(body, space, thermal, surroundings)
        return ConductingBody(found.temperature.reference, found.temperature.matrix, found.deformation)


WallForm = PlainWall | HeldSection | CooledSection | WarmBodySection


@dataclass(frozen=True, kw_only=True)
class ThermalSection:
    """[thermal]: temperature of the film, between two walls."""

    fixed_wall: WallForm
    moving_wall: WallForm
    inlet_temperature: Temperature | None = None  # left out: that of the oil
    levels: Annotated[int, Limits(least=2, most=MOST_LEVELS)] = DEFAULT_LEVELS  # across the film

    @property
    def finer(self) -> ThermalSection:
        """The same with two more levels across the film: their error falls faster than that of cells."""
        return replace(self, levels=min(self.levels + 2, MOST_LEVELS))

    @property
    def walls(self) -> Mapping[str, WallForm]:
        """Both walls by their names in [elastic]."""
        return {"fixed": self.fixed_wall, "moving": self.moving_wall}

    def inlet(self, oil: FilmOilSection) -> float:
        """Return the temperature of entering oil, K."""
        usual = oil.temperature if self.inlet_temperature is None else self.inlet_temperature
        assert usual is not None
        return usual

    def heat(
        self,
        oil: FilmOilSection,
        temperatures: Mapping[str, float | None],
        bodies: Mapping[str, Body],
        space: FilmSpace,
    ) -> Heat:
        """Return the heat problem; `temperatures` (K) by boundary, None where the inlet temperature holds.

        Raises InputError for a body that does not lie under the film or that loses no heat anywhere.
        """
        assert oil.density is not None
        assert oil.specific_heat is not None
        assert oil.thermal_conductivity is not None
        usual = self.inlet(oil)
        inflow = {name: usual if kelvin is None else kelvin for name, kelvin in temperatures.items()}
        fixed, moving = (_wall(wall, bodies.get(key), space) for key, wall in self.walls.items())
        return Heat(
            oil.density, oil.specific_heat, oil.thermal_conductivity, fixed, moving, inflow,
            oil.thermal_expansion or 0.0,
        )  # fmt: skip


def _wall(stated: WallForm, body: Body | None, space: FilmSpace) -> Wall:
    match stated:
        case HeldSection(temperature=kelvin):
            return GivenTemperature(kelvin)
        case CooledSection(heat_transfer_coefficient=coefficient, outer_temperature=outer):
            return Convecting(coefficient, outer)
        case WarmBodySection():
            assert body is not None
            return stated.under(body, space)
        case PlainWall.ADIABATIC:
            return Adiabatic()
        case PlainWall.TURNING:
            return Turning()


def read_thermal(top: Table, bodies: Mapping[str, Body] | None) -> ThermalSection | None:
    """Return the [thermal] table; None if it is absent, or with its faults listed.

    A wall that is a body is one of `bodies`, those of [elastic] (None: it has a fault itself); no half-space is.
    """
    stated = table_section(top, "thermal", ThermalSection)
    for key, wall in stated.walls.items() if stated else ():
        if isinstance(wall, WarmBodySection) and bodies is not None and key not in bodies:
            top.fault(f"thermal.{key}_wall", "a body's conductivity", f"elastic.{key}, a body of a kind with sizes")
    return stated
