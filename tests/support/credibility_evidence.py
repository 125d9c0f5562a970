"""Findings of tests and proofs for the page on credibility."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from measured import Verdict
from validation_rows import Row, Summary, read_summary

Judged = TypeVar("Judged")


@dataclass(frozen=True)
class Gate:
    """A gate of the proof: what is asked, what was found, whether it is held."""

    name: str
    asked: str
    found: str
    held: bool


@dataclass(frozen=True)
class Evidence:
    """The last run of the tests, the gates of the proof, and film physics named: reached and goal."""

    summary: Summary
    gates: tuple[Gate, ...]
    named: tuple[str, str]

    def of(self, *parts: str) -> tuple[Row, ...]:
        """Rows against a measured number of these parts."""
        return tuple(row for row, reference in self.summary.numbers if reference.part in parts)

    def within(self, rows: Sequence[Row] | None = None) -> tuple[Row, ...]:
        """Rows within k u_val, of all or of these."""
        chosen = [row for row, _ in self.summary.numbers] if rows is None else rows
        return tuple(
            row
            for row, reference in self.summary.numbers
            if row in chosen and reference.verdict(row.error) is Verdict.NOISE
        )

    def all_within(self, what: str, rows: Sequence[Row], criterion: Callable[[str, str, bool], Judged]) -> Judged:
        """The criterion that all of these rows lie within k u_val."""
        right, largest = len(self.within(rows)), max((abs(row.error / row.expected) for row in rows), default=0.0)
        found = f"{right} of {len(rows)}; largest error {largest:.0%} of the measured"
        return criterion(f"all {what} within k u_val", found, right == len(rows) > 0)

    def trends(self) -> tuple[int, int]:
        """Measured trends that are met, and all."""
        return sum(not row.missed for row, _ in self.summary.trends), len(self.summary.trends)

    def met_trends(self) -> str:
        """The same in words."""
        right, trends = self.trends()
        return f"{right} of {trends}"

    def held(self) -> int:
        """Gates of the proof that are held."""
        return sum(gate.held for gate in self.gates)

    def coverage(self) -> str:
        """Share of 90 % intervals of parameters that contain the truth."""
        (gate,) = (gate for gate in self.gates if gate.name.startswith("90 % intervals"))
        return gate.found.split(":")[0]

    def named_met(self) -> bool:
        """Whether film physics is named as often as the goal asks."""
        right, cases = map(int, re.findall(r"\d+", self.named[0]))
        return right >= float(self.named[1].rstrip("%")) / 100.0 * cases


def read_evidence(docs: Path) -> Evidence:
    """From measured.json, proof.md and proof_floating.md of the folder."""
    named = next(
        cells for cells in _cells((docs / "proof_floating.md").read_text("utf-8")) if cells[0].startswith("named")
    )
    return Evidence(
        read_summary(docs / "measured.json"), gates((docs / "proof.md").read_text("utf-8")), (named[1], named[2])
    )


def gates(proof: str) -> tuple[Gate, ...]:
    """Gates of the page of the proof, which its own table tells."""
    section = proof.split("\n## Gates\n", 1)[1].split("\n## ", 1)[0]
    rows = [cells for cells in _cells(section) if len(cells) == 4 and cells[3].strip("*") in ("held", "missed")]
    return tuple(Gate(*cells[:3], cells[3] == "held") for cells in rows)


def _cells(text: str) -> list[list[str]]:
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if line.startswith("| ")]
