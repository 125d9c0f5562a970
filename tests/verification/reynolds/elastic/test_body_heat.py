"""Heat in bodies and their expansion.

Closed forms of steady conduction and of free thermal expansion (Boley and Weiner 1960).
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    Body,
    Cylinder,
    Elastic,
    FilmInputError,
    Plane,
    Side,
    Supports,
    block,
    body_space,
    face_normals,
    film_space,
    heated_wall,
    hollow_cylinder,
    rectangle,
    section,
    structure,
)
from reynolds.bodies.conduction import (
    Convection,
    HeldTemperature,
    Thermal,
    face_expansion,
    face_temperature,
    heated_body,
    temperature_deformation,
)

STEEL = Elastic(210e9, 0.3)
WARM = Thermal(conductivity=45.0, expansion=12e-6, unstrained_temperature=20.0)
FLUX = 2e4


def test_wall_with_convection(tmp_path, validation):
    """T = T_ambient + q (1/h + t/k)."""
    size = (10e-3, 8e-3, 3e-3)
    body = Body(block(size, (2, 2, 1)), STEEL, Supports(), "top", Plane((0.0, 0.0, 1.0), origin=(0.0, 0.0, size[2])))
    film = film_space(rectangle(size[:2], (6, 4)))  # three and two cells to a facet: nothing lies across
    found = heated_wall(body, film, WARM, {"bottom": Convection(800.0, 40.0)}, folder=tmp_path).temperature
    warm = found.reference + found.matrix @ np.full(len(film.vertices), FLUX)
    exact = 40.0 + FLUX * (1.0 / 800.0 + size[2] / WARM.conductivity)
    assert np.ptp(warm) < 1e-9
    validation(
        case="Heat through a plane wall with convection",
        source="closed form q (1/h + t/k)",
        quantity="temperature of the surface",
        unit="degC",
        expected=exact,
        obtained=float(warm.mean()),
        relative_tolerance=1e-10,
        note="linear temperature: exact",
    )


@pytest.mark.parametrize("kind", ["ring", "section"])
def test_bore_with_convection(kind, validation, refine):
    """T = T_ambient + q a (1/(h b) + ln(b/a)/k)."""
    a, b, length = 10e-3, 16e-3, 12e-3

    def solve(n: int) -> float:
        radii = (a, b)
        mesh = hollow_cylinder(radii, length, (n, 6 * n, 1)) if kind == "ring" else section(radii, length, (2 * n, 1))
        space = body_space(mesh)
        face = space.face("inner")
        found = face_temperature(heated_body(space, WARM, {"outer": Convection(800.0, 40.0)}), face)
        return float(np.mean(found.reference + found.matrix @ (FLUX * face.gathered(1.0))))

    found = refine(solve, (1, 2, 4), 3.5)
    validation(
        case="Heat through a thick-walled bore with convection",
        source="closed form q a (1/(h b) + ln(b/a)/k)",
        quantity=f"mean temperature of the bore, {kind}",
        unit="degC",
        expected=40.0 + FLUX * a * (1.0 / (800.0 * b) + np.log(b / a) / WARM.conductivity),
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


def test_resistance_is_symmetric_and_heat_is_conserved():
    """Reciprocity; and a body that is cooled at one temperature gives off there what it takes in."""
    space = body_space(block((10e-3, 8e-3, 3e-3), (2, 2, 1)))
    face = space.face("top")
    body = heated_body(space, WARM, {"bottom": Convection(800.0, 40.0), "left": HeldTemperature(40.0)})
    found = face_temperature(body, face)
    assert np.array_equal(found.matrix, found.matrix.T)
    assert found.reference == pytest.approx(np.full(len(face.nodes), 40.0))
    only = heated_body(space, WARM, {"bottom": Convection(800.0, 40.0)})
    heat = np.zeros((len(space.places), 1))
    heat[face.nodes, 0] = np.random.default_rng(5).uniform(0.0, 1.0, len(face.nodes))
    floor = space.face("bottom")
    given_off = 800.0 * floor.gathered(1.0) @ only.warmed(heat)[floor.nodes, 0]
    assert given_off == pytest.approx(heat.sum(), rel=1e-12)


@pytest.mark.parametrize("kind", ["bore", "shaft", "section", "plate"])
def test_free_expansion(kind, validation):
    """Evenly warm by dT, a free body grows by alpha dT about its middle: bores open, shafts close their film."""
    rise, strain = 30.0, WARM.expansion * 30.0
    a, b, length = 10e-3, 16e-3, 12e-3
    mesh, name, chart, expected = {
        "bore": (hollow_cylinder((a, b), length, (1, 8, 1)), "inner", Cylinder(a, Side.BORE), strain * a),
        "shaft": (hollow_cylinder((a, b), length, (1, 8, 1)), "outer", Cylinder(b, Side.SHAFT), -strain * b),
        "section": (section((a, b), length, (1, 1)), "inner", Cylinder(a, Side.BORE), strain * a),
        "plate": (block((a, b, length), (1, 2, 1)), "top", Plane((0.0, 0.0, 1.0)), -strain * length / 2.0),
    }[kind]
    space = body_space(mesh)
    face = space.face(name)
    normals = face_normals(chart, face.places)
    free = structure(space, STEEL, Supports())
    found = temperature_deformation(free, face, normals, WARM.expansion, np.full(len(space.places), rise))
    validation(
        case="Free thermal expansion",
        source="closed form alpha dT x size",
        quantity=f"opening, {kind}",
        unit="um",
        expected=1e6 * expected,
        obtained=1e6 * float(found.mean()),
        relative_tolerance=3e-4 if kind in ("bore", "shaft") else 1e-9,
        note="face middles on parabolas through arcs of 45 deg" if kind in ("bore", "shaft") else "exact",
    )


def test_bowed_plate(validation):
    """A free plate warm on one side bows without stress to curvature alpha dT/t: u_z = g (z^2 - x^2 - y^2)/2."""
    size, hot = (20e-3, 16e-3, 4e-3), 30.0
    space = body_space(block(size, (2, 2, 1), origin=(-size[0] / 2, -size[1] / 2, -size[2] / 2)))
    face = space.face("top")
    surroundings = {"top": HeldTemperature(20.0 + hot), "bottom": HeldTemperature(20.0 - hot)}
    heated = heated_body(space, WARM, surroundings)
    normals = np.tile([0.0, 0.0, 1.0], (len(face.nodes), 1))
    found = face_expansion(heated, structure(space, STEEL, Supports()), face, normals).reference
    curvature = WARM.expansion * 2.0 * hot / size[2]
    x, y, z = face.places.T
    middle = (size[2] ** 2 - size[0] ** 2 - size[1] ** 2) / 12.0  # mean of z^2 - x^2 - y^2: no rigid part
    exact = -0.5 * curvature * (z**2 - x**2 - y**2 - middle)
    validation(
        case="Plate bowed by a difference of temperature",
        source="Boley and Weiner 1960, curvature alpha dT/t",
        quantity="largest error of the opening / largest opening",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(found - exact).max() / np.abs(exact).max()),
        tolerance=1e-8,
        note="quadratic displacement: exact",
    )


def test_expansion_matrix_is_that_of_its_temperatures():
    """Column by column: heat, temperature of the whole body, deformation; the adjoint gives the same."""
    space = body_space(block((10e-3, 8e-3, 3e-3), (2, 1, 1)))
    face = space.face("top")
    normals = np.tile([0.0, 0.0, 1.0], (len(face.nodes), 1))
    heated = heated_body(space, WARM, {"bottom": Convection(800.0, 40.0)})
    free = structure(space, STEEL, Supports())
    matrix = face_expansion(heated, free, face, normals).matrix
    heat = np.zeros((len(space.places), 1))
    heat[face.nodes, 0] = np.random.default_rng(6).uniform(0.0, 1.0, len(face.nodes))
    direct = temperature_deformation(free, face, normals, WARM.expansion, heated.warmed(heat)[:, 0])
    assert matrix @ heat[face.nodes, 0] == pytest.approx(direct, rel=1e-9, abs=1e-9 * np.abs(direct).max())


def test_errors():
    space = body_space(block((1.0, 1.0, 1.0), (1, 1, 1)))
    with pytest.raises(FilmInputError, match="no face that heat leaves by"):
        heated_body(space, WARM, {})
    with pytest.raises(FilmInputError, match="no such face"):
        heated_body(space, WARM, {"lid": HeldTemperature(20.0)})
    with pytest.raises(FilmInputError, match="coefficient 0"):
        Convection(0.0, 20.0)
    with pytest.raises(FilmInputError, match="conductivity"):
        Thermal(-1.0, 0.0, 20.0)
