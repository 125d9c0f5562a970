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
from diagnosis.explain.starts import Expansion, Trials, lent_slopes, nearest_start, start
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds
from system.estimation.fit import maximum_posterior
from system.estimation.parameters import Parameter
from system.estimation.posterior import Posterior, settled, values_at
from system.work.processes import ProcessPool
from system.work.progress import Report

PAIR = 2
"""Number of refits side by side for any number of processes, so that the answer does not depend on it."""


def refit(
    study: Study, hypothesis: Hypothesis, thresholds: Thresholds, hopeless: float = inf, part: Explanation | None = None
) -> Explanation:
    """The hypothesis at the peak of its posterior; of a grid the best member, its evidence averaged over all.

    A fault has no typical multiple of the tolerance: if a widened parameter goes farther than `reach`, its prior is a
    mixture, with a tenth of its mass ten times as wide (a size as likely in each decade). Where the fit starts at the
    largest trial size and its peak lies beyond `reach`, only that tenth counts. hopeless: an objective above which a
    fit stops early. part: a refitted explanation by some of the effects, from whose peak the fit starts. Raises
    NotConverged if no member converges.
    """
    limits = thresholds.fit
    near = _begun(study, replace(hypothesis, reach=1.0), thresholds, part)
    far: Explanation | None = None
    if near.strain(study, thresholds) >= limits.start_sizes[-1] or _is_far(part):
        far = _far(study, hypothesis, thresholds, hopeless, part)
        if far is not None and limits.farther * _strain(far) > limits.reach:
            return replace(far, log_evidence=far.log_evidence - log(limits.farther))
    found = _refitted(study, near, thresholds, hopeless)
    if _strain(found) <= limits.reach:
        return found
    far = far or _far(study, hypothesis, thresholds, hopeless, part)
    if far is None:
        return found
    shares = found.log_evidence + log(1.0 - 1.0 / limits.farther), far.log_evidence - log(limits.farther)
    return replace(max((found, far), key=lambda each: each.log_evidence), log_evidence=float(np.logaddexp(*shares)))


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
        held = maximum_posterior(simulator, study.observations, start, thresholds.fit_limits(study.scant))
    except NotConverged:
        return fit
    return _of_free(held, np.abs(held.xi) < thresholds.fit.at_bound * pull)


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


def _far(
    study: Study, hypothesis: Hypothesis, thresholds: Thresholds, hopeless: float, part: Explanation | None
) -> Explanation | None:
    """The refit by the wider part of the prior, None where it does not converge."""
    far = replace(hypothesis, reach=thresholds.fit.farther)
    try:
        return _refitted(study, _begun(study, far, thresholds, part), thresholds, hopeless)
    except NotConverged:
        return None


def _is_far(part: Explanation | None) -> bool:
    return part is not None and part.hypothesis.reach > 1.0


def _strain(explanation: Explanation) -> float:
    """The largest |xi| of the widened parameters of a refit."""
    posterior = explanation.posterior
    return 0.0 if posterior is None else _largest(posterior.parameters, posterior.xi, explanation.hypothesis.widened)


def _largest(parameters: Sequence[Parameter], xi: Array, names: Sequence[str]) -> float:
    return max((abs(float(own)) for one, own in zip(parameters, xi, strict=True) if one.name in names), default=0.0)


def _refitted(study: Study, begun: _Begun, thresholds: Thresholds, hopeless: float) -> Explanation:
    """The hypothesis with one width of prior.

    Members of a grid that are not refitted count as 0, so that their average is never too high. The fit of a member
    that is hopelessly behind a fitted one stops early.
    """
    limits = replace(thresholds.fit_limits(study.scant), hopeless=hopeless)
    if _gross(begun.about, thresholds):
        limits = replace(limits, patience=thresholds.fit.gross_patience)
    failed = list(begun.failed)
    found: list[tuple[Hypothesis, Posterior]] = []
    for member, begin in begun.members[: thresholds.fit.grid_members]:
        simulator = simulator_of(study, member, thresholds)
        try:
            begin = nearest_start(study, simulator, begun.about, begin, thresholds.fit.way)
            lent = lent_slopes(simulator, begun.about, begun.fresh, begin)
            found.append((member, maximum_posterior(simulator, study.observations, begin, limits, lent)))
            behind = found[-1][1].objective + 2.0 * thresholds.fit.hopeless
            limits = replace(limits, hopeless=min(limits.hopeless, behind))
        except NotConverged as reason:
            failed.append(reason)
    if not found:
        raise failed[0]
    best, posterior = max(found, key=lambda each: each[1].log_evidence)
    evidence = float(logsumexp([each.log_evidence for _, each in found])) - log(len(begun.hypothesis.members))
    return Explanation(best, evidence, False, posterior, _size_over_sigma(posterior, best), 0.0, None)


def _trials(thresholds: Thresholds, sizes: tuple[float, ...]) -> Trials:
    return Trials(sizes, thresholds.fit.beside, thresholds.fit.reach)


def _about(study: Study, hypothesis: Hypothesis, part: Explanation | None) -> tuple[Expansion, tuple[str, ...]]:
    """Linear model about which a fit starts, at the peak of a part or that of the study, and the names new to it."""
    if part is None or part.posterior is None or not set(part.hypothesis.open_names) < set(hypothesis.open_names):
        return _whole(study), hypothesis.open_names
    known = part.hypothesis.open_names
    own = Expansion(part.posterior, part.posterior.xi)
    return own, tuple(name for name in hypothesis.open_names if name not in known)


