"""A diagnosis as text: headline, finding with size and place, certainty, and open questions."""

from __future__ import annotations

from collections.abc import Iterator

from diagnosis.detect.time_scan import TimeKind
from diagnosis.explain.ranked import Explanation
from diagnosis.recording.units import difference, difference_unit, reading
from diagnosis.report.certainty import LIKELY, stated_probability
from diagnosis.report.explanations import RIVALS, explained_by, explanation_words, named_apart, rivals
from diagnosis.report.format import (
    CHANNELS,
    COMPONENTS,
    PLACES,
    chance,
    channel_words,
    effect_words,
    last_word,
    listed,
    region_words,
    sentence_case,
)
from diagnosis.report.measure import measure_words
from diagnosis.report.sizes import finding_sentence
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis, Remainder, VerdictStatus
from diagnosis.verdict.locate import Location
from system.effects.effect import EffectId, Kind
from system.inputs.channels import ChannelName

OTHER = 0.05
"""Probability from which a suspected cause, or another place of an effect (its share), is listed."""
OUTSIDE = (EffectId.UNKNOWN_PHYSICS,)
"""The class of a claim that has no other rival than a cause outside the catalogue."""
COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")


def statement(diagnosis: Diagnosis) -> str:
    """Headline, finding with its size, its place, and certainty."""
    told = (headline(diagnosis), finding(diagnosis), doubt(diagnosis), where_words(diagnosis), _sure(diagnosis))
    return " ".join(text for text in told if text)


def paragraphs(diagnosis: Diagnosis) -> tuple[str, ...]:
    """The statement, points not used in the fit, other possible explanations, and the next measurement."""
    told = (statement(diagnosis), fit_words(diagnosis), rivals_words(diagnosis), measure_words(diagnosis))
    return tuple(text for text in told if text)


def headline(diagnosis: Diagnosis) -> str:
    """The kind of answer, in a few words."""
    if diagnosis.status is VerdictStatus.SUSPICION:
        return "A suspicion."
    if diagnosis.kind is Kind.NO_MISMATCH:
        return "No mismatch."
    if diagnosis.kind is Kind.UNKNOWN_PHYSICS:
        return "A mismatch without a known cause."
    left = "; a part of the mismatch remains" if diagnosis.status is VerdictStatus.INCOMPLETE else ""
    causes = len(diagnosis.effects)
    outside = {EffectId.UNKNOWN_PHYSICS}
    alike = [len({*claim.equivalent} - outside) + len(claim.elsewhere) for claim in diagnosis.effects]
    if stated_probability(diagnosis) < LIKELY:
        several = 1 + alike[0] if causes == 1 else causes
        words = f"{_count(several)} possible causes" if several > 1 else "a possible cause"
        return f"{sentence_case(words)}, not sure{left}."
    if causes == 1 and alike[0]:
        return f"Narrowed down to {_count(1 + alike[0])} causes{left}."
    sure = not left and stated_probability(diagnosis) >= diagnosis.thresholds.name.probability
    found = "cause found" if causes < 2 else f"{_count(causes)} causes found"
    words = found if sure else f"likely {found}"
    if any(alike):
        words += f", {_count(sum(map(bool, alike)))} of which cannot be told from others"
    return f"{sentence_case(words)}{left}."


def finding(diagnosis: Diagnosis) -> str:
    """Process in the pump or fault of its meters, with sizes."""
    if diagnosis.status is VerdictStatus.SUSPICION:
        return _suspicion(diagnosis)
    if diagnosis.kind is Kind.NO_MISMATCH:
        return "Simulation and recording agree within the scatter of the meters and the tolerances of the pump."
    if diagnosis.kind is Kind.UNKNOWN_PHYSICS:
        parts = listed((f"the {COMPONENTS[one]}" for one in diagnosis.location.tie), "or")
        inputs = listed(map(channel_words, diagnosis.location.inputs))
        goes = f" and changes with {inputs}" if inputs else ""
        place = f" It lies most likely in {parts}{goes}." if parts else ""
        return f"No effect of the catalogue explains the mismatch.{place}"
    return " ".join(
        f"{finding_sentence(claim, diagnosis)}{_of_which(at, diagnosis)}." for at, claim in enumerate(diagnosis.effects)
    )


