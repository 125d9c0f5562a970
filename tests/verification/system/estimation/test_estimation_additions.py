"""Search for what a model lacks, on linear laws whose evidence is known exactly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from reynolds import Array, InputError, NotConverged
from system import (
    FunctionSimulator,
    Observations,
    Parameter,
    Role,
    Scale,
    additions,
    held_out,
    independent_observations,
    ladder,
    maximum_posterior,
)

POINTS, SPREAD = 40, 100.0
COLUMNS = np.linalg.qr(np.random.default_rng(3).standard_normal((POINTS, 4)))[0].T
"""Orthonormal, so that a size of 30 is 30 sigma of the readings."""
SHAPES: Mapping[str, Array] = {
    "level": COLUMNS[0],
    "first": COLUMNS[1],
    "second": COLUMNS[2],
    "both": COLUMNS[1] + COLUMNS[2] + 0.4 * COLUMNS[3],
    "twin": COLUMNS[1] + 0.01 * COLUMNS[3],
}
NOISE = np.random.default_rng(4).standard_normal(POINTS)


def parameter(name: str) -> Parameter:
    return Parameter(name, Role.EXTENSION, Scale.NORMAL, 0.0, SPREAD, -np.inf, np.inf, None, "test")


def law(values: Mapping[str, float]) -> Array:
    """The sum of the named shapes; a model with `broken` has no solution."""
    if "broken" in values:
        raise NotConverged("no solution")
    return np.sum([size * SHAPES[name] for name, size in values.items()], axis=0)[:, None]


MODEL = FunctionSimulator(law, (parameter("level"),))


def read(**sizes: float) -> Observations:
    return independent_observations(["reading"], law({"level": 5.0, **sizes}) + NOISE[:, None], np.array([1.0]))


def possible(*names: str) -> dict[str, Sequence[Parameter]]:
    return {name: (parameter(name),) for name in names}


def evidence(readings: Observations, *names: str) -> float:
    """ln of the normal density of the readings under a sum of shapes with their priors."""
    covariance = np.eye(POINTS) + SPREAD**2 * sum(np.outer(SHAPES[name], SHAPES[name]) for name in names)
    return float(multivariate_normal(cov=covariance).logpdf(readings.values[:, 0]))


def test_the_gain_of_an_addition_is_the_exact_ratio_of_evidences():
    readings = read(first=30.0, second=3.0)
    rung = additions(MODEL, readings, possible("second", "first"))
    assert [one.name for one in rung.tried] == ["first", "second"]
    for one in rung.tried:
        assert one.gain == pytest.approx(evidence(readings, "level", one.name) - evidence(readings, "level"), abs=1e-3)
    size, sigma = rung.tried[0].size("first")
    assert size == pytest.approx(30.0 + NOISE @ SHAPES["first"], rel=1e-3)
    assert sigma == pytest.approx(1.0, rel=1e-3)


def test_nothing_is_taken_where_nothing_is_missing():
    found = ladder(MODEL, read(), possible("first", "second"))
    assert found.kept == ()
    assert len(found.rungs) == 1
    assert found.rungs[0].taken is None
    assert found.rungs[0].rivals == ()
    assert found.fit is found.before


def test_a_ladder_takes_one_after_the_other_and_ends_where_none_gains():
    found = ladder(MODEL, read(first=60.0, second=30.0), possible("second", "first"))
    assert found.kept == ("first", "second")
    assert [rung.taken and rung.taken.name for rung in found.rungs] == ["first", "second", None]
    values = dict(zip((one.name for one in found.fit.parameters), found.fit.values, strict=True))
    for name, size in (("first", 60.0), ("second", 30.0), ("level", 5.0)):
        assert values[name] == pytest.approx(size + NOISE @ SHAPES[name], rel=1e-3)


def test_steps_end_at_the_most():
    found = ladder(MODEL, read(first=60.0, second=30.0), possible("second", "first"), most=1)
    assert found.kept == ("first",)


def test_an_earlier_addition_that_the_later_ones_replace_is_dropped():
    """A shape near the sum of two is the best alone; beside these two it explains nothing more."""
    found = ladder(MODEL, read(first=30.0, second=60.0), possible("first", "second", "both"))
    assert [rung.taken and rung.taken.name for rung in found.rungs][:3] == ["both", "second", "first"]
    assert found.rungs[2].dropped == ("both",)
    assert found.kept == ("second", "first")


def test_an_addition_without_which_no_fit_is_found_stays_with_the_reason():
    """As above, but the two alone have no solution."""

    def needs_both(values: Mapping[str, float]) -> Array:
        if {"first", "second"} <= set(values) and "both" not in values:
            raise NotConverged("no solution of the two")
        return law(values)

    model = FunctionSimulator(needs_both, (parameter("level"),))
    found = ladder(model, read(first=30.0, second=60.0), possible("first", "second", "both"))
    assert found.rungs[2].dropped == ()
    (told,) = found.rungs[2].unfitted
    assert told.startswith("both: ")
    assert "no solution of the two" in told
    assert set(found.kept) == {"both", "second", "first"}


def test_additions_that_readings_do_not_tell_apart_are_rivals():
    found = ladder(MODEL, read(first=30.0), possible("first", "twin", "second"))
    (kept,) = found.kept
    assert {kept, *found.rivals(kept)} == {"first", "twin"}


def test_an_addition_that_fails_is_told_and_the_others_count():
    rung = additions(MODEL, read(first=30.0), possible("broken", "first"))
    (failure,) = rung.failed
    assert failure.startswith("broken: ")
    assert failure.endswith("no solution")
    assert rung.taken is not None
    assert rung.taken.name == "first"


def test_an_addition_that_the_model_has_is_left_out():
    assert additions(MODEL, read(), possible("level")).tried == ()


def test_a_ladder_without_possible_additions_is_refused():
    with pytest.raises(InputError, match="no possible addition"):
        ladder(MODEL, read(), {})


def test_held_out_readings_are_those_of_fits_without_their_block():
    readings = read(first=30.0)
    fit = maximum_posterior(MODEL, readings)
    left = np.empty(POINTS)
    for block in np.unique(readings.blocks):
        rows = readings.blocks == block
        without = maximum_posterior(MODEL, readings.without(rows))
        left[rows] = (readings.values - MODEL.predict(without.values))[rows, 0]
    assert held_out(fit, readings) == pytest.approx(np.sqrt(np.mean(left**2)), rel=1e-5)
