"""Convergence of a number over meshes: observed order, extrapolated value and error bar (Roache 1994)."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

RATIO = 2.0  # cell size of a mesh over that of the next finer one
SAFETY = 1.25  # factor on the error estimate where the observed order is near the expected one
DOUBTFUL_SAFETY = 3.0  # factor where the order is assumed, oscillating or far from the expected one
LEAST_ORDER = 0.4  # below it steps shrink by less than a quarter: they determine no limit
ORDER_MARGIN = 0.5  # largest distance of a trusted observed order from the expected orders
ROUNDING = 1e-9  # relative to the number's size: smaller steps come from the solver, not from the mesh


class ConvergenceKind(Enum):
    """Kind of convergence, judged by the steps between meshes."""

    CONVERGED = "converged to round-off"
    CONVERGING = "converges as expected"
    DOUBTFUL = "converges, but not at the expected order"
    OSCILLATING = "oscillates with falling amplitude"
    ASSUMED = "two meshes: order assumed"
    NONE = "no order observed"


@dataclass(frozen=True)
class Convergence:
    """A number on meshes each twice finer than the one before, and its limit.

    order: observed on the three finest meshes, None where it is not defined; extrapolated: the limit; error: error bar
    of the limit, 1.25 or 3 times the error estimate of the finest mesh. Both are None where no order is observed.
    """

    values: tuple[float, ...]
    order: float | None
    extrapolated: float | None
    error: float | None
    verdict: ConvergenceKind


def convergence(values: Sequence[float], expected: tuple[float, float], size: float) -> Convergence:
    """Return the convergence of values on two or more meshes, coarsest first.

    `expected` is the range of orders that theory allows, `size` the size of such a number, in its unit, the scale
    of round-off. The limit is Richardson's, from the observed order but never from an order higher than expected;
    where steps change their sign the limit is the finest value. Source: Roache 1994 (safety factors 1.25 and 3 of
    the grid convergence index).
    """
    listed = tuple(float(value) for value in values)
    steps = np.diff(listed)
    last = float(steps[-1])
    rounding = ROUNDING * size
    if np.all(np.abs(steps[-2:]) <= rounding):
        return Convergence(listed, None, listed[-1], rounding, ConvergenceKind.CONVERGED)
    if len(steps) == 1:
        rise = last / (RATIO ** expected[0] - 1.0)
        return Convergence(listed, None, listed[-1] + rise, DOUBTFUL_SAFETY * abs(rise), ConvergenceKind.ASSUMED)
    before = float(steps[-2])
    if abs(last) > abs(before) / RATIO**LEAST_ORDER:
        return Convergence(listed, None, None, None, ConvergenceKind.NONE)
    order = float(np.log2(abs(before / last))) if last else None
    if last * before <= 0.0:
        # A single step may vanish by chance: the step before bounds the error.
        step = max(abs(last), abs(before) / RATIO ** expected[1])
        error = DOUBTFUL_SAFETY * step / (RATIO ** expected[0] - 1.0)
        return Convergence(listed, order, listed[-1], error, ConvergenceKind.OSCILLATING)
    assert order is not None
    rise = last / (RATIO ** min(order, expected[1]) - 1.0)
    trusted = expected[0] - ORDER_MARGIN <= order <= expected[1] + ORDER_MARGIN
    safety, verdict = (SAFETY, ConvergenceKind.CONVERGING) if trusted else (DOUBTFUL_SAFETY, ConvergenceKind.DOUBTFUL)
    return Convergence(listed, order, listed[-1] + rise, safety * abs(rise), verdict)
