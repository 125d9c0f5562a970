"""Walls on springs side by side: they open in proportion to the pressure at their own place alone.

The wall whose flow a closed law of an opening gives: bodies spread what presses on them, springs do not.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array

from gaps.walls.pair import BoreWalls, PlateWalls
from gaps.walls.parts import Stand
from gaps.walls.piston import ByChamber
from reynolds.bodies.foundation import Compliance, winkler
from reynolds.fem.space import FilmSpace


@dataclass(frozen=True)
class SpringBore(BoreWalls):
    """A bore on springs, `compliance` in m/Pa above zero; the parts' sizes as they are, the piston rigid."""

    compliance: float = field(kw_only=True)

    def at(self, film: FilmSpace, stand: Stand) -> Compliance:
        """Opening p times `compliance`, wherever the parts stand (Winkler 1867)."""
        return winkler(film, 1.0 / self.compliance)

    def piston_at(self, film: FilmSpace, stand: Stand) -> Compliance:
        """None: the piston is rigid."""
        return Compliance(csr_array((len(film.vertices), film.size)))

    def by_chamber(self, film: FilmSpace, stand: Stand) -> ByChamber:
        """Nothing: what the film leaves bare opens no other place."""
        none = np.zeros(len(film.vertices))
        return ByChamber(none, none, 0.0)


@dataclass(frozen=True)
class SpringPlates(PlateWalls):
    """A plate on springs, `compliance` in m/Pa above zero; the parts' sizes as they are."""

    compliance: float = field(kw_only=True)

    def at(self, film: FilmSpace, stand: Stand) -> Compliance:
        """Opening p times `compliance`, wherever the parts stand (Winkler 1867)."""
        return winkler(film, 1.0 / self.compliance)
