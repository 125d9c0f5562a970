"""Formulas sampled by rows and columns: the same values as point by point; others are refused."""

import numpy as np
import pytest

from reynolds import Cell, FilmInputError, annulus, film_space, rectangle

FORMULAS = {
    "x alone": lambda x, y: 1.0 + 0.6 * np.cos(x),
    "y alone": lambda x, y: np.exp(-y),
    "both": lambda x, y: np.cos(x) * (1.0 + y**2),
    "a jump": lambda x, y: np.where((x < 1.1) & (y > 0.4), 2.0, 1.0),
    "a number": lambda x, y: 3.0,
    "an array of one": lambda x, y: np.full((1, 1), 3.0),
}
QUADS = rectangle((6.0, 1.0), (9, 7), cell=Cell.QUADRILATERAL)
SPACES = {
    "Q1": film_space(QUADS),
    "Q2": film_space(QUADS, degree=2),
    "stretched": film_space(QUADS).moved(QUADS.mesh.p.T ** np.array([1.5, 0.5])),
    "as many columns as rows": film_space(rectangle((2.0, 1.0), (5, 5), cell=Cell.QUADRILATERAL)),
    "P1": film_space(rectangle((6.0, 1.0), (9, 7))),
    "ring": film_space(annulus(1.0, 2.0, (4, 12), cell=Cell.QUADRILATERAL)),
}


@pytest.mark.parametrize("space", SPACES.values(), ids=list(SPACES))
@pytest.mark.parametrize("formula", FORMULAS.values(), ids=list(FORMULAS))
def test_values_are_those_of_the_points(space, formula):
    ruled, expected = space.sample_ruled(formula), space.sample(formula)
    assert ruled.flags.c_contiguous
    np.testing.assert_allclose(ruled, np.broadcast_to(expected, space.area.shape), rtol=1e-13, atol=1e-13)


def test_only_rectangles_are_ruled_and_each_line_is_asked_for_once():
    """Two Gauss points a cell and direction for Q1; a ring's points lie in no rows along x."""
    ruling = SPACES["Q1"].ruling
    assert (ruling.x.shape, ruling.y.shape) == ((18, 1), (1, 14))
    assert SPACES["ring"].ruling is None
    assert SPACES["P1"].ruling is None


def test_values_that_belong_to_no_row_or_column_are_refused():
    with pytest.raises(FilmInputError, match="formula"):
        SPACES["Q1"].sample_ruled(lambda x, y: np.ones(5))
