"""A part by a mesh of the user's: read from a file, its faces by their function, under the film of its gap.

In place of the body that `gaps.walls.parts` makes from the part's sizes, and in the same axes: a face under the
film, faces held or sliding, and faces that pressures beside the film press on, by the names of those pressures.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reynolds.bodies.chart import Chart
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.mesh import BodyMesh
from reynolds.bodies.supports import Supports
from reynolds.bodies.wall import Body
from reynolds.errors import FilmInputError

FILM, HELD, SLIDING, CHAMBER, POCKET = "film", "held", "sliding", "chamber", "pocket"


@dataclass(frozen=True)
class OwnMesh:
    """A mesh of a file (m), and names of its faces by their function; `content`: a hash of the file's content.

    film: under the film; held: held fast; sliding: held across itself; pressed: (name of a pressure, face), such
    as ("pocket", "floor").
    """

    path: Path
    body: BodyMesh = field(compare=False, repr=False)
    content: str = ""
    film: str = FILM
    held: tuple[str, ...] = ()
    sliding: tuple[str, ...] = ()
    pressed: tuple[tuple[str, str], ...] = ()

    @property
    def named(self) -> tuple[str, ...]:
        """All faces by name."""
        return self.film, *self.held, *self.sliding, *(face for _, face in self.pressed)


def own_body(own: OwnMesh, elastic: Elastic, chart: Chart) -> Body:
    """The part of a user's mesh, its face under the film where the chart has it.

    Its faces `film` and those of pressures go by these names. With nothing held it is a free body (inertia relief).
    Raises FilmInputError for a face that the mesh lacks.
    """
    mesh = own.body
    if lost := [name for name in own.named if name not in mesh.face_names]:
        raise FilmInputError(f"mesh {own.path}", f"no face {', '.join(lost)}", f"of {', '.join(mesh.face_names)}")
    faces = mesh.mesh.boundaries
    as_named = {FILM: faces[own.film]} | {pressure: faces[face] for pressure, face in own.pressed}
    return Body(with_faces(mesh, as_named), elastic, Supports(own.held, own.sliding), FILM, chart)


def with_faces(body: BodyMesh, faces: Mapping[str, NDArray[np.int64]]) -> BodyMesh:
    """The same body with more faces, by their facets."""
    return replace(body, mesh=replace(body.mesh, _boundaries={**body.mesh.boundaries, **faces}))
