"""Deforming parts of the pump.

Bushing, piston, slipper and plates under their films against closed forms of elasticity (Lame 1852, Timoshenko and
Woinowsky-Krieger 1959), and that force and work are the same on either side of a film that moves along a part.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ive

from gaps import BushingPart, PistonPart, PistonWalls, PlatePart, Pose, bushing_body, part_wall, piston_body, plate_body
from gaps.walls.parts import SlipperPart, closer_at_end, closer_at_start, slipper_body
from gaps.walls.piston import FaceGrid, face_grid
from gaps.walls.user_mesh import CHAMBER, FILM
from reynolds import (
    Array,
    Cell,
    Elastic,
    FilmInputError,
    FilmSpace,
    annulus,
    at_points,
    body_space,
    film_space,
    rectangle,
    structure,
)
from reynolds.bodies.elasticity import pressure_forces
from reynolds.bodies.foundation import both
from reynolds.bodies.wall import BodyWall, FacePressure, FaceWall, load_deformation
from reynolds.numerics.cache import CacheOrigin

STEEL, BRONZE = Elastic(210e9, 0.3), Elastic(110e9, 0.34)
PRESSURE, MICRON = 30e6, 1e6
BORE, OUTSIDE, GUIDE = 11e-3, 15e-3, 20e-3
BUSHING = BushingPart(2.0 * BORE, OUTSIDE - BORE, GUIDE, BRONZE)
PISTON = PistonPart(2.0 * BORE, 10e-3, 30e-3, STEEL)


def unrolled(rows: Array, around: int = 12) -> FilmSpace:
    """A film on the bore with its rows along it."""
    space = film_space(rectangle((2.0 * np.pi * BORE, 1.0), (around, len(rows) - 1), periodic_x=True,
                                 cell=Cell.QUADRILATERAL))  # fmt: skip
    row = np.round(space.vertices[:, 1] * (len(rows) - 1)).astype(int)
    return space.moved(np.column_stack([space.vertices[:, 0], rows[row]]))


def even(length: float, cells: int) -> Array:
    """Rows of a face at even steps."""
    return np.linspace(0.0, length, cells + 1)


def opened(grid: FaceGrid) -> Array:
    """Opening of a whole face under one pressure, (rows, columns + 1) m."""
    return PRESSURE * grid.influence.sum(axis=(2, 3))[:, np.arange(grid.columns + 1) % grid.period]


@pytest.mark.parametrize("poisson", [0.34, 0.0])
def test_bushing_in_its_web(poisson, validation, refine):
    """Plane stress, u(b) = 0: u(a) = p (1 - nu^2)/E (1/a - a/b^2)/[(1 + nu)/b^2 + (1 - nu)/a^2]."""
    a, b = BORE, OUTSIDE
    part = BushingPart(2.0 * a, b - a, GUIDE, Elastic(110e9, poisson))
    shape = (1.0 - poisson**2) / ((1.0 + poisson) / b**2 + (1.0 - poisson) / a**2)
    exact = PRESSURE / 110e9 * shape * (1.0 / a - a / b**2)

    def solve(n: int) -> float:
        return MICRON * float(opened(face_grid(bushing_body(part, (n, 6 * n, 1)), a, even(GUIDE, 2), 12 * n)).mean())

    found = refine(solve, (1, 2, 4), 3.0)
    validation(
        case="Bushing in the web between two bores",
        source="Lame, plane stress, outer face sliding",
        quantity=f"radial displacement of the bore at 30 MPa, Poisson's ratio {poisson:g}",
        unit="um",
        expected=MICRON * exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("inner", [0.0, 10e-3])
def test_piston_pressed_from_outside(inner, validation, refine):
    """Plane stress: u(b) = -p b/E [(b^2 + a^2)/(b^2 - a^2) - nu]; the film opens by as much."""
    a, b = 0.5 * inner, BORE
    exact = PRESSURE * b / 210e9 * ((b**2 + a**2) / (b**2 - a**2) - 0.3)

    def solve(n: int) -> float:
        part = PistonPart(2.0 * b, inner, PISTON.length, STEEL)
        found = opened(face_grid(piston_body(part, (n, 8 * n, 1)), b, even(part.length, 2), 16 * n))
        return MICRON * float(found.mean())

    found = refine(solve, (1, 2, 4), 3.0)
    validation(
        case="Piston pressed from outside",
        source="Lame, plane stress",
        quantity=f"opening at 30 MPa, {'solid' if inner == 0.0 else 'hollow'} piston",
        unit="um",
        expected=MICRON * exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


def dent(wave: float, radius: float) -> float:
    """Deepest deformation (m/Pa) of a long solid cylinder under cos(2 pi z/wave): its own, by its dents."""
    x = 2.0 * np.pi / wave * radius
    zero, one = ive(0, x), ive(1, x)
    return 0.7 * radius * 2.6 / 210e9 * one**2 / (x**2 * zero**2 - (x**2 + 1.4) * one**2)


@pytest.mark.slow
def test_dents_along_a_piston(validation, tmp_path):
    """Bands of pressure half a radius wide dent a piston as a long cylinder, next to a half-space."""
    wave, part = 12e-3, PistonPart(2.0 * BORE, 0.0, 36e-3, STEEL)
    rows = part.length * closer_at_start(np.linspace(0.0, 1.0, 25))
    grid = face_grid(piston_body(part, (3, 8, 12)), BORE, rows, 8, tmp_path)
    middle = int(np.argmin(np.abs(rows - 0.5 * part.length)))
    pressed = np.cos(2.0 * np.pi * (rows - rows[middle]) / wave)
    apart = 2.0 * np.pi / wave * (rows[middle + 1] - rows[middle])
    exact = dent(wave, BORE)
    assert exact == pytest.approx(2.0 * 0.91 / 210e9 * wave / (2.0 * np.pi), rel=0.1)
    validation(
        case="Dents along a piston",
        source="Filon 1902, solid cylinder under a cosine of pressure",
        quantity="opening in the middle of a band of 6 mm at 100 MPa",
        unit="um",
        expected=1e8 * MICRON * exact,
        obtained=1e8 * MICRON * float(grid.influence[middle, 0].sum(axis=0) @ pressed),
        relative_tolerance=1.5 * apart**2 / 12.0,
        note="tolerance: half as much again as rows this far apart lose of the cosine",
    )


def test_piston_under_its_chamber(validation, refine):
    """Pressure within widens it as Lame says; pressure on its end, held by inertia, by nu p (1 - z/L) b/E more."""
    a, b, length = 0.5 * PISTON.inner_diameter, BORE, PISTON.length
    widened = 2.0 * PRESSURE * a**2 * b / (210e9 * (b**2 - a**2))
    film = unrolled(np.linspace(0.0, length, 5), around=24)
    ends = [np.abs(film.vertices[:, 1] - y) < 1e-9 for y in (0.0, length)]

    def solve(n: int) -> tuple[float, float]:
        found = load_deformation(piston_body(PISTON, (n, 6 * n, n)), film, FacePressure(CHAMBER, -PRESSURE))
        return MICRON * float(found[ends[0]].mean()), MICRON * float(found[ends[1]].mean())

    found = refine(solve, (1, 2, 4), 3.0)
    for place, more, column in zip(("chamber end", "other end"), (0.3 * PRESSURE * b / 210e9, 0.0), found, strict=True):
        validation(
            case="Hollow piston under its chamber's pressure",
            source="Lame, plane stress; accelerated bar",
            quantity=f"radial displacement at the {place}, 30 MPa",
            unit="um",
            expected=MICRON * (widened + more),
            obtained=column.finest,
            tolerance=column.tolerance(rounding=1e-9),
            order=column.order,
        )


def test_no_rigid_motion():
    """Pushed aside, a free piston bends about its mean position; a bushing, free along its axis, stays there."""
    for body, faces in (
        (piston_body(PISTON, (1, 8, 2)), ("top", "bottom")),
        (bushing_body(BUSHING, (1, 8, 2)), ("top",)),
    ):
        space = body_space(body.mesh)
        held = structure(space, body.elastic, body.supports)
        assert held.motions.shape[1] == (6 if faces == ("top", "bottom") else 2)  # along and about the axis
        for face in faces:
            moved = held.displaced(pressure_forces(space, space.face(face), PRESSURE)[:, None])
            mean = held.inertia.T @ moved
            assert np.abs(mean).max() < 1e-9 * np.abs(held.inertia).sum(axis=0).max() * np.abs(moved).max()
    solid = slipper_body(SlipperPart(0.5e-3, 8e-3, 7e-3, 14e-3, 5e-3, BRONZE), (4, 8, 1))
    assert structure(body_space(solid.mesh), BRONZE, solid.supports).motions.shape[1] == 0
    plate = plate_body(PlatePart(30e-3, 50e-3, 10e-3, STEEL), (2, 8, 1))
    assert structure(body_space(plate.mesh), STEEL, plate.supports).motions.shape[1] == 0


def rim_deflection(inner: float, outer: float, thick: float, elastic: Elastic) -> float:
    """Kirchhoff's annular plate, clamped at `inner`, free at `outer`, under unit pressure: deflection of its rim.

    w = q r^4/(64 D) + C0 + C1 ln r + C2 r^2 + C3 r^2 ln r with w = w' = 0 within, M = Q = 0 without.
    """
    e, nu = elastic.youngs_modulus, elastic.poisson_ratio
    d = e * thick**3 / (12.0 * (1.0 - nu**2))

    def shapes(r: float) -> Array:
        """w, w', w'' and Q/D of q r^4/64, 1, ln r, r^2, r^2 ln r."""
        log = np.log(r)
        return np.array([
            [r**4 / 64.0, 1.0, log, r**2, r**2 * log],
            [r**3 / 16.0, 0.0, 1.0 / r, 2.0 * r, 2.0 * r * log + r],
            [3.0 * r**2 / 16.0, 0.0, -1.0 / r**2, 2.0, 2.0 * log + 3.0],
            [r / 2.0, 0.0, 0.0, 0.0, 4.0 / r],
        ])  # fmt: skip

    within, rim = shapes(inner), shapes(outer)
    rows = np.array([within[0], within[1], rim[2] + nu * rim[1] / outer, rim[3]])
    free = np.linalg.solve(rows[:, 1:], -rows[:, 0])
    return float((rim[0] @ np.r_[1.0, free]) / d)


