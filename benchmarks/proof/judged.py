"""An outcome judged: right or wrong, certain or not, ranks of explanations."""

from __future__ import annotations

from .outcome import Claimed, Outcome, Ranked

UNKNOWN = "unknown_physics"
FLAGGED = ("suspicion", "incomplete", "failed")
SET = 0.95
SURE = 0.9
Place = tuple[tuple[str, str], ...]


def truth_of(outcome: Outcome) -> frozenset[str]:
    """The ids of the truth as an explanation has them."""
    return frozenset(outcome.effects) if outcome.truth != UNKNOWN else frozenset({UNKNOWN})


def _is_whole_truth(ids: frozenset[str], outcome: Outcome) -> bool:
    """Whether an explanation's ids are those of the truth, with faults beside it or without."""
    return ids - frozenset(outcome.beside) == truth_of(outcome)


def is_right(outcome: Outcome) -> bool:
    """Whether the verdict is the truth, by its effects or their classes; a missing gap is not wrong.

    A fault beside the truth may be named too. Unknown physics counts as a verdict, or in the class of every claim.
    """
    if not outcome.effects:
        told = outcome.verdict == outcome.truth or is_open(outcome)
        return told and outcome.status != "suspicion"
    left = [one for one in outcome.claims if one.effect not in outcome.beside]
    if outcome.status == "suspicion" or len(left) != len(outcome.effects):
        return False
    for effect, pair in zip(outcome.effects, outcome.pairs, strict=True):
        fits = [
            one
            for one in left
            if (one.effect == effect and _at_gap(one, pair)) or (one.effect != effect and effect in one.equivalent)
        ]
        if not fits:
            return False
        left.remove(fits[0])
    return True


def is_open(outcome: Outcome) -> bool:
    """Whether the truth is unknown physics and every claim includes it."""
    of_claims = [UNKNOWN in one.equivalent for one in outcome.claims]
    return outcome.truth == UNKNOWN and bool(of_claims) and all(of_claims)


def _at_gap(claim: Claimed, pair: str | None) -> bool:
    """Whether a claim is at a gap: stated, in its class, or at none; in a plant without gaps (None) no gap is wrong."""
    return claim.pair is None or pair in (None, claim.pair, *claim.elsewhere)


def is_named(outcome: Outcome) -> bool:
    """Whether anything is claimed: an effect, or unknown physics."""
    unknown = outcome.verdict == UNKNOWN and outcome.status == "named"
    return bool(outcome.claims) or unknown


def is_wrong_name(outcome: Outcome) -> bool:
    """Whether a claim is not the truth; a part of the truth alone is not wrong."""
    if not outcome.claims:
        return is_named(outcome) and outcome.truth != UNKNOWN
    return bool(_wrong_claims(outcome))


def _wrong_claims(outcome: Outcome) -> list[Claimed]:
    """Claims of which no id is concealed, or whose id is concealed at other gaps alone."""
    known, found = {*truth_of(outcome), *outcome.beside}, []
    for one in outcome.claims:
        gaps = [pair for effect, pair in zip(outcome.effects, outcome.pairs, strict=True) if effect == one.effect]
        elsewhere = bool(gaps) and not any(_at_gap(one, pair) for pair in gaps)
        found += [one] if elsewhere or not known & {one.effect, *one.equivalent} else []
    return found


def is_grave(outcome: Outcome) -> bool:
    """Wrong, certain and unflagged: the error that must not occur."""
    return is_sure_and_wrong(outcome) and outcome.status not in FLAGGED


def is_sure_and_wrong(outcome: Outcome) -> bool:
    """Wrong at a stated probability of .9 at least, flagged or not: of a claim with its class, of unknown physics."""
    if not is_wrong_name(outcome):
        return False
    told = [max(one.probability, of_class(outcome, one)) for one in _wrong_claims(outcome)] or [of_unknown(outcome)]
    return max(told) >= SURE


def of_class(outcome: Outcome, claim: Claimed) -> float:
    """The probability of a claim and of its class, together."""
    members = {claim.effect, *claim.equivalent}
    return sum(one.probability for one in outcome.ranked if members & set(one.effects))


def of_unknown(outcome: Outcome) -> float:
    """The probability of unknown physics, of all components together."""
    return sum(one.probability for one in outcome.ranked if UNKNOWN in one.effects)


def groups(outcome: Outcome) -> list[tuple[frozenset[str], float]]:
    """Explanations by their ids, the places of one id together, the likeliest first."""
    found: dict[frozenset[str], float] = {}
    for one in outcome.ranked:
        found[frozenset(one.effects)] = found.get(frozenset(one.effects), 0.0) + one.probability
    return sorted(found.items(), key=lambda each: -each[1])


def rank(outcome: Outcome) -> int | None:
    """The place of the truth among the explanations, from 1; 1 too where it is in the class that is claimed.

    Not the first for another claim: its effect at another gap.
    """
    if is_right(outcome):
        return 1
    listed = enumerate((ids for ids, _ in groups(outcome)), start=1)
    place = next((at for at, ids in listed if _is_whole_truth(ids, outcome)), None)
    return max(place, 2) if place is not None and is_wrong_name(outcome) else place


def in_set(outcome: Outcome) -> bool:
    """Whether the truth, at its gap, is among the likeliest explanations that hold 95 % together."""
    return any(_is_truth(place, outcome) for place in likeliest_set(outcome))


def likeliest_set(outcome: Outcome) -> list[Place]:
    """The likeliest explanations that hold 95 % together, all of them where they hold less."""
    found: dict[Place, float] = {}
    for one in outcome.ranked:
        found[_place(one)] = found.get(_place(one), 0.0) + one.probability
    listed, held = list[Place](), 0.0
    for place, probability in sorted(found.items(), key=lambda each: -each[1]):
        listed.append(place)
        held += probability
        if held >= SET:
            break
    return listed


def _place(one: Ranked) -> Place:
    return tuple(sorted(((effect, pair or "") for effect, pair in zip(one.effects, one.pairs, strict=True))))


def _is_truth(place: Place, outcome: Outcome) -> bool:
    """Whether effects are the true ones, each at its gap where both have one."""
    if not _is_whole_truth(frozenset(effect for effect, _ in place), outcome):
        return False
    true = dict(zip(outcome.effects, outcome.pairs, strict=True))
    return all(not gap or true.get(effect) in (None, gap) for effect, gap in place)


def confidence(outcome: Outcome) -> tuple[float, bool]:
    """Probability of the likeliest explanation, and whether it is the truth.

    Of an explanation with more effects than a verdict claims, its claims count, by all explanations that hold them: a
    verdict claims A where A with B is likelier by less than the odds of a name.
    """
    listed = groups(outcome)
    if not listed:
        return 1.0, False
    likeliest, probability = listed[0]
    claimed = frozenset(one.effect for one in outcome.claims)
    if claimed and claimed < likeliest:
        told = sum(share for ids, share in listed if claimed <= ids)
        return told, bool(claimed & truth_of(outcome)) and claimed <= truth_of(outcome) | set(outcome.beside)
    return probability, _is_whole_truth(likeliest, outcome)
