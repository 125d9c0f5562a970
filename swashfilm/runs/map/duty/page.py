"""Page of a duty cycle: report.html from summary.json and course.csv."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby
from pathlib import Path
from typing import Any

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.data.files import read_columns
from swashfilm.output.page import keep_pictures, read_summary, write_page
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.map.answer import overall_formula, points_text
from swashfilm.runs.map.duty.plots import BALANCE, course_plot, share_text, sinks_of, sinks_plot
from system.maps.definitions import BY_NAME, HEADLINE, agreeing, definition_words

COURSE = "course.csv"
ENERGY_HEAD = ("", "energy", "interpolation error", "mean power", "share of the loss")
EFFICIENCY_HEAD = ("definition", "mean efficiency", "interpolation error [percentage points]", "formula")
SINKS, OVER_TIME = "losses", "course"
"""Names of the page's pictures."""


def write_duty_page(folder: Path) -> Path:
    """Write report.html and plots/ of a duty's run folder from its summary.json and course.csv."""
    summary = read_summary(folder, ("summary.json", COURSE), "a duty cycle's run folder")
    course = read_columns(folder / COURSE)
    caption = "Energy lost over the cycle by kind, with its share of the loss"
    sinks = keep_pictures(folder, SINKS, {caption: sinks_plot(summary)})
    over_time = {"Inputs, loss, and hydraulic power over shaft power during the cycle": course_plot(course)}
    return write_page(
        folder,
        "duty",
        answer=duty_answer(summary, sinks[caption], caption),
        summary=summary,
        energies=list(energy_rows(summary)),
        energy_head=ENERGY_HEAD,
        efficiencies=list(efficiency_rows(summary)),
        efficiency_head=EFFICIENCY_HEAD,
        marked=list(marked_rows(summary)),
        pictures=keep_pictures(folder, OVER_TIME, over_time),
    )


def duty_answer(summary: Mapping[str, Any], picture: Picture | None = None, caption: str = "") -> Answer:
    """Return the answer of a cycle: energy in, out and lost, mean efficiency, and the largest loss."""
    shaft, hydraulic, loss = (summary["energy_J"][name] for name in BALANCE)
    efficiency, volume = summary["efficiency"][HEADLINE.value], summary["volume_m3"]
    tiles = (
        Tile(energy_text(shaft["value"]), "energy in, at the shaft", _off(energy_text(shaft["error"], 2))),
        Tile(energy_text(hydraulic["value"]), "energy out, hydraulic", _off(energy_text(hydraulic["error"], 2))),
        Tile(energy_text(loss["value"]), "energy lost", _off(energy_text(loss["error"], 2))),
        _efficiency_tile(efficiency),
        *_largest_tile(summary),
        Tile(f"{volume['value'] * 1e3:.4g} L", "delivered", f"in {summary['duration_s']:.6g} s"),
    )
    words = (
        f"In {summary['duration_s']:.6g} s the pump takes {energy_text(shaft['value'])} at its shaft and gives "
        f"{energy_text(hydraulic['value'])} to the oil; {energy_text(loss['value'])} are lost. "
        f"{efficiency_words(efficiency)}{_loss_words(summary)} The errors are those of interpolation between "
        f"the levels of the map; the error of the pump's model itself comes on top."
    )
    return Answer(tiles, words, picture, caption)


def _off(error: str) -> str:
    return f"interpolation error {error}"


def _efficiency_tile(efficiency: Mapping[str, Any]) -> Tile:
    if efficiency["value"] is None:
        return Tile("none", "mean efficiency (ISO 4409)", "no energy in, or none out")
    value = f"{100.0 * efficiency['value']:.1f} %"
    return Tile(value, "mean efficiency (ISO 4409)", _off(points_text(efficiency["error"])))


def efficiency_words(efficiency: Mapping[str, Any]) -> str:
    """Return the mean efficiency in a sentence, or why the cycle has none."""
    if efficiency["value"] is None:
        return (
            "It has no mean efficiency: the pump stands still or motors for so much of the cycle that the energies in "
            "and out are not both above zero."
        )
    return f"Its mean overall efficiency by ISO 4409 is {100.0 * efficiency['value']:.1f} %, energy over energy."


def _largest_tile(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield the share of the largest loss, where anything is lost."""
    loss = summary["energy_J"]["loss"]["value"]
    for name, most in list(sinks_of(summary).items())[:1]:
        if share := share_text(most["value"], loss):
            yield Tile(share, "of the loss", name)


def _loss_words(summary: Mapping[str, Any]) -> str:
    """Return the largest losses in a sentence, none where nothing is lost."""
    loss = summary["energy_J"]["loss"]["value"]
    largest = list(sinks_of(summary).items())[:2]
    shares = [f"{name} ({share})" for name, one in largest if (share := share_text(one["value"], loss))]
    return f" The largest loss is {', then '.join(shares)}." if shares else ""


def energy_text(joule: float, digits: int = 4) -> str:
    """Return an energy in kJ, in MJ from 10 MJ on."""
    scale, unit = (1e-6, "MJ") if abs(joule) >= 1e7 else (1e-3, "kJ")
    return f"{joule * scale:.{digits}g} {unit}"


def energy_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (name, energy, error, mean power, share of the loss)."""
    duration, loss = summary["duration_s"], summary["energy_J"]["loss"]["value"]
    energies = {name: summary["energy_J"][name] for name in BALANCE} | sinks_of(summary)
    for words, energy in energies.items():
        share = "" if words in BALANCE else share_text(energy["value"], loss, 2)
        yield (
            words,
            energy_text(energy["value"], 5),
            energy_text(energy["error"], 2),
            f"{energy['value'] / duration * 1e-3:.4g} kW",
            share,
        )
    volume = summary["volume_m3"]
    yield "delivered", f"{volume['value'] * 1e3:.5g} L", f"{volume['error'] * 1e3:.2g} L", "", ""


def efficiency_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (definitions, mean efficiency, error, formulas); definitions that agree together."""

    def shown(one: Mapping[str, Any]) -> tuple[str, ...]:
        if one["value"] is None:
            return "none", ""
        return f"{100.0 * one['value']:.2f} %", f"{100.0 * one['error']:.2g}"

    found = {BY_NAME[name]: one for name, one in summary["efficiency"].items()}
    for alike, cells in agreeing({name: shown(one) for name, one in found.items()}):
        formulas = dict.fromkeys(overall_formula(found[one]["formula"]) for one in alike)
        yield definition_words(alike), *cells, "; ".join(formulas)


def marked_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (part of the time, warnings): the time next to points of the map with these warnings, longest first."""

    def shown(item: tuple[str, float]) -> str:
        return f"{100.0 * item[1]:.1f} % of the time" if item[1] < 0.9995 else "the whole time"

    for part, alike in groupby(sorted(summary["marked"].items(), key=lambda item: -item[1]), shown):
        yield part, ", ".join(sorted(name for name, _ in alike))
