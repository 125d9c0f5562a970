"""Files of a reproduction: claims as JSON and table, numbers of the curves, and pictures."""

from collections.abc import Iterator, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

from swashfilm.output.page import keep_pictures
from swashfilm.output.run_folder import write_json
from swashfilm.output.tables import write_csv
from swashfilm.runs.reproduce.plots import panel_pictures
from system.paper.figure import FigureAxis, Panel, Unit
from system.paper.judge import FigureResult, Judged, Range

CLAIMS, DATA = "claims.json", "data"
Row = dict[str, Any]


def write_reproduction(folder: Path, results: Sequence[FigureResult], summary: Row) -> None:
    """Write claims.json, claims.csv, data/FIGURE.csv, plots/FIGURE-N.svg and summary.json."""
    rows = claim_rows(results, summary["fidelity"])
    write_json(folder / CLAIMS, {"format": 1, "claims": rows})
    _write_table(folder / "claims.csv", [one for result in results for one in result.judged], summary["fidelity"])
    for result in (result for result in results if result.panels):
        (folder / DATA).mkdir(exist_ok=True)
        _write_curves(folder / DATA / f"{result.figure.value}.csv", result.panels)
        keep_pictures(folder, result.figure.value, panel_pictures(result.panels))
    write_json(folder / "summary.json", summary)


def claim_rows(results: Sequence[FigureResult], fidelity: str) -> list[Row]:
    """Return each judged statement for claims.json, its readings together; a missing end of a range is null."""
    by_claim: dict[str, list[Judged]] = {}
    for result in results:
        for one in result.judged:
            by_claim.setdefault(one.claim.id, []).append(one)
    return [_claim_row(one, fidelity) for readings in by_claim.values() for one in readings]


def _claim_row(one: Judged, fidelity: str) -> Row:
    claim, impossible = one.claim, one.impossible
    return {
        "id": claim.id,
        "figure": claim.figure.value,
        "words": claim.words,
        "quantity": claim.quantity,
        "unit": claim.unit.si,
        "expected": _ends(claim.expected),
        "expected_text": claim.expected.text(claim.unit, 5),
        "taken": claim.taken,
        "fidelity": fidelity,
        "reading": one.reading.value if one.reading else "",
        "found": _ends(one.found),
        "found_text": one.found.text(claim.unit),
        "verdict": one.verdict.value,
        "reason": one.reason,
        "impossible": None
        if impossible is None
        else {
            "quantity": impossible.quantity,
            "unit": impossible.unit.si,
            "value": impossible.value,
            "bound": _ends(impossible.bound),
            "text": impossible.text,
        },
    }


def _ends(of: Range) -> list[float | None]:
    return [end if isfinite(end) else None for end in (of.low, of.high)]


def figure_row(result: FigureResult) -> Row:
    """Return the entry of a figure in summary.json."""
    figure = result.figure
    return {
        "name": figure.value,
        "title": figure.title,
        "picture": bool(result.panels),
        "remarks": list(result.remarks),
    }


def _write_table(path: Path, judged: Sequence[Judged], fidelity: str) -> None:
    """Write one row per statement and reading; ranges as two columns in the unit of the row."""
    head = ["id", "figure", "words", "quantity", "unit", "expected low", "expected high", "fidelity", "reading",
            "found low", "found high", "verdict", "reason", "impossible"]  # fmt: skip
    lines = []
    for one in judged:
        claim, reading = one.claim, one.reading.value if one.reading else ""
        expected, found = (_shown_ends(of, claim.unit) for of in (claim.expected, one.found))
        impossible = one.impossible.text if one.impossible else ""
        told = claim.id, claim.figure.value, claim.words, claim.quantity, claim.unit.shown
        lines.append([*told, *expected, fidelity, reading, *found, one.verdict.value, one.reason, impossible])
    write_csv(path, head, lines)


def _shown_ends(of: Range, unit: Unit) -> list[str]:
    return ["" if end is None else f"{unit.factor * end:.8g}" for end in _ends(of)]


def _write_curves(path: Path, panels: Sequence[Panel]) -> None:
    """Write all points of all curves and fields, in the units of their axes."""
    head = ["panel", "curve", "x", "x unit", "y", "y unit", "one sigma of y", "value", "value unit"]
    write_csv(path, head, (row for panel in panels for row in _points(panel)))


def _points(panel: Panel) -> Iterator[list[str]]:
    for curve in panel.curves:
        widths = [""] * len(curve.y) if curve.sigma is None else [_number(one, panel.y)[0] for one in curve.sigma]
        for x, y, width in zip(curve.x, curve.y, widths, strict=True):
            yield [panel.title, curve.name, *_number(x, panel.x), *_number(y, panel.y), width, "", ""]
    if panel.field is not None:
        field = panel.field
        for y, row in zip(field.y, field.values, strict=True):
            for x, value in zip(field.x, row, strict=True):
                place = [*_number(x, panel.x), *_number(y, panel.y)]
                yield [panel.title, field.axis.words, *place, "", *_number(value, field.axis)]


def _number(value: float, axis: FigureAxis) -> tuple[str, str]:
    return f"{axis.unit.factor * value:.8g}", axis.unit.shown
