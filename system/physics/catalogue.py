"""The catalogue: every effect that can be named, but what stands in none."""

from __future__ import annotations

from system.physics.catalogue_films import FILM_ENTRIES
from system.physics.catalogue_pump import PUMP_ENTRIES
from system.physics.catalogue_readings import PARAMETER_ENTRIES, SENSOR_ENTRIES
from system.physics.effects import EffectId
from system.physics.extension import Entry, Extension

CATALOGUE: tuple[Entry, ...] = (*FILM_ENTRIES, *PUMP_ENTRIES, *SENSOR_ENTRIES, *PARAMETER_ENTRIES)
EXTENSIONS: tuple[Extension, ...] = tuple(one for entry in CATALOGUE for one in entry.extensions)


def entry_of(effect: EffectId) -> Entry:
    """The entry of an effect; raises ValueError for unknown physics, which has none."""
    for entry in CATALOGUE:
        if entry.id is effect:
            return entry
    raise ValueError(f"{effect.value}: stands in no catalogue")
