"""Rows and columns found in a mesh by walking over its cells."""

import numpy as np
import pytest
import skfem

from reynolds import Cell, FilmMesh, annulus, film_space, rectangle, ring
from reynolds.linear.multigrid.grid import grid_of


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize(
    ("around_x", "around_y", "shape"), [(False, False, (13, 8)), (True, False, (7, 13)), (False, True, (12, 8))]
)
def test_a_rectangle_is_a_grid(cell, around_x, around_y, shape):
    """Lines run from side to side where a film closes on itself, else the shorter way."""
    mesh = rectangle((1.0, 1.0), (7, 12), cell=cell, periodic_x=around_x, periodic_y=around_y)
    space = film_space(mesh)
    grid = grid_of(space)
    assert grid.unknowns.shape == shape
    assert grid.around == (around_x or around_y)
    assert np.array_equal(np.sort(grid.unknowns.ravel()), np.arange(space.size))
    place = np.empty((space.size, 2), dtype=int)
    place[grid.unknowns] = np.moveaxis(np.indices(grid.unknowns.shape), 0, 2)
    apart = np.abs(np.diff(place[space.dofs], axis=1)).max(axis=1)
    assert np.all((apart <= 1) | (apart == np.where([grid.around, False], [shape[0] - 1, 0], 1)))


@pytest.mark.parametrize("cell", list(Cell))
def test_the_lines_of_a_ring_run_across_it(cell):
    grid = grid_of(film_space(annulus(1.0, 2.0, (5, 20), cell=cell)))
    assert grid.unknowns.shape == (20, 6)
    assert grid.around


def test_a_refined_square_is_a_grid_whatever_its_numbering():
    assert grid_of(film_space(FilmMesh(skfem.MeshQuad().refined(4)))).unknowns.shape == (17, 17)


def _holed():
    keep = np.ones((5, 20), dtype=bool)
    keep[2, 3] = False
    return ring(np.linspace(1.0, 2.0, 6), 20, keep=keep)


@pytest.mark.parametrize(
    ("mesh", "posed"),
    [
        (_holed(), {}),
        (rectangle((1.0, 1.0), (7, 12)), {"pockets": ("left",)}),
        (rectangle((1.0, 1.0), (7, 12)), {"degree": 2}),
        (rectangle((1.0, 1.0), (7, 12), periodic_x=True, periodic_y=True), {}),
        (rectangle((1.0, 1.0), (2, 5), cell=Cell.QUADRILATERAL, periodic_x=True), {}),
        (rectangle((1.0, 1.0), (1, 5), cell=Cell.QUADRILATERAL, periodic_x=True), {}),
        (FilmMesh(skfem.MeshTri().refined(3)), {}),
        (FilmMesh(skfem.MeshTri.init_lshaped()), {}),
        (FilmMesh(skfem.MeshQuad.init_tensor(np.arange(3.0), np.arange(4.0)).remove_elements(np.array([0]))), {}),
    ],
    ids=[
        "hole",
        "pocket",
        "quadratic",
        "closed both ways",
        "two cells round",
        "one cell round",
        "no halves",
        "L, halves",
        "L",
    ],
)
def test_what_is_no_grid_is_told_apart(mesh, posed):
    assert grid_of(film_space(mesh, **posed)) is None
