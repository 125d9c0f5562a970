"""Quasi-static position of a floating part: film forces and moments equal the outer ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from reynolds.errors import FilmNotConverged
from reynolds.mesh import Array

TOLERANCE = 1e-6
MAX_STEPS = 50
FAR = 20.0
"""Unknowns beyond this lie at the edge of what is possible: within 0.13 % of the wall in `into_disc`."""
START_WITHIN = 0.99
"""Part of the disc that a search may start from: beyond it the wall, where no step leads anywhere, is too near."""


@dataclass(frozen=True)
class Equilibrium:
    """A position at which the film balances the outer load, or the nearest miss.

    `unknowns` are free parameters of the part's position; `rest` is the largest relative force or moment that
    remains; `found` is true where it is below 1e-6; `evaluations` counts film solves; `cut_short` tells that a
    start still gained when it came to MAX_STEPS, so that a balance may have been missed.
    """

    unknowns: Array
    rest: float
    found: bool
    evaluations: int
    cut_short: bool

    @property
    def miss(self) -> str:
        """The rest in words, in per cent of the load, and whether the search was cut short."""
        percent = 100.0 * self.rest
        limit = f", a search cut short after {MAX_STEPS} steps" if self.cut_short else ""
        if percent > 100.0:
            return f"nothing near it was found{limit}"
        return f"nearest miss {percent:{'.1f' if percent >= 0.1 else '.1g'}} % of the load{limit}"


class _AtTheWall(Exception):
    """The search left what is possible: the film is as thin as it may be, and still does not balance."""


class _Search:
    """The imbalance as the search sees it; remembers the best position met."""

    def __init__(self, imbalance: Callable[[Array], Array]) -> None:
        self._imbalance = imbalance
        self.evaluations = 0
        self.rest = np.inf
        self.unknowns: Array = np.empty(0)

    def __call__(self, unknowns: Array) -> Array:
        if np.max(np.abs(unknowns)) > FAR:
            raise _AtTheWall
        self.evaluations += 1
        found = self._imbalance(unknowns)
        rest = float(np.max(np.abs(found)))
        if rest < self.rest:
            self.rest, self.unknowns = rest, unknowns.copy()
        return found


def find_equilibrium(imbalance: Callable[[Array], Array], starts: Iterable[Array]) -> Equilibrium:
    """Solve imbalance(u) = 0 (relative forces and moments) from the given starts; the best answer.

    Levenberg-Marquardt (More 1978) on unknowns that any real number is a valid position of. Near an equilibrium
    its steps shrink the imbalance manifold; where they gain less than 1e-5, or lead to the wall, there is none to
    be reached. Stops at the first start that gets to 1e-6. A start at which the film itself does not converge
    counts as a miss; raises FilmNotConverged if all do.
    """
    search, cut_short = _Search(imbalance), False
    for start in starts:
        try:
            fit = least_squares(search, start, method="lm", max_nfev=MAX_STEPS, ftol=1e-5, xtol=1e-9)
            cut_short |= fit.status == 0
        except (FilmNotConverged, _AtTheWall):
            continue
        if search.rest < TOLERANCE:
            break
    if not search.unknowns.size:
        raise FilmNotConverged("no start of the force balance gave a film", "a given position instead of a load")
    return Equilibrium(search.unknowns, search.rest, search.rest < TOLERANCE, search.evaluations, cut_short)


def into_disc(free: Array) -> Array:
    """Map the plane onto the open unit disc, smoothly: u -> u / sqrt(1 + |u|^2)."""
    return free / np.sqrt(1.0 + free @ free)


def out_of_disc(inside: Array) -> Array:
    """Inverse of `into_disc`."""
    return inside / np.sqrt(1.0 - inside @ inside)


def start_towards(wanted: Array) -> Array:
    """Free start of a search for a place in the plane of the disc; one at the wall or beyond it is drawn in."""
    return out_of_disc(wanted * min(1.0, START_WITHIN / max(float(np.linalg.norm(wanted)), START_WITHIN)))
