"""Distances of suspects and the choice of points, on linear readings of which all is known in closed form."""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
import pytest
from numpy.typing import NDArray

from diagnosis import load_thresholds
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.next_point.discrimination import _exchanged, added_points, promise
from diagnosis.planning.apart import Contest, PairCampaign, all_pairs
from diagnosis.planning.design import spread_order, wanted_distance
from diagnosis.planning.responses import White
from diagnosis.planning.suspects import Suspect
from reynolds import Array
from system import EffectId
from system.effects.effect import Kind
from system.work.progress import silent

WIDE = 1e6


def _suspect(at: int, count: int, size: float, effect: EffectId = EffectId.CHURNING) -> Suspect:
    truth = np.zeros(count)
    truth[at] = size
    own = Hypothesis((effect,), None, Kind.MISSING_PHYSICS, (), (), 0.0)
    return Suspect(f"s{at}", f"s{at}", own, ((at,),), truth, 0.01, False, "")


def _contest(columns: Array, slopes: Array, sizes: Array, widths: Array, signs: Array | None = None) -> Contest:
    """One reading a point: columns (N, Q), slopes (N, k) of parameters of prior N(0, 1)."""
    count = columns.shape[1]
    suspects = [_suspect(at, count, float(size)) for at, size in enumerate(sizes)]
    white = White(slopes[:, None, :], columns[:, None, :])
    return Contest(white, suspects, widths, np.zeros(count) if signs is None else signs)


def _random(seed: int, points: int = 7, suspects: int = 4) -> Contest:
    rng = np.random.default_rng(seed)
    return _contest(
        rng.normal(size=(points, suspects)), rng.normal(size=(points, 2)), rng.uniform(1.0, 3.0, suspects),
        rng.uniform(0.5, 2.0, suspects),
    )  # fmt: skip


def _exact(contest: Contest, counts: Array, truth: int, rival: int) -> float:
    """t^T (noise + all that is uncertain)^-1 t, each reading by itself."""
    rows = np.repeat(np.arange(len(counts)), counts)
    columns, slopes = contest.white.columns[rows, 0], contest.white.slopes[rows, 0]
    covariance = np.eye(len(rows)) + slopes @ slopes.T
    covariance += contest.widths[rival] ** 2 * np.outer(columns[:, rival], columns[:, rival])
    told = columns @ contest.truths[:, truth]
    return float(told @ np.linalg.solve(covariance, told))


@pytest.mark.parametrize("seed", range(5))
def test_distance_is_that_of_the_joint_normal_law(seed: int) -> None:
    """After the rival's best fit the square left is that of the readings' covariance with all priors in it."""
    contest, counts = _random(seed), np.array([1, 0, 2, 1, 3, 1, 1])
    squares = contest.apart(counts).squares
    for truth, rival in ((0, 1), (1, 0), (2, 3), (3, 1)):
        assert squares[truth, rival] == pytest.approx(_exact(contest, counts, truth, rival), rel=1e-9)


def test_the_distance_of_a_line_from_a_level_is_its_scatter() -> None:
    """y = x against y = b with b free: d^2 = sum (x - mean)^2, and equally many readings at both ends are best."""
    x = np.linspace(-1.0, 1.0, 9)
    contest = _contest(np.column_stack([x, np.ones(9)]), np.zeros((9, 1)), np.ones(2), np.array([WIDE, WIDE]))
    counts = np.array([1, 0, 0, 0, 2, 0, 0, 1, 0])
    readings = np.repeat(x, counts)
    square = contest.apart(counts).squares[0, 1]
    assert square == pytest.approx(np.sum((readings - readings.mean()) ** 2), rel=1e-6)
    found = added_points(PairCampaign(contest, ((0, 1),), 50.0), np.zeros(9, dtype=int), np.full(9, 9), 6, 1e-6)
    assert sorted(found.points) == [0, 0, 0, 8, 8, 8]
    assert contest.apart(np.bincount(found.points, minlength=9)).squares[0, 1] == pytest.approx(6.0, rel=1e-6)


def test_a_size_of_one_sign_does_not_follow_the_other_way() -> None:
    """A rival that can only lower a reading takes nothing of one that is raised, and all of one of either sign."""
    columns = np.column_stack([np.ones(4), -np.ones(4), np.ones(4)])
    signs = np.array([1.0, 1.0, 0.0])
    contest = _contest(columns, np.zeros((4, 1)), np.array([1.0, 1.0, 1.0]), np.full(3, WIDE), signs)
    squares = contest.apart(np.ones(4, dtype=int)).squares
    assert squares[0, 1] == pytest.approx(4.0)
    assert squares[1, 0] == pytest.approx(4.0)
    assert squares[2, 0] == pytest.approx(0.0, abs=1e-6)
    assert squares[2, 1] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_a_further_reading_never_brings_a_pair_together(seed: int) -> None:
    contest, rng = _random(seed), np.random.default_rng(100 + seed)
    counts = rng.integers(0, 3, 7)
    before = contest.apart(counts).distances
    for point in range(7):
        more = counts.copy()
        more[point] += 1
        assert np.all(contest.apart(more).distances >= before - 1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_what_a_reading_promises_is_what_it_brings(seed: int) -> None:
    """The promise of every point is the rise of the sum by a reading there, each pair up to what is wanted."""
    contest, counts = _random(seed), np.array([1, 0, 1, 0, 1, 0, 1])
    campaign = PairCampaign(contest, all_pairs(4), 2.0)
    rises = []
    for point in range(7):
        more = counts.copy()
        more[point] += 1
        rises.append(campaign.total(more) - campaign.total(counts))
    np.testing.assert_allclose(campaign.promised(counts), rises, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_added_points_are_nearly_the_best_of_all_choices(seed: int) -> None:
    """One by one and exchanged, three readings reach 97 % of the best of all 84 choices."""
    contest, counts = _random(seed), np.zeros(7, dtype=int)
    campaign = PairCampaign(contest, all_pairs(4), 3.0)
    found = added_points(campaign, counts, np.full(7, 3), 3, 1e-6)
    every = combinations_with_replacement(range(7), 3)
    best = max(campaign.total(np.bincount(chosen, minlength=7)) for chosen in every)
    assert found.totals[-1] >= 0.97 * best
    assert np.all(np.diff(found.totals) >= -1e-9)


def test_nothing_is_added_where_no_point_tells_more() -> None:
    """Two suspects of one column, and a pair that is apart already, ask for no reading."""
    same = _contest(np.ones((5, 2)), np.zeros((5, 1)), np.ones(2), np.full(2, WIDE))
    counts, most = np.ones(5, dtype=int), np.full(5, 9)
    assert added_points(PairCampaign(same, ((0, 1),), 3.0), counts, most, 4, 1e-3).points == ()
    line = np.column_stack([np.linspace(-20.0, 20.0, 5), np.ones(5)])
    apart = _contest(line, np.zeros((5, 1)), np.array([1.0, 20.0]), np.full(2, WIDE))
    assert added_points(PairCampaign(apart, ((0, 1),), 3.0), counts, most, 4, 1e-3).points == ()


def test_a_settled_pair_draws_no_more_readings() -> None:
    """A promise counts up to what is wanted."""
    found = promise(np.array([4.0, 1.0]), np.array([[9.0, 0.5], [0.0, 1.0]]), 5.0)
    np.testing.assert_allclose(found, [1.0, 1.5])


def test_the_wanted_distance_keeps_the_promise_of_the_next_test() -> None:
    """ln odds of mean d^2/2 and sigma d are 20 to 1 with the chance that a next point has to promise."""
    limits = load_thresholds().next_point
    d = wanted_distance(limits)
    draws = np.random.default_rng(1).normal(0.5 * d**2, d, 400_000)
    assert np.mean(draws >= np.log(limits.odds)) == pytest.approx(limits.promised, abs=0.003)


def test_places_in_the_order_are_mixed() -> None:
    order = spread_order(40)
    assert len(set(order.round(6))) == 40
    assert abs(np.corrcoef(order, np.arange(40))[0, 1]) < 0.1


def test_laws_nearer_than_they_are_true_are_not_told_apart() -> None:
    """Two forms that differ by a hundredth of themselves stay one, however large: 400 sigma seen, 4 sigma apart."""
    line = np.column_stack([np.ones(4), np.ones(4) + np.array([0.01, -0.01, 0.01, -0.01])])
    contest = _contest(line, np.zeros((4, 1)), np.full(2, 200.0), np.full(2, WIDE))
    apart = contest.apart(np.ones(4, dtype=int))
    assert apart.distances[0, 1] == pytest.approx(4.0, rel=1e-3)
    assert not contest.told(apart, 3.4, load_thresholds().form)[0, 1]
    wide = _contest(
        np.column_stack([np.linspace(-1, 1, 4), np.ones(4)]), np.zeros((4, 1)), np.full(2, 20.0), np.ones(2)
    )
    assert wide.told(wide.apart(np.ones(4, dtype=int)), 3.4, load_thresholds().form)[0, 1]


def test_points_are_exchanged_until_none_is_better() -> None:
    """What a point promises changes with the others: the best of three is seen once the second has been taken."""
    worth = np.array([1.0, 2.0, 3.0])

    class Campaign:
        looks = 0

        def total(self, counts: NDArray[np.int64]) -> float:
            return float(worth @ counts)

        def promised(self, counts: NDArray[np.int64]) -> Array:
            self.looks += 1
            return np.where(np.arange(3) == min(self.looks, 2), 1.0, 0.0)

    counts = np.zeros(3, dtype=np.int64)
    assert _exchanged(Campaign(), counts, np.ones(3, dtype=np.int64), [0], silent) == [2]
