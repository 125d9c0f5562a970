"""Walther's law and the ISO grades against the published row and the definition of the viscosity index."""

import numpy as np
import pytest

from reynolds import ISO_GRADES, FilmInputError, Oil, dynamic_viscosity, walther
from reynolds.laws.oil import temperature_of, walther_coefficients

VG46 = Oil(46e-6, 6.8e-6, density=860.0, bulk_modulus=1.6e9, specific_heat=1950.0)


def test_walther_coefficients_of_vg46():
    intercept, slope = walther_coefficients(VG46)
    assert intercept == pytest.approx(9.41799, abs=5e-6)
    assert slope == pytest.approx(3.68444, abs=5e-6)


@pytest.mark.parametrize(
    ("celsius", "centistokes", "last_digit"),
    [(20, 133.84, 0.005), (50, 29.973, 5e-4), (60, 20.623, 5e-4), (80, 11.103, 5e-4), (120, 4.571, 5e-4)],
)
def test_viscosity_of_vg46_over_temperature(celsius, centistokes, last_digit):
    assert walther(celsius + 273.15, VG46) * 1e6 == pytest.approx(centistokes, abs=last_digit)


@pytest.mark.parametrize("grade", ISO_GRADES)
def test_the_law_passes_through_its_two_points(grade):
    stated = ISO_GRADES[grade]
    oil = Oil(stated.kinematic_viscosity_40C, stated.kinematic_viscosity_100C, 860.0, 1.6e9, 1950.0)
    at_points = walther(np.array([313.15, 373.15]), oil)
    expected = [stated.kinematic_viscosity_40C, stated.kinematic_viscosity_100C]
    np.testing.assert_allclose(at_points, expected, rtol=1e-11)


def test_dynamic_viscosity_at_50_degC():
    assert dynamic_viscosity(VG46, 323.15) == pytest.approx(25.8e-3, abs=0.05e-3)


# ASTM D2270, table X2.1: over a range of the viscosity Y at 100 degC, the viscosities at 40 degC of an oil of
# index 0, L = a Y^2 + b Y + c, and of index 100, H = d Y^2 + e Y + f, all in mm2/s (the last range, which the
# standard ends at 15, is used to 15.05).
D2270 = [
    (2.0, 3.8, (1.14673, 1.7576, -0.109), (0.84155, 1.5521, -0.077)),
    (3.8, 4.4, (3.38095, -15.4952, 33.196), (0.78571, 1.7929, -0.183)),
    (5.0, 6.4, (0.10100, 16.6350, -45.469), (0.04985, 9.1613, -18.557)),
    (6.4, 7.0, (3.35714, -23.5643, 78.466), (0.22619, 7.7369, -16.656)),
    (7.7, 9.0, (0.41858, 16.1558, -56.040), (0.05794, 10.5156, -28.240)),
    (9.0, 12.0, (0.88779, 7.5527, -16.600), (0.26665, 6.7015, -10.810)),
    (12.0, 15.1, (0.76720, 10.7972, -38.180), (0.20073, 8.4658, -22.490)),
]


@pytest.mark.parametrize("grade", ISO_GRADES)
def test_grades_have_viscosity_index_100(grade):
    """To the rounding of the viscosity at 100 degC, 0.05 mm2/s, which moves the index by its own slope."""
    at_40 = ISO_GRADES[grade].kinematic_viscosity_40C * 1e6
    at_100 = ISO_GRADES[grade].kinematic_viscosity_100C * 1e6
    assert at_40 == float(grade.rpartition(" ")[2])
    low, high = (_viscosity_index(at_40, at_100 + change) for change in (-0.05, 0.05))
    assert low <= 100.0 <= high


def _viscosity_index(at_40, at_100):
    poor, good = next((low, high) for start, end, low, high in D2270 if start <= at_100 < end)
    return 100 * (np.polyval(poor, at_100) - at_40) / (np.polyval(poor, at_100) - np.polyval(good, at_100))


@pytest.mark.parametrize("celsius", [-20.0, 50.0, 120.0])
def test_a_viscosity_leads_back_to_its_temperature(celsius):
    kelvin = celsius + 273.15
    assert temperature_of(VG46, dynamic_viscosity(VG46, kelvin)) == pytest.approx(kelvin, rel=1e-12)


def test_no_temperature_of_an_oil_too_thin():
    with pytest.raises(FilmInputError):
        temperature_of(VG46, 1.5e-3)


@pytest.mark.parametrize("celsius", [-41.0, 151.0, np.nan])
def test_a_temperature_outside_the_law_is_refused(celsius):
    with pytest.raises(FilmInputError, match=r"-40 \.\. 150 degC"):
        walther(celsius + 273.15, VG46)


def test_an_oil_too_thin_for_the_law_is_refused():
    thin = Oil(10e-6, 2.7e-6, 860.0, 1.6e9, 1950.0)
    with pytest.raises(FilmInputError, match="2 mm2/s"):
        walther(273.15 + 140.0, thin)


@pytest.mark.parametrize("viscosities", [(46e-6, 46e-6), (46e-6, 1.5e-6), (-46e-6, 6.8e-6)])
def test_what_is_no_oil_is_refused(viscosities):
    with pytest.raises(FilmInputError, match="kinematic_viscosity"):
        Oil(*viscosities, density=860.0, bulk_modulus=1.6e9, specific_heat=1950.0)
