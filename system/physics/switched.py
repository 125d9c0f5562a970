"""The effects that a pump's description switches on, with the values it states."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce

from reynolds.errors import FilmInputError
from system.description import PumpDescription
from system.physics.catalogue import EXTENSIONS
from system.physics.effects import BenchState, Effects, GapCourse, both
from system.physics.extension import Extension, Values
from system.physics.state import unchanged
from system.pump_gap import Gap


def switched_on(pump: PumpDescription) -> Iterator[tuple[Extension, Values]]:
    """Every extension of which the pump has a table below [physics], with its law's values."""
    for extension in EXTENSIONS:
        section = getattr(pump.physics, extension.id.value)
        if section is not None and extension.pair is not None:
            section = getattr(section, extension.pair.value)
        if section is not None:
            yield extension, {key: float(value) for key, value in dict(section).items()}


def hold_plain(pump: PumpDescription) -> None:
    """Raise FilmInputError where a pump has effects switched on that a fidelity does not read."""
    if pump.physics.on:
        found = ", ".join(dict.fromkeys(extension.id.value for extension, _ in switched_on(pump)))
        raise FilmInputError("physics", found, "no effects, or the lumped fidelity, which alone reads them")


def stated_effects(pump: PumpDescription, courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
    """What all of them change together; nothing where none is on."""
    found = (extension.law(values, courses, state) for extension, values in switched_on(pump))
    return reduce(both, found, unchanged(courses))
