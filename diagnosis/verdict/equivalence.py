"""Classes of explanations that a recording cannot separate."""

from __future__ import annotations

from collections.abc import Sequence

from diagnosis.explain.ranked import Explanation
from system.effects.effect import Kind

NOT_NAMED = (Kind.NO_MISMATCH, Kind.UNKNOWN_PHYSICS)


def equivalents(
    best: Explanation, explanations: Sequence[Explanation], gap: float, place_gap: float
) -> tuple[Explanation, ...]:
    """Explanations with as many effects as the best and an equal refit, the best first.

    Equal: ln evidence within the gap (nats), within `place_gap` for the same effects at other gaps; or the same
    predicted readings (difference of the refitted predictions below the gap, delta^2 / 2 nats) with all other
    parameters as near to their stated values: then only the prior widths of the free parameters separate them. Equal
    slopes make no class: laws of one slope differ by their curvature.
    """
    rivals = [each for each in explanations if each is not best and _comparable(each, best)]
    alike = [
        each
        for each in rivals
        if best.log_evidence - each.log_evidence <= (place_gap if _elsewhere(each, best) else gap)
        or (parting(best, each) <= gap and _strain(each) - _strain(best) <= gap)
    ]
    return (best, *alike)


def parting(one: Explanation, other: Explanation) -> float:
    """Nats by which such readings separate two refitted explanations: delta^2 / 2; inf if not refitted."""
    if one.posterior is None or other.posterior is None:
        return float("inf")
    apart = one.posterior.whitening.whiten(one.posterior.predictions - other.posterior.predictions)
    return 0.5 * float(apart @ apart)


def _strain(explanation: Explanation) -> float:
    """Nats of a refit's objective, (r^2 + xi^2) / 2, without the prior cost of its free parameters."""
    posterior = explanation.posterior
    if posterior is None:
        return float("inf")
    own = [posterior.index(name) for name in explanation.hypothesis.open_names]
    return 0.5 * (posterior.objective - float((posterior.xi[own] ** 2).sum()))


def agrees(each: Explanation, members: Sequence[Explanation]) -> bool:
    """True if an explanation claims at least the effects of one of the members."""
    return any(
        set(member.hypothesis.open_names) <= set(each.hypothesis.open_names) and each.hypothesis.effects
        for member in members
    )


def _elsewhere(each: Explanation, best: Explanation) -> bool:
    """True if an explanation claims the same effects at other places, by a fit of its own."""
    return each.posterior is not None and each.hypothesis.effects == best.hypothesis.effects


def _comparable(each: Explanation, best: Explanation) -> bool:
    own, other = each.hypothesis, best.hypothesis
    same = own.open_names == other.open_names
    return own.kind not in NOT_NAMED and len(own.effects) == len(other.effects) and not same
