"""Between a film and its elastic wall.

Force, moments and work are the same on either side of meshes that do not match.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import skfem

from reynolds import (
    Body,
    BodyMesh,
    Cell,
    Cylinder,
    Elastic,
    FilmInputError,
    FilmSpace,
    Plane,
    Side,
    Supports,
    annulus,
    block,
    body_space,
    body_wall,
    disc,
    face_normals,
    film_space,
    hollow_cylinder,
    rectangle,
    section,
)
from reynolds.bodies.transfer import transfer
from reynolds.bodies.wall import FacePressure, Spin, load_deformation

STEEL = Elastic(210e9, 0.3)
BORE, OUTSIDE, LENGTH = 10e-3, 16e-3, 12e-3
TOP = Plane((0.0, 0.0, 1.0), origin=(0.0, 0.0, 3e-3))


def _bore_film(cells: tuple[int, int] = (37, 11), degree: int = 1) -> FilmSpace:
    return film_space(rectangle((2.0 * np.pi * BORE, LENGTH), cells, periodic_x=True), degree=degree)


MEETINGS = {
    "bore, full turn": (
        hollow_cylinder((BORE, OUTSIDE), LENGTH, (1, 8, 2)), "inner", Cylinder(BORE, Side.BORE), _bore_film(),
    ),
    "piston in part of its bore": (
        hollow_cylinder((4e-3, BORE), 2 * LENGTH, (1, 8, 3)), "outer", Cylinder(BORE, Side.SHAFT, 0.7, 5e-3),
        _bore_film((19, 7), 2),
    ),
    "turned plane": (
        block((10e-3, 8e-3, 3e-3), (3, 2, 1)), "bottom",
        Plane((0.0, 0.0, -1.0), (1e-3, 7e-3, 0.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0)),
        film_space(rectangle((6e-3, 7e-3), (7, 9), cell=Cell.QUADRILATERAL)),
    ),
    "ring on a disc": (disc(10e-3, 3e-3, (2, 2, 1)), "top", TOP, film_space(annulus(3e-3, 9e-3, (5, 17)))),
}  # fmt: skip


@pytest.mark.parametrize("kind", MEETINGS)
def test_force_and_moments_are_conserved(kind, validation):
    body, name, chart, film = MEETINGS[kind]
    face = body_space(body).face(name)
    pressure = np.random.default_rng(2).uniform(0.0, 30e6, film.size)
    meeting = transfer(film, face, chart)
    places = chart.places(meeting.rule.points)
    forces = -(meeting.rule.by_unknown @ pressure)[:, None] * chart.normals(places)
    own = np.sum(pressure[film.dofs] @ film.reference.value.T * film.area)
    assert (meeting.rule.by_unknown @ pressure).sum() == pytest.approx(own, rel=1e-12)
    nodal = -(meeting.force @ pressure)[:, None] * face_normals(chart, face.places)
    scale = np.linalg.norm(forces, axis=1).sum()
    arm = np.abs(places).max()
    error = np.abs(nodal.sum(axis=0) - forces.sum(axis=0)).max() / scale
    moment = np.abs(np.cross(face.places, nodal).sum(axis=0) - np.cross(places, forces).sum(axis=0)).max()
    for quantity, found in (("force", error), ("moments", moment / (scale * arm))):
        validation(
            case="Transfer of a random pressure to a body",
            source="conservation, Farhat, Lesoinne and Le Tallec 1998",
            quantity=f"error of {quantity} / sum of magnitudes, {kind}",
            unit="1",
            expected=0.0,
            obtained=float(found),
            tolerance=1e-12,
            note="meshes do not match; round-off",
        )


@pytest.mark.parametrize("kind", ["bore, full turn", "turned plane", "ring on a disc"])
def test_work_is_the_same_on_either_side(kind, tmp_path, validation):
    """int q w[p] dA = int p w[q] dA, over the film: the deformation is symmetric in mean square."""
    mesh, name, chart, film = MEETINGS[kind]
    matrix = body_wall(Body(mesh, STEEL, Supports(), name, chart), film, folder=tmp_path).matrix
    p, q = np.random.default_rng(3).uniform(0.0, 1.0, (2, film.size))

    def work(pressure: np.ndarray, deformation: np.ndarray) -> float:
        at = film.sample_vertices(deformation) * (pressure[film.dofs] @ film.reference.value.T)
        return float(np.sum(at * film.area))

    validation(
        case="Reciprocal work of two pressures",
        source="Betti 1872",
        quantity=f"difference when exchanged / work, {kind}",
        unit="1",
        expected=0.0,
        obtained=(work(q, matrix @ p) - work(p, matrix @ q)) / work(p, matrix @ p),
        tolerance=1e-9,
        note="round-off",
    )
    assert work(p, matrix @ p) > 0.0


def test_body_displaced_as_a_whole():
    """A translation opens the film by its component along the normal; of a plane, turning does so linearly."""
    body, name, chart, film = MEETINGS["ring on a disc"]
    face = body_space(body).face(name)
    into = -face.places @ np.array([0.3, -0.2, 0.0]) - 0.1
    x, y = film.vertices.T
    assert transfer(film, face, chart).deformation(into) == pytest.approx(-0.3 * x + 0.2 * y - 0.1, abs=1e-13)


def test_opening_of_a_bore_by_the_film(tmp_path, validation):
    """The whole way: film pressure to body, body's displacement to film."""

    def solve(n: int) -> float:
        body = Body(
            hollow_cylinder((BORE, OUTSIDE), LENGTH, (n, 6 * n, 1)),
            STEEL,
            Supports(),
            "inner",
            Cylinder(BORE, Side.BORE),
        )
        film = _bore_film((18 * n, 6 * n))
        wall = body_wall(body, film, folder=tmp_path)
        deformation = wall.matrix @ np.full(film.size, 30e6)
        return 1e6 * float(np.sum(film.sample_vertices(deformation) * film.area) / film.area.sum())

    coarse, fine = solve(1), solve(2)
    validation(
        case="Thick-walled bore under pressure",
        source="Lame, closed form",
        quantity="mean opening of the film in a free ring",
        unit="um",
        expected=3.688645,
        obtained=fine,
        tolerance=abs(fine - coarse) / 2.0**3,
        note="third order assumed, from the mesh before",
    )


