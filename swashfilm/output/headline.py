"""Headline numbers of a film's summary, each with its name and unit."""

from collections.abc import Mapping
from typing import Any

UNITS = {
    "_m3_per_s": "m3/s", "_Nm": "N m", "_Pa": "Pa", "_N": "N", "_W": "W", "_K": "K", "_m": "m", "_kg": "kg",
    "_rad": "rad", "_seconds": "s", "_s": "s", "_deg": "deg",
}  # fmt: skip
EFFORT = (
    "format", "kind", "name", "warnings", "mass_balance_error", "energy_balance_error", "imbalance", "dofs",
    "iterations", "solve_seconds", "pressure_max_at_m", "temperature_max_at_m", "time_s", "thermal_rounds",
    "load_rest", "films_solved", "span_deg", "turns", "turn_change_m", "step_error", "steps", "physics_left_out",
    "physics_seconds", "assumptions",
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
    return words.replace("_", " ") + (f", {part}" if part else ""), unit


def titled(key: str) -> str:
    """Return the title of a column or an axis, such as `load / N`."""
    words, unit = named(key)
    return f"{words} / {bracketed(unit)}" if unit else words


def bracketed(unit: str) -> str:
    """Return the unit as it stands behind a stroke: in brackets where it has a blank or a stroke itself."""
    return f"({unit})" if any(sign in unit for sign in " /") else unit


def sizes(numbers: Mapping[str, float], least: Mapping[str, float]) -> dict[str, float]:
    """Return the scale of round-off of each number: the largest of its family, at least the value in `least`.

    Families: `moment`, `friction` (all forces), `torque`, `flow` (of all boundaries); any other number is a family
    of its own.
    """
    largest = dict(least)
    for key, value in numbers.items():
        largest[_family(key)] = max(largest.get(_family(key), 0.0), abs(value))
    return {key: largest[_family(key)] for key in numbers}


def _family(key: str) -> str:
    return next((family for start, family in _FAMILIES.items() if key.startswith(start)), key)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
