"""Operating points of the plant, and the state of the oil there."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from .machine import Array

RPM = 2.0 * 3.141592653589793 / 60.0
RATED_SPEED = 2100.0 * RPM
WARM = 323.15  # K, reference of temperatures


@dataclass(frozen=True)
class Settings:
    """N operating points, arrays (N,): rad/s, share of the full stroke, Pa absolute, K."""

    speed: Array
    ratio: Array
    p_out: Array
    p_in: Array
    p_case: Array
    T_in: Array
    T_case: Array

    def moved(self, name: str, change: float) -> Settings:
        """The same with one of them changed at every point."""
        return replace(self, **{name: getattr(self, name) + change})

    def of(self, points: NDArray[np.int64]) -> Settings:
        """Some of the points, by their numbers."""
        return Settings(**{one.name: getattr(self, one.name)[points] for one in fields(self)})
