"""The operating point: the inputs of a run, and the viscosity of the oil there."""

from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar, cast

import numpy as np

from reynolds.laws.oil import dynamic_viscosity
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.pump.laws.kinematics import Number

Of = TypeVar("Of")


@dataclass(frozen=True)
class OperatingPoint(Generic[Number]):
    """One steady point. Speed in rad/s, pressures in Pa gauge, temperature in K, viscosity in Pa s.

    OperatingPoint[Array]: N points at once, each value a column (N, 1).
    """

    shaft_speed: Number
    delivery_pressure: Number
    inlet_pressure: Number
    case_pressure: Number
    displacement_ratio: Number
    temperature: Number
    viscosity: Number


def columns(point: OperatingPoint) -> OperatingPoint[Array]:
    """One point as N = 1 points, columns (1, 1)."""
    return OperatingPoint(**{name: np.full((1, 1), value) for name, value in vars(point).items()})


def flat(item: Of) -> Of:
    """The same dataclass with its columns (N, 1) as arrays (N,); numbers stay."""
    changed = {name: value.ravel() for name, value in vars(item).items() if isinstance(value, np.ndarray)}
    made: Any = replace(cast(Any, item), **changed)
    return cast(Of, made)


def operating_point(
    pump: PumpDescription,
    *,
    shaft_speed: float | None = None,
    delivery_pressure: float | None = None,
    inlet_pressure: float | None = None,
    case_pressure: float | None = None,
    displacement_ratio: float | None = None,
    temperature: float | None = None,
) -> OperatingPoint:
    """Return the operating point of the description's [operating] table, with the given values in place of its own.

    The viscosity is that of the pump's oil at the temperature, at case pressure. Raises ValueError where the oil's law
    is not valid; `system.pump_file.operating.check_operating_point` checks the rest.
    """
    stated = pump.operating
    kelvin = stated.temperature if temperature is None else temperature
    return OperatingPoint(
        shaft_speed=stated.speed if shaft_speed is None else shaft_speed,
        delivery_pressure=stated.pressure if delivery_pressure is None else delivery_pressure,
        inlet_pressure=stated.inlet_pressure if inlet_pressure is None else inlet_pressure,
        case_pressure=stated.case_pressure if case_pressure is None else case_pressure,
        displacement_ratio=stated.displacement_ratio if displacement_ratio is None else displacement_ratio,
        temperature=kelvin,
        viscosity=dynamic_viscosity(pump.oil.fluid, kelvin),
    )
