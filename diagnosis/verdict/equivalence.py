"""Which explanations a recording cannot tell from each other."""

from __future__ import annotations

from collections.abc import Sequence

from diagnosis.explain.ranked import Explanation
from system.effects.effect import Kind

NOT_NAMED = (Kind.NO_MISMATCH, Kind.UNKNOWN_PHYSICS)


def equivalents(
    best: Explanation, weighed: Sequence[Explanation], gap: float, place_gap: float
) -> tuple[Explanation, ...]:
    """Explanations of as many effects as the best that stand as well after a refit, the best first.

    As well: ln evidence within the gap (nats), of the same effects elsewhere within the gap of places; or the same
    readings foretold (the difference of the refitted predictions worth less than the gap, delta^2 / 2 nats) with
    all else as near its stated value: then only the width of the prior of what they set free parts them, however
    far. Likeness of slopes makes no class: laws of one slope part by their curvature.
    """
    rivals = [each for each in weighed if each is not best and _comparable(each, best)]
    alike = [
        each
        for each in rivals
        if best.log_evidence - each.log_evidence <= (place_gap if _elsewhere(each, best) else gap)
        or (parting(best, each) <= gap and _strain(each) - _strain(best) <= gap)
    ]
    return (best, *alike)


def parting(one: Explanation, other: Explanation) -> float:
    """Nats by which readings like these would part two refitted explanations: delta^2 / 2; inf if not refitted."""
    if one.posterior is None or other.posterior is None:
        return float("inf")
    apart = one.posterior.whitening.whiten(one.posterior.predictions - other.posterior.predictions)
    return 0.5 * float(apart @ apart)


def _strain(weighed: Explanation) -> float:
    """Nats of a refit's objective without what the size of that which it sets free costs: (r^2 + xi^2) / 2."""
    posterior = weighed.posterior
    if posterior is None:
        return float("inf")
    own = [posterior.index(name) for name in weighed.hypothesis.open_names]
    return 0.5 * (posterior.objective - float((posterior.xi[own] ** 2).sum()))


def agrees(each: Explanation, members: Sequence[Explanation]) -> bool:
    """Whether an explanation claims at least what one of the members claims: it, or it and more."""
    return any(
        set(member.hypothesis.open_names) <= set(each.hypothesis.open_names) and each.hypothesis.effects
        for member in members
    )


def _elsewhere(each: Explanation, best: Explanation) -> bool:
    """Whether an explanation claims the same effects at other places, by a fit of its own."""
    return each.posterior is not None and each.hypothesis.effects == best.hypothesis.effects


def _comparable(each: Explanation, best: Explanation) -> bool:
    own, other = each.hypothesis, best.hypothesis
    same = own.open_names == other.open_names
    return own.kind not in NOT_NAMED and len(own.effects) == len(other.effects) and not same
