"""Error of form of the laws, a floor on the evidence gap between explanations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit, log_softmax, logsumexp

from diagnosis.explain.ranked import Explanation
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.effect import EffectId, Kind


def by_form(gained: float, thresholds: Thresholds) -> float:
    """Error of form of a law that gains `gained` nats over the null, in units of the noise's gap; 1 at least.

    A form wrong by a tenth leaves the share `true_to` of its gain: up to 300 nats that is less than the gap of a class.
    """
    return max(1.0, thresholds.form.true_to * gained / thresholds.name.class_gap)


def class_gap(explanations: Sequence[Explanation], thresholds: Thresholds) -> float:
    """Nats within which refitted explanations are one class: by noise, or by the error of their forms."""
    return thresholds.name.class_gap * by_form(_gained(explanations), thresholds)


def place_gap(explanations: Sequence[Explanation], thresholds: Thresholds) -> float:
    """The same of one law at several places: the share `placed_by` of its gain.

    By 24 recordings of the development set with one film that opens or warms: the law at the true gap was up to
    .06 of its gain behind that at another gap, and in half of them less than .02 ahead or behind.
    """
    return max(thresholds.name.class_gap, thresholds.form.placed_by * _gained(explanations))


def behind_unknown(best: Explanation, explanations: Sequence[Explanation]) -> float:
    """Nats by which an explanation is behind unknown physics, all components together; -inf without any."""
    unknown = [each.log_weight for each in explanations if each.hypothesis.kind is Kind.UNKNOWN_PHYSICS]
    return float(logsumexp(unknown)) - best.log_weight if unknown else -np.inf


def chance_of_form(best: Explanation, explanations: Sequence[Explanation], thresholds: Thresholds) -> float:
    """Probability that the best law of the catalogue, in another form, has been left out, and not unknown physics.

    Unknown physics departs freely; a law of another make leaves a share s of the nats that it gains. Bayes' rule with
    the priors of both and their densities at s: `lagging` exp(-s/`lag`)/`lag` of a law, `unmet` (uniform) of unknown
    physics. 1 where the law is not behind; no less than by the evidences alone, which alone count for a wrong parameter
    and a faulty sensor: they have no other form.

    By 23 recordings of the development set (both plants, z = 8 to 30): 2 of 13 laws of another make lag, by .07 and
    .12; 8 of 10 effects that no catalogue has are not met, which leaves .15 to .9.
    """
    behind = behind_unknown(best, explanations)
    if behind <= 0.0:
        return 1.0
    by_evidence = float(expit(-behind / thresholds.name.temperature))
    if best.hypothesis.kind is not Kind.MISSING_PHYSICS:
        return by_evidence
    form, prior = thresholds.form, thresholds.prior
    law = prior.missing_physics * form.lagging / form.lag * np.exp(-behind / (form.lag * _gained(explanations)))
    return max(by_evidence, float(law / (law + prior.unknown_physics * form.unmet)))


def _gained(explanations: Sequence[Explanation]) -> float:
    nothing = max(each.log_evidence for each in explanations if each.hypothesis.kind is Kind.NO_MISMATCH)
    return max(each.log_evidence for each in explanations) - nothing


def shared_out(
    explanations: Sequence[Explanation], members: Sequence[Explanation], gap: float, thresholds: Thresholds
) -> tuple[tuple[Explanation, ...], tuple[Explanation, ...]]:
    """The explanations, and the members of a class, whose probability is shared by the gaps of class and places.

    P ~ exp(ln weight / temperature): an approximate likelihood is tempered (Miller and Dunson 2019,
    doi:10.1080/01621459.2018.1469995). For different effects the temperature is the `gap` (nats) within which they are
    one class over that of noise, times that of all probabilities; for places of the same effects, the gap of places
    over that of noise.
    """
    total = sum(each.probability for each in members)
    return _with(explanations, members, total * _shares(explanations, members, gap, thresholds))


def by_chance(
    explanations: Sequence[Explanation],
    known: Sequence[Explanation],
    unknown: Sequence[Explanation],
    chance: float,
    thresholds: Thresholds,
) -> tuple[tuple[Explanation, ...], tuple[Explanation, ...]]:
    """The explanations, and a law's class with unknown physics beside it, whose probability is the law's by `chance`.

    Within both it is shared as by `shared_out`.
    """
    members, gap = (*known, *unknown), class_gap(explanations, thresholds)
    total = sum(each.probability for each in members)
    parts = [
        part * _shares(explanations, group, gap, thresholds)
        for part, group in ((chance, known), (1.0 - chance, unknown))
    ]
    return _with(explanations, members, total * np.concatenate(parts))


def _with(
    explanations: Sequence[Explanation], members: Sequence[Explanation], probabilities: Array
) -> tuple[tuple[Explanation, ...], tuple[Explanation, ...]]:
    """The explanations and the members with other probabilities of the members."""
    changed = {
        id(each): replace(each, probability=float(own)) for each, own in zip(members, probabilities, strict=True)
    }
    return tuple(changed.get(id(each), each) for each in explanations), tuple(changed[id(each)] for each in members)


def _shares(
    explanations: Sequence[Explanation], members: Sequence[Explanation], gap: float, thresholds: Thresholds
) -> Array:
    """Shares (m,) of the members in their probability, which sum to 1."""
    weights, own = np.array([each.log_weight for each in members]), thresholds.name
    shares = np.exp(log_softmax(weights / (gap / own.class_gap * own.temperature)))
    within = place_gap(explanations, thresholds) / own.class_gap
    for same in _alike(members):
        shares[same] = shares[same].sum() * np.exp(log_softmax(weights[same] / within))
    return np.asarray(shares)


def _alike(members: Sequence[Explanation]) -> list[NDArray[np.int64]]:
    """The numbers of members that claim the same effects, those of several places; unknown physics has no place."""
    effects = [each.hypothesis.effects for each in members]
    known = [one for one in dict.fromkeys(effects) if one != (EffectId.UNKNOWN_PHYSICS,)]
    found = [np.flatnonzero([other == one for other in effects]) for one in known]
    return [same for same in found if same.size > 1]
