"""Answer of a study: the varied keys, the ranges of the main numbers, and the points without a result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from swashfilm.case.axis import StudyAxis, place_words
from swashfilm.output.answer import Tile
from swashfilm.output.headline import named
from swashfilm.runs.film.answer import LOADS, carried_key
from swashfilm.runs.film.series.plots import LEAST_CHANGE
from system.inputs.shown import quantity_text
from system.inputs.units import Dimension

PUMP_STUDY = "pump_study"
"""Kind of a study of a pump's operating points, in its files."""
EFFICIENCIES_BY = "Efficiencies are those of ISO 4409."
MAIN = {
    "overall_efficiency": None,
    "delivery_flow_m3_per_s": Dimension.VOLUME_FLOW,
    "loss_W": Dimension.POWER,
    "shaft_torque_Nm": Dimension.TORQUE,
    "drain_flow_m3_per_s": Dimension.VOLUME_FLOW,
    "bearing_load_N": Dimension.FORCE,
    "carried_load_N": Dimension.FORCE,
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
"""Main numbers of a page, in this order; None: a bare number."""
LEAST_FIRST = ("film_thickness_min_m", "friction_coefficient")
"""Numbers whose least value matters most."""
WORDS = {
    "bearing_load_N": "load",
    "carried_load_N": "load",
    "dissipation_W": "friction power",
    "film_thickness_min_m": "least film",
}
MOST = 5


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
    by = [EFFICIENCIES_BY] if summary["kind"] == PUMP_STUDY else []
    return " ".join((_varied(summary), *_spans(summary), *by, *_failed(summary)))


def main_spans(summary: Mapping[str, Any]) -> list[tuple[str, Mapping[str, Any]]]:
    """Return the main numbers that vary, with their ends; of the loads the supported one."""
    numbers = summary["numbers"]
    keys = (key for key in MAIN if key in numbers and (key not in LOADS or key == carried_key(numbers)))
    found = [(key, numbers[key]) for key in keys]
    return [(key, span) for key, span in found if _varies(span)][:MOST]


def axes_of(summary: Mapping[str, Any]) -> tuple[StudyAxis, ...]:
    """Return the varied keys of a study's summary."""
    return tuple(
        StudyAxis(one["key"], tuple(one["values"]), one["numbers"] and tuple(one["numbers"]), one["unit"] or "")
        for one in summary["axes"]
    )


def _at(axes: Sequence[StudyAxis], values: Mapping[str, Any]) -> str:
    """Return the place of a point in words: the value alone where one key varies."""
    return place_words(axes, values) if len(axes) > 1 else axes[0].text(values[axes[0].key])


def _words(key: str) -> str:
    return WORDS.get(key, named(key)[0])


def _varies(span: Mapping[str, Any]) -> bool:
    return bool(span["max"] - span["min"] > LEAST_CHANGE * max(abs(span["max"]), abs(span["min"])))


def _text(key: str, value: float) -> str:
    dimension = MAIN[key]
    if key.endswith("_efficiency"):
        return f"{100.0 * value:.3g} %"
    return f"{value:.3g}" if dimension is None else quantity_text(value, dimension, digits=3)


def _varied(summary: Mapping[str, Any]) -> str:
    axes = [f"{axis.key} ({_ends(axis)})" for axis in axes_of(summary)]
    what = "operating points" if summary["kind"] == PUMP_STUDY else "films"
    return f"{summary['solved']} {what} over {' and '.join(axes)}."


def _ends(axis: StudyAxis) -> str:
    values = [axis.text(value) for value in axis.values]
    return f"{values[0]} to {values[-1]}, {len(values)} values" if len(values) > 2 else ", ".join(values)


def _spans(summary: Mapping[str, Any]) -> Iterator[str]:
    spans, axes = main_spans(summary), axes_of(summary)
    if not spans:
        yield "No main number varies."
    for key, span in spans:
        low, high = (f"{_text(key, span[end])} (at {_at(axes, span[f'{end}_at'])})" for end in ("min", "max"))
        yield f"The {_words(key)} lies between {low} and {high}."


def _failed(summary: Mapping[str, Any]) -> Iterator[str]:
    if count := len(summary["failed"]):
        first = summary["failed"][0]
        told = "One point has no result, at" if count == 1 else f"{count} points have no result; the first at"
        yield f"{told} {_at(axes_of(summary), first['values'])}: {first['reason']}."
