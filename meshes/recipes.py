"""The reference film meshes of this folder, each from a few lines: `python meshes/recipes.py` writes them anew.

Boundary names are API: a film case names them. Coordinates in metres, the film plane is z = 0.
"""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np
import skfem
from skfem.io.meshio import to_meshio

from reynolds.fem.mesh import Cell, annulus, rectangle

HERE = Path(__file__).parent


def slipper_land() -> meshio.Mesh:
    """Sealing land of the reference pump's slipper, 8.2 to 14 mm: triangles, physical groups pocket and rim."""
    mesh = annulus(8.2e-3, 14.0e-3, (6, 48), cell=Cell.TRIANGLE).mesh
    tags = {"pocket": 1, "rim": 2, "land": 3}
    edges = {"pocket": mesh.facets[:, mesh.boundaries["inner"]].T, "rim": mesh.facets[:, mesh.boundaries["outer"]].T}
    return meshio.Mesh(
        np.column_stack([mesh.p.T, np.zeros(mesh.nvertices)]),
        [("line", edges["pocket"]), ("line", edges["rim"]), ("triangle", mesh.t.T)],
        cell_data={
            key: [np.full(48, 1), np.full(48, 2), np.full(mesh.nelements, 3)]
            for key in ("gmsh:physical", "gmsh:geometrical")
        },
        field_data={name: np.array([tag, 2 if name == "land" else 1]) for name, tag in tags.items()},
    )


def pad() -> meshio.Mesh:
    """A 20 x 10 mm pad: quadrilaterals; boundaries inlet, outlet and side; film thickness 20 to 10 um as data."""
    film_mesh = rectangle((20e-3, 10e-3), (40, 10), cell=Cell.QUADRILATERAL)
    sides = film_mesh.mesh.boundaries
    named = {"inlet": sides["left"], "outlet": sides["right"], "side": np.concatenate([sides["bottom"], sides["top"]])}
    mesh = skfem.MeshQuad(film_mesh.mesh.p, film_mesh.mesh.t).with_boundaries(named)
    written = to_meshio(mesh, point_data={"film_thickness": 20e-6 - 10e-6 * mesh.p[0] / 20e-3})
    written.points = np.column_stack([written.points, np.zeros(len(written.points))])
    return written


def write_all(folder: Path) -> None:
    """Write slipper_land.msh (gmsh 2.2, text) and pad.vtu into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    slipper_land().write(folder / "slipper_land.msh", file_format="gmsh22", binary=False)
    pad().write(folder / "pad.vtu")


if __name__ == "__main__":
    write_all(HERE)
    print(f"wrote slipper_land.msh and pad.vtu in {HERE}")
