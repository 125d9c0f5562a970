"""One step towards the peak of a quadratic model between bounds, along curves on which readings are linear.

Leakage grows with the cube of a film: along xi = ln(1 + b d)/b, b = 3 spreads, it is linear in d. Two films whose
leakages replace each other lie in a valley that is straight in d and curved in xi.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.parameters import Parameter

LEAST_LEFT = 0.1
"""Least share of value^power that one step leaves."""


@dataclass(frozen=True)
class Bounds:
    """Least and largest xi, (k,) each; curved: (k,), true where a long step leaves the slopes' validity.

    bend: (k,), power times spread on log scales, else 0: readings are linear in (exp(bend xi) - 1)/bend.
    """

    lowest: Array
    highest: Array
    curved: NDArray[np.bool_]
    bend: Array

    @classmethod
    def of(cls, parameters: tuple[Parameter, ...]) -> Bounds:
        """Those of some parameters."""
        lowest = np.array([parameter.lowest for parameter in parameters])
        highest = np.array([parameter.highest for parameter in parameters])
        curved = np.array([not parameter.linear for parameter in parameters], dtype=bool)
        return cls(lowest, highest, curved, np.array([parameter.bend for parameter in parameters]))

    def within(self, xi: Array) -> Array:
        """The nearest xi between the bounds."""
        return np.clip(xi, self.lowest, self.highest)

    def reached(self, xi: Array, step: Array) -> Array:
        """The xi at the end of a step d (k,) along the curves: xi + ln(1 + b d)/b, and xi + d where b = 0."""
        other = xi + step
        has_bend = self.bend != 0.0
        grown = np.maximum(1.0 + self.bend[has_bend] * step[has_bend], LEAST_LEFT)
        other[has_bend] = xi[has_bend] + np.log(grown) / self.bend[has_bend]
        return other

    def step_to(self, xi: Array, other: Array) -> Array:
        """The step d (k,) along the curves from xi to another: the inverse of `reached`."""
        step = other - xi
        has_bend = self.bend != 0.0
        step[has_bend] = np.expm1(self.bend[has_bend] * step[has_bend]) / self.bend[has_bend]
        return step

    def about(self, xi: Array) -> Bounds:
        """The bounds of xi + d for steps d along the curves from xi."""
        lowest, highest = xi + self.step_to(xi, self.lowest), xi + self.step_to(xi, self.highest)
        return Bounds(lowest, highest, self.curved, self.bend)


@dataclass(frozen=True)
class Quadratic:
    """The objective about xi by its slopes: J(xi + d) = J - 2 gradient.d + d.precision.d."""

    xi: Array
    gradient: Array
    precision: Array

    @classmethod
    def of(cls, xi: Array, residual: Array, slopes: Array) -> Quadratic:
        """Of J = r.r + xi.xi with dr/dxi = -slopes."""
        return cls(xi, slopes.T @ residual - xi, slopes.T @ slopes + np.eye(xi.size))

    def fall(self, step: Array) -> float:
        """Decrease of the model's objective along a step."""
        return float(2.0 * self.gradient @ step - step @ self.precision @ step)


def bounded_step(model: Quadratic, bounds: Bounds, damping: float, largest: float) -> Array:
    """The damped Newton step of the model: its minimum between bounds, with no curved component longer than `largest`.

    (precision + damping diag(precision)) d = gradient within the bounds; a component on a bound whose gradient
    points outwards is zero. A step that is too long is shortened as a whole.
    """
    below, above = bounds.lowest - model.xi, bounds.highest - model.xi
    damped = model.precision + damping * np.diag(np.diag(model.precision))
    step, held = _held(model.gradient, damped, below, above)
    left = np.where(held, model.gradient - damped @ step, 0.0)
    if np.any(np.where(step < above, left, 0.0) > 0.0) or np.any(np.where(step > below, left, 0.0) < 0.0):
        step = _least_between(model.gradient, damped, below, above)
    length = float(np.abs(step[bounds.curved]).max(initial=0.0))
    return step if length <= largest else step * (largest / length)


def _held(gradient: Array, damped: Array, below: Array, above: Array) -> tuple[Array, NDArray[np.bool_]]:
    """The step with all components that would pass a bound held on it and the rest solved again, and the mask of
    the held ones. In most cases it is the minimum.
    """
    step = np.zeros_like(gradient)
    free = np.ones(step.size, dtype=bool)
    while free.any():
        push = gradient[free] - damped[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.solve(damped[np.ix_(free, free)], push)
        over = free & ((step > above) | (step < below))
        if not over.any():
            break
        step[over] = np.clip(step[over], below[over], above[over])
        free &= ~over
    return step, ~free


def _least_between(gradient: Array, damped: Array, below: Array, above: Array) -> Array:
    """The least of d.damped.d - 2 gradient.d between bounds, by bounded-variable least squares."""
    from scipy.optimize import lsq_linear

    lower = np.linalg.cholesky(damped)
    right = solve_triangular(lower, gradient, lower=True)
    found = lsq_linear(lower.T, right, (below, above), method="bvls", tol=1e-12, max_iter=100 * gradient.size)
    if not found.success:
        raise NotConverged(f"a step of {gradient.size} parameters between their bounds: {found.message}")
    return np.asarray(found.x)
