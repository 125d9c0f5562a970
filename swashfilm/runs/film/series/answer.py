"""Answer of a study: what varies, between which ends the main numbers lie, and the points without a result."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from swashfilm.output.answer import Tile
from swashfilm.output.headline import named
from swashfilm.runs.film.series.plots import LEAST_CHANGE
from system.inputs.shown import quantity_text
from system.inputs.units import Dimension

MAIN = {
    "load_N": Dimension.FORCE,
    "film_thickness_min_m": Dimension.LENGTH,
    "leakage_flow_m3_per_s": Dimension.VOLUME_FLOW,
    "friction_coefficient": None,
    "friction_power_W": Dimension.POWER,
    "dissipation_W": Dimension.POWER,
    "pressure_max_Pa": Dimension.PRESSURE,
    "film_temperature_max_K": Dimension.TEMPERATURE,
    "temperature_max_K": Dimension.TEMPERATURE,
}
"""Numbers that a page tells first, in this order; None: a bare number."""
LEAST_FIRST = ("film_thickness_min_m", "friction_coefficient")
"""Numbers whose least value matters most."""
MOST = 5
LONG_NUMBER = re.compile(r"\d+\.\d{4,}")


def study_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield the number of points, and the ends of the main numbers that vary."""
    failed = summary["points"] - summary["solved"]
    note = f"{failed} without a result" if failed else "all with a result"
    yield Tile(f"{summary['solved']} of {summary['points']}", "points solved", note)
    for key, span in main_spans(summary):
        first, second, side = ("min", "max", "up to") if key in LEAST_FIRST else ("max", "min", "down to")
        end = "least" if key in LEAST_FIRST else "largest"
        yield Tile(_text(key, span[first]), f"{_words(key)}, {end}", f"{side} {_text(key, span[second])}")


def study_words(summary: Mapping[str, Any]) -> str:
    """Return a paragraph on a study from its summary."""
    return " ".join((_varied(summary), *_spans(summary), *_failed(summary)))


def main_spans(summary: Mapping[str, Any]) -> list[tuple[str, Mapping[str, Any]]]:
    """Return the main numbers that vary, with their ends."""
    found = [(key, summary["numbers"][key]) for key in MAIN if key in summary["numbers"]]
    return [(key, span) for key, span in found if _varies(span)][:MOST]


_LONG = re.compile(r"^-?\d+\.\d{6,}")
"""Number with more digits than it is worth, at the begin of a value."""


def place(values: Mapping[str, Any]) -> str:
    """Return the values of the varied keys at a point."""
    return ", ".join(f"{key} = {_LONG.sub(_rounded, str(value))}" for key, value in values.items())


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.6g}"


def _at(values: Mapping[str, Any]) -> str:
    """Return the place of a point in words: the value alone where one key varies."""
    return _short(place(values) if len(values) > 1 else str(*values.values()))


def _short(text: str) -> str:
    """Return a text with its long numbers rounded."""
    return LONG_NUMBER.sub(lambda number: f"{float(number[0]):.4g}", text)


def _words(key: str) -> str:
    return {"film_thickness_min_m": "least film", "dissipation_W": "friction power"}.get(key, named(key)[0])


def _varies(span: Mapping[str, Any]) -> bool:
    return bool(span["max"] - span["min"] > LEAST_CHANGE * max(abs(span["max"]), abs(span["min"])))


def _text(key: str, value: float) -> str:
    dimension = MAIN[key]
    return f"{value:.3g}" if dimension is None else quantity_text(value, dimension, digits=3)


def _varied(summary: Mapping[str, Any]) -> str:
    axes = [f"{axis['key']} ({_ends(axis['values'])})" for axis in summary["axes"]]
    return f"{summary['solved']} films over {' and '.join(axes)}."


def _ends(values: list[str]) -> str:
    values = [_short(value) for value in values]
    return f"{values[0]} to {values[-1]}, {len(values)} values" if len(values) > 2 else ", ".join(values)


def _spans(summary: Mapping[str, Any]) -> Iterator[str]:
    spans = main_spans(summary)
    if not spans:
        yield "No main number varies."
    for key, span in spans:
        low, high = (f"{_text(key, span[end])} (at {_at(span[f'{end}_at'])})" for end in ("min", "max"))
        yield f"The {_words(key)} lies between {low} and {high}."


def _failed(summary: Mapping[str, Any]) -> Iterator[str]:
    if count := len(summary["failed"]):
        first = summary["failed"][0]
        told = "One point has no result, at" if count == 1 else f"{count} points have no result; the first at"
        yield f"{told} {_at(first['values'])}: {first['reason']}."