def doubt(diagnosis: Diagnosis) -> str:
    """Rivals that the recording does not separate from a claim, and a part of the mismatch that no claim explains."""
    return " ".join([*_class(diagnosis), *_incomplete(diagnosis)])


def suspected(diagnosis: Diagnosis) -> list[Explanation]:
    """The explanations of a suspicion that are likely enough to be listed, the likeliest first."""
    return [one for one in explained_by(diagnosis) if one.probability >= OTHER]


def where_words(diagnosis: Diagnosis) -> str:
    """Channels with the mismatch, its strongest region of the map, in time and over the shaft angle."""
    location = diagnosis.location
    if diagnosis.kind is Kind.NO_MISMATCH or not location.channels:
        return ""
    region = f", mostly at {region_words(location.region)}" if location.region else ""
    half = ", where it reaches half of its largest size or more" if location.region and diagnosis.effects else ""
    channels = listed(map(channel_words, location.channels))
    return f"It shows in {channels}{region}{half}.{_times(location)}{_angles(location)}"


def fit_words(diagnosis: Diagnosis) -> str:
    """Misfit at points that were not used in the fit, without and with the finding, by channel."""
    fit = diagnosis.fit
    channels = [channel for channel in diagnosis.location.channels if channel in fit.after] or list(fit.after)
    if not diagnosis.effects or not channels:
        return ""
    parts = [
        f"{_number(channel, fit.after[channel])} {difference_unit(channel)} in {CHANNELS[channel]} "
        f"(before {_number(channel, fit.before[channel])}; scatter of the meter {_number(channel, fit.noise[channel])})"
        for channel in channels
    ]
    return f"Points not used in the fit are now met to {listed(parts)}."


def rivals_words(diagnosis: Diagnosis) -> str:
    """Explanations that are still possible and that are ruled out."""
    if diagnosis.status is VerdictStatus.SUSPICION or not diagnosis.effects:
        return ""
    possible, excluded = ([explanation_words(one.hypothesis) for one in some] for some in rivals(diagnosis))
    more = len(possible) - RIVALS
    rest = [f"{_count(more)} less likely {'cause' if more == 1 else 'causes'}"] if more > 0 else []
    parts = [f"Still possible: {listed([*possible[:RIVALS], *rest])}." if possible else ""]
    parts += [f"Ruled out: {listed(excluded[:RIVALS])}." if excluded else ""]
    return " ".join(part for part in parts if part)


def _count(number: int) -> str:
    return COUNTS[number] if number < len(COUNTS) else str(number)


def _sure(diagnosis: Diagnosis) -> str:
    """Probabilities of the claims."""
    if not diagnosis.effects or diagnosis.status is VerdictStatus.SUSPICION:
        return ""
    return f"Probability {listed(f'{chance(one.probability)} ({one.effect.value})' for one in diagnosis.effects)}."


def _times(location: Location) -> str:
    """A sentence of its own, with a blank before it."""
    time = location.time
    if time is None:
        return ""
    drifts = time.kind is TimeKind.DRIFT
    since = "drifts in the course of the recording" if drifts else f"begins at point {time.at + 1}"
    return f" The difference in {CHANNELS[time.channel]} {since}."


def _angles(location: Location) -> str:
    """A sentence of its own: a significant angle in a trace need not belong to the claim."""
    if location.angle is None:
        return ""
    start, end = (reading(ChannelName.ANGLE, angle) for angle in (location.angle.start, location.angle.end))
    events = f" ({listed(location.angle.events)})" if location.angle.events else ""
    return f" The chamber's pressure stands out at shaft angle {start:.3g} to {end:.3g} deg{events}."


def _of_which(at: int, diagnosis: Diagnosis) -> str:
    """Other friction pairs or bearings, without a gap, to which a claimed value may belong as well."""
    own = diagnosis.hypotheses[0].hypothesis
    if at >= len(own.subjects) or not isinstance(own.subjects[at], str):
        return ""
    first = last_word(str(own.subjects[at]))
    shares = {first: 0.0}
    for one in diagnosis.hypotheses:
        which = last_word(str(one.hypothesis.subjects[at])) if one.hypothesis.effects == own.effects else ""
        if which == first or (which and named_apart(one.hypothesis, at)):
            shares[which] = shares.get(which, 0.0) + one.probability
    parts = {which: share / (sum(shares.values()) or 1.0) for which, share in shares.items()}
    others = [f"{which} ({chance(part)})" for which, part in parts.items() if which != first and part >= OTHER]
    return f", most likely of {first} ({chance(parts[first])}), else of {listed(others, 'or')}" if others else ""


