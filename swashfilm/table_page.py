"""The page of a response table: report.html made from the run folder's own files."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.table_plots import table_plots
from system.faults import Fault, InputFaults
from system.response_tables import axis_value
from system.table_store import read_table

FILES = ("summary.json", "resolved.toml", "table.json", "table.npz")


def write_table_page(folder: Path) -> Path:
    """Write report.html of a table's run folder; raises InputFaults where one of its files is not there."""
    from jinja2 import Environment, PackageLoader

    missing = [name for name in FILES if not (folder / name).is_file()]
    if missing:
        raise InputFaults(str(folder), [Fault(name, "no such file", "a table's run folder") for name in missing])
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    pictures = table_plots(read_table(folder / "table.json").response)
    template = Environment(loader=PackageLoader("swashfilm"), autoescape=True).get_template("table.html.jinja")
    page = template.render(
        summary=summary,
        held=list(held_rows(summary)),
        errors=list(error_rows(summary)),
        meanings=[
            (row["name"].replace(".", ", ").replace("_", " "), row["meaning"]) for row in summary["outputs"]
        ],
        failed=[(_place(summary, one["at"]), one["reason"]) for one in summary["failed"]],
        pictures={text: base64.b64encode(png).decode("ascii") for text, png in pictures.items()},
        resolved=(folder / "resolved.toml").read_text("utf-8"),
    )
    path = folder / "report.html"
    path.write_text(page, encoding="utf-8")
    return path


def held_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """(what, value with its unit): where a table comes from, its box, and what it is held at."""
    yield "condensed from", f"{summary['source']} fidelity"
    for name, text in summary["stated"].items():
        yield name, text
    for axis in summary["axes"]:
        ends = (axis_value(axis["name"], axis[end]) for end in ("lower", "upper"))
        yield axis["name"].replace("_", " "), " .. ".join(ends)
    for name in ("inlet_pressure", "case_pressure"):
        yield name.replace("_", " "), axis_value("delivery_pressure", summary[name])
    points = summary["points"]
    failed = f", {len(summary['failed'])} failed" if summary["failed"] else ""
    yield "points", f"{points['learnt']} learnt, {points['held_out']} held out{failed}"
    yield "computing, a point", f"{summary['seconds']:.3g} s"


def error_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """(output, rms, largest error of held-out points, where the largest is)."""
    for row in summary["outputs"]:
        relative = row["measure"] == "relative"
        errors = (
            f"{100.0 * row[key]:.2f} %" if relative else f"{row[key]:.4f}"
            for key in ("held_out_rms", "held_out_largest")
        )
        yield row["name"].replace(".", ", ").replace("_", " "), *errors, _place(summary, row["held_out_worst_at"])


def _place(summary: Mapping[str, Any], at: list[float]) -> str:
    return ", ".join(axis_value(axis["name"], value) for axis, value in zip(summary["axes"], at, strict=True))
