"""Error of form of the laws, a floor on the evidence gap between explanations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_softmax

from diagnosis.explain.ranked import Explanation
from diagnosis.thresholds import Thresholds
from system.effects.effect import EffectId, Kind


def by_form(gained: float, thresholds: Thresholds) -> float:
    """Error of form of a law that gains `gained` nats over nothing, in units of the noise's gap; 1 at least.

    A form off by a tenth leaves the share `true_to` of its gain: up to 300 nats that is less than the gap of a class.
    """
    return max(1.0, thresholds.form.true_to * gained / thresholds.name.class_gap)


def class_gap(explanations: Sequence[Explanation], thresholds: Thresholds) -> float:
    """Nats within which refitted explanations are one class: by noise, or by the error of their forms."""
    return thresholds.name.class_gap * by_form(_gained(explanations), thresholds)


def place_gap(explanations: Sequence[Explanation], thresholds: Thresholds) -> float:
    """The same of one law at several places: the share `placed_by` of what is gained.

    By 24 recordings of the development set with one film that opens or warms: the law at the true gap was up to
    .06 of its gain behind that at another gap, and in half of them less than .02 ahead or behind.
    """
    return max(thresholds.name.class_gap, thresholds.form.placed_by * _gained(explanations))


def form_gap(explanations: Sequence[Explanation], thresholds: Thresholds) -> float:
    """Nats by which a law of the catalogue may be behind unknown physics and still be what has been left out.

    Unknown physics departs as it likes; a law whose form is that of another make leaves a share of what it explains.
    Laws of the second plant, each expressed by the catalogue's, leave .002 to .18 of their square, one in seven more
    (two campaigns, sizes of z = 8): a law that lags by less than the share 1/(1 + own) is of another form, not another
    law.
    """
    return max(class_gap(explanations, thresholds), _gained(explanations) / (1.0 + thresholds.form.own))


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
    weights = np.array([each.log_weight for each in members])
    own = thresholds.name
    shares = np.exp(log_softmax(weights / (gap / own.class_gap * own.temperature)))
    within = place_gap(explanations, thresholds) / own.class_gap
    for same in _alike(members):
        shares[same] = shares[same].sum() * np.exp(log_softmax(weights[same] / within))
    shared = {
        id(each): replace(each, probability=total * float(share)) for each, share in zip(members, shares, strict=True)
    }
    return tuple(shared.get(id(each), each) for each in explanations), tuple(shared[id(each)] for each in members)


def _alike(members: Sequence[Explanation]) -> list[NDArray[np.int64]]:
    """The numbers of members that claim the same effects, those of several places; unknown physics has no place."""
    effects = [each.hypothesis.effects for each in members]
    known = [one for one in dict.fromkeys(effects) if one != (EffectId.UNKNOWN_PHYSICS,)]
    found = [np.flatnonzero([other == one for other in effects]) for one in known]
    return [same for same in found if same.size > 1]