def test_load_cases_open_the_film(tmp_path):
    """A chamber's pressure on a bore of its own, against the same pressure by the film; and spin."""
    body = Body(
        hollow_cylinder((BORE, OUTSIDE), LENGTH, (2, 12, 1)), STEEL, Supports(), "inner", Cylinder(BORE, Side.BORE)
    )
    film = _bore_film()
    by_load = load_deformation(body, film, FacePressure("inner", 30e6), folder=tmp_path)
    by_film = body_wall(body, film, folder=tmp_path).matrix @ np.full(film.size, 30e6)
    # Parabolic arcs of 30 degrees: area, normals and radius each fall short of the circle's by less than 1e-4.
    assert by_load.mean() == pytest.approx(by_film.mean(), rel=3e-4)
    assert load_deformation(body, film, FacePressure("outer", 30e6), folder=tmp_path).max() < 0.0
    assert load_deformation(body, film, Spin(7850.0, 1000.0), folder=tmp_path).min() > 0.0
    twice = load_deformation(body, film, Spin(7850.0, 2000.0), folder=tmp_path)
    assert twice == pytest.approx(4.0 * load_deformation(body, film, Spin(7850.0, 1000.0), folder=tmp_path))


def test_pocket_presses_on_its_own_face(tmp_path):
    """A pocket of the film pushes the floor that it has no cells over."""
    film = film_space(annulus(3e-3, 9e-3, (3, 12)), pockets=("inner",))
    body = Body(disc(10e-3, 3e-3, (2, 2, 1)), STEEL, Supports(clamped=("outer",)), "top", TOP)
    pocket = film.edge_dofs["inner"][0]
    alone = body_wall(body, film, folder=tmp_path).matrix
    filled = body_wall(body, film, pockets={"inner": "bottom"}, folder=tmp_path).matrix
    change = filled - alone
    assert change[:, pocket] == pytest.approx(
        load_deformation(body, film, FacePressure("bottom", 1.0), folder=tmp_path)
    )
    assert np.count_nonzero(np.delete(change, pocket, axis=1)) == 0
    with pytest.raises(FilmInputError, match="no such pocket"):
        body_wall(body, film, pockets={"outer": "bottom"}, folder=tmp_path)


def test_section_takes_the_mean_around(tmp_path):
    """A film of revolution: the section's deformation is that of the ring."""
    chart, film = Cylinder(BORE, Side.BORE), _bore_film((12, 6))
    pressure = 30e6 * (1.0 + film.vertices[:, 1] / LENGTH)
    nodal = np.empty(film.size)
    nodal[film.vertex_dofs] = pressure
    found = [
        body_wall(Body(mesh, STEEL, Supports(), "inner", chart), film, folder=tmp_path).matrix @ nodal
        for mesh in (section((BORE, OUTSIDE), LENGTH, (3, 3)), hollow_cylinder((BORE, OUTSIDE), LENGTH, (2, 12, 2)))
    ]
    assert found[0] == pytest.approx(found[1], rel=3e-3)


