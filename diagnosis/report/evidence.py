"""The statistics behind an answer, in sentences for its appendix: misfit, growth, odds, gain of a next point."""

from __future__ import annotations

from collections.abc import Iterator
from math import exp, log

from diagnosis.explain.scaling import Scaling
from diagnosis.next_point.choose import NextPoint
from diagnosis.report.explanations import RIVALS, explained_by, explanation_words
from diagnosis.report.format import MOST_ODDS, chance, effect_words, listed, odds_text
from diagnosis.report.measure import point_words
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus


def evidence(diagnosis: Diagnosis) -> tuple[str, ...]:
    """Sentences with the numbers behind the verdict."""
    return tuple(_sentences(diagnosis))


def _sentences(diagnosis: Diagnosis) -> Iterator[str]:
    found = diagnosis.detection
    p_value = f"p {found.p_value:.2g}" if found.p_value > 0.0 else "p too small to be a number"
    yield f"The pump as described, within its tolerances: chi2 {found.chi2_per_dof:.3g} per reading, {p_value}."
    for candidate, score in found.strongest[:1]:
        yield (
            f"The strongest candidate is {effect_words([candidate.entry.id])}, {abs(score.z):.1f} sigma; without any "
            f"effect one as strong has a chance of {chance(found.chance)}."
        )
    if diagnosis.scaling is not None:
        side = "higher" if diagnosis.scaling.above else "lower"
        grows = _growth(diagnosis.scaling, diagnosis.thresholds.form.flat)
        yield f"{diagnosis.scaling.channel.value} reads {side} than simulated; the difference {grows}."
    if diagnosis.effects and diagnosis.status is not VerdictStatus.SUSPICION:
        yield from _odds_to_rivals(diagnosis)
    if diagnosis.next_point is not None:
        yield _gain(diagnosis.next_point)


def _growth(scaling: Scaling, flat: float) -> str:
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


def _odds_to_rivals(diagnosis: Diagnosis) -> Iterator[str]:
    first, *others = explained_by(diagnosis, other_form=False)
    odds = [
        f"{explanation_words(one.hypothesis)} {odds_text(first.probability, one.probability)}"
        for one in others[: 2 * RIVALS]
    ]
    if odds:
        yield f"Odds of the others to the first: {listed(odds)}."


def _gain(found: NextPoint) -> str:
    """The odds of the two explanations of a next point, now and after readings there."""
    first, second = found.between
    ahead, behind = (first, second) if found.before >= 0.0 else (second, first)
    return (
        f"Odds of {behind} to {ahead}: {_odds(abs(found.before))} now. {found.readings} readings at "
        f"{_where(found)} multiply those for the true one by {_times(found.gain)} on average; expected "
        f"are {_odds(found.after)}, 1:20 or better has a chance of {chance(found.chance)}. There the two are "
        f"{found.expected.apart:.1f} sigma of one reading of {found.expected.channel} apart."
    )


def _where(found: NextPoint) -> str:
    first, *others = (point_words(found, place) for place in found.places)
    more = f" and {len(others)} point{'s' if len(others) > 1 else ''} more" if others else ""
    return f"{first}{more}{f', with {found.meter_words},' if found.meter else ''}"


def _times(nats: float) -> str:
    return f"{exp(nats):.2g}" if nats < log(MOST_ODDS) else f"more than {MOST_ODDS}"


def _odds(nats: float) -> str:
    return odds_text(1.0, exp(-nats))
