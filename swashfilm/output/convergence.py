"""How a number converges over meshes: order observed, extrapolated value and error bar (Roache 1994)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

RATIO = 2.0  # of the cell sizes of two meshes that follow each other
SAFETY = 1.25  # of the error estimate, where the observed order is near the expected one
DOUBTFUL_SAFETY = 3.0  # where it is assumed, oscillating or far from it
LEAST_ORDER = 0.4  # below it steps shrink by less than a quarter: there is no limit to be told from them
ORDER_MARGIN = 0.5  # how far from the expected orders an observed one may be and still be trusted
ROUNDING = 1e-9  # of the number's size: smaller steps are the solver's, not the mesh's


class Verdict(Enum):
    """What the steps between meshes say."""

    CONVERGED = "converged to round-off"
    CONVERGING = "converges as expected"
    DOUBTFUL = "converges, but not at the expected order"
    OSCILLATING = "oscillates, ever less"
    ASSUMED = "two meshes: order assumed"
    NONE = "no order observed"


@dataclass(frozen=True)
class Convergence:
    """A number on meshes each twice finer than the one before, and what it tends to.

    order: observed on the three finest meshes, None where it cannot be; extrapolated: the limit; error: bar of the
    limit, 1.25 or 3 times the error estimate of the finest mesh. Both None where no order is observed.
    """

    values: tuple[float, ...]
    order: float | None
    extrapolated: float | None
    error: float | None
    verdict: Verdict


def convergence(values: Sequence[float], expected: tuple[float, float], size: float) -> Convergence:
    """What the values on two or more meshes tell, coarsest first.

    `expected` is the range of orders that theory leaves open, `size` the size of such a number, in its unit,
    against which round-off counts. The limit is Richardson's, from the observed order but never from a higher one
    than expected; where steps change their sign it is the finest value itself. Source: Roache 1994 (safety 1.25
    and 3 of the grid convergence index).
    """
    listed = tuple(float(value) for value in values)
    steps = np.diff(listed)
    last = float(steps[-1])
    rounding = ROUNDING * size
    if np.all(np.abs(steps[-2:]) <= rounding):
        return Convergence(listed, None, listed[-1], rounding, Verdict.CONVERGED)
    if len(steps) == 1:
        rise = last / (RATIO ** expected[0] - 1.0)
        return Convergence(listed, None, listed[-1] + rise, DOUBTFUL_SAFETY * abs(rise), Verdict.ASSUMED)
    before = float(steps[-2])
    if abs(last) > abs(before) / RATIO**LEAST_ORDER:
        return Convergence(listed, None, None, None, Verdict.NONE)
    order = float(np.log2(abs(before / last))) if last else None
    if last * before <= 0.0:
        # A step may vanish by chance between two that do not: the one before bounds it.
        step = max(abs(last), abs(before) / RATIO ** expected[1])
        error = DOUBTFUL_SAFETY * step / (RATIO ** expected[0] - 1.0)
        return Convergence(listed, order, listed[-1], error, Verdict.OSCILLATING)
    assert order is not None
    rise = last / (RATIO ** min(order, expected[1]) - 1.0)
    trusted = expected[0] - ORDER_MARGIN <= order <= expected[1] + ORDER_MARGIN
    safety, verdict = (SAFETY, Verdict.CONVERGING) if trusted else (DOUBTFUL_SAFETY, Verdict.DOUBTFUL)
    return Convergence(listed, order, listed[-1] + rise, safety * abs(rise), verdict)
