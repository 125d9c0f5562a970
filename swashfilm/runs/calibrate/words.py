"""Parameters of a calibration as people read them: name, value with sigma in usual units, degree of determination."""

from __future__ import annotations

from collections.abc import Mapping
from math import floor, log10

from diagnosis.recording.units import BENCH_UNITS
from diagnosis.report.format import CHANNELS
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension, in_unit, reading_unit
from system.pump.laws.friction_pairs import Pair

Row = Mapping[str, str]
WELL, PARTLY = 0.5, 0.9
"""Share of the assumed uncertainty left by the fit, up to which a parameter is determined well, or in part."""
DETERMINED, IN_PART, MOVED, AS_ASSUMED = "determined", "in part", "moved, not narrowed", "as assumed"
AT_END = "at the end of its range"
FAR = 3.0
"""Assumed sigmas from the assumed value, from which a fitted one contradicts it."""
FRICTION = "friction."
STIFF = 1e8
"""Pa from which a pressure is a modulus."""
OFF = "off_over_prior [1]"
_GAIN = "gain"
_INPUTS = {
    "speed": "shaft speed", "p_out": "delivery pressure", "p_in": "inlet pressure", "p_case": "case pressure",
    "T_in": "inlet temperature", "T_case": "case temperature",
}  # fmt: skip
_NAMES = {
    "viscosity": "viscosity factor", "displacement": "displacement factor",
    "mixed_friction.hersey_scale": "Hersey scale of mixed friction",
    "mixed_friction.exponent": "exponent of mixed friction",
}  # fmt: skip
"""Names of parameters that are no quantity of one part; factors multiply a value of the pump file."""


def parameter_words(name: str) -> str:
    """Return the name of a parameter in words: "film thickness, piston", "gain of delivery flow (Q_out)"."""
    first, _, rest = name.partition(".")
    if name.startswith(FRICTION):
        pair = next((pair for pair in Pair if pair.value == rest), None)
        return f"friction coefficient, {pair.words if pair else rest.replace('_', ' ')}"
    channel = next((one for one in ChannelName if one.value == first), None)
    if channel is not None and rest:
        words = CHANNELS.get(channel) or _INPUTS.get(first)
        return f"{rest.replace('_', ' ')} of {f'{words} ({first})' if words else first.replace('_', ' ')}"
    return _NAMES.get(name) or name.replace("_", " ").replace(".", ", ")


def is_sensor(row: Row) -> bool:
    """Return whether a parameter belongs to a meter of the bench, not to the pump."""
    return row["name"].partition(".")[0] in {one.value for one in ChannelName} and "." in row["name"]


def how_far(row: Row) -> str:
    """Return the degree to which the recording determines a parameter; one at a bound is not determined."""
    if is_at_end(row):
        return AT_END
    left = float(row["sigma_over_prior [1]"])
    unmoved = AS_ASSUMED if abs(sigmas_off(row)) < 1.0 else MOVED
    return DETERMINED if left < WELL else IN_PART if left < PARTLY else unmoved


def is_at_end(row: Row) -> bool:
    """Return whether the fitted value lies on a bound."""
    return row["at_bound"] == "yes"


def sigmas_off(row: Row) -> float:
    """Return the assumed sigmas by which the fitted value differs from the assumed one; 0 in tables without them."""
    return float(row.get(OFF, "0"))


def degree_text(row: Row) -> str:
    """Return `how_far`, and the distance of a value that contradicts the assumed one: "in part, 4.4 sigma off"."""
    off = abs(sigmas_off(row))
    return f"{how_far(row)}, {off:.1f} sigma off" if off >= FAR else how_far(row)


def fitted_parts(row: Row) -> tuple[str, str]:
    """Return the fitted value and its sigma, each with its unit: "15.11 um", "0.68 um"."""
    value, sigma = float(row["mean"]), float(row["sigma"])
    factor, unit = _unit(row, max(abs(value), sigma))
    size = factor * (abs(value) if is_at_end(row) and value != 0.0 else sigma)
    digits = max(0, 1 - floor(log10(size))) if size > 0.0 else 3
    shown, width = (f"{factor * number:.{digits}f} {unit}".rstrip() for number in (value, sigma))
    return shown, width


def fitted_text(row: Row) -> str:
    """Return the fitted value with one sigma and its unit: "15.11 +- 0.68 um"; without it at a bound."""
    value, sigma = fitted_parts(row)
    if is_at_end(row):
        return value
    return f"{value.split()[0]} +- {sigma}"


def assumed_text(row: Row) -> str:
    """Return the values within one sigma before the fit: "13.8 to 16.2 um"."""
    low, high = float(row["prior_low"]), float(row["prior_high"])
    factor, unit = _unit(row, max(abs(low), abs(high)))
    digits = max(0, 1 - floor(log10(factor * (high - low)))) if high > low else 3
    return f"{factor * low:.{digits}f} to {factor * high:.{digits}f} {unit}".rstrip()


def _unit(row: Row, size: float) -> tuple[float, str]:
    """Return factor and name of the unit in which a number of this size (SI) is read; gains are in percent."""
    if row["name"].endswith(f".{_GAIN}"):
        return 100.0, "%"
    dimension = next((one for one in Dimension if one.si_unit == row["unit"]), None)
    if dimension is None or dimension is Dimension.TEMPERATURE:
        return 1.0, "" if row["unit"] == "1" else row["unit"]
    if dimension is Dimension.PRESSURE and size >= STIFF:
        dimension = Dimension.MODULUS
    unit = BENCH_UNITS.get(dimension, reading_unit(size, dimension))
    return in_unit(1.0, unit, dimension) - in_unit(0.0, unit, dimension), unit
