"""The answer of a diagnosis for a bench engineer, readable in ten minutes."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from diagnosis.report.certainty import SURE, certainty, record_words, sure_words
from diagnosis.report.course import course_words, drift_words
from diagnosis.report.evidence import evidence
from diagnosis.report.format import PLACES, effect_words, listed, sentence_case
from diagnosis.report.hidden import hidden_effects, hidden_examples
from diagnosis.report.measure import hidden_words, measure_words
from diagnosis.report.sizes import size_words
from diagnosis.report.text import doubt, finding, fit_words, headline, rivals_words, suspected, where_words
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from system.description.gap import Gap
from system.effects.catalogue.bench_words import BENCH_WORDS, PARTS
from system.effects.effect import EffectId, Kind
from system.inputs.channels import ChannelName

SUSPECTS = 2
"""Number of explanations of a suspicion with inspections on the page."""
TO_THE_INLET = frozenset({EffectId.PORT_SHORT_CIRCUIT, EffectId.LAMINAR_CROSS_LEAK})
LEAK_OUTSIDE = (
    "No inlet flow is recorded: a leak of the line between the pump and its flow meter looks alike. Look at the "
    "bench's relief valve and fittings, too."
)


@dataclass(frozen=True)
class Look:
    """Inspection for one effect: its id, the parts or meters to inspect, and its name with the place as a heading.

    name: empty for the one cause of a claim, which the finding names.
    """

    id: str
    name: str
    text: str


@dataclass(frozen=True)
class PlainAnswer:
    """The answer in sentences, in the order of reading; empty parts have no content.

    headline: kind of answer; finding: process with sizes; cost: in flow, torque and efficiency; doubt: explanations
    inseparable from it, and the unexplained part; course: distance of the readings from the simulation; where: channels
    and part of the map; certainty: with the record of such answers; rivals: other possible explanations, excluded ones;
    look: parts to inspect; measure: next measurement; fit: points not used in the fit; evidence: sentences of
    statistics. sizes: of each claim; sure, record: certainty and the record of such answers in a word or two each.
    """

    headline: str
    finding: str
    cost: str
    doubt: str
    course: str
    where: str
    certainty: str
    rivals: str
    look: tuple[Look, ...]
    measure: str
    fit: str
    evidence: tuple[str, ...]
    sizes: tuple[str, ...]
    sure: str
    record: str


def plain_answer(study: Study, diagnosis: Diagnosis, cost: str) -> PlainAnswer:
    """The answer on a study; cost: of the finding, as a sentence."""
    return PlainAnswer(
        headline=headline(diagnosis),
        finding=finding(diagnosis),
        cost=cost,
        doubt=" ".join(filter(None, (doubt(diagnosis), drift_words(study, diagnosis)))),
        course=course_words(study, diagnosis),
        where=where_words(diagnosis),
        certainty=certainty(diagnosis, study.scant),
        rivals=rivals_words(diagnosis),
        look=tuple(inspections(diagnosis, study.channels)),
        measure=_measure(study, diagnosis),
        fit=fit_words(diagnosis),
        evidence=evidence(diagnosis),
        sizes=tuple(map(size_words, diagnosis.effects)),
        sure=sure_words(diagnosis, study.scant),
        record=record_words(diagnosis, study.scant),
    )


def _measure(study: Study, diagnosis: Diagnosis) -> str:
    """The next measurement. Without a mismatch, if that is uncertain or only a type plate is known of the pump: effects
    that may be hidden, and the measurements that would show them.
    """
    found = diagnosis.kind is not Kind.NO_MISMATCH or diagnosis.status is VerdictStatus.SUSPICION
    if found or (sure_words(diagnosis, study.scant) in SURE and not study.scant):
        return measure_words(diagnosis)
    return hidden_words(study, hidden_examples(study, hidden_effects(study, diagnosis)))


def inspections(diagnosis: Diagnosis, channels: Collection[ChannelName]) -> Iterator[Look]:
    """Inspections for claims and explanations inseparable from them; of a suspicion the likeliest; of the unknown.

    channels: the recorded ones.
    """
    outside = frozenset() if ChannelName.Q_IN in channels else TO_THE_INLET
    places: dict[EffectId, list[Gap]] = {}
    for effect, pair in _suspects(diagnosis):
        known = places.setdefault(effect, [])
        known += [pair] if pair is not None and pair not in known else []
    alone = len(places) == 1 and diagnosis.status is not VerdictStatus.SUSPICION
    for effect, gaps in places.items():
        where = f" at {listed((PLACES[gap] for gap in gaps), 'or')}" if gaps else ""
        parts, name = listed(PARTS[gap] for gap in gaps or Gap), effect_words([effect])
        heading = "" if alone else f"{sentence_case(name)}{where}"
        beside = f" {LEAK_OUTSIDE}" if effect in outside else ""
        yield Look(effect.value, heading, f"{BENCH_WORDS[effect].look.format(parts=parts)}{beside}")


def _suspects(diagnosis: Diagnosis) -> Iterator[tuple[EffectId, Gap | None]]:
    if diagnosis.status is VerdictStatus.SUSPICION:
        known = [one.hypothesis for one in suspected(diagnosis)]
        likely = [own for own in known if EffectId.UNKNOWN_PHYSICS not in own.effects][:SUSPECTS]
        yield from (pair for own in likely for pair in zip(own.effects, own.places, strict=True))
    elif diagnosis.kind is Kind.UNKNOWN_PHYSICS:
        yield EffectId.UNKNOWN_PHYSICS, None
    for claim in diagnosis.effects:
        yield claim.effect, claim.pair
        yield from ((claim.effect, gap) for gap, _ in claim.elsewhere)
        yield from ((one, None) for one in claim.equivalent)
