"""Mesh files that hold no film mesh are refused; those that do keep their names."""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import FilmInputError, FilmProblem, FilmSolver, Held, film, film_space, loads, mesh_from_file
from reynolds.fem.mesh_check import mesh_faults

SQUARE = np.array([[i, j] for j in range(4) for i in range(4)]) * 1e-3
QUADS = np.array([[4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4] for j in range(3) for i in range(3)])
TRIANGLES = np.vstack([QUADS[:, [0, 1, 2]], QUADS[:, [0, 2, 3]]])


def _replaced(array, index, value):
    changed = array.copy()
    changed[index] = value
    return changed


@pytest.mark.parametrize("cells", [QUADS, TRIANGLES])
def test_cells_may_run_either_way_and_start_anywhere(cells):
    turned = np.array([np.roll(c if k % 2 else c[::-1], k) for k, c in enumerate(cells)])
    assert mesh_faults(SQUARE, turned) == []
    assert mesh_faults(SQUARE * [1.0, 1e-6], turned) == []  # slivers are cells


@pytest.mark.parametrize(
    ("points", "cells", "words"),
    [
        (SQUARE, _replaced(QUADS, 4, [5, 6, 9, 10]), "1 cells without area, crossed"),  # a bow tie
        (_replaced(SQUARE, 5, [1.9e-3, 1.9e-3]), QUADS, "not convex"),
        (SQUARE, _replaced(TRIANGLES, 0, [0, 1, 2]), "1 cells without area"),
        (SQUARE, _replaced(TRIANGLES, 0, [0, 0, 1]), "1 cells without area"),
        (_replaced(SQUARE, 5, [2.5e-3, 1.1e-3]), TRIANGLES, "lie on each other"),  # folded over
        (SQUARE, np.vstack([TRIANGLES, TRIANGLES[:1]]), "2 cells that lie on each other"),
        (np.vstack([SQUARE, SQUARE]), np.vstack([QUADS[:3], QUADS[3:] + 16]), "4 points in the place of another"),
        (np.vstack([SQUARE, [[1.0, 1.0]]]), QUADS, "1 points in no cell"),
        (_replaced(SQUARE, 0, np.nan), QUADS, "1 points without finite coordinates"),
        (SQUARE[:-1], QUADS, "number 15, of 15"),
    ],
)
def test_cells_on_which_no_film_is_computed(points, cells, words):
    assert words in " ".join(mesh_faults(points, cells))


def test_broken_files_of_any_format_are_one_kind_of_error(tmp_path):
    for ending in ("bdf", "su2", "post", "xdmf", "exo", "node", "vtu", "med"):
        for content in (b"", b"no mesh \x00\xff\n1 2 3\n"):
            path = tmp_path / f"broken.{ending}"
            path.write_bytes(content)
            if ending != "node" or not content:
                with pytest.raises(FilmInputError, match="broken"):
                    mesh_from_file(path)


GMSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 1 "film"
1 1 "inflow"
1 2 "groove"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1e-3 0 0
3 2e-3 0 0
4 0 1e-3 0
5 1e-3 1e-3 0
6 2e-3 1e-3 0
$EndNodes
$Elements
5
1 1 2 1 1 1 4
2 1 2 2 2 2 5
3 1 2 7 3 3 6
4 3 2 1 1 1 2 5 4
5 3 2 1 1 2 3 6 5
$EndElements
"""


def test_gmsh_lines_keep_their_names_beside_surfaces_of_the_same_tag(tmp_path):
    path = tmp_path / "two.msh"
    path.write_text(GMSH)
    mesh = mesh_from_file(path)
    assert mesh.boundary_names == ("bottom", "groove", "inflow", "left", "outer", "right", "top")
    space = film_space(mesh)
    edges = {"inflow": Held(2e5), "groove": Held(1e5), "right": Held(0.0)}
    flow = loads(FilmSolver(space).solve(FilmProblem(space, film(np.full((1, 1), 1e-5), 0.03), edges))).flow
    through = 1e-15 / (12 * 0.03) * 1e5  # h^3 / (12 mu) of a square
    assert flow["inflow"] == pytest.approx(-through)
    assert flow["groove"] == pytest.approx(0.0, abs=1e-9 * through)
    assert flow["right"] == pytest.approx(through)
