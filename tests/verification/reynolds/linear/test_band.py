"""Elimination in a narrow band, against numpy's of the same matrix; the order of unknowns that makes it narrow."""

import numpy as np
import pytest
from scipy.sparse import csr_array

from reynolds import Cell, FilmSpace, film_space, rectangle, ring
from reynolds.linear.band import BandedFactor, banded
from reynolds.linear.band_ordering import line_order
from reynolds.linear.factor import GeneralFactor


def strip() -> FilmSpace:
    return film_space(rectangle((1.0, 1.0), (30, 9), cell=Cell.QUADRILATERAL))


def around() -> FilmSpace:
    return film_space(rectangle((1.0, 1.0), (30, 9), cell=Cell.TRIANGLE, periodic_x=True))


def pocket() -> FilmSpace:
    return film_space(ring(np.linspace(1.0, 2.0, 8), 30), pockets=("inner",))


def holes() -> FilmSpace:
    keep = np.ones((6, 32), dtype=bool)
    keep[2:4, np.arange(32) % 8 < 4] = False
    return film_space(ring(np.linspace(1.0, 2.0, 7), 32, keep=keep))


def pieces() -> FilmSpace:
    keep = np.ones((6, 32), dtype=bool)
    keep[:, [0, 11]] = False
    return film_space(ring(np.linspace(1.0, 2.0, 7), 32, keep=keep))


SPACES = [strip, around, pocket, holes, pieces]


def carried(space: FilmSpace) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Upper triangle and mirror, entries of any size, columns dominated by their diagonal; the dense matrix."""
    rng, pattern = np.random.default_rng(5), space.pattern
    column = np.repeat(np.arange(space.size), np.diff(pattern.indptr))
    upper, lower = -(10.0 ** rng.uniform(-3.0, 0.0, (2, len(column))))
    dense = np.zeros((space.size, space.size))
    dense[column, pattern.indices], dense[pattern.indices, column] = lower, upper
    np.fill_diagonal(dense, 0.0)
    np.fill_diagonal(dense, 1e-2 - dense.sum(axis=0))
    upper = dense[pattern.indices, column]
    return upper, lower, dense


def factor_of(space: FilmSpace) -> BandedFactor:
    found = banded(space.matrix(np.ones(len(space.pattern.indices))))
    assert found is not None
    return found


@pytest.mark.parametrize("space", SPACES, ids=lambda made: made.__name__)
def test_band_agrees_with_a_full_elimination(space):
    space = space()
    upper, lower, dense = carried(space)
    factor, loads = factor_of(space), np.random.default_rng(1).standard_normal((3, space.size))
    for scale in (1.0, 7.0):  # the second time with what the first one left
        assert factor.update(scale * upper, scale * lower)
        found, left = factor.solve(loads, 1e-12)
        assert left < 1e-11
        np.testing.assert_allclose(scale * dense @ found.T, loads.T, atol=1e-10)


@pytest.mark.parametrize("space", SPACES, ids=lambda made: made.__name__)
def test_order_is_line_after_line(space):
    """Both fronts take two lines of ten unknowns at most, and a third where lines slant to the couplings."""
    graph = matrix_of(space())
    order = line_order(graph)
    assert np.array_equal(np.sort(order), np.arange(graph.shape[0]))
    number = np.argsort(order)
    row = np.repeat(np.arange(graph.shape[0]), np.diff(graph.indptr))
    assert np.abs(number[row] - number[graph.indices]).max() <= 3 * 10


def matrix_of(space: FilmSpace) -> csr_array:
    """Couplings of a space's unknowns, of a pocket none."""
    dense = carried(space)[2] != 0.0
    crowded = dense.sum(axis=0) > 20
    return csr_array(dense[~crowded][:, ~crowded].astype(float))


def test_wide_bands_are_refused():
    wide = film_space(rectangle((1.0, 1.0), (60, 60), cell=Cell.QUADRILATERAL))
    assert banded(wide.matrix(np.ones(len(wide.pattern.indices)))) is None


def test_a_matrix_that_needs_an_exchange_of_rows_gets_it():
    """A vanishing pivot and a tiny one: the general factor goes over to an elimination with pivots."""
    space = strip()
    upper, lower, dense = carried(space)
    first = space.pattern.indptr[1:] - 1
    for pivot in (0.0, 1e-18):
        upper[first] = dense[np.diag_indices(space.size)] = pivot
        band = factor_of(space)
        assert not band.update(upper, lower) or not band.solve(np.ones((1, space.size)), 1e-12)[1] < 1e-10
        factor = GeneralFactor()
        factor.update(space.matrix(upper), lower)
        load = np.random.default_rng(2).standard_normal(space.size)
        expected = np.linalg.solve(dense, load)
        np.testing.assert_allclose(factor.solve(load), expected, atol=1e-6 * np.abs(expected).max())
