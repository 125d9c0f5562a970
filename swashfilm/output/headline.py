"""Headline numbers of a film's summary, each with its name and unit."""

from collections.abc import Mapping, Sequence
from typing import Any

from system.inputs.shown import DIGITS, Shown, largest_of_units, round_off, shown_in, significant, titled

CHECK_DIGITS = 2
"""Significant digits of balances and effort."""
UNITS = {
    "_m3_per_s": "m3/s", "_m3_per_rev": "m3/rev", "_rad_per_s": "rad/s", "_Pa_s": "Pa s", "_Nms": "N m s", "_Nm": "N m",
    "_Pa": "Pa", "_N": "N", "_W": "W", "_J": "J", "_K": "K", "_m2": "m2", "_m3": "m3", "_m": "m", "_kg": "kg",
    "_rad": "rad", "_seconds": "s", "_s": "s", "_deg": "deg", "_Hz": "Hz",
}  # fmt: skip
EFFORT = (
    "format", "kind", "name", "warnings", "mass_balance_error", "energy_balance_error", "imbalance", "dofs",
    "iterations", "solve_seconds", "pressure_max_at_m", "temperature_max_at_m", "time_s", "thermal_rounds",
    "load_rest", "films_solved", "span_deg", "turns", "turn_change_m", "step_error", "steps", "physics_left_out",
    "physics_seconds", "assumptions", "scale",
)  # fmt: skip
# Numbers of one family share a scale of round-off: the largest of them.
_FAMILIES = {
    "moment": "moment",
    "friction_force": "friction",
    "friction_torque": "torque",
    "flow": "flow",
    "leakage": "flow",
    "cavity_flow": "flow",
}


def headline_numbers(summary: Mapping[str, Any]) -> dict[str, float]:
    """Return physical numbers of a summary by key: `load_N`, `flow_m3_per_s.left`, `friction_force_moving_N.x`.

    Balances, effort and places are left out.
    """
    found: dict[str, float] = {}
    for key, value in summary.items():
        if key in EFFORT:
            continue
        if isinstance(value, Mapping):
            found |= {f"{key}.{part}": float(number) for part, number in value.items() if _is_number(number)}
        elif isinstance(value, (list, tuple)) and len(value) == 2:
            found |= {f"{key}.{axis}": float(number) for axis, number in zip("xy", value, strict=True)}
        elif _is_number(value):
            found[key] = float(value)
    return found


def named(key: str) -> tuple[str, str]:
    """Return (words, unit) of a key: `flow_m3_per_s.left` is ("flow, left", "m3/s")."""
    stem, _, part = key.partition(".")
    words, unit = stem, ""
    for ending, symbol in UNITS.items():
        if stem.endswith(ending):
            words, unit = ("solve" if stem == "solve_seconds" else stem.removesuffix(ending)), symbol
            break
    return words.replace("_", " ") + (f", {part.replace('_', ' ')}" if part else ""), unit


def shown_of(key: str) -> Shown:
    """Return the unit in which the number of a key is shown."""
    words, unit = named(key)
    return shown_in(unit, words.partition(",")[0])


def about(key: str) -> dict[str, str]:
    """Return the attributes of the variable of a key in a NetCDF file."""
    words, unit = named(key)
    return {"units": unit or "1", "long_name": words}


def titled_key(key: str) -> str:
    """Return the title of a column or an axis, such as `load [N]`."""
    return titled(named(key)[0], shown_of(key).symbol)


def summary_scales(summary: Mapping[str, Any]) -> Mapping[str, float]:
    """Return the scale of round-off of each SI unit: the largest number of it, and those stated in `scale`."""
    stated = headline_numbers({f"scale_{key}": value for key, value in summary.get("scale", {}).items()})
    numbers = headline_numbers(summary) | stated
    return largest_of_units((named(key)[1], [value]) for key, value in numbers.items())


def number_text(key: str, value: float, scales: Mapping[str, float]) -> str:
    """Return the number of a key, rounded, in the unit that people read; round-off as 0, and a check with two digits.

    scales: of round-off by SI unit.
    """
    shown = shown_of(key)
    if value != 0.0 and abs(value) < round_off(key, named(key)[1], scales):
        return " ".join(filter(None, ("0", shown.symbol, "(round-off)")))
    return shown.text(value, CHECK_DIGITS if key in EFFORT else DIGITS)


def numbers_text(key: str, values: Sequence[float], scales: Mapping[str, float]) -> str:
    """Return a list of numbers of a key, such as the two parts of a force, with one unit."""
    shown = shown_of(key)
    least = round_off(key, named(key)[1], scales)
    parts = ("0" if abs(value) < least else significant(shown.of(value)) for value in values)
    return f"({', '.join(parts)}) {shown.symbol}".rstrip()


def sizes(numbers: Mapping[str, float], least: Mapping[str, float]) -> dict[str, float]:
    """Return the scale of round-off of each number: the largest of its family, at least the value in `least`.

    Families: `moment`, `friction` (all forces), `torque`, `flow` (of all boundaries); any other number is a family
    of its own. A number that is itself round-off has the scale of all numbers of its unit.
    """
    largest = dict(least)
    for key, value in numbers.items():
        largest[_family(key)] = max(largest.get(_family(key), 0.0), abs(value))
    scales = largest_of_units((named(key)[1], [value]) for key, value in numbers.items())

    def size(key: str, value: float) -> float:
        unit = named(key)[1]
        of_unit = scales.get(unit, 0.0) if abs(value) < round_off(key, unit, scales) else 0.0
        return max(largest[_family(key)], of_unit)

    return {key: size(key, value) for key, value in numbers.items()}


def _family(key: str) -> str:
    return next((family for start, family in _FAMILIES.items() if key.startswith(start)), key)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
