"""Certainty of an answer in words, with the record of such answers on other simulators beside it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cache
from importlib.resources import files

from scipy.stats import binomtest

from diagnosis.report.format import chance, sentence_case
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis, VerdictStatus
from system.effects.effect import EffectId, Kind

ENOUGH = 10
"""Trials of a band of probability below which all bands of the answer count together."""
GRADES = ((0.9, "very sure"), (0.75, "fairly sure"), (0.5, "likely"))
LIKELY = GRADES[-1][0]
"""Probability from which an answer is likelier than not."""
SURE = ("very sure", "fairly sure")
"""Words of certainty of reliable answers."""


class AnswerKind(Enum):
    """Kinds of an answer with a record of their own, by their names in track_record.json."""

    NAME = "name"
    PART = "part"
    UNKNOWN = "unknown"
    SUSPICION = "suspicion"
    NOTHING = "nothing"


@dataclass(frozen=True)
class Record:
    """Right answers among `cases` of one kind in the proof, on pumps with a file or known by their type plate.

    banded: only those of similar probability count.
    """

    right: int
    cases: int
    banded: bool

    @property
    def trust(self) -> float:
        """Probability that the next such answer is right, (right + 1)/(cases + 2) (Laplace's rule of succession)."""
        return (self.right + 1) / (self.cases + 2)

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval of the share of right ones (Wilson 1927)."""
        found = binomtest(self.right, self.cases).proportion_ci(0.95, method="wilson")
        return float(found.low), float(found.high)


@cache
def _rows() -> tuple[dict[str, str | float], ...]:
    text = files("diagnosis.report").joinpath("track_record.json").read_text("utf-8")
    return tuple(json.loads(text)["rows"])


def record_of(kind: AnswerKind, scant: bool, probability: float) -> Record | None:
    """The record of answers of a kind and of similar probability; of any probability if those are fewer than `ENOUGH`.

    scant: of pumps known by their type plate. None without such a trial.
    """
    pump = "type_plate" if scant else "stated"
    rows = [row for row in _rows() if (row["answer"], row["pump"]) == (kind.value, pump)]
    own = [row for row in rows if float(row["from"]) <= probability < float(row["to"]) or probability == row["to"]]
    banded = sum(int(row["cases"]) for row in own) >= ENOUGH
    counted = own if banded else rows
    cases = sum(int(row["cases"]) for row in counted)
    return Record(sum(int(row["right"]) for row in counted), cases, banded) if cases else None


def stated_probability(diagnosis: Diagnosis) -> float:
    """The probability of the answer: of claims that of the least certain class; of a suspicion that of any mismatch.

    A class may include a cause outside the catalogue, which no reading contradicts: it does not count.
    """
    if diagnosis.effects:
        return min(_of_class(claim, diagnosis) for claim in diagnosis.effects)
    wanted = Kind.UNKNOWN_PHYSICS if _kind(diagnosis) is AnswerKind.UNKNOWN else Kind.NO_MISMATCH
    found = sum(one.probability for one in diagnosis.hypotheses if one.hypothesis.kind is wanted)
    return 1.0 - found if diagnosis.status is VerdictStatus.SUSPICION else found


def certainty(diagnosis: Diagnosis, scant: bool) -> str:
    """Certainty of the answer, the record of such answers with its interval, and open questions of the recording."""
    return " ".join(_sentences(diagnosis, scant))


def sure_words(diagnosis: Diagnosis, scant: bool) -> str:
    """Certainty in a word or two, by the lesser of the stated probability and the trust in such answers on record.

    For a suspicion it is the certainty that there is a cause.
    """
    probability = stated_probability(diagnosis)
    record = record_of(_kind(diagnosis), scant, probability)
    trust = min(probability, record.trust) if record else probability
    return next((words for least, words in GRADES if trust >= least), "not sure")


def record_words(diagnosis: Diagnosis, scant: bool) -> str:
    """The record of such answers in a few words: "31 of 32 such answers right"; empty without one."""
    record = record_of(_kind(diagnosis), scant, stated_probability(diagnosis))
    return f"{record.right} of {record.cases} such answers right" if record else ""


def record_text(record: Record, kind: AnswerKind, scant: bool) -> str:
    """The record as a sentence, with the interval."""
    low, high = (100.0 * end for end in record.interval)
    like = " with such certainty" if record.banded else ""
    of = " of pumps known by their type plate" if scant else ""
    return (
        f"In trials on other simulators{of}, {_RIGHT[kind].format(right=record.right, cases=record.cases, like=like)} "
        f"(95 % interval {low:.0f} to {high:.0f} %)."
    )


_RIGHT = {
    AnswerKind.NAME: "{right} of {cases} names given{like} proved right",
    AnswerKind.PART: "{right} of {cases} names that left a part unexplained proved right",
    AnswerKind.UNKNOWN: "{right} of {cases} answers of this kind proved right",
    AnswerKind.SUSPICION: "{right} of {cases} suspicions had a cause",
    AnswerKind.NOTHING: "{right} of {cases} answers of this kind{like} proved right, the others missed an effect",
}


_OF = {
    AnswerKind.SUSPICION: " that there is a cause",
    AnswerKind.NOTHING: " that nothing is wrong",
    AnswerKind.UNKNOWN: " that no effect of the catalogue is the cause",
}


def _sentences(diagnosis: Diagnosis, scant: bool) -> Iterator[str]:
    kind, probability = _kind(diagnosis), stated_probability(diagnosis)
    words = sure_words(diagnosis, scant)
    whole = " that this is the whole cause" if scant and diagnosis.effects else ""
    of = _which(diagnosis) or _OF.get(kind, whole)
    yield f"{sentence_case(words)}{of} (stated probability {chance(probability)})."
    record = record_of(kind, scant, probability)
    if record is not None:
        yield record_text(record, kind, scant)


def _which(diagnosis: Diagnosis) -> str:
    """Statement to which the certainty of a claim with a class refers; empty for claims without a class."""
    claims = diagnosis.effects
    outside = any(EffectId.UNKNOWN_PHYSICS in claim.equivalent for claim in claims)
    alike = any(_named(claim) - {claim.effect} or claim.elsewhere for claim in claims)
    which = "this" if not alike else "one of these" if len(claims) == 1 else "these, or what cannot be told from them"
    beside = " and no cause outside the catalogue" if outside else ""
    return f" that it is {which}{beside}" if alike or outside else ""


def _named(claim: ClaimedEffect) -> set[EffectId]:
    """The effects of a claim and of its class that have a law."""
    return {claim.effect, *claim.equivalent} - {EffectId.UNKNOWN_PHYSICS}


def _kind(diagnosis: Diagnosis) -> AnswerKind:
    if diagnosis.status is VerdictStatus.SUSPICION:
        return AnswerKind.SUSPICION
    if diagnosis.kind is Kind.NO_MISMATCH:
        return AnswerKind.NOTHING
    if diagnosis.kind is Kind.UNKNOWN_PHYSICS:
        return AnswerKind.UNKNOWN
    return AnswerKind.PART if diagnosis.status is VerdictStatus.INCOMPLETE else AnswerKind.NAME


def _of_class(claim: ClaimedEffect, diagnosis: Diagnosis) -> float:
    members = _named(claim)
    return min(1.0, sum(one.probability for one in diagnosis.hypotheses if members & set(one.hypothesis.effects)))
