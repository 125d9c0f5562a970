"""Pareto set of the designs that were tried, its knee, and its growth over the generations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.variation.optimisation.problem import Design, Problem

ROOM = 1.1
"""Reference point of the hypervolume, of the distance from the best to the worst of each objective."""
LATE = 0.25
"""Last part of the generations, in which a converged set no longer grows."""


@dataclass(frozen=True)
class ParetoSet:
    """Places (n,) among the designs that no other feasible design dominates, by the first objective; and the growth.

    growth: hypervolume (g,) after each generation, of that of the last; zero before the first feasible design.
    """

    members: tuple[int, ...]
    growth: Array

    @property
    def late_growth(self) -> float:
        """Share of the hypervolume that the last quarter of the generations has added; 0 for fewer than four."""
        late = int(LATE * len(self.growth))
        return float(self.growth[-1] - self.growth[-1 - late]) if late else 0.0


def pareto_set(problem: Problem, designs: Sequence[Design]) -> ParetoSet:
    """Return the Pareto set of designs; without a feasible one it is empty."""
    feasible = np.flatnonzero(problem.feasible(designs))
    generations = np.array([one.generation for one in designs])
    last = int(generations.max(initial=0))
    if not feasible.size:
        return ParetoSet((), np.zeros(last))
    aims = problem.aims(designs)
    members = feasible[_best(aims[feasible])]
    first = feasible[generations[feasible] == generations[feasible].min()]
    reference = np.concatenate([aims[members], aims[first]])
    best, span = reference.min(axis=0), np.ptp(reference, axis=0)
    scaled = (aims - best) / np.where(span > 0.0, span, 1.0)
    growth = [_volume(scaled[feasible[generations[feasible] <= one]]) for one in range(1, last + 1)]
    return ParetoSet(tuple(int(at) for at in members[np.argsort(aims[members, 0], kind="stable")]),
                     np.array(growth) / (growth[-1] or 1.0))  # fmt: skip


def knee(problem: Problem, designs: Sequence[Design], members: Sequence[int]) -> int:
    """Return the member nearest to the ideal point, each objective scaled by its range over the set."""
    aims = problem.aims([designs[at] for at in members])
    span = np.ptp(aims, axis=0)
    scaled = (aims - aims.min(axis=0)) / np.where(span > 0.0, span, 1.0)
    return members[int(np.argmin(np.linalg.norm(scaled, axis=1)))]


def _best(aims: Array) -> Array:
    """Return the places of rows (N, m) that no other row dominates; of equal rows the first."""
    from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting

    _, first = np.unique(aims, axis=0, return_index=True)
    front = NonDominatedSorting().do(aims[first], only_non_dominated_front=True)
    return np.sort(first[np.asarray(front, dtype=int)])


def _volume(scaled: Array) -> float:
    """Return the hypervolume of rows (N, m) up to ROOM; zero without rows."""
    from pymoo.indicators.hv import HV

    inside = scaled[np.all(scaled < ROOM, axis=1)]
    return float(HV(ref_point=np.full(scaled.shape[1], ROOM))(inside)) if inside.size else 0.0
