"""Oil table of a film case: viscosity over temperature and pressure, density over pressure, heat."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.errors import InputError
from reynolds.laws.density import DOWSON_HIGGINSON, BulkModulus, RationalDensity, Tait, tait_modulus
from reynolds.laws.fluid import DensityLaw, Fluid, ViscosityLaw, incompressible, isoviscous
from reynolds.laws.oil import ISO_GRADES, Oil, dynamic_viscosity, walther
from reynolds.laws.rheology import Carreau, Cross, Eyring
from reynolds.laws.viscosity import Barus, Roelands
from reynolds.numerics.arrays import Array
from reynolds.thermal.shear_thinning import ShearLaw
from system.inputs.faults import nearest_choice
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity

_KINEMATIC = ("kinematic_viscosity_40C", "kinematic_viscosity_100C")
_OF_LAWS = {
    "pressure_law": ("pressure_viscosity_coefficient",),
    "density_law": ("bulk_modulus", "density_pressure", "density_limit", "tait_modulus", "tait_slope"),
    "shear_law": ("second_newtonian", "relaxation_time", "shear_exponent", "eyring_stress"),
}


class PressureLaw(Enum):
    """Viscosity over pressure."""

    NONE = "none"
    BARUS = "barus"
    ROELANDS = "roelands"


class Density(Enum):
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


@dataclass(frozen=True)
class OilStatement:
    """Oil of a case, SI; None for values that are neither stated nor needed.

    `kinematic`: viscosities at 40 and 100 degC, m2/s (None: the case states film.viscosity at `temperature`, and
    viscosity varies as exp(-temperature_coefficient dT)); `rows`: the table as a case file writes it.
    """

    rows: tuple[str, ...]
    kinematic: tuple[float, float] | None
    density: float | None
    temperature: float | None
    temperature_coefficient: float
    specific_heat: float | None
    conductivity: float | None
    expansion: float
    viscosity_law: ViscosityLaw
    density_law: DensityLaw
    shear_law: ShearLaw | None

    @property
    def fluid(self) -> Fluid:
        """The oil's laws over pressure, at one temperature."""
        return Fluid(self.viscosity_law, self.density_law)

    def at_temperature(self, temperature: Array, viscosity: float) -> Array:
        """Return the viscosity (Pa s) at zero pressure at temperatures (K); `viscosity`: that of the case, Pa s.

        Raises InputError where the law of the viscosity over temperature does not hold.
        """
        if self.kinematic is None or self.density is None:
            cooler = (self.temperature or 0.0) - temperature
            return np.asarray(viscosity * np.exp(self.temperature_coefficient * cooler))
        return walther(temperature, Oil(*self.kinematic, self.density, 1.0, 1.0)) * self.density


@dataclass
class _Rows:
    """Entries read from a table, as a case file writes them."""

    table: Table
    rows: list[str]

    def positive(self, key: str, dimension: Dimension, default: float | None = None) -> float | None:
        """Return a quantity above zero; list its fault, keep its row."""
        value = self.table.positive(key, dimension, default)
        if value is not None:
            self.rows.append(f'{key} = "{format_quantity(value, dimension)}"')
        return value

    def share(self, key: str) -> float | None:
        """Return a bare number from 0 to 1; list its fault, keep its row."""
        value = self.table.number(key)
        if value is not None and not 0.0 <= value <= 1.0:
            self.table.fault(key, f"{value:g}", "a fraction from 0 to 1")
            return None
        self.rows.append(f"{key} = {value!r}")
        return value

    def optional(self, key: str, dimension: Dimension) -> float | None:
        """Return a quantity above zero, or None where none is stated."""
        return self.positive(key, dimension) if self.table.get(key) is not None else None


def read_oil(oil: Table, *, with_viscosity: bool, with_heat: bool) -> OilStatement | None:
    """Return the oil of a table; None with its faults listed.

    `with_viscosity`: the case states film.viscosity, the table need not; `with_heat`: the film temperature is
    solved, which needs density, temperature, specific heat and conductivity.
    """
    rows = _Rows(oil, [])
    kinematic = _kinematic(rows, needed=not with_viscosity)
    if with_viscosity and kinematic is not None:
        oil.fault(
            "grade" if oil.get("grade") else _KINEMATIC[0], "a viscosity beside film.viscosity", "one of the two"
        )
    needs = with_heat or not with_viscosity
    read = rows.positive if needs else rows.optional
    density, temperature = read("density", Dimension.DENSITY), read("temperature", Dimension.TEMPERATURE)
    heat = rows.positive if with_heat else rows.optional
    specific_heat = heat("specific_heat", Dimension.SPECIFIC_HEAT)
    conductivity = heat("thermal_conductivity", Dimension.CONDUCTIVITY)
    expansion = rows.optional("thermal_expansion", Dimension.TEMPERATURE_COEFFICIENT) or 0.0
    coefficient = 0.0
    if with_viscosity:
        coefficient = rows.optional("temperature_coefficient", Dimension.TEMPERATURE_COEFFICIENT) or 0.0
    faults = len(oil.faults)
    viscosity_law, density_law = _viscosity_law(rows), _density_law(rows, temperature)
    shear_law = _shear_law(rows)
    _check_laws(oil)
    oil.close()
    missing = None in (density, temperature) if needs else False
    missing |= with_heat and None in (specific_heat, conductivity)
    missing |= kinematic is None and not with_viscosity
    if missing or len(oil.faults) > faults or viscosity_law is None or density_law is None:
        return None
    return OilStatement(
        tuple(rows.rows), kinematic, density, temperature, coefficient, specific_heat, conductivity, expansion,
        viscosity_law, density_law, shear_law,
    )  # fmt: skip


