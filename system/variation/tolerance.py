"""Tolerances of a drawing as the scatter of a series of pumps: solved, counted, shared out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.description.drawn import Drawing
from system.variation.admitted import commonest
from system.variation.measures import Measure, measured
from system.variation.sampling import Series, drawn_series
from system.variation.scatter import FEWEST, Interval, Limit, Scatter, scatter, share_of
from system.variation.shares import Share, Surface, pumps_needed, shares
from system.variation.solving import VariedWork, numbers_in, solved_variants
from system.work.kept_results import KeptPoints
from system.work.progress import Report
from system.work.tasks import Executor, PartOutcome, PartStatus


@dataclass(frozen=True)
class LimitFound:
    """A limit, the share of pumps that miss it over all operating points, and of those that miss it at one or more."""

    limit: Limit
    missing: Interval
    anywhere: Interval


@dataclass(frozen=True)
class Tolerance:
    """Scatter of a series of pumps.

    pumps: drawn; series: those with a result, values and `numbers` (N, P, NUMBERS) of each; refused, failed: what
    keeps the others from one, as `commonest` has it; scatters, shares: of each measure over all operating points;
    at_sites: of each measure at each point, (P, M).
    """

    measures: tuple[Measure, ...]
    pumps: int
    series: Series
    numbers: Array
    of_measures: Array
    refused: dict[str, int]
    failed: dict[str, int]
    scatters: tuple[Scatter, ...]
    at_sites: tuple[tuple[Scatter, ...], ...]
    surface: Surface
    shares: tuple[tuple[Share, ...], ...]
    limits: tuple[LimitFound, ...]
    seconds: float
    internal: bool

    def place(self, name: str) -> int:
        """Return the place of a measure."""
        return next(at for at, one in enumerate(self.measures) if one.name == name)


def tolerance(
    work: VariedWork,
    drawing: Drawing,
    count: int,
    seed: int,
    measures: tuple[Measure, ...],
    limits: Sequence[Limit],
    folder: Path,
    executor: Executor,
    report: Report,
    earlier: KeptPoints | None = None,
) -> Tolerance:
    """Return the scatter of `count` pumps drawn from a drawing.

    Pumps that the geometry refuses are counted, not altered; they have no part in the scatter
    (`system.variation.admitted` knows before whether they are too many). Raises InputError where too few are left.
    """
    drawn = drawn_series(drawing, count, seed)
    outcomes = solved_variants(work, list(drawn.variants(work.pump)), folder, executor, report, earlier)
    series, numbers = _solved(drawn, outcomes)
    of_all = measured(numbers, work.sites.weights, measures)
    at_each = [measured(numbers[:, [k]], np.ones(1), measures) for k in range(len(work.sites.points))]
    surface, by_measure = shares(series, of_all, seed)
    return Tolerance(
        measures=measures,
        pumps=count,
        series=series,
        numbers=numbers,
        of_measures=of_all,
        refused=_reasons(outcomes, (PartStatus.FAULTY,)),
        failed=_reasons(outcomes, (PartStatus.NOT_CONVERGED, PartStatus.WORKER_DIED, PartStatus.INTERNAL)),
        scatters=_scatters(of_all),
        at_sites=tuple(map(_scatters, at_each)),
        surface=surface,
        shares=tuple(tuple(own) for own in by_measure),
        limits=tuple(_limit(one, measures, of_all, at_each) for one in limits),
        seconds=sum(one.seconds for one in outcomes),
        internal=any(one.status is PartStatus.INTERNAL for one in outcomes),
    )


def _solved(drawn: Series, outcomes: Sequence[PartOutcome]) -> tuple[Series, Array]:
    """Return the pumps with a result and their numbers; raise InputError where they are too few."""
    solved = np.array([one.status is PartStatus.SOLVED for one in outcomes])
    _hold_enough(outcomes, max(FEWEST, pumps_needed(len(drawn.drawing.names))), int(solved.sum()))
    numbers = [numbers_in(one) for one in outcomes if one.status is PartStatus.SOLVED]
    return Series(drawn.drawing, drawn.values[solved]), np.array(numbers)


def _scatters(numbers: Array) -> tuple[Scatter, ...]:
    return tuple(scatter(column) for column in numbers.T)


def _hold_enough(outcomes: Sequence[PartOutcome], needed: int, solved: int) -> None:
    """Raise InputError with the first reason where too few pumps have a result; RuntimeError for the program's own."""
    if solved < needed:
        for one in outcomes:
            if one.status is PartStatus.INTERNAL:
                raise RuntimeError(one.reason)
        reason = next(one.reason for one in outcomes if one.status is not PartStatus.SOLVED)
        raise InputError(
            "series", f"{solved} of {len(outcomes)} pumps with a result; the first without: {reason}",
            f"{needed} at least: more pumps, or tolerances that the geometry admits",
        )  # fmt: skip


def _limit(limit: Limit, measures: tuple[Measure, ...], of_all: Array, at_each: Sequence[Array]) -> LimitFound:
    at = measures.index(limit.measure)
    missed = np.logical_or.reduce([limit.missed(one[:, at]) for one in at_each])
    return LimitFound(limit, share_of(limit.missed(of_all[:, at])), share_of(missed))


def _reasons(outcomes: Sequence[PartOutcome], kinds: tuple[PartStatus, ...]) -> dict[str, int]:
    return commonest(one.reason for one in outcomes if one.status in kinds)
