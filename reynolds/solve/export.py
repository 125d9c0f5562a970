"""Film fields for ParaView: VTU files of a plane or curved film, and PVD series over shaft angle or time."""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.fem.space import FilmSpace
from reynolds.laws.contact import contact_pressure
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import point_fields

Fields = Mapping[str, tuple[Array, str]]
"""Values by name, each with its unit."""


def vertex_fields(solution: FilmSolution) -> dict[str, tuple[Array, str]]:
    """Fields at the vertices (vertices,) with their units: pressure, thickness and film fraction of a film.

    Between elastic walls also deformation (opening of the film), also of a film of the deformed shape between rigid
    ones; between rough ones contact_pressure.
    """
    problem, at = solution.problem, solution.problem.space.vertex_dofs
    thickness = vertex_thickness(solution)
    found = {
        "film_pressure": (solution.pressure[at], "Pa"),
        "film_thickness": (thickness, "m"),
        "film_fraction": (solution.film_fraction[at], "1"),
    }
    if problem.walls is not None or solution.deformation.any():
        found["deformation"] = (solution.deformation, "m")
    if problem.asperities is not None:
        gap = problem.space.to_vertices(solution.gap)
        found["contact_pressure"] = (np.asarray(contact_pressure(problem.asperities, gap).value), "Pa")
    return found


def write_vtu(
    path: Path, solution: FilmSolution, place: Callable[[Array], Array] | None = None, more: Fields | None = None
) -> None:
    """Write one film as a surface with its `vertex_fields` and wall_shear (moving wall); heads are `name [unit]`.

    `more` are further fields at the vertices. `place` maps vertices (n, 2) m of the film plane to their true place
    (n, 3) m: a cylinder for a piston. film_thickness is given at the vertices (averaged where it jumps) and, exact,
    as the mean of each cell.
    """
    import meshio

    space = solution.problem.space
    fields = point_fields(solution)
    thickness = np.broadcast_to(solution.film.thickness, space.area.shape)
    shear = np.stack([np.broadcast_to(t, space.area.shape) for t in fields.shear_moving])
    cell_area = space.area.sum(axis=1)
    meshio.write_points_cells(
        path,
        surface_points(space, place),
        [("triangle" if space.cells.shape[1] == 3 else "quad", space.cells)],
        point_data=_headed({**vertex_fields(solution), **(more or {})}),
        cell_data={
            name: [values]
            for name, values in _headed(
                {
                    "film_thickness_cell": ((thickness * space.area).sum(axis=1) / cell_area, "m"),
                    "wall_shear": (np.hypot(*(shear * space.area).sum(axis=2)) / cell_area, "Pa"),
                }
            ).items()
        },
    )


def _headed(fields: Fields) -> dict[str, Array]:
    return {f"{name} [{unit}]": values for name, (values, unit) in fields.items()}


def surface_points(space: FilmSpace, place: Callable[[Array], Array] | None = None) -> Array:
    """Vertices of a film in space, (n, 3) m: by `place`, else on the film's plane or sphere."""
    flat = space.vertices
    return place(flat) if place else space.sphere.in_space(flat)


def write_pvd(path: Path, entries: Iterable[tuple[float, int, str]]) -> None:
    """Write a ParaView collection: (shaft angle in degrees or time in s, part, file name beside the PVD)."""
    rows = "\n".join(
        f'    <DataSet timestep="{stamp:.9g}" group="" part="{part}" file={quoteattr(name)}/>'
        for stamp, part, name in entries
    )
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
        f"  <Collection>\n{rows}\n  </Collection>\n</VTKFile>\n",
        encoding="utf-8",
    )
