"""Response tables: points, interpolant, held-out error.

Functions of four inputs that are known everywhere: what the held-out points say is compared with what a dense set
of other points says.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps import Axis, Response
from gaps.response import Measure, Output, Samples, Spacing, fewest_learnt, held_out_points, learnt_points
from reynolds import FilmInputError

AXES = (
    Axis("shaft speed", 40.0, 260.0, Spacing.LOGARITHMIC),
    Axis("delivery pressure", 2e6, 40e6, Spacing.LOGARITHMIC),
    Axis("displacement ratio", 0.1, 1.0, Spacing.LOGARITHMIC),
    Axis("viscosity", 5e-3, 0.1, Spacing.LOGARITHMIC),
)
SMOOTH = Output("friction", Measure.RELATIVE)
KINKED = Output("contact share", Measure.ABSOLUTE)


def hersey(points):
    """Viscosity times speed over pressure, 1 in the middle of it all."""
    speed, pressure, ratio, viscosity = points.T
    return (viscosity / 0.03) * (speed / 220.0) * ratio / (pressure / 35e6)


def friction(points):
    """A Stribeck curve without its kink: positive, over a decade and a half."""
    return 0.2 + 2.0 * np.sqrt(hersey(points))


def contact(points):
    """Nothing above a Hersey number of 0.2, rising linearly below: continuous, with a kink."""
    return np.maximum(0.2 - hersey(points), 0.0) / 0.2


def both(points):
    return np.stack([friction(points), contact(points)], axis=1)


def response(count, held_out=30, axes=AXES):
    learnt, tried = learnt_points(axes, count), held_out_points(axes, count, held_out)
    return Response(axes, (SMOOTH, KINKED), Samples(learnt, both(learnt)), Samples(tried, both(tried)))


def dense(axes=AXES, count=4000):
    """Random points, edges as likely as anything else."""
    places = np.random.default_rng(7).random((count, len(axes)))
    return np.stack([axis.from_unit(places[:, k]) for k, axis in enumerate(axes)], axis=1)


@pytest.fixture(scope="module")
def learnt():
    return response(120)


def test_learnt_points_are_met(learnt):
    assert learnt.errors(learnt.learnt) == pytest.approx(0.0, abs=1e-9)


def test_a_smooth_function_is_learnt_within_one_per_cent(learnt):
    assert learnt.held_out_error.largest[0] < 0.01
    assert response(240).held_out_error.rms[0] < learnt.held_out_error.rms[0]


def test_held_out_error_is_honest(learnt):
    """30 held-out points tell the RMS error of 4000 others within a factor of two, of either function.

    A mean square of 30 values, each of the sort that a chi-square is made of, scatters by sqrt(2/30) = 26 %;
    heavier tails scatter more.
    """
    points = dense()
    found = np.sqrt(np.mean(learnt.errors(Samples(points, both(points))) ** 2, axis=0))
    assert np.all(found < 2.0 * learnt.held_out_error.rms)
    assert np.all(found > 0.5 * learnt.held_out_error.rms)


def test_a_kink_is_told_by_its_error(learnt):
    """A bend between the points costs ten times what the smooth function does, and the held-out points show it."""
    error = learnt.held_out_error
    assert error.rms[1] > 10.0 * error.rms[0]
    worst = learnt.held_out.points[error.worst[1]]
    assert abs(float(contact(worst[None])[0]) - float(learnt.at(worst[None])[0, 1])) == pytest.approx(error.largest[1])


def test_a_region_of_large_error_is_told(learnt):
    """The smooth function has none; the kinked one's holds its worst point, and leaves out what is learnt well."""
    assert learnt.large_error(0, 0.03) is None
    region = learnt.large_error(1, 0.03)
    off = np.abs(learnt.errors(learnt.held_out)[:, 1])
    assert region.count == np.sum(off > 0.03)
    worst = learnt.held_out.points[learnt.held_out_error.worst[1]]
    assert np.all((region.lower <= worst) & (worst <= region.upper))
    assert region.count < len(off)


