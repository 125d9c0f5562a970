"""The next test: a point that separates the first explanation from its likeliest rival."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.explain.hypotheses import simulator_of
from diagnosis.explain.ranked import Explanation
from diagnosis.next_point.choose import NextPoint, next_point
from diagnosis.next_point.forecast import Contender
from diagnosis.next_point.operating_box import ordinary_box, rig_box
from diagnosis.procedure.gap_leak_test import gap_leak_test
from diagnosis.report.explanations import explanation_words
from diagnosis.study.model import Study
from diagnosis.thresholds import NextPointLimits, Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from reynolds.errors import InputError, NotConverged
from system.description.pump import PumpDescription


def with_next_point(study: Study, pump: PumpDescription, found: Diagnosis, thresholds: Thresholds) -> Diagnosis:
    """The diagnosis with the point that separates its first explanation from the likeliest other.

    Unchanged if there is no refitted rival. Raises NotConverged where a point cannot be simulated.
    """
    asked = rivals(found, thresholds)
    if asked is None:
        return found
    first, second = (contender(study, each, thresholds) for each in asked)
    return replace(found, next_point=proposed_point(study, pump, first, second, thresholds.next_point))


def proposed_point(
    study: Study, pump: PumpDescription, first: Contender, second: Contender, limits: NextPointLimits
) -> NextPoint:
    """A point of the rig's box if one settles two that are open, else one of an ordinary bench's if that does.

    Else the rig's best, with another test if one settles them. Raises NotConverged if a point of the rig's box
    cannot be simulated; for a point farther out the failure is part of the text.
    """
    box = rig_box(study.recording, pump)
    point = next_point(study, pump, box, first, second, limits)
    if point.settles or not point.is_open:
        return point
    try:
        farther = next_point(study, pump, ordinary_box(study.recording, pump), first, second, limits)
    except (NotConverged, InputError) as reason:
        return replace(point, instead=f"Farther out nothing can be predicted: {reason}.")
    if farther.settles:
        return replace(farther, beyond=True)
    leak = gap_leak_test(study, box, first, second, limits)
    return replace(point, instead=leak.text if leak else "")


def rivals(found: Diagnosis, thresholds: Thresholds) -> tuple[Explanation, Explanation] | None:
    """The first explanation and its likeliest rival, both refitted; None without a rival."""
    fitted = [each for each in found.hypotheses if each.posterior is not None]
    rival = _rival(fitted, thresholds.next_point.rival)
    return None if rival is None else (fitted[0], rival)


def _rival(fitted: Sequence[Explanation], least: float) -> Explanation | None:
    """The likeliest of the explanations that are not the first at the same places."""
    others = [
        each
        for each in fitted[1:]
        if each.probability >= least and each.hypothesis.open_names != fitted[0].hypothesis.open_names
    ]
    return max(others, key=lambda each: each.probability, default=None)


def contender(study: Study, explanation: Explanation, thresholds: Thresholds) -> Contender:
    """A refitted explanation with the simulator of its fit."""
    if explanation.posterior is None:
        raise ValueError(f"{explanation.hypothesis.text}: not refitted")
    simulator = simulator_of(study, explanation.hypothesis, thresholds)
    own = explanation.hypothesis
    text = explanation_words(own) + (", of another form" if own.other_form else "")
    return Contender(own.effects, simulator, explanation.posterior, text, explanation.probability)
