"""Rows of a sensitivity's tables, from its summary."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from system.variation.differences import Side, Verdict
from system.variation.measures import EFFICIENCY, LOSS, MEASURES, significant

COST_HEAD = (
    "dimension", "value", "change", "loss", "efficiency", "loss by 1 %", "efficiency by 1 %", "one sigma",
    "loss by sigma",
)  # fmt: skip
SHOWN = 12
"""Rows that the command prints."""
ABOUT_ZERO = "about 0"
"""A change that is smaller than what the solver tells apart; it need not be zero."""
Row = Mapping[str, Any]


def derivative(row: Row, measure: str) -> float | None:
    """Return a derivative in SI; None where it has no number."""
    found = row["measures"][measure]["derivative"]
    return None if found is None else float(found)


def cost(row: Row, measure: str, by: str = "change") -> float:
    """Return the change of a measure by the change, "percent" or "sigma" of a dimension; 0 without a number."""
    return (derivative(row, measure) or 0.0) * (row[by] or 0.0)


def ranked(summary: Mapping[str, Any], kind: str = "") -> list[Row]:
    """Return the dimensions with a cost, the costliest first; kind: those of a change such as "1 um"."""
    rows = [row for row in summary["dimensions"] if cost(row, LOSS) != 0.0 or cost(row, EFFICIENCY) != 0.0]
    chosen = [row for row in rows if not kind or kind_of(row) == kind]
    return sorted(chosen, key=lambda row: -abs(cost(row, LOSS)))


def kind_of(row: Row) -> str:
    """Return the kind of a dimension's change: "1 um", "1 deg" or "1 %"."""
    text = str(row["change_text"])
    return text if text in ("1 um", "1 deg") else "1 %"


def cost_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of COST_HEAD, the costliest first."""
    for row in ranked(summary):
        yield (
            row["key"], row["text"], f"+{row['change_text']}", _change(row, LOSS), _change(row, EFFICIENCY),
            _change(row, LOSS, "percent"), _change(row, EFFICIENCY, "percent"), row["sigma_text"] or "",
            _change(row, LOSS, "sigma"),
        )  # fmt: skip


def measure_head(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the head of `measure_rows`."""
    return ("dimension", "change", *(one["words"] for one in summary["measures"].values()))


def measure_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the change of every measure, a row for each dimension that has an effect, in the order of the file."""
    for row in summary["dimensions"]:
        if row["has_effect"]:
            yield row["key"], f"+{row['change_text']}", *(_change(row, name) for name in summary["measures"])


def middle_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (measure, value as stated)."""
    for name, one in summary["measures"].items():
        yield one["words"], MEASURES[name].text(one["value"], 5)


def rough_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (dimension, measures whose derivative does not converge there)."""
    for row in summary["dimensions"]:
        names = [name for name, one in row["measures"].items() if one["verdict"] == Verdict.NOT_SMOOTH.value]
        if names:
            yield row["key"], "; ".join(summary["measures"][name]["words"] for name in names)


def without_effect(summary: Mapping[str, Any]) -> list[str]:
    """Return the dimensions that change no measure beyond the noise of the solver."""
    return [row["key"] for row in summary["dimensions"] if not row["has_effect"]]


def side_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (dimension, side of its difference) where the geometry allows one side only."""
    for row in summary["dimensions"]:
        if row["side"] != Side.BOTH.value:
            yield row["key"], row["side"]


def refused_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (dimension, value, reason) of those without a derivative."""
    for one in summary["refused"]:
        yield one["key"], one["value"], one["reason"]


def first_rows(rows: Sequence[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Return the first SHOWN rows, and the number of others."""
    more = len(rows) - SHOWN
    return [*rows[:SHOWN], *([(f"and {more} more in sensitivity.csv",)] if more > 0 else [])]


def _change(row: Row, measure: str, by: str = "change") -> str:
    """Return a change as people read it, with its error where that shows; the verdict where there is no number.

    Empty where the dimension has no such change: no sigma is stated, or its value is 0 and has no 1 %.
    """
    found = row["measures"][measure]
    if row[by] is None:
        return ""
    if found["verdict"] == Verdict.NOT_SMOOTH.value:
        return str(Verdict.NOT_SMOOTH.value)
    if found["verdict"] == Verdict.NO_EFFECT.value:
        return ABOUT_ZERO
    value, error = found["derivative"] * row[by], found["error"] * row[by]
    text = MEASURES[measure].change(value)
    if error <= 0.005 * abs(value):
        return text
    number, _, unit = text.partition(" ")
    return f"{number} +- {significant(error * MEASURES[measure].scale, 1)} {unit}"