def test_slipper_bends_about_its_socket(validation, refine):
    """The rim of a thin flange under a uniform film, as an annular plate clamped at the socket's edge.

    The socket holds only the back: a thicker flange deforms more there, in proportion to its thickness.
    """
    socket, rim = 8e-3, 14e-3
    film = film_space(annulus(socket, rim, (6, 48)))
    edge = np.hypot(*film.vertices.T) > rim * (1.0 - 1e-9)

    def solve(thick: float, across: int) -> float:
        body = slipper_body(SlipperPart(3e-3, socket, socket, rim, thick, BRONZE), (across, 8, 1))
        found = load_deformation(body, film, FacePressure(FILM, 1.0))
        return float(np.mean(found[edge])) / rim_deflection(socket, rim, thick, BRONZE)

    thick = (0.6e-3, 0.3e-3, 0.15e-3)
    found = refine(lambda n: solve(thick[n], 24), (0, 1, 2), 1.0)
    limit = 2.0 * found.finest - found.values[-2]
    mesh = 1.25 * abs(found.finest - solve(thick[-1], 12))
    validation(
        case="Slipper's rim bending about its socket",
        source="Timoshenko and Woinowsky-Krieger 1959, annular plate",
        quantity="deflection of the rim / Kirchhoff's, extrapolated to a thin flange",
        unit="1",
        expected=1.0,
        obtained=limit,
        tolerance=0.25 * abs(limit - found.finest) + mesh,
        order=found.order,
        note="tolerance: a quarter of what halving the flange still changes; mesh, first order at the edge",
    )


