"""Pump with the parameters of a fit, its effects switched on; [tolerance] from the fit of a calibration."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

from reynolds.numerics.arrays import Array
from system.bench.parameters import DISPLACEMENT, FILE_KEYS, INLET_SHARE, friction_key, pump_with
from system.description.effects import PhysicsSection
from system.description.pump import PumpDescription
from system.effects.extension import Extension
from system.estimation.parameters import Parameter, Scale
from system.estimation.posterior import Posterior
from system.inputs.sections.reader import section_of


def values_by_name(parameters: Sequence[Parameter], values: Array) -> dict[str, float]:
    """Values (k,) by the names of their parameters, within the bounds to the last digit, as a file requires."""
    pairs = zip(parameters, map(float, values), strict=True)
    return {one.name: min(max(value, one.lower), one.upper) for one, value in pairs}


def extended_pump(
    pump: PumpDescription, values: Mapping[str, float], extensions: Sequence[Extension]
) -> PumpDescription:
    """The pump with `base_parameters` and the extensions' parameters at values (SI) by name.

    extensions: each with a grid of one, without those of solved films, which no file states. Their sizes add to those
    of an effect that the pump has switched on already, whose law acts in a fit too (`Extension.stated_beside`); Barus'
    coefficient is stated in [oil] too. Names of sensors do not matter. `system.pump_file.file.resolved_toml` writes it
    as a file that runs to the readings of a `LumpedBench` at these values. Raises ValueError for values outside the
    effects' limits.
    """
    own = pump_with(pump, values)
    stated: dict[str, Any] = {
        key: _stated(section) for key in vars(pump.physics) if (section := getattr(pump.physics, key)) is not None
    }
    for extension in (one for one in extensions if not one.of_films):
        table = stated.get(extension.id.value, {})
        if extension.pair is None:
            stated[extension.id.value] = extension.stated_beside(table, values)
        else:
            beside = _stated(table[extension.pair.value]) if extension.pair.value in table else {}
            stated[extension.id.value] = table | {extension.pair.value: extension.stated_beside(beside, values)}
    physics = section_of(PhysicsSection, stated)
    oil = own.oil
    if physics.viscosity_pressure is not None and oil.pressure_viscosity is not None:
        oil = replace(oil, pressure_viscosity=physics.viscosity_pressure.coefficient)
    return replace(own, oil=oil, physics=physics)


def calibrated_pump(pump: PumpDescription, fit: Posterior, laws: Sequence[Extension] = ()) -> PumpDescription:
    """The pump with a fit's values, and with `laws` switched on; [tolerance] holds the fit's own sigmas.

    A key of [tolerance] for several parameters has the widest of them; a value at a bound keeps its sigma. Others keep
    their tolerance, and so does inlet_share, whose value no file states; that of the drawing is omitted for a fitted
    dimension. Raises ValueError for values outside an effect's limits.
    """
    own = extended_pump(pump, values_by_name(fit.parameters, fit.values), laws)
    stated = {one.name for one in fields(own.tolerance)} - {INLET_SHARE}
    known: dict[str, Any] = {}
    for at, parameter in enumerate(fit.parameters):
        first, _, rest = parameter.name.partition(".")
        key = friction_key(rest) if first == "friction" else first
        if key in stated:
            known[key] = max(known.get(key, 0.0), _sigma(fit, at))
    fitted = {FILE_KEYS.get(parameter.name) for parameter in fit.parameters}
    drawn = own.tolerance
    known["dimension"] = tuple(one for one in drawn.dimension if one.key not in fitted)
    known["fit"] = tuple(one for one in drawn.fit if one.key not in fitted)
    known["correlation"] = tuple(one for one in drawn.correlation if fitted.isdisjoint((one.one, one.other)))
    return replace(own, tolerance=replace(own.tolerance, **known))


def _sigma(fit: Posterior, at: int) -> float:
    """One sigma of a fitted parameter as [tolerance] states it: about the fitted value, relative for a factor."""
    parameter, value = fit.parameters[at], float(fit.values[at])
    if fit.at_bounds[at]:
        return parameter.spread
    relative = parameter.scale is Scale.LOG or parameter.name == DISPLACEMENT
    return fit.sigma(parameter.name) / (value if relative else 1.0)


def _stated(section: object) -> dict[str, Any]:
    """Return the values of a section that are stated, by key."""
    return {key: value for key, value in vars(section).items() if value is not None}