@pytest.mark.parametrize("film_sectors", [8, 10, 13, 24])
@pytest.mark.parametrize("body_sectors", [8, 12, 30])
@pytest.mark.parametrize("solid", ["arcs", "hexahedra", "tetrahedra"])
def test_one_circle_by_two_polygons(film_sectors, body_sectors, solid):
    """A film over all of a face, its circles other polygons than the body's: all force arrives there."""
    inner, outer = 4e-3, 9e-3
    whole = hollow_cylinder((inner, outer), 3e-3, (2, body_sectors, 1))
    body = whole if solid == "arcs" else straight(whole, tetrahedra=solid == "tetrahedra")
    film = film_space(annulus(inner, outer, (3, film_sectors)))
    face = body_space(body).face("top")
    meeting = transfer(film, face, TOP)
    x, _ = film.vertices.T
    pressure = np.zeros(film.size)
    pressure[film.vertex_dofs] = 1e6 * (1.0 + x / outer)
    nodal, at_points = meeting.force @ pressure, meeting.rule.by_unknown @ pressure
    assert nodal.sum() == pytest.approx(at_points.sum(), rel=1e-12)
    # No point moves by more than a circle strays from its polygons: 1 - cos(pi/n) of the radius.
    strays = outer * (1.0 - np.cos(np.pi / min(film_sectors, body_sectors)))
    moments = face.places[:, :2].T @ nodal - meeting.rule.points.T @ at_points
    assert np.abs(moments).max() < strays * np.abs(at_points).sum()
    assert meeting.deformation(np.ones(len(face.nodes))) == pytest.approx(np.ones(len(film.vertices)), abs=1e-12)


@pytest.mark.parametrize("cell", Cell)
def test_coarse_film_presses_a_fine_body_evenly(cell):
    """A film cell over 36 facets: one pressure arrives as the facets' own nodal forces do, but for kinks."""
    space = body_space(block((6e-3, 6e-3, 1e-3), (12, 12, 1), origin=(0.0, 0.0, 2e-3)))
    face = space.face("top")
    film = film_space(rectangle((6e-3, 6e-3), (2, 2), cell=cell))
    force = transfer(film, face, TOP).force @ np.ones(film.size)
    assert np.abs(force - face.gathered(1.0)).max() < 0.03 * face.gathered(1.0).max()


def straight(body: BodyMesh, *, tetrahedra: bool) -> BodyMesh:
    """The same body with straight edges, as most mesh files have them."""
    kind = skfem.MeshHex.from_mesh(body.mesh)
    if tetrahedra:
        kind = skfem.MeshTet.from_mesh(kind.to_meshtet())
        top = np.abs(kind.p[2, kind.facets].mean(axis=0) - 3e-3) < 1e-9
        return BodyMesh(replace(kind, _boundaries={"top": np.flatnonzero(top)}))
    return BodyMesh(replace(kind, _boundaries=body.mesh.boundaries))


def test_errors():
    body, name, chart, _ = MEETINGS["ring on a disc"]
    face = body_space(body).face(name)
    wide = film_space(annulus(3e-3, 12e-3, (3, 12)))
    with pytest.raises(FilmInputError, match=r"\d+ of \d+ film points have no face .*, x -0\.01.* mm from"):
        transfer(wide, face, chart)
    film = film_space(annulus(3e-3, 9e-3, (3, 12)))
    with pytest.raises(FilmInputError, match=r"(\d+) of \1 film points"):
        transfer(film, face, Plane((0.0, 0.0, 1.0)))  # 3 mm below the face
    with pytest.raises(FilmInputError, match=r"(\d+) of \1 film points"):
        transfer(film, face, Plane((0.0, 0.0, -1.0), origin=(0.0, 0.0, 3e-3)))  # the film within the body
    with pytest.raises(FilmInputError, match="unit vectors at right angles"):
        Plane((0.0, 1.0, 1.0))


def test_a_film_just_beyond_the_edge_takes_the_edges_displacement():
    """A film 0.2 mm longer than the face, less than BEYOND of its cells, on either side: no displacement outside it."""
    face = body_space(block((10e-3, 8e-3, 3e-3), (4, 3, 1))).face("top")
    film = film_space(rectangle((10.4e-3, 8e-3), (6, 5)))
    chart = Plane((0.0, 0.0, 1.0), (-0.2e-3, 0.0, 3e-3), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    meeting = transfer(film, face, chart)
    met = meeting.share @ face.places
    x = chart.places(meeting.rule.points)[:, 0]
    assert x.min() < -1e-4
    assert x.max() > 10.1e-3
    assert met[:, 0] == pytest.approx(np.clip(x, 0.0, 10e-3), abs=1e-12)
