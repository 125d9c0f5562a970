"""Walls on springs side by side: they deform in proportion to the pressure at their own place alone.

The wall of closed laws for the flow of a deformed gap: bodies distribute a load, springs do not.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array

from gaps.walls.pair import BoreWalls, PlateWalls
from gaps.walls.parts import Pose
from gaps.walls.piston import ChamberInfluence
from reynolds.bodies.foundation import Compliance, winkler
from reynolds.fem.space import FilmSpace


@dataclass(frozen=True)
class SpringBore(BoreWalls):
    """A bore on springs, `compliance` in m/Pa above zero; the parts' sizes unchanged, the piston rigid."""

    compliance: float = field(kw_only=True)

    def at(self, film: FilmSpace, pose: Pose) -> Compliance:
        """Deformation p times `compliance`, in any pose (Winkler 1867)."""
        return winkler(film, 1.0 / self.compliance)

    def piston_at(self, film: FilmSpace, pose: Pose) -> Compliance:
        """Zero: the piston is rigid."""
        return Compliance(csr_array((len(film.vertices), film.size)))

    def by_chamber(self, film: FilmSpace, pose: Pose) -> ChamberInfluence:
        """Zero: faces outside the film deform no other place."""
        none = np.zeros(len(film.vertices))
        return ChamberInfluence(none, none, 0.0)


@dataclass(frozen=True)
class SpringPlates(PlateWalls):
    """A plate on springs, `compliance` in m/Pa above zero; the parts' sizes unchanged."""

    compliance: float = field(kw_only=True)

    def at(self, film: FilmSpace, pose: Pose) -> Compliance:
        """Deformation p times `compliance`, in any pose (Winkler 1867)."""
        return winkler(film, 1.0 / self.compliance)
