"""Tables [roughness] and [contact] of a film case: rough walls and contact of their asperities."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from reynolds.errors import InputError
from reynolds.laws.contact import Asperities, composite_modulus
from reynolds.laws.patir_cheng import HIGHEST_PEKLENIK, LOWEST_PEKLENIK
from reynolds.laws.roughness import Surface
from system.inputs.sections.fields import (
    AnyLength,
    ArealDensity,
    Coefficient,
    Elasticity,
    Height,
    Limits,
    Micrometres,
    NotNegative,
    Positive,
    Several,
)
from system.inputs.sections.reader import table_section
from system.inputs.toml_table import Table
from system.inputs.units import Dimension

WallHeight = Annotated[float, Dimension.LENGTH, NotNegative, Micrometres]
Peklenik = Annotated[float, Limits(least=LOWEST_PEKLENIK * (1.0 - 1e-9), most=HIGHEST_PEKLENIK * (1.0 + 1e-9))]


@dataclass(frozen=True, kw_only=True)
class RoughnessSection:
    """[roughness]: standard deviation of heights, of both walls together or of each."""

    composite: Height | None = None  # in place of moving and fixed
    moving: WallHeight | None = None  # left out: smooth
    fixed: WallHeight | None = None  # left out: smooth
    peklenik: Peklenik | None = None  # of both walls, left out: 1
    peklenik_moving: Peklenik | None = None
    peklenik_fixed: Peklenik | None = None
    lay_angle: Annotated[float, Dimension.ANGLE] = 0.0

    def __post_init__(self) -> None:
        for key, height in (("moving", self.moving), ("fixed", self.fixed)):
            if self.composite is not None and height is not None:
                raise InputError(key, "a wall's height beside composite", "composite, or moving and fixed")
        if not (self.composite or self.moving or self.fixed):
            raise InputError("moving", "two smooth walls", "moving or fixed above 0, or no table [roughness]")

    @property
    def filled(self) -> RoughnessSection:
        """The same roughness, stated for each wall."""
        # Flow factors depend on which wall is rough: half of a composite variance is assigned to each wall.
        half = None if self.composite is None else self.composite / 2.0**0.5
        both = 1.0 if self.peklenik is None else self.peklenik
        return RoughnessSection(
            moving=half or self.moving or 0.0, fixed=half or self.fixed or 0.0, lay_angle=self.lay_angle,
            peklenik_moving=self.peklenik_moving or both, peklenik_fixed=self.peklenik_fixed or both,
        )  # fmt: skip

    @property
    def surface(self) -> Surface:
        """Both walls for the film."""
        own = self.filled
        heights = own.moving or 0.0, own.fixed or 0.0
        return Surface(*heights, own.peklenik_moving or 1.0, own.peklenik_fixed or 1.0, own.lay_angle)


@dataclass(frozen=True, kw_only=True)
class ContactSection:
    """[contact]: asperities of the walls."""

    asperity_density: ArealDensity
    asperity_radius: Height
    asperity_height: Height | None = None  # standard deviation of summits; left out: the walls' composite
    composite_modulus: Elasticity | None = None  # E' of both walls, in place of the two keys below
    youngs_modulus: Annotated[tuple[float, float], Several(2), Dimension.ELASTICITY, Positive] | None = None  # by wall
    poissons_ratio: Annotated[tuple[float, float], Several(2), Limits(above=-1.0, below=0.5)] | None = None  # by wall
    summit_height: Annotated[AnyLength, Micrometres] = 0.0
    friction_coefficient: Coefficient

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

    def filled(self, surface: Surface) -> ContactSection:
        """Return the same asperities with E' of both walls, and the walls' own height where it is left out."""
        own, height = self.modulus, self.asperity_height or surface.composite_roughness
        return replace(self, composite_modulus=own, youngs_modulus=None, poissons_ratio=None, asperity_height=height)

    def asperities(self, surface: Surface) -> Asperities:
        """Return the asperities of the walls."""
        height = self.asperity_height or surface.composite_roughness
        own = self.asperity_density, self.asperity_radius, height, self.modulus, self.friction_coefficient
        return Asperities(*own, self.summit_height)


def read_roughness(top: Table) -> tuple[RoughnessSection | None, ContactSection | None]:
    """Return roughness and contact, filled in; None if the table is absent, or with its faults listed."""
    roughness = table_section(top, "roughness", RoughnessSection)
    contact = table_section(top, "contact", ContactSection)
    if top.get("contact") is not None and top.get("roughness") is None:
        top.fault("contact", "no table [roughness]", "the roughness of the walls in contact")
    if roughness is None:
        return None, None
    return roughness.filled, contact and contact.filled(roughness.surface)
