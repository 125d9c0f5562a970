"""Refit of hypotheses: the coupled simulator, all nuisances, and the free parameters of the hypothesis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import inf, log

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from diagnosis.explain.hypotheses import Hypothesis, candidates_of, simulator_of
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.screen import joint_evidence
from diagnosis.explain.starts import Expansion, lent_slopes, nearest_start, start
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds
from system.estimation.fit import FitLimits, maximum_posterior
from system.estimation.posterior import Posterior, values_at
from system.work.processes import ProcessPool
from system.work.progress import Report

SIZES = (0.1, 0.3, 1.0, 2.0)  # trial sizes of a start, in spreads
ROUGHLY = (0.3, 1.0)  # trial sizes of a first look
AT_BOUND = 0.999  # of a bound: a fit ends so near to it
LIMITS = FitLimits(change=0.1)  # of the objective: a twentieth of a nat decides nothing, and costs sixfold less


def refit(
    study: Study, hypothesis: Hypothesis, thresholds: Thresholds, hopeless: float = inf, part: Explanation | None = None
) -> Explanation:
    """The hypothesis at the peak of its posterior; of a grid the best member, its evidence averaged over all.

    A fault has no typical multiple of the tolerance: if a widened parameter goes farther than `reach`, its prior
    is a mixture, with a tenth of its mass ten times as wide (a size as likely in each decade). hopeless: an
    objective above which a fit stops early. part: a refitted explanation by some of the effects, from whose peak
    the fit starts. Raises NotConverged if no member converges.
    """
    near = _refitted(study, replace(hypothesis, reach=1.0), thresholds, hopeless, part)
    limits = thresholds.fit
    if not _strained(near, limits.reach):
        return near
    try:
        far = _refitted(study, replace(hypothesis, reach=limits.farther), thresholds, hopeless, part)
    except NotConverged:
        return near
    shares = near.log_evidence + log(1.0 - 1.0 / limits.farther), far.log_evidence - log(limits.farther)
    return replace(max((near, far), key=lambda each: each.log_evidence), log_evidence=float(np.logaddexp(*shares)))


def within_tolerance(study: Study, null: Explanation, thresholds: Thresholds) -> Posterior:
    """The null's fit with every parameter within `pull` of its stated tolerance, those at this bound fixed there.

    Its own fit where all are, and where the other does not converge. A null that needs a value beyond `pull` is the
    explanation that this value is wrong. Raises ValueError for a null without a fit.
    """
    fit, pull = null.posterior, thresholds.mismatch.pull
    if fit is None:
        raise ValueError("the null has no fit")
    if np.abs(fit.xi).max(initial=0.0) <= pull:
        return fit
    simulator = simulator_of(study, null.hypothesis, thresholds)
    simulator = simulator.with_parameters(tuple(each.held(pull) for each in simulator.parameters))
    start = Bounds.of(simulator.parameters).within(fit.xi)
    try:
        held = maximum_posterior(simulator, study.observations, start, LIMITS)
    except NotConverged:
        return fit
    return _of_free(held, np.abs(held.xi) < AT_BOUND * pull)


def _of_free(fit: Posterior, free: NDArray[np.bool_]) -> Posterior:
    """A fit with some of its parameters alone, the others known exactly."""
    return replace(
        fit,
        parameters=tuple(one for one, own in zip(fit.parameters, free, strict=True) if own),
        xi=fit.xi[free],
        values=fit.values[free],
        slopes=fit.slopes[:, free],
        precision=fit.precision[np.ix_(free, free)],
    )


def _strained(explanation: Explanation, reach: float) -> bool:
    """True if a widened parameter lies beyond `reach` of its wide prior."""
    posterior = explanation.posterior
    return posterior is not None and any(
        abs(posterior.xi[posterior.index(name)]) > reach for name in explanation.hypothesis.widened
    )


def _refitted(
    study: Study, hypothesis: Hypothesis, thresholds: Thresholds, hopeless: float, part: Explanation | None
) -> Explanation:
    """The same with one width of prior.

    Members of a grid that are not refitted count as 0, so that their average is never too high. A member that stays
    hopelessly behind one that is fitted already stops early.
    """
    limits = replace(LIMITS, hopeless=inf if _gross(study, thresholds) else hopeless)
    about, fresh = _about(study, hypothesis, part)
    begun, failed = _begun(study, hypothesis, thresholds, about, fresh)
    found: list[tuple[Hypothesis, Posterior]] = []
    for member, begin in begun[: thresholds.fit.grid_members]:
        simulator = simulator_of(study, member, thresholds)
        try:
            begin = nearest_start(study, simulator, about, begin)
            lent = lent_slopes(simulator, about, fresh, begin)
            found.append((member, maximum_posterior(simulator, study.observations, begin, limits, lent)))
            behind = found[-1][1].objective + 2.0 * thresholds.fit.hopeless
            limits = replace(limits, hopeless=min(limits.hopeless, behind))
        except NotConverged as reason:
            failed.append(reason)
    if not found:
        raise failed[0]
    best, posterior = max(found, key=lambda each: each[1].log_evidence)
    evidence = float(logsumexp([each.log_evidence for _, each in found])) - log(len(hypothesis.members))
    return Explanation(best, evidence, False, posterior, _size_over_sigma(posterior, best), 0.0, None)


def _about(study: Study, hypothesis: Hypothesis, part: Explanation | None) -> tuple[Expansion, tuple[str, ...]]:
    """Linear model about which a fit starts, at the peak of a part or at the prior mean, and the names new to it."""
    if part is None or part.posterior is None or not set(part.hypothesis.open_names) < set(hypothesis.open_names):
        return _prior_mean(study), hypothesis.open_names
    known = part.hypothesis.open_names
    own = Expansion(part.posterior, part.posterior.xi)
    return own, tuple(name for name in hypothesis.open_names if name not in known)


def _prior_mean(study: Study) -> Expansion:
    return Expansion(study.base, np.zeros_like(study.base.xi))


def _gross(study: Study, thresholds: Thresholds) -> bool:
    return study.base.objective > thresholds.fit.gross * study.base.residual.size


def try_refit(
    study: Study, linear: Explanation, thresholds: Thresholds, hopeless: float = inf, part: Explanation | None = None
) -> tuple[Explanation, str | None]:
    """The refitted hypothesis; if that fails, its linear form and the reason as text."""
    try:
        return replace(refit(study, linear.hypothesis, thresholds, hopeless, part), heldout=linear.heldout), None
    except NotConverged as reason:
        return linear, f"{linear.hypothesis.text} could not be refitted: {reason}"


def refit_all(
    study: Study,
    listed: Sequence[Explanation],
    thresholds: Thresholds,
    executor: ProcessPool,
    report: Report,
    hopeless: float = inf,
    part: Explanation | None = None,
) -> tuple[tuple[Explanation, ...], tuple[str, ...]]:
    """The refits of some hypotheses in their order, by a crew, and the failures as text.

    part: a refitted explanation; hypotheses that it is a part of start from its peak.
    """
    if not listed:
        return (), ()
    task = partial(_numbered, study, thresholds, hopeless, part)
    found: dict[int, tuple[Explanation, str | None]] = {}
    report(0, len(listed), f"fitting {', '.join(each.hypothesis.text for each in listed[: executor.workers])}")
    for number, done in executor.do(task, list(enumerate(listed))):
        found[number] = done
        report(len(found), len(listed), f"fitted {done[0].hypothesis.text}")
    ordered = [found[number] for number in range(len(listed))]
    return tuple(each for each, _ in ordered), tuple(reason for _, reason in ordered if reason is not None)


def _numbered(
    study: Study, thresholds: Thresholds, hopeless: float, part: Explanation | None, task: tuple[int, Explanation]
) -> tuple[int, tuple[Explanation, str | None]]:
    """One refit with its place in the list."""
    number, linear = task
    return number, try_refit(study, linear, thresholds, hopeless, part)


def _begun(
    study: Study, hypothesis: Hypothesis, thresholds: Thresholds, about: Expansion, fresh: tuple[str, ...]
) -> tuple[list[tuple[Hypothesis, Array]], list[NotConverged]]:
    """Members of a grid with the xi where their fits start, the most promising first, and those without a start.

    Only the likeliest in the linear model are tried; of a gross mismatch, where slopes say little, all.
    """
    members = hypothesis.members if _gross(study, thresholds) else _likeliest(study, hypothesis, thresholds)
    begun: list[tuple[float, Hypothesis, Array]] = []
    failed: list[NotConverged] = []
    for member in members:
        simulator = simulator_of(study, member, thresholds)
        try:
            promised, begin = start(study, simulator, about, fresh, SIZES, thresholds.fit.reach)
            begun.append((promised, member, begin))
        except NotConverged as reason:
            failed.append(reason)
    begun.sort(key=lambda each: each[0])
    return [(member, begin) for _, member, begin in begun], failed


def _likeliest(study: Study, hypothesis: Hypothesis, thresholds: Thresholds) -> Sequence[Hypothesis]:
    """The members of a grid to refit, by the linear model."""
    members, widths = hypothesis.members, thresholds.name.mixture_widths
    if len(members) <= thresholds.fit.grid_members:
        return members

    def evidence(member: Hypothesis) -> float:
        return joint_evidence(study.base, candidates_of(study, member), widths).evidence

    return sorted(members, key=evidence, reverse=True)[: thresholds.fit.grid_members]


@dataclass(frozen=True)
class FirstLook:
    """First estimate of a hypothesis: least objective by the linear model, and of one full prediction."""

    promised: float
    reached: float


def first_look(study: Study, hypothesis: Hypothesis, thresholds: Thresholds) -> FirstLook:
    """Objective for a few sizes of the free parameters of a hypothesis, with linear nuisances: no fit.

    For parameters whose slope is no measure of a large change.
    """
    simulator = simulator_of(study, hypothesis, thresholds)
    promised, xi = start(study, simulator, _prior_mean(study), hypothesis.open_names, ROUGHLY, thresholds.fit.reach)
    predicted = simulator.predict(values_at(simulator.parameters, xi))
    left = study.base.whitening.whiten(study.observations.values - predicted)
    return FirstLook(promised, float(left @ left + xi @ xi))


def _size_over_sigma(posterior: Posterior, hypothesis: Hypothesis) -> float:
    """The largest xi over its sigma among the free parameters of a hypothesis."""
    places = [posterior.index(name) for name in hypothesis.open_names]
    sizes = [float(posterior.xi[at] / np.sqrt(posterior.covariance[at, at])) for at in places]
    return max(sizes, key=abs, default=0.0)
