"""Differences over falling steps: closed forms, kinks, noise, one side."""

import numpy as np
import pytest

from system import load_pump
from system.description.keys import pump_keys
from system.inputs.faults import Fault, InputFaults
from system.variation.differences import Side, Stencil, Verdict, stencils, usual_step, verdicts

KEYS = pump_keys(load_pump("ref90"))
FILM = KEYS["valve_plate.film_thickness"]


def derived(of, side, step):
    stencil = Stencil(FILM, side, step)
    found = np.array([of(value) for value in stencil.values])
    return stencil, of(FILM.value), *stencil.derivative(np.array(of(FILM.value)), found)


@pytest.mark.parametrize("side", list(Side))
def test_cube_of_a_film(side):
    """Leakage grows with the cube: a polynomial that the extrapolation on both sides differentiates exactly."""
    _, _, value, error = derived(lambda h: h**3, side, 0.05 * FILM.value)
    exact = 3.0 * FILM.value**2
    assert abs(value - exact) <= (1e-12 * exact if side is Side.BOTH else error)
    assert error < 0.01 * exact


@pytest.mark.parametrize(("side", "order"), [(Side.BOTH, 4), (Side.ABOVE, 3), (Side.BELOW, 3)])
def test_order_of_the_error(side, order):
    off = [abs(derived(lambda h: np.exp(h / FILM.value), side, step * FILM.value)[2] * FILM.value - np.e)
           for step in (0.2, 0.1)]  # fmt: skip
    assert np.log2(off[0] / off[1]) == pytest.approx(order, abs=0.15)


def test_stated_error_holds_the_true_one():
    for of, exact in ((np.sin, np.cos), (np.exp, np.exp)):
        for side in Side:
            _, _, value, error = derived(lambda h, of=of: of(h * 1e5), side, 0.05 * FILM.value)
            assert abs(value - 1e5 * exact(FILM.value * 1e5)) <= error


def test_a_kink_is_no_number():
    """The largest of two courses, beside where they cross."""
    kink = FILM.value * 1.004
    stencil, middle, value, error = derived(lambda h: 1.0 + max(0.0, h - kink) * 1e5, Side.BOTH, 0.01 * FILM.value)
    assert verdicts(stencil, middle, value, error, 1e-6) == Verdict.NOT_SMOOTH


def test_noise_is_no_effect():
    random = np.random.default_rng(1)
    stencil, middle, value, error = derived(lambda _: 5.0 + 1e-9 * random.standard_normal(), Side.BOTH, 1e-7)
    assert value != 0.0
    assert verdicts(stencil, middle, value, error, 1e-6) == Verdict.NO_EFFECT
    assert verdicts(stencil, middle, value, error, 1e-12) != Verdict.NO_EFFECT


def limited(low, high):
    """A geometry that admits values between two."""

    def made(value):
        if not low <= value <= high:
            raise InputFaults("pump", [Fault("film", str(value), "less")])

    return made


def test_both_sides_at_a_small_step_come_before_one_side():
    at, step = FILM.value, 0.01 * FILM.value
    assert next(stencils(FILM, step, limited(0.0, 1.0))) == Stencil(FILM, Side.BOTH, step)
    assert next(stencils(FILM, step, limited(0.0, at + 0.3 * step))) == Stencil(FILM, Side.BOTH, 0.25 * step)
    assert next(stencils(FILM, step, limited(0.0, at))) == Stencil(FILM, Side.BELOW, step)
    assert next(stencils(FILM, step, limited(at, at + 0.3 * step))) == Stencil(FILM, Side.ABOVE, 0.25 * step)
    assert not list(stencils(FILM, step, limited(at, at)))


def test_steps_of_angles_and_of_zeros():
    assert usual_step(FILM, 0.01) == pytest.approx(8e-8)
    assert usual_step(KEYS["ports.kidney_end"], 0.01) == pytest.approx(np.radians(0.2))  # not 1.8 deg
    assert usual_step(KEYS["ports.groove_start"], 0.01) == pytest.approx(np.radians(0.02))
    assert usual_step(KEYS["ball_guide.spring_compression"], 0.01) == pytest.approx(1e-6)
    assert usual_step(KEYS["ball_guide.spring_stiffness"], 0.01) == pytest.approx(200.0)  # 1 % of 20 N/mm