def test_plate_on_its_back(validation):
    """Far from its edges a plate is pressed without giving way sideways: t p (1 + nu)(1 - 2 nu)/((1 - nu) E)."""
    thick = 2e-3
    film = film_space(annulus(30e-3, 50e-3, (8, 24)))
    body = plate_body(PlatePart(20e-3, 60e-3, thick, STEEL), (10, 12, 1))
    found = load_deformation(body, film, FacePressure("top", PRESSURE))
    middle = np.abs(np.hypot(*film.vertices.T) - 40e-3) < 1e-9
    validation(
        case="Plate held on its back",
        source="confined compression",
        quantity="opening in the middle at 30 MPa, 2 mm thick",
        unit="nm",
        expected=1e9 * PRESSURE * thick * 1.3 * 0.4 / (0.7 * 210e9),
        obtained=1e9 * float(np.mean(found[middle])),
        relative_tolerance=1e-4,
        note="linear displacement: exact but for the edges, ten thicknesses away (exp(-10) = 5e-5)",
    )


def grids(cells: tuple[int, int] = (12, 8), across: int = 1) -> PistonWalls:
    """Bushing, so many cells across its wall, and piston, coarse."""
    around, along = cells
    drawn = GUIDE * closer_at_end(np.linspace(0.0, 1.0, along + 1))
    bush = face_grid(bushing_body(BUSHING, (across, 12, 2)), BORE, drawn, around)
    piston = face_grid(piston_body(PISTON, (1, 6, 2)), BORE, even(PISTON.length, along), around)
    return PistonWalls(GUIDE, bush, piston)


