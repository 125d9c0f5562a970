"""Search by derivatives, for one smooth objective: sequential quadratic programming (SLSQP, Kraft 1988) of scipy.

The derivatives are differences; the designs of one gradient are solved side by side. The optimum is a local one, that
of the valley of the start.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize

from reynolds.numerics.arrays import Array
from system.variation.optimisation.problem import MET, Design, Problem
from system.variation.optimisation.trials import Trials

SETTLED = 1e-5
"""Change of the objective at which the search ends, of its change across the bounds by the slope of the start."""
REFUSED = 10.0
"""Objective of a design without a result, in the same measure: a line search moves back from it."""


def descend(trials: Trials, step: float, iterations: int) -> None:
    """Try designs along the gradient from the start, moved into the bounds, until the objective settles.

    step: of the differences, of the bounds' distance: the wider, the larger the noise of a fidelity.
    """
    values = _Values(trials, step)
    constraints = (
        [{"type": "ineq", "fun": values.room, "jac": values.room_slopes}] if trials.problem.constraints else []
    )
    minimize(
        values.aim, np.clip(trials.problem.start, 0.0, 1.0), jac=values.aim_slopes, method="SLSQP",
        bounds=[(0.0, 1.0)] * len(trials.problem.space), constraints=constraints,
        options={"maxiter": iterations, "ftol": SETTLED},
    )  # fmt: skip


class _Values:
    """Objective and margin of constraints with their slopes, each design solved with those of its gradient."""

    def __init__(self, trials: Trials, step: float) -> None:
        self.trials, self.step = trials, step
        self.origin, self.scale = 0.0, 1.0
        start = np.clip(trials.problem.start, 0.0, 1.0)
        middle, self.scale = float(self.aim(start)), float(np.linalg.norm(self._slopes(start)[0])) or 1.0
        self.origin = middle

    def aim(self, place: Array) -> float:
        return float(self._at(place)[0][0])

    def aim_slopes(self, place: Array) -> Array:
        return self._slopes(place)[0]

    def room(self, place: Array) -> Array:
        return self._at(place)[0][1:]

    def room_slopes(self, place: Array) -> Array:
        return self._slopes(place)[1:]

    def _slopes(self, place: Array) -> Array:
        """Return the slopes (1 + c, k)."""
        (middle, *_), steps = self._at(place), self._steps(place)
        around = self._at(place)[1:]
        return np.stack([(one - middle) / step for one, step in zip(around, steps, strict=True)], axis=-1)

    def _steps(self, place: Array) -> Array:
        """Return the steps (k,): forward, backward where the bound is nearer."""
        return np.where(place + self.step <= 1.0, self.step, -self.step)

    def _at(self, place: Array) -> list[Array]:
        """Return objective and margins (1 + c,) at a place and at one step along each dimension."""
        place = np.clip(place, 0.0, 1.0)
        places = np.vstack([place, place + np.diag(self._steps(place))])
        return [self._numbers(one) for one in self.trials.tried(places)]

    def _numbers(self, design: Design) -> Array:
        problem = self.trials.problem
        if not design.solved:
            return np.array([REFUSED, *(-REFUSED for _ in problem.constraints)])
        aim = (float(problem.aims([design])[0, 0]) - self.origin) / self.scale
        return np.array([aim, *(-0.5 * MET - problem.violations([design])[0])])


def gradient_designs(problem: Problem, iterations: int) -> int:
    """Return the number of designs, about, that a search of so many iterations tries."""
    return iterations * (1 + len(problem.space))
