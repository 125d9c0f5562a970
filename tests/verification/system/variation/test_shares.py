"""Shares of the variance by closed forms, what tighter tolerances buy, and the quadratic surface behind both."""

import numpy as np
import pytest

from reynolds.errors import InputError
from system.description.drawn import Drawing, Drawn
from system.description.tolerance import Shape
from system.variation.sampling import drawn_series
from system.variation.shares import TIGHTER, fitted_surface, pumps_needed, shares


def drawing(sigmas, correlation=None):
    own = tuple(Drawn(f"d{k}", (f"d{k}",), Shape.NORMAL, 1.0, sigma) for k, sigma in enumerate(sigmas))
    return Drawing(own, (), correlation or {}, ())


def found(sigmas, of, correlation=None, count=800):
    series = drawn_series(drawing(sigmas, correlation), count, seed=2)
    surface, by_number = shares(series, of(series.values)[:, None], seed=2)
    return surface, by_number[0]


def test_linear_number():
    """Shares are those of the single variances, first and total alike."""
    surface, own = found((1.0, 2.0), lambda x: 3.0 * x[:, 0] + x[:, 1])
    assert surface.held_out[0] == pytest.approx(1.0, abs=1e-12)
    for share, exact in zip(own, (9.0 / 13.0, 4.0 / 13.0), strict=True):
        assert share.first.value == pytest.approx(exact, abs=0.01)
        assert share.total.value == pytest.approx(exact, abs=0.01)
        assert share.first.low <= exact + 0.01
        assert share.first.high >= exact - 0.01


def test_product_of_two():
    """x y about zero: nothing alone, all together."""
    _, own = found((1.0, 1.0), lambda x: (x[:, 0] - 1.0) * (x[:, 1] - 1.0))
    for share in own:
        assert share.first.value == pytest.approx(0.0, abs=0.03)
        assert share.total.value == pytest.approx(1.0, abs=0.03)


def test_square():
    """x^2 + y with x, y of unit variance: 2 against 1."""
    _, own = found((1.0, 1.0), lambda x: (x[:, 0] - 1.0) ** 2 + x[:, 1])
    assert own[0].total.value == pytest.approx(2.0 / 3.0, abs=0.02)
    assert own[1].first.value == pytest.approx(1.0 / 3.0, abs=0.02)


def test_a_third_tighter():
    """Width of a sum of normals, and the mean of a square, which falls by 1 - (2/3)^2 of its variance."""
    _, own = found((1.0, 2.0), lambda x: 3.0 * x[:, 0] + x[:, 1])
    whole, less = np.sqrt(13.0), np.sqrt((3.0 * TIGHTER) ** 2 + 4.0)
    assert own[0].width.value == pytest.approx(2.0 * 1.6449 * (less - whole), rel=0.03)
    assert own[0].mean.value == pytest.approx(0.0, abs=1e-3)
    _, own = found((1.0, 1.0), lambda x: (x[:, 0] - 1.0) ** 2 + x[:, 1])
    assert own[0].mean.value == pytest.approx(TIGHTER**2 - 1.0, rel=0.02)


def test_correlated_dimensions_are_one_group():
    _, own = found((1.0, 1.0, 1.0), lambda x: x.sum(axis=1), {("d0", "d1"): 0.5})
    assert [share.names for share in own] == [("d0", "d1"), ("d2",)]
    assert own[0].first.value == pytest.approx(3.0 / 4.0, abs=0.01)
    assert own[1].total.value == pytest.approx(1.0 / 4.0, abs=0.01)


def test_a_number_that_does_not_scatter():
    _, own = found((1.0, 1.0), lambda x: np.full(len(x), 5.0))
    assert [(share.first.value, share.total.value) for share in own] == [(0.0, 0.0)] * 2
    assert own[0].width.value == pytest.approx(0.0, abs=1e-12)


def test_surface_tells_what_it_does_not_describe():
    series = drawn_series(drawing((1.0, 1.0)), 800, seed=2)
    random = np.random.default_rng(8).standard_normal(800)
    kept = fitted_surface(series.values, np.column_stack([random, series.values[:, 0] + 0.5 * random])).held_out
    assert kept[0] < 0.05
    assert kept[1] == pytest.approx(0.8, abs=0.05)  # variances 1 and 1/4


def test_too_few_pumps():
    assert pumps_needed(2) == 18
    with pytest.raises(InputError, match="18 at least"):
        fitted_surface(np.ones((17, 2)), np.ones((17, 1)))
