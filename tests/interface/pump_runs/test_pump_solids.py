"""Solids of the pump's parts: closed surfaces of the pump file's sizes, with the films on them."""

import numpy as np
import pytest
import pyvista

from reynolds.fem.sphere import Sphere
from swashfilm.runs.pump.scene.solids import NECK, Solids
from swashfilm.runs.pump.scene.surfaces import Bores, ring_with_bores
from system import load_pump
from system.description.gap import Gap
from system.films.parts import floating_parts
from system.films.places import place_of
from system.films.rotor import rotor, travel, valve_plate_geometry
from system.pump.lumped import piston_area
from system.pump.operating import operating_point

AROUND = 48
PARTS = ("piston", "slipper", "oil", "block", "valve_plate", "swash_plate", "shaft")
PUMPS = {
    "ref90": {},
    "half stroke": {"operating.displacement_ratio": 0.5},
    "crossed": {"pump.cross_angle": "4 deg", "pump.displacement": "92.42 cm3/rev"},
    "hollow piston": {"piston.bore_diameter": "12 mm"},
    "short overhang": {"piston.overhang": "3 mm"},
    "spherical plate": {"valve_plate.sphere_radius": "120 mm"},
}


def of_regular(sides: int) -> float:
    """Area of a regular polygon over that of its circle."""
    return sides / (2.0 * np.pi) * np.sin(2.0 * np.pi / sides)


def solids_of(stated: dict[str, object]) -> Solids:
    pump = load_pump("ref90", stated)
    return Solids(rotor(pump, operating_point(pump)), floating_parts(pump))


def body(solids, part, angle=0.7):
    of = getattr(solids, part)
    return of(angle) if part in ("piston", "slipper", "oil", "block") else of()


def volume(surface):
    """Volume by the divergence theorem: positive where cells are counterclockwise from outside."""
    a, b, c, d = (surface.points[surface.cells[:, k]] for k in range(4))
    whole = np.einsum("ij,ij->", a, np.cross(b, c)) + np.einsum("ij,ij->", a, np.cross(c, d))
    return float(whole) / 6.0


def mesh_of(surface):
    found = pyvista.PolyData.from_regular_faces(surface.points, surface.cells)
    return found.triangulate().clean(tolerance=1e-9, absolute=True)


@pytest.fixture(scope="module")
def solids():
    return solids_of({})


@pytest.mark.parametrize("stated", PUMPS.values(), ids=PUMPS)
@pytest.mark.parametrize("part", PARTS)
def test_every_surface_is_closed_and_faces_outwards(part, stated):
    surface = body(solids_of(stated), part)
    edges = mesh_of(surface).extract_feature_edges(
        boundary_edges=True, non_manifold_edges=False, feature_edges=False, manifold_edges=False
    )
    assert edges.n_cells == 0
    assert volume(surface) > 0.0


def test_piston_has_the_volume_of_its_cylinder_neck_and_ball(solids):
    pump = solids.rotor.pump
    ball, long, over = pump.slipper.ball_joint_radius, pump.piston.engaged_length, pump.piston.overhang
    neck = NECK * ball
    height = np.sqrt(ball**2 - neck**2)  # of the ball's centre over the neck's end
    segment = np.pi * (ball**2 * (ball + height) - (ball**3 + height**3) / 3.0)
    exact = piston_area(pump) * long + np.pi * neck**2 * (over - height) + segment
    assert volume(solids.piston(0.3)) == pytest.approx(of_regular(AROUND) * exact, rel=2e-3)


def test_hollow_piston_lacks_its_bore(solids):
    hollow, pump = solids_of(PUMPS["hollow piston"]), solids.rotor.pump
    depth = pump.piston.engaged_length - (11e-3 - 6e-3)  # its floor is as thick as its wall
    lacks = volume(solids.piston(0.0)) - volume(hollow.piston(0.0))
    assert lacks == pytest.approx(of_regular(AROUND) * np.pi * 6e-3**2 * depth, rel=1e-9)


def test_block_has_the_volume_of_its_ring_less_bores_and_kidneys(solids):
    pump, (inner, outer), (end, edge) = solids.rotor.pump, solids.block_radii, solids.block_heights
    geometry, ring = valve_plate_geometry(pump), np.pi * (outer**2 - inner**2)
    bores = pump.pump.pistons * piston_area(pump) / np.cos(pump.pump.bore_cone_angle)
    kidneys = pump.pump.pistons * geometry.kidney_area
    exact = (ring - kidneys) * end + (ring - bores) * (edge - end)
    assert volume(solids.block(0.0)) == pytest.approx(exact, rel=3e-3)
    dead = pump.pump.dead_volume / piston_area(pump) + pump.piston.engaged_length
    assert edge == pytest.approx(dead * np.cos(pump.pump.bore_cone_angle))


