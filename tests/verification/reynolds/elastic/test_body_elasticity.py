"""Elastic bodies.

Closed forms of linear elasticity: Lame 1852, Timoshenko and Goodier 1951, Timoshenko and Woinowsky-Krieger 1959.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    BodyMesh,
    Elastic,
    FilmInputError,
    Supports,
    block,
    body_space,
    disc,
    hollow_cylinder,
    rigid_motions,
    section,
    structure,
)
from reynolds.bodies.elasticity import centrifugal_forces, face_compliance, pressure_forces, stiffness
from reynolds.bodies.space import BodySpace

STEEL = Elastic(210e9, 0.3)
BORE, OUTSIDE, PRESSURE = 10e-3, 16e-3, 30e6
BETWEEN_PLANES = Supports(symmetry=("bottom", "top"))


def _radial(space: BodySpace, face: str, displaced: np.ndarray) -> float:
    """Mean displacement (m) of a face away from the axis."""
    found = space.face(face)
    moved = displaced.reshape(-1, space.dim)[found.nodes]
    if space.dim == 2:
        return float(np.mean(moved[:, 0]))
    out = found.places[:, :2] / np.hypot(*found.places[:, :2].T)[:, None]
    return float(np.sum(moved[:, :2] * out, axis=1) @ found.gathered(1.0) / found.gathered(1.0).sum())


def _bore(body: BodyMesh, supports: Supports) -> float:
    space = body_space(body)
    forces = pressure_forces(space, space.face("inner"), PRESSURE)
    return 1e6 * _radial(space, "inner", structure(space, STEEL, supports).displaced(forces[:, None]))


@pytest.mark.parametrize(
    ("state", "supports", "lame"), [("plane stress", Supports(), 3.688645), ("plane strain", BETWEEN_PLANES, 3.523810)]
)
@pytest.mark.parametrize("kind", ["ring", "sector", "section"])
def test_lame_bore(kind, state, supports, lame, validation, refine):
    """A free ring is in plane stress whatever its length; one between sliding planes in plane strain."""

    def solve(n: int) -> float:
        radii, length = (BORE, OUTSIDE), 5e-3
        if kind == "ring":
            return _bore(hollow_cylinder(radii, length, (n, 6 * n, 1)), supports)
        if kind == "section":
            return _bore(section(radii, length, (n, n)), supports)
        sides = Supports(symmetry=("start", "end", *supports.symmetry))
        return _bore(hollow_cylinder(radii, length, (n, n, 1), angles=(0.3, 1.2)), sides)

    found = refine(solve, (2, 4, 8) if kind == "section" else (1, 2, 4), 3.5)
    validation(
        case="Thick-walled bore under pressure",
        source="Lame, closed form",
        quantity=f"radial displacement of the bore, {state}, {kind}",
        unit="um",
        expected=lame,
        obtained=found.finest,
        tolerance=found.tolerance(rounding=0.5e-6),
        order=found.order,
    )


@pytest.mark.parametrize("body", [disc(10e-3, 20e-3, (2, 1, 2)), section((0.0, 10e-3), 20e-3, (2, 2))])
def test_solid_piston(body, validation):
    space = body_space(body)
    forces = pressure_forces(space, space.face("outer"), PRESSURE)
    found = _radial(space, "outer", structure(space, STEEL, Supports()).displaced(forces[:, None]))
    validation(
        case="Solid piston under pressure",
        source="closed form, -p R (1 - nu)/E",
        quantity=f"radial displacement, {'section' if body.axisymmetric else 'hexahedra'}",
        unit="um",
        expected=-1.0,
        obtained=1e6 * found,
        relative_tolerance=1e-4 if not body.axisymmetric else 1e-9,
        note="uniform stress; hexahedra by parabolic arcs of 45 deg" if not body.axisymmetric else "uniform stress",
    )


def test_patch(validation):
    """Uniform tension of a block with its inner nodes displaced: no element sees anything but that stress."""
    body = block((2.0, 1.0, 1.5), (3, 2, 2))
    mesh = body.mesh
    places = mesh.doflocs.copy()
    corners = np.arange(mesh.nvertices)
    inside = corners[np.all((places[:, corners].T > 1e-9) & (places[:, corners].T < [1.999, 0.999, 1.499]), axis=1)]
    places[:, inside] += 0.1 * np.random.default_rng(1).uniform(-1.0, 1.0, (3, len(inside)))
    straight = type(mesh).from_mesh(_linear(mesh, places))
    crooked = BodyMesh(straight.with_boundaries({name: mesh.boundaries[name] for name in body.face_names}))
    space = body_space(crooked)
    held = structure(space, STEEL, Supports(symmetry=("left", "front", "bottom")))
    moved = held.displaced(pressure_forces(space, space.face("right"), -PRESSURE)[:, None]).reshape(-1, 3)
    strain = PRESSURE / STEEL.youngs_modulus
    exact = space.places * strain * np.array([1.0, -0.3, -0.3])
    validation(
        case="Patch test",
        source="uniform tension, Irons 1966",
        quantity="largest error of displacement / largest displacement",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(moved - exact).max() / np.abs(exact).max()),
        tolerance=1e-10,
        note="distorted straight hexahedra, round-off",
    )


def _linear(mesh, places):
    import skfem

    return skfem.MeshHex1(np.ascontiguousarray(places[:, : mesh.nvertices]), mesh.t)


@pytest.mark.parametrize(
    "body",
    [
        hollow_cylinder((BORE, OUTSIDE), 5e-3, (1, 5, 1)),
        disc(5e-3, 4e-3, (2, 1, 1)),
        section((0.0, 1e-2), 1e-2, (2, 2)),
    ],
)
def test_rigid_motion_costs_no_energy(body):
    space = body_space(body)
    matrix, rigid = stiffness(space, STEEL), rigid_motions(space)
    assert np.abs(matrix @ rigid).max() < 1e-10 * np.abs(matrix).max()
    free = structure(space, STEEL, Supports())
    assert free.motions.shape[1] == rigid.shape[1]
    # Pushed on one side only, the body stays where it is in the mean.
    moved = free.displaced(pressure_forces(space, space.face("top"), PRESSURE)[:, None])
    still = free.inertia.T @ moved
    assert np.abs(still).max() < 1e-9 * np.abs(free.inertia).sum(axis=0).max() * np.abs(moved).max()


def test_inertia_relief(validation):
    """A bar pushed at one end by sigma is uniformly accelerated: sigma(z) = -p z/L, of which u follows."""
    length = 8e-3
    space = body_space(block((1e-3, 1e-3, length), (1, 1, 4)))
    free = structure(space, Elastic(210e9, 0.0), Supports())
    moved = free.displaced(pressure_forces(space, space.face("top"), PRESSURE)[:, None]).reshape(-1, 3)[:, 2]
    z = space.places[:, 2] / length
    exact = -PRESSURE * length / 210e9 * (0.5 * z**2 - 1.0 / 6.0)
    validation(
        case="Accelerated bar",
        source="closed form, mean displacement zero",
        quantity="largest error of u E/(p L)",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(moved - exact).max() * 210e9 / (PRESSURE * length)),
        tolerance=1e-10,
        note="quadratic displacement: exact",
    )


@pytest.mark.parametrize("slender", [0.1, 0.05])
def test_clamped_plate(slender, validation, refine):
    """Kirchhoff's p a^4/(64 D) plus the shear deflection 0.3 p a^2/(G t) (Mindlin, kappa = 5/6)."""
    radius, pressure = 0.1, 1e5
    thick = slender * radius

    def solve(n: int) -> float:
        space = body_space(section((0.0, radius), thick, (4 * n, n)))
        held = structure(space, STEEL, Supports(clamped=("outer",)))
        moved = held.displaced(pressure_forces(space, space.face("top"), pressure)[:, None]).reshape(-1, 2)
        middle = np.argmin(np.hypot(space.places[:, 0], space.places[:, 1] - 0.5 * thick))
        return float(-moved[middle, 1] / bending)

    bending = pressure * radius**4 / 64.0 * 12.0 * (1.0 - 0.3**2) / (STEEL.youngs_modulus * thick**3)
    shear = 0.3 * pressure * radius**2 / (STEEL.lame[1] * thick) / bending
    found = refine(solve, (2, 4, 8), 1.0)
    validation(
        case="Clamped circular plate under uniform pressure",
        source="Timoshenko and Woinowsky-Krieger 1959, with Mindlin's shear",
        quantity=f"deflection of the middle / Kirchhoff's, thickness/radius {slender:g}",
        unit="1",
        expected=1.0 + shear,
        obtained=found.finest,
        tolerance=found.tolerance() + 0.25 * shear,
        order=found.order,
        note="tolerance: mesh, and a quarter of the shear deflection (plate theory against the solid)",
    )


