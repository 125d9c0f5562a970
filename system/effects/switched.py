"""The effects that a pump's description switches on, with the values it states."""

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce

from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.catalogue.entries import EXTENSIONS
from system.effects.effect import BenchState, EffectId, Effects, GapCourse, both
from system.effects.extension import Extension, Law, Values
from system.effects.opening_tables import COMPLIANCE, SolvedOpening, opening_table
from system.effects.state import unchanged


def switched_on(pump: PumpDescription) -> Iterator[tuple[Extension, Values]]:
    """Every extension of which the pump has a table below [physics], in the form that states it, and its values."""
    for extension in EXTENSIONS:
        section = getattr(pump.physics, extension.id.value)
        if section is not None and extension.pair is not None:
            section = getattr(section, extension.pair.value)
        if section is not None:
            values = {key: float(value) for key, value in vars(section).items() if value is not None}
            yield extension.form_of(values), values


def stated_laws(pump: PumpDescription) -> tuple[tuple[Law, Values], ...]:
    """The laws of all of them with their values; films between elastic walls are read if kept, else solved."""
    return tuple((_law(pump, extension, values), values) for extension, values in switched_on(pump))


def _law(pump: PumpDescription, extension: Extension, values: Values) -> Law:
    if extension.id is EffectId.ELASTIC_OPENING and COMPLIANCE in values and extension.pair is not None:
        return SolvedOpening(opening_table(pump, extension.pair))
    return extension.law


def stated_effects(laws: Sequence[tuple[Law, Values]], courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
    """Combined changes by `stated_laws`; neutral where all are off."""
    found = (law(values, courses, state) for law, values in laws)
    return reduce(both, found, unchanged(courses))
