"""Film meshes: names, seams, valid and invalid files."""

from __future__ import annotations

import runpy
from pathlib import Path

import meshio
import numpy as np
import pytest
import skfem

from reynolds import (
    ZERO,
    Cell,
    FilmInputError,
    FilmMesh,
    FilmProblem,
    FilmSolver,
    Held,
    annulus,
    film,
    film_space,
    loads,
    mesh_from_file,
    rectangle,
    ring,
)
from reynolds.fem.mesh import rename

MESHES = Path(__file__).resolve().parents[4] / "meshes"


@pytest.mark.parametrize("cell", list(Cell))
def test_rectangle_names(cell):
    mesh = rectangle((0.02, 0.01), (4, 3), origin=(-0.01, 0.5), cell=cell)
    assert mesh.boundary_names == ("bottom", "left", "right", "top")
    assert mesh.mesh.p.min(axis=1) == pytest.approx([-0.01, 0.5])
    assert mesh.mesh.p.max(axis=1) == pytest.approx([0.01, 0.51])
    assert len(mesh.mesh.boundaries["top"]) == 4
    sewn = rectangle((0.02, 0.01), (4, 3), cell=cell, periodic_x=True)
    assert sewn.boundary_names == ("bottom", "top")


@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("cell", list(Cell))
def test_area_and_boundary_lengths(cell, degree):
    space = film_space(rectangle((0.02, 0.01), (4, 3), cell=cell), degree=degree)
    assert space.area.sum() == pytest.approx(2e-4)
    assert space.edge_share["left"].sum() == pytest.approx(0.01)
    outward = {name: normal.sum(axis=0) for name, normal in space.edge_normal.items()}
    np.testing.assert_allclose(outward["right"], (0.01, 0.0), atol=1e-15)
    np.testing.assert_allclose(outward["bottom"], (0.0, -0.02), atol=1e-15)
    moved = space.moved(2.0 * space.vertices)
    assert moved.edge_share["left"].sum() == pytest.approx(0.02)


@pytest.mark.parametrize("cell", list(Cell))
def test_annulus_names(cell):
    mesh = annulus(1.0, 2.0, (3, 30), cell=cell)
    assert mesh.boundary_names == ("inner", "outer")
    reach = {name: np.abs(mesh.mesh.p[:, mesh.mesh.facets[:, on]]).max() for name, on in mesh.mesh.boundaries.items()}
    assert reach == pytest.approx({"inner": 1.0, "outer": 2.0}, rel=1e-2)


def test_holes_of_a_ring_are_numbered_by_angle():
    keep = np.ones((5, 36), dtype=bool)
    for first in (3, 15, 27):
        keep[2, first : first + 4] = False
    mesh = ring(np.linspace(1.0, 2.0, 6), 36, keep=keep).mesh
    centres = [mesh.p[:, mesh.facets[:, mesh.boundaries[f"hole_{k}"]]].mean(axis=(1, 2)) for k in range(3)]
    angles = np.degrees([np.arctan2(y, x) % (2.0 * np.pi) for x, y in centres])
    assert angles == pytest.approx([50.0, 170.0, 290.0])
    assert {"inner", "outer"} <= set(mesh.boundaries)
    assert "port" in rename(FilmMesh(mesh), {"hole_1": "port"}).boundary_names


def test_seam_that_does_not_match():
    mesh = rectangle((0.02, 0.01), (4, 3), periodic_x=True).mesh
    p = mesh.p.copy()
    right = (p[0] > 0.0199) & (p[1] > 1e-4) & (p[1] < 0.0099)
    p[1, right] += 1e-3
    bent = skfem.MeshTri(p, mesh.t).with_boundaries(dict(mesh.boundaries))
    with pytest.raises(FilmInputError, match=r"seam left/right.*expected two sides that match"):
        film_space(FilmMesh(bent, (("left", "right"),)))
    with pytest.raises(FilmInputError, match=r"seam left/top.*expected two sides that match"):
        film_space(FilmMesh(mesh, (("left", "top"),)))


def test_pocket_that_is_not_there():
    with pytest.raises(FilmInputError, match=r"pocket grove.*bottom"):
        film_space(rectangle((1.0, 1.0), (2, 2)), pockets=["grove"])


