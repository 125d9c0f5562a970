"""Stages of equations whose rate is known, for the steps in time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reynolds import FilmNotConverged

Rate = Callable[[float, np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Stage:
    """y = before + step rate(t, y), and dy/dbefore."""

    q: np.ndarray
    slope: np.ndarray

    @property
    def holds(self) -> np.ndarray:
        """y."""
        return self.q

    def propagated(self, before: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return changes of y by changes of the state before."""
        return self.slope @ before, self.slope @ before


def stages(rate: Rate) -> Callable[..., Stage]:
    """Return stages of y' = rate(t, y)[0], by Newton's method with rate(t, y)[1] = d rate/dy."""

    def solve(time: float, before: np.ndarray, step: float, guess: np.ndarray, last: Stage | None) -> Stage:
        y = guess
        for _ in range(50):
            value, slope = rate(time, y)
            move = np.linalg.solve(np.eye(len(y)) - step * slope, before + step * value - y)
            y = y + move
            if np.abs(move).max() <= 1e-15 + 1e-13 * np.abs(y).max():
                return Stage(y, np.linalg.inv(np.eye(len(y)) - step * rate(time, y)[1]))
        raise FilmNotConverged("no root", "a smaller step")

    return solve
