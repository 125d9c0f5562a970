"""Rough walls: contact.

Greenwood and Tripp's integrals against quadrature and the printed table; boundary friction.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import quad

from reynolds import Asperities, FilmInputError, contact_pressure
from reynolds.laws.contact import boundary_shear, composite_modulus, contact_area, gaussian_moment, lambda_ratio

EXAMPLES = settings(max_examples=60, deadline=None, derandomize=True)
HEIGHT = 0.4e-6
WALLS = Asperities(
    density=0.04 / (20e-6 * HEIGHT), radius=20e-6, height=HEIGHT, modulus=1.15e11, friction_coefficient=0.12
)


def test_table_of_the_integral(validation):
    rows = {
        2.5: {
            0.0: (0.6166342, 5e-8), 0.5: (0.2404016, 5e-8), 1.0: (0.08056234, 5e-9), 1.5: (0.02286306, 5e-9),
            2.0: (0.005423705, 5e-10), 2.5: (0.001063689, 5e-10), 3.0: (1.70873e-4, 5e-10), 3.5: (2.231e-5, 5e-9),
            4.0: (2.353e-6, 5e-10),
        },
        2.0: {0.0: (0.5, 1e-12), 1.0: (0.0753398, 5e-8), 2.0: (0.00576873, 5e-9)},
    }  # fmt: skip
    for order, row in rows.items():
        for ratio, (expected, digit) in row.items():
            validation(
                case="Greenwood-Tripp integral of Gaussian heights",
                source="Greenwood and Tripp 1970-71, by quadrature",
                quantity=f"F_{order:g}, H = {ratio:g}",
                unit="1",
                expected=expected,
                obtained=float(gaussian_moment(order, ratio).value),
                tolerance=digit,
                note="to the printed digits",
            )


def test_error_of_the_common_fit(validation):
    """Why the integral: the fit 4.4086e-5 (4 - H)^6.804 of many programs is off by these shares."""
    for ratio, percent, digit in ((0.0, -10.7, 0.05), (1.0, -3.5, 0.05), (2.0, -9.0, 0.5), (2.5, -35.0, 0.5),
                                  (3.0, -74.0, 0.5)):  # fmt: skip
        fit = 4.4086e-5 * (4.0 - ratio) ** 6.804
        validation(
            case="Common power-law fit of F_5/2",
            source="Greenwood and Tripp 1970-71, by quadrature",
            quantity=f"error of the fit against the integral used here, H = {ratio:g}",
            unit="%",
            expected=percent,
            obtained=100.0 * (fit / float(gaussian_moment(2.5, ratio).value) - 1.0),
            tolerance=digit,
            note="to the printed digits",
        )


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0, 2.5, 3.0])
@pytest.mark.parametrize("ratio", [-6.0, -2.3, 0.0, 0.7, 3.1, 8.0, 25.0])
def test_moment_against_quadrature(order, ratio):
    """Over t = s - H, with exp(-H^2/2) taken out where it is small; t = u^2 removes the root at the end."""
    outside = np.exp(-0.5 * ratio**2)
    end = np.sqrt(np.sqrt(ratio**2 + 120.0) - ratio)
    inner, _ = quad(
        lambda u: 2.0 * u ** (2.0 * order + 1.0) * np.exp(-0.5 * u**4 - ratio * u**2),
        0.0, end, epsabs=0.0, epsrel=1e-12, points=[0.25 * end, 0.5 * end], limit=400,
    )  # fmt: skip
    assert float(gaussian_moment(order, ratio).value) == pytest.approx(
        outside * inner / np.sqrt(2.0 * np.pi), rel=1e-11, abs=0.0
    )


@EXAMPLES
@given(ratio=st.floats(-5.9, 35.0), order=st.sampled_from([1.0, 1.5, 2.0, 2.5]))
def test_moment_falls_with_its_slope(ratio, order):
    value, slope = gaussian_moment(order, ratio)
    assert value > 0.0
    assert slope < 0.0
    ahead, behind = (gaussian_moment(order, ratio + d).value for d in (1e-5, -1e-5))
    # Rounding of the series, 1e-13, over the step; curvature (H step)^2.
    assert (ahead - behind) / 2e-5 == pytest.approx(float(slope), rel=1e-6, abs=0.0)


@EXAMPLES
@given(ratio=st.floats(-5.0, 30.0), order=st.sampled_from([1.5, 2.0, 2.5]))
def test_recursion(ratio, order):
    """F_(n+1) = n F_(n-1) - H F_n, by parts; its terms cancel for large H, hence the scale."""
    after, here, before = (float(gaussian_moment(n, ratio).value) for n in (order + 1.0, order, order + 2.0))
    slope = float(gaussian_moment(order + 1.0, ratio).slope)  # - (n + 1) F_n
    assert slope == pytest.approx(-(order + 1.0) * here, rel=1e-11, abs=0.0)
    terms = ((order + 1.0) * here, -ratio * after)
    assert before == pytest.approx(sum(terms), abs=1e-11 * max(abs(t) for t in terms))


def test_far_apart_no_contact():
    assert float(gaussian_moment(2.5, 100.0).value) == 0.0
    assert float(contact_pressure(WALLS, 1e-3).value) == 0.0


def test_contact_pressure(validation):
    """p = (16 sqrt2/15) pi (eta beta sigma)^2 sqrt(sigma/beta) E' F5/2(H), with F5/2 of the table."""
    factor = 16.0 * np.sqrt(2.0) / 15.0 * np.pi * 0.04**2 * np.sqrt(HEIGHT / 20e-6)
    validation(
        case="Greenwood-Tripp contact pressure, eta beta sigma = 0.04, sigma/beta = 0.02, E' = 115 GPa",
        source="Greenwood and Tripp 1970-71, by quadrature",
        quantity="contact pressure, h/sigma = 2",
        unit="Pa",
        expected=factor * 1.15e11 * 0.005423705,
        obtained=float(contact_pressure(WALLS, 2.0 * HEIGHT).value),
        relative_tolerance=1e-7,
        note="to the digits of F_5/2",
    )
    validation(
        case="Greenwood-Tripp real area of contact, eta beta sigma = 0.04",
        source="Greenwood and Tripp 1970-71, by quadrature",
        quantity="share of the nominal area, h/sigma = 1",
        unit="1",
        expected=np.pi**2 * 0.04**2 * 0.0753398,
        obtained=float(contact_area(WALLS, HEIGHT).value),
        relative_tolerance=1e-6,
        note="to the digits of F_2",
    )


