"""Thermal table of a film case: heat transfer at the walls, and temperature of the entering oil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from reynolds.fem.space import FilmSpace
from reynolds.thermal.energy import Heat
from reynolds.thermal.film_profile import DEFAULT_LEVELS
from reynolds.thermal.walls import Adiabatic, Convecting, GivenTemperature, Turning, Wall
from swashfilm.case.tables.elastic import ElasticStatement
from swashfilm.case.tables.oil import OilSection
from swashfilm.case.tables.warm_bodies import WarmBody, read_warm_body
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity

_WALLS = (
    "{ temperature }, { heat_transfer_coefficient, outer_temperature }, 'adiabatic', 'turning', or "
    "{ thermal_conductivity, thermal_expansion, unstrained_temperature, faces } of the body of [elastic]"
)
_MOST_LEVELS = 12


@dataclass(frozen=True)
class ThermalStatement:
    """Both walls, the temperature (K) of entering oil, and the number of levels across the film."""

    fixed_wall: Wall | WarmBody
    moving_wall: Wall | WarmBody
    inlet_temperature: float | None
    levels: int

    @property
    def walls(self) -> Mapping[str, Wall | WarmBody]:
        """Both walls by their names in [elastic]."""
        return {"fixed": self.fixed_wall, "moving": self.moving_wall}

    def inlet(self, oil: OilSection) -> float:
        """Return the temperature of entering oil, K."""
        usual = oil.temperature if self.inlet_temperature is None else self.inlet_temperature
        assert usual is not None
        return usual

    def heat(
        self,
        oil: OilSection,
        temperatures: Mapping[str, float | None],
        elastic: ElasticStatement | None,
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
        fixed, moving = (_under(wall, elastic, key, space) for key, wall in self.walls.items())
        return Heat(
            oil.density,
            oil.specific_heat,
            oil.thermal_conductivity,
            fixed,
            moving,
            inflow,
            oil.thermal_expansion or 0.0,
        )


def _under(wall: Wall | WarmBody, elastic: ElasticStatement | None, key: str, space: FilmSpace) -> Wall:
    if not isinstance(wall, WarmBody):
        return wall
    stated = getattr(elastic, key)
    return wall.under(stated.body, space)


def check_bodies(top: Table, stated: ThermalStatement | None, elastic: ElasticStatement | None) -> None:
    """List a fault for a conducting body that [elastic] does not have; a half-space is not such a body."""
    for key, wall in stated.walls.items() if stated else ():
        if isinstance(wall, WarmBody) and getattr(getattr(elastic, key, None), "body", None) is None:
            top.fault(f"thermal.{key}_wall", "a body's conductivity", f"elastic.{key}, a body of a kind with sizes")


def read_thermal(top: Table) -> ThermalStatement | None:
    """Return the [thermal] table; None where there is none, or with its faults listed."""
    table = top.table("thermal")
    if table is None:
        return None
    fixed, moving = _wall(table, "fixed_wall"), _wall(table, "moving_wall")
    inlet = table.positive("inlet_temperature", Dimension.TEMPERATURE) if table.get("inlet_temperature") else None
    levels = table.get("levels")
    levels = DEFAULT_LEVELS if levels is None else levels
    if type(levels) is not int or not 2 <= levels <= _MOST_LEVELS:
        table.fault("levels", repr(levels), f"a whole number of levels across the film, 2 to {_MOST_LEVELS}")
        levels = None
    table.close()
    if fixed is None or moving is None or levels is None:
        return None
    return ThermalStatement(fixed, moving, inlet, levels)


def _wall(table: Table, key: str) -> Wall | WarmBody | None:
    raw = table.get(key)
    if raw == "adiabatic":
        return Adiabatic()
    if raw == "turning":
        return Turning()
    if not isinstance(raw, dict):
        table.fault(key, "missing" if raw is None else repr(raw), _WALLS)
        return None
    wall = Table(table.name(key), raw, table.faults)
    if "thermal_conductivity" in raw:
        return read_warm_body(wall)
    if "temperature" in raw:
        for other in ("heat_transfer_coefficient", "outer_temperature"):
            if wall.get(other) is not None:
                wall.fault(other, f"{other} beside a temperature", "one of the two, " + _WALLS)
        kelvin = wall.positive("temperature", Dimension.TEMPERATURE)
        wall.close()
        return None if kelvin is None else GivenTemperature(kelvin)
    coefficient = wall.positive("heat_transfer_coefficient", Dimension.HEAT_TRANSFER)
    outer = wall.positive("outer_temperature", Dimension.TEMPERATURE)
    wall.get("temperature")
    wall.close()
    return None if coefficient is None or outer is None else Convecting(coefficient, outer)


def thermal_rows(stated: ThermalStatement) -> list[str]:
    """Return the table as text of a case file."""
    rows = ["[thermal]", f"fixed_wall = {_written(stated.fixed_wall)}", f"moving_wall = {_written(stated.moving_wall)}"]
    if stated.inlet_temperature is not None:
        rows.append(f'inlet_temperature = "{format_quantity(stated.inlet_temperature, Dimension.TEMPERATURE)}"')
    return [*rows, f"levels = {stated.levels}"]


def _written(wall: Wall | WarmBody) -> str:
    def kelvin(value: object) -> str:
        assert isinstance(value, float)
        return format_quantity(value, Dimension.TEMPERATURE)

    match wall:
        case WarmBody():
            return wall.text
        case Adiabatic():
            return '"adiabatic"'
        case Turning():
            return '"turning"'
        case GivenTemperature(temperature):
            return f'{{ temperature = "{kelvin(temperature)}" }}'
        case Convecting(coefficient, outer):
            assert isinstance(coefficient, float)
            shown = format_quantity(coefficient, Dimension.HEAT_TRANSFER)
            return f'{{ heat_transfer_coefficient = "{shown}", outer_temperature = "{kelvin(outer)}" }}'
    raise AssertionError(wall)
