"""Page of a response table: report.html from the files of the run folder."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gaps.response import Measure
from swashfilm.output.answer import Answer, Tile
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.table.plots import NEGLIGIBLE, table_plots, words_of
from system.inputs.shown import quantity_text
from system.inputs.units import Dimension
from system.points.table.response_table import axis_words
from system.points.table.store import read_response

KINDS = NUMBERS, OUTPUTS = "numbers", "outputs"
"""Kinds of rows in a summary: numbers of runs by the table, and outputs of its response."""
HEADLINE = ("shaft_torque", "delivery_flow")
"""Numbers of a pump's table whose errors a page always states first."""
MOST_TILES = 4
FILES = ("summary.json", "resolved.toml", "table.json", "table.npz")


def write_table_page(folder: Path) -> Path:
    """Write report.html of a table's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a table's run folder")
    response = read_response(folder / "table.json", summary["table_format"], lambda _, response: response)
    pictures = {text: inlined(figure) for text, figure in table_plots(response, summary).items()}
    caption = next(iter(pictures))
    return write_page(
        folder,
        "table",
        answer=table_answer(summary, pictures.pop(caption), caption),
        summary=summary,
        held=list(held_rows(summary)),
        numbers=list(number_rows(summary)),
        errors=list(error_rows(summary)),
        meanings=[(words_of(row["name"]), row["meaning"]) for kind in KINDS for row in summary.get(kind, [])],
        failed=[(place_text(summary["axes"], one["at"]), one["reason"]) for one in summary["failed"]],
        pictures=pictures,
        resolved=kept_text(folder, "resolved.toml"),
    )


def held_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value with its unit): origin of the table, its constant inputs, and its box."""
    yield from summary["condensed"].items()
    for axis in summary["axes"]:
        yield (axis_words(axis["name"]), " .. ".join(input_text(axis, axis[end]) for end in ("lower", "upper")))
    points = summary["points"]
    failed = f", {len(summary['failed'])} failed" if summary["failed"] else ""
    yield "points", f"{points['learnt']} learnt, {points['held_out']} held out{failed}"
    yield "computing time per point", f"{summary['seconds']:.3g} s"


def table_answer(summary: Mapping[str, Any], picture: Picture | None = None, caption: str = "") -> Answer:
    """Return the answer of a table's page: its largest errors and their places, its box, and its use."""
    rows, axes, points = _ranked(summary, NUMBERS) or _ranked(summary, OUTPUTS), summary["axes"], summary["points"]
    headline = [row for row in rows if row["name"] in HEADLINE]
    others = [row for row in rows if row not in headline]
    tiles = [_error_tile(row, summary) for row in (*others[: MOST_TILES - len(headline)], *headline)]
    tiles.append(
        Tile(f"{points['learnt']} + {points['held_out']}", "points", "learnt, and held out to measure the error")
    )
    box = "; ".join(
        f"{axis_words(axis['name'])} {input_text(axis, axis['lower'])} to {input_text(axis, axis['upper'])}"
        for axis in axes
    )
    worst = rows[0]
    named = "".join(f" {words_of(row['name']).capitalize()} is met to {_error_text(row)}." for row in headline)
    words = (
        f"The table gives numbers of the pump in milliseconds in this box: {box}. It learnt {points['learnt']} solved "
        f"points; at {points['held_out']} others its largest error is {_error_text(worst)}, of "
        f"{words_of(worst['name'])} at {place_text(axes, worst['held_out_worst_at'])}.{named} Outside the box it is "
        f"refused."
    )
    return Answer(tuple(tiles), words, picture, caption)


def error_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (output, rms, largest error of held-out points, point of the largest); negligible ones in one row."""
    yield from _rows_of(summary, OUTPUTS)


def number_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the same for the pump's numbers by runs with the table; nothing for a gap's table."""
    yield from _rows_of(summary, NUMBERS)


def _ranked(summary: Mapping[str, Any], kind: str) -> list[Mapping[str, Any]]:
    """Return the rows of a kind, the largest error first."""
    return sorted(summary.get(kind, []), key=lambda row: -float(row["held_out_largest"]))


def _rows_of(summary: Mapping[str, Any], kind: str) -> Iterator[tuple[str, ...]]:
    rows = _ranked(summary, kind)
    for row in rows:
        if row["held_out_largest"] >= NEGLIGIBLE:
            place = place_text(summary["axes"], row["held_out_worst_at"])
            yield words_of(row["name"]), _error_text(row, "held_out_rms"), _error_text(row), place
    if small := sum(row["held_out_largest"] < NEGLIGIBLE for row in rows):
        yield f"{small} others", "", f"below {100.0 * NEGLIGIBLE:g} %", ""


def _error_text(row: Mapping[str, Any], key: str = "held_out_largest") -> str:
    """Return an error of a row, in percent; of an output that is a share, as a number."""
    error = float(row[key])
    if error < NEGLIGIBLE:
        return f"below {100.0 * NEGLIGIBLE:g} %"
    match Measure(row["measure"]):
        case Measure.RELATIVE:
            return f"{100.0 * error:.2g} %"
        case Measure.OF_LARGEST:
            return f"{100.0 * error:.2g} % of the largest"
        case Measure.ABSOLUTE:
            return f"{error:.2g}"


def _error_tile(row: Mapping[str, Any], summary: Mapping[str, Any]) -> Tile:
    value, _, whole = _error_text(row).partition(" of the ")
    where = f"{f'of the {whole}; ' if whole else ''}at {place_text(summary['axes'], row['held_out_worst_at'])}"
    return Tile(value, f"largest error, {words_of(row['name'])}", where)


def input_text(axis: Mapping[str, Any], value: float) -> str:
    """Return a value of an axis (a row of the record) with its unit."""
    if axis["dimension"] is None:
        return f"{value:.4g}"
    return quantity_text(float(value), Dimension[axis["dimension"]], digits=4)


def place_text(axes: Sequence[Mapping[str, Any]], at: Sequence[float]) -> str:
    """Return a point in the box in words."""
    return ", ".join(
        f"{axis_words(axis['name'])} {input_text(axis, value)}" for axis, value in zip(axes, at, strict=True)
    )
