"""Compliance of piston and bushing for the film between them, at any reach of the piston.

The film's mesh stretches as the piston moves; each part's compliance is built once, on a film over all of its
face, and coupled there to the film's rows along the bore: with hats psi of the face and phi of the film,

    M_psi P = G p,   M_phi w = G^T W,   G = int psi phi dy,

so that force and work are the same on both (`reynolds.bodies.transfer` in one dimension). Faces outside the film
are loaded too: bore and piston beyond it, and the piston's own chamber faces, by the chamber's pressure, whose
volume grows in turn.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gaps.walls.parts import Pose
from gaps.walls.piston_kernels import add_turned
from gaps.walls.user_mesh import CHAMBER
from reynolds.bodies.foundation import Compliance
from reynolds.bodies.wall import Body, FacePressure, body_wall, load_deformation
from reynolds.errors import FilmInputError
from reynolds.fem.mesh import Cell, rectangle
from reynolds.fem.space import FilmSpace, film_space
from reynolds.numerics.arrays import Array

ALIKE = 1e-9  # of the largest influence: round-off of a part that is the same all around
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(2)  # exact for the product of two hats


@dataclass(frozen=True, eq=False)
class FaceGrid:
    """A cylindrical part's whole face as rows along the bore and columns around it.

    rows (n,) m from the part's end; influence (n, period, columns, n) m/Pa: deformation at a row and column by
    pressure on a column and row; the part is the same every `period` columns, so that those of one are all.
    by_chamber (n, columns + 1) m/Pa, by the pressure on its chamber faces, the seam's column twice.
    """

    rows: Array
    influence: Array
    by_chamber: Array

    @property
    def columns(self) -> int:
        """Cells around."""
        return int(self.influence.shape[2])

    @property
    def period(self) -> int:
        """Columns after which the part is the same."""
        return int(self.influence.shape[1])

    @cached_property
    def by_row(self) -> Array:
        """Deformation at a row and column by pressure all along a row, (n, period, n) m/Pa."""
        return np.asarray(self.influence.sum(axis=2))

    @cached_property
    def mass(self) -> Array:
        """Integrals of the products of the rows' hats, (n, n) m."""
        return _products(self.rows, self.rows, self.rows[0], self.rows[-1])


def face_grid(body: Body, radius: float, rows: Array, around: int = 48, folder: Path | None = None) -> FaceGrid:
    """The face of a part of such radius (m) on rows (n,) m along it and cells around; kept as by `body_wall`."""
    cells = (around, len(rows) - 1)
    even = film_space(rectangle((2.0 * np.pi * radius, 1.0), cells, cell=Cell.QUADRILATERAL, periodic_x=True))
    vertices, unknowns = _numbers(even)
    places = even.vertices.copy()
    places[vertices, 1] = rows[:, None]
    space = even.moved(places)
    matrix = body_wall(body, space, folder=folder).matrix
    influence = matrix[np.ix_(vertices.ravel(), unknowns.T.ravel())].reshape(*vertices.shape, *unknowns.T.shape)
    opened = np.zeros(len(space.vertices))
    if CHAMBER in body.mesh.face_names:
        opened = load_deformation(body, space, FacePressure(CHAMBER, 1.0), folder=folder)
    return FaceGrid(space.vertices[vertices[:, 0], 1], _of_one_period(influence), opened[vertices])


def _of_one_period(influence: Array) -> Array:
    """One period of an influence (n, columns + 1, columns, n), which determines all of it."""
    columns, same = influence.shape[2], ALIKE * float(np.abs(influence).max())
    for period in (p for p in range(1, columns) if columns % p == 0):
        turned = np.roll(influence[:, :-period], period, axis=2)
        if np.abs(turned - influence[:, period:]).max() <= same:
            return np.ascontiguousarray(influence[:, :period])
    return np.ascontiguousarray(influence[:, :columns])


def _around(opened: Array, angle: float) -> Array:
    """Deformation by a part turned by an angle (rad), (n, columns + 1), the seam's column twice."""
    after, share = divmod(angle / (2.0 * np.pi) * (opened.shape[1] - 1), 1.0)
    one, two = (np.roll(opened[:, :-1], int(after) + k, axis=1) for k in (0, 1))
    turned = (1.0 - share) * one + share * two
    return np.column_stack([turned, turned[:, 0]])


@dataclass(frozen=True)
class ChamberInfluence:
    """Influence of unit pressure (Pa) in the chamber on faces outside the film.

    deformation (vertices,) m/Pa of the film, piston (vertices,) m/Pa by the piston alone; chamber_growth m3/Pa. The
    influence of the piston's chamber faces on each other is omitted: it is the same at any reach.
    """

    deformation: Array
    piston: Array
    chamber_growth: float


_Placed = tuple[FaceGrid, float, float]  # a part, the place (m) in the film plane from which its rows count, its angle


