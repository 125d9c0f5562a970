"""A response table as a run: built or completed, and left in a run folder with what it is worth."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from gaps.response import Region, Response
from swashfilm.progress import Report
from swashfilm.run_folder import write_json
from system.pump_file import resolved_toml
from system.response_tables import LARGE_ERROR, ResponseTable, axis_value
from system.table_build import TableCase, build_table
from system.table_means import MEANINGS
from system.table_store import keep_table, table_record

TABLE = "table"
NARROW = 0.7
"""Part of an axis within which a region of large error must lie for the axis to be named."""
UNITS = {
    "shaft_speed": "rad/s", "delivery_pressure": "Pa", "displacement_ratio": "1", "viscosity": "Pa s",
}  # fmt: skip


def run_table(case: TableCase, folder: Path, report: Report, *, workers: int = 1) -> dict[str, Any]:
    """Build a table and write table.npz, table.json, points.csv, resolved.toml, summary.json and report.html.

    The table itself is kept in the cache, point by point. Returns the summary. Raises as `build_table`.
    """
    table = build_table(case, workers=workers, report=report)
    (folder / "resolved.toml").write_text(resolved_toml(case.pump), encoding="utf-8")
    keep_table(table, folder / TABLE)
    write_points(folder / "points.csv", table)
    summary = table_summary(table)
    write_json(folder / "summary.json", summary)
    from swashfilm.table_page import write_table_page

    write_table_page(folder)
    return summary


def table_summary(table: ResponseTable) -> dict[str, Any]:
    """What a table is worth: its origin and box, the error of each output, and warnings."""
    record = table_record(table)
    meanings = [row | {"meaning": MEANINGS[row["name"]]} for row in record["outputs"]]
    return record | {
        "format": 1,
        "kind": "response_table",
        "name": table.origin.pump,
        "outputs": meanings,
        "warnings": table_warnings(table),
    }


def table_warnings(table: ResponseTable) -> list[str]:
    """Outputs that are learnt badly, with the region in which they are; points without a result."""
    return [*_large_errors(table), *_failures(table)]


def _large_errors(table: ResponseTable) -> Iterator[str]:
    response = table.response
    for column, output in enumerate(response.outputs):
        region = response.large_error(column, LARGE_ERROR)
        if region is None:
            continue
        error = response.held_out_error
        yield (
            f"large_error: {output.name}: held-out points err by {error.largest[column]:.3g} at most, "
            f"{error.rms[column]:.3g} rms ({output.measure.value}, limit {LARGE_ERROR:g}); above the limit "
            f"{region.count} of {len(response.held_out.points)}, {region_text(response, region)}; a smaller box "
            "or more points"
        )


def region_text(response: Response, region: Region) -> str:
    """Where a region lies, by the axes along which it is narrow."""
    ends = []
    for axis, low, high in zip(response.axes, region.lower, region.upper, strict=True):
        if np.ptp(axis.to_unit(np.array([low, high]))) < NARROW:
            shown = dict.fromkeys((axis_value(axis.name, low), axis_value(axis.name, high)))
            ends.append(f"{axis.name.replace('_', ' ')} {' .. '.join(shown)}")
    return "at " + ", ".join(ends) if ends else "all over the box"


def _failures(table: ResponseTable) -> Iterator[str]:
    failed = table.origin.failed
    if failed:
        first = failed[0]
        at = zip(table.response.axes, first.at, strict=True)
        place = ", ".join(f"{axis.name.replace('_', ' ')} {axis_value(axis.name, value)}" for axis, value in at)
        yield (
            f"points_failed: {len(failed)} points have no result and are not learnt from, such as {place}: "
            f"{first.reason}"
        )


def write_points(path: Path, table: ResponseTable) -> None:
    """Write every point: learnt or held out, inputs with their units, outputs as solved and as the table says."""
    response = table.response
    inputs = [f"{axis.name} [{UNITS[axis.name]}]" for axis in response.axes]
    names = [output.name for output in response.outputs]
    rows = [",".join(["set", *inputs, *(f"{n} [1]" for n in names), *(f"{n} by table [1]" for n in names)])]
    for kind, samples in (("learnt", response.learnt), ("held out", response.held_out)):
        told = response.at(samples.points)
        for numbers in np.hstack([samples.points, samples.values, told]):
            rows.append(",".join([kind, *(f"{value:.8g}" for value in numbers)]))
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
