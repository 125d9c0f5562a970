"""Answer of a gap over the turn: least film and its place, leakage, friction, and the support of the part."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gaps.films.reports import Active
from swashfilm.output.answer import Tile
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.refinement import bar_text
from swashfilm.runs.film.answer import LEAST_SHARE, amount, leak_words
from swashfilm.runs.film.revolution.plots import MEANING
from system.inputs.units import Dimension


def revolution_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield the headline numbers of a turn from its summary, with error bars where it is refined."""
    at, rubbing = f"at {summary['film_thickness_min_at_deg']:.0f} deg", summary["rubbing_power_W"]
    touches = rubbing > LEAST_SHARE * abs(summary["friction_power_W"])
    contact = f"{amount(rubbing, Dimension.POWER)} by contact" if touches else "without contact"
    for name, key, dimension, note in (
        ("least film of the turn", "film_thickness_min_m", Dimension.LENGTH, at),
        ("mean film", "film_thickness_mean_m", Dimension.LENGTH, ""),
        ("leakage, mean", "leakage_flow_m3_per_s", Dimension.VOLUME_FLOW, ""),
        ("friction power, mean", "friction_power_W", Dimension.POWER, contact),
        ("largest pressure", "pressure_max_Pa", Dimension.PRESSURE, ""),
        ("hottest oil", "film_temperature_max_K", Dimension.TEMPERATURE, ""),
    ):
        if key in summary:
            notes = [part for part in (note, bar_text(summary, key, dimension)) if part]
            yield Tile(amount(summary[key], dimension), name, "; ".join(notes))


def revolution_words(summary: Mapping[str, Any]) -> str:
    """Return a paragraph on a turn from its summary."""
    least, mean = (amount(summary[f"film_thickness_{of}_m"], Dimension.LENGTH) for of in ("min", "mean"))
    words = [
        f"The film {TITLES[summary['gap']]} is thinnest at {summary['film_thickness_min_at_deg']:.0f} deg of shaft "
        f"angle: {least}, where its mean over the turn is {mean}.",
        f"{leak_words(summary['leakage_flow_m3_per_s'], 'the case')} on the mean, and "
        f"{amount(summary['friction_power_W'], Dimension.POWER)} are lost to friction.",
        f"{_supports(summary['share_of_turn'])}.",
        _stability(summary["largest_multiplier"]),
    ]
    return " ".join(words)


def _supports(shares: Mapping[str, float]) -> str:
    """Return for which share of the turn the film is full, cavitates or touches."""
    found = {kind: shares.get(kind.value, 0.0) for kind in Active}
    listed = [f"{MEANING[kind]} in {100.0 * share:.0f} %" for kind, share in found.items() if share > 0.0]
    return f"Share of the turn: {', '.join(listed)}"


def _stability(multiplier: float) -> str:
    if multiplier > 1.0:
        return f"The motion is unstable: a small disturbance grows {multiplier:.3g} times in a turn."
    return f"The motion is stable: {100.0 * multiplier:.2g} % of a small disturbance are left after a turn."
