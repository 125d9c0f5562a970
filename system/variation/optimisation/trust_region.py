"""Search by a quadratic model in a region of trust, for one objective of costly designs: COBYQA of scipy.

COBYQA (Ragonneau and Zhang 2023) needs only values: 2k + 1 designs about the start make the first model of objective
and constraints, each further design improves it. It tolerates jumps of slopes, as of a least film, and noise of solvers
that are smaller than its region. The optimum is a local one, that of the valley of the start.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize

from reynolds.numerics.arrays import Array
from system.variation.optimisation.ending import Ending, ending
from system.variation.optimisation.method import Method
from system.variation.optimisation.problem import MET, Design, Problem
from system.variation.optimisation.trials import Trials

FIRST = 0.2
"""Radius of the first region, of the bounds' distance."""
REFUSED = 1.0
"""Objective of a design without a result beside the start, and violation of its constraints, both relative."""


def approach(trials: Trials, designs: int, last: float) -> Ending:
    """Try at most so many designs from the start, moved into the bounds, until the region is as small as `last`.

    last: radius of the region, of the bounds' distance: the wider, the larger the noise of a fidelity.
    """
    problem = trials.problem
    start = np.clip(problem.start, 0.0, 1.0)
    (first,) = trials.tried(start[None])
    origin = float(problem.aims([first])[0, 0]) if first.solved else 0.0
    moved = bool(np.any(np.minimum(start, 1.0 - start) < FIRST))  # COBYQA begins on or away from a bound so near

    def numbers(place: Array) -> Array:
        (design,) = trials.tried(np.clip(place, 0.0, 1.0)[None])
        return _numbers(problem, design, origin)

    constraints = [{"type": "ineq", "fun": lambda place: numbers(place)[1:]}] if problem.constraints else []
    found = minimize(
        lambda place: float(numbers(place)[0]), start, method="COBYQA", constraints=constraints,
        bounds=[(0.0, 1.0)] * len(problem.space),
        options={"maxfev": designs - moved, "initial_tr_radius": FIRST, "final_tr_radius": last},
    )  # fmt: skip
    return ending(found, Method.TRUST_REGION)


def fewest_designs(dimensions: int) -> int:
    """Return the least number of designs of a search over so many dimensions: the first model and a step."""
    return 2 * dimensions + 2


def _numbers(problem: Problem, design: Design, origin: float) -> Array:
    """Return the objective's change by the start and the margin of each constraint (1 + c,), all relative."""
    if not design.solved:
        return np.array([REFUSED, *(-REFUSED for _ in problem.constraints)])
    aim = (float(problem.aims([design])[0, 0]) - origin) / (abs(origin) or 1.0)
    return np.array([aim, *(-0.5 * MET - problem.violations([design])[0])])
