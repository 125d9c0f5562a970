"""Judgement on a statement of Xu, Hu, Zhang and Mao (2017): reached, missed, or contradicted by physics."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from math import inf, isfinite

from reynolds.errors import InputError
from system.paper.figure import Figure, Panel, Unit
from system.paper.points import LossReading

ROUND_OFF = 1e-6
"""Magnitude below which a number is shown as 0."""


class StatementVerdict(Enum):
    """Verdict on a statement; CONTRADICTED needs an impossibility that holds."""

    REACHED = "reached"
    MISSED = "missed"
    CONTRADICTED = "contradicted by physics"


@dataclass(frozen=True)
class Range:
    """From low to high, both within; -inf or inf: no end. Raises InputError if low is not below high."""

    low: float = -inf
    high: float = inf

    def __post_init__(self) -> None:
        if not self.low <= self.high:
            raise InputError("range", f"{self.low} to {self.high}", "a low end below the high one")

    def holds(self, other: Range) -> bool:
        """True if all of another range lies within."""
        return self.low <= other.low and other.high <= self.high

    def text(self, unit: Unit, digits: int = 4) -> str:
        """Both ends in the unit that they are shown in."""
        low, high = (_shown(unit.factor * end, digits) for end in (self.low, self.high))
        shown = "" if unit is Unit.NUMBER else f" {unit.shown}"
        if not isfinite(self.low):
            return f"at most {high}{shown}" if isfinite(self.high) else "any"
        if not isfinite(self.high):
            return f"at least {low}{shown}"
        return f"{low}{shown}" if low == high else f"{low} to {high}{shown}"


def _shown(value: float, digits: int) -> str:
    """Rounded to so many digits; round-off is shown as zero."""
    return "0" if abs(value) < ROUND_OFF else f"{value:.{digits}g}"


def range_of(values: Iterable[float]) -> Range:
    """The least range that holds some numbers."""
    listed = [float(value) for value in values]
    return Range(min(listed), max(listed))


@dataclass(frozen=True)
class PaperClaim:
    """A statement of the paper: its words, the quantity that judges it, and its expected range, SI.

    A number in print is met where it agrees in its last digit. `taken`: our interpretation of a word without a
    number ("small").
    """

    id: str
    figure: Figure
    words: str
    quantity: str
    unit: Unit
    expected: Range
    taken: str = ""


@dataclass(frozen=True)
class Impossibility:
    """Quantity whose bound is necessary for a statement: with the quantity outside no number here can meet it.

    It is computed each time; a quantity within the bound is no contradiction.
    """

    quantity: str
    unit: Unit
    value: float
    bound: Range

    @property
    def holds(self) -> bool:
        """True if the quantity lies outside its bound."""
        return not self.bound.holds(Range(self.value, self.value))

    @property
    def text(self) -> str:
        """In words."""
        alone = Range(self.value, self.value).text(self.unit)
        return f"{self.quantity}: {alone}; the statement needs {self.bound.text(self.unit)}"


@dataclass(frozen=True)
class Judged:
    """A claim with the range found, in one reading of the losses (None: independent of them)."""

    claim: PaperClaim
    reading: LossReading | None
    found: Range
    verdict: StatementVerdict
    reason: str
    impossible: Impossibility | None


@dataclass(frozen=True)
class FigureResult:
    """A reproduced figure: its pictures, its statements judged, and further remarks."""

    figure: Figure
    panels: tuple[Panel, ...] = ()
    judged: tuple[Judged, ...] = ()
    remarks: tuple[str, ...] = ()


def judge(
    claim: PaperClaim,
    found: Range,
    *,
    reading: LossReading | None = None,
    reason: str = "",
    impossible: Impossibility | None = None,
) -> Judged:
    """A claim with its verdict.

    REACHED where the whole range found lies within the expected one; else CONTRADICTED where an impossibility holds;
    else MISSED. An impossibility that no longer holds is omitted.
    """
    if claim.expected.holds(found):
        return Judged(claim, reading, found, StatementVerdict.REACHED, reason, None)
    if impossible is not None and impossible.holds:
        return Judged(claim, reading, found, StatementVerdict.CONTRADICTED, reason, impossible)
    return Judged(claim, reading, found, StatementVerdict.MISSED, reason, None)
