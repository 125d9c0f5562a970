"""Tables [roughness] and [contact] of a film case: rough walls and contact of their asperities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

from reynolds.errors import InputError
from reynolds.laws.contact import Asperities, composite_modulus
from reynolds.laws.roughness import Surface
from system.inputs.sections.fields import AnyLength, ArealDensity, Elasticity, Length, NotNegative
from system.inputs.sections.reader import Reading, read_section
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import Table
from system.inputs.units import Dimension

Height = Annotated[float, Dimension.LENGTH, NotNegative]


@dataclass(frozen=True, kw_only=True)
class RoughnessSection:
    """[roughness]: standard deviation of heights, of both walls together or of each."""

    composite: Length | None = None  # in place of moving and fixed
    moving: Height = 0.0
    fixed: Height = 0.0
    peklenik: float | None = None  # of both walls, left out: 1
    peklenik_moving: float | None = None
    peklenik_fixed: float | None = None
    lay_angle: Annotated[float, Dimension.ANGLE] = 0.0


@dataclass(frozen=True, kw_only=True)
class ContactSection:
    """[contact]: asperities of the walls."""

    asperity_density: ArealDensity
    asperity_radius: Length
    asperity_height: Length | None = None  # standard deviation of summits; left out: the walls' composite
    composite_modulus: Elasticity  # E' of both walls, or youngs_modulus and poissons_ratio of the two
    summit_height: AnyLength = 0.0
    friction_coefficient: float


@dataclass(frozen=True)
class RoughWalls:
    """Roughness of both walls, contact of asperities (None: no contact), and the tables as written in a case."""

    surface: Surface
    asperities: Asperities | None
    rows: tuple[str, ...]


def read_roughness(top: Table) -> RoughWalls | None:
    """Return roughness and contact; None where there are no such tables, or with the faults listed."""
    table, contact = top.table("roughness"), top.table("contact")
    if table is None:
        if contact is not None:
            top.fault("contact", "no table [roughness]", "the roughness of the walls in contact")
        return None
    surface, rows = _surface(table)
    if contact is None or surface is None:
        return RoughWalls(surface, None, tuple(rows)) if surface else None
    asperities, more = _asperities(contact, surface)
    return RoughWalls(surface, asperities, (*rows, *more)) if asperities else None


def _surface(table: Table) -> tuple[Surface | None, list[str]]:
    """Return the surface by its standard deviations: of both walls together, or of each wall."""
    reading = Reading(faults=table.faults)
    stated = read_section("roughness", RoughnessSection, table.values, reading)
    moving, fixed = stated.moving, stated.fixed
    if stated.composite is not None:
        # Flow factors depend on which wall is rough: half of a composite variance is assigned to each wall.
        moving = fixed = stated.composite / 2.0**0.5
        for wall in ("moving", "fixed"):
            if wall in table.values:
                reading.fault(f"roughness.{wall}", "a wall's height beside composite", "composite, or moving and fixed")
    elif moving == fixed == 0.0 and not reading.faulty:
        reading.fault("roughness.moving", "two smooth walls", "moving or fixed above 0, or no table [roughness]")
    if reading.faulty:
        return None, []
    both = 1.0 if stated.peklenik is None else stated.peklenik
    gamma, gamma_fixed = (both if own is None else own for own in (stated.peklenik_moving, stated.peklenik_fixed))
    try:
        surface = Surface(moving, fixed, gamma, gamma_fixed, stated.lay_angle)
    except InputError as reason:
        key = "peklenik" if "eklenik" in reason.where else "moving"
        table.fault(key, reason.found, reason.expected)
        return None, []
    found = RoughnessSection(
        moving=moving, fixed=fixed, peklenik_moving=gamma, peklenik_fixed=gamma_fixed, lay_angle=stated.lay_angle
    )
    return surface, [*section_rows("roughness", found)]


def _asperities(table: Table, surface: Surface) -> tuple[Asperities | None, list[str]]:
    special = {"contact.youngs_modulus": _modulus, "contact.poissons_ratio": lambda *_: {}}
    reading = Reading(special=special, faults=table.faults)
    stated = read_section("contact", ContactSection, table.values, reading)
    if reading.faulty:
        return None, []
    height = surface.composite_roughness if stated.asperity_height is None else stated.asperity_height
    try:
        asperities = Asperities(
            stated.asperity_density, stated.asperity_radius, height, stated.composite_modulus,
            stated.friction_coefficient, stated.summit_height,
        )  # fmt: skip
    except InputError as reason:
        table.fault("friction_coefficient", reason.found, reason.expected)
        return None, []
    return asperities, [*section_rows("contact", replace(stated, asperity_height=height))]


def _modulus(_: object, values: Mapping[str, object], reading: Reading) -> Mapping[str, float]:
    """Return E' of both walls from the moduli and Poisson's ratios of the two; none with its fault noted."""
    table = Table("contact", values, reading.faults)
    moduli, ratios = table.pair("youngs_modulus", Dimension.ELASTICITY), table.get("poissons_ratio")
    is_pair = isinstance(ratios, list) and len(ratios) == 2
    if not is_pair or not all(isinstance(ratio, (int, float)) and -1.0 < ratio < 0.5 for ratio in ratios):
        table.fault("poissons_ratio", repr(ratios), "two numbers between -1 and 0.5, of the two walls")
    elif moduli is not None:
        return {"composite_modulus": composite_modulus(moduli[0], ratios[0], moduli[1], ratios[1])}
    reading.faulty.add("contact.composite_modulus")
    return {}