def _whole(study: Study) -> Expansion:
    return Expansion(study.base, study.place)


def _gross(about: Expansion, thresholds: Thresholds) -> bool:
    return about.posterior.objective > thresholds.fit.gross * about.posterior.residual.size


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

    The first, which should be the likeliest, is refitted before the others and gives the limit of hopeless fits. part:
    a refitted explanation, from whose peak those start that it is a part of. It gives that limit too, so that the first
    PAIR are refitted at once.
    """
    found: dict[int, tuple[Explanation, str | None]] = {}
    numbered = list(enumerate(listed))
    first = 1 if part is None else PAIR
    for wave in (numbered[:first], numbered[first:]):
        task = partial(_numbered, study, thresholds, hopeless, part)
        if wave:
            names = ", ".join(each.hypothesis.text for _, each in wave[: executor.workers])
            report(len(found), len(listed), f"fitting {names}")
        for number, done in executor.do(task, wave):
            found[number] = done
            report(len(found), len(listed), f"fitted {done[0].hypothesis.text}")
        hopeless = min([hopeless, *(hopeless_beside(each, thresholds) for each, _ in found.values())])
    ordered = [found[number] for number in range(len(listed))]
    return tuple(each for each, _ in ordered), tuple(reason for _, reason in ordered if reason is not None)


def hopeless_beside(best: Explanation, thresholds: Thresholds) -> float:
    """Objective of a fit that is hopelessly behind a refitted explanation."""
    return inf if best.posterior is None else best.posterior.objective + 2.0 * thresholds.fit.hopeless


def _numbered(
    study: Study, thresholds: Thresholds, hopeless: float, part: Explanation | None, task: tuple[int, Explanation]
) -> tuple[int, tuple[Explanation, str | None]]:
    """One refit with its place in the list."""
    number, linear = task
    return number, try_refit(study, linear, thresholds, hopeless, part)


@dataclass(frozen=True)
class _Begun:
    """A hypothesis before its fits: the linear model that they start from and the names new to it.

    members: of its grid, each with the xi where its fit starts, the most promising first; failed: those without.
    """

    hypothesis: Hypothesis
    about: Expansion
    fresh: tuple[str, ...]
    members: tuple[tuple[Hypothesis, Array], ...]
    failed: tuple[NotConverged, ...]

    def strain(self, study: Study, thresholds: Thresholds) -> float:
        """The largest |xi| of the widened parameters at the first start, 0 without any."""
        if not self.members or not self.hypothesis.widened:
            return 0.0
        member, begin = self.members[0]
        return _largest(simulator_of(study, member, thresholds).parameters, begin, self.hypothesis.widened)


def _begun(study: Study, hypothesis: Hypothesis, thresholds: Thresholds, part: Explanation | None) -> _Begun:
    """Starts of the fits of a hypothesis.

    Only the likeliest members in the linear model are tried; for a gross mismatch, where slopes are unreliable, all.
    """
    about, fresh = _about(study, hypothesis, part)
    members = hypothesis.members if _gross(about, thresholds) else _likeliest(study, hypothesis, about, thresholds)
    begun: list[tuple[float, Hypothesis, Array]] = []
    failed: list[NotConverged] = []
    for member in members:
        simulator = simulator_of(study, member, thresholds)
        try:
            promised, begin = start(study, simulator, about, fresh, _trials(thresholds, thresholds.fit.start_sizes))
            begun.append((promised, member, begin))
        except NotConverged as reason:
            failed.append(reason)
    begun.sort(key=lambda each: each[0])
    starts = tuple((member, begin) for _, member, begin in begun)
    return _Begun(hypothesis, about, fresh, starts, tuple(failed))


def _likeliest(study: Study, hypothesis: Hypothesis, about: Expansion, thresholds: Thresholds) -> Sequence[Hypothesis]:
    """The members of a grid to refit, by the linear model that the fits start from."""
    members, widths = hypothesis.members, thresholds.name.mixture_widths
    if len(members) <= thresholds.fit.grid_members:
        return members
    known = set(hypothesis.open_names) & {each.name for each in about.posterior.parameters}
    posterior = settled(about.posterior)

    def evidence(member: Hypothesis) -> float:
        fresh = [each for each in candidates_of(study, member) if each.parameter not in known]
        return joint_evidence(posterior, fresh, widths).evidence

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
    trials = _trials(thresholds, thresholds.fit.look_sizes)
    promised, xi = start(study, simulator, _whole(study), hypothesis.open_names, trials)
    predicted = simulator.predict(values_at(simulator.parameters, xi))
    left = study.base.whitening.whiten(study.observations.values - predicted)
    return FirstLook(promised, float(left @ left + xi @ xi))


def _size_over_sigma(posterior: Posterior, hypothesis: Hypothesis) -> float:
    """The largest xi over its sigma among the free parameters of a hypothesis."""
    places = [posterior.index(name) for name in hypothesis.open_names]
    sizes = [float(posterior.xi[at] / np.sqrt(posterior.covariance[at, at])) for at in places]
    return max(sizes, key=abs, default=0.0)