def test_film_that_covers_a_part_meets_all_of_it():
    """On the rows of the face itself nothing is lost: the very matrix of the body."""
    walls = grids()
    film = unrolled(walls.bushing.rows)
    stiff = FaceGrid(walls.piston.rows, 0.0 * walls.piston.influence, 0.0 * walls.piston.by_chamber)
    found = PistonWalls(GUIDE, walls.bushing, stiff).at(film, Pose(GUIDE)).matrix
    whole = part_wall(bushing_body(BUSHING, (1, 12, 2)), film).matrix
    assert found == pytest.approx(whole, abs=1e-9 * np.abs(whole).max())


@pytest.mark.parametrize("reach", [0.6 * GUIDE, GUIDE, 1.3 * GUIDE])
def test_work_is_the_same_wherever_the_piston_stands(reach):
    """int p1 w(p2) dA = int p2 w(p1) dA, and never negative: force and deformation pass the same way."""
    walls = grids()
    film = unrolled(np.linspace(max(0.0, GUIDE - reach), GUIDE, 6))
    matrix = walls.at(film, Pose(reach)).matrix
    value, area = film.reference.value, film.area
    at_points = np.zeros((area.size, film.size))
    for local in range(film.dofs.shape[1]):
        rows = np.arange(area.size).reshape(area.shape)
        np.add.at(at_points, (rows, film.dofs[:, local][:, None]), np.broadcast_to(value[:, local], area.shape))
    corners = np.column_stack([film.sample_vertices(column).ravel() for column in matrix.T])
    work = at_points.T @ (area.ravel()[:, None] * corners)
    assert work == pytest.approx(work.T, abs=1e-9 * np.abs(work).max())
    assert np.linalg.eigvalsh(0.5 * (work + work.T)).min() > -1e-9 * np.linalg.norm(work, 2)


def test_bore_under_one_pressure_opens_alike_wherever_the_piston_stands(refine):
    """Film and bare bore at one pressure: Lame's bore, as if no piston stood in it.

    However film and face part the pressure, what they hand on is one: what is left is how far the mesh of the wall
    itself is from a bore that opens alike all along, of the third order at least in its cells across.
    """

    def solve(across: int) -> tuple[float, ...]:
        walls = grids((12, 16), across)
        stiff = FaceGrid(walls.piston.rows, 0.0 * walls.piston.influence, 0.0 * walls.piston.by_chamber)
        alone = PistonWalls(GUIDE, walls.bushing, stiff)
        whole, strays = walls.bushing.influence.sum(axis=(2, 3)).mean(), []
        for reach in (0.37 * GUIDE, 0.8 * GUIDE, GUIDE):
            film = unrolled(np.linspace(GUIDE - reach, GUIDE, 9))
            found = (
                alone.at(film, Pose(reach)).matrix @ np.ones(film.size)
                + alone.by_chamber(film, Pose(reach)).deformation
            )
            strays.append(float(np.abs(found / whole - 1.0).max()))
        return tuple(strays)

    for stray in refine(solve, (1, 2, 4), 3.0):
        assert stray.finest <= stray.tolerance()


