"""Oil table of a film case: viscosity over temperature and pressure, density over pressure, heat."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum
from typing import Annotated

import numpy as np

from reynolds.errors import InputError
from reynolds.laws.density import DOWSON_HIGGINSON, BulkModulus, RationalDensity, Tait, tait_modulus
from reynolds.laws.fluid import DensityLaw, Fluid, ViscosityLaw, incompressible, isoviscous
from reynolds.laws.oil import Oil, dynamic_viscosity, walther
from reynolds.laws.rheology import Carreau, Cross, Eyring
from reynolds.laws.viscosity import Barus, Roelands
from reynolds.numerics.arrays import Array
from reynolds.thermal.shear_thinning import ShearLaw
from system.inputs.sections.fields import (
    Conductivity,
    Density,
    Fraction,
    KinematicViscosity,
    Limits,
    Modulus,
    Positive,
    Span,
    SpecificHeat,
    Temperature,
    fields_of,
)
from system.inputs.sections.reader import Reading, read_section
from system.inputs.sections.values import wanted
from system.inputs.toml_table import Table
from system.inputs.units import Dimension
from system.pump_file.tables import GRADE_KEYS, grade_viscosities

PerKelvin = Annotated[float, Dimension.TEMPERATURE_COEFFICIENT, Positive]
Stress = Annotated[float, Dimension.PRESSURE, Span.OF_TWO, Positive]
_AT_TEMPERATURE, _OF_HEAT = ("density", "temperature"), ("specific_heat", "thermal_conductivity")
_FOR_HEAT = (*_OF_HEAT, "thermal_expansion", "temperature_coefficient")
"""Keys that only a solved temperature uses."""
TAIT_SLOPE = 11.0  # of mineral oils
ONLY_HEATED = "a film at one temperature without this key, or a table [thermal], which solves for it"


class PressureLaw(Enum):
    """Viscosity over pressure."""

    NONE = "none"
    BARUS = "barus"
    ROELANDS = "roelands"


class DensityOverPressure(Enum):
    """Density over pressure."""

    NONE = "none"
    DOWSON_HIGGINSON = "dowson_higginson"
    BULK_MODULUS = "bulk_modulus"
    RATIONAL = "rational"
    TAIT = "tait"


class Thinning(Enum):
    """Viscosity over shear rate."""

    NONE = "none"
    CARREAU = "carreau"
    CROSS = "cross"
    EYRING = "eyring"


_SHARES = ("second_newtonian", "relaxation_time", "shear_exponent")
_CONSTANTS: dict[Enum, tuple[str, ...]] = {
    PressureLaw.BARUS: ("pressure_viscosity_coefficient",),
    PressureLaw.ROELANDS: ("pressure_viscosity_coefficient",),
    DensityOverPressure.BULK_MODULUS: ("bulk_modulus",),
    DensityOverPressure.RATIONAL: ("density_pressure", "density_limit"),
    DensityOverPressure.TAIT: ("tait_modulus", "tait_slope"),
    Thinning.CARREAU: _SHARES,
    Thinning.CROSS: _SHARES,
    Thinning.EYRING: ("eyring_stress",),
}


@dataclass(frozen=True, kw_only=True)
class FilmOilSection:
    """[oil]: oil of a case; None for values that are neither stated nor needed.

    Without the two viscosities the case states film.viscosity at `temperature`.
    """

    kinematic_viscosity_40C: KinematicViscosity | None = None
    kinematic_viscosity_100C: KinematicViscosity | None = None  # Walther's law runs through both
    density: Density | None = None
    temperature: Temperature | None = None
    specific_heat: SpecificHeat | None = None
    thermal_conductivity: Conductivity | None = None
    thermal_expansion: PerKelvin | None = None
    temperature_coefficient: PerKelvin | None = None  # decrease of film.viscosity with temperature
    pressure_law: PressureLaw = PressureLaw.NONE
    pressure_viscosity_coefficient: Annotated[float, Dimension.PRESSURE_COEFFICIENT, Positive] | None = None
    density_law: DensityOverPressure = DensityOverPressure.NONE
    bulk_modulus: Modulus | None = None
    density_pressure: Stress | None = None
    density_limit: Annotated[float, Limits(above=1.0)] | None = None  # density ratio at endless pressure
    tait_modulus: Modulus | None = None
    tait_slope: Annotated[float, Positive] | None = None  # the modulus' rise with pressure
    shear_law: Thinning = Thinning.NONE
    second_newtonian: Fraction | None = None
    relaxation_time: Annotated[float, Dimension.TIME, Positive] | None = None
    shear_exponent: Fraction | None = None
    eyring_stress: Stress | None = None

    @property
    def kinematic(self) -> tuple[float, float] | None:
        """Viscosities at 40 and 100 degC, m2/s; None where the case states film.viscosity."""
        at_40, at_100 = self.kinematic_viscosity_40C, self.kinematic_viscosity_100C
        return None if at_40 is None or at_100 is None else (at_40, at_100)

    @property
    def dynamic_viscosity(self) -> float:
        """Viscosity (Pa s) of a grade by Walther's law at its temperature; raises InputError beyond the law's range."""
        assert self.kinematic is not None
        assert self.density is not None
        assert self.temperature is not None
        # An isothermal film needs neither bulk modulus nor specific heat: both are set to 1.
        return dynamic_viscosity(Oil(*self.kinematic, self.density, 1.0, 1.0), self.temperature)

    @property
    def fluid(self) -> Fluid:
        """The oil's laws over pressure, at one temperature."""
        return Fluid(self.viscosity_over_pressure, self.density_over_pressure)

    @property
    def viscosity_over_pressure(self) -> ViscosityLaw:
        """Law of the viscosity over pressure."""
        constant = self.pressure_viscosity_coefficient
        if constant is None:
            return isoviscous
        return Barus(constant) if self.pressure_law is PressureLaw.BARUS else Roelands(constant)

    @property
    def density_over_pressure(self) -> DensityLaw:
        """Law of the density over pressure."""
        if self.bulk_modulus is not None:
            return BulkModulus(self.bulk_modulus)
        if self.density_pressure is not None and self.density_limit is not None:
            return RationalDensity(self.density_pressure, self.density_limit)
        if self.tait_modulus is not None and self.tait_slope is not None:
            return Tait(self.tait_modulus, self.tait_slope)
        is_dowson = self.density_law is DensityOverPressure.DOWSON_HIGGINSON
        return DOWSON_HIGGINSON if is_dowson else incompressible

    @property
    def shear_thinning(self) -> ShearLaw | None:
        """Law of shear thinning; None without thinning."""
        if self.eyring_stress is not None:
            return Eyring(self.eyring_stress)
        if self.second_newtonian is None or self.relaxation_time is None or self.shear_exponent is None:
            return None
        law = Carreau if self.shear_law is Thinning.CARREAU else Cross
        return law(self.second_newtonian, self.relaxation_time, self.shear_exponent)

    def at_temperature(self, temperature: Array, viscosity: float) -> Array:
        """Return the viscosity (Pa s) at zero pressure at temperatures (K); `viscosity`: that of the case, Pa s.

        Raises InputError where the law of the viscosity over temperature does not hold.
        """
        if self.kinematic is None or self.density is None:
            assert self.temperature is not None
            assert self.temperature_coefficient is not None
            return np.asarray(viscosity * np.exp(self.temperature_coefficient * (self.temperature - temperature)))
        return walther(temperature, Oil(*self.kinematic, self.density, 1.0, 1.0)) * self.density


