"""Scores of the answers to a split: detection, isolation, classification errors, time; with Wilson's intervals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from proof.calibration import wilson
from proof.judged import in_set, is_right, is_sure_and_wrong, is_wrong_name, likeliest_set
from proof.outcome import Claimed, Outcome, Ranked as Weighed
from proof.parts import Plant

from system.effects.effect import Kind

from .answer import Answer
from .truth import Truth

NOTHING, UNKNOWN = Kind.NO_MISMATCH.value, Kind.UNKNOWN_PHYSICS.value


@dataclass(frozen=True)
class Share:
    """A count of so many, with the ends of Wilson's 95 % interval."""

    hits: int
    of: int

    @property
    def text(self) -> str:
        """The share in % with its interval, and the counts."""
        if not self.of:
            return "-"
        low, high = (100.0 * end for end in wilson(self.hits, self.of))
        return f"{100.0 * self.hits / self.of:.0f} % ({low:.0f} to {high:.0f}), {self.hits}/{self.of}"


@dataclass(frozen=True)
class Score:
    """Score of one entry over the recordings of a split; one without an answer, or failed, counts as not detected.

    false_positive: of nulls, alarms; false_negative: of the others, no alarm; detected: both right, of all; right: of
    recordings with concealed causes, exactly these named; right_at: the same by plant; right_alone: right by the ids
    themselves, without their classes; wrong: of all, a wrong cause named; sure_and_wrong: at a probability of .9 or
    more; in_set: of rankings given, the truth among the explanations that hold 95 %; set_size: mean number of these.
    errors: of classification, per recording: ids named wrongly, and concealed ids not named. cpu_s: median.
    """

    entry: str
    answered: Share
    false_positive: Share
    false_negative: Share
    detected: Share
    right: Share
    right_alone: Share
    right_at: Mapping[str, Share]
    wrong: Share
    sure_and_wrong: Share
    in_set: Share
    set_size: float
    errors: float
    cpu_s: float


@dataclass(frozen=True)
class Judged:
    """An answer, or none, beside the truth."""

    truth: Truth
    answer: Answer | None
    outcome: Outcome

    @property
    def null(self) -> bool:
        """True where nothing is concealed."""
        return self.truth.verdict == NOTHING

    @property
    def answered(self) -> bool:
        """True where there is an answer and the tool has not failed."""
        return self.answer is not None and self.answer.status != "failed"

    @property
    def alarm(self) -> bool:
        """True where the answer reports a mismatch."""
        if self.answer is None or not self.answered:
            return False
        return self.answer.verdict != NOTHING or self.answer.status == "suspicion"

    @property
    def right_alone(self) -> bool:
        """True where the ids named are the concealed ones, each without its class."""
        alone = tuple(replace(one, equivalent=()) for one in self.outcome.claims)
        return is_right(replace(self.outcome, claims=alone))

    @property
    def errors(self) -> int:
        """Ids named wrongly, and concealed ids not named; an id of a class represents the class.

        Unknown physics that is not reported as such is not named, nor is what a suspicion tells.
        """
        named = self.answer if self.answer is not None and self.answer.status == "named" else None
        left, errors = [*self.truth.ids], 0
        for one in () if named is None else named.names:
            own = next((id for id in (one.id, *one.equivalent) if id in left), None)
            if own is not None:
                left.remove(own)
            elif not {one.id, *one.equivalent} & set(self.truth.beside):
                errors += 1
        told = named is not None and named.verdict == UNKNOWN
        return errors + len(left) + (self.truth.verdict == UNKNOWN and not told)


def score(entry: str, truths: Sequence[Truth], answers: Mapping[str, Answer]) -> Score:
    """Return the score of an entry's answers to all recordings of a split."""
    all_of = [judged(one, answers.get(one.recording)) for one in truths]
    nulls, hidden = [one for one in all_of if one.null], [one for one in all_of if not one.null]
    ranked = [one for one in all_of if one.answer is not None and one.answer.ranking]
    times = [one.cpu_s for one in answers.values() if np.isfinite(one.cpu_s)]
    return Score(
        entry=entry,
        answered=_share(all_of, lambda one: one.answered),
        false_positive=_share(nulls, lambda one: one.alarm),
        false_negative=_share(hidden, lambda one: not one.alarm),
        detected=_share(all_of, lambda one: one.answered and one.alarm is not one.null),
        right=_share(hidden, lambda one: is_right(one.outcome)),
        right_alone=_share(hidden, lambda one: one.right_alone),
        right_at={
            plant.value: _share([one for one in hidden if one.truth.plant == plant.value],
                                lambda one: is_right(one.outcome)) for plant in Plant
        },
        wrong=_share(all_of, lambda one: is_wrong_name(one.outcome)),
        sure_and_wrong=_share(all_of, lambda one: is_sure_and_wrong(one.outcome)),
        in_set=_share(ranked, lambda one: in_set(one.outcome)),
        set_size=float(np.mean([len(likeliest_set(one.outcome)) for one in ranked])) if ranked else float("nan"),
        errors=float(np.mean([one.errors for one in all_of])) if all_of else 0.0,
        cpu_s=float(np.median(times)) if times else float("nan"),
    )  # fmt: skip


def judged(truth: Truth, answer: Answer | None) -> Judged:
    """Return an answer beside the truth; without one, or where the tool failed, an empty one."""
    gaps = tuple(gap or None for gap in truth.gaps)
    known = Outcome(
        name=truth.recording, part=truth.part, campaign="", seed=0, asked=0.0, score=truth.score, sizes={},
        truth=truth.verdict, effects=truth.ids, pairs=gaps, shares={}, beside=truth.beside, status="failed",
    )  # fmt: skip
    if answer is None or answer.status == "failed":
        return Judged(truth, None if answer is None else answer, known)
    told = answer.status == "named"
    names = tuple(Claimed(one.id, one.gap or None, one.probability, one.equivalent) for one in answer.names if told)
    weighed = tuple(
        Weighed(one.ids, tuple(gap or None for gap in one.gaps), "", one.probability) for one in answer.ranking
    )
    outcome = Outcome(**vars(known) | {"verdict": answer.verdict, "status": answer.status, "claims": names,
                                       "ranked": weighed})  # fmt: skip
    return Judged(truth, answer, outcome)


def _share(listed: Sequence[Judged], test: Callable[[Judged], bool]) -> Share:
    return Share(sum(map(test, listed)), len(listed))
