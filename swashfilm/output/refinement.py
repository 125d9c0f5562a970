"""Numbers on meshes each twice finer: summary, table and file of their orders and limits."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from reynolds.numerics.convergence import Convergence, ConvergenceKind
from swashfilm.output.data.files import CSV_DIGITS
from swashfilm.output.headline import named, shown_of, titled_key
from swashfilm.output.tables import write_csv
from system.inputs.shown import Shown, quantity_text, significant
from system.inputs.units import Dimension

DIGITS = 6
"""Significant digits of numbers whose change from mesh to mesh is of interest."""


@dataclass(frozen=True)
class Refinement:
    """Unknowns of the meshes, coarsest (that of the case) first; expected orders; the numbers by key.

    time_steps: those of a transient on each mesh; empty for a film that is not in time.
    """

    dofs: tuple[int, ...]
    expected: tuple[float, float]
    numbers: Mapping[str, Convergence]
    time_steps: tuple[int, ...] = ()


def refinement_summary(found: Refinement) -> dict[str, Any]:
    """Return the entry of summary.json: SI, units in the keys of the numbers."""
    return {
        "dofs": list(found.dofs),
        **({"time_steps": list(found.time_steps)} if found.time_steps else {}),
        "expected_order": list(found.expected),
        "numbers": {
            key: {
                "values": list(number.values),
                "order": number.order,
                "extrapolated": number.extrapolated,
                "error": number.error,
                "verdict": number.verdict.value,
            }
            for key, number in found.numbers.items()
        },
    }


def refinement_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (number and unit, value on each mesh, order, limit and error bar, verdict) of a `refinement`."""
    for key, number in found["numbers"].items():
        order = "-" if number["order"] is None else f"{number['order']:.2f}"
        shown = shown_of(key)
        least = number["error"] if number["verdict"] == ConvergenceKind.CONVERGED.value else 0.0
        values = [significant(shown.of(value) if abs(value) > least else 0.0, DIGITS) for value in number["values"]]
        limit = _with_bar(shown, number["extrapolated"], number["error"])
        yield (titled_key(key), *values, order, limit, number["verdict"])


def _with_bar(shown: Shown, limit: float | None, error: float | None) -> str:
    """Return the limit in its unit, rounded to the digit of its error bar."""
    if limit is None or error is None:
        return "-"
    limit, error = shown.of(limit if abs(limit) > error else 0.0), shown.difference(error)
    return f"{significant(limit, _digits(limit, error))} +- {significant(error, 1)}"


def _digits(limit: float, error: float) -> int:
    """Return the number of significant digits of a limit within its error."""
    if error > 0.0 and limit != 0.0:
        return int(np.clip(np.ceil(np.log10(abs(limit) / error)) + 1.0, 2, 10))
    return DIGITS


def bar_text(summary: Mapping[str, Any], key: str, dimension: Dimension) -> str:
    """Return limit and error bar of a number of a refined run, each with its unit; empty without refinement.

    Without a limit the verdict states the reason.
    """
    number = summary.get("refinement", {}).get("numbers", {}).get(key)
    if number is None:
        return ""
    limit, error = number["extrapolated"], number["error"]
    if number["verdict"] == ConvergenceKind.CONVERGED.value:
        return str(number["verdict"])
    if limit is None or error is None:
        return f"{number['verdict']}: no error bar"
    digits = _digits(limit, error)
    return f"limit {quantity_text(limit, dimension, digits=digits)} +- {quantity_text(error, dimension, digits=1)}"


def refinement_head(found: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the titles of the columns of `refinement_rows`."""
    counts = zip_longest(found["dofs"], found.get("time_steps", ()))
    meshes = [f"{dofs} unknowns" + (f", {steps} steps" if steps else "") for dofs, steps in counts]
    return ("", *meshes, "order", "limit", "verdict")


def write_refinement(path: Path, found: Refinement) -> None:
    """Write a CSV of the numbers: key, unit, value on each mesh, order, limit, error bar, verdict."""
    rows = []
    for key, number in found.numbers.items():
        shown = shown_of(key)
        limit = None if number.extrapolated is None else shown.of(number.extrapolated)
        error = None if number.error is None else shown.difference(number.error)
        cells = (*(shown.of(value) for value in number.values), number.order, limit, error)
        rows.append([named(key)[0], shown.unit, *(_cell(value) for value in cells), number.verdict.value])
    meshes = [f"{dofs} unknowns" for dofs in found.dofs]
    write_csv(path, ["number", "unit", *meshes, "order", "limit", "error", "verdict"], rows)


def _cell(value: float | None) -> str:
    return "" if value is None else f"{value:.{CSV_DIGITS}g}"
