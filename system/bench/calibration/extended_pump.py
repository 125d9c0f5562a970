"""The pump that a fit of its readings makes: parameters at their values, effects switched on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from reynolds.numerics.arrays import Array
from system.bench.parameters import pump_with
from system.description.effects import PhysicsSection
from system.description.pump import PumpDescription
from system.effects.extension import Extension
from system.estimation.parameters import Parameter


def values_by_name(parameters: Sequence[Parameter], values: Array) -> dict[str, float]:
    """Values (k,) by the names of their parameters, held to the bounds to the last digit, as a file wants them."""
    pairs = zip(parameters, map(float, values), strict=True)
    return {one.name: min(max(value, one.lower), one.upper) for one, value in pairs}


def extended_pump(
    pump: PumpDescription, values: Mapping[str, float], extensions: Sequence[Extension]
) -> PumpDescription:
    """The pump with `base_parameters` and the extensions' parameters at values (SI) by name.

    extensions: each with a grid of one; an effect that the pump has switched on already is stated anew, Barus'
    coefficient in [oil] too. Names of sensors do not matter. `system.pump_file.file.resolved_toml` writes it as a
    file that runs to the readings of a `LumpedBench` at these values. Raises pydantic's ValidationError for values
    outside the effects' bounds.
    """
    own = pump_with(pump, values)
    stated: dict[str, Any] = pump.physics.model_dump(exclude_none=True)
    for extension in extensions:
        table = extension.stated(values)
        if extension.pair is None:
            stated[extension.id.value] = table
        else:
            stated[extension.id.value] = stated.get(extension.id.value, {}) | {extension.pair.value: table}
    displacement = pump.pump.displacement
    if displacement is not None:
        displacement *= values.get("displacement", 1.0)
    physics = PhysicsSection.model_validate(stated)
    part = own.pump.model_copy(update={"displacement": displacement})
    oil = own.oil
    if physics.viscosity_pressure is not None and oil.pressure_viscosity is not None:
        oil = oil.model_copy(update={"pressure_viscosity": physics.viscosity_pressure.coefficient})
    return own.model_copy(update={"pump": part, "oil": oil, "physics": physics})
