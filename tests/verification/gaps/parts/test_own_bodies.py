"""Parts by meshes of the user: the same bodies after a round trip through files, under their films.

Lame's bushing on meshes of tetrahedra, built-in parts written to files and read back, and where a mesh lies.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest
import skfem
from numpy.typing import NDArray

from gaps import (
    Accuracy,
    BushingPart,
    Effect,
    Physics,
    PistonPart,
    PistonWalls,
    PlatePart,
    Pose,
    bushing_body,
    part_wall,
    piston_body,
    plate_body,
    slipper_mesh,
)
from gaps.walls.pair import PlateWalls, in_part_axes, while_turning
from gaps.walls.parts import SlipperPart, slipper_body
from gaps.walls.piston import FaceGrid, face_grid
from gaps.walls.user_mesh import OwnMesh
from reynolds import (
    Array,
    BodyMesh,
    Cell,
    Elastic,
    FilmInputError,
    FilmSpace,
    annulus,
    body_space,
    film_space,
    hollow_cylinder,
    rectangle,
)
from reynolds.bodies.compliance import full
from reynolds.bodies.mesh_file import body_from_file
from system import (
    FloatingOptions,
    PumpDescription,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    rotor,
    slipper_revolution,
)

STEEL, BRONZE = Elastic(210e9, 0.3), Elastic(110e9, 0.34)
BORE, OUTSIDE, GUIDE = 11e-3, 15e-3, 20e-3
HEXAHEDRON = [0, 3, 6, 2, 1, 5, 7, 4]  # scikit-fem's corners in the order of files
Faces = dict[str, NDArray[np.int64]]


def written(
    place: Path, mesh: skfem.Mesh, faces: Faces, unit: float = 1e-3, mirrored: tuple[int, int, int] = (1, 1, 1)
) -> Path:
    """A file of straight cells with named surfaces, in its unit (m); as cell data in VTU, else as gmsh's tags."""
    hexahedra = isinstance(mesh, skfem.MeshHex)
    solid = mesh.t.T[:, HEXAHEDRON] if hexahedra else mesh.t.T
    facets = np.concatenate([mesh.facets[:, faces[name]].T for name in faces])
    tags = np.repeat(np.arange(1, len(faces) + 1), [len(part) for part in faces.values()])
    inside = np.zeros(len(solid), dtype=int)
    cells = [("quad" if hexahedra else "triangle", facets), ("hexahedron" if hexahedra else "tetra", solid)]
    points = mesh.p.T / unit * mirrored
    if place.suffix == ".vtu":
        marks = {name: [(tags == k).astype(int), inside] for k, name in enumerate(faces, start=1)}
        meshio.write(place, meshio.Mesh(points, cells, cell_data=marks))
        return place
    names = {name: np.array([k, 2]) for k, name in enumerate(faces, start=1)}
    data = {key: [tags, inside] for key in ("gmsh:physical", "gmsh:geometrical")}
    raw = meshio.Mesh(points, cells, cell_data=data, field_data=names)
    meshio.write(place, raw, file_format="gmsh22", binary=False)
    return place


def unrolled(around: int, along: int = 2) -> FilmSpace:
    """A film over all of the bore."""
    size = (2.0 * np.pi * BORE, GUIDE)
    return film_space(rectangle(size, (around, along), cell=Cell.QUADRILATERAL, periodic_x=True))


def read(path: Path, unit: float, **names) -> OwnMesh:
    """A mesh file with a coordinate of one being `unit` metres."""
    return OwnMesh(path, body_from_file(path, unit), **names)


def tetrahedra(body: BodyMesh, at: dict[str, tuple[float, float]]) -> tuple[skfem.Mesh, Faces]:
    """A round body cut into tetrahedra, its faces all of whose corners have a radius (from, to) m."""
    mesh = skfem.MeshHex.from_mesh(body.mesh).to_meshtet()
    radius = np.hypot(*mesh.p[:2])[mesh.facets]
    outside = mesh.f2t[1] < 0
    return mesh, {
        name: np.flatnonzero(outside & (radius > low).all(axis=0) & (radius < high).all(axis=0))
        for name, (low, high) in at.items()
    }


