"""Displacement, films and friction of a recording that contradict the type plate of its pump."""

from __future__ import annotations

from collections.abc import Iterator
from math import log

from diagnosis.recording.model import DataNote, NoteKind
from system.bench.parameters import base_parameters
from system.description.pump import PumpDescription
from system.description.tolerances import Tolerances
from system.inputs.units import Dimension, format_quantity

OF_DISPLACEMENT = 0.03
"""Largest relative error of a plate: makers round by less."""
OF_LEVELS = 4.0
"""Factor on the film that is widest for its gap, or on friction: two sigma of pumps of one size. One film alone may be
far thinner: its gap then has no leakage, and the others have all of the drain."""


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
    ratios = {name: after[name] / value for name, value in before.items() if value > 0.0}
    films = {name: ratio for name, ratio in ratios.items() if name.startswith("film_thickness.")}
    widest = max(films, key=films.__getitem__, default=None)
    if widest is not None and _is_far(films[widest]):
        film, usual = (_shown(each[widest], Dimension.LENGTH) for each in (after, before))
        gap = widest.rpartition(".")[2].replace("_", " ")
        yield _warning(
            f"leakage: the recording asks for films {_times(films[widest])} those of a pump of this size, {film} for "
            f"{usual} at the {gap}. The pump is taken with them: check the flows, their units, and the oil"
        )
    friction = next((ratio for name, ratio in ratios.items() if name.startswith("friction.")), 1.0)
    if _is_far(friction):
        yield _warning(
            f"torque: the recording asks for {_times(friction)} the friction of a pump of this size. The pump is taken "
            "with it: check that torque and pressures are what their columns say"
        )


def _is_far(ratio: float) -> bool:
    return abs(log(ratio)) > log(OF_LEVELS)


def _warning(text: str) -> DataNote:
    return DataNote(NoteKind.WARNED, None, (), text)


def _shown(value: float, dimension: Dimension) -> str:
    return format_quantity(value, dimension, digits=3)


def _times(ratio: float) -> str:
    """A ratio in words: "8 times", "1/8 of"."""
    return f"{ratio:.2g} times" if ratio > 1.0 else f"1/{1.0 / ratio:.2g} of"
