"""Rough elastic walls in compiled loops, against the deformation of the general solver."""

from __future__ import annotations

import numpy as np
import pytest
from floating_journal import SUMMITS

from reynolds.equation.deformation import Meeting, settled_deformation
from reynolds.errors import FilmNotConverged
from reynolds.floating.joint_walls import _settled
from reynolds.numerics.array_kernels import largest

VERTICES, UNKNOWNS = 40, 30


def _meeting(soft: float) -> Meeting:
    """Vertices of which the last share unknowns with the first, some in a pocket; walls that spread what they bear."""
    rng = np.random.default_rng(3)
    seats = np.concatenate([np.arange(UNKNOWNS), np.arange(VERTICES - UNKNOWNS)]).astype(np.int32)
    oil = rng.uniform(size=VERTICES) < 0.1
    shares = np.where(oil, 0.0, 1.0 / np.bincount(seats)[seats])
    apart = np.abs(seats[:, None] - np.arange(UNKNOWNS))
    return Meeting(soft * np.exp(-apart / 4.0), SUMMITS, oil, seats, shares)


@pytest.mark.parametrize("soft", [1e-16, 1e-14, 1e-13])
@pytest.mark.parametrize("deep", [8.0, 1.0, -1.5])
def test_walls_settle_as_in_the_general_solver(soft: float, deep: float) -> None:
    """Apart, where few asperities touch, and where all do; stiff walls and walls softer than their asperities."""
    meeting = _meeting(soft)
    along = np.linspace(0.0, 2.0 * np.pi, UNKNOWNS, endpoint=False)
    given = (SUMMITS.summit_height + SUMMITS.height * (deep + 2.0 * np.cos(along)))[meeting.seats]
    alone = np.asarray(meeting.compliance @ (1e7 * (1.0 + np.sin(along))))
    expected = settled_deformation(meeting, given, alone, alone)
    found, touch = _settled(meeting, given, alone, alone)
    assert found == pytest.approx(expected, abs=1e-11 * np.abs(given).max())
    reference = meeting.at(given + expected)
    assert np.array_equal(touch.felt, reference.felt)
    assert deep > 0.0 or touch.felt.size > 2
    # The table of contact is accurate to 1e-8 of its largest pressure.
    assert touch.bears.value == pytest.approx(reference.bears.value, abs=1e-6 * max(reference.bears.value.max(), 1.0))


@pytest.mark.parametrize("soft", [1e-14, 1e-13])
def test_walls_settle_from_far_in_each_other(soft: float) -> None:
    """Forty standard deviations of the summits: contact begins where it bears, and in the end the walls balance it."""
    meeting = _meeting(soft)
    given = np.full(VERTICES, SUMMITS.summit_height - 40.0 * SUMMITS.height)
    found, touch = _settled(meeting, given, np.zeros(VERTICES), np.zeros(VERTICES))
    bears = np.where(meeting.oil, 0.0, touch.bears.value)
    pressed = np.bincount(meeting.seats, meeting.shares * bears, UNKNOWNS)
    assert found == pytest.approx(meeting.compliance @ pressed, abs=1e-6 * found.max())


def test_walls_that_do_not_settle_end_with_an_error() -> None:
    meeting = _meeting(1e-14)
    given = np.full(VERTICES, SUMMITS.summit_height)
    with pytest.raises(FilmNotConverged, match="walls in contact"):
        _settled(meeting, given, np.full(VERTICES, np.nan), np.zeros(VERTICES))


def test_largest_magnitude() -> None:
    assert largest(np.array([])) == 0.0
    assert largest(np.array([1.0, -3.0, 2.0])) == 3.0
    assert np.isnan(largest(np.array([1.0, np.nan, 2.0])))