def test_a_bore_is_round_across_its_axis():
    bores = Bores(5, 11e-3, np.radians(20.0), 40e-3)
    surface = ring_with_bores((20e-3, 60e-3), (0.0, 30e-3), bores)
    wall = surface.points[:32]  # the first bore in the lower face, towards x
    axis, at = np.array([np.sin(bores.cone), 0.0, np.cos(bores.cone)]), wall - [40e-3, 0.0, 0.0]
    assert np.linalg.norm(np.cross(at, axis), axis=1) == pytest.approx(11e-3, rel=1e-12)


def test_valve_plate_is_a_ring_less_its_ports(solids):
    geometry, part = valve_plate_geometry(solids.rotor.pump), solids.parts.block.laws.walls.parts[1]
    _, r2, r3, _ = geometry.land_radii
    ports = sum(end - start for start, end in (*geometry.suction, *geometry.delivery))
    area = np.pi * (part.outer_radius**2 - part.inner_radius**2) - 0.5 * ports * (r3**2 - r2**2)
    assert volume(solids.valve_plate()) == pytest.approx(area * part.thickness, rel=3e-3)


@pytest.mark.parametrize("stated", [PUMPS["ref90"], PUMPS["half stroke"], PUMPS["crossed"]])
def test_oil_in_a_chamber_grows_by_the_pistons_way(stated):
    solids = solids_of(stated)
    way = travel(solids.rotor, 2.0) - travel(solids.rotor, 0.0)
    grows = volume(solids.oil(2.0)) - volume(solids.oil(0.0))
    assert grows == pytest.approx(of_regular(24) * piston_area(solids.rotor.pump) * way, rel=1e-9)


@pytest.mark.parametrize("stated", PUMPS.values(), ids=PUMPS)
@pytest.mark.parametrize("angle", [0.0, 2.0, 4.5])
def test_films_lie_on_the_parts(stated, angle):
    """Nodes of a film are no farther from a part than its facets from their circle; on the plate they lie in it."""
    solids = solids_of(stated)
    pump, radius = solids.rotor.pump, 0.5 * solids.rotor.pump.pump.piston_diameter
    guide = solids.parts.piston.guide_length
    inner = max(0.0, guide - pump.piston.engaged_length + travel(solids.rotor, angle))
    arc, along = np.meshgrid(np.linspace(0.0, 2.0 * np.pi * radius, 25), np.linspace(inner, guide, 5))
    lands = np.linspace(pump.slipper.land_inner_radius, pump.slipper.land_outer_radius, 4)
    ring, turn = np.meshgrid(lands, np.linspace(0.0, 2.0 * np.pi, 25))
    films = {
        Gap.PISTON: np.column_stack([arc.ravel(), along.ravel()]),
        Gap.SLIPPER: np.column_stack([(ring * np.cos(turn)).ravel(), (ring * np.sin(turn)).ravel()]),
    }
    rise = 1.0 - np.cos(np.pi / AROUND)
    for gap, part, reach in (
        (Gap.PISTON, solids.piston(angle), radius),
        (Gap.SLIPPER, solids.slipper(angle), pump.slipper.land_outer_radius),
        (Gap.SLIPPER, solids.swash_plate(), 0.0),
    ):
        nodes = place_of(gap, solids.rotor, solids.parts, angle)(films[gap])
        away = pyvista.PolyData(nodes).compute_implicit_distance(mesh_of(part))["implicit_distance"]
        assert np.abs(away).max() <= 1.001 * rise * reach + 1e-9


def test_block_and_valve_plate_meet_in_the_films_sphere():
    solids = solids_of(PUMPS["spherical plate"])
    sphere = Sphere(0.12)
    x = sphere.stretch(0.05) * 0.05
    place = sphere.in_space(np.array([[x, 0.0]]))[0]
    for part in ("valve_plate", "block"):
        points = body(solids, part, 0.0).points
        level = points[:, 2] + 0.12 - np.sqrt(np.maximum(0.12**2 - points[:, 0] ** 2 - points[:, 1] ** 2, 0.0))
        assert np.count_nonzero(np.abs(level) < 1e-12) > 100
    assert place[2] == pytest.approx(np.sqrt(0.12**2 - 0.05**2) - 0.12)