def read_oil(oil: Table, *, with_viscosity: bool, with_heat: bool) -> FilmOilSection | None:
    """Return the oil of a table; None with its faults listed.

    `with_viscosity`: the case states film.viscosity, the table need not; `with_heat`: the film temperature is
    solved, which needs density, temperature, specific heat and conductivity; else what only heat needs is a fault.
    """
    before = len(oil.faults)
    reading = Reading(special={f"{oil.path}.grade": grade_viscosities}, faults=oil.faults)
    stated = read_section(oil.path, FilmOilSection, oil.values, reading)
    if stated.density_law is DensityOverPressure.TAIT:
        usual = None if stated.temperature is None else float(tait_modulus(stated.temperature))
        modulus, slope = stated.tait_modulus or usual, stated.tait_slope or TAIT_SLOPE
        stated = replace(stated, tait_modulus=modulus, tait_slope=slope)
    if with_viscosity and any(getattr(stated, key) is not None for key in GRADE_KEYS):
        key = "grade" if "grade" in oil.values else GRADE_KEYS[0]
        oil.fault(key, "a viscosity beside film.viscosity", "one of the two")
    elif stated.temperature_coefficient is not None and not with_viscosity:
        expected = (
            "not beside a grade: the viscosities at 40 and 100 degC give the decrease; or film.viscosity in their place"
        )
        oil.fault("temperature_coefficient", "a decrease with temperature without film.viscosity", expected)
    elif not with_heat:
        for key in filter(oil.values.__contains__, _FOR_HEAT):
            oil.fault(key, "a property without a table [thermal]", ONLY_HEATED)
    needed = [*(() if with_viscosity else GRADE_KEYS), *(_OF_HEAT if with_heat else ())]
    needed += _AT_TEMPERATURE if with_heat or not with_viscosity else ()
    for key in (*needed, *_constants(oil, stated, reading)):
        if getattr(stated, key) is None and f"{oil.path}.{key}" not in reading.faulty:
            oil.fault(key, "missing", wanted(fields_of(FilmOilSection)[key]))
    if not with_viscosity and len(oil.faults) == before:
        try:
            stated.dynamic_viscosity  # noqa: B018
        except InputError as reason:
            key = reason.where.removeprefix("oil ")
            oil.fault(key if key in GRADE_KEYS else "temperature", reason.found, reason.expected)
    return stated if len(oil.faults) == before else None


def _constants(oil: Table, stated: FilmOilSection, reading: Reading) -> Iterator[str]:
    """Yield the constants of the laws of a table; list a fault for each whose law the table does not select."""
    for law in ("pressure_law", "density_law", "shear_law"):
        chosen: Enum = getattr(stated, law)
        yield from _CONSTANTS.get(chosen, ())
        others = {key for one, keys in _CONSTANTS.items() if type(one) is type(chosen) for key in keys}
        for key in sorted(others - {*_CONSTANTS.get(chosen, ())}):
            if key in oil.values and f"{oil.path}.{law}" not in reading.faulty:
                oil.fault(key, f"a constant beside {law} = {chosen.value!r}", f"a {law} that has it")
