"""Answer of one film: load, flow, friction, least film, and its limits."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping
from typing import Any

from swashfilm.output.answer import Tile
from swashfilm.output.headline import named, summary_scales
from swashfilm.output.refinement import bar_text
from system.inputs.shown import quantity_text, round_off
from system.inputs.units import Dimension

DIGITS = 4
LOADS = ("carried_load_N", "bearing_load_N", "load_N")
"""Keys of a film's load; the first that a film has is its supported load."""
LEAST_SHARE = 1e-4
"""Share of area or load below which cavities and contact are not mentioned."""
ROUGH = 3.0
"""Ratio of film to roughness above which contact is negligible."""


def film_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield the headline numbers of a film from its summary, with error bars where it is refined."""
    key, note = carried_key(summary), ""
    if "required_load_N" in summary:
        note = f"of {amount(summary['required_load_N'], Dimension.FORCE)} required"
    elif "attitude_angle_deg" in summary:
        note = f"attitude angle {summary['attitude_angle_deg']:.1f} deg"
    yield Tile(amount(summary[key], Dimension.FORCE), "load", _note(summary, key, Dimension.FORCE, note))
    for name, key, dimension in (
        ("leakage", "leakage_flow_m3_per_s", Dimension.VOLUME_FLOW),
        ("friction power", "friction_power_W" if "friction_power_W" in summary else "dissipation_W", Dimension.POWER),
        ("least film", "film_thickness_min_m", Dimension.LENGTH),
        ("largest pressure", "pressure_max_Pa", Dimension.PRESSURE),
        ("hottest oil", "temperature_max_K", Dimension.TEMPERATURE),
    ):
        if key in summary:
            note, value = _coefficient(summary) if dimension is Dimension.POWER else "", counted(summary, key)
            if key == "leakage_flow_m3_per_s" and value < 0.0:
                note = "negative: the film draws oil in"
            yield Tile(amount(value, dimension), name, _note(summary, key, dimension, note))


def counted(summary: Mapping[str, Any], key: str) -> float:
    """Return the number of a key, 0 where it is round-off beside the film's numbers of its unit."""
    value = float(summary[key])
    return value if abs(value) >= round_off(key, named(key)[1], summary_scales(summary)) else 0.0


def carried_key(numbers: Container[str]) -> str:
    """Return the key of a film's supported load: of a journal the vector; with pockets and contact."""
    return next(key for key in LOADS if key in numbers)


def film_words(summary: Mapping[str, Any]) -> str:
    """Return a paragraph on a film from its summary."""
    return " ".join((*_load_words(summary), _flow_words(summary), *_limit_words(summary)))


def amount(value: float, dimension: Dimension) -> str:
    """Return a number in the unit that suits its size."""
    return quantity_text(value, dimension, digits=DIGITS)


def _note(summary: Mapping[str, Any], key: str, dimension: Dimension, words: str) -> str:
    bar = bar_text(summary, key, dimension)
    return "; ".join(part for part in (bar, words) if part)


def _coefficient(summary: Mapping[str, Any]) -> str:
    found = summary.get("friction_coefficient")
    return "" if found is None else f"friction coefficient {found:.3g}"


def _load_words(summary: Mapping[str, Any]) -> Iterator[str]:
    when = f"After {amount(summary['time_s'], Dimension.TIME)} the film" if "time_s" in summary else "The film"
    if "required_load_N" not in summary:
        yield f"{when} carries {amount(summary[carried_key(summary)], Dimension.FORCE)}{_attitude(summary)}."
    elif summary["position_source"] == "rest":
        load = amount(summary["required_load_N"], Dimension.FORCE)
        yield f"The part rests where film and outer forces balance, under a load of {load}."
    else:
        carried, required = (amount(summary[f"{of}_load_N"], Dimension.FORCE) for of in ("carried", "required"))
        yield f"At the given position the film with its pockets carries {carried} of {required}."
    if "load_of_time_max_N" in summary:
        low, high = (amount(summary[f"load_of_time_{end}_N"], Dimension.FORCE) for end in ("min", "max"))
        yield f"Over the whole time the load lies between {low} and {high}."


def _attitude(summary: Mapping[str, Any]) -> str:
    """Return words on the direction of a journal's load."""
    angle = summary.get("attitude_angle_deg")
    return "" if angle is None else f", the vector around the shaft, at an attitude angle of {angle:.1f} deg"


def _flow_words(summary: Mapping[str, Any]) -> str:
    least, pressure = summary["film_thickness_min_m"], summary["pressure_max_Pa"]
    key = "friction_power_W" if "friction_power_W" in summary else "dissipation_W"
    leak = leak_words(counted(summary, "leakage_flow_m3_per_s"))
    return (
        f"It is {amount(least, Dimension.LENGTH)} thick at its thinnest place, and its pressure reaches "
        f"{amount(pressure, Dimension.PRESSURE)}. {leak}, and {amount(summary[key], Dimension.POWER)} are lost to "
        "friction."
    )


def leak_words(flow: float, source: str = "its sides") -> str:
    """Return words on a leakage (m3/s): out of a film, or into it from a source where it is negative."""
    if flow == 0.0:
        return "Nothing leaks out"
    size = amount(abs(flow), Dimension.VOLUME_FLOW)
    return f"{size} leak out" if flow > 0.0 else f"{size} flow in from {source}"


def _limit_words(summary: Mapping[str, Any]) -> Iterator[str]:
    """Yield the limits of the film: cavities, contact, roughness, heat."""
    cavities, carried = summary["cavitated_area_fraction"], summary.get("contact_load_N", 0.0)
    touching = carried > LEAST_SHARE * max(abs(summary[carried_key(summary)]), carried)
    if cavities > LEAST_SHARE:
        yield f"{_percent(cavities)} of its area cavitates."
    if touching:
        yield f"Contact of the walls carries {amount(carried, Dimension.FORCE)}."
    if not touching and (ratio := summary.get("lambda_ratio_min", ROUGH)) < ROUGH:
        yield f"At the thinnest place the film is only {ratio:.2g} times as thick as the walls are rough."
    if not touching and cavities <= LEAST_SHARE:
        yield "The film is full everywhere, and the walls do not touch."


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %"
