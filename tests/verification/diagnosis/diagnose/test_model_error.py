"""Explanations that part by less than the form of a law can be off by: one class, its probability shared out."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis import Explanation, load_thresholds
from diagnosis.explain.model_error import class_gap, form_gap, place_gap, shared_out
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


def test_a_law_of_another_form_lags_by_a_fifth_of_what_is_gained() -> None:
    """In square a fifth, which is a quarter of what the law itself takes up; by noise alone where little is gained."""
    assert form_gap(_weighed(10.0, behind=1.0), LIMITS) == LIMITS.name.class_gap
    assert form_gap(_weighed(100.0, behind=1.0), LIMITS) == pytest.approx(20.0)


def test_components_of_unknown_physics_are_no_places() -> None:
    """They share their probability as different effects do."""
    listed = _weighed(600.0, behind=2.0, second=(EffectId.UNKNOWN_PHYSICS,))
    unknown = [*listed[:1], *_weighed(600.0, behind=2.0, second=(EffectId.UNKNOWN_PHYSICS,))[1:2], *listed[1:]]
    found, _ = shared_out(unknown, [*unknown[1:3]], LIMITS.name.class_gap, LIMITS)
    assert found[1].probability == pytest.approx(found[2].probability)
    assert found[0].probability == listed[0].probability
