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
from swashfilm.runs.map.duty.plots import BALANCE, course_plot, sinks_of, sinks_plot
from swashfilm.runs.map.plots import HEADLINE

COURSE = "course.csv"
ENERGY_HEAD = ("", "energy", "error", "mean power", "share of the loss")
EFFICIENCY_HEAD = ("definition", "mean efficiency", "error [percentage points]", "formula")
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
    (first, most), *others = sinks_of(summary).items()
    mean = f"{100.0 * efficiency['value']:.1f} %"
    tiles = (
        Tile(energy_text(shaft["value"]), "energy in, at the shaft", f"+- {energy_text(shaft['error'], 2)}"),
        Tile(energy_text(hydraulic["value"]), "energy out, hydraulic", f"+- {energy_text(hydraulic['error'], 2)}"),
        Tile(energy_text(loss["value"]), "energy lost", f"+- {energy_text(loss['error'], 2)}"),
        Tile(mean, "mean efficiency (ISO 4409)", f"+- {points_text(efficiency['error'])}"),
        Tile(f"{100.0 * most['value'] / loss['value']:.0f} %", "of the loss", first),
        Tile(f"{volume['value'] * 1e3:.4g} L", "delivered", f"in {summary['duration_s']:.6g} s"),
    )
    next_words = f", then {others[0][0]} ({100.0 * others[0][1]['value'] / loss['value']:.0f} %)" if others else ""
    words = (
        f"In {summary['duration_s']:.6g} s the pump takes {energy_text(shaft['value'])} at its shaft and gives "
        f"{energy_text(hydraulic['value'])} to the oil; {energy_text(loss['value'])} are lost. Its mean overall "
        f"efficiency by ISO 4409 is {mean}, energy over energy. The largest loss is {first} "
        f"({100.0 * most['value'] / loss['value']:.0f} %){next_words}. The errors are those of the map between its "
        f"levels; the error of the pump's model itself comes on top."
    )
    return Answer(tiles, words, picture, caption)


def energy_text(joule: float, digits: int = 4) -> str:
    """Return an energy in kJ, in MJ from 10 MJ on."""
    scale, unit = (1e-6, "MJ") if abs(joule) >= 1e7 else (1e-3, "kJ")
    return f"{joule * scale:.{digits}g} {unit}"


def energy_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (name, energy, error, mean power, share of the loss)."""
    duration, loss = summary["duration_s"], summary["energy_J"]["loss"]["value"]
    energies = {name: summary["energy_J"][name] for name in BALANCE} | sinks_of(summary)
    for words, energy in energies.items():
        share = "" if words in BALANCE else f"{100.0 * energy['value'] / loss:.2f} %"
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

    def shown(one: Mapping[str, Any]) -> tuple[str, str]:
        return f"{100.0 * one['value']:.2f} %", f"{100.0 * one['error']:.2g}"

    for (value, error), alike in groupby(sorted(summary["efficiency"].values(), key=shown), shown):
        listed = list(alike)
        formulas = dict.fromkeys(overall_formula(one["formula"]) for one in listed)
        yield "; ".join(one["label"] for one in listed), value, error, "; ".join(formulas)


def marked_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (part of the time, warnings): the time next to points of the map with these warnings, longest first."""

    def shown(item: tuple[str, float]) -> str:
        return f"{100.0 * item[1]:.1f} % of the time" if item[1] < 0.9995 else "the whole time"

    for part, alike in groupby(sorted(summary["marked"].items(), key=lambda item: -item[1]), shown):
        yield part, ", ".join(sorted(name for name, _ in alike))
