"""Comparison of two maps: differences, duty cycle, page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.output.page import keep_pictures, kept_pictures, read_summary, write_page
from swashfilm.output.run_folder import write_json
from swashfilm.output.tables import write_csv
from swashfilm.runs.map.duty import duty_summary
from swashfilm.runs.map.plots import Slice, contours, difference_levels, efficiency_levels, held_words, shown, slice_of
from system.inputs.shown import shown_in
from system.maps.compare import MapComparison
from system.maps.data import LOSSES, MapData
from system.maps.duty import Cycle, duty
from system.maps.interpolation import MapError, MapInterpolant, left_out_error
from system.maps.plan import MapInput
from system.pump.efficiency import EfficiencyDefinition

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = "compare"
DIFFERENCE_HEAD = ("", "A, mean", "B, mean", "largest difference, B - A", "at", "error of interpolation there")
DUTY_HEAD = ("", "A", "B", "B - A", "error of both")
_SCALES = {"W": (1e-3, "kW"), "m3/s": (6e4, "L/min"), "1": (100.0, "%"), "N m": (1.0, "N m")}

Known = tuple[MapData, MapError | None]


INK = "#55616a"
SHOWN = (EfficiencyDefinition.PAPER, EfficiencyDefinition.ENERGY_RETURNED)


def run_compare(
    found: MapComparison, names: tuple[str, str], both: tuple[Known, Known], cycle: Cycle | None, folder: Path
) -> dict[str, Any]:
    """Write differences.csv, summary.json, plots and report.html of a comparison; return the summary."""
    summary = {
        "format": 1,
        "kind": "comparison",
        "names": list(names),
        "pumps": [data.name for data, _ in both],
        "solvers": [data.words for data, _ in both],
        "warnings": list(_warnings(both)),
        "box": [
            {"words": axis.input.words, "from": axis.input.text(axis.values[0]), "to": axis.input.text(axis.values[-1])}
            for axis in found.one.axes
        ],
        "differences": [
            {
                "words": one.words,
                "unit": one.unit,
                "one": one.one,
                "other": one.other,
                "largest": one.largest,
                "at": {given.value: value for given, value in one.at.items()},
                "error": one.error,
                "told": one.significant,
            }
            for one in found.differences
        ],
        "duty": [] if cycle is None else [_duty(data, error, cycle) for data, error in both],
    }
    write_json(folder / "summary.json", summary)
    _write_table(folder / "differences.csv", summary)
    keep_pictures(folder, PICTURES, compare_plots(found))
    write_compare_page(folder)
    return summary


def _warnings(both: tuple[Known, Known]) -> Iterator[str]:
    """Yield warnings on the differences."""
    one, other = (data.words for data, _ in both)
    if one != other:
        yield f"A is {one}, B is {other}: differences contain those between the fidelities, not only the pumps"


def _duty(data: MapData, error: MapError | None, cycle: Cycle) -> dict[str, Any]:
    known = error or left_out_error(data)
    if known is None:
        raise ValueError("a duty cycle needs a map with three levels of at least one input")
    return duty_summary(data, duty(MapInterpolant(data), cycle, known))


def difference_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (number, mean of A, mean of B, largest difference, point, largest error of interpolation)."""
    varied = {box["words"] for box in summary["box"] if box["from"] != box["to"]}
    for row in summary["differences"]:
        scale, unit = _SCALES[row["unit"]]
        at = ", ".join(f"{given.text(row['at'][given.value])}" for given in MapInput if given.words in varied)
        means = (f"{row[which] * scale:.5g} {unit}" for which in ("one", "other"))
        error = f"{row['error'] * scale:.2g} {unit}" if row["error"] else "none: same levels"
        yield row["words"], *means, f"{row['largest'] * scale:+.4g} {unit}", at, error


