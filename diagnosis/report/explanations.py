"""Explanations in words, ranked: each effect at its own place, unknown physics as one."""

from __future__ import annotations

from dataclasses import replace

from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.explain.ranked import Explanation
from diagnosis.report.format import NOTHING, effect_words, last_word, listed
from diagnosis.study.model import SUBJECTS
from diagnosis.verdict.diagnosis import Diagnosis

RIVALS = 3
"""Largest number of named explanations."""


def explained_by(diagnosis: Diagnosis, *, other_form: bool = True) -> list[Explanation]:
    """Explanations by an effect, the claimed one first, then by probability; of the same words the best.

    Unknown physics, one explanation for each component, counts by all; other_form: include laws of another form.
    """
    first = diagnosis.hypotheses[:1]
    others = sorted(diagnosis.hypotheses[1:], key=lambda one: -one.probability)
    others = [one for one in others if other_form or not one.hypothesis.other_form]
    unknown = sum(one.probability for one in diagnosis.hypotheses if one.hypothesis.component is not None)
    found: dict[str, Explanation] = {}
    for one in (*first, *others):
        if one.hypothesis.component is not None:
            one = replace(one, probability=unknown)
        if one.hypothesis.effects:
            found.setdefault(explanation_words(one.hypothesis), one)
    ranked = list(found.values())
    return [*ranked[:1], *sorted(ranked[1:], key=lambda one: -one.probability)]


def rivals(diagnosis: Diagnosis) -> tuple[list[Explanation], list[Explanation]]:
    """Explanations that the finding does not name, the likeliest first: those that are possible, and the excluded."""
    _, *others = explained_by(diagnosis, other_form=False)
    least = diagnosis.thresholds.name.possible
    others = [one for one in others if not _is_told(one.hypothesis, diagnosis)]
    return [one for one in others if one.probability >= least], [one for one in others if one.probability < least]


def _is_told(own: Hypothesis, diagnosis: Diagnosis) -> bool:
    """True for an explanation that the finding names already, as one of those that are inseparable."""
    if len(diagnosis.effects) != 1 or len(own.effects) != 1:
        return False
    (claim,) = diagnosis.effects
    places = {claim.pair, *(gap for gap, _ in claim.elsewhere)}
    return own.effects[0] in claim.equivalent or (own.effects[0] is claim.effect and own.places[0] in places)


def explanation_words(own: Hypothesis) -> str:
    """An explanation in words, each effect with its own place: "churning and film thickness at the slippers"; of the
    null "no mismatch".
    """
    if not own.effects:
        return NOTHING
    if len(own.effects) == 1:
        return effect_words(own.effects, own.pair) + _which(own, 0)
    each = enumerate(zip(own.effects, own.places, strict=True))
    return listed(effect_words([effect], place) + _which(own, at) for at, (effect, place) in each)


def _which(own: Hypothesis, at: int) -> str:
    """The parameter of an effect that has several not distinguished by gaps."""
    return f" ({last_word(str(own.subjects[at]))})" if named_apart(own, at) else ""


def named_apart(own: Hypothesis, at: int) -> bool:
    """True if an effect concerns one of several values, one for each pair."""
    subject = own.subjects[at]
    return isinstance(subject, str) and subject not in ("", SUBJECTS.get(own.effects[at])) and not own.places[at]
