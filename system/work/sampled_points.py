"""Points from which a response is learnt: solved once each, kept by content, in parallel processes on request."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from gaps.response import Axis, Samples, fewest_learnt, held_out_points, learnt_points
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import cache_folder
from system.work.kept_results import POINTS, KeptPoints, run_kept
from system.work.processes import HERE
from system.work.progress import Report, silent
from system.work.tasks import Executor, PartOutcome, PartStatus

FEWEST_HELD_OUT = 2
OUTPUTS = "outputs"
"""Of a point's record: the numbers that `SamplingTask.solve` gave."""


class SamplingTask(Protocol):
    """A response to condense over a box of inputs; frozen data that can be sent to another process."""

    @property
    def axes(self) -> tuple[Axis, ...]:
        """The inputs."""

    @property
    def learnt(self) -> int:
        """Number of points to learn from."""

    @property
    def held_out(self) -> int:
        """Number of points that measure the error."""

    def key(self, x: Array) -> str:
        """Name of the content of a place (d,) in the box."""

    def solve(self, x: Array) -> Array:
        """The outputs (m,) there; raises NotConverged, FilmNotConverged, InputError or InputFaults."""


@dataclass(frozen=True)
class SampledPoint:
    """Result of a point: its number, its outputs or the reason for their absence, seconds of computing."""

    index: int
    outputs: Array | None
    reason: str
    seconds: float


def points_of(asked: SamplingTask) -> Array:
    """All points (n, d), the learnt ones first."""
    learnt = learnt_points(asked.axes, asked.learnt)
    return np.concatenate([learnt, held_out_points(asked.axes, asked.learnt, asked.held_out)])


def usual_counts(inputs: int) -> tuple[int, int]:
    """Default numbers of learnt and held-out points: 8 and 2 for one input, 120 and 30 for four.

    They grow as the square of the number of inputs, as the second derivatives of a smooth function do, plus twice
    the corners of the box.
    """
    learnt = max(2 ** (inputs + 1), round(7.5 * inputs**2))
    return learnt, max(FEWEST_HELD_OUT, learnt // 4)


def tables_folder(folder: Path | None = None) -> Path:
    """Folder of the tables, with their points in `points`."""
    return cache_folder(folder) / "tables"


@dataclass(frozen=True)
class TableWork:
    """The points of a box as work in parts."""

    asked: SamplingTask

    def key(self, x: Array) -> str:
        """Name of the content of a place (d,)."""
        return self.asked.key(x)

    def solve(self, x: Array) -> dict[str, list[float]]:
        """The outputs there; raises as `SamplingTask.solve`."""
        return {OUTPUTS: self.asked.solve(x).tolist()}


def solved_points(
    asked: SamplingTask, *, executor: Executor = HERE, report: Report = silent, folder: Path | None = None
) -> tuple[SampledPoint, ...]:
    """Every point of `points_of`, in its order; points that are kept already are not solved again.

    After an interruption the next call continues. A point that does not converge, or lies outside the range of a law or
    case, has its reason and is tried again the next time.
    """
    store = KeptPoints(tables_folder(folder) / POINTS, frozenset({PartStatus.SOLVED}))
    kept = run_kept(TableWork(asked), list(points_of(asked)), store, executor, described=_described, report=report)
    return tuple(_solved(index, outcome) for index, outcome in enumerate(kept.outcomes))


def _described(x: Array, outcome: PartOutcome) -> str:
    return "point failed" if outcome.reason else "point solved"


def _solved(index: int, outcome: PartOutcome) -> SampledPoint:
    """A point by its outcome; raises RuntimeError for an error of the program's own, which no table may hide."""
    if outcome.status is PartStatus.INTERNAL:
        raise RuntimeError(outcome.reason)
    outputs = np.array(outcome.record[OUTPUTS]) if outcome.status is PartStatus.SOLVED else None
    return SampledPoint(index, outputs, outcome.reason, outcome.seconds)


def samples_of(asked: SamplingTask, found: Sequence[SampledPoint]) -> tuple[Samples, Samples]:
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
