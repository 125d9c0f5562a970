"""Levels of a recording that a pump of this type plate hardly has: what is off, before any hypothesis is asked."""

from __future__ import annotations

from collections.abc import Iterator
from math import log

from diagnosis.recording.model import DataNote, NoteKind
from system.bench.parameters import base_parameters
from system.description.pump import PumpDescription
from system.description.tolerances import Tolerances
from system.inputs.units import Dimension, format_quantity

OF_DISPLACEMENT = 0.03
"""Share by which a plate may be off: makers round by less."""
OF_LEVELS = 4.0
"""Factor on the film that is widest for its gap, or on friction: two sigma of pumps of one size. One film alone may be
far less: its gap then leaks nothing, and the others what the drain has."""


def far_levels(stated: PumpDescription, fitted: PumpDescription, allowed: Tolerances) -> Iterator[DataNote]:
    """Warnings where displacement, films or friction at the level of a recording are far from those of the pump.

    stated: the pump of the file; fitted: the same at the level of the recording.
    """
    own, other = stated.pump.displacement, fitted.pump.displacement
    if own is not None and other is not None and abs(log(other / own)) > OF_DISPLACEMENT:
        yield _warning(
            f"displacement: the pump file states {_shown(own, Dimension.DISPLACEMENT)}, the recording is of "
            f"{_shown(other, Dimension.DISPLACEMENT)}. The pump is taken with the latter: correct pump.displacement, "
            "or the column or unit that is wrong (speed, flow, displacement_ratio)"
        )
    before, after = ({one.name: one.centre for one in base_parameters(pump, allowed)} for pump in (stated, fitted))
    films = [name for name in before if name.startswith("film_thickness.")]
    widest = max(films, key=lambda name: after[name] / before[name], default=None)
    if widest is not None and abs(log(after[widest] / before[widest])) > log(OF_LEVELS):
        film, usual = (_shown(each[widest], Dimension.LENGTH) for each in (after, before))
        gap, times = widest.rpartition(".")[2].replace("_", " "), _times(after[widest], before[widest])
        yield _warning(
            f"leakage: the recording asks for films {times} those of a pump of this size, {film} for {usual} at the "
            f"{gap}. The pump is taken with them: check the flows, their units, and the oil"
        )
    friction = [name for name in before if name.startswith("friction.") and before[name] > 0.0]
    if friction and abs(log(after[friction[0]] / before[friction[0]])) > log(OF_LEVELS):
        yield _warning(
            f"torque: the recording asks for {_times(after[friction[0]], before[friction[0]])} the friction of a pump "
            "of this size. The pump is taken with it: check that torque and pressures are what their columns say"
        )


def _warning(text: str) -> DataNote:
    return DataNote(NoteKind.WARNED, None, (), text)


def _shown(value: float, dimension: Dimension) -> str:
    return format_quantity(value, dimension, digits=3)


def _times(after: float, before: float) -> str:
    """How many times one value is the other: "8 times", "1/8 of"."""
    return f"{after / before:.2g} times" if after > before else f"1/{before / after:.2g} of"