@dataclass(frozen=True)
class PistonWalls:
    """Both parts by their faces: rows of the bushing from the guide's inner end, of the piston from its own."""

    guide_length: float
    bushing: FaceGrid
    piston: FaceGrid

    def at(self, film: FilmSpace, pose: Pose) -> Compliance:
        """Both walls of a film on that mesh.

        The film plane is that of `gaps.films.piston`. Raises FilmInputError for a film with other columns than
        the faces have, and for one that reaches beyond a part.
        """
        return _compliance(film, self._parts(pose))

    def piston_at(self, film: FilmSpace, pose: Pose) -> Compliance:
        """The piston alone; raises as `at`."""
        return _compliance(film, self._parts(pose)[1:])

    def by_chamber(self, film: FilmSpace, pose: Pose) -> ChamberInfluence:
        """Influence of the chamber's pressure on faces outside the film."""
        vertices, _ = _numbers(film)
        opened, swollen = np.empty((2, len(film.vertices))), 0.0
        width = float(np.ptp(film.vertices[:, 0]))
        for part, (grid, start, angle) in zip(opened, self._parts(pose), strict=True):
            rows = film.vertices[vertices[:, 0], 1] - start
            _, back = _between(grid, rows)
            bare = _bare(grid, float(rows[0]))
            loaded = (grid.by_row @ bare)[:, np.arange(grid.columns + 1) % grid.period]
            part[vertices] = back @ _around(grid.by_chamber + loaded, angle)
            both = (loaded + 2.0 * grid.by_chamber)[:, :-1].mean(axis=1)  # faces and bare rows deform each other
            swollen += width * float(bare @ grid.mass @ both)
        return ChamberInfluence(opened.sum(axis=0), opened[1], swollen)

    def _parts(self, pose: Pose) -> tuple[_Placed, _Placed]:
        """Each part with the place (m) in the film plane from which its rows count, and its angle."""
        start = self.guide_length - pose.reach
        return (self.bushing, 0.0, pose.fixed), (self.piston, start, pose.moving)


def _compliance(film: FilmSpace, parts: tuple[_Placed, ...]) -> Compliance:
    """Parts together by the film's own numbering.

    Between two columns the mean of the part turned to either: as good as columns are fine, and force and work stay
    the same on both sides.
    """
    vertices, unknowns = _numbers(film)
    matrix, rows = np.zeros((len(film.vertices), film.size)), film.vertices[vertices[:, 0], 1]
    for grid, start, angle in parts:
        if unknowns.shape[1] != grid.columns:
            found = f"{unknowns.shape[1]} cells around a film"
            raise FilmInputError("piston walls", found, f"{grid.columns}, as around the parts' faces")
        after, share = divmod(angle / (2.0 * np.pi) * grid.columns, 1.0)
        influence = _on_film_rows(grid, tuple((rows - start).tolist()))
        add_turned(influence, int(after), share, vertices, unknowns, matrix)
    return Compliance(matrix)


@lru_cache(maxsize=8)
def _on_film_rows(grid: FaceGrid, rows: tuple[float, ...]) -> Array:
    """The part's compliance on a film's rows, (rows, period, columns, rows) m/Pa, kept for the films of an instant."""
    there, back = _between_rows(grid, rows)
    opened = back @ grid.influence.reshape(len(grid.rows), -1)
    shape = (len(rows), grid.period, grid.columns, len(rows))
    return np.asarray(opened.reshape(-1, len(grid.rows)) @ there).reshape(shape)


def _numbers(space: FilmSpace) -> tuple[NDArray[np.signedinteger], NDArray[np.signedinteger]]:
    """Vertices (rows, columns + 1) and unknowns (rows, columns) of an unrolled film, row by row along the bore."""
    x, y = space.vertices.T
    columns = len(np.unique(x))
    vertices = np.lexsort((x, y)).reshape(-1, columns)
    return vertices, space.vertex_dofs[vertices[:, :-1]]


def _between(grid: FaceGrid, film: Array) -> tuple[Array, Array]:
    """Rows of a face (n,) and of a film on it (m,): pressures there (n, m) and openings back (m, n)."""
    return _between_rows(grid, tuple(film.tolist()))


@lru_cache(maxsize=8)
def _between_rows(grid: FaceGrid, rows: tuple[float, ...]) -> tuple[Array, Array]:
    """The same, kept for the films of an instant."""
    face, film = grid.rows, np.array(rows)
    slack = 1e-9 * float(face[-1] - face[0])
    if not (film[0] >= face[0] - slack and film[-1] <= face[-1] + slack):
        found = f"a film from {film[0]:.6g} to {film[-1]:.6g} m"
        raise FilmInputError("piston walls", found, f"within the part, {face[0]:.6g} to {face[-1]:.6g} m")
    shared = _products(face, film, film[0], film[-1])
    there = np.linalg.solve(grid.mass, shared)
    back = np.linalg.solve(_products(film, film, film[0], film[-1]), shared.T)
    return np.asarray(there), np.asarray(back)


def _bare(grid: FaceGrid, end: float) -> Array:
    """Unit pressure from a face's start to `end` (m) as nodal pressures on its rows, (n,), in mean square."""
    face = grid.rows
    if end <= face[0]:
        return np.zeros(len(face))
    one = np.array([face[0], end])
    return np.asarray(np.linalg.solve(grid.mass, _products(face, one, face[0], end).sum(axis=1)))


def _products(first: Array, second: Array, start: float, end: float) -> Array:
    """Integrals from start to end of the products of hats on two sets of rows, (len(first), len(second)) m."""
    knots = np.union1d(first, second)
    knots = np.unique(np.clip(knots, start, end))
    middle, half = 0.5 * (knots[1:] + knots[:-1]), 0.5 * np.diff(knots)
    at = (middle[:, None] + half[:, None] * POINTS).ravel()
    weight = (half[:, None] * WEIGHTS).ravel()
    return np.asarray((_hats(first, at) * weight) @ _hats(second, at).T)


def _hats(rows: Array, at: Array) -> Array:
    """Hat functions of rows at places, (rows, places); beyond the rows as at their ends."""
    found, place = np.zeros((len(rows), len(at))), np.arange(len(at))
    after = np.clip(np.searchsorted(rows, at), 1, len(rows) - 1)
    share = np.clip((at - rows[after - 1]) / (rows[after] - rows[after - 1]), 0.0, 1.0)
    found[after - 1, place], found[after, place] = 1.0 - share, share
    return found
