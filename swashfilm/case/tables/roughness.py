"""Tables [roughness] and [contact] of a film case: rough walls and contact of their asperities."""

from __future__ import annotations

from dataclasses import dataclass

from reynolds.errors import InputError
from reynolds.laws.contact import Asperities, composite_modulus
from reynolds.laws.roughness import Surface
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity


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
            for key in contact.values:
                contact.get(key)
            top.fault("contact", "no table [roughness]", "the roughness of the walls in contact")
        return None
    surface, rows = _surface(table)
    if contact is None or surface is None:
        return RoughWalls(surface, None, tuple(rows)) if surface else None
    asperities, more = _asperities(contact, surface)
    return RoughWalls(surface, asperities, (*rows, "", *more)) if asperities else None


def _surface(table: Table) -> tuple[Surface | None, list[str]]:
    """Return the surface by its standard deviations: of both walls together, or of each wall."""
    if table.get("composite") is not None:
        # Flow factors depend on which wall is rough: half of a composite variance is assigned to each wall.
        composite = table.positive("composite", Dimension.LENGTH)
        moving = fixed = None if composite is None else composite / 2.0**0.5
        for wall in ("moving", "fixed"):
            if table.get(wall) is not None:
                table.fault(wall, "a wall's height beside composite", "composite, or moving and fixed")
    else:
        moving, fixed = (_height(table, wall) for wall in ("moving", "fixed"))
    gammas = [table.number(f"peklenik_{wall}", table.number("peklenik", 1.0)) for wall in ("moving", "fixed")]
    lay = table.quantity("lay_angle", Dimension.ANGLE, 0.0)
    table.close()
    if moving is None or fixed is None or None in gammas or lay is None:
        return None, []
    if moving == fixed == 0.0:
        table.fault("moving", "two smooth walls", "moving or fixed above 0, or no table [roughness]")
        return None, []
    try:
        surface = Surface(moving, fixed, float(gammas[0] or 0.0), float(gammas[1] or 0.0), lay)
    except InputError as reason:
        key = "peklenik" if "eklenik" in reason.where else "moving"
        table.fault(key, reason.found, reason.expected)
        return None, []
    shown = [
        f'{key} = "{format_quantity(value, Dimension.LENGTH)}"'
        for key, value in (("moving", moving), ("fixed", fixed))
    ]
    shown += [f"peklenik_moving = {gammas[0]!r}", f"peklenik_fixed = {gammas[1]!r}"]
    return surface, ["[roughness]", *shown, f'lay_angle = "{format_quantity(lay, Dimension.ANGLE)}"']


def _height(table: Table, wall: str) -> float | None:
    """Return the standard deviation of a wall's heights (m), zero for a smooth wall."""
    value = table.quantity(wall, Dimension.LENGTH, 0.0)
    if value is not None and value < 0.0:
        table.fault(wall, str(table.values[wall]), "a height of 0 (smooth) or more")
        return None
    return value


def _asperities(table: Table, surface: Surface) -> tuple[Asperities | None, list[str]]:
    density = table.positive("asperity_density", Dimension.AREAL_DENSITY)
    radius = table.positive("asperity_radius", Dimension.LENGTH)
    height = table.positive("asperity_height", Dimension.LENGTH, surface.composite_roughness)
    modulus = _modulus(table)
    friction = table.number("friction_coefficient")
    summit = table.quantity("summit_height", Dimension.LENGTH, 0.0)
    table.close()
    if (
        density is None
        or radius is None
        or height is None
        or modulus is None
        or friction is None
        or summit is None
    ):
        return None, []
    try:
        asperities = Asperities(density, radius, height, modulus, friction, summit)
    except InputError as reason:
        table.fault("friction_coefficient", reason.found, reason.expected)
        return None, []
    rows = ["[contact]"]
    for key, value, dimension in (
        ("asperity_density", density, Dimension.AREAL_DENSITY),
        ("asperity_radius", radius, Dimension.LENGTH),
        ("asperity_height", height, Dimension.LENGTH),
        ("composite_modulus", modulus, Dimension.ELASTICITY),
        ("summit_height", summit, Dimension.LENGTH),
    ):
        rows.append(f'{key} = "{format_quantity(value, dimension)}"')
    return asperities, [*rows, f"friction_coefficient = {friction!r}"]


def _modulus(table: Table) -> float | None:
    """Return E' of both walls: stated, or from the moduli and Poisson's ratios of the two."""
    if "youngs_modulus" not in table.values:
        return table.positive("composite_modulus", Dimension.ELASTICITY)
    moduli, ratios = table.pair("youngs_modulus", Dimension.ELASTICITY), table.get("poissons_ratio")
    is_pair = isinstance(ratios, list) and len(ratios) == 2
    if not is_pair or not all(isinstance(ratio, (int, float)) and -1.0 < ratio < 0.5 for ratio in ratios):
        table.fault("poissons_ratio", repr(ratios), "two numbers between -1 and 0.5, of the two walls")
        return None
    return None if moduli is None else composite_modulus(moduli[0], ratios[0], moduli[1], ratios[1])
