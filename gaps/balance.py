"""Quasi-static position of a floating part: film forces and moments equal the outer ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from reynolds.errors import FilmNotConverged
from reynolds.mesh import Array

TOLERANCE = 1e-6
MAX_STEPS = 25


@dataclass(frozen=True)
class Equilibrium:
    """A position at which the film balances the outer load, or the nearest miss.

    `unknowns` are free parameters of the part's position; `rest` is the largest relative force or moment that
    remains; `found` is true where it is below 1e-6; `evaluations` counts film solves.
    """

    unknowns: Array
    rest: float
    found: bool
    evaluations: int


def find_equilibrium(imbalance: Callable[[Array], Array], starts: Iterable[Array]) -> Equilibrium:
    """Solve imbalance(u) = 0 (relative forces and moments) from the given starts; the best answer.

    Levenberg-Marquardt (More 1978) on unknowns that any real number is a valid position of. Near an equilibrium
    its steps shrink the imbalance manifold; where they gain less than 1e-5 there is none to be reached. Stops at
    the first start that gets to 1e-6. A start at which the film itself does not converge counts as a miss.
    """
    best: Equilibrium | None = None
    spent = 0
    for start in starts:
        try:
            fit = least_squares(imbalance, start, method="lm", max_nfev=MAX_STEPS, ftol=1e-5, xtol=1e-9)
        except FilmNotConverged:
            continue
        spent += fit.nfev
        rest = float(np.max(np.abs(fit.fun)))
        if best is None or rest < best.rest:
            best = Equilibrium(fit.x, rest, rest < TOLERANCE, spent)
        if best.found:
            break
    if best is None:
        raise FilmNotConverged(
            "no start of the force balance gave a film", "give the position instead of the load"
        )
    return best


def into_disc(free: Array) -> Array:
    """Map the plane onto the open unit disc, smoothly: u -> u / sqrt(1 + |u|^2)."""
    return free / np.sqrt(1.0 + free @ free)


def out_of_disc(inside: Array) -> Array:
    """Inverse of `into_disc`."""
    return inside / np.sqrt(1.0 - inside @ inside)
