"""Profiles of faces and pistons: each shape against its formula, its slopes against differences; courses."""

from __future__ import annotations

import numpy as np
import pytest

from gaps import DepthPoints, EdgeRelief, Effect, FilmLaws, PeriodicCurve, Physics, Profile, Waviness, constant
from gaps.films.physics import laws_left
from gaps.shapes.profiles import PLAIN, Barrel, Crown, PointsAround, RingGroove
from reynolds import CONSTANT, Asperities, Cavitation, FilmInputError, Surface

LENGTH = 40e-3
WORN = PointsAround((0.0, 15e-3, LENGTH), (0.5, 2.0, 4.0), ((0.0, 1e-6, 2e-6), (3e-6, 1e-6, 0.0), (5e-6, 2e-6, 4e-6)))
SHAPES = [
    Barrel(LENGTH, 5e-6),
    Crown(LENGTH, -2e-6),
    EdgeRelief(LENGTH, 30e-3, 3e-6),
    EdgeRelief(0.0, 4e-3, 3e-6),
    RingGroove(10.03e-3, 0.5e-3, 0.3e-3),
    Waviness(3, 1e-6, 0.4),
    DepthPoints((0.0, 13.3e-3, LENGTH), (3e-6, 0.0, 1e-6)),
    WORN,
]
# Places and angles between the knees, so that differences stay on one piece.
PLACE = np.linspace(0.3e-3, LENGTH - 0.3e-3, 23).reshape(1, -1)
ANGLE = np.linspace(-7.0, 9.1, 23).reshape(1, -1)


@pytest.mark.parametrize("shape", [*SHAPES, Profile(tuple(SHAPES))])
def test_slopes(shape):
    """Central differences of a piecewise parabola are exact, of a cosine to (waves step)^2/6."""
    step, turn = 1e-6, 1e-5
    found = shape(PLACE, ANGLE)
    along = (shape(PLACE + step, ANGLE).depth - shape(PLACE - step, ANGLE).depth) / (2.0 * step)
    around = (shape(PLACE, ANGLE + turn).depth - shape(PLACE, ANGLE - turn).depth) / (2.0 * turn)
    round_off = 1e-15 * np.abs(found.depth).max()
    assert found.along == pytest.approx(along, abs=1e-9 * np.abs(along).max() + round_off / step)
    assert found.around == pytest.approx(around, abs=1e-9 * np.abs(around).max() + round_off / turn)
    assert found.depth.shape == found.along.shape == found.around.shape == PLACE.shape


@pytest.mark.parametrize(
    ("shape", "place", "angle", "depth"),
    [
        (Barrel(LENGTH, 5e-6), 0.0, 0.0, 5e-6),
        (Barrel(LENGTH, 5e-6), 0.5 * LENGTH, 0.0, 0.0),
        (Barrel(LENGTH, 5e-6), 0.75 * LENGTH, 0.0, 1.25e-6),
        (Crown(14e-3, 2e-6), 7e-3, 0.0, 0.5e-6),
        (Crown(14e-3, -2e-6), 14e-3, 0.0, -2e-6),
        (EdgeRelief(14e-3, 11e-3, 2e-6), 14e-3, 0.0, 2e-6),
        (EdgeRelief(14e-3, 11e-3, 2e-6), 12.5e-3, 0.0, 0.5e-6),
        (EdgeRelief(14e-3, 11e-3, 2e-6), 9e-3, 0.0, 0.0),
        (EdgeRelief(0.0, 3e-3, 2e-6), 0.0, 0.0, 2e-6),
        (RingGroove(10e-3, 1e-3, 3e-4), 10.4e-3, 0.0, 3e-4),
        (RingGroove(10e-3, 1e-3, 3e-4), 10.6e-3, 0.0, 0.0),
        (Waviness(2, 1e-6, 0.3), 0.0, 0.3, 1e-6),
        (Waviness(2, 1e-6, 0.3), 0.0, 0.3 + 0.5 * np.pi, -1e-6),
        (DepthPoints((0.0, 2e-3), (3e-6, 1e-6)), 0.5e-3, 0.0, 2.5e-6),
        (WORN, 15e-3, 2.0, 1e-6),
        (WORN, 7.5e-3, 1.25, 1.25e-6),  # middle of a cell: mean of its corners
        (WORN, 0.0, 0.5 * (4.0 + 0.5 + 2.0 * np.pi), 1e-6),  # across the seam
        (WORN, 0.0, 2.0 + 6.0 * np.pi, 1e-6),
        (PLAIN, 5e-3, 1.0, 0.0),
    ],
)
def test_depths(shape, place, angle, depth):
    found = shape(np.array([place]), np.array([angle])).depth
    assert found == pytest.approx([depth], abs=1e-18)


def test_sum_of_shapes():
    total = Profile(tuple(SHAPES))(PLACE, ANGLE).depth
    assert total == pytest.approx(sum(shape(PLACE, ANGLE).depth for shape in SHAPES), rel=1e-14)


def test_shapes_join_without_a_jump():
    """At a measured point depth is continuous, and at the inner end of an edge relief its slope too."""
    for shape, place in ((SHAPES[6], 13.3e-3), (WORN, 15e-3), (SHAPES[2], 30e-3)):
        before, after = (shape(np.array([place + side]), np.array([0.7])) for side in (-1e-12, 1e-12))
        assert after.depth == pytest.approx(before.depth, abs=1e-14)
    assert after.along == pytest.approx(before.along, abs=1e-12)