def test_lame_on_a_mesh_of_tetrahedra(tmp_path, validation, refine):
    """A bore whose outside slides, u(b) = 0, plane stress; straight edges err by 1/n^2."""
    a, b, nu = BORE, OUTSIDE, 0.34
    shape = (1.0 - nu**2) / ((1.0 + nu) / b**2 + (1.0 - nu) / a**2)
    exact = 30e6 / 110e9 * shape * (1.0 / a - a / b**2)

    def solve(n: int) -> float:
        near = {"bore": (0.99 * a, 1.01 * a), "web": (0.99 * b, 1.01 * b)}
        mesh, faces = tetrahedra(hollow_cylinder((a, b), GUIDE, (n, 8 * n, 1)), near)
        own = read(written(tmp_path / f"{n}.msh", mesh, faces), 1e-3, film="bore", sliding=("web",))
        film = unrolled(12 * n)
        body = bushing_body(BushingPart(2.0 * a, b - a, GUIDE, BRONZE, own))
        return 1e6 * float((part_wall(body, film, folder=tmp_path).matrix @ np.full(film.size, 30e6)).mean())

    found = refine(solve, (1, 2, 4), 2.0)
    validation(
        case="Bushing by a user's mesh of tetrahedra",
        source="Lame, plane stress, outer face sliding",
        quantity="radial displacement of the bore at 30 MPa",
        unit="um",
        expected=1e6 * exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


SLIPPER = SlipperPart(0.5e-3, 8e-3, 7e-3, 14e-3, 5e-3, BRONZE)
PLATE = PlatePart(0.0, 20e-3, 10e-3, STEEL, pocket_radius=8e-3, over_film=True)
PISTON = PistonPart(2.0 * BORE, 10e-3, GUIDE, STEEL)
BUSHING = BushingPart(2.0 * BORE, OUTSIDE - BORE, GUIDE, BRONZE)
LANDS = ((8e-3, 14e-3),)
PARTS = {
    "slipper": (SLIPPER, slipper_body, ("film", "pocket", "held"), (1, 1, 1)),
    "swash plate": (PLATE, plate_body, ("top", "pocket", "bottom"), (1, 1, -1)),
    "piston": (PISTON, piston_body, ("outer", "chamber"), (1, 1, 1)),
    "bushing": (BUSHING, bushing_body, ("inner", "outer"), (1, 1, 1)),
}
MEANT = {
    "slipper": {"held": ("held",), "pressed": (("pocket", "pocket"),)},
    "swash plate": {"film": "top", "held": ("bottom",), "pressed": (("pocket", "pocket"),)},
    "piston": {"film": "outer", "pressed": (("chamber", "chamber"),)},
    "bushing": {"film": "inner", "sliding": ("outer",)},
}


@pytest.mark.parametrize(("kind", "suffix"), [*((kind, ".msh") for kind in PARTS), ("slipper", ".vtu")])
def test_part_written_and_read_back_is_the_same_part(kind, suffix, tmp_path):
    """The built-in part with straight edges, 24 around: chords stray from arcs by 1 - cos(pi/24) = 0.9 %.

    Stiffness against bending goes by the third power of a size at most: openings differ by less than 3 %.
    """
    part, build, names, mirrored = PARTS[kind]
    built = build(part, (3, 24, 1))
    faces = {name: built.mesh.mesh.boundaries[name] for name in names}
    place = written(tmp_path / f"part{suffix}", built.mesh.mesh, faces, mirrored=mirrored)
    own = read(place, 1e-3, **MEANT[kind])
    film = unrolled(24, 4)
    if kind in ("slipper", "swash plate"):
        film = film_space(slipper_mesh(LANDS, (3, 24)), pockets=["pocket"])
    pressure = 30e6 * np.random.default_rng(1).uniform(0.0, 1.0, film.size)
    one = part_wall(built, film, folder=tmp_path).matrix @ pressure
    two = part_wall(build(replace(part, own=own)), film, folder=tmp_path).matrix @ pressure
    assert np.abs(two - one).max() < 0.03 * np.abs(one).max()


def thin_quarter(place: Path, *, over: bool = False) -> OwnMesh:
    """A plate held on its back that is half as thick where x, y > 0."""
    mesh = skfem.MeshHex.from_mesh(hollow_cylinder((20e-3, 50e-3), 10e-3, (4, 24, 2), bottom=-10e-3).mesh)
    x, y, z = mesh.p[:, mesh.t].mean(axis=1)
    cut = (x > 0.0) & (y > 0.0) & (z < -5e-3)
    left = mesh.remove_elements(np.flatnonzero(cut))
    facet = left.p[:, left.facets]
    outside = left.f2t[1] < 0
    faces = {
        "film": np.flatnonzero(outside & (np.abs(facet[2]) < 1e-9).all(axis=0)),
        "held": np.flatnonzero(outside & (np.abs(facet[2] + 10e-3) < 1e-9).all(axis=0)),
    }
    file = written(place / "plate.msh", left, faces, mirrored=(1, 1, -1 if over else 1))
    return read(file, 1e-3, held=("held",))


@pytest.mark.parametrize("over", [False, True])
def test_a_mesh_lies_in_the_axes_of_its_film(over, tmp_path):
    """A plate that is missing its back on a quarter opens there most, whichever side of the film it lies on."""
    own = thin_quarter(tmp_path, over=over)
    film = film_space(annulus(25e-3, 45e-3, (3, 24)))
    body = plate_body(PlatePart(20e-3, 50e-3, 10e-3, STEEL, over_film=over, own=own))
    opening = part_wall(body, film, folder=tmp_path).matrix @ np.ones(film.size)
    quadrant = [opening[(film.vertices * side > 5e-3).all(axis=1)].mean() for side in ((1, 1), (-1, 1), (1, -1))]
    assert quadrant[0] > 1.5 * max(quadrant[1:]) > 0.0


def oblong(place: Path, angle: float) -> OwnMesh:
    """A bushing of 12 sectors that is twice as thick towards an angle (rad) as away from it."""
    mesh = skfem.MeshHex.from_mesh(hollow_cylinder((BORE, OUTSIDE), GUIDE, (1, 12, 2)).mesh)
    x, y, z = mesh.p
    thick = np.where(np.hypot(x, y) > 0.5 * (BORE + OUTSIDE), 1.0 + 0.2 * (1.0 + x / OUTSIDE), 1.0)
    c, s = np.cos(angle), np.sin(angle)
    turned = skfem.MeshHex(np.vstack([thick * (c * x - s * y), thick * (s * x + c * y), z]), mesh.t)
    built = hollow_cylinder((BORE, OUTSIDE), GUIDE, (1, 12, 2)).mesh.boundaries
    faces = {"film": built["inner"], "held": built["outer"], "chamber": built["bottom"]}
    pressed = (("chamber", "chamber"),)
    return read(written(place / f"{angle:.3f}.vtu", turned, faces), 1e-3, held=("held",), pressed=pressed)


@pytest.mark.parametrize(("columns", "tolerance"), [(2.0, 1e-9), (1.5, 0.03)])
def test_a_bushing_that_turns_is_the_turned_bushing(columns, tolerance, tmp_path):
    """Compliance and the chamber's opening turn with the part; between columns to second order of their width.

    Half a column is pi/24: cos 6 theta, as far as 12 sectors go, is wrong by its square over 8, weighted little.
    """
    angle = 2.0 * np.pi * columns / 24
    film = unrolled(24, 4)
    pressure = 30e6 * np.random.default_rng(4).uniform(0.5, 1.0, film.size)
    found = []
    for built, stands in ((0.0, angle), (angle, 0.0)):
        body = bushing_body(replace(BUSHING, own=oblong(tmp_path, built)))
        grid = face_grid(body, BORE, np.linspace(0.0, GUIDE, 5), 24, tmp_path)
        stiff = FaceGrid(grid.rows, 0.0 * grid.influence, 0.0 * grid.by_chamber)
        walls = PistonWalls(GUIDE, grid, stiff)
        stand = Pose(GUIDE, fixed=stands)
        found.append((walls.at(film, stand).matrix @ pressure, walls.by_chamber(film, stand).deformation))
    for turned, as_built in zip(*found, strict=True):
        assert np.ptp(as_built) > 0.1 * np.abs(as_built).max()
        assert np.abs(turned - as_built).max() < tolerance * np.abs(as_built).max()


def test_plates_are_meshed_once_for_films_of_the_same_mesh():
    walls = PlateWalls((PlatePart(20e-3, 50e-3, 10e-3, STEEL), PlatePart(20e-3, 50e-3, 10e-3, STEEL)))
    first, again, finer = (film_space(annulus(25e-3, 45e-3, (3, around))) for around in (24, 24, 36))
    found = walls.at(first, Pose())
    assert walls.at(again, Pose()) is found
    assert walls.at(finer, Pose()).matrix.shape != found.matrix.shape
    stiff = PlatePart(20e-3, 50e-3, 10e-3, replace(STEEL, youngs_modulus=2.0 * STEEL.youngs_modulus))
    stiffer = full(replace(walls, parts=(stiff, stiff)).at(first, Pose()).matrix)
    np.testing.assert_allclose(2.0 * stiffer, full(found.matrix), rtol=1e-6)


@pytest.mark.parametrize(("columns", "tolerance"), [(3.0, 1e-3), (2.5, 0.11)])
def test_plates_turn_in_their_film(columns, tolerance, tmp_path):
    """A moving plate turned one way is a film and its pressure turned the other; between columns nearly so.

    Openings change over a thickness t = 10 mm, columns are d = 9.2 mm: d^2/(8 t^2). The other has 36 sectors.
    """
    film = film_space(annulus(25e-3, 45e-3, (3, 24)))
    column = 2.0 * np.pi / 24
    walls = PlateWalls((
        PlatePart(20e-3, 50e-3, 10e-3, STEEL, own=thin_quarter(tmp_path)), PlatePart(20e-3, 50e-3, 10e-3, STEEL),
    ))  # fmt: skip
    assert not walls.alike_around
    x, y = in_part_axes(film, columns * column).vertices.T
    pressure = np.empty(film.size)
    pressure[film.vertex_dofs] = 1.0 + x / 50e-3
    turned = while_turning(lambda at: walls.at(film, Pose(moving=at)), columns * column, column)
    as_built = walls.at(in_part_axes(film, columns * column), Pose()).matrix @ pressure
    assert np.abs(turned.matrix @ pressure - as_built).max() < tolerance * np.abs(as_built).max()
    assert np.abs(as_built[(x > 0.0) & (y > 0.0)]).mean() > 1.3 * np.abs(as_built[(x < 0.0) & (y < 0.0)]).mean()


@pytest.mark.long
def test_a_pump_of_own_meshes_runs_alike(tmp_path):
    """Slipper and swash plate of ref90 from files, straight edges: films over the turn differ by 1 %.

    Chords stray by 0.9 % of their radius (24 around), openings by up to 3 %, of films that walls open by a third.
    """
    stated = {"operating.pressure": "10 MPa"}
    own = dict(stated)
    upper, lower = floating_parts(load_pump("ref90", stated)).slipper.laws.walls.parts
    for table, body, names, mirrored in (
        ("slipper", slipper_body(upper), {"film": "film", "pocket": "pocket", "held": "held"}, (1, 1, 1)),
        ("swash_plate", plate_body(lower), {"film": "top", "pocket": "pocket", "held": "bottom"}, (1, 1, -1)),
    ):
        faces = {name: body.mesh.mesh.boundaries[face] for name, face in names.items()}
        place = written(tmp_path / f"{table}.vtu", body.mesh.mesh, faces, mirrored=mirrored)
        own[f"{table}.body"] = {"mesh": str(place), "unit": "mm"}
    one, two = (turn_of(load_pump("ref90", tables)) for tables in (stated, own))
    assert two == pytest.approx(one, rel=0.01, abs=0.0)


def turn_of(pump: PumpDescription) -> Array:
    """Mean film (m) of the slipper between elastic walls at 24 angles."""
    at, parts = rotor(pump, operating_point(pump)), floating_parts(pump)
    cycle = lumped_point(pump, at.point).cycle
    driven = drives(at, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(len(cycle.shaft_angle)))
    soft = Physics().without(Effect.PRESSURE_VISCOSITY)
    options = FloatingOptions(soft, steps=24, accuracy=Accuracy(step=0.1), finer=0.5, keep=1)
    found = slipper_revolution(at, parts, driven.slipper, options)
    return np.array([instant.mean_film for instant in found.turn.instants])


# Files that hold no body


def block(tmp_path: Path, change: str) -> Path:
    mesh = skfem.MeshTet.init_tensor(*(np.linspace(0.0, 1.0, 3),) * 3)
    top = np.flatnonzero(np.abs(mesh.p[2, mesh.facets] - 1.0).max(axis=0) < 1e-9)
    points, t = mesh.p.copy(), mesh.t.copy()
    if change == "folded":
        points[:, np.argmin(np.abs(points - 0.5).max(axis=0))] += 0.8
    if change == "cracked":  # the cells of one corner point take a copy of their middle one
        middle = np.argmin(np.abs(points - 0.5).max(axis=0))
        points = np.column_stack([points, points[:, middle]])
        first = np.flatnonzero((t == middle).any(axis=0))[0]
        t[:, first] = np.where(t[:, first] == middle, points.shape[1] - 1, t[:, first])
    return written(tmp_path / "block.msh", skfem.MeshTet(points, t), {"film": top}, unit=1.0)


@pytest.mark.parametrize(("change", "wanted"), [("folded", "folded into each other"), ("cracked", "in one place")])
def test_meshes_that_are_no_body(change, wanted, tmp_path):
    body = body_from_file(block(tmp_path, ""))
    assert body_space(body).volume.sum() == pytest.approx(1.0)
    with pytest.raises(FilmInputError, match=wanted):
        body_space(body_from_file(block(tmp_path, change)))


def test_faces_that_a_mesh_has_not(tmp_path):
    own = read(block(tmp_path, ""), 1.0, film="top", held=("bottom",))
    with pytest.raises(FilmInputError, match=r"no face top, bottom.*of film"):
        plate_body(PlatePart(0.0, 1.0, 1.0, STEEL, own=own))
    with pytest.raises(FilmInputError, match=r"no file .*nowhere\.msh"):
        body_from_file(tmp_path / "nowhere.msh")


def radius_of(places: Array) -> Array:
    return np.hypot(*places[:, :2].T)


def test_a_unit_is_what_a_coordinate_means(tmp_path):
    body = hollow_cylinder((BORE, OUTSIDE), GUIDE, (1, 12, 1))
    for unit in (1.0, 1e-3, 25.4e-3):
        place = written(tmp_path / "ring.vtu", body.mesh, {"film": body.mesh.boundaries["outer"]}, unit)
        face = body_space(body_from_file(place, unit)).face("film")
        assert radius_of(face.places).max() == pytest.approx(OUTSIDE, rel=1e-12)
