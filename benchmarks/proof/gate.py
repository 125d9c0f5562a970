"""One gate of the proof, and its computation from cases: a share, a median, a number."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from .calibration import wilson
from .outcome import Outcome

Outcomes = Sequence[Outcome]
T = TypeVar("T")


@dataclass(frozen=True)
class Gate:
    """One line: the requirement in words, the result, the number of its cases; None: no case yet."""

    name: str
    asked: str
    found: str
    cases: int
    passed: bool | None


def share(
    name: str, cases: Sequence[T], test: Callable[[T], bool], at_most: float = 1.0, at_least: float = 0.0
) -> Gate:
    """A share of cases, with Wilson's interval."""
    hits, count = sum(map(bool, map(test, cases))), len(cases)
    asked = f"<= {100.0 * at_most:g}%" if at_most < 1.0 else f">= {100.0 * at_least:g}%"
    if not count:
        return Gate(name, asked, "-", 0, None)
    low, high = wilson(hits, count)
    found = f"{hits / count:.1%} ({hits} of {count}; {low:.0%} to {high:.0%})"
    return Gate(name, asked, found, count, at_least <= hits / count <= at_most)


def wilson_end(name: str, cases: Outcomes, test: Callable[[Outcome], bool], limit: float) -> Gate:
    """The upper end of the interval of a share."""
    high = wilson(sum(map(test, cases)), len(cases))[1]
    return Gate(name, f"<= {limit:.1%}", f"{high:.1%}", len(cases), high <= limit if cases else None)


def median(
    name: str, cases: Outcomes, value: Callable[[Outcome], float], at_most: float = np.inf, at_least: float = -np.inf
) -> Gate:
    """The median of a value, of which a nan counts as missed."""
    asked = f"<= {at_most:g}" if np.isfinite(at_most) else f">= {at_least:g}"
    told = np.array([value(one) for one in cases])
    known = told[np.isfinite(told)]
    if not known.size:
        return Gate(name, asked, "-", len(cases), False if len(cases) else None)
    worst = np.inf if np.isfinite(at_most) else -np.inf
    middle = float(np.median(np.where(np.isfinite(told), told, worst)))
    missing = f"; {told.size - known.size} without, counted as missed" if known.size < told.size else ""
    found = f"{middle:.2f} median of {told.size}, {known.min():.2f} to {known.max():.2f}{missing}"
    return Gate(name, asked, found, told.size, at_least <= middle <= at_most)


def beside(gate: Gate, text: str) -> Gate:
    """The gate with a remark beside its result."""
    return replace(gate, found=f"{gate.found}; {text}") if gate.cases else gate


def number(name: str, cases: Outcomes, value: Callable[[Outcomes], float], limit: float) -> Gate:
    """One number of all cases."""
    if not cases:
        return Gate(name, f"<= {limit:g}", "-", 0, None)
    found = value(cases)
    return Gate(name, f"<= {limit:g}", f"{found:.3f}", len(cases), found <= limit)
