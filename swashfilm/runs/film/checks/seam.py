"""Warning of a film around a cylinder whose seam is a wall."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from reynolds.fem.mesh import box_names
from reynolds.problem import FilmProblem
from reynolds.solve.bearing import radius_around
from swashfilm.case.tables.film import Geometry
from system.inputs.units import Dimension, format_quantity


def seam_warnings(problem: FilmProblem, geometry: Geometry) -> Iterator[tuple[str, str]]:
    """Yield the warning, name and text, where x ends of a cylinder are neither sewn nor held at a pressure."""
    if geometry is not Geometry.CYLINDER:
        return
    film_mesh = problem.space.film_mesh
    names = {*problem.boundary, *(name for pair in film_mesh.seams for name in pair)}
    on_box, boundaries = box_names(film_mesh.mesh), film_mesh.mesh.boundaries or {}
    ends = np.concatenate([on_box.get(side, np.zeros(0, dtype=np.int64)) for side in ("left", "right")])
    told = np.concatenate([np.zeros(0, dtype=np.int64), *(np.asarray(boundaries[name]) for name in names)])
    if closed := len(np.setdiff1d(ends, told)):
        radius = format_quantity(radius_around(problem.space), Dimension.LENGTH, digits=4)
        yield (
            "seam_is_a_wall",
            f"{closed} of the {len(ends)} edges at the least and the greatest x of a full turn (radius {radius}) are "
            "neither a seam nor held at a pressure: they are a wall along the shaft, before which pressure builds up; "
            'periodic = "x" in film.mesh (of a file { file = "PATH", periodic = "x" }), or a pressure at both ends',
        )