@pytest.mark.parametrize("row", [2, 5])
def test_work_of_film_and_chamber_is_that_of_the_face(row):
    """int p w dA over the film + p V of chamber growth: what the bore's whole face takes at that pressure."""
    walls = grids()
    alone = PistonWalls(
        GUIDE, walls.bushing, FaceGrid(walls.piston.rows, 0.0 * walls.piston.influence, 0.0 * walls.piston.by_chamber)
    )
    whole, edge = unrolled(walls.bushing.rows), walls.bushing.rows[row]
    film = unrolled(walls.bushing.rows[row:])

    def falling(space: FilmSpace) -> Array:
        pressure = np.empty(space.size)
        pressure[space.vertex_dofs] = np.minimum(1.0, (GUIDE - space.vertices[:, 1]) / (GUIDE - edge))
        return pressure

    def work(space: FilmSpace, pressure: Array, opened: Array) -> float:
        return float(np.sum(at_points(space, pressure) * space.sample_vertices(opened) * space.area))

    on_film, bare = falling(film), alone.by_chamber(film, Pose(GUIDE - edge))
    opened = alone.at(film, Pose(GUIDE - edge)).matrix @ on_film + bare.deformation
    grown = work(film, on_film, bare.deformation) + bare.chamber_growth
    on_face = falling(whole)
    expected = work(whole, on_face, alone.at(whole, Pose(GUIDE)).matrix @ on_face)
    assert bare.chamber_growth > 0.1 * grown
    assert work(film, on_film, opened) + grown == pytest.approx(expected, rel=1e-9, abs=0.0)


def test_faces_a_piston_cannot_meet():
    walls = grids()
    with pytest.raises(FilmInputError, match=r"7 cells around a film.*12, as around"):
        walls.at(unrolled(np.linspace(0.0, GUIDE, 3), around=7), Pose(GUIDE))
    with pytest.raises(FilmInputError, match="within the part"):
        walls.at(unrolled(np.linspace(0.0, GUIDE, 3)), Pose(0.5 * GUIDE))  # a film beyond the piston's end
    with pytest.raises(FilmInputError, match="within the part"):
        walls.at(unrolled(np.linspace(0.0, GUIDE, 3)), Pose(2.0 * PISTON.length))


def test_pocket_presses_on_slipper_and_plate(tmp_path):
    """A pocket's column is what its face alone does, both walls added; the cheaper form is chosen by size."""
    from gaps import slipper_mesh

    film = film_space(slipper_mesh(((8e-3, 14e-3),), (3, 24)), pockets=["pocket"])
    slipper = slipper_body(SlipperPart(0.5e-3, 8e-3, 7e-3, 14e-3, 5e-3, BRONZE), (6, 12, 1))
    plate = plate_body(PlatePart(0.0, 20e-3, 10e-3, STEEL, pocket_radius=8e-3), (4, 12, 1))
    together = both(*(part_wall(body, film, folder=tmp_path) for body in (slipper, plate))).matrix
    pocket = film.edge_dofs["pocket"][0]
    parts = [part_wall(body, film, folder=tmp_path) for body in (slipper, plate)]
    assert together[:, pocket] == pytest.approx(sum(part.matrix[:, pocket] for part in parts), abs=0.0)
    assert all(part.origin is CacheOrigin.CACHE for part in parts)  # kept from the first time
    radius = np.hypot(*film.vertices.T)
    rim, edge = radius > radius.max() * (1.0 - 1e-9), radius < radius.min() * (1.0 + 1e-9)
    assert parts[1].matrix[edge, pocket].mean() > 5.0 * abs(parts[1].matrix[rim, pocket].mean())  # dents the plate
    assert parts[0].matrix[rim, pocket].mean() > parts[0].matrix[edge, pocket].mean() > 0.0  # turns the flange back
    fine = film_space(annulus(30e-3, 50e-3, (6, 40)))
    small, large = (
        PlatePart(30e-3, 50e-3, 10e-3, STEEL),
        plate_body(PlatePart(30e-3, 50e-3, 10e-3, STEEL), (4, 20, 1)),
    )
    assert isinstance(part_wall(plate_body(small, (2, 8, 1)), fine, folder=tmp_path), FaceWall)
    assert isinstance(part_wall(large, fine, folder=tmp_path), BodyWall)


