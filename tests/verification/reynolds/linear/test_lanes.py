"""Lanes of compiled loops: plain loops and vector registers give the same numbers."""

import os
import subprocess
import sys

import numpy as np
import pytest
from numba import njit

from reynolds import ZERO, FilmProblem, FilmSolver, Held, film, film_space, rectangle
from reynolds.numerics import lanes, scalar_lanes, vector_lanes

LOAD = "import runpy, sys, numpy; numpy.save(sys.argv[2], runpy.run_path(sys.argv[1])['pressures']())"


def pressures() -> np.ndarray:
    """A wedge on a grid, solved by multigrid."""
    space = film_space(rectangle((1.0, 0.5), (24, 16)))
    wedge = film(space.sample(lambda x, y: 2.0 - x), 1.0, velocity_moving=(np.ones((1, 1)), ZERO))
    sides = dict.fromkeys(("left", "right", "bottom", "top"), Held(0.0))
    return FilmSolver(space).solve(FilmProblem(space, wedge, sides)).pressure


def _of(module):
    """A kernel of all operations: first and second half of two arrays, mixed."""
    lanes, put_lanes, all_lanes = module.lanes, module.put_lanes, module.all_lanes
    apart, together, lanes_like, where = module.apart, module.together, module.lanes_like, module.where_positive

    @njit
    def mixed(a, b, out):
        one, other = lanes(a, 0), lanes_like(a, lanes(b, 3))
        even, odd = apart(one, other)
        low, high = together(even * all_lanes(a, 0.7), odd / all_lanes(a, 1.3))
        low += one * high
        low -= other
        put_lanes(out, 0, where(low, low - high, high))
        put_lanes(out, 8, even)
        put_lanes(out, 16, odd)
        put_lanes(out, 24, low + high)

    return mixed


@pytest.mark.parametrize(("of_a", "of_b"), [(float, float), (float, np.float32), (np.float32, float)])
def test_both_give_the_same_numbers(of_a, of_b):
    random = np.random.default_rng(3)
    a, b = random.normal(size=8).astype(of_a), random.normal(size=11).astype(of_b)
    found = [np.empty(32, of_a) for _ in range(2)]
    for module, out in zip((scalar_lanes, vector_lanes), found, strict=True):
        _of(module)(a, b, out)
    assert found[0] == pytest.approx(found[1], rel=4.0 * float(np.finfo(of_a).eps))


@pytest.mark.long
def test_a_film_by_plain_loops(tmp_path):
    """The switch in a process of its own: the pressures of vector registers, to the solver's tolerance."""
    switched = {"SWASHFILM_LANES": "scalar", "NUMBA_CACHE_DIR": str(tmp_path / "numba")}
    file = tmp_path / "pressure.npy"
    subprocess.run([sys.executable, "-c", LOAD, __file__, str(file)], check=True, env=os.environ | switched)
    assert not lanes.SCALAR
    assert np.load(file) == pytest.approx(pressures(), rel=1e-9, abs=1e-12)