def test_thin_plate_does_not_lock(validation, refine):
    """One layer of crooked hexahedra, thickness/radius 1/50."""
    radius, thick, pressure = 0.1, 0.002, 1e4

    def solve(n: int) -> float:
        space = body_space(disc(radius, thick, (n, n, 1)))
        held = structure(space, STEEL, Supports(clamped=("outer",)))
        moved = held.displaced(pressure_forces(space, space.face("top"), pressure)[:, None]).reshape(-1, 3)
        return float(-moved[np.argmin(np.linalg.norm(space.places, axis=1)), 2] / bending)

    bending = pressure * radius**4 / 64.0 * 12.0 * (1.0 - 0.3**2) / (STEEL.youngs_modulus * thick**3)
    shear = 0.3 * pressure * radius**2 / (STEEL.lame[1] * thick) / bending
    found = refine(solve, (2, 4, 8), 1.0)
    validation(
        case="Clamped circular plate under uniform pressure",
        source="Timoshenko and Woinowsky-Krieger 1959, with Mindlin's shear",
        quantity="deflection of the middle / Kirchhoff's, thickness/radius 0.02, one layer of hexahedra",
        unit="1",
        expected=1.0 + shear,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
        note="an element that locks is off by several times",
    )


@pytest.mark.parametrize(
    ("state", "supports", "modulus", "poisson"), [("plane strain", BETWEEN_PLANES, 210e9 / (1.0 - 0.09), 0.3 / 0.7)]
)
def test_turning_ring(state, supports, modulus, poisson, validation, refine):
    density, speed, (a, b) = 7850.0, 1000.0, (BORE, OUTSIDE)

    def solve(n: int) -> float:
        space = body_space(section((a, b), 5e-3, (n, 1)))
        forces = centrifugal_forces(space, density, speed)
        return 1e9 * _radial(space, "inner", structure(space, STEEL, supports).displaced(forces[:, None]))

    ratio = (1.0 + poisson) / (1.0 - poisson) * b**2 - (1.0 + poisson) / (3.0 + poisson) * a**2
    exact = (3.0 + poisson) * (1.0 - poisson) * density * speed**2 * a / (8.0 * modulus) * (a**2 + b**2 + ratio)
    found = refine(solve, (2, 4, 8), 3.5)
    validation(
        case="Ring turning about its axis",
        source="Timoshenko and Goodier 1951",
        quantity=f"radial displacement of the bore, {state}",
        unit="nm",
        expected=1e9 * exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("supports", [Supports(), Supports(clamped=("bottom",)), Supports(points=((0.0, 0.0, 0.0),))])
def test_compliance_is_symmetric(supports):
    """Maxwell's reciprocity, and never negative work."""
    space = body_space(block((10e-3, 8e-3, 3e-3), (4, 3, 1)))
    face = space.face("top")
    normals = np.tile([0.0, 0.0, 1.0], (len(face.nodes), 1))
    held = structure(space, STEEL, supports)
    found = face_compliance(held, face, normals)
    assert np.array_equal(found, found.T)
    assert np.linalg.eigvalsh(found).min() > -1e-9 * np.linalg.norm(found, 2)
    into = np.zeros((space.places.size, 1))
    into[3 * face.nodes[3] + 2] = -1.0
    assert held.displaced(into)[3 * face.nodes + 2, 0] == pytest.approx(-found[:, 3], rel=1e-6, abs=1e-14)


def test_errors():
    space = body_space(block((1.0, 1.0, 1.0), (1, 1, 1)))
    with pytest.raises(FilmInputError, match=r"no such face.*back, bottom"):
        structure(space, STEEL, Supports(clamped=("lid",)))
    with pytest.raises(FilmInputError, match="from any node"):
        structure(space, STEEL, Supports(points=((5.0, 0.0, 0.0),)))
    with pytest.raises(FilmInputError, match=r"E = -1 Pa"):
        Elastic(-1.0, 0.3)
    with pytest.raises(FilmInputError, match=r"nu = 0\.5"):
        Elastic(1.0, 0.5)
    with pytest.raises(FilmInputError, match="its own axis"):
        centrifugal_forces(body_space(section((0.0, 1.0), 1.0, (1, 1))), 1.0, 1.0, (1.0, 0.0))
