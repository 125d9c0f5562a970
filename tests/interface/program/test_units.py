"""Quantities as text: exact units, refusals, and the way back to the last bit."""

import math
import re

import pytest
from hypothesis import given, settings, strategies as st

from system import Dimension
from system.inputs.units import (
    QuantityError,
    format_quantity,
    in_unit,
    largest,
    parse_quantity,
    parse_share,
    unit_scale,
)

SIZES = st.one_of(st.just(0.0), st.floats(1e-29, 1e29), st.floats(-1e29, -1e-29))


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("22 mm", Dimension.LENGTH, 0.022),
        ("15um", Dimension.LENGTH, 15e-6),
        ("15 µm", Dimension.LENGTH, 15e-6),
        ("60 rpm", Dimension.ANGULAR_SPEED, 2 * math.pi),
        ("60 r/min", Dimension.ANGULAR_SPEED, 2 * math.pi),
        ("6 cm3", Dimension.VOLUME, 6e-6),
        ("6 cm^3", Dimension.VOLUME, 6e-6),
        ("90 cc/rev", Dimension.DISPLACEMENT, 90e-6),
        ("90 mL/r", Dimension.DISPLACEMENT, 90e-6),
        ("60 L/min", Dimension.VOLUME_FLOW, 1e-3),
        ("60 lpm", Dimension.VOLUME_FLOW, 1e-3),
        ("350 bar", Dimension.PRESSURE, 35e6),
        ("35 MPa", Dimension.PRESSURE, 35e6),
        ("50 degC", Dimension.TEMPERATURE, 323.15),
        ("180 deg", Dimension.ANGLE, math.pi),
        ("46 cSt", Dimension.KINEMATIC_VISCOSITY, 46e-6),
        ("46 mm2/s", Dimension.KINEMATIC_VISCOSITY, 46e-6),
        ("25.8 mPa s", Dimension.DYNAMIC_VISCOSITY, 25.8e-3),
        ("500.5 N m", Dimension.TORQUE, 500.5),
        ("152 mm²", Dimension.AREA, 152e-6),
        ("1.95 kJ/(kg K)", Dimension.SPECIFIC_HEAT, 1950.0),
    ],
)
def test_units_are_exact(text, dimension, value):
    assert parse_quantity(text, dimension) == value


@pytest.mark.parametrize(
    ("text", "dimension"),
    [
        ("90 cm3", Dimension.DISPLACEMENT),
        ("6 cm3/rev", Dimension.VOLUME),
        ("35 1/s", Dimension.ANGULAR_SPEED),
        ("50 C", Dimension.TEMPERATURE),
        ("nan mm", Dimension.LENGTH),
        ("1e999 mm", Dimension.LENGTH),
        ("1e-99 mm", Dimension.LENGTH),
        ("9" * 5000 + " mm", Dimension.LENGTH),
        ("1e29 rpm", Dimension.ANGULAR_SPEED),
        ("1,5 mm", Dimension.LENGTH),
        ("22", Dimension.LENGTH),
        ("", Dimension.LENGTH),
        ("3 dB", Dimension.LENGTH),
        ("2 __import__('os')", Dimension.LENGTH),
    ],
)
def test_what_is_no_such_quantity(text, dimension):
    with pytest.raises(QuantityError, match=re.escape(dimension.example)):
        parse_quantity(text, dimension)


@pytest.mark.parametrize("dimension", Dimension)
def test_examples_measure_what_they_show(dimension):
    assert parse_quantity(dimension.example, dimension) > 0.0


@pytest.mark.parametrize(("text", "shown"), [("0 degC", "0 degC"), ("-40 degC", "-40 degC"), ("273 K", "-0.15 degC")])
def test_temperatures_about_zero_are_shown_without_what_rounding_leaves(text, shown):
    assert format_quantity(parse_quantity(text, Dimension.TEMPERATURE), Dimension.TEMPERATURE, digits=4) == shown


@settings(deadline=None)
@given(st.sampled_from(Dimension), SIZES)
def test_quantities_come_back_to_the_last_bit(dimension, value):
    if abs(value) <= 0.999 * largest(dimension):
        assert parse_quantity(format_quantity(value, dimension), dimension) == value
    elif abs(value) > 1.001 * largest(dimension):
        with pytest.raises(QuantityError, match="at most"):
            parse_quantity(format_quantity(value, dimension), dimension)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_cannot_be_shown_is_refused(value):
    with pytest.raises(ValueError, match="a length"):
        format_quantity(value, Dimension.LENGTH)