@pytest.mark.parametrize("law", [contact_pressure, contact_area])
@EXAMPLES
@given(h=st.floats(0.0, 3e-6))
def test_contact_falls_with_its_slope(law, h):
    value, slope = law(WALLS, h)
    assert value > 0.0
    assert slope < 0.0
    step = 1e-5 * HEIGHT
    ahead, behind = (law(WALLS, h + sign * step).value for sign in (1.0, -1.0))
    assert (ahead - behind) / (2.0 * step) == pytest.approx(float(slope), rel=1e-6)


def test_summits_above_the_mean_plane():
    """Raising the summits by delta moves the whole curve by delta."""
    raised = Asperities(WALLS.density, WALLS.radius, HEIGHT, WALLS.modulus, 0.1, summit_height=0.3e-6)
    h = np.linspace(0.3e-6, 2e-6, 7)
    np.testing.assert_allclose(contact_pressure(raised, h).value, contact_pressure(WALLS, h - 0.3e-6).value)


def test_composite_modulus():
    """Steel on steel of 210 GPa, nu = 0.3: E/(2 (1 - nu^2)); the E' of elastohydrodynamics is twice that."""
    assert composite_modulus(210e9, 0.3, 210e9, 0.3) == pytest.approx(210e9 / 1.82)
    assert composite_modulus(210e9, 0.3, 110e9, 0.34) == pytest.approx(1.0 / (0.91 / 210e9 + 0.8844 / 110e9))


def test_boundary_friction():
    limited = Asperities(WALLS.density, WALLS.radius, HEIGHT, WALLS.modulus, 0.12, shear_limit=2e6)
    pressure = np.array([0.0, 1e7, 1e8])
    np.testing.assert_allclose(boundary_shear(WALLS, pressure).value, [0.0, 1.2e6, 1.2e7])
    np.testing.assert_allclose(boundary_shear(limited, pressure).value, [0.0, 1.2e6, 2e6])
    np.testing.assert_allclose(boundary_shear(limited, pressure).slope, [0.12, 0.12, 0.0])
    with pytest.raises(FilmInputError, match="contact pressure"):
        boundary_shear(WALLS, -1.0)


def test_lambda_ratio():
    np.testing.assert_allclose(lambda_ratio([1e-6, 2e-6], 0.5e-6), [2.0, 4.0])
    with pytest.raises(FilmInputError, match="composite_roughness"):
        lambda_ratio(1e-6, 0.0)


def test_walls_pressed_into_each_other_are_refused():
    with pytest.raises(FilmInputError, match="H"):
        contact_pressure(WALLS, -6.1 * HEIGHT)
    with pytest.raises(FilmInputError, match="H"):
        contact_pressure(WALLS, np.nan)


@pytest.mark.parametrize(
    "change",
    [{"density": 0.0}, {"radius": -1e-6}, {"height": np.nan}, {"modulus": np.inf}, {"friction_coefficient": -0.1},
     {"summit_height": np.nan}, {"shear_limit": 0.0}],
)  # fmt: skip
def test_what_is_no_asperity_is_refused(change):
    with pytest.raises(FilmInputError, match=next(iter(change))):
        Asperities(**{**vars(WALLS), **change})
