"""Constraints that keep designs from being feasible, and the amounts by which designs miss them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.variation.optimisation.problem import MET, Constraint, Design, Problem


@dataclass(frozen=True)
class Obstacle:
    """A constraint over all designs with a result.

    met: number of designs that meet it; best: the value nearest to it, or with the largest margin; nearest: the value
    at the design that misses all constraints together by the least, violation there of the constraint's scale.
    """

    constraint: Constraint
    met: int
    best: float
    nearest: float
    violation: float


@dataclass(frozen=True)
class Obstacles:
    """All constraints, the worst first; at: the design that misses them by the least; solved: designs with a result."""

    rows: tuple[Obstacle, ...]
    at: int
    solved: int


def obstacles(problem: Problem, designs: Sequence[Design]) -> Obstacles | None:
    """Return the obstacles of feasible designs; None where no design has a result."""
    solved = [at for at, one in enumerate(designs) if one.solved]
    if not solved:
        return None
    own = [designs[at] for at in solved]
    violations = problem.violations(own)
    near = int(np.argmin(np.sum(np.maximum(violations, 0.0), axis=1)))
    rows = [_obstacle(problem, own, one, violations[:, at], near) for at, one in enumerate(problem.constraints)]
    return Obstacles(tuple(sorted(rows, key=lambda row: -row.violation)), solved[near], len(solved))


def _obstacle(problem: Problem, own: Sequence[Design], one: Constraint, violation: Array, near: int) -> Obstacle:
    values = problem.column(own, one.measure)
    best = float(values[np.argmin(violation)])
    return Obstacle(one, int(np.sum(violation <= MET)), best, float(values[near]), float(violation[near]))
