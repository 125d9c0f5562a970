"""Points that a response is learnt from: solved once each, kept by content, side by side where asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from gaps.response import Axis, Samples, fewest_learnt, held_out_points, learnt_points
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import cache_folder
from system.inputs.errors import NotConverged
from system.work.kept_results import POINTS, KeptPoints, run_kept
from system.work.processes import HERE
from system.work.progress import Report, silent
from system.work.tasks import Hands, Outcome, Status

FEWEST_HELD_OUT = 2
OUTPUTS = "outputs"
"""Of a point's record: the numbers that `Asked.solve` gave."""


class Asked(Protocol):
    """What is condensed over a box of inputs; frozen data that can be sent to another process."""

    @property
    def axes(self) -> tuple[Axis, ...]:
        """The inputs."""
        ...

    @property
    def learnt(self) -> int:
        """How many points to learn from."""
        ...

    @property
    def held_out(self) -> int:
        """How many points to take the error from."""
        ...

    def key(self, x: Array) -> str:
        """Name of the content that a place (d,) in the box has."""
        ...

    def solve(self, x: Array) -> Array:
        """The outputs (m,) there; raises NotConverged, FilmNotConverged, FilmInputError or InputFaults."""
        ...


@dataclass(frozen=True)
class Solved:
    """What a point gave: where it stands among all, its outputs or why there are none, seconds it took."""

    index: int
    outputs: Array | None
    reason: str
    seconds: float


def points_of(asked: Asked) -> Array:
    """All points (n, d), the learnt ones first."""
    learnt = learnt_points(asked.axes, asked.learnt)
    return np.concatenate([learnt, held_out_points(asked.axes, asked.learnt, asked.held_out)])


def usual_counts(inputs: int) -> tuple[int, int]:
    """How many points to learn from and to hold out where nobody says: 8 and 2 of one input, 120 and 30 of four.

    As the square of the number of inputs, which a smooth function of so many needs for its second derivatives,
    and twice the corners of the box.
    """
    learnt = max(2 ** (inputs + 1), round(7.5 * inputs**2))
    return learnt, max(FEWEST_HELD_OUT, learnt // 4)


def tables_folder(folder: Path | None = None) -> Path:
    """Where tables are kept, their points beside them in `points`."""
    return cache_folder(folder) / "tables"


@dataclass(frozen=True)
class TableWork:
    """The points of a box as work in parts."""

    asked: Asked

    def key(self, x: Array) -> str:
        """Name of the content of a place (d,)."""
        return self.asked.key(x)

    def solve(self, x: Array) -> dict[str, list[float]]:
        """The outputs there; raises as `Asked.solve`."""
        return {OUTPUTS: self.asked.solve(x).tolist()}


def solved_points(
    asked: Asked, *, hands: Hands = HERE, report: Report = silent, folder: Path | None = None
) -> tuple[Solved, ...]:
    """Every point of `points_of`, in its order; those that are kept already are not solved again.

    Interrupted, it goes on where it was at the next call. A point that does not converge, or that no law or case
    reaches, says why and is tried again the next time.
    """
    store = KeptPoints(tables_folder(folder) / POINTS, frozenset({Status.SOLVED}))
    kept = run_kept(TableWork(asked), list(points_of(asked)), store, hands, told=_told, report=report)
    return tuple(_solved(index, outcome) for index, outcome in enumerate(kept.outcomes))


def _told(x: Array, outcome: Outcome) -> str:
    return "point failed" if outcome.reason else "point solved"


def _solved(index: int, outcome: Outcome) -> Solved:
    """A point by its outcome; raises RuntimeError for an error of the program's own, which no table may hide."""
    if outcome.status is Status.INTERNAL:
        raise RuntimeError(outcome.reason)
    outputs = np.array(outcome.record[OUTPUTS]) if outcome.status is Status.SOLVED else None
    return Solved(index, outputs, outcome.reason, outcome.seconds)


def samples_of(asked: Asked, found: Sequence[Solved]) -> tuple[Samples, Samples]:
    """Learnt and held-out points that have a result; raises NotConverged where these are too few."""
    points, reasons = points_of(asked), [solved.reason for solved in found if solved.reason]
    parts = found[: asked.learnt], found[asked.learnt :]
    good = [[one for one in part if one.outputs is not None] for part in parts]
    fewest = fewest_learnt(len(asked.axes))
    if len(good[0]) < fewest or len(good[1]) < FEWEST_HELD_OUT:
        raise NotConverged(
            f"response table: {len(reasons)} of {len(points)} points have no result, expected {fewest} to "
            f"learn from and {FEWEST_HELD_OUT} held out; the first: {reasons[0]}; try a smaller box"
        )
    learnt, held_out = (
        Samples(points[[one.index for one in part]], np.array([one.outputs for one in part])) for part in good
    )
    return learnt, held_out
