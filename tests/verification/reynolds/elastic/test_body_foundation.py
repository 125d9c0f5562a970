"""Elastic walls without a mesh: Winkler's springs and the elastic half-space.

Boussinesq 1885, Love 1929, Johnson 1985.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import Cell, Elastic, FilmInputError, annulus, both, film_space, half_space, rectangle, winkler

STEEL = Elastic(210e9, 0.3)
PRESSURE = 30e6


@pytest.mark.parametrize("degree", [1, 2])
def test_winkler_is_pointwise(degree):
    """opening = p/k at each vertex, pockets and seams included."""
    film = film_space(rectangle((1e-2, 5e-3), (4, 3), periodic_x=True), degree=degree, pockets=("top",))
    pressure = np.random.default_rng(1).uniform(0.0, PRESSURE, film.size)
    assert winkler(film, 1e13).matrix @ pressure == pytest.approx(pressure[film.vertex_dofs] / 1e13, rel=1e-14)


@pytest.mark.parametrize("cell", list(Cell))
def test_love_rectangle(cell, validation):
    """Uniform pressure on a x b: middle and corner, exact on any mesh."""
    a, b = 10e-3, 4e-3
    film = film_space(rectangle((a, b), (6, 4), cell=cell))
    opening = half_space(film, STEEL).matrix @ np.full(film.size, PRESSURE)
    corner = (1.0 - 0.09) * PRESSURE / (np.pi * 210e9) * (a * np.arcsinh(b / a) + b * np.arcsinh(a / b))
    x, y = film.vertices.T
    for place, at, exact in (
        ("middle", np.argmin(np.hypot(x - a / 2, y - b / 2)), 2.0 * corner),
        ("corner", np.argmin(np.hypot(x, y)), corner),
    ):
        validation(
            case="Half-space under a uniformly pressed rectangle",
            source="Love 1929, closed form",
            quantity=f"displacement at the {place}, {cell.value}",
            unit="um",
            expected=1e6 * exact,
            obtained=1e6 * float(opening[at]),
            relative_tolerance=1e-12,
            note="uniform pressure: exact",
        )


def test_pressed_ring(validation, refine):
    """Uniform pressure between two radii, at the inner edge: the difference of two discs (Johnson 1985, 3.4)."""
    inner, outer = 4e-3, 8e-3

    def solve(n: int) -> float:
        film = film_space(annulus(inner, outer, (n, 6 * n)))
        opening = half_space(film, STEEL).matrix @ np.full(film.size, PRESSURE)
        return 1e6 * float(opening[np.argmin(np.hypot(*(film.vertices - [inner, 0.0]).T))])

    from scipy.special import ellipe

    factor = 4.0 * (1.0 - 0.09) * PRESSURE / (np.pi * 210e9)
    exact = factor * (outer * ellipe((inner / outer) ** 2) - inner * ellipe(1.0))
    found = refine(solve, (4, 8, 16), 1.5)
    validation(
        case="Half-space under a uniformly pressed ring",
        source="Johnson 1985, complete elliptic integrals",
        quantity="displacement at the inner edge",
        unit="um",
        expected=1e6 * exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
        note="error of the polygons for circles",
    )


def test_reciprocity_improves_with_the_mesh():
    """The half-space is symmetric in mean square but for the error of the mesh."""

    def unevenness(n: int) -> float:
        film = film_space(rectangle((10e-3, 10e-3), (n, n), cell=Cell.QUADRILATERAL))
        x, y = film.vertices.T
        p, q = np.empty((2, film.size))
        p[film.vertex_dofs], q[film.vertex_dofs] = x, y**2
        matrix = half_space(film, STEEL).matrix

        def work(one: np.ndarray, two: np.ndarray) -> float:
            at = film.sample_vertices(matrix @ one) * film.sample_vertices(two[film.vertex_dofs])
            return float(np.sum(at * film.area))

        return abs(work(p, q) / work(q, p) - 1.0)

    assert unevenness(8) < 0.01
    assert unevenness(16) < 0.5 * unevenness(8)


def test_both_walls_add_up():
    film = film_space(rectangle((10e-3, 4e-3), (3, 2)))
    soft, deep = winkler(film, 1e13), half_space(film, STEEL)
    assert both(soft, soft).matrix.toarray() == pytest.approx(2.0 * soft.matrix.toarray())
    assert both(soft, deep).matrix == pytest.approx(soft.matrix.toarray() + deep.matrix)
    assert both(deep, soft).matrix == pytest.approx(both(soft, deep).matrix)


def test_errors():
    film = film_space(rectangle((10e-3, 4e-3), (3, 2), periodic_x=True))
    with pytest.raises(FilmInputError, match=r"0 Pa/m"):
        winkler(film, 0.0)
    with pytest.raises(FilmInputError, match="seam"):
        half_space(film, STEEL)