def _class(diagnosis: Diagnosis) -> Iterator[str]:
    """Effects and gaps that the recording cannot separate."""
    if diagnosis.status is VerdictStatus.SUSPICION:
        return
    outside = [claim for claim in diagnosis.effects if claim.equivalent == OUTSIDE]
    for behind in (True, False):
        own = listed(effect_words([one.effect]) for one in outside if _is_behind_unknown(one, diagnosis) is behind)
        others = sentence_case(_member(EffectId.UNKNOWN_PHYSICS, diagnosis))
        if own and behind:
            yield f"{others} is likelier. It may be {own} by another law."
        elif own:
            yield f"{others} in place of {own} fits this recording as well."
    for claim in diagnosis.effects:
        if claim.equivalent and claim not in outside:
            others = sentence_case(listed((_member(one, diagnosis) for one in claim.equivalent), "or"))
            yield f"{others} in place of {effect_words([claim.effect])} fits this recording as well."
        if claim.pair and claim.elsewhere:
            own = f"{PLACES[claim.pair]} ({chance(1.0 - sum(part for _, part in claim.elsewhere))})"
            others = listed((f"{PLACES[gap]} ({chance(part)})" for gap, part in claim.elsewhere), "or")
            yield f"This recording cannot tell {own} from {others}."


def _is_behind_unknown(claim: ClaimedEffect, diagnosis: Diagnosis) -> bool:
    """True if unknown physics is likelier than the claim."""
    return _probability_of(EffectId.UNKNOWN_PHYSICS, diagnosis) > _probability_of(claim.effect, diagnosis)


def _probability_of(effect: EffectId, diagnosis: Diagnosis) -> float:
    """Probability of all explanations with an effect."""
    return sum(one.probability for one in diagnosis.hypotheses if effect in one.hypothesis.effects)


def _member(effect: EffectId, diagnosis: Diagnosis) -> str:
    """An effect of a class in words; unknown physics, which may be likelier than the claim, with its probability."""
    words = effect_words([effect])
    if effect is not EffectId.UNKNOWN_PHYSICS:
        return words
    return f"{words} ({chance(_probability_of(effect, diagnosis))})"


def _incomplete(diagnosis: Diagnosis) -> Iterator[str]:
    """A sentence on the remaining part, and on the certainty of names without an unknown cause beside them."""
    if diagnosis.status is VerdictStatus.INCOMPLETE:
        several = len(diagnosis.effects) > 1
        they, names = ("they do", "the names are") if several else ("it does", "the name is")
        is_open = any(EffectId.UNKNOWN_PHYSICS in claim.equivalent for claim in diagnosis.effects)
        sure = "" if is_open else f": {names} likely, not sure"
        yield f"A part of the mismatch remains that {they} not explain{sure}."
        yield from map(_remains, diagnosis.left[:1])


def _remains(left: Remainder) -> str:
    """A part of the mismatch that a claim leaves, as a sentence."""
    if left.region is not None:
        side, place = "high" if left.region.contrast > 0.0 else "low", region_words(left.region)
        return (
            f"{sentence_case(channel_words(left.region.channel))} still reads too {side} at {place}, by "
            f"{abs(left.region.contrast):.1f} sigma of the readings there together."
        )
    if left.effect is not None:
        return f"What remains looks like {effect_words([left.effect])} ({left.score:.1f} sigma)."
    return f"{sentence_case(left.text)}."


def _suspicion(diagnosis: Diagnosis) -> str:
    known = suspected(diagnosis)[:RIVALS]
    likely = [f"{explanation_words(one.hypothesis)} ({chance(one.probability)})" for one in known]
    thought = f" Likeliest: {listed(likely)}." if likely else ""
    return f"Readings and simulation differ, but not clearly enough to name a cause: nothing is claimed.{thought}"


def _number(channel: ChannelName, value: float) -> str:
    return f"{difference(channel, value):.2g}"
