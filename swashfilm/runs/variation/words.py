"""Words of the commands on varied pumps: its operating points, and changes as people read them."""

from __future__ import annotations

from typing import Any

import numpy as np

from swashfilm.runs.variation.case import VariedCase
from system.description.keys import PumpKey
from system.inputs.shown import quantity_text
from system.inputs.units import Dimension, in_unit, reading_unit
from system.maps.plan import MapInput, point_words
from system.variation.sensitivity import PERCENT, unit_change


def where(case: VariedCase) -> dict[str, Any]:
    """Return the entries of a summary with the operating points and the solver of a pump."""
    levels = {axis.input.value: list(axis.values) for axis in case.plan.axes}
    points = case.work.sites.points
    words = point_words(points[0]) if len(points) == 1 else _levels_words(case)
    return {
        "fidelity": case.fidelity.value,
        "solver": case.work.solver.words,
        "at": f"{case.work.sites.words}: {words}",
        "points": len(points),
        "levels": levels,
        "weights": case.work.sites.weights.tolist(),
    }


def _levels_words(case: VariedCase) -> str:
    parts = []
    for axis in case.plan.axes:
        ends = " to ".join(dict.fromkeys(axis.input.text(value) for value in (axis.values[0], axis.values[-1])))
        parts.append(f"{axis.input.words} {ends}" if axis.input is not MapInput.RATIO else f"ratio {ends}")
    return ", ".join(parts)


def change_text(key: PumpKey) -> str:
    """Return the change by which a cost is stated: "1 um", "1 deg", "1 %" with its size."""
    if key.dimension is Dimension.LENGTH:
        return "1 um"
    if key.dimension is Dimension.ANGLE:
        return "1 deg"
    return "1 %" if key.value != 0.0 else size_text(key, unit_change(key))


def percent_of(key: PumpKey) -> float | None:
    """Return 1 % of a dimension, SI; None of one that is zero."""
    return PERCENT * abs(key.value) or None


def size_text(key: PumpKey, size: float) -> str:
    """Return a difference of a dimension as people read it."""
    if key.dimension is None:
        return f"{size:.3g}"
    if key.dimension is Dimension.ANGLE:
        return f"{np.degrees(size):.3g} deg"
    return quantity_text(size, key.dimension, digits=3)


def key_unit(key: PumpKey) -> tuple[str, float]:
    """Return the unit that people read a dimension in, and its factor on SI; a temperature in K."""
    if key.dimension is None:
        return "1", 1.0
    if key.dimension is Dimension.TEMPERATURE:
        return "K", 1.0
    if key.dimension is Dimension.ANGLE:
        return "deg", 180.0 / np.pi
    unit = reading_unit(key.value, key.dimension)
    return unit, in_unit(1.0, unit, key.dimension)
