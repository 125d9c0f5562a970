"""Residue of the best explanation: parts of the mismatch that it does not explain."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from scipy.stats import norm

from diagnosis.detect.contrasts import contrasts
from diagnosis.detect.mismatch import most_striking
from diagnosis.detect.regions import flagged
from diagnosis.explain.explained import explained_mismatch
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.explain.ranked import Explanation
from diagnosis.study.map_axes import axis_values
from diagnosis.study.model import Study
from diagnosis.study.multipliers import multiplier_columns
from diagnosis.study.noise_correlation import MEDIAN
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Remainder
from diagnosis.verdict.suspects import remaining
from diagnosis.verdict.trend import power_errors
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import multiplier_evidence
from system.estimation.parameters import Role
from system.estimation.posterior import Posterior, settled
from system.inputs.channels import ChannelName

BROADER = 5.44  # n times the variance of a squared scale from the median (Rousseeuw and Croux 1993)
LEAKAGE_AND_FRICTION = (
    Component.PISTON_LEAKAGE,
    Component.SLIPPER_LEAKAGE,
    Component.PLATE_LEAKAGE,
    Component.PISTON_FRICTION,
    Component.SLIPPER_FRICTION,
    Component.SOCKET_FRICTION,
    Component.PLATE_FRICTION,
    Component.GUIDE_FRICTION,
    Component.BEARINGS,
)
"""Components whose laws may vary over the map by the allowance."""


def remainders(
    study: Study, null: Explanation, best: Explanation, along: Mapping[str, Array], thresholds: Thresholds
) -> tuple[Remainder, ...]:
    """Parts of the mismatch that the best explanation leaves; () if it is complete.

    A significant part of the map or candidate in the residual counts where chance hardly produces it and its square
    exceeds the share `material` of the explained part in its channel: a law of another form than the pump's leaves a
    small residual at any size. along: coordinates (N,) with which an effect may grow, by name.
    """
    after, before = best.posterior, null.posterior
    if after is None or before is None:
        return ()
    found = [Remainder(text) for text in (*_form_note(best.hypothesis), *_scatter(study, after, thresholds))]
    gained = max(before.objective - after.objective, 0.0)
    least = np.sqrt(thresholds.form.material * gained * _shares(study, best, thresholds))
    found += _regions(study, after, least, thresholds)
    found += _striking(study, after, best.hypothesis, least, thresholds)
    found += map(Remainder, remaining(study, best, thresholds))
    found += [Remainder(growth.text) for growth in power_errors(study, best, along, thresholds)[:1]]
    if _pulls(after, best.hypothesis) - _pulls(before, best.hypothesis) > 2.0 * thresholds.name.odds:
        found.append(Remainder("parameters move farther from their stated values than without it"))
    if _allowed_gain(study, before, after, thresholds) < thresholds.name.odds:
        found.append(Remainder(f"errors of form of {thresholds.name.allowance:.1%} would explain as much"))
    return tuple(found)


def _form_note(hypothesis: Hypothesis) -> Iterator[str]:
    if not hypothesis.other_form:
        return
    beside = " and ".join(each.value for each in hypothesis.stand_ins)
    second = (
        f"; {beside} beside it would do so too, but explains no more than an error of its form may leave"
        if beside
        else ""
    )
    yield f"its law explains more if it varies freely over the map{second}"


def _scatter(study: Study, after: Posterior, thresholds: Thresholds) -> Iterator[str]:
    """A note for each channel whose median residual exceeds the noise: tails and steps of the noise are no mismatch.

    The numbers of all traces are one channel. Chance of a false note in any channel: Holm (1979), first step.
    """
    names, column = study.shown_channels, after.whitening.rows[:, 1]
    for at, name in enumerate(names):
        own = after.residual[column >= at if name is ChannelName.P_CHAMBER else column == at]
        if not own.size:
            continue
        broad = float(np.median(np.abs(own)) / MEDIAN) ** 2
        if norm.sf((broad - 1.0) / np.sqrt(BROADER / own.size)) < thresholds.mismatch.chance / len(names):
            yield f"the residual of {name.value} scatters {np.sqrt(broad):.2f} times as wide as the noise"


def _shares(study: Study, best: Explanation, thresholds: Thresholds) -> Array:
    """Share of each shown channel in the square of the explanation's addition, in sigma; 0 where it is unknown."""
    try:
        added = explained_mismatch(study, best, thresholds).added / study.base.whitening.sigma
    except NotConverged:
        return np.zeros(len(study.shown_channels))
    squares = np.where(study.observations.measured, added**2, 0.0).sum(axis=0)
    squares = study.by_shown(squares)
    return np.asarray(squares / squares.sum()) if squares.any() else np.zeros_like(squares)


def _regions(study: Study, after: Posterior, least: Array, thresholds: Thresholds) -> Iterator[Remainder]:
    """The first two significant parts of the map in the residual."""
    by_channel = {name: contrasts(after, at) for at, name in enumerate(study.channels)}
    flags = flagged(by_channel, axis_values(study.recording), thresholds)
    for flag in flags[:2]:
        if abs(flag.contrast) > least[study.channels.index(flag.channel)]:
            yield Remainder(f"{flag.channel.value} stays {flag.contrast:+.1f} sigma off at {flag.text}", region=flag)


def _striking(
    study: Study, after: Posterior, hypothesis: Hypothesis, least: Array, thresholds: Thresholds
) -> Iterator[Remainder]:
    """The significant candidate in the residual."""
    others = [each for each in study.candidates if each.entry.id not in hypothesis.effects]
    chance, strongest = most_striking(settled(after), others, thresholds)
    if chance >= thresholds.mismatch.chance:
        return
    candidate, found = strongest[0]
    squares = np.zeros(len(study.observations.channels))
    np.add.at(squares, after.whitening.rows[:, 1], candidate.column**2)
    channel = study.by_shown(squares).argmax()
    if abs(found.z) > least[channel]:
        text = f"{candidate.entry.id.value} stands out of the residual by {abs(found.z):.1f} sigma"
        yield Remainder(text, effect=candidate.entry.id, score=abs(found.z))


def _pulls(posterior: Posterior, hypothesis: Hypothesis) -> float:
    """Sum of xi^2 over the parameters of the null that are not free in the hypothesis."""
    kept = np.array(
        [each.role is not Role.EXTENSION and each.name not in hypothesis.widened for each in posterior.parameters]
    )
    return float((posterior.xi[kept] ** 2).sum())


def _allowed_gain(study: Study, before: Posterior, after: Posterior, thresholds: Thresholds) -> float:
    """ln evidence over the null if each leakage and friction law may vary over the map by the allowance."""
    free = [component for component in LEAKAGE_AND_FRICTION if component in study.components]

    def evidence(posterior: Posterior) -> float:
        if not free:
            return posterior.log_evidence
        columns = np.hstack([multiplier_columns(study, posterior, component) for component in free])
        return posterior.log_evidence + multiplier_evidence(settled(posterior), columns, (thresholds.name.allowance,))

    return evidence(after) - evidence(before)
