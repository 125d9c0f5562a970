"""How the walls of a floating gap give way: as its film asks for it, wherever the parts stand."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Protocol

import numpy as np

from gaps.bodies import (
    BushingPart,
    PistonPart,
    PlatePart,
    SlipperPart,
    bushing_body,
    part_wall,
    piston_body,
    plate_body,
    slipper_body,
)
from gaps.piston_walls import PistonWalls, face_grid
from gaps.stand import Stand
from reynolds.bodies.foundation import both
from reynolds.bodies.wall import Body
from reynolds.mesh import Array
from reynolds.space import FilmSpace
from reynolds.walls import Walls


class GapWalls(Protocol):
    """Both walls of a gap."""

    def at(self, film: FilmSpace, stand: Stand) -> Walls:
        """Those of a film on that mesh, its parts standing so."""

    def by_chamber(self, film: FilmSpace, stand: Stand) -> Array:
        """Opening (vertices,) m by unit pressure (Pa) in the chamber beside the film."""


@dataclass(frozen=True)
class PlateWalls:
    """Both parts of a plane film, which lie under it in the same way at any time."""

    parts: tuple[SlipperPart | PlatePart, SlipperPart | PlatePart]
    _built: list[tuple[object, Walls]] = field(default_factory=list, compare=False, repr=False)

    def at(self, film: FilmSpace, stand: Stand) -> Walls:
        """The walls, meshed when a film first asks; a film's mesh that has moved is the same mesh."""
        if not self._built or self._built[0][0] is not film.pattern:
            one, two = (part_wall(_plane_body(part), film) for part in self.parts)
            self._built[:] = [(film.pattern, both(one, two))]
        return self._built[0][1]

    def by_chamber(self, film: FilmSpace, stand: Stand) -> Array:
        """Nothing: the chamber presses on these walls through the film and its pockets alone."""
        return np.zeros(len(film.vertices))


def _plane_body(part: SlipperPart | PlatePart) -> Body:
    return slipper_body(part) if isinstance(part, SlipperPart) else plate_body(part)


@dataclass(frozen=True)
class BoreWalls:
    """Piston and bushing by their sizes, the guide as long as the bushing; meshed when a film first asks."""

    piston: PistonPart
    bushing: BushingPart

    def at(self, film: FilmSpace, stand: Stand) -> Walls:
        """See `PistonWalls.at`."""
        return self._walls(film).at(film, stand)

    def by_chamber(self, film: FilmSpace, stand: Stand) -> Array:
        """See `PistonWalls.by_chamber`."""
        return self._walls(film).by_chamber(film, stand)

    def _walls(self, film: FilmSpace) -> PistonWalls:
        return _bore_walls(self.piston, self.bushing, len(np.unique(film.vertices[:, 0])) - 1)


@lru_cache(maxsize=4)
def _bore_walls(piston: PistonPart, bushing: BushingPart, around: int) -> PistonWalls:
    """The faces of both parts, as many cells around as the film has."""
    radius, cells = 0.5 * piston.diameter, (around, 24)
    return PistonWalls(
        bushing.length,
        face_grid(bushing_body(bushing), radius, bushing.length, cells),
        face_grid(piston_body(piston), radius, piston.length, cells),
    )