def test_slipper_bends_alike_on_coarse_films():
    """Films of eight sectors on: a polygon presses on the area of its circle."""
    from gaps import slipper_mesh

    body = slipper_body(SlipperPart(0.5e-3, 8e-3, 7e-3, 14e-3, 5e-3, BRONZE), (6, 12, 1))

    def rim(sectors: int) -> float:
        film = film_space(slipper_mesh(((8e-3, 14e-3),), (3, sectors)), pockets=["pocket"])
        deformation = part_wall(body, film).matrix @ np.ones(film.size)
        radius = np.hypot(*film.vertices.T)
        return float(deformation[radius > radius.max() * (1.0 - 1e-9)].mean())

    finest = rim(48)
    assert [rim(sectors) for sectors in (8, 16, 32)] == pytest.approx([finest] * 3, rel=1e-3, abs=0.0)


def test_grooves_press_on_slipper_and_plate(tmp_path):
    """Lands, groove and pocket at one pressure press as a film without a groove: nothing is left out."""
    from gaps import SlipperLands, slipper_mesh

    grooved, plain = SlipperLands(((8e-3, 10e-3), (11.5e-3, 14e-3))), SlipperLands(((8e-3, 14e-3),))
    for body in (
        slipper_body(SlipperPart(0.5e-3, 8e-3, 7e-3, 14e-3, 5e-3, BRONZE, grooves=grooved.closed_grooves), (9, 24, 1)),
        plate_body(PlatePart(0.0, 20e-3, 10e-3, STEEL, 8e-3, grooves=grooved.closed_grooves), (10, 24, 1)),
    ):
        groove = body_space(body.mesh).face("groove_1").gathered(1.0).sum()
        assert groove == pytest.approx(np.pi * (11.5e-3**2 - 10e-3**2), rel=1e-3)
        found = []
        for lands in (grooved, plain):
            film = film_space(slipper_mesh(lands.radii, (12, 48)), pockets=lands.closed)
            deformation = part_wall(body, film, folder=tmp_path).matrix @ np.full(film.size, PRESSURE)
            radius = np.hypot(*film.vertices.T)
            ends = radius.min(), radius.max()
            found.append([deformation[np.abs(radius - at) < 1e-9].mean() for at in ends])
        assert found[0] == pytest.approx(found[1], rel=0.02)


def test_faces_have_the_areas_of_their_loads():
    """Pocket, socket and chamber: what a pressure on them presses with, to the arcs of 30 degrees."""
    slipper = slipper_body(SlipperPart(0.5e-3, 8e-3, 7e-3, 14e-3, 5e-3, BRONZE), (6, 12, 1))
    plate = plate_body(PlatePart(0.0, 20e-3, 10e-3, STEEL, pocket_radius=8e-3), (4, 12, 1))
    piston = piston_body(PISTON, (1, 12, 2))
    for body, name, area in (
        (slipper, "pocket", np.pi * (8e-3**2 - 0.5e-3**2)),
        (slipper, "held", np.pi * (7e-3**2 - 0.5e-3**2)),
        (plate, "pocket", np.pi * (8e-3**2 - 0.4e-3**2)),
        (piston, "chamber", np.pi * (BORE**2 - 5e-3**2 + 10e-3 * PISTON.length)),
    ):
        assert body_space(body.mesh).face(name).gathered(1.0).sum() == pytest.approx(area, rel=1e-3, abs=0.0), name


@pytest.mark.parametrize(
    ("make", "wanted"),
    [
        (lambda: PistonPart(22e-3, 22e-3, 30e-3, STEEL), "inner diameter"),
        (lambda: PistonPart(22e-3, 0.0, -1.0, STEEL), "length"),
        (lambda: BushingPart(22e-3, 0.0, 30e-3, STEEL), "wall"),
        (lambda: SlipperPart(0.5e-3, 8e-3, 15e-3, 14e-3, 5e-3, STEEL), "socket"),
        (lambda: SlipperPart(0.5e-3, 15e-3, 7e-3, 14e-3, 5e-3, STEEL), "radii that rise"),
        (lambda: PlatePart(50e-3, 50e-3, 5e-3, STEEL), "inner radius"),
    ],
)
def test_parts_that_are_none(make, wanted):
    with pytest.raises(FilmInputError, match=wanted):
        make()