@pytest.mark.parametrize(
    ("make", "fault"),
    [
        (
            lambda: DepthPoints((0.0, 0.0), (1e-6, 0.0)),
            r"profile, places: \[0\.0, 0\.0\]; expected two or more that rise",
        ),
        (
            lambda: DepthPoints((0.0, 2e-3, 1e-3), (1e-6, 0.0, 0.0)),
            r"profile, places: \[0\.0, 0\.002, 0\.001\]; expected two or more that rise",
        ),
        (lambda: DepthPoints((0.0, 1e-3), (1e-6,)), r"profile, depths: an array of shape \(1,\)"),
        (lambda: DepthPoints((0.0, 1e-3), (1e-6, np.nan)), "profile, depths"),
        (lambda: PointsAround((0.0, 1.0), (0.0, 6.5), ((0.0, 0.0), (0.0, 0.0))), "profile, angles: 372"),
        (lambda: EdgeRelief(1e-3, 1e-3, 1e-6), "edge relief: from 0.001 to 0.001 m; expected two places apart"),
        (lambda: RingGroove(1e-3, 0.0, 1e-6), "ring groove, width"),
        (lambda: Barrel(-1.0, 1e-6), "barrel, length"),
        (lambda: DepthPoints((0.0, 1e-3), (1e-6, 0.0))(np.array([1.1e-3]), np.zeros(1)), "profile, place: 0.0011"),
    ],
)
def test_refused(make, fault):
    with pytest.raises(FilmInputError, match=fault):
        make()


def _wave(angle: np.ndarray) -> np.ndarray:
    return np.column_stack([np.sin(angle), 2.0 + np.cos(3.0 * angle)])


def test_course_passes_through_its_values_on_any_turn():
    angles = np.linspace(0.0, 2.0 * np.pi, 37)[:-1] + 0.1
    course = PeriodicCurve(angles, _wave(angles))
    for turn in (-1, 0, 5):
        for k in (0, 17, 35):
            assert course(angles[k] + 2.0 * np.pi * turn) == pytest.approx(_wave(angles)[k], abs=1e-12)


def test_course_converges(validation, refine):
    """Monotone cubics: of second order at extrema, where they are flat."""

    def solve(n: int) -> float:
        angles = 2.0 * np.pi * np.arange(n) / n
        course = PeriodicCurve(angles, _wave(angles)[:, 0])
        between = 2.0 * np.pi * (np.arange(400) + 0.37) / 400
        return float(max(abs(course(angle) - np.sin(angle)) for angle in between))

    found = refine(solve, (30, 60, 120))
    validation(
        case="Course over a turn",
        source="sine, known in closed form",
        quantity="largest error between angles",
        unit="1",
        expected=0.0,
        obtained=found.finest,
        tolerance=(2.0 * np.pi / 120) ** 2 / 8.0,
        order=found.order,
        note="tolerance: a parabola's fall from its top to a chord",
    )


def test_course_stays_within_its_values():
    """A chamber's pressure that jumps has no overshoot; its slope is the same from both sides of the wrap."""
    angles = 2.0 * np.pi * np.arange(40) / 40
    course = PeriodicCurve(angles, np.where(np.sin(angles) > 0.0, -1e5, 35e6))
    between = np.array([float(course(angle)) for angle in np.linspace(-1.0, 8.0, 2001)])
    assert between.min() == -1e5
    assert between.max() == pytest.approx(35e6)
    step = 1e-6
    left = (course(0.0) - course(-step)) / step
    right = (course(step) - course(0.0)) / step
    curvature = 6.0 * 35e6 / angles[1] ** 2  # of a cubic from flat to flat
    assert left == pytest.approx(right, abs=curvature * step)
    assert constant(3.0)(1.0) == 3.0
    assert constant(3.0, 4.0)(1.0) == pytest.approx([3.0, 4.0])


def test_a_plateau_is_never_left_by_rounding():
    """Where a pressure falls to a cavity's, cubics round an ulp below it just before the angle: one in six did."""
    lowest, draws = 1e3 - 101325.0, np.random.default_rng(1)
    angles = 2.0 * np.pi * np.arange(440) / 440
    for swing in 10.0 ** draws.uniform(5.1, 7.5, 40):
        course = PeriodicCurve(angles, np.maximum(swing * np.cos(angles), lowest))
        assert min(float(course(angle)) for angle in np.nextafter(angles, -1.0)) == lowest


@pytest.mark.parametrize(
    ("angles", "values", "fault"),
    [
        ([0.0, 1.0, 2.0], [1.0, 2.0, 3.0], "course over a turn, angles: 3 from 0 to 114"),
        ([0.0, 1.0, 2.0, 6.5], [1.0, 2.0, 3.0, 4.0], "rising, within one turn"),
        ([0.0, 1.0, 2.0, 3.0], [1.0, 2.0, 3.0, np.inf], "course over a turn, values"),
    ],
)
def test_course_refused(angles, values, fault):
    with pytest.raises(FilmInputError, match=fault):
        PeriodicCurve(np.array(angles), np.array(values))


def test_physics_switches():
    asperities = Asperities(1e10, 1e-5, 4e-7, 8e10, 0.1)
    surface = Surface(0.4e-6, 0.3e-6)
    laws = FilmLaws(surface=surface, asperities=asperities)
    bare = Physics().without(Effect.ROUGHNESS, Effect.CAVITATION)
    assert laws_left(laws, Physics()) == laws
    assert laws_left(laws, bare) == FilmLaws(fluid=CONSTANT)
    assert (Physics().film_rupture, bare.film_rupture) == (Cavitation.JFO, Cavitation.NONE)
    assert bare.left_out == (Effect.CAVITATION, Effect.ROUGHNESS)
    assert bare.including(Effect.ROUGHNESS, Effect.CAVITATION) == Physics()
