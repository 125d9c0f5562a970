"""Formulas of case files: what they compute, and what they refuse."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from swashfilm.case.fields.expressions import LONGEST, ExpressionError, parse_expression

X, Y = np.array([0.1, 0.5, 2.0]), np.array([-1.0, 0.3, 4.0])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2", np.full(3, 2.0)),
        ("x + 2*y - 1/4", X + 2 * Y - 0.25),
        ("-x**2", -(X**2)),
        ("2**-x", 2.0**-X),
        ("1e-5*(2-x/0.01)", 1e-5 * (2 - X / 0.01)),
        ("sin(pi*x)*exp(-y) + hypot(x, y)", np.sin(np.pi * X) * np.exp(-Y) + np.hypot(X, Y)),
        ("where(x < 0.3, 2e-5, 1e-5)", np.array([2e-5, 1e-5, 1e-5])),
        ("where(0.3 <= x < 1 and not y < 0, 1, 0)", np.array([0.0, 1.0, 0.0])),
        ("where(x < 0.3 or y > 3, 1, 0)", np.array([1.0, 0.0, 1.0])),
        ("min(x, max(y, 0.2)) + abs(y)", np.minimum(X, np.maximum(Y, 0.2)) + abs(Y)),
        ("atan2(y, x)", np.arctan2(Y, X)),
        ("r*phi", np.hypot(X, Y) * np.arctan2(Y, X)),
    ],
)  # fmt: skip
def test_a_formula_has_the_value_that_numpy_gives_it(text, expected):
    np.testing.assert_allclose(parse_expression(text)(X, Y), expected, rtol=1e-15)


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
def test_arithmetic_is_that_of_floats(a, x, y):
    text = f"({a!r})*x - y/3 + x*y"
    assert parse_expression(text)(np.array([x]), np.array([y]))[0] == a * x - y / 3 + x * y


def test_where_a_formula_has_no_value_it_is_not_finite_and_nothing_is_raised():
    assert np.isinf(parse_expression("1/(x-0.1)")(X, Y)[0])
    assert np.isnan(parse_expression("sqrt(y)")(X, Y)[0])
    assert np.isinf(parse_expression("9**9**9**9")(X, Y)).all()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1 + z", ["unknown name z", "column 5", "x, y, r, phi, pi"]),
        ("1 + sine(x)", ["unknown function sine", "column 5"]),
        ("2*(x", ["syntax error", "column 3"]),
        ("x^2", ["^", "**"]),
        ("t*x", ["t at column 1", "[time]"]),
        ("hypot(x)", ["1 arguments of hypot", "2"]),
        ("x if y else 1", ["not arithmetic"]),
        ("x == y", ["< <= > >="]),
        ("[1, 2]", ["not arithmetic"]),
        ("'text'", ["not arithmetic"]),
        ("True", ["not arithmetic"]),
        ("1j", ["not arithmetic"]),
        ("x.__class__", ["not arithmetic"]),
        ("__import__('os').system('true')", ["not arithmetic"]),
        ("(lambda: 1)()", ["not arithmetic"]),
        ("sin(x=1)", ["not arithmetic"]),
        ("x\0", ["formula of x, y, r and phi"]),
        ("-" * 1500 + "x", ["too deep"]),
        ("x" * (LONGEST + 1), [str(LONGEST)]),
    ],
)
def test_what_is_no_formula_is_refused_and_says_where(text, words):
    with pytest.raises(ExpressionError) as refused:
        parse_expression(text)
    for word in words:
        assert word in str(refused.value)


def test_a_misspelt_function_is_told_the_nearest():
    with pytest.raises(ExpressionError) as refused:
        parse_expression("sqr(x)")
    assert refused.value.nearest == "sqrt"


def test_constants_stand_in_a_formula_by_name():
    formula = parse_expression("height*(1 + ratio*x)", constants={"height": 2.0, "ratio": 0.5})
    np.testing.assert_allclose(formula(X, Y), 2.0 * (1.0 + 0.5 * X), rtol=1e-15)
    with pytest.raises(ExpressionError, match="unknown name heigth") as refused:
        parse_expression("heigth*x", constants={"height": 2.0})
    assert refused.value.nearest == "height"
