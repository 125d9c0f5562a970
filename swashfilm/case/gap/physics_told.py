"""What a report tells of the physics of floating gaps: what is on, how it is switched, and what it took."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from gaps.films.physics import Effect
from gaps.revolution.march import Leg

PHYSICS_HEAD = ("physics", "is", "switch", "time of the gaps")
_TOLD = {
    Effect.CAVITATION: ("cavities that keep their oil", "--no-cavitation", None),
    Effect.ROUGHNESS: ("rough walls, contact of asperities", "--smooth", Leg.RIGID),
    Effect.PRESSURE_VISCOSITY: ("oil that stiffens with pressure", "--isoviscous", None),
    Effect.ELASTIC_WALLS: ("walls that give way", "--rigid", Leg.ELASTIC),
    Effect.HEAT: ("films and parts that warm", "--heat", Leg.HEAT),
}
"""Each effect in words, its switch, and the leg that ends with it: its time is of all before it."""


def physics_told(left_out: Sequence[str], seconds: Mapping[str, float]) -> list[tuple[str, ...]]:
    """A row an effect; `left_out` and `seconds` (s, by leg) as summary.json has them."""
    rows: list[tuple[str, ...]] = []
    for effect, (what, switch, leg) in _TOLD.items():
        took = "" if leg is None or leg.value not in seconds else f"{seconds[leg.value]:.1f} s"
        rows.append((what, "off" if effect.value in left_out else "on", switch, took))
    return rows
