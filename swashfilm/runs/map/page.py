"""Page of an operating map: report.html from the files of the run folder."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swashfilm.output.page import keep_pictures, kept_text, read_summary, write_page
from swashfilm.runs.map.answer import map_answer, overall_formula
from swashfilm.runs.map.explorer import map_explorer
from swashfilm.runs.map.files import MAP, read_map
from swashfilm.runs.map.film_plots import film_pictures
from swashfilm.runs.map.plots import definition_pictures, further_pictures, loss_pictures, main_picture
from swashfilm.runs.map.slices import MOST_PANELS, held_levels, third_input, varied
from system.maps.data import MapData
from system.maps.definitions import BY_NAME, agreeing, definition_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILES = ("summary.json", "resolved.toml", MAP)
CM3 = 1e6
BEST_HEAD = ("definition", "best overall efficiency", "at", "formula")
DISPLACEMENT_HEAD = ("displacement ratio", "geometric", "swept", "by Toet (ISO 8426-1)")
ERROR_HEAD = ("number", "rms", "largest", "relative to the map's largest")
_SHOWN = {"W": (1e-3, "kW"), "Nm": (1.0, "N m"), "m3_per_s": (6e4, "L/min")}
FIRST, FURTHER, DEFINITIONS, LOSSES, FILMS = "efficiency", "levels", "definitions", "losses", "films"
"""Names of the page's groups of pictures, in its order."""
EXPLORED = "explored"
TO_EXPLORE = "Any number of the map over any two of its axes; circles: solved points"


def write_map_page(folder: Path) -> Path:
    """Write report.html and plots/ of a map's folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a map's run folder")
    data, error = read_map(folder / MAP)
    drawn = map_pictures(data) if summary["solved"] else {}
    if FIRST in drawn and (explorer := map_explorer(data)) is not None:
        figure = next(iter(drawn[FIRST].values()))
        explored = keep_pictures(folder, EXPLORED, {TO_EXPLORE: figure}, {TO_EXPLORE: explorer})
    else:
        explored = {}
    kept = {EXPLORED: explored} | {name: keep_pictures(folder, name, pictures) for name, pictures in drawn.items()}
    caption, picture = next(iter(kept.pop(FIRST, {}).items()), ("", None))
    return write_page(
        folder,
        "map",
        answer=map_answer(data, error, summary, picture, caption),
        summary=summary,
        axes=list(axis_rows(summary)),
        best=list(best_rows(summary)),
        best_head=BEST_HEAD,
        formulas=[(one["label"], one["formula"]) for one in summary["best"] if ", " in one["formula"]],
        displacement=list(displacement_rows(summary)),
        displacement_head=DISPLACEMENT_HEAD,
        errors=list(error_rows(summary)),
        error_head=ERROR_HEAD,
        table_errors=[(name, f"{100.0 * one:.3g} %") for name, one in (summary["table_error"] or {}).items()],
        failed=list(failure_rows(summary)),
        further=further_words(data),
        pictures=kept,
        resolved=kept_text(folder, "resolved.toml"),
    )


def map_pictures(data: MapData) -> dict[str, dict[str, Figure]]:
    """Return the pictures of a map by group and caption, as far as it has enough levels; no empty group."""
    first = main_picture(data)
    groups = {
        FIRST: {} if first is None else {first[0]: first[1]},
        FURTHER: further_pictures(data),
        DEFINITIONS: definition_pictures(data),
        LOSSES: loss_pictures(data),
        FILMS: film_pictures(data),
    }
    return {name: pictures for name, pictures in groups.items() if pictures}


def further_words(data: MapData) -> str:
    """Return the levels of further inputs that the pictures omit; empty without any."""
    third, left = third_input(data), []
    for axis, level in zip(data.axes, held_levels(data), strict=True):
        count = len(axis.values)
        if axis.input is third and count > MOST_PANELS:
            left.append(f"{MOST_PANELS} of the {count} levels of {axis.input.words}")
        elif axis.input in varied(data)[3:]:
            left.append(f"{axis.input.words} {axis.input.text(axis.values[level])} of {count} levels")
    return f"The pictures show {' and '.join(left)}; map.csv and map.nc hold all points." if left else ""


def axis_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value): axes, numbers of solved, kept and failed points, and computing time."""
    for axis in summary["axes"]:
        yield axis["words"], axis["levels"]
    failed = len(summary["failed"])
    counts = f"{summary['solved']} of {summary['points']} solved" + (f", {failed} failed" if failed else "")
    yield "points", counts + (f", {summary['kept']} of them kept from before" if summary["kept"] else "")
    if summary["loss"]:
        ends = dict.fromkeys(f"{summary['loss'][end] * 1e-3:.4g}" for end in ("least_W", "largest_W"))
        yield "loss (shaft power minus p Q)", f"{' .. '.join(ends)} kW"
    if summary["energy_balance_error_max"] is not None:
        yield "largest energy balance error", f"{100.0 * summary['energy_balance_error_max']:.2g} % of the shaft power"
    if summary["seconds_a_point"] is not None:
        one = f"{summary['seconds_a_point']:.2g} s of processor time per point"
        yield "computing time", f"{one}, {summary['wall_s']:.3g} s in total with {summary['workers']} at a time"


def best_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (definitions, efficiency, point, formulas) of each best point; equal ones together."""

    best = {BY_NAME[one["definition"]]: one for one in summary["best"]}
    shown = {name: (f"{100.0 * one['overall']:.2f} %", one["at"]) for name, one in best.items()}
    for alike, cells in agreeing(shown):
        formulas = dict.fromkeys(overall_formula(best[one]["formula"]) for one in alike)
        yield definition_words(alike), *cells, "; ".join(formulas)


def displacement_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (setting, geometric, swept, by Toet) in mL/r."""
    for row in summary["displacement"]:
        toet, sigma = row["toet_m3_per_rev"], row["toet_sigma_m3_per_rev"]
        by_toet = "void" if toet is None else f"{toet * CM3:.3f}" + (f" +- {sigma * CM3:.2g}" if sigma else "")
        yield (
            row["at"],
            *(f"{row[name] * CM3:.3f} mL/r" for name in ("geometric_m3_per_rev", "swept_m3_per_rev")),
            f"{by_toet} mL/r" if toet is not None else by_toet,
        )


def error_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (number, rms, largest, relative to the map's largest) of the error between levels."""
    found = summary["interpolation"]
    for key, row in (found["numbers"] if found else {}).items():
        name, unit = next((key.removesuffix(f"_{end}"), end) for end in _SHOWN if key.endswith(f"_{end}"))
        scale, shown = _SHOWN[unit]
        errors = (f"{row[kind] * scale:.3g} {shown}" for kind in ("rms", "largest"))
        yield name.replace("_", " "), *errors, f"{100.0 * row['largest'] / row['of']:.2g} %"


def failed_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (point, state, reason) of every point without a result."""
    for point in summary["failed"]:
        yield point["at"], point["status"], point["reason"]


def failure_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (reason, number of points, the first of them), the most frequent reason first."""
    counts = Counter(point["reason"] for point in summary["failed"])
    first = {point["reason"]: point["at"] for point in reversed(summary["failed"])}
    for reason, count in counts.most_common():
        yield reason, str(count), first[reason]
