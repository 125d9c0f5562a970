"""Physics of floating gaps: the keys of a case that choose it, and its summary."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from gaps.films.physics import Effect, Physics
from gaps.revolution.march import Leg


class WallChoice(Enum):
    """Elastic or rigid parts under the pressure of film and contact."""

    ELASTIC = "elastic"
    RIGID = "rigid"


class OilChoice(Enum):
    """Viscosity with or without dependence on pressure."""

    PRESSURE_VISCOSITY = "pressure_viscosity"
    ISOVISCOUS = "isoviscous"


class SurfaceChoice(Enum):
    """Rough walls (flow factors, contact of asperities) or smooth walls."""

    ROUGH = "rough"
    SMOOTH = "smooth"


class CavitationChoice(Enum):
    """Cavitation that conserves oil mass, or full films with tension below the cavity's pressure."""

    JFO = "jfo"
    NONE = "none"


class HeatChoice(Enum):
    """Temperature of films and parts: solved, or that of the case."""

    SOLVED = "solved"
    NONE = "none"


# Effect: key, the choice with it, the choice without it.
_KEYS: dict[Effect, tuple[str, Enum, Enum]] = {
    Effect.ELASTIC_WALLS: ("walls", WallChoice.ELASTIC, WallChoice.RIGID),
    Effect.PRESSURE_VISCOSITY: ("oil", OilChoice.PRESSURE_VISCOSITY, OilChoice.ISOVISCOUS),
    Effect.ROUGHNESS: ("surfaces", SurfaceChoice.ROUGH, SurfaceChoice.SMOOTH),
    Effect.CAVITATION: ("cavitation", CavitationChoice.JFO, CavitationChoice.NONE),
    Effect.HEAT: ("heat", HeatChoice.SOLVED, HeatChoice.NONE),
}

PHYSICS_HEAD = ("physics", "is", "switch", "time of the gaps")
_SUMMARY = {
    Effect.CAVITATION: ("mass-conserving cavitation", "--no-cavitation", None),
    Effect.ROUGHNESS: ("rough walls, contact of asperities", "--smooth", Leg.RIGID),
    Effect.PRESSURE_VISCOSITY: ("viscosity dependent on pressure", "--isoviscous", None),
    Effect.ELASTIC_WALLS: ("elastic walls", "--rigid", Leg.ELASTIC),
    Effect.HEAT: ("temperature of films and parts", "--isothermal", Leg.HEAT),
}
"""Each effect in words, its switch, and the march that ends with it (its time includes all before it)."""


@dataclass(frozen=True, kw_only=True)
class SwitchesSection:
    """[physics]: physics of a gap; what is left out is as usual."""

    walls: WallChoice | None = None
    oil: OilChoice | None = None
    surfaces: SurfaceChoice | None = None
    cavitation: CavitationChoice | None = None
    heat: HeatChoice | None = None

    def physics(self, usual: Physics) -> Physics:
        """Return the physics, with `usual` where nothing is chosen."""
        found = usual
        for effect, (key, on, off) in _KEYS.items():
            choice = getattr(self, key) or (off if effect in usual.left_out else on)
            found = found.without(effect) if choice is off else found.including(effect)
        return found


def choices(physics: Physics) -> dict[str, Any]:
    """Return the choices by key from which a `SwitchesSection` has this physics."""
    return {key: off if effect in physics.left_out else on for effect, (key, on, off) in _KEYS.items()}


def effects_of(keys: Collection[str]) -> list[Effect]:
    """Return the effects that some keys choose."""
    return [effect for effect, (key, *_) in _KEYS.items() if key in keys]


def effect_rows(left_out: Sequence[str], seconds: Mapping[str, float]) -> list[tuple[str, ...]]:
    """Return a row for each effect; `left_out` and `seconds` (s, by march) are those of summary.json."""
    rows: list[tuple[str, ...]] = []
    for effect, (what, switch, leg) in _SUMMARY.items():
        took = "" if leg is None or leg.value not in seconds else f"{seconds[leg.value]:.1f} s"
        rows.append((what, "off" if effect.value in left_out else "on", switch, took))
    return rows
