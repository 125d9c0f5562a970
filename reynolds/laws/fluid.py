"""Laws of the oil in pressure: viscosity and density, each with its slope for Newton's method."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

ViscosityLaw = Callable[[Array, Array], tuple[Array, Array]]
"""(pressure Pa, viscosity Pa s at the reference pressure) -> viscosity Pa s and its slope by pressure, Pa s/Pa."""

DensityLaw = Callable[[Array], tuple[Array, Array]]
"""Pressure Pa -> density over that at the reference pressure, and its slope, 1/Pa."""


def isoviscous(pressure: Array, viscosity: Array) -> tuple[Array, Array]:
    """A viscosity independent of pressure."""
    return viscosity, np.zeros((1, 1))


def incompressible(pressure: Array) -> tuple[Array, Array]:
    """A density independent of pressure: ratio one."""
    return _constant(pressure.shape)


@lru_cache(maxsize=64)
def _constant(shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Ones and zeros, made once a shape; not to be written to."""
    ratio, slope = np.ones(shape), np.zeros(shape)
    ratio.flags.writeable = slope.flags.writeable = False
    return ratio, slope


@dataclass(frozen=True)
class Fluid:
    """Laws of the oil in pressure; flows of a film are volumes at the reference density (ratio one).

    viscosity: (pressure Pa, viscosity Pa s of the film without pressure) -> (viscosity Pa s, its slope by pressure,
    Pa s/Pa). density: pressure Pa -> (density over that without pressure, its slope, 1/Pa). All are arrays.
    Newton's method needs the slopes: a solver tries those of one's own laws once, by a difference.
    """

    viscosity: ViscosityLaw = isoviscous
    density: DensityLaw = incompressible


CONSTANT = Fluid()
CHANGE = 1e-5  # of a law's value: over half the difference at which its slope is tried
SLOPE_ERROR = 0.01  # of the largest slope
ROUND_OFF = 1e-12  # of the value: a change that counts as none


def check_laws(fluid: Fluid, viscosity: Array, shape: tuple[int, int]) -> None:
    """Raise FilmInputError for a law of one's own without a value and its slope by pressure, in any units.

    viscosity: of the film; shape: of the pressures (cells, points). Laws of this package are right.
    """
    for name, law in (("viscosity", fluid.viscosity), ("density", fluid.density)):
        if not getattr(law, "__module__", "").startswith("reynolds."):
            with np.errstate(all="ignore"):
                _check_slope(name, law, (viscosity,) if name == "viscosity" else (), shape)


def _check_slope(name: str, law: Callable[..., object], more: tuple[Array, ...], shape: tuple[int, int]) -> None:
    """Try a law just above zero pressure, where it may have a kink."""
    value, slope = _law_at(name, law, (np.zeros(shape), *more))
    size, steepest = float(np.max(np.abs(value))), float(np.max(np.abs(slope)))
    step = CHANGE * size / steepest if steepest > 0.0 else 1.0
    (below, _), (_, slope), (above, _) = (_law_at(name, law, (np.full(shape, k * step), *more)) for k in (2, 3, 4))
    found = (above - below) / (2.0 * step)
    if not np.max(np.abs(slope - found)) <= SLOPE_ERROR * np.max(np.abs(found)) + ROUND_OFF * size / step:
        raise FilmInputError(
            f"fluid, {name}",
            f"slopes up to {np.max(np.abs(slope)):.4g} at {3.0 * step:.4g} Pa, by differences of the law's values "
            f"up to {np.max(np.abs(found)):.4g}",
            "the derivative of the value by pressure",
        )


def _law_at(name: str, law: Callable[..., object], given: tuple[Array, ...]) -> tuple[Array, Array]:
    found = law(*given)
    if not (isinstance(found, (tuple, list)) and len(found) == 2):
        arguments = "pressure, viscosity without pressure" if name == "viscosity" else "pressure"
        expected = f"law({arguments}) -> ({name}, its slope by pressure), as `Fluid` describes it"
        raise FilmInputError(f"fluid, {name}", f"a law that returns a {type(found).__name__}", expected)
    value, slope = (np.asarray(one, dtype=float) for one in found)
    return value, slope
