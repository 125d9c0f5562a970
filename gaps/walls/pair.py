"""Elastic walls of a gap, for any mesh of its film and any pose of its parts."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Protocol

import numpy as np

from gaps.walls.parts import (
    BushingPart,
    PistonPart,
    PlatePart,
    Pose,
    SlipperPart,
    bushing_body,
    closer_at_end,
    closer_at_start,
    part_wall,
    piston_body,
    plate_body,
    slipper_body,
)
from gaps.walls.piston import ChamberInfluence, PistonWalls, face_grid
from reynolds.bodies.compliance import ElasticWalls, full
from reynolds.bodies.foundation import Compliance, both
from reynolds.fem.space import FilmSpace

KEPT = 2.5e8  # bytes of walls that are kept as parts turn
ROWS = 36  # along a part's face, as many as its body's quadratic cells have nodes


class GapWalls(Protocol):
    """Both walls of a gap."""

    @property
    def alike_around(self) -> bool:
        """True where rotated parts are the same."""

    def at(self, film: FilmSpace, pose: Pose) -> ElasticWalls:
        """The walls of a film on that mesh, for a pose of the parts."""


@dataclass(frozen=True)
class PlateWalls:
    """Both parts of a film across an axis, the moving one first.

    Parts made from sizes are symmetric about the axis; a part by a mesh of the user's need not be.
    """

    parts: tuple[SlipperPart | PlatePart, SlipperPart | PlatePart]
    _built: list[tuple[FilmSpace, Pose, ElasticWalls]] = field(
        init=False, default_factory=list, compare=False, repr=False
    )

    @property
    def alike_around(self) -> bool:
        """True where rotated parts are the same."""
        return all(part.own is None for part in self.parts)

    def at(self, film: FilmSpace, pose: Pose) -> ElasticWalls:
        """The walls, meshed on first use; the last ones are kept."""
        if self.alike_around:
            pose = Pose()
        for known, at, walls in self._built:
            if at == pose and np.array_equal(known.dofs, film.dofs) and np.array_equal(known.vertices, film.vertices):
                return walls
        bodies = (slipper_body(part) if isinstance(part, SlipperPart) else plate_body(part) for part in self.parts)
        turned = zip(bodies, (pose.moving, pose.fixed), strict=True)
        one, two = (part_wall(body, in_part_axes(film, angle)) for body, angle in turned)
        found = both(one, two)
        self._built.append((film, pose, found))
        del self._built[: -max(2, int(KEPT / (8.0 * np.prod(found.matrix.shape))))]
        return found


def in_part_axes(film: FilmSpace, angle: float) -> FilmSpace:
    """A film in the axes of a part turned by an angle (rad) about the film's axis."""
    if angle == 0.0:
        return film
    c, s = np.cos(angle), np.sin(angle)
    return film.moved(np.ascontiguousarray(film.vertices @ np.array([[c, -s], [s, c]])))


def while_turning(walls_at: Callable[[float], ElasticWalls], angle: float, column: float) -> ElasticWalls:
    """Walls that change as parts turn: between those at multiples of a column (rad), by their shares.

    Force and work stay the same on both sides; the deformation errs by the square of a column.
    """
    before, share = divmod(angle / column, 1.0)
    one, two = (full(walls_at((before + k) * column).matrix) for k in (0, 1))
    return Compliance((1.0 - share) * one + share * two)


@dataclass(frozen=True)
class BoreWalls:
    """Piston and bushing by their sizes, the guide as long as the bushing; meshed on first use."""

    piston: PistonPart
    bushing: BushingPart

    @property
    def alike_around(self) -> bool:
        """True where rotated parts are the same."""
        return self.piston.own is None and self.bushing.own is None

    def at(self, film: FilmSpace, pose: Pose) -> ElasticWalls:
        """See `PistonWalls.at`."""
        return self._walls(film).at(film, pose)

    def piston_at(self, film: FilmSpace, pose: Pose) -> ElasticWalls:
        """See `PistonWalls.piston_at`."""
        return self._walls(film).piston_at(film, pose)

    def by_chamber(self, film: FilmSpace, pose: Pose) -> ChamberInfluence:
        """See `PistonWalls.by_chamber`."""
        return self._walls(film).by_chamber(film, pose)

    def _walls(self, film: FilmSpace) -> PistonWalls:
        return _bore_walls(self.piston, self.bushing, len(np.unique(film.vertices[:, 0])) - 1)


@lru_cache(maxsize=4)
def _bore_walls(piston: PistonPart, bushing: BushingPart, around: int) -> PistonWalls:
    """The faces of both parts, with the film's cells around."""
    radius, shares = 0.5 * piston.diameter, np.linspace(0.0, 1.0, ROWS + 1)
    return PistonWalls(
        bushing.length,
        face_grid(bushing_body(bushing), radius, bushing.length * closer_at_end(shares), around),
        face_grid(piston_body(piston), radius, piston.length * closer_at_start(shares), around),
    )