def test_recipes_give_the_committed_files(tmp_path):
    runpy.run_path(str(MESHES / "recipes.py"))["write_all"](tmp_path)
    for name in ("slipper_land.msh", "pad.vtu"):
        written, kept = mesh_from_file(tmp_path / name), mesh_from_file(MESHES / name)
        np.testing.assert_allclose(written.mesh.p, kept.mesh.p, rtol=1e-12)
        np.testing.assert_array_equal(written.mesh.t, kept.mesh.t)
        assert written.boundary_names == kept.boundary_names


def test_land_from_gmsh_leaks_as_the_closed_form(validation):
    """A polygon of 48 sides lies between its inscribed and circumscribed circles: so does its leakage."""
    space = film_space(mesh_from_file(MESHES / "slipper_land.msh"))
    assert {"pocket", "rim"} <= set(space.film_mesh.boundary_names)
    problem = FilmProblem(space, film(space.sample(1e-5), 0.03), {"pocket": Held(20e6), "rim": Held(0.0)})
    exact = np.pi * 1e-15 * 20e6 / (6.0 * 0.03 * np.log(14.0 / 8.2))
    validation(
        case="Slipper land from a gmsh file",
        source="closed form",
        quantity="leakage",
        unit="m3/s",
        expected=exact,
        obtained=loads(FilmSolver(space).solve(problem)).flow["rim"],
        relative_tolerance=(np.pi / 48) ** 2 / 2.0 + (1.0 / 6.0) ** 2 * np.log(14.0 / 8.2) ** 2 / 12.0,
        note="tolerance: sagitta of 48 sides, and P1 on a logarithm over six cells",
    )


def test_pad_from_vtu_carries_its_names():
    mesh = mesh_from_file(MESHES / "pad.vtu")
    assert {"inlet", "outlet", "side", "left", "right", "bottom", "top"} <= set(mesh.boundary_names)
    space = film_space(mesh)
    thickness = space.sample_vertices(meshio.read(MESHES / "pad.vtu").point_data["film_thickness"])
    assert (thickness.min(), thickness.max()) == pytest.approx((1e-5, 2e-5), rel=0.02)
    posed = film(thickness, 0.03, velocity_moving=(np.ones((1, 1)), ZERO))
    held = {name: Held(0.0) for name in ("inlet", "outlet", "side")}
    found = loads(FilmSolver(space).solve(FilmProblem(space, posed, held)))
    assert found.load > 0.0
    assert found.flow["inlet"] < 0.0 < found.flow["outlet"]
    assert found.mass_balance_error < 1e-12


def _write(path: Path, points: np.ndarray, cells) -> Path:
    meshio.Mesh(points, cells).write(path)
    return path


SQUARE = np.array(
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]
)
QUAD, TRIANGLES = ("quad", np.array([[0, 1, 2, 3]])), ("triangle", np.array([[1, 4, 2], [4, 5, 2]]))


def test_file_that_is_not_there(tmp_path):
    with pytest.raises(FilmInputError, match=r"no file .*nowhere\.vtu"):
        mesh_from_file(tmp_path / "nowhere.vtu")


def test_file_that_is_no_mesh(tmp_path):
    for name in ("words.vtu", "words.msh", "words.xyz"):
        (tmp_path / name).write_text("film\n")
        with pytest.raises(FilmInputError, match=rf"{name} cannot be read"):
            mesh_from_file(tmp_path / name)


def test_file_with_other_cells(tmp_path):
    solid = _write(
        tmp_path / "solid.vtu", np.vstack([SQUARE[:3], [[0.0, 0.0, 1.0]]]), [("tetra", np.array([[0, 1, 2, 3]]))]
    )
    with pytest.raises(FilmInputError, match="holds tetra"):
        mesh_from_file(solid)
    with pytest.raises(FilmInputError, match="mixes triangles and quads"):
        mesh_from_file(_write(tmp_path / "mixed.vtu", SQUARE, [QUAD, TRIANGLES]))


def test_file_that_is_not_plane(tmp_path):
    tilted = SQUARE + np.outer(SQUARE[:, 0], [0.0, 0.0, 0.1])
    with pytest.raises(FilmInputError, match="tilted plane"):
        mesh_from_file(_write(tmp_path / "tilted.vtu", tilted, [TRIANGLES]))
    bent = SQUARE + np.outer(SQUARE[:, 0] * SQUARE[:, 1], [0.0, 0.0, 0.1])
    with pytest.raises(FilmInputError, match="not plane"):
        mesh_from_file(_write(tmp_path / "bent.vtu", bent, [TRIANGLES]))
