"""ref90's parts driven at an operating point: its gaps alone, rigid walls, chamber pressure by the lumped cycle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from gaps import Accuracy
from system import (
    RIGID,
    Drives,
    FloatingOptions,
    FloatingParts,
    Rotor,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    rotor,
)

COARSE = FloatingOptions(RIGID, steps=36, accuracy=Accuracy(step=3e-2), finer=0.5)


@dataclass(frozen=True)
class At:
    """An operating point in the units of the paper: MPa, r/min, 1, degC; pressures gauge."""

    pressure: float = 35.0
    speed: float = 2100.0
    ratio: float = 1.0
    temperature: float = 50.0
    inlet: float = 2.5
    case: float = 0.15


def driven(
    at: At, changed: Mapping[str, object] | None = None, *, motoring: bool = False
) -> tuple[Rotor, FloatingParts, Drives]:
    """Parts and drives of ref90 at `at`, with other values of the keys `changed` of its file.

    motoring: the ports' pressures change places, so that the pistons are pushed out.
    """
    pump = load_pump(
        "ref90",
        {
            "operating.pressure": f"{at.pressure} MPa",
            "operating.speed": f"{at.speed} rpm",
            "operating.displacement_ratio": at.ratio,
            "operating.temperature": f"{at.temperature} degC",
            "operating.inlet_pressure": f"{at.inlet} MPa",
            "operating.case_pressure": f"{at.case} MPa",
            **(changed or {}),
        },
    )
    point = operating_point(pump)
    if motoring:
        high, low = point.delivery_pressure, point.inlet_pressure
        point = replace(point, delivery_pressure=low, inlet_pressure=high)
    cycle = lumped_point(pump, point).cycle
    group, parts = rotor(pump, point), floating_parts(pump)
    return group, parts, drives(group, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size))
