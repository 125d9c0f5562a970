"""The bearing every benchmark of the film solves, for any Python: it imports nothing outside the library.

Finite journal bearing, L/D 1, clearance, radius, viscosity and surface speed one. Full film (no cavitation):

    div(h^3/12 grad p) = 1/2 dh/dx,    h = 1 + eccentricity cos x

with x round the bearing from the largest film and y from the midplane (closed) to the side. The pressure is
zero at the largest film and at the side. It is odd about the least film; its positive half carries the load.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable

ECCENTRICITY = 0.6
ROUND = 2.0 * math.pi
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def one_thread() -> None:
    """Run the script anew with one thread a process, unless it has: numerical libraries read that as they load."""
    if any(os.environ.get(name) != "1" for name in THREADS):
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | dict.fromkeys(THREADS, "1"))


def rows(cells: int) -> int:
    """Cells over the half-width for so many round the bearing: about as long as wide."""
    return round(cells / ROUND)


def least(action: Callable[[], object], repeats: int, clock: Callable[[], float] = time.perf_counter) -> float:
    """Smallest time of the repeats, s: wall time unless another clock is given."""
    times = []
    for _ in range(repeats):
        begin = clock()
        action()
        times.append(clock() - begin)
    return min(times)