def test_corners_are_worth_their_points():
    """With corners the error over the whole box is less than with as many Sobol points more."""
    from scipy.stats.qmc import Sobol

    places = Sobol(4, scramble=False).fast_forward(1).random(120)
    alone = np.stack([axis.from_unit(places[:, k]) for k, axis in enumerate(AXES)], axis=1)
    points, tried = dense(), held_out_points(AXES, 120, 30)
    rest = Response(AXES, (SMOOTH, KINKED), Samples(alone, both(alone)), Samples(tried, both(tried)))
    without, given = (
        np.sqrt(np.mean(found.errors(Samples(points, both(points))) ** 2, axis=0)) for found in (rest, response(120))
    )
    assert given[0] < 0.5 * without[0]
    assert given[1] < without[1]


def test_more_points_begin_with_the_held_out():
    assert np.array_equal(learnt_points(AXES, 150)[120:], held_out_points(AXES, 120, 30))
    assert np.array_equal(learnt_points(AXES, 150)[:120], learnt_points(AXES, 120))


def test_points_lie_in_the_box_and_differ():
    points = learnt_points(AXES, 64)
    for k, axis in enumerate(AXES):
        assert points[:, k].min() == pytest.approx(axis.lower)
        assert points[:, k].max() == pytest.approx(axis.upper)
    assert len(np.unique(points, axis=0)) == 64


def test_nothing_is_extrapolated(learnt):
    inside = np.array([[axis.upper for axis in AXES]])
    assert np.all(np.isfinite(learnt.at(inside)))
    outside = inside * np.array([1.0, 1.01, 1.0, 0.01])
    with pytest.raises(FilmInputError, match="nothing is extrapolated") as told:
        learnt.at(outside)
    assert "delivery pressure" in told.value.where
    assert "viscosity" in told.value.where
    assert "speed" not in told.value.where
    with pytest.raises(FilmInputError):
        learnt.at(np.full((1, 4), np.nan))


def test_what_cannot_be_learnt_is_refused(learnt):
    values = learnt.learnt.values.copy()
    values[3, 0] = -1.0
    with pytest.raises(FilmInputError, match="friction"):
        Response(AXES, (SMOOTH, KINKED), Samples(learnt.learnt.points, values), learnt.held_out)
    few = Samples(learnt.learnt.points[:5], learnt.learnt.values[:5])
    with pytest.raises(FilmInputError, match="at least 10 points"):
        Response(AXES, (SMOOTH, KINKED), few, learnt.held_out)
    with pytest.raises(FilmInputError, match="at least 32"):
        learnt_points(AXES, 31)
    with pytest.raises(FilmInputError, match="below the upper"):
        Axis("speed", 2.0, 1.0)
    with pytest.raises(FilmInputError, match="above 0"):
        Axis("speed", 0.0, 1.0, Spacing.LOGARITHMIC)


def test_an_output_that_goes_as_an_inverse_is_learnt_with_its_powers():
    """y = (2 + x) / z over a decade of z: exact with the power of z, as a product that is linear; rough without."""
    axes = (Axis("x", 1.0, 2.0), Axis("z", 1.0, 10.0, Spacing.LOGARITHMIC))

    def samples(points):
        return Samples(points, ((2.0 + points[:, 0]) / points[:, 1])[:, None])

    def errors(output):
        learnt, held_out = learnt_points(axes, 8), held_out_points(axes, 8, 4)
        return Response(axes, (output,), samples(learnt), samples(held_out)).held_out_error.largest[0]

    assert errors(Output("y", Measure.ABSOLUTE, powers=(("z", 1.0), ("no axis", 1.0)))) < 1e-12
    assert errors(Output("y", Measure.ABSOLUTE)) > 0.02


def test_the_fewest_points_hold_all_corners_and_twice_a_linear_law():
    """2^d corners, and 2 (d + 1) points for the d + 1 coefficients of a linear law."""
    assert [fewest_learnt(inputs) for inputs in range(1, 6)] == [4, 6, 8, 16, 32]
