"""Rows and columns found in a mesh by walking over its cells."""

import numpy as np
import pytest
import skfem

from reynolds.grid import grid_of
from reynolds.mesh import Cell, FilmMesh, annulus, rectangle, ring
from reynolds.space import film_space


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("around_x", [False, True])
@pytest.mark.parametrize("around_y", [False, True])
def test_a_rectangle_is_a_grid(cell, around_x, around_y):
    """Rows run along the numbering, which is up the rectangle: grid columns are its y."""
    mesh = rectangle((1.0, 1.0), (7, 12), cell=cell, periodic_x=around_x, periodic_y=around_y)
    space = film_space(mesh)
    grid = grid_of(space)
    assert (grid.rows, grid.columns) == (8 - around_x, 13 - around_y)
    assert (grid.around_y, grid.around_x) == (around_x, around_y)
    assert np.array_equal(np.sort(grid.unknowns.ravel()), np.arange(space.size))
    place = np.empty((space.size, 2), dtype=int)
    place[grid.unknowns] = np.moveaxis(np.indices(grid.unknowns.shape), 0, 2)
    apart = np.abs(np.diff(place[space.dofs], axis=1)).max(axis=1)
    shape = np.where([around_x, around_y], [grid.rows - 1, grid.columns - 1], 1)
    assert np.all((apart <= 1) | (apart == shape))


@pytest.mark.parametrize("cell", list(Cell))
def test_a_ring_is_a_grid_closed_along_its_rows(cell):
    grid = grid_of(film_space(annulus(1.0, 2.0, (5, 20), cell=cell)))
    assert (grid.rows, grid.columns, grid.around_x, grid.around_y) == (6, 20, True, False)


def test_a_refined_square_is_a_grid_whatever_its_numbering():
    grid = grid_of(film_space(FilmMesh(skfem.MeshQuad().refined(4))))
    assert (grid.rows, grid.columns) == (17, 17)


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
        (rectangle((1.0, 1.0), (2, 5), cell=Cell.QUADRILATERAL, periodic_x=True), {}),
        (rectangle((1.0, 1.0), (1, 5), cell=Cell.QUADRILATERAL, periodic_x=True), {}),
        (FilmMesh(skfem.MeshTri().refined(3)), {}),
        (FilmMesh(skfem.MeshTri.init_lshaped()), {}),
        (FilmMesh(skfem.MeshQuad.init_tensor(np.arange(3.0), np.arange(4.0)).remove_elements(np.array([0]))), {}),
    ],
    ids=["hole", "pocket", "quadratic", "two cells round", "one cell round", "no halves", "L, halves", "L"],
)
def test_what_is_no_grid_is_told_apart(mesh, posed):
    assert grid_of(film_space(mesh, **posed)) is None
