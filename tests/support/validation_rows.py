"""Rows that the tests record, and what a run of them leaves for the pages: docs/measured.json."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from measured import Measured, Reference, Trend, reference_of


@dataclass(frozen=True)
class Row:
    """One line of the validation page; place: its test's among all that were collected."""

    place: int
    chapter: str
    case: str
    source: str
    quantity: str
    unit: str
    expected: float
    obtained: float
    tolerance: float
    order: float | None
    note: str
    missed: str
    discussion: str
    measured: Reference | None

    @property
    def error(self) -> float:
        """E = S - D, in the row's unit."""
        return self.obtained - self.expected


@dataclass(frozen=True)
class Summary:
    """A run that wrote the pages, all of whose tests passed: its rows by number, and those against measurement.

    ordered: rows with an observed order of convergence; missed: rows out of their tolerance, each with its reason.
    """

    chapters: int
    rows: int
    ordered: int
    missed: int
    measured: tuple[Row, ...]

    @property
    def numbers(self) -> tuple[tuple[Row, Measured], ...]:
        """Rows against a measured number, each with its uncertainties."""
        return tuple((row, row.measured) for row in self.measured if isinstance(row.measured, Measured))

    @property
    def trends(self) -> tuple[tuple[Row, Trend], ...]:
        """Rows against a measured direction."""
        return tuple((row, row.measured) for row in self.measured if isinstance(row.measured, Trend))


def row_of(plain: Mapping[str, Any]) -> Row:
    """The row of `asdict`."""
    return Row(**{**plain, "measured": plain["measured"] and reference_of(plain["measured"])})


def summary_of(rows: Sequence[Row]) -> Summary:
    """The summary of a run's rows, in the order of the tests; measured rows are numbered, without discussions."""
    measured = [row for row in rows if row.measured]
    return Summary(
        chapters=len({row.chapter for row in rows}),
        rows=len(rows),
        ordered=sum(row.order is not None for row in rows),
        missed=sum(bool(row.missed) for row in rows),
        measured=tuple(replace(row, place=place, discussion="") for place, row in enumerate(measured)),
    )


def write_summary(summary: Summary, path: Path) -> None:
    """The summary as JSON."""
    path.write_text(json.dumps(asdict(summary), indent=1) + "\n", encoding="utf-8")


def read_summary(path: Path) -> Summary:
    """The summary of `write_summary`."""
    plain = json.loads(path.read_text(encoding="utf-8"))
    return Summary(**{**plain, "measured": tuple(map(row_of, plain["measured"]))})