@settings(deadline=None)
@given(st.sampled_from(Dimension), st.floats(min_value=1e-9, max_value=1e9), st.integers(2, 8))
def test_rounded_quantities_are_near(dimension, value, digits):
    value = min(value, 0.9 * float(largest(dimension)))
    shown = format_quantity(value, dimension, digits=digits)
    offset = 273.15 if dimension is Dimension.TEMPERATURE else 0.0  # digits count from the freezing point
    assert abs(parse_quantity(shown, dimension) - value) <= 0.51 * 10.0 ** (1 - digits) * abs(value - offset) + 1e-300


@pytest.mark.parametrize("unit", ["1/min", "min-1", "min^-1", "U/min", "upm", "UpM"])
def test_turns_are_counted_as_catalogues_write_them(unit):
    speed = parse_quantity("2100 rpm", Dimension.ANGULAR_SPEED)
    assert parse_quantity(f"2100 {unit}", Dimension.ANGULAR_SPEED) == speed
    assert parse_quantity("35 Hz", Dimension.ANGULAR_SPEED) == speed
    factor, offset = unit_scale(unit, Dimension.ANGULAR_SPEED)
    assert (2100.0 * factor, offset) == (pytest.approx(speed, rel=1e-15), 0.0)
    assert in_unit(speed, unit, Dimension.ANGULAR_SPEED) == pytest.approx(2100.0, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "gauge"),
    [
        ("1 bara", "'-0.01325 bar', which is 1.01325 bar less"),
        ("1 bar abs", "'-0.01325 bar', which is 1.01325 bar less"),
        ("14.7 psi(a)", "'0.00405122 psi', which is 1.01325 bar less"),
        ("0.3 MPa absolute", "'0.198675 MPa', which is 1.01325 bar less"),
    ],
)
def test_an_absolute_pressure_gets_its_gauge_pressure_as_remedy(text, gauge):
    with pytest.raises(QuantityError, match="an absolute pressure") as caught:
        parse_quantity(text, Dimension.PRESSURE)
    assert caught.value.nearest == gauge


@pytest.mark.parametrize(
    ("text", "example", "meant"),
    [
        ("0.014", "14 um", "'0.014 mm'"),
        ("14", "14 um", "'14 um'"),
        ("28", "350 bar", "'28 MPa'"),
        ("280", "350 bar", "'280 bar'"),
        ("0", "14 um", "'0 um'"),
        (0.01, "22 mm", "'0.01 m'"),
        (0.001, "22 mm", "'0.001 m'"),
        (1e-5, "14 um", "'1e-05 m'"),
    ],
)
def test_a_bare_number_gets_the_unit_in_which_it_is_nearest_to_the_usual_value(text, example, meant):
    dimension = Dimension.PRESSURE if "bar" in example else Dimension.LENGTH
    with pytest.raises(QuantityError) as caught:
        parse_quantity(text, dimension, example=example)
    assert caught.value.nearest == meant


@pytest.mark.parametrize(("text", "value"), [("0.5", 0.5), ("50%", 0.5), ("7 %", 0.07), ("1", 1.0)])
def test_a_share_may_be_in_percent(text, value):
    assert parse_share(text) == value


@pytest.mark.parametrize("text", ["nan", "inf", "1e999", "nan %", "half"])
def test_a_share_is_a_finite_number(text):
    with pytest.raises(QuantityError, match="a share in %"):
        parse_share(text)


@pytest.mark.parametrize(
    ("text", "dimension", "meant"),
    [
        ("50 C", Dimension.TEMPERATURE, "'50 degC'"),
        ("180 LPM", Dimension.VOLUME_FLOW, "'180 L/min'"),
        ("350 Bar", Dimension.PRESSURE, "'350 bar'"),
        ("2100 RPM", Dimension.ANGULAR_SPEED, "'2100 rpm'"),
        ("60 ccm", Dimension.DISPLACEMENT, "'60 cm3/rev'"),
        ("2100 rmp", Dimension.ANGULAR_SPEED, "'2100 rpm'"),
        ("35 mpa", Dimension.PRESSURE, "'35 MPa'"),
        ("50 gpm", Dimension.VOLUME_FLOW, "'50 gallon/min'"),
        ("50 US gal/min", Dimension.VOLUME_FLOW, "'50 gallon/min'"),
        ("90 in-lbf", Dimension.TORQUE, "'90 lbf inch'"),
        ("90 lb-ft", Dimension.TORQUE, "'90 lbf ft'"),
        ("2100 tr/min", Dimension.ANGULAR_SPEED, "'2100 rpm'"),
        ("5000 psig", Dimension.PRESSURE, "'5000 psi'"),
    ],
)
def test_what_benches_write_is_understood_as_a_hint(text, dimension, meant):
    with pytest.raises(QuantityError) as caught:
        parse_quantity(text, dimension)
    assert caught.value.nearest == meant
    with pytest.raises(QuantityError) as caught:
        unit_scale(text.partition(" ")[2], dimension)
    assert caught.value.nearest == f"'{meant.partition(' ')[2]}"
