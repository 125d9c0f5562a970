"""Seam of a film mesh: two sides of its bounding box that a translation maps onto each other."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.fem.mesh import FilmMesh, box_names

SIDES = (("left", "right"), ("bottom", "top"))
NEAR = 1e-6  # of the film's extent: nodes farther apart are two


def sewn(film_mesh: FilmMesh, axis: int) -> FilmMesh:
    """The mesh with its sides along x (axis 0: left and right) or y (axis 1: bottom and top) as one seam.

    Edges of the seam have no other name; a name of the file for one of the sides is then a side of the seam. Raises
    FilmInputError where the nodes of the sides do not match.
    """
    first, second = SIDES[axis]
    on_box = box_names(film_mesh.mesh)
    sides = {name: on_box.get(name, np.zeros(0, dtype=np.int64)) for name in (first, second)}
    _check(film_mesh, sides, 1 - axis)
    seam = np.concatenate(list(sides.values()))
    others = {name: np.setdiff1d(facets, seam) for name, facets in (film_mesh.mesh.boundaries or {}).items()}
    kept = {name: facets for name, facets in others.items() if len(facets) and name not in sides}
    named = replace(film_mesh.mesh, _boundaries={**kept, **sides})
    return FilmMesh(named, (*film_mesh.seams, (first, second)))


def _check(film_mesh: FilmMesh, sides: Mapping[str, NDArray[np.int64]], along: int) -> None:
    mesh = film_mesh.mesh
    near = NEAR * float(np.ptp(mesh.p, axis=1).max())
    (one, first), (other, second) = ((name, np.unique(mesh.facets[:, facets])) for name, facets in sides.items())
    expected = "two straight sides whose nodes lie at the same places along them"
    if len(first) != len(second) or not len(first):
        raise FilmInputError("periodic", f"{len(first)} nodes on {one}, {len(second)} on {other}", expected)
    apart = np.abs(np.sort(mesh.p[along, first]) - np.sort(mesh.p[along, second]))
    if apart.max() > near:
        missed = int(np.argmax(apart > near))
        place = float(np.sort(mesh.p[along, first])[missed])
        found = f"a node on {one} at {'xy'[along]} = {place:.6g} that {other} lacks by {apart[missed]:.3g}"
        raise FilmInputError("periodic", f"{found}, in the unit of the file", expected)
