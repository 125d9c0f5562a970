"""A recording of the second or third plant, with the truth behind it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..outcome import Outcome
from ..rig import Rig
from .case import Secret, WideCase


@dataclass(frozen=True)
class WideMade:
    """expected: the outcome before a verdict; write: puts the recording into a folder; pump: a built-in pump, or the
    file in that folder; rig: for further points, or None.
    """

    expected: Outcome
    write: Callable[[Path], None]
    pump: str
    rig: Rig | None = None


def expected(
    case: WideCase, factors: Sequence[float], scores: Sequence[float], strength: Mapping[str, float]
) -> Outcome:
    """The truth of a case; the score is the least of those that a right verdict names.

    strength: channel -> square of its shift in sigma.
    """
    total = sum(strength.values()) or 1.0
    reached = dict(zip(case.secrets, scores, strict=True))
    named: tuple[Secret, ...] = case.main or case.secrets
    return Outcome(
        name=case.name, part=case.part.value, campaign=case.campaign, seed=case.seed, asked=case.score,
        score=min((reached[one] for one in named), default=0.0),
        sizes={one.label: factor * one.size for one, factor in zip(case.secrets, factors, strict=True)},
        truth=case.truth, effects=tuple(one.id for one in case.main), pairs=tuple(one.pair for one in case.main),
        beside=case.beside, shares={name: one / total for name, one in strength.items()},
    )  # fmt: skip
