"""Page of a response table: report.html from the files of the run folder."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gaps.response import Measure
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.table.plots import table_plots, words_of
from system.inputs.units import Dimension, format_quantity
from system.points.table.store import read_response

KINDS = NUMBERS, OUTPUTS = "numbers", "outputs"
"""Kinds of rows in a summary: numbers of runs by the table, and outputs of its response."""
FILES = ("summary.json", "resolved.toml", "table.json", "table.npz")


def write_table_page(folder: Path) -> Path:
    """Write report.html of a table's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a table's run folder")
    response = read_response(folder / "table.json", summary["table_format"], lambda _, response: response)
    pictures = table_plots(response, summary)
    return write_page(
        folder,
        "table",
        summary=summary,
        held=list(held_rows(summary)),
        numbers=list(number_rows(summary)),
        errors=list(error_rows(summary)),
        meanings=[(words_of(row["name"]), row["meaning"]) for kind in KINDS for row in summary.get(kind, [])],
        failed=[(place_text(summary["axes"], one["at"]), one["reason"]) for one in summary["failed"]],
        pictures={text: inlined(png) for text, png in pictures.items()},
        resolved=(folder / "resolved.toml").read_text("utf-8"),
    )


def held_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value with its unit): origin of the table, its constant inputs, and its box."""
    yield from summary["condensed"].items()
    for axis in summary["axes"]:
        yield (axis["name"].replace("_", " "), " .. ".join(input_text(axis, axis[end]) for end in ("lower", "upper")))
    points = summary["points"]
    failed = f", {len(summary['failed'])} failed" if summary["failed"] else ""
    yield "points", f"{points['learnt']} learnt, {points['held_out']} held out{failed}"
    yield "computing time per point", f"{summary['seconds']:.3g} s"


def error_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (output, rms, largest error of held-out points, point of the largest)."""
    yield from _rows_of(summary, OUTPUTS)


def number_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the same for the pump's numbers by runs with the table; nothing for a gap's table."""
    yield from _rows_of(summary, NUMBERS)


def _rows_of(summary: Mapping[str, Any], kind: str) -> Iterator[tuple[str, ...]]:
    for row in summary.get(kind, []):
        errors = (_error_text(row["measure"], row[key]) for key in ("held_out_rms", "held_out_largest"))
        yield words_of(row["name"]), *errors, place_text(summary["axes"], row["held_out_worst_at"])


def _error_text(measure: str, error: float) -> str:
    match Measure(measure):
        case Measure.RELATIVE:
            return f"{100.0 * error:.2f} %"
        case Measure.OF_LARGEST:
            return f"{100.0 * error:.2f} % of the largest"
        case Measure.ABSOLUTE:
            return f"{error:.4f}"


def input_text(axis: Mapping[str, Any], value: float) -> str:
    """Return a value of an axis (a row of the record) with its unit."""
    if axis["dimension"] is None:
        return f"{value:.4g}"
    return format_quantity(float(value), Dimension[axis["dimension"]], digits=4)


def place_text(axes: Sequence[Mapping[str, Any]], at: Sequence[float]) -> str:
    """Return a point in the box in words."""
    return ", ".join(
        f"{axis['name'].replace('_', ' ')} {input_text(axis, value)}" for axis, value in zip(axes, at, strict=True)
    )
