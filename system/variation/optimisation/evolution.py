"""Evolutionary search: NSGA-II (Deb et al. 2002), from three objectives on NSGA-III (Deb and Jain 2014), of pymoo.

Both need only values, no derivatives, and rank infeasible designs by their violation. A fixed seed makes the same
designs in the same order, so that a search whose results are kept continues after an interruption.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.stats import qmc

from reynolds.numerics.arrays import Array
from system.variation.optimisation.problem import Design, Problem
from system.variation.optimisation.trials import Trials

if TYPE_CHECKING:
    from pymoo.core.algorithm import Algorithm

REFUSED = 1e3
"""Violation of a design without a result, beyond that of any other; it grows with the distance from the start."""
MANY = 3
"""Objectives from which crowding no longer spreads a set and NSGA-III takes over."""


def evolve(trials: Trials, designs: int, generations: int, seed: int) -> None:
    """Try so many generations of so many designs; the first is that of `first_places`."""
    from pymoo.core.evaluator import Evaluator
    from pymoo.core.problem import Problem as SearchProblem
    from pymoo.problems.static import StaticProblem

    problem = trials.problem
    aims, constraints = len(problem.objectives), len(problem.constraints) + 1
    asked = SearchProblem(n_var=len(problem.space), n_obj=aims, n_ieq_constr=constraints, xl=0.0, xu=1.0)
    algorithm = _algorithm(aims, first_places(problem, designs, seed))
    algorithm.setup(asked, termination=("n_gen", generations), seed=seed)
    for _ in range(generations):
        population: Any = algorithm.ask()
        if population is None:  # every further design is known
            return
        found = trials.tried(population.get("X"))
        Evaluator().eval(StaticProblem(asked, F=_aims(problem, found), G=_violations(problem, found)), population)
        algorithm.tell(infills=population)


def first_places(problem: Problem, designs: int, seed: int) -> Array:
    """Return the first generation (N, k): a Latin hypercube, its first design the start where the bounds hold it."""
    places = np.asarray(qmc.LatinHypercube(len(problem.space), rng=seed).random(designs))
    if problem.holds_start:
        places[0] = problem.start
    return places


def _algorithm(aims: int, first: Array) -> Algorithm:
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.algorithms.moo.nsga3 import NSGA3
    from pymoo.util.ref_dirs import get_reference_directions

    if aims < MANY:
        return NSGA2(pop_size=len(first), sampling=first)
    parts = next(p for p in range(len(first), 0, -1) if comb(p + aims - 1, aims - 1) <= len(first) or p == 1)
    directions = get_reference_directions("das-dennis", aims, n_partitions=parts)
    return NSGA3(directions, pop_size=max(len(first), len(directions)), sampling=first)


def _aims(problem: Problem, found: Sequence[Design]) -> Array:
    """Return the objectives (N, m); zero for designs without a result, which their violation alone ranks."""
    return np.nan_to_num(problem.aims(found), nan=0.0)


def _violations(problem: Problem, found: Sequence[Design]) -> Array:
    """Return the violations (N, c + 1); the last is that of designs without a result."""
    centre = np.clip(problem.start, 0.0, 1.0)
    refused = [0.0 if one.solved else REFUSED * (1.0 + float(np.linalg.norm(one.place - centre))) for one in found]
    return np.column_stack([np.nan_to_num(problem.violations(found), nan=0.0), refused])
