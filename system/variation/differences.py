"""Derivative of a pump's numbers by one dimension: differences over falling steps, extrapolated, with their error."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.keys import PumpKey
from system.inputs.faults import InputFaults
from system.inputs.units import Dimension, parse_quantity

FALLS = (1.0, 0.25, 0.0625)
"""Parts of the usual step that are tried, until the geometry admits one."""
SMOOTH = 0.05
"""Largest error of a derivative, of itself, that counts as converged."""
NOT_ZERO = {Dimension.LENGTH: 1e-6, Dimension.ANGLE: np.radians(0.02)}
"""Step in SI of a dimension that is zero."""
WIDEST = {Dimension.ANGLE: np.radians(0.2)}
"""Largest step in SI: within it no port opens or closes."""


class Side(Enum):
    """Side of the stated value on which pumps exist."""

    BOTH = "both sides"
    ABOVE = "above only"
    BELOW = "below only"


class Verdict(Enum):
    """Verdict of differences on a derivative: a number, none beyond the solver's noise, or not converged."""

    SMOOTH = "smooth"
    NO_EFFECT = "no effect"
    NOT_SMOOTH = "not smooth here"


@dataclass(frozen=True)
class Stencil:
    """Values of one dimension at which the pump is solved: a step (SI, above 0) and the side."""

    key: PumpKey
    side: Side
    step: float

    @property
    def values(self) -> tuple[float, ...]:
        """Values (SI): in the order of the numbers for `derivative`."""
        at, h = self.key.value, self.step
        if self.side is Side.BOTH:
            return at + h, at - h, at + 0.5 * h, at - 0.5 * h
        sign = 1.0 if self.side is Side.ABOVE else -1.0
        return at + sign * h, at + 0.5 * sign * h, at + 0.25 * sign * h

    def derivative(self, middle: Array, found: Array) -> tuple[Array, Array]:
        """Return derivative and error (..) of numbers (..) at the value itself, found (n, ..) at `values`.

        Richardson's extrapolation (1911): from two central differences, of the fourth order; on one side from three
        differences, of the third. The error is the distance to the best number without the last extrapolation.
        """
        h = self.step
        if self.side is Side.BOTH:
            coarse, fine = (found[0] - found[1]) / (2.0 * h), (found[2] - found[3]) / h
            value = (4.0 * fine - coarse) / 3.0
            return value, np.abs(value - fine)
        sign = 1.0 if self.side is Side.ABOVE else -1.0
        first, second, third = (sign * (found[k] - middle) * 2**k / h for k in range(3))
        coarse, fine = 2.0 * second - first, 2.0 * third - second
        value = (4.0 * fine - coarse) / 3.0
        return value, np.abs(value - fine)


def usual_step(key: PumpKey, share: float) -> float:
    """Return the step (SI) of a dimension: a share of its value, bounded for angles."""
    least = NOT_ZERO.get(key.dimension) if key.dimension else None
    step = share * abs(key.value) or (share * one_of(key) if least is None else least)
    step = max(step, NOT_ZERO[Dimension.ANGLE]) if key.dimension is Dimension.ANGLE else step
    return float(min(step, WIDEST.get(key.dimension, np.inf) if key.dimension else np.inf))


def one_of(key: PumpKey) -> float:
    """Return the size (SI) of a dimension: its value, of one that is zero the example of its kind."""
    if key.value != 0.0 or key.dimension is None:
        return abs(key.value) or 1.0
    return parse_quantity(key.dimension.example, key.dimension)


def stencils(key: PumpKey, step: float, made: Callable[[float], object]) -> Iterator[Stencil]:
    """Yield the stencils that the geometry admits, the best first: both sides at a small step before one at any.

    made: makes the pump of a value, raises InputFaults where no pump has it.
    """
    admitted = {(part, sign): _admits(made, key.value + sign * part * step) for part in FALLS for sign in (1, -1)}
    yield from (Stencil(key, Side.BOTH, part * step) for part in FALLS if admitted[part, 1] and admitted[part, -1])
    for side, sign in ((Side.ABOVE, 1), (Side.BELOW, -1)):
        yield from (Stencil(key, side, part * step) for part in FALLS if admitted[part, sign])


def _admits(made: Callable[[float], object], value: float) -> bool:
    try:
        made(value)
    except InputFaults:
        return False
    return True


def verdicts(stencil: Stencil, middle: Array, value: Array, error: Array, noise: float) -> np.ndarray:
    """Return the Verdict (..) of derivatives with their errors; noise: of the solver, of the number itself."""
    quiet = noise * np.abs(middle) / stencil.step
    found = np.full(np.shape(value), Verdict.NOT_SMOOTH, dtype=object)
    found[error <= np.maximum(SMOOTH * np.abs(value), quiet)] = Verdict.SMOOTH
    found[(np.abs(value) <= quiet) & (error <= quiet)] = Verdict.NO_EFFECT
    return found
