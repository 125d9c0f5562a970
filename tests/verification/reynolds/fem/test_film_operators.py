"""Film equation: the operators of the balance against each other, on every kind of element.

What a full film needs is summed without matrices; it must be what the matrices give.
"""

from __future__ import annotations

import numpy as np
import pytest
import skfem
from scipy.spatial import Delaunay

from reynolds import Cavitation, Cell, FilmMesh, FilmProblem, FilmSpace, Held, annulus, film, film_space, rectangle
from reynolds.equation.balance import FilmState, Operators, operators, steep_gradient
from reynolds.equation.hourglass import saved_heat

SIZE = (0.02, 0.013)
SPACES = {
    f"{cell.value}, degree {degree}": film_space(rectangle(SIZE, (7, 5), cell=cell, periodic_x=True), degree=degree)
    for cell in Cell
    for degree in (1, 2)
} | {
    "pocket": film_space(rectangle(SIZE, (7, 5), cell=Cell.QUADRILATERAL), pockets=("bottom",)),
    "ring": film_space(annulus(5e-3, 9e-3, (3, 14))),
}
ROUND_OFF = 1e-13  # of the flows that meet: some ten products and sums


def _operators(space: FilmSpace) -> Operators:
    """Of a film that waves and jumps between walls that turn and close."""
    x, y = space.points / SIZE[0]
    thickness = 1e-5 * (1.0 + 0.4 * np.cos(7.0 * x) * np.sin(5.0 * y)) * np.where(x > 0.5, 1.0, 3.0)
    walls = (3.0 - 200.0 * y, 1.0 + 200.0 * x)
    posed = film(thickness, 0.03, velocity_moving=walls, squeeze=1e-3 * (1.0 + x))
    held = {name: Held(0.0) for name in space.film_mesh.boundary_names[-1:]}
    problem = FilmProblem(space, posed, held, Cavitation.JFO)
    return operators(problem, FilmState(np.zeros(space.size), np.ones(space.size), np.zeros(len(space.vertices))))


@pytest.mark.parametrize("kind", sorted(SPACES))
def test_full_film_is_the_rows_of_the_matrix(kind):
    """- int h U . grad f_i = sum_j C_ij, since the basis sums to one; magnitudes are no less than the sum."""
    parts = _operators(SPACES[kind])
    pattern = parts.problem.space.pattern
    upper, lower = parts.convection
    off = pattern.indices != pattern.columns
    rows = np.bincount(pattern.indices, weights=upper) + np.bincount(
        pattern.columns[off], weights=lower[off], minlength=parts.problem.space.size
    )
    net, flow_scale = parts.full
    assert np.abs(net - parts.rate - rows).max() <= ROUND_OFF * flow_scale.max()
    assert np.all(np.abs(net) <= flow_scale * (1.0 + ROUND_OFF))


@pytest.mark.parametrize("kind", sorted(SPACES))
def test_conductance_spends_what_pressure_drives(kind):
    """p . K p = int h^3/(12 mu) |grad p|^2, and a uniform pressure drives nothing."""
    parts = _operators(SPACES[kind])
    space = parts.problem.space
    rng = np.random.default_rng(3)
    pressure = rng.uniform(-1e6, 1e6, space.size)
    full = np.zeros((space.size, space.size))
    full[space.pattern.indices, space.pattern.columns] = parts.stiffness
    full += np.triu(full, 1).T
    x, y = steep_gradient(space, pressure)
    spent = np.sum(parts.transport.conductance[0] * (x * x + y * y) * space.steep_area)
    spent -= saved_heat(space, parts.transport.conductance, pressure).sum()
    assert pressure @ full @ pressure == pytest.approx(spent, rel=1e-12)
    assert np.abs(full.sum(axis=1)).max() <= ROUND_OFF * np.abs(full).max()


@pytest.mark.parametrize("kind", sorted(SPACES))
def test_lumped_fields_keep_their_integral(kind):
    space = SPACES[kind]
    x, y = space.points
    field = 1.0 + x / SIZE[0] + 2.0 * y / SIZE[1]
    assert space.lumped(field).sum() == pytest.approx(np.sum(field * space.area), rel=1e-13)
    assert space.lumped(np.full((1, 1), 2.0)) == pytest.approx(space.lumped(np.full(space.area.shape, 2.0)))


def test_every_triangle_of_a_large_graded_mesh_has_its_own_tensors():
    """60 000 triangles that grow from 1 um to 1 mm: the slope of x by the tensors is one in each."""
    rng, count = np.random.default_rng(0), 30_000
    places = 10.0 ** rng.uniform(-5.0, -2.0, count) * np.exp(2j * np.pi * rng.random(count))
    points = np.array([places.real, places.imag])
    cells = np.ascontiguousarray(Delaunay(points.T).simplices.T)
    space = film_space(FilmMesh(skfem.MeshTri(points, cells)))
    slopes = space.tensors.gradient[space.tensors.shape, :, :, 0] / space.area[:, :, None]
    along = np.einsum("cpi,ci->cp", slopes, space.vertices[space.cells][:, :, 0])
    np.testing.assert_allclose(along, 1.0, rtol=1e-9)
