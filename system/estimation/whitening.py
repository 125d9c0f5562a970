"""Noise made white: readings, slopes and columns in units in which every residual has a sigma of one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from system.estimation.observations import Array


@dataclass(frozen=True)
class Whitening:
    """factors: (N, C, C), L^-1 of each point; measured: (N, C), the readings that count, n in all.

    Row j of a whitened array belongs to the reading `rows[j]` = (point, channel).
    """

    factors: Array
    measured: NDArray[np.bool_]
    memory: tuple[float, ...]

    @property
    def rows(self) -> NDArray[np.int64]:
        """(n, 2), point and channel of each whitened row."""
        return np.argwhere(self.measured)
