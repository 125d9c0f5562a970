"""Verdict from the explanations: claims, and their certainty."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.special import logsumexp
from scipy.stats import chi2, norm

from diagnosis.detect.mismatch import Detection
from diagnosis.explain.model_error import behind_unknown, by_chance, chance_of_form, class_gap, place_gap, shared_out
from diagnosis.explain.ranked import Explanation
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import ClaimedEffect, Estimate, Remainder, VerdictStatus
from diagnosis.verdict.doubt import doubted, no_surer
from diagnosis.verdict.equivalence import NOT_NAMED, agrees, equivalents
from diagnosis.verdict.multiplier_chance import MultiplierChance, multiplier_chance
from diagnosis.verdict.residue import remainders
from diagnosis.verdict.row_numbers import table_rows
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import EffectId, Kind
from system.effects.extension import Extension
from system.estimation.fit import is_peak
from system.estimation.posterior import Posterior

MISMATCHES = frozenset(Kind) - {Kind.NO_MISMATCH}
"""Kinds of explanation of a mismatch."""


@dataclass(frozen=True)
class Judgement:
    """Kind, status and claims of a verdict; members of the claimed class; reasons against more, as text.

    ranked: all explanations, the likeliest first; left: what the claims do not explain, among the reasons too.
    """

    kind: Kind
    status: VerdictStatus
    claims: tuple[ClaimedEffect, ...]
    members: tuple[Explanation, ...]
    reasons: tuple[str, ...]
    ranked: tuple[Explanation, ...]
    left: tuple[Remainder, ...] = ()


def judge(
    study: Study,
    detection: Detection,
    explanations: Sequence[Explanation],
    along: Mapping[str, Array],
    thresholds: Thresholds,
) -> Judgement:
    """The verdict on explanations with their probabilities, the likeliest first, including the null.

    along: coordinates (N,) by name, with which an effect may grow (`diagnosis.verdict.trend`).

    A mismatch needs an improbable null and a candidate (or a departure) of a significance that chance hardly produces;
    one of the two alone is a suspicion of the likeliest kind, without a claim. So is a null that is less likely than
    not, with any candidates. A name needs probability, odds to all with other claims, sizes above zero, and no veto of
    held-out regions; it is incomplete if a part of the mismatch remains. Unknown physics as likely as a name is in the
    class of each claim; so it is where the missing physics may be a law of the catalogue in another form
    (`chance_of_form`).
    """
    limits = thresholds.mismatch
    null = next(each for each in explanations if each.hypothesis.kind is Kind.NO_MISMATCH)
    if null.probability >= limits.null_probability:
        if detection.chance >= limits.suspicion and null.probability >= limits.agreed:
            return Judgement(Kind.NO_MISMATCH, VerdictStatus.NAMED, (), (), (), tuple(explanations))
        return _suspicion(explanations, (_one_of_two(detection, null),), frozenset(Kind), detection, thresholds)
    free = _free_multiplier(study, null, explanations, thresholds)
    if min(detection.chance, free.chance) >= limits.chance:
        return _suspicion(explanations, (_one_of_two(detection, null),), frozenset(Kind), detection, thresholds)
    best = _likeliest(explanations, thresholds)
    if best is None:
        return _unknown(study, free, null, explanations, detection, thresholds)
    gap = class_gap(explanations, thresholds)
    members = equivalents(best, explanations, gap, place_gap(explanations, thresholds))
    beside = _beside(members, explanations, thresholds)
    if _together(beside) > _together(members):
        chance = chance_of_form(best, explanations, thresholds)
        explanations, shared = by_chance(explanations, members, beside, chance, thresholds)
        members, beside = shared[: len(members)], shared[len(members) :]
    else:
        explanations, members = shared_out(explanations, members, gap, thresholds)
    against = _objections(study, members, beside, explanations, thresholds)
    if against:
        return _suspicion(explanations, against, _left_open(null, explanations, thresholds), detection, thresholds)
    left = remainders(study, null, members[0], along, thresholds)
    if left:
        explanations, members = _less_sure(explanations, members, thresholds.record.incomplete, (Kind.UNKNOWN_PHYSICS,))
    record = _record_of_scant(study, thresholds)
    if record:
        explanations, members = _less_sure(explanations, members, thresholds.record.type_plate, MISMATCHES)
    claims = _claims(members, beside, explanations, thresholds)
    alike = any(claim.equivalent or claim.elsewhere for claim in claims)
    status = VerdictStatus.INCOMPLETE if left else VerdictStatus.CLASS if alike else VerdictStatus.NAMED
    reasons = (*(one.text for one in left), *record)
    return Judgement(members[0].hypothesis.kind, status, claims, members, reasons, explanations, left)


def _record_of_scant(study: Study, thresholds: Thresholds) -> tuple[str, ...]:
    """Share of right findings on pumps of which little is known, as text; empty for another pump."""
    if not study.scant:
        return ()
    share = f"{thresholds.record.type_plate:.0%}"
    return (f"of findings on pumps known by their type plate alone {share} told every cause and no other",)


def _free_multiplier(
    study: Study, null: Explanation, explanations: Sequence[Explanation], thresholds: Thresholds
) -> MultiplierChance:
    """The chance of unknown physics beside the null, about the prior mean alone where the null has no fit."""
    unknown = [each.hypothesis for each in explanations if each.hypothesis.component is not None]
    return multiplier_chance(study, null.posterior or study.base, unknown, thresholds)


def _weight(each: Explanation) -> float:
    return each.log_weight


def _likeliest(explanations: Sequence[Explanation], thresholds: Thresholds) -> Explanation | None:
    """The likeliest explanation that can be named; None where unknown physics is certain beside it.

    Certain: ahead by more than the gap of a class, and by the chance of the known law in another form.
    """
    known = [each for each in explanations if each.hypothesis.kind not in NOT_NAMED]
    if not known:
        return None
    best = _simplest(max(known, key=_weight), explanations, thresholds)
    behind = behind_unknown(best, explanations) > class_gap(explanations, thresholds)
    if behind and 1.0 - chance_of_form(best, explanations, thresholds) >= thresholds.name.probability:
        return None
    return best


def _beside(
    members: Sequence[Explanation], explanations: Sequence[Explanation], thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """Unknown physics, if all of it together is within the gap of a class behind the members; else none."""
    unknown = tuple(each for each in explanations if each.hypothesis.kind is Kind.UNKNOWN_PHYSICS)
    is_near = unknown and _together(members) - _together(unknown) <= class_gap(explanations, thresholds)
    return unknown if is_near else ()


def _together(explanations: Sequence[Explanation]) -> float:
    return float(logsumexp([each.log_weight for each in explanations])) if explanations else -inf


def _simplest(best: Explanation, explanations: Sequence[Explanation], thresholds: Thresholds) -> Explanation:
    """Of the best and of explanations by a part of its effects within the odds of a name: the fewest effects."""
    names = set(best.hypothesis.open_names)
    near = [
        each
        for each in explanations
        if each.hypothesis.open_names
        and set(each.hypothesis.open_names) <= names
        and best.log_weight - each.log_weight < thresholds.name.odds
    ]
    return min((best, *near), key=lambda each: (len(each.hypothesis.effects), -each.log_weight))


def _one_of_two(detection: Detection, null: Explanation) -> str:
    return (
        f"a candidate as striking as the strongest has a chance of {detection.chance:.2g} where nothing is there, "
        f"and nothing a probability of {null.probability:.2g}: a mismatch needs both to be small"
    )


def _left_open(null: Explanation, explanations: Sequence[Explanation], thresholds: Thresholds) -> Collection[Kind]:
    """Kinds among which a suspicion is open where both tests indicate a mismatch.

    They include "nothing" only if it is less than the odds of a name behind the likeliest explanation. Beyond that the
    mismatch is certain, and the doubt concerns its cause alone.
    """
    ahead = max(map(_weight, explanations)) - null.log_weight
    return MISMATCHES if ahead >= thresholds.name.odds else frozenset(Kind)


def _suspicion(
    explanations: Sequence[Explanation],
    reasons: tuple[str, ...],
    rest: Collection[Kind],
    detection: Detection,
    thresholds: Thresholds,
) -> Judgement:
    """A suspicion of the likeliest kind of mismatch, its probabilities by the record of suspicions.

    rest: the kinds among which it is open (`doubted`). The certainty of a mismatch is no larger than by the readings.
    """
    kinds = {each.hypothesis.kind for each in explanations} - {Kind.NO_MISMATCH}
    likeliest = max(kinds, key=lambda kind: _probability(explanations, kind))
    chance = min(detection.p_value, detection.chance)
    told = no_surer(doubted(explanations, thresholds.record.suspicion, rest), chance)
    ranked = sorted(told, key=lambda each: -each.probability)
    return Judgement(likeliest, VerdictStatus.SUSPICION, (), (), reasons, tuple(ranked))


def _less_sure(
    explanations: Sequence[Explanation], members: Sequence[Explanation], share: float, rest: Collection[Kind]
) -> tuple[tuple[Explanation, ...], tuple[Explanation, ...]]:
    """The explanations and the members of the claimed class, as certain as the record of such findings (`doubted`).

    rest: kinds of other possible explanations. Where a part of the mismatch remains, that part is unknown physics.
    """
    ranked = doubted(explanations, share, rest)
    fresh = {id(old): new for old, new in zip(explanations, ranked, strict=True)}
    return ranked, tuple(fresh[id(each)] for each in members)


def _probability(explanations: Sequence[Explanation], kind: Kind) -> float:
    return sum(each.probability for each in explanations if each.hypothesis.kind is kind)


def _unknown(
    study: Study,
    free: MultiplierChance,
    null: Explanation,
    explanations: Sequence[Explanation],
    detection: Detection,
    thresholds: Thresholds,
) -> Judgement:
    """Unknown physics, without an effect, if its hypotheses together are probable and striking.

    No other explanation remains, so the record of the pump's kind counts before: where forms of the known laws are
    uncertain, a catalogue without an explanation is no proof of an effect beyond it.
    """
    record = _record_of_scant(study, thresholds)
    told = tuple(explanations)
    if record:
        told, _ = _less_sure(told, (), thresholds.record.type_plate, MISMATCHES)
    probability = _probability(told, Kind.UNKNOWN_PHYSICS)
    against, rest = [], _left_open(null, explanations, thresholds)
    if probability < thresholds.name.probability:
        against += [f"unknown physics at a probability of {probability:.2f} only", *record]
    if free.chance >= thresholds.mismatch.chance:
        row = table_rows(study.recording)[free.point]
        against.append(
            f"without point {row}, on which it rests most, unknown physics as far ahead of nothing has a chance "
            f"of {free.chance:.2g} where nothing is there: read that point again"
        )
        rest = frozenset(Kind)
    if against:
        return _suspicion(explanations, tuple(against), rest, detection, thresholds)
    return Judgement(Kind.UNKNOWN_PHYSICS, VerdictStatus.NAMED, (), (), record, told)


def _objections(
    study: Study,
    members: Sequence[Explanation],
    beside: Sequence[Explanation],
    explanations: Sequence[Explanation],
    thresholds: Thresholds,
) -> tuple[str, ...]:
    """Reasons against naming the class. Its members count together: the gaps of one id share its prior.

    beside: unknown physics, where the class contains it too.
    """
    best, limits = members[0], thresholds.name
    own = [each for each in explanations if each in members or each in beside or agrees(each, members)]
    probability = sum(each.probability for each in own)
    rival = max((each for each in explanations if each not in own), key=_weight)
    ahead = _together([*members, *beside]) - rival.log_weight
    found = []
    if probability < limits.probability:
        found.append(f"a probability of {probability:.2f} only")
    if ahead < limits.odds:
        found.append(f"{rival.hypothesis.text} is only {ahead:.1f} nats behind")
    if best.posterior is None:
        found.append("it could not be refitted")
    elif not is_peak(best.posterior, thresholds.fit_limits(study.scant)):
        found.append("its fit has not reached a peak")
    elif not _sure(best, explanations, thresholds):
        found.append("its size is not sure")
    if best.heldout is not None and best.heldout.vetoed:
        gains = ", ".join(
            f"{name} {gain:+.1f}"
            for name, gain in best.heldout.gains.items()
            if gain < thresholds.heldout.negative_gain
        )
        found.append(f"regions held out speak against it (nats): {gains}")
    return tuple(found)


def _sure(best: Explanation, explanations: Sequence[Explanation], thresholds: Thresholds) -> bool:
    """Each law with sizes more than some sigma from zero; each wrong parameter beyond its stated tolerance."""
    posterior, hypothesis = best.posterior, best.hypothesis
    if posterior is None:
        return False
    least = 2.0 * norm.sf(thresholds.name.sure)
    if any(_chance_of_none(best, law, explanations) > least for law in hypothesis.laws):
        return False
    for name in hypothesis.widened:
        beyond = abs(posterior.xi[posterior.index(name)]) * thresholds.name.fault_factor * hypothesis.reach
        if beyond <= thresholds.mismatch.pull or _sigmas(posterior, name) <= thresholds.name.sure:
            return False
    return True


def _chance_of_none(best: Explanation, law: Extension, explanations: Sequence[Explanation]) -> float:
    """The chance that all sizes of a law are zero: by the increase of the objective without it, chi2 (Wilks 1938).

    Several sizes of one law together: none may be certain alone if the readings determine their sum. A law that levels
    off (oil that heats itself thins and heats less) has a wide covariance at its peak, and yet its absence fits far
    worse. Without such a fit, xi^T C^-1 xi about the peak, the same for linear readings.
    """
    names = {one.name for one in law.parameters}
    rest = set(best.hypothesis.open_names) - names
    known = (each for each in explanations if each.posterior is not None and each.hypothesis.component is None)
    without = next((each.posterior for each in known if set(each.hypothesis.open_names) == rest), None)
    posterior = best.posterior
    if posterior is None:
        return 1.0
    if without is not None:
        return float(chi2.sf(without.objective - posterior.objective, len(names)))
    at = [posterior.index(name) for name in names]
    xi = posterior.xi[at]
    return float(chi2.sf(xi @ np.linalg.solve(posterior.covariance[np.ix_(at, at)], xi), len(at)))


def _sigmas(posterior: Posterior, name: str) -> float:
    at = posterior.index(name)
    return float(abs(posterior.xi[at]) / np.sqrt(posterior.covariance[at, at]))


def _claims(
    members: Sequence[Explanation],
    beside: Sequence[Explanation],
    explanations: Sequence[Explanation],
    thresholds: Thresholds,
) -> tuple[ClaimedEffect, ...]:
    """One claim for each effect of the best member; its probability is the sum over all that claim it.

    beside: unknown physics inseparable from any of them.
    """
    best = members[0]
    own = best.hypothesis
    rivals = {effect for each in members for effect in each.hypothesis.effects} - set(own.effects)
    shared = set.intersection(*(set(each.hypothesis.effects) for each in members))
    claims = []
    for at, effect in enumerate(own.effects):
        probability = sum(each.probability for each in explanations if effect in each.hypothesis.effects)
        equivalent = () if effect in shared else tuple(sorted(rivals, key=lambda one: one.value))
        equivalent += (EffectId.UNKNOWN_PHYSICS,) if beside else ()
        claims.append(
            ClaimedEffect(
                effect,
                own.places[at],
                probability,
                equivalent,
                _estimates(best, at),
                _elsewhere(at, members, thresholds),
            )
        )
    return tuple(claims)


def _elsewhere(at: int, members: Sequence[Explanation], thresholds: Thresholds) -> tuple[tuple[Gap, float], ...]:
    """Other gaps for one effect of the first member, each with its share; none if its own gap is certain."""
    own = members[0].hypothesis
    same = [each for each in members if each.hypothesis.effects == own.effects]
    total = sum(each.probability for each in same)
    share: dict[Gap | None, float] = {}
    for each in same:
        place = each.hypothesis.places[at]
        share[place] = share.get(place, 0.0) + each.probability / total
    if share[own.places[at]] >= thresholds.name.probability:
        return ()
    return tuple((gap, part) for gap, part in share.items() if gap is not None and gap is not own.places[at])


def _estimates(best: Explanation, at: int) -> tuple[Estimate, ...]:
    """The fitted parameters of one effect; those of a law by the last part of their path."""
    posterior, own = best.posterior, best.hypothesis
    if posterior is None:
        return ()
    subject = own.subjects[at]
    if isinstance(subject, str):
        return (_estimate(posterior, subject, False),)
    return tuple(_estimate(posterior, one.name, True) for one in subject.free)


def _estimate(posterior: Posterior, name: str, short: bool) -> Estimate:
    at = posterior.index(name)
    shown = name.rpartition(".")[2] if short else name
    dimension = posterior.parameters[at].dimension
    return Estimate(shown, float(posterior.values[at]), posterior.sigma(name), dimension)
