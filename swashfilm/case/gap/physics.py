"""Which physics floating gaps have, as the keys of a table choose it."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum

from gaps.films.physics import Effect, Physics
from system.inputs.toml_table import Table


class Walls(Enum):
    """Whether the parts give way under film and contact."""

    ELASTIC = "elastic"
    RIGID = "rigid"


class Oil(Enum):
    """Whether oil stiffens with pressure."""

    PRESSURE_VISCOSITY = "pressure_viscosity"
    ISOVISCOUS = "isoviscous"


class Surfaces(Enum):
    """Whether walls are rough: flow factors and contact of asperities."""

    ROUGH = "rough"
    SMOOTH = "smooth"


class Rupture(Enum):
    """Whether the film cavitates, oil conserved, or is pulled below the cavity's pressure."""

    JFO = "jfo"
    NONE = "none"


class Warmth(Enum):
    """Whether films and parts warm, or keep the case's temperature."""

    SOLVED = "solved"
    NONE = "none"


# Effect: key, the choice with it, the choice without it.
_KEYS: dict[Effect, tuple[str, Enum, Enum]] = {
    Effect.ELASTIC_WALLS: ("walls", Walls.ELASTIC, Walls.RIGID),
    Effect.PRESSURE_VISCOSITY: ("oil", Oil.PRESSURE_VISCOSITY, Oil.ISOVISCOUS),
    Effect.ROUGHNESS: ("surfaces", Surfaces.ROUGH, Surfaces.SMOOTH),
    Effect.CAVITATION: ("cavitation", Rupture.JFO, Rupture.NONE),
    Effect.HEAT: ("heat", Warmth.SOLVED, Warmth.NONE),
}


def read_physics(table: Table, usual: Physics) -> Physics:
    """The physics that `walls`, `oil`, `surfaces`, `cavitation` and `heat` of a table choose.

    What is left out is `usual`. Faults are told in the table's list.
    """
    found = usual
    for effect, (key, on, off) in _KEYS.items():
        choice = table.choice(key, type(on), off if effect in usual.left_out else on)
        found = found.without(effect) if choice is off else found.including(effect)
    return found


def physics_rows(physics: Physics) -> Iterator[str]:
    """The keys that `read_physics` reads back to this physics."""
    for effect, (key, on, off) in _KEYS.items():
        yield f'{key} = "{(off if effect in physics.left_out else on).value}"'
