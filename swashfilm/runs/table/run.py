"""Run of a response table: built or completed, and written to a run folder with its error."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gaps.response import ErrorRegion, Response
from swashfilm.console.schemas import write_new
from swashfilm.formats.versions import headed
from swashfilm.output.data.files import Column, write_columns
from swashfilm.output.headline import named
from swashfilm.output.run_folder import write_json
from swashfilm.runs.table.page import input_text, place_text
from system.films.parts import floating_parts
from system.inputs.units import Dimension
from system.points.table.build import TableCase, build_table
from system.points.table.means import MEANINGS
from system.points.table.pump_numbers import NUMBERS
from system.points.table.response_table import LARGE_ERROR, ResponseTable, axis_value, axis_words
from system.points.table.store import keep_table, table_record
from system.pump_file.file import resolved_toml
from system.work.processes import process_pool
from system.work.progress import Report

TABLE = "table"
NARROW = 0.7
"""Largest fraction of an axis that a region of large error may cover for the axis to be named."""


def run_table(case: TableCase, folder: Path, report: Report, *, workers: int = 1) -> dict[str, Any]:
    """Build a table and write table.npz, table.json, points.csv, resolved.toml, summary.json and report.html.

    The cache stores the table point by point. Returns the summary. Raises as `build_table`.
    """
    with process_pool(workers) as executor:
        table = build_table(case, executor=executor, report=report)
    write_new(folder / "resolved.toml", "pump", resolved_toml(case.pump))
    keep_table(table, folder / TABLE)
    summary = table_summary(table) | {"assumptions": [str(one) for one in floating_parts(case.pump).taken]}
    write_table_files(folder, table.response, summary)
    return summary


def write_table_files(folder: Path, response: Response, summary: Mapping[str, Any]) -> None:
    """Write points.csv, summary.json and, from the folder's files, report.html."""
    write_points(folder / "points.csv", response, summary)
    write_json(folder / "summary.json", summary)
    from swashfilm.runs.table.page import write_table_page

    write_table_page(folder)


def table_summary(table: ResponseTable) -> dict[str, Any]:
    """Return the summary of a table: origin, box, error of each output, and warnings."""
    record, origin = table_record(table), table.origin
    held = dict(origin.held) | {"inlet_pressure": origin.inlet_pressure, "case_pressure": origin.case_pressure}
    rows = [row | {"unit": "1", "meaning": MEANINGS[row["name"]]} for row in record["outputs"]]
    return record | {
        **headed("response_table"),
        "name": origin.pump,
        "condensed": {
            "condensed from": f"{origin.source.value} fidelity",
            **origin.stated,
            **{name.replace("_", " "): axis_value(name, value) for name, value in held.items()},
        },
        "outputs": rows,
        "numbers": [row | {"meaning": NUMBERS[row["name"]]} for row in record["numbers"]],
        "warnings": [*table_warnings(table.response, record), *_far_off(record)],
    }


def table_warnings(response: Response, record: Mapping[str, Any]) -> list[str]:
    """Return warnings of outputs with large errors, with their region, and of points without a result."""
    return [*_large_errors(response, record["axes"]), *_failures(record)]


def _large_errors(response: Response, axes: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    for column, output in enumerate(response.outputs):
        region = response.large_error(column, LARGE_ERROR)
        if region is None:
            continue
        error = response.held_out_error
        yield (
            f"large_error: {output.name}: the error of held-out points is {error.largest[column]:.3g} at most, "
            f"{error.rms[column]:.3g} rms ({output.measure.value}, limit {LARGE_ERROR:g}); above the limit are "
            f"{region.count} of {len(response.held_out.points)}, {region_text(response, region, axes)}; choose a "
            "smaller box or more points"
        )


def _far_off(record: Mapping[str, Any]) -> Iterator[str]:
    for row in record["numbers"]:
        if row["held_out_largest"] > LARGE_ERROR:
            yield (
                f"large_error: the error of {row['name']} by this table at held-out points is "
                f"{row['held_out_largest']:.3g} at most, {row['held_out_rms']:.3g} rms ({row['measure']}, limit "
                f"{LARGE_ERROR:g}), largest at {place_text(record['axes'], row['held_out_worst_at'])}; choose a "
                "smaller box or more points"
            )


def region_text(response: Response, region: ErrorRegion, axes: Sequence[Mapping[str, Any]]) -> str:
    """Return the position of a region in words, by the axes along which it is narrow."""
    ends = []
    for axis, row, low, high in zip(response.axes, axes, region.lower, region.upper, strict=True):
        if np.ptp(axis.to_unit(np.array([low, high]))) < NARROW:
            shown = dict.fromkeys((input_text(row, low), input_text(row, high)))
            ends.append(f"{axis_words(axis.name)} {' .. '.join(shown)}")
    return "at " + ", ".join(ends) if ends else "all over the box"


def _failures(record: Mapping[str, Any]) -> Iterator[str]:
    failed = record["failed"]
    if failed:
        yield (
            f"points_failed: {len(failed)} points have no result and are not fitted, such as "
            f"{place_text(record['axes'], failed[0]['at'])}: {failed[0]['reason']}"
        )


def write_points(path: Path, response: Response, summary: Mapping[str, Any]) -> None:
    """Write every point: fitted or held out, inputs with units, outputs as solved and by the table."""
    sets = {"learnt": response.learnt, "held out": response.held_out}
    points, solved = (np.vstack([getattr(one, name) for one in sets.values()]) for name in ("points", "values"))
    kinds = [kind for kind, samples in sets.items() for _ in samples.points]
    inputs = [
        (axis["name"], Dimension[axis["dimension"]].si_unit if axis["dimension"] else "1") for axis in summary["axes"]
    ]
    outputs = [(named(row["name"])[0], row["unit"]) for row in summary["outputs"]]
    by_table = [(f"{name} by table", unit) for name, unit in outputs]
    numbers = np.hstack([points, solved, response.at(points)]).T
    columns = zip([*inputs, *outputs, *by_table], numbers, strict=True)
    write_columns(path, [Column("set", kinds), *(Column(name, values, unit) for (name, unit), values in columns)])
