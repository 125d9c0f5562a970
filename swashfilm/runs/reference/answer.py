"""Answer of a reference flow: the coefficients of the passage at its ends of Reynolds number, and their error."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from swashfilm.output.answer import Tile


def reference_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield the headline numbers of a reference flow from its summary."""
    rows = _rows(summary)
    last = max(rows, key=lambda row: row["reynolds"])
    re = f"at Re {last['reynolds']:g}"
    if last["flow_coefficient"] is not None:
        yield Tile(f"{last['flow_coefficient']:.3f}", "flow coefficient", re)
    lengths = [passage["extra_length"] for passage in summary["passages"]]
    unit = "diameters" if last["flow_coefficient"] is not None else "film thicknesses"
    yield Tile(_span(lengths), "extra length of slow flow", unit)
    yield Tile(f"{last['loss_factor']:.3g}", "loss factor", re)
    if last["pressure_drop_over_film_equation"] is not None:
        yield Tile(f"{last['pressure_drop_over_film_equation']:.3f}", "pressure drop over film equation", re)
    yield Tile(f"{100.0 * max(row['mesh_error'] for row in rows):.2g} %", "largest mesh error", "of the pressure drop")


def reference_words(summary: Mapping[str, Any]) -> str:
    """Return a paragraph on a reference flow from its summary."""
    rows = _rows(summary)
    numbers = [row["reynolds"] for row in rows]
    drops = [
        row["pressure_drop_over_film_equation"] for row in rows if row["pressure_drop_over_film_equation"] is not None
    ]
    words = [
        f"The flow through {_counted(summary)} is solved at Reynolds numbers from {min(numbers):g} to {max(numbers):g}."
    ]
    if drops:
        words.append(f"The pressure drop is {_span(drops)} times that of the film equation alone.")
    words.append(f"The table {summary['table']} brings the coefficients into a pump file.")
    words.append(f"Valid for {summary['holds_for']}.")
    return " ".join(words)


def _counted(summary: Mapping[str, Any]) -> str:
    """Return the number of passages and their kind."""
    count, kind = len(summary["passages"]), summary["passage"].replace("_", " ")
    return f"one passage ({kind})" if count == 1 else f"{count} passages ({kind})"


def _rows(summary: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    return [row for passage in summary["passages"] for row in passage["rows"]]


def _span(values: list[float]) -> str:
    """Return the ends of some numbers, one where they agree."""
    low, high = f"{min(values):.3g}", f"{max(values):.3g}"
    return low if low == high else f"{low} to {high}"
