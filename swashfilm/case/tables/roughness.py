"""Tables [roughness] and [contact] of a film case: rough walls and contact of their asperities."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from reynolds.errors import InputError
from reynolds.laws.contact import Asperities, composite_modulus
from reynolds.laws.roughness import Surface
from system.inputs.sections.fields import (
    AnyLength,
    ArealDensity,
    Elasticity,
    Length,
    Limits,
    NotNegative,
    Positive,
    Several,
)
from system.inputs.sections.reader import Reading, read_section, table_section
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
    composite_modulus: Elasticity | None = None  # E' of both walls, in place of the two keys below
    youngs_modulus: Annotated[tuple[float, float], Several(2), Dimension.ELASTICITY, Positive] | None = None  # by wall
    poissons_ratio: Annotated[tuple[float, float], Several(2), Limits(above=-1.0, below=0.5)] | None = None  # by wall
    summit_height: AnyLength = 0.0
    friction_coefficient: float

    def __post_init__(self) -> None:
        of_walls = {"youngs_modulus": self.youngs_modulus, "poissons_ratio": self.poissons_ratio}
        for key, pair in of_walls.items():
            if (pair is None) is (self.composite_modulus is None):
                found = "missing" if pair is None else f"{key} beside composite_modulus"
                raise InputError(key, found, "composite_modulus, or youngs_modulus and poissons_ratio of the two walls")

    @property
    def modulus(self) -> float:
        """E' of both walls, Pa."""
        if self.youngs_modulus is None or self.poissons_ratio is None:
            assert self.composite_modulus is not None
            return self.composite_modulus
        (one, other), (ratio, other_ratio) = self.youngs_modulus, self.poissons_ratio
        return composite_modulus(one, ratio, other, other_ratio)


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
    asperities, more = _asperities(top, surface)
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


def _asperities(top: Table, surface: Surface) -> tuple[Asperities | None, list[str]]:
    stated = table_section(top, "contact", ContactSection)
    if stated is None:
        return None, []
    height = surface.composite_roughness if stated.asperity_height is None else stated.asperity_height
    try:
        asperities = Asperities(
            stated.asperity_density, stated.asperity_radius, height, stated.modulus,
            stated.friction_coefficient, stated.summit_height,
        )  # fmt: skip
    except InputError as reason:
        top.fault("contact.friction_coefficient", reason.found, reason.expected)
        return None, []
    return asperities, [*section_rows("contact", replace(stated, asperity_height=height))]
