"""Body meshes."""

from __future__ import annotations

import meshio
import numpy as np
import pytest
import skfem

from reynolds import BodyMesh, FilmInputError, block, body_space, disc, hollow_cylinder, section
from reynolds.bodies.mesh_file import body_from_file

SHAPES = {
    "block": (block((1.0, 2.0, 3.0), (1, 2, 2)), 6.0, {"top": 2.0, "left": 6.0, "front": 3.0}),
    "ring": (hollow_cylinder((1.0, 1.6), 2.0, (1, 24, 1)), 3.12 * np.pi, {"inner": 4 * np.pi, "outer": 6.4 * np.pi}),
    "sector": (
        hollow_cylinder((1.0, 1.6), 2.0, (2, 4, 1), angles=(3.0, 3.8)),
        1.248,
        {"start": 1.2, "end": 1.2, "inner": 1.6},
    ),
    "disc": (disc(1.0, 0.5, (6, 2, 1)), 0.5 * np.pi, {"outer": np.pi, "top": np.pi, "bottom": np.pi}),
    "section": (section((1.0, 1.6), 2.0, (2, 2)), 3.12 * np.pi, {"inner": 4 * np.pi, "top": 1.56 * np.pi}),
}


@pytest.mark.parametrize("kind", SHAPES)
def test_volume_and_areas(kind):
    """Exact where straight; arcs of 15 degrees fall short of the circle by about 5e-6."""
    body, volume, areas = SHAPES[kind]
    space = body_space(body)
    close = 1e-12 if kind in ("block", "section") else 2e-5
    assert space.volume.sum() == pytest.approx(volume, rel=close)
    for name, area in areas.items():
        assert space.face(name).gathered(1.0).sum() == pytest.approx(area, rel=close)


@pytest.mark.parametrize("kind", ["block", "ring", "sector", "disc"])
def test_surfaces_close(kind):
    """The named faces are the whole surface, outwards: their area vectors add up to nothing."""
    space = body_space(SHAPES[kind][0])
    faces = [space.face(name) for name in space.body.face_names]
    assert np.abs(sum(face.area.sum(axis=(0, 1)) for face in faces)).max() < 1e-12
    # Gauss: the flux of the place through the surface is three times the volume.
    flux = sum(float(np.einsum("fqd,aq,fad->", face.area, face.value, face.places[face.facets])) for face in faces)
    assert flux == pytest.approx(3.0 * space.volume.sum(), rel=1e-12)


def test_a_solid_section_has_no_face_on_its_axis():
    assert section((0.0, 1.0), 1.0, (1, 1)).face_names == ("bottom", "outer", "top")


@pytest.mark.parametrize("kind", ["tetra", "hexahedron"])
def test_body_from_file(kind, tmp_path):
    """gmsh 2.2 with physical surfaces: names are kept, and lines or volumes with the same tag are no faces."""
    lines = [np.linspace(0.0, 1.0, 3)] * 3
    mesh = {"tetra": skfem.MeshTet, "hexahedron": skfem.MeshHex}[kind].init_tensor(*lines)
    top, floor = (mesh.facets_satisfying(lambda x, z=z: x[2] == z, boundaries_only=True) for z in (1.0, 0.0))
    order = list(range(4)) if kind == "tetra" else [0, 3, 6, 2, 1, 5, 7, 4]
    inverse = [order.index(k) for k in range(len(order))]
    cells = mesh.t.T if kind == "tetra" else mesh.t.T[:, [inverse.index(k) for k in range(8)]]
    surface = "triangle" if kind == "tetra" else "quad"
    tags = [np.repeat([1, 2], [len(top), len(floor)]), np.full(len(cells), 1)]
    raw = meshio.Mesh(
        mesh.p.T, [(surface, mesh.facets[:, np.concatenate([top, floor])].T), (kind, cells)],
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data={"lid": np.array([1, 2]), "floor": np.array([2, 2]), "steel": np.array([1, 3])},
    )  # fmt: skip
    meshio.write(tmp_path / "body.msh", raw, file_format="gmsh22", binary=False)
    body = body_from_file(tmp_path / "body.msh")
    assert body.face_names == ("floor", "lid")
    space = body_space(body)
    assert space.volume.sum() == pytest.approx(1.0)
    assert space.face("lid").area.sum(axis=(0, 1)) == pytest.approx([0.0, 0.0, 1.0], abs=1e-12)


def test_errors(tmp_path):
    with pytest.raises(FilmInputError, match="no file"):
        body_from_file(tmp_path / "nothing.msh")
    flat = meshio.Mesh(np.eye(3), [("triangle", np.array([[0, 1, 2]]))])
    meshio.write(tmp_path / "flat.vtu", flat)
    with pytest.raises(FilmInputError, match="holds triangle"):
        body_from_file(tmp_path / "flat.vtu")
    solid = meshio.Mesh(np.vstack([np.eye(3), np.zeros(3)]), [("tetra", np.array([[0, 1, 2, 3]]))])
    meshio.write(tmp_path / "solid.vtu", solid)
    with pytest.raises(FilmInputError, match="names no faces"):
        body_from_file(tmp_path / "solid.vtu")
    with pytest.raises(FilmInputError, match="120 deg"):
        hollow_cylinder((1.0, 2.0), 1.0, (1, 2, 1))
    with pytest.raises(FilmInputError, match="full turn"):
        hollow_cylinder((1.0, 2.0), 1.0, (1, 8, 1), angles=(0.0, 7.0))
    with pytest.raises(FilmInputError, match="sizes above zero"):
        block((1.0, -1.0, 1.0), (1, 1, 1))
    with pytest.raises(FilmInputError, match="no such face"):
        body_space(block((1.0, 1.0, 1.0), (1, 1, 1))).face("lid")
    with pytest.raises(FilmInputError, match="axisymmetric"):
        body_space(BodyMesh(skfem.MeshQuad()))
    apart = skfem.MeshHex().translated((2.0, 0.0, 0.0)) + skfem.MeshHex()
    with pytest.raises(FilmInputError, match="2 pieces"):
        body_space(BodyMesh(apart))