def duty_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (energy, of A, of B, difference, error of both)."""
    one, other = (side["energy_J"] for side in summary["duty"])
    for words in dict.fromkeys([*one, *other]):
        nothing = {"value": 0.0, "error": 0.0}
        mine, theirs = one.get(words, nothing), other.get(words, nothing)
        values = mine["value"], theirs["value"], theirs["value"] - mine["value"]
        yield (
            words,
            *(f"{value * 1e-3:.5g} kJ" for value in values),
            f"{(mine['error'] + theirs['error']) * 1e-3:.2g} kJ",
        )


def _write_table(path: Path, summary: Mapping[str, Any]) -> None:
    places = [f"at {given.words} [{given.shown.unit}]" for given in MapInput]
    heads = "number", "unit", "A mean", "B mean", "largest B - A", "interpolation may miss there"
    rows = []
    for row in summary["differences"]:
        shown = shown_in(row["unit"])
        numbers = [
            *(shown.of(row[name]) for name in ("one", "other")),
            *(shown.difference(row[name]) for name in ("largest", "error")),
            *(given.shown.of(row["at"][given.value]) for given in MapInput),
        ]
        rows.append([row["words"], shown.unit, *(f"{number:.8g}" for number in numbers)])
    write_csv(path, [*heads, *places], rows)


def write_compare_page(folder: Path) -> Path:
    """Write report.html of a comparison's run folder from its summary.json and plots/."""
    summary = read_summary(folder)
    return write_page(
        folder,
        "compare",
        summary=summary,
        box=[(box["words"], f"{box['from']} .. {box['to']}") for box in summary["box"]],
        differences=list(difference_rows(summary)),
        difference_head=DIFFERENCE_HEAD,
        duty=list(duty_rows(summary)) if summary["duty"] else [],
        duty_head=DUTY_HEAD,
        pictures=kept_pictures(folder, PICTURES),
    )


def compare_plots(found: MapComparison) -> dict[str, Figure]:
    """Return the pictures of a comparison by caption."""
    pictures = {}
    for up in (MapInput.RATIO, MapInput.SPEED):
        piece = slice_of(found.one, MapInput.PRESSURE, up)
        if piece is not None:
            where = held_words(found.one, piece)
            pictures[f"Overall efficiency of A and B in %, and B - A in percentage points, {where}"] = _slices(
                found, piece
            )
    pictures["Mean power of every loss over the common levels"] = _losses(found)
    return pictures


def _slices(found: MapComparison, piece: Slice) -> Figure:
    figure = figure_of(11.0, 6.8)
    panels = figure.subplots(len(SHOWN), 3)
    for row, definition in zip(panels, SHOWN, strict=True):
        one, other = (100.0 * piece.of(data.efficiency(definition).overall) for data in (found.one, found.other))
        levels = efficiency_levels(*(shown(found.one, piece, field) for field in (one, other)))
        for axes, field, words in zip(row, (one, other), "AB", strict=False):
            contours(axes, found.one, piece, field, levels)
            axes.set_title(f"{words} [%]: {definition.label}", fontsize=8)
        apart = other - one
        levels = difference_levels(shown(found.one, piece, apart))
        contours(row[-1], found.one, piece, apart, levels, colours="RdBu", ink=INK)
        row[-1].set_title(f"B - A / percentage points: {definition.label}", fontsize=8)
    return figure


def _losses(found: MapComparison) -> Figure:
    sinks = {
        words: [float(np.mean(data.values[column])) * 1e-3 for data in (found.one, found.other)]
        for column, words in LOSSES.items()
    }
    sinks = {words: pair for words, pair in sinks.items() if any(pair)}
    figure = figure_of(9.0, max(2.6, 0.4 * len(sinks)))
    axes, rows = figure.subplots(), np.arange(len(sinks))
    one, other = zip(*sinks.values(), strict=True)
    axes.barh(rows - 0.2, one, 0.38, color="#3c7a8c", label="A")
    axes.barh(rows + 0.2, other, 0.38, color="#8c5a3c", label="B")
    axes.set_yticks(rows, list(sinks))
    axes.invert_yaxis()
    axes.set_xlabel("mean loss [kW]")
    axes.legend()
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure
