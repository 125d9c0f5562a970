"""Explanations that part by less than the form of a law can be off by: one class, its probability shared out."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis import Explanation, load_thresholds
from diagnosis.explain.model_error import by_chance, chance_of_form, class_gap, place_gap, shared_out
from diagnosis.explain.ranked import with_probabilities
from system import EffectId, Kind

LIMITS = load_thresholds()
OPENING, CHURNING = (EffectId.ELASTIC_OPENING,), (EffectId.CHURNING,)


def _weighed(gained: float, behind: float, second: tuple[EffectId, ...] = CHURNING) -> tuple[Explanation, ...]:
    """Nothing, and two explanations that gain so much over it, the second some nats behind the first."""
    kinds = (Kind.NO_MISMATCH, Kind.MISSING_PHYSICS, Kind.MISSING_PHYSICS)
    stated = zip(kinds, ((), OPENING, second), (-gained, 0.0, -behind), strict=True)
    return with_probabilities(
        [
            Explanation(
                SimpleNamespace(kind=kind, effects=effects, log_prior=-1.0),
                evidence,
                False,
                None,
                0.0,
                0.0,
                None,  # type: ignore[arg-type]
            )
            for kind, effects, evidence in stated
        ],
        LIMITS.name.temperature,
    )


def test_up_to_three_hundred_nats_noise_alone_makes_a_class() -> None:
    listed = _weighed(LIMITS.name.class_gap / LIMITS.form.true_to, behind=2.0)
    assert class_gap(listed, LIMITS) == LIMITS.name.class_gap
    found, members = shared_out(listed, listed[:2], class_gap(listed, LIMITS), LIMITS)
    assert [each.probability for each in found] == pytest.approx([each.probability for each in listed])
    assert members == found[:2]


def test_beyond_a_class_grows_with_what_is_explained() -> None:
    """Of 6000 nats 60 are form: 20 times the gap of 3, and 15 nats are odds of e^(15/(20 x .7))."""
    listed = _weighed(6000.0, behind=15.0)
    assert class_gap(listed, LIMITS) == pytest.approx(60.0)
    found, members = shared_out(listed, listed[:2], class_gap(listed, LIMITS), LIMITS)
    odds = members[0].probability / members[1].probability
    assert np.log(odds) == pytest.approx(15.0 / (20.0 * LIMITS.name.temperature))
    assert sum(each.probability for each in found) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("gained", "warmth"), [(0.9 * LIMITS.name.class_gap / LIMITS.form.placed_by, 1.0), (600.0, 10.0)]
)
def test_places_of_one_law_are_told_apart_by_its_form_alone(gained: float, warmth: float) -> None:
    """No more surely than by the evidence itself, and by 30 nats of 600: odds of e^(2/10) where it is 2 ahead."""
    listed = _weighed(gained, behind=2.0, second=OPENING)
    assert place_gap(listed, LIMITS) == pytest.approx(warmth * LIMITS.name.class_gap)
    found, members = shared_out(listed, listed[:2], class_gap(listed, LIMITS), LIMITS)
    assert np.log(members[0].probability / members[1].probability) == pytest.approx(2.0 / warmth)
    assert sum(each.probability for each in members) == pytest.approx(sum(each.probability for each in listed[:2]))
    assert sum(each.probability for each in found) == pytest.approx(1.0)


def _behind(share: float, kind: Kind = Kind.MISSING_PHYSICS, gained: float = 100.0) -> tuple[Explanation, ...]:
    """Nothing, unknown physics that gains so many nats, and an explanation that lags by a share of them."""
    listed = {each.hypothesis.effects: each for each in _weighed(gained, behind=gained * share)}
    unknown = SimpleNamespace(kind=Kind.UNKNOWN_PHYSICS, effects=(EffectId.UNKNOWN_PHYSICS,), log_prior=-1.0)
    known = SimpleNamespace(kind=kind, effects=CHURNING, log_prior=-1.0)
    return listed[()], replace(listed[OPENING], hypothesis=unknown), replace(listed[CHURNING], hypothesis=known)  # type: ignore[arg-type]


def test_a_law_far_behind_unknown_physics_is_not_that_law_in_another_form() -> None:
    """Sure of the law where it is not behind, less sure with every nat, sure of unknown physics where it gains half."""
    chances = [chance_of_form(one[2], one, LIMITS) for one in map(_behind, (-0.01, 0.05, 0.2, 0.4, 0.6, 1.0))]
    assert chances == sorted(chances, reverse=True)
    assert chances[0] == 1.0
    assert chances[1] > 0.5 > chances[3] > 1.0 - LIMITS.name.probability > chances[4]
    form, prior = LIMITS.form, LIMITS.prior
    odds = prior.missing_physics * form.lagging / form.lag * np.exp(-0.2 / form.lag)
    odds /= prior.unknown_physics * form.unmet
    assert chances[2] == pytest.approx(odds / (1.0 + odds))


@pytest.mark.parametrize("kind", [Kind.WRONG_PARAMETER, Kind.SENSOR_FAULT])
def test_what_has_no_form_goes_by_the_evidence(kind: Kind) -> None:
    """One nat behind, odds of e^(1/.7); ten nats behind, none. So does a law where little is gained."""
    near, far = _behind(0.01, kind), _behind(0.1, kind)
    assert chance_of_form(near[2], near, LIMITS) == pytest.approx(1.0 / (1.0 + np.exp(1.0 / LIMITS.name.temperature)))
    assert chance_of_form(far[2], far, LIMITS) < 1e-5
    slight = _behind(0.5, gained=1.0)
    even = 1.0 / (1.0 + np.exp(0.5 / LIMITS.name.temperature))
    assert chance_of_form(slight[2], slight, LIMITS) == pytest.approx(even)


def test_probability_by_the_chance_of_another_form() -> None:
    listed = _behind(0.2)
    found, members = by_chance(listed, listed[2:], listed[1:2], 0.4, LIMITS)
    both = listed[1].probability + listed[2].probability
    assert [each.probability for each in members] == pytest.approx([0.4 * both, 0.6 * both])
    assert found == (listed[0], members[1], members[0])


def test_components_of_unknown_physics_are_no_places() -> None:
    """They share their probability as different effects do."""
    listed = _weighed(600.0, behind=2.0, second=(EffectId.UNKNOWN_PHYSICS,))
    unknown = [*listed[:1], *_weighed(600.0, behind=2.0, second=(EffectId.UNKNOWN_PHYSICS,))[1:2], *listed[1:]]
    found, _ = shared_out(unknown, [*unknown[1:3]], LIMITS.name.class_gap, LIMITS)
    assert found[1].probability == pytest.approx(found[2].probability)
    assert found[0].probability == listed[0].probability
