"""Pump with the parameters of a fit, its effects switched on; [tolerance] from the fit of a calibration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.parameters import BEARINGS, GUIDE, pump_with
from system.description.effects import PhysicsSection
from system.description.pump import PumpDescription
from system.effects.extension import Extension
from system.estimation.parameters import Parameter
from system.estimation.posterior import Posterior

_OF_FRICTION: Mapping[str, str] = {
    f"friction.{GUIDE}": "guide_friction",
    **{f"friction.{pair}": "bearing_friction" for pair in BEARINGS},
}


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


def calibrated_pump(pump: PumpDescription, fit: Posterior, laws: Sequence[Extension] = ()) -> PumpDescription:
    """The pump with a fit's values, and with `laws` switched on; [tolerance] holds the fit's own sigmas.

    A key of [tolerance] that stands for several parameters takes the widest of them. Others keep
    their tolerance. Raises pydantic's ValidationError for values outside an effect's bounds.
    """
    own = extended_pump(pump, values_by_name(fit.parameters, fit.values), laws)
    sigma = np.sqrt(np.diag(fit.covariance))
    known: dict[str, float] = {}
    for parameter, width in zip(fit.parameters, sigma, strict=True):
        key = _OF_FRICTION.get(parameter.name, parameter.name.partition(".")[0])
        if key in type(own.tolerance).model_fields:
            known[key] = max(known.get(key, 0.0), float(parameter.spread * width))
    return own.model_copy(update={"tolerance": own.tolerance.model_copy(update=known)})