def _check_laws(oil: Table) -> None:
    """List faults of constants whose law the table does not select."""
    for law, keys in _OF_LAWS.items():
        for key in keys:
            if key in oil.values and key not in oil.asked:
                named = repr(oil.get(law)) if oil.get(law) is not None else "none"
                oil.get(key)
                oil.fault(key, f"a constant beside {law} = {named}", f"a {law} that has it")


def oil_viscosity(oil: Table, stated: OilStatement) -> float | None:
    """Return the viscosity (Pa s) by Walther's law at the table's temperature; None with its fault listed."""
    assert stated.kinematic is not None
    assert stated.density is not None
    assert stated.temperature is not None
    try:
        # An isothermal film needs neither bulk modulus nor specific heat: both are set to 1.
        return dynamic_viscosity(Oil(*stated.kinematic, stated.density, 1.0, 1.0), stated.temperature)
    except InputError as reason:
        oil.fault("temperature", reason.found, f"{reason.expected} of {reason.where}")
        return None


def _viscosity_law(rows: _Rows) -> ViscosityLaw | None:
    law = rows.table.choice("pressure_law", PressureLaw, PressureLaw.NONE)
    if law in (None, PressureLaw.NONE):
        return None if law is None else isoviscous
    rows.rows.append(f'pressure_law = "{law.value}"')
    coefficient = rows.positive("pressure_viscosity_coefficient", Dimension.PRESSURE_COEFFICIENT)
    if coefficient is None:
        return None
    return Barus(coefficient) if law is PressureLaw.BARUS else Roelands(coefficient)


def _density_law(rows: _Rows, temperature: float | None) -> DensityLaw | None:
    law = rows.table.choice("density_law", Density, Density.NONE)
    if law in (None, Density.NONE):
        return None if law is None else incompressible
    rows.rows.append(f'density_law = "{law.value}"')
    if law is Density.DOWSON_HIGGINSON:
        return DOWSON_HIGGINSON
    if law is Density.BULK_MODULUS:
        modulus = rows.positive("bulk_modulus", Dimension.MODULUS)
        return None if modulus is None else BulkModulus(modulus)
    if law is Density.RATIONAL:
        pressure = rows.positive("density_pressure", Dimension.PRESSURE)
        limit = rows.table.number("density_limit")
        if limit is not None and limit <= 1.0:
            rows.table.fault("density_limit", f"{limit:g}", "the density ratio at endless pressure, above 1")
            limit = None
        rows.rows.append(f"density_limit = {limit!r}")
        return None if pressure is None or limit is None else RationalDensity(pressure, limit)
    default = None if temperature is None else float(tait_modulus(temperature))
    modulus = rows.positive("tait_modulus", Dimension.MODULUS, default)
    slope = rows.table.number("tait_slope", 11.0)
    if slope is not None and slope <= 0.0:
        rows.table.fault("tait_slope", f"{slope:g}", "the modulus' rise with pressure, above 0 (mineral oils: 11)")
        slope = None
    rows.rows.append(f"tait_slope = {slope!r}")
    return None if modulus is None or slope is None else Tait(modulus, slope)


def _shear_law(rows: _Rows) -> ShearLaw | None:
    """Return the law of shear thinning; None without thinning, or with its fault listed."""
    law = rows.table.choice("shear_law", Thinning, Thinning.NONE)
    if law in (None, Thinning.NONE):
        return None
    rows.rows.append(f'shear_law = "{law.value}"')
    if law is Thinning.EYRING:
        stress = rows.positive("eyring_stress", Dimension.PRESSURE)
        return None if stress is None else Eyring(stress)
    time = rows.positive("relaxation_time", Dimension.TIME)
    shares = [rows.share(key) for key in ("second_newtonian", "shear_exponent")]
    if time is None or shares[0] is None or shares[1] is None:
        return None
    return (Carreau if law is Thinning.CARREAU else Cross)(shares[0], time, shares[1])


def _kinematic(rows: _Rows, *, needed: bool) -> tuple[float, float] | None:
    """Return kinematic viscosities at 40 and 100 degC (m2/s); None where not needed, or with a fault listed."""
    oil = rows.table
    grade = oil.get("grade")
    stated = [key for key in _KINEMATIC if oil.get(key) is not None]
    if grade is None:
        if not needed and not stated:
            return None
        at_40, at_100 = (rows.positive(key, Dimension.KINEMATIC_VISCOSITY) for key in _KINEMATIC)
        return None if at_40 is None or at_100 is None else (at_40, at_100)
    if stated:
        oil.fault("grade", f"grade beside {' and '.join(stated)}", "the grade or the two viscosities")
        return None
    if not isinstance(grade, str) or grade not in ISO_GRADES:
        expected = f"one of {', '.join(ISO_GRADES)}, or {' and '.join(_KINEMATIC)} in its place"
        oil.fault("grade", repr(grade), expected, nearest_choice(str(grade), ISO_GRADES))
        return None
    rows.rows.append(f'grade = "{grade}"')
    known = ISO_GRADES[grade]
    return known.kinematic_viscosity_40C, known.kinematic_viscosity_100C
