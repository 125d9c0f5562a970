"""Rough walls: average flow model.

Patir and Cheng's factors against their table, exact values and independent averages.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from scipy.integrate import quad

from reynolds import FilmInputError, Surface
from reynolds.laws.patir_cheng import TABLE, phi_f, phi_fp, phi_fs, phi_s, phi_x, phi_y
from reynolds.laws.roughness import beyond_range, flow_factors, mean_thickness, shear_factors

EXAMPLES = settings(max_examples=60, deadline=None, derandomize=True)
SIGMA = 0.5e-6
FACTORS = {"phi_x": phi_x, "phi_y": phi_y, "Phi_s": phi_s, "Phi_fs": phi_fs, "phi_fp": phi_fp}
PEKLENIK = st.floats(np.log(1.0 / 9.0), np.log(9.0)).map(lambda x: float(np.clip(np.exp(x), 1.0 / 9.0, 9.0)))


def test_isotropic_rows(validation):
    rows = {1.0: (0.48591, 0.79559), 3.0: (0.83226, 0.55320), 5.0: (0.94527, 0.32257)}
    for ratio, expected in rows.items():
        for name, factor, value in zip(("phi_x", "Phi_s"), (phi_x, phi_s), expected, strict=True):
            validation(
                case="Flow factors of isotropic roughness",
                source="Patir and Cheng 1978, 1979",
                quantity=f"{name}, h/sigma = {ratio:g}",
                unit="1",
                expected=value,
                obtained=float(factor(ratio, 1.0).value),
                tolerance=5e-6,
                note="to the printed digits",
            )


PRINTED = {  # gamma: C, r, A1, al1, al2, al3, A2, A3, al4, al5, al6, D, s as printed
    1 / 9: (1.48, 0.42, 2.046, 1.12, 0.78, 0.03, 1.856, 14.1, 2.45, 2.30, 0.10, 1.51, 0.52),
    1 / 6: (1.38, 0.42, 1.962, 1.08, 0.77, 0.03, 1.754, 13.4, 2.42, 2.30, 0.10, 1.51, 0.54),
    1 / 3: (1.18, 0.42, 1.858, 1.01, 0.76, 0.03, 1.561, 12.3, 2.32, 2.30, 0.10, 1.47, 0.58),
    1.0: (0.90, 0.56, 1.899, 0.98, 0.92, 0.05, 1.126, 11.1, 2.31, 2.38, 0.11, 1.40, 0.66),
    3.0: (0.225, 1.5, 1.560, 0.85, 1.13, 0.08, 0.556, 9.8, 2.25, 2.80, 0.18, 0.98, 0.79),
    6.0: (0.520, 1.5, 1.290, 0.62, 1.09, 0.08, 0.388, 10.1, 2.25, 2.90, 0.18, 0.97, 0.91),
    9.0: (0.870, 1.5, 1.011, 0.54, 1.07, 0.08, 0.295, 8.7, 2.15, 2.97, 0.18, 0.73, 0.91),
}


@pytest.mark.parametrize("gamma", PRINTED, ids=lambda gamma: f"{gamma:.3g}")
def test_every_row_of_the_table(gamma, validation):
    """At H = 2, and Phi_s at H = 6, where its second formula holds."""
    c, r, a1, al1, al2, al3, a2, a3, al4, al5, al6, d, s = PRINTED[gamma]
    h = 2.0
    along = 1.0 - c * np.exp(-r * h) if gamma <= 1.0 else 1.0 + c * h**-r
    for quantity, expected, obtained in (
        ("phi_x, h/sigma = 2", along, phi_x(h, gamma)),
        ("phi_y of 1/gamma, h/sigma = 2", along, phi_y(h, 1.0 / gamma)),
        ("Phi_s, h/sigma = 2", a1 * h**al1 * np.exp(-al2 * h + al3 * h**2), phi_s(h, gamma)),
        ("Phi_s, h/sigma = 6", a2 * np.exp(-0.25 * 6.0), phi_s(6.0, gamma)),
        ("Phi_fs, h/sigma = 2", a3 * h**al4 * np.exp(-al5 * h + al6 * h**2), phi_fs(h, gamma)),
        ("phi_fp, h/sigma = 2", 1.0 - d * np.exp(-s * h), phi_fp(h, gamma)),
    ):
        validation(
            case="Table of Patir and Cheng's factors",
            source="Patir and Cheng 1978, 1979",
            quantity=f"{quantity}, gamma = {gamma:.3g}",
            unit="1",
            expected=expected,
            obtained=float(obtained.value),
            relative_tolerance=1e-12,
            note="the printed coefficients, put in by hand",
        )


def test_contact_factor_rows(validation):
    """phi_c and the mean film of Gaussian heights."""
    rows = {
        0.0: (0.5, 0.3989423),
        1.0: (0.8413447, 1.0833155),
        2.0: (0.9772499, 2.0084907),
        3.0: (0.9986501, 3.0003822),
    }
    for ratio, (share, thickness) in rows.items():
        found = mean_thickness(SIGMA, ratio * SIGMA)
        obtained = (float(found.slope), float(found.value) / SIGMA)
        for name, value, got in zip(("phi_c", "hT/sigma"), (share, thickness), obtained, strict=True):
            validation(
                case="Mean film of Gaussian heights",
                source="closed form, normal distribution",
                quantity=f"{name}, h/sigma = {ratio:g}",
                unit="1",
                expected=value,
                obtained=got,
                tolerance=5e-8,
                note="to the printed digits",
            )


def test_the_trap_of_low_ratios(validation):
    """The formula of gamma = 1/9 is -0.20 at h/sigma = 0.5; the continued factor is positive."""
    row = TABLE[0]
    validation(
        case="Published formula below its range",
        source="Patir and Cheng 1978",
        quantity="1 - C exp(-r H), gamma = 1/9, H = 0.5: not used there",
        unit="1",
        expected=-0.20,
        obtained=1.0 - row.c * np.exp(-row.r * 0.5),
        tolerance=5e-3,
        note="to the printed digits; the continuation in its place is positive",
    )
    assert 0.0 < float(phi_x(0.5, 1.0 / 9.0).value) < float(phi_x(1.0, 1.0 / 9.0).value)


@pytest.mark.parametrize("name", FACTORS)
@EXAMPLES
@given(peklenik=PEKLENIK, ratio=st.floats(1e-3, 30.0))
def test_factors_are_positive_with_their_slope(name, peklenik, ratio):
    assume(name != "Phi_fs" or ratio < 6.99)  # zero from 7 on, by definition, with a step
    assume(name != "Phi_s" or abs(ratio - 5.0) > 1e-4)  # two published formulas meet there, within 0.1 %
    assume(min(abs(ratio - limit) for limit in (0.5, 0.75, 1.0)) > 1e-5)  # the second derivative jumps there
    value, slope = FACTORS[name](ratio, peklenik)
    assert value > 0.0
    step = 1e-6 * max(ratio, 1.0)
    ahead, behind = (FACTORS[name](ratio + sign * step, peklenik).value for sign in (1.0, -1.0))
    # Rounding: eps/step = 2e-10, of a factor up to about 10; curvature is below 1e-9 of the value.
    assert (ahead - behind) / (2.0 * step) == pytest.approx(float(slope), rel=1e-6, abs=1e-8)


@pytest.mark.parametrize("factor", FACTORS.values(), ids=FACTORS)
@pytest.mark.parametrize("row", TABLE, ids=lambda row: f"{row.peklenik:.3g}")
def test_the_continuation_has_value_and_slope(factor, row):
    """C1 at every limit of the range."""
    for limit in (0.5, 0.75, 1.0):
        below, above = (factor(limit + d, row.peklenik) for d in (-1e-9, 1e-9))
        np.testing.assert_allclose(below.value, above.value, rtol=1e-7)
        np.testing.assert_allclose(below.slope, above.slope, rtol=1e-6)


def test_interpolation_in_the_logarithm():
    """On the rows the table itself, half way in log gamma the mean; ends and ratios of the table are met."""
    h = np.linspace(1.0, 8.0, 15)
    for low, high in pairwise(TABLE):
        middle = phi_x(h, np.sqrt(low.peklenik * high.peklenik)).value
        mean = 0.5 * (phi_x(h, low.peklenik).value + phi_x(h, high.peklenik).value)
        np.testing.assert_allclose(middle, mean, rtol=1e-12)
    np.testing.assert_array_equal(phi_y(h, 9.0).value, phi_x(h, 1.0 / 9.0).value)
    np.testing.assert_allclose(phi_x(h, 3.0).value, 1.0 + 0.225 * h**-1.5, rtol=1e-14)


@pytest.mark.parametrize("gamma", [0.1, 9.5, np.nan, -1.0])
def test_peklenik_beyond_the_table_is_refused(gamma):
    with pytest.raises(FilmInputError, match="Peklenik"):
        phi_x(3.0, gamma)
    with pytest.raises(FilmInputError, match="Peklenik"):
        Surface(SIGMA, 0.0, peklenik_moving=gamma)


def test_couette_factor_is_the_mean_of_one_over_h(validation):
    """h E[1/h_T] of the density (35/32)(1 - s^2)^3 by quadrature, cut off at sigma/100."""
    for ratio in (0.3, 1.0, 2.0, 2.9, 3.0, 3.1, 5.0, 9.1, 30.0):
        z = ratio / 3.0
        cut = 1.0 / 300.0
        lowest = max(-1.0, -z + cut)
        # The density is P(u) over u = z + s, with P'(0) = 6 z (1 - z^2)^2 and |P''| < 8. The published form takes
        # P(0)/u only below its cut-off: what it leaves out is P'(0) cut + P'' cut^2/4 + ...
        left_out = 6.0 * z * (1.0 - z**2) ** 2 * cut + 2.0 * cut**2
        mean, _ = quad(
            lambda s, z=z: 35.0 / 32.0 * (1.0 - s * s) ** 3 * z / (z + s), lowest, 1.0, epsabs=1e-13, limit=200
        )
        validation(
            case="Couette shear stress factor of Patir and Cheng",
            source="mean of h/h_T over the heights, quadrature",
            quantity=f"phi_f, h/sigma = {ratio:g}",
            unit="1",
            expected=mean,
            obtained=float(phi_f(ratio).value),
            tolerance=35.0 / 32.0 * z * left_out if ratio <= 3.0 else 1e-11,
            note="less what the published form leaves out at its cut-off" if ratio <= 3.0 else "",
        )


@EXAMPLES
@given(ratio=st.floats(0.01, 60.0))
def test_couette_factor_has_its_slope(ratio):
    value, slope = phi_f(ratio)
    assert value > 0.0
    step = 1e-5
    ahead, behind = (phi_f(ratio + sign * step).value for sign in (1.0, -1.0))
    assert (ahead - behind) / (2.0 * step) == pytest.approx(float(slope), rel=1e-4, abs=1e-6)


def test_smooth_far_away():
    """Thick film: every factor tends to that of smooth walls, and hT to h."""
    factors, stress = flow_factors(Surface(SIGMA, 0.3e-6), 60.0 * SIGMA), shear_factors(Surface(SIGMA, 0.0), 3e-5)
    assert float(factors.pressure.x.value) == pytest.approx(1.0, abs=np.exp(-0.56 * 51.0))
    assert float(factors.shear.x.value) == pytest.approx(0.0, abs=1.126 * np.exp(-0.25 * 51.0))
    assert float(factors.content.value) == pytest.approx(60.0 * SIGMA)
    assert float(stress.couette.value) == pytest.approx(1.0 + 1.0 / 60.0**2, abs=1e-5)


def test_the_moving_rough_wall_carries_oil():
    """Sign and size of phi_s, by exact averages over crossing ridges (one-dimensional film, q the same all along).

    Seen from the ridges q' = -h^3/(12 mu) p' - U h/2 is uniform and p' of zero mean, so that in the wall's
    rest frame q = U h - U/2 E[h^-2]/E[h^-3] = U/2 (h + sigma phi_s) with phi_s > 0; with the rough wall at rest
    the sign turns. Peklenik's table ends at 1/9, so it lies between isotropic and crossing ridges.
    """
    ratio, wave = 6.0, np.sqrt(2.0) * np.sin(np.linspace(0.0, 2.0 * np.pi, 4096, endpoint=False))
    h = ratio + wave
    crossing = ratio - np.mean(h**-2.0) / np.mean(h**-3.0)
    assert crossing == pytest.approx(3.0 / ratio, rel=0.1)
    moving = flow_factors(Surface(SIGMA, 0.0, peklenik_moving=1.0 / 9.0), ratio * SIGMA).shear.x.value
    isotropic = flow_factors(Surface(SIGMA, 0.0), ratio * SIGMA).shear.x.value
    assert 0.0 < isotropic < moving < crossing
    fixed = flow_factors(Surface(0.0, SIGMA, peklenik_fixed=1.0 / 9.0), ratio * SIGMA).shear.x.value
    assert fixed == -moving


def test_crossing_ridges_shear_the_smooth_wall_more():
    """The same film: viscous stress on the smooth wall is mu U/h (phi_f + Phi_fs), on the ridges less by 2 Phi_fs.

    Phi_fs = 3 h (E[1/h] - E[h^-2]^2/E[h^-3]) > 0; the table's isotropic value is of its size.
    """
    ratio, wave = 4.0, np.sqrt(2.0) * np.sin(np.linspace(0.0, 2.0 * np.pi, 4096, endpoint=False))
    h = ratio + wave
    gradient = 6.0 * np.mean(h**-2.0) / np.mean(h**-3.0) / h**3 - 6.0 / h**2  # of p/(mu U), of zero mean
    assert np.mean(gradient) == pytest.approx(0.0, abs=1e-12)
    on_smooth = ratio * np.mean(1.0 / h - 0.5 * h * gradient)
    on_ridges = ratio * np.mean(1.0 / h + 0.5 * h * gradient)
    sliding = shear_factors(Surface(SIGMA, 0.0, peklenik_moving=1.0 / 9.0), ratio * SIGMA).sliding.x.value
    assert sliding > 0.0
    assert on_smooth > on_ridges
    assert 0.3 < sliding / (0.5 * (on_smooth - on_ridges)) < 3.0


def test_walls_of_equal_roughness_draw_nothing():
    factors = flow_factors(Surface(SIGMA, SIGMA), np.array([1e-6, 3e-6]))
    np.testing.assert_array_equal(factors.shear.x.value, 0.0)
    unlike = flow_factors(Surface(SIGMA, SIGMA, 3.0, 1.0 / 3.0), np.array([1e-6, 3e-6]))
    np.testing.assert_allclose(unlike.pressure.x.value, unlike.pressure.y.value, rtol=1e-14)
    assert np.all(unlike.shear.x.value < 0.0)  # ridges across carry more than ridges along


@EXAMPLES
@given(peklenik=PEKLENIK, ratio=st.floats(0.05, 20.0), lay=st.floats(-4.0, 4.0))
def test_flow_factors_are_a_tensor_with_slopes_over_h(peklenik, ratio, lay):
    """A turned lay keeps the principal factors; slopes are over h in metres."""
    surface = Surface(SIGMA, 0.2e-6, peklenik, peklenik, lay)
    sigma = surface.composite_roughness
    factors = flow_factors(surface, ratio * sigma)
    x, xy, y = (float(part.value) for part in factors.pressure)
    found = np.sort(np.linalg.eigvalsh([[x, xy], [xy, y]]))
    expected = np.sort([float(phi_x(ratio, peklenik).value), float(phi_y(ratio, peklenik).value)])
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)
    assert float(factors.pressure.x.slope) * sigma == pytest.approx(
        float(np.cos(lay) ** 2 * phi_x(ratio, peklenik).slope + np.sin(lay) ** 2 * phi_y(ratio, peklenik).slope),
        rel=1e-9,
        abs=1e-12,
    )


@EXAMPLES
@given(ratio=st.floats(-5.0, 12.0))
def test_mean_thickness_has_its_slope(ratio):
    value, slope = mean_thickness(SIGMA, ratio * SIGMA)
    assert value > 0.0
    ahead, behind = (mean_thickness(SIGMA, (ratio + d) * SIGMA).value for d in (1e-5, -1e-5))
    assert (ahead - behind) / (2e-5 * SIGMA) == pytest.approx(float(slope), rel=1e-5, abs=1e-10)


def test_beyond_range_is_reported():
    h = np.array([[0.4, 0.9], [1.2, 3.0]]) * SIGMA
    assert tuple(beyond_range(h, Surface(SIGMA, 0.0))) == (0.25, pytest.approx(0.4), 0.5)
    assert tuple(beyond_range(h, Surface(SIGMA, 0.0, peklenik_moving=3.0))) == (0.5, pytest.approx(0.4), 1.0)
    # The lay of a smooth wall is of no matter.
    assert beyond_range(h, Surface(SIGMA, 0.0, peklenik_fixed=3.0)).limit == 0.5


@pytest.mark.parametrize("thickness", [0.0, -1e-6, np.nan])
def test_no_film_is_refused(thickness):
    with pytest.raises(FilmInputError, match="film thickness"):
        flow_factors(Surface(SIGMA, 0.0), np.array([1e-6, thickness]))


@pytest.mark.parametrize("walls", [(0.0, 0.0), (-1e-7, 1e-7), (np.nan, 1e-7)])
def test_walls_without_roughness_are_refused(walls):
    with pytest.raises(FilmInputError, match="roughness"):
        Surface(*walls)
