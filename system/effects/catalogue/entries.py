"""The catalogue: every effect that can be named, without unknown physics."""

from dataclasses import replace

from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.catalogue.films import FILM_ENTRIES
from system.effects.catalogue.pump import PUMP_ENTRIES
from system.effects.catalogue.readings import PARAMETER_ENTRIES, SENSOR_ENTRIES
from system.effects.catalogue.solved import SOLVED_ENTRIES
from system.effects.effect import EffectId
from system.effects.extension import Entry, Extension
from system.effects.opening_tables import COMPLIANCE, OpeningTable, SolvedOpening, opening_table
from system.effects.priors import half, path_of
from system.work.progress import Report, silent

CATALOGUE: tuple[Entry, ...] = (*FILM_ENTRIES, *PUMP_ENTRIES, *SENSOR_ENTRIES, *PARAMETER_ENTRIES)
EXTENSIONS: tuple[Extension, ...] = tuple(one for entry in CATALOGUE for one in entry.extensions)


def with_films_solved(pump: PumpDescription, report: Report = silent) -> tuple[Entry, ...]:
    """The catalogue with the laws of this pump's films as far as the film solver gives them: elastic walls.

    Their films are solved where they are not kept from before, some forty seconds in all; raises NotConverged as
    `opening_table`.
    """
    solved = tuple(_solved(opening_table(pump, gap, report)) for gap in Gap)
    return tuple(
        replace(entry, extensions=solved) if entry.id is EffectId.ELASTIC_OPENING else entry for entry in CATALOGUE
    )


def _solved(table: OpeningTable) -> Extension:
    name = path_of(EffectId.ELASTIC_OPENING, COMPLIANCE, table.gap)
    source = f"1: walls as drawing and material make them; films solved, to {table.error:.1%} between them"
    return Extension(EffectId.ELASTIC_OPENING, table.gap, SolvedOpening(table), (half(name, 1.0, 1.5, None, source),))


def entry_of(effect: EffectId) -> Entry:
    """The entry of an effect; raises ValueError for unknown physics, which has no entry."""
    for entry in (*CATALOGUE, *SOLVED_ENTRIES):
        if entry.id is effect:
            return entry
    raise ValueError(f"{effect.value}: not in the catalogue")
