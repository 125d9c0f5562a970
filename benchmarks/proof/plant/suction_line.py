"""The inlet line: the pressure at the port behind its loss, at the actual inflow."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize.elementwise import find_root

from .chamber_kernels import VAPOUR
from .machine import Array
from .settings import Settings

RATED_FLOW = 188.7e-3 / 60.0  # m3/s
CLOSE = 2.0  # Pa


def port_pressure(loss: float, at: Settings, drawn: Callable[[NDArray[np.int64], Array], Array]) -> Array:
    """Pa absolute (N,) at the inlet port: p + loss (Q(p)/Q rated)^2 = p_in, Q the flow that the chambers draw.

    `drawn(points, pressure)` is that flow, m3/s, of some points by their numbers, at pressures of their ports: it grows
    with pressure, little where chambers fill, much where they do not. The line's loss depends on the actual inflow, not
    on the swept volume, so that filling fails gradually.
    """

    def excess(pressure: Array, points: NDArray[np.int64]) -> Array:
        share = drawn(points, pressure) / RATED_FLOW
        return pressure + loss * share**2 - at.p_in[points]

    bracket = np.full(at.p_in.size, VAPOUR), at.p_in
    found = find_root(excess, bracket, args=(np.arange(at.p_in.size),), tolerances={"xatol": CLOSE})
    if not found.success.all():
        raise RuntimeError(f"the inlet line does not settle at points {np.flatnonzero(~found.success)}")
    return np.asarray(found.x)
