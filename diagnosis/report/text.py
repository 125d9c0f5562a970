"""A diagnosis as text: place, effect, size, certainty, and the next point to record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import exp

from diagnosis.detect.time_scan import TimeKind
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.scaling import Scaling
from diagnosis.next_point.choose import NextPoint
from diagnosis.recording.units import channel_unit, difference, difference_unit, reading
from diagnosis.report.format import (
    CHANNELS,
    PLACES,
    chance,
    channel_words,
    effect_words,
    estimate_text,
    last_word,
    listed,
    odds_text,
)
from diagnosis.study.model import SUBJECTS
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from diagnosis.verdict.locate import Location
from system.effects.catalogue.entries import entry_of
from system.effects.effect import Kind
from system.inputs.channels import ChannelName

RIVALS = 3  # named at most
OTHER = 0.05  # share of the probability of an effect's other places, from which they are listed


def statement(diagnosis: Diagnosis) -> str:
    """One to three sentences: place, effect, size, certainty; and the shaft angles at which traces stand out."""
    angles = "" if diagnosis.kind is Kind.NO_MISMATCH else _angles(diagnosis.location)
    return f"{_verdict(diagnosis)}{angles}"


def _verdict(diagnosis: Diagnosis) -> str:
    if diagnosis.status is VerdictStatus.SUSPICION:
        return f"{_where(diagnosis)}: {_suspicion(diagnosis)}."
    if diagnosis.kind is Kind.NO_MISMATCH:
        return f"Simulation and recording agree within noise and tolerance ({_misfit(diagnosis)})."
    if diagnosis.kind is Kind.UNKNOWN_PHYSICS:
        unknown = _unknown(diagnosis)
        return f"{_where(diagnosis)}. {unknown[0].upper()}{unknown[1:]}."
    said = "; besides, ".join(_claim(at, diagnosis) for at in range(len(diagnosis.effects)))
    ends = " ".join(filter(None, (_class(diagnosis), _incomplete(diagnosis))))
    return f"{_where(diagnosis)}. {said[0].upper()}{said[1:]}. {ends}".rstrip()


def paragraphs(diagnosis: Diagnosis) -> tuple[str, ...]:
    """The statement, held-out residuals, rivals, and the next point."""
    texts = (
        statement(diagnosis),
        held_out_text(diagnosis),
        _rivals(diagnosis),
        next_point_text(diagnosis.next_point) if diagnosis.next_point else "",
    )
    return tuple(text for text in texts if text)


def held_out_text(diagnosis: Diagnosis) -> str:
    """Residuals of the simulation without and with the finding on held-out points, channel by channel."""
    fit = diagnosis.fit
    channels = [channel for channel in diagnosis.location.channels if channel in fit.after] or list(fit.after)
    if not diagnosis.effects or not channels:
        return ""
    parts = [
        f"{CHANNELS.get(channel, channel.value)} {_number(channel, fit.before[channel])} -> "
        f"{_number(channel, fit.after[channel])} (noise {_number(channel, fit.noise[channel])}) "
        f"{difference_unit(channel)}"
        for channel in channels
    ]
    return f"Error on points held out, rms: {'; '.join(parts)}."


def next_point_text(found: NextPoint) -> str:
    """The next point to record, with units, and the odds after readings there; or that no point settles it."""
    first, second = found.between
    ahead, behind = (first, second) if found.before >= 0.0 else (second, first)
    pair = f"{ahead} from {behind} (odds now {_odds(abs(found.before))})"
    times = f"{_point(found)}, {found.limits.readings} times"
    if found.settles:
        beyond = ", outside the range recorded," if found.beyond else ""
        sure = f"1:20 or better with a chance of {chance(found.chance)}"
        return (
            f"To separate {pair}, record{beyond} {times}: the expected odds are {_odds(found.after)}, {sure}, "
            f"whichever is true; {found.why}."
        )
    factor = f"multiplies the odds for the true one by {exp(found.gain):.2g} on average"
    if not found.is_open:
        now = _odds(abs(found.before))
        return f"To improve the odds of {ahead} against {behind}, now {now}, record {times}: this {factor}."
    more = f"; {found.repeats} readings there separate them" if found.repeats else ""
    return (
        f"No point of an ordinary bench is likely to separate {pair}. The best of the range recorded, "
        f"{times}, {factor}{more}; {found.why}.{' ' if found.instead else ''}{found.instead}"
    )


def _point(found: NextPoint) -> str:
    point = found.point
    values = {
        ChannelName.SPEED: point.shaft_speed,
        ChannelName.P_OUT: point.delivery_pressure,
        ChannelName.DISPLACEMENT_RATIO: point.displacement_ratio,
        ChannelName.T_IN: found.inlet_temperature,
        ChannelName.T_CASE: point.temperature,
    }
    parts = [
        f"{channel.value} {reading(channel, value):.4g} {channel_unit(channel)}".removesuffix(" 1")
        for channel, value in values.items()
    ]
    return ", ".join(parts)


def _odds(nats: float) -> str:
    return odds_text(1.0, exp(-nats))


def _where(diagnosis: Diagnosis) -> str:
    """Channels, part of the map, time, sign of the difference, and the powers of its growth."""
    location, scaling = diagnosis.location, diagnosis.scaling
    channels = listed(map(channel_words, location.channels)) or "no single channel"
    place = ", ".join([channels[0].upper() + channels[1:], *_places(location)])
    if scaling is None:
        return place
    side = "higher" if scaling.above else "lower"
    grows = _course(scaling, diagnosis.thresholds.form.flat)
    return f"{place}: {scaling.channel.value} reads {side} than simulated; the difference {grows}"


def _places(location: Location) -> Iterator[str]:
    if location.region is not None:
        yield location.region.text
    time = location.time
    if time is not None:
        drifts = time.kind is TimeKind.DRIFT
        since = "drifting in the course of the recording" if drifts else f"from point {time.at + 1} on"
        yield f"{time.channel.value} {since}"


def _angles(location: Location) -> str:
    """A sentence of its own: an angle that stands out in a trace need not belong to the claim."""
    if location.angle is None:
        return ""
    start, end = (reading(ChannelName.ANGLE, angle) for angle in (location.angle.start, location.angle.end))
    events = f" ({listed(location.angle.events)})" if location.angle.events else ""
    return f" The chamber's pressure stands out at shaft angle {start:.3g} to {end:.3g} deg{events}."


def _claim(at: int, diagnosis: Diagnosis) -> str:
    """Effect, gap, sizes and probability of a claim."""
    claim = diagnosis.effects[at]
    sizes = listed(estimate_text(estimate) for estimate in claim.parameters)
    place = f", {'most likely ' if claim.elsewhere else ''}at {PLACES[claim.pair]}" if claim.pair else ""
    return (
        f"{entry_of(claim.effect).sentence} ({claim.effect.value}){place}"
        f"{': ' if sizes else ''}{sizes}, probability {chance(claim.probability)}{_of_which(at, diagnosis)}"
    )


def _of_which(at: int, diagnosis: Diagnosis) -> str:
    """Other friction pairs or bearings, without a gap, to which a claimed value may belong as well."""
    own = diagnosis.hypotheses[0].hypothesis
    if at >= len(own.subjects) or not isinstance(own.subjects[at], str):
        return ""
    first = last_word(str(own.subjects[at]))
    shares = {first: 0.0}
    for one in diagnosis.hypotheses:
        which = last_word(str(one.hypothesis.subjects[at])) if one.hypothesis.effects == own.effects else ""
        if which == first or (which and _named_apart(one.hypothesis, at)):
            shares[which] = shares.get(which, 0.0) + one.probability
    parts = {which: share / (sum(shares.values()) or 1.0) for which, share in shares.items()}
    others = [f"{which} ({chance(part)})" for which, part in parts.items() if which != first and part >= OTHER]
    return f", most likely of {first} ({chance(parts[first])}), else of {listed(others, 'or')}" if others else ""


def _class(diagnosis: Diagnosis) -> str:
    """Ids and gaps that the recording cannot separate; empty if there are none."""
    alike = [
        f"{claim.effect.value} from {listed((one.value for one in claim.equivalent), 'or')}"
        for claim in diagnosis.effects
        if claim.equivalent
    ]
    alike += [
        f"{PLACES[claim.pair]} ({chance(1.0 - sum(part for _, part in claim.elsewhere))}) from "
        f"{listed((f'{PLACES[gap]} ({chance(part)})' for gap, part in claim.elsewhere), 'or')}"
        for claim in diagnosis.effects
        if claim.pair and claim.elsewhere
    ]
    return f"This recording cannot separate {listed(alike)}." if alike else ""


def _incomplete(diagnosis: Diagnosis) -> str:
    """A sentence on the part that remains, and on the certainty of the names."""
    if diagnosis.status is not VerdictStatus.INCOMPLETE:
        return ""
    if _class(diagnosis):
        return "A part of the mismatch remains besides that none of them explains."
    names, they = ("The names are", "they do") if len(diagnosis.effects) > 1 else ("The name is", "it does")
    return f"A part of the mismatch remains that {they} not explain: {names[0].lower()}{names[1:]} likely, not sure."


def _suspicion(diagnosis: Diagnosis) -> str:
    likely = _likeliest(diagnosis)
    verb = "are" if len(likely) > 1 else "is"
    thought = f"; likeliest {verb} {listed(likely)}" if likely else ""
    return f"a mismatch without proof ({_misfit(diagnosis)}{_striking(diagnosis)}): nothing is claimed{thought}"


def _striking(diagnosis: Diagnosis) -> str:
    """The strongest candidate, and the chance of one as strong without any effect."""
    found = diagnosis.detection
    return "".join(
        f"; {effect_words([candidate.entry.id])} is the strongest candidate, {abs(score.z):.1f} sigma; without "
        f"any effect one as strong has a chance of {chance(found.chance)}"
        for candidate, score in found.strongest[:1]
    )


def _unknown(diagnosis: Diagnosis) -> str:
    parts = listed((one.value.replace("_", " ") for one in diagnosis.location.tie), "or")
    place = f", most like a change of the {parts}" if parts else ""
    return f"no effect of the catalogue explains the mismatch ({_misfit(diagnosis)}){place}"


def _course(scaling: Scaling, flat: float) -> str:
    """Powers by which the difference grows, and coordinates without effect, where exponents are known."""
    powers = [
        f"{name}^({exponent:.2g} +- {scaling.sigma[name]:.1g})"
        for name, exponent in scaling.exponents.items()
        if abs(exponent) > max(2.0 * scaling.sigma[name], flat)
    ]
    same = [
        name for name, exponent in scaling.exponents.items() if abs(exponent) <= flat and scaling.sigma[name] <= flat
    ]
    grows = [f"grows as {' '.join(powers)}"] if powers else []
    alike = [f"{'' if powers else 'is the same '}at every {listed(same)}{' alike' if powers else ''}"] if same else []
    return ", ".join([*grows, *alike]) or "follows no clear power law"


def _misfit(diagnosis: Diagnosis) -> str:
    found = diagnosis.detection
    chance_of_it = f"p {found.p_value:.2g}" if found.p_value > 0.0 else "p too small to be a number"
    return f"chi2 {found.chi2_per_dof:.3g} per reading, {chance_of_it}"


def _likeliest(diagnosis: Diagnosis) -> list[str]:
    """The likeliest hypotheses with an effect, with their probabilities."""
    least = diagnosis.thresholds.name.possible
    listed_so = [one for one in _explained(diagnosis) if one.probability >= least][:RIVALS]
    return [f"{explanation_words(one.hypothesis)} ({chance(one.probability)})" for one in listed_so]


def _rivals(diagnosis: Diagnosis) -> str:
    """Rivals that are still possible and that are excluded, with their odds to the first explanation."""
    if diagnosis.status is VerdictStatus.SUSPICION or not diagnosis.effects:
        return ""
    first, *others = _explained(diagnosis, other_form=False)
    texts = [(explanation_words(one.hypothesis), one.probability) for one in others][: 2 * RIVALS]
    odds = [
        (words, odds_text(first.probability, each), each >= diagnosis.thresholds.name.possible) for words, each in texts
    ]
    possible = [f"{words} ({against})" for words, against, is_possible in odds if is_possible]
    excluded = [f"{words} ({against})" for words, against, is_possible in odds if not is_possible][:RIVALS]
    parts = [f"Still possible, odds to the first: {listed(possible)}." if possible else ""]
    parts += [f"Excluded: {listed(excluded)}." if excluded else ""]
    return " ".join(part for part in parts if part)


def _explained(diagnosis: Diagnosis, *, other_form: bool = True) -> list[Explanation]:
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


def explanation_words(own: Hypothesis) -> str:
    """An explanation in words, each effect with its own place: "churning and film thickness at the slippers"; of the
    null "no mismatch".
    """
    if not own.effects:
        return "no mismatch"
    if len(own.effects) == 1:
        return effect_words(own.effects, own.pair) + _which(own, 0)
    each = enumerate(zip(own.effects, own.places, strict=True))
    return listed(effect_words([effect], place) + _which(own, at) for at, (effect, place) in each)


def _which(own: Hypothesis, at: int) -> str:
    """The parameter of an effect that has several which gaps do not distinguish."""
    return f" ({last_word(str(own.subjects[at]))})" if _named_apart(own, at) else ""


def _named_apart(own: Hypothesis, at: int) -> bool:
    """True if an effect concerns one of several values, one for each pair."""
    subject = own.subjects[at]
    return isinstance(subject, str) and subject not in ("", SUBJECTS.get(own.effects[at])) and not own.places[at]


def _number(channel: ChannelName, value: float) -> str:
    return f"{difference(channel, value):.3g}"
