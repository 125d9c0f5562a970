"""Search by derivatives, for one smooth objective: sequential quadratic programming (SLSQP, Kraft 1988) of scipy.

The derivatives are differences; the designs of one gradient are solved side by side. The optimum is a local one, that
of the valley of the start.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize

from reynolds.numerics.arrays import Array
from system.variation.optimisation.ending import Ending, ending
from system.variation.optimisation.method import Method
from system.variation.optimisation.problem import MET, Design, Problem
from system.variation.optimisation.trials import Trials

SETTLED = 1e-5
"""Change of the objective at which the search ends, of its change across the bounds by the slope of the start."""
REFUSED = 10.0
"""Objective of a design without a result, in the same measure: a line search moves back from it."""


def descend(trials: Trials, step: float, iterations: int) -> Ending:
    """Try designs along the gradient from the start, moved into the bounds, until the objective settles.

    step: of the differences, of the bounds' distance: the wider, the larger the noise of a fidelity.
    """
    values = _Values(trials, step)
    constraints = (
        [{"type": "ineq", "fun": values.room, "jac": values.room_slopes}] if trials.problem.constraints else []
    )
    found = minimize(
        values.aim, np.clip(trials.problem.start, 0.0, 1.0), jac=values.aim_slopes, method="SLSQP",
        bounds=[(0.0, 1.0)] * len(trials.problem.space), constraints=constraints,
        options={"maxiter": iterations, "ftol": SETTLED},
    )  # fmt: skip
    return ending(found, Method.GRADIENT)


class _Values:
    """Objective and margin of constraints with their slopes, each design solved with those of its gradient."""

    def __init__(self, trials: Trials, step: float) -> None:
        self.trials, self.step = trials, step
        self.origin, self.scale = 0.0, 1.0
        first, *around = self._tried(np.clip(trials.problem.start, 0.0, 1.0))
        if first.solved:
            self.origin = self._aim(first)
            # A refused neighbour has no slope that could be a measure.
            slopes = [(self._aim(one) - self.origin) / step for one in around if one.solved]
            self.scale = float(np.linalg.norm(slopes)) or 1.0

    def aim(self, place: Array) -> float:
        return float(self._at(place)[0])

    def aim_slopes(self, place: Array) -> Array:
        return self._slopes(place)[0]

    def room(self, place: Array) -> Array:
        return self._at(place)[1:]

    def room_slopes(self, place: Array) -> Array:
        return self._slopes(place)[1:]

    def _slopes(self, place: Array) -> Array:
        """Return the slopes (1 + c, k); beside a design without a result those over the whole of the bounds.

        Over a step such a slope would be a wall beside which the search sees no other.
        """
        place = np.clip(place, 0.0, 1.0)
        middle, *around = self._tried(place)
        here = self._numbers(middle)
        ways = [
            step if one.solved and middle.solved else np.sign(step)
            for one, step in zip(around, self._steps(place), strict=True)
        ]
        return np.stack([(self._numbers(one) - here) / way for one, way in zip(around, ways, strict=True)], axis=-1)

    def _steps(self, place: Array) -> Array:
        """Return the steps (k,): forward, backward where the bound is nearer."""
        return np.where(place + self.step <= 1.0, self.step, -self.step)

    def _at(self, place: Array) -> Array:
        """Return objective and rooms (1 + c,) at a place, whose gradient is solved with it."""
        return self._numbers(self._tried(np.clip(place, 0.0, 1.0))[0])

    def _tried(self, place: Array) -> list[Design]:
        """Return the designs at a place of the unit cube and at one step along each dimension."""
        return self.trials.tried(np.vstack([place, place + np.diag(self._steps(place))]))

    def _aim(self, design: Design) -> float:
        """Return the objective of a design with a result, SI."""
        return float(self.trials.problem.aims([design])[0, 0])

    def _numbers(self, design: Design) -> Array:
        problem = self.trials.problem
        if not design.solved:
            return np.array([REFUSED, *(-REFUSED for _ in problem.constraints)])
        aim = (self._aim(design) - self.origin) / self.scale
        return np.array([aim, *(-0.5 * MET - problem.violations([design])[0])])


def gradient_designs(problem: Problem, iterations: int) -> int:
    """Return the number of designs, about, that a search of so many iterations tries."""
    return iterations * (1 + len(problem.space))
