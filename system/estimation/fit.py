"""The peak of the posterior, by damped Gauss-Newton steps. Slopes propose a step, a prediction accepts or rejects it.

Approximate slopes still lead to the peak of the true objective (`trial.py`). They are computed again at the peak, and
where a step achieves little of its predicted reduction.
"""

from collections.abc import Sequence
from dataclasses import replace
from time import process_time

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds, Quadratic, bounded_step
from system.estimation.observations import Observations
from system.estimation.posterior import FitEffort, Posterior, bounded_laplace, log_mass, values_at
from system.estimation.simulator import Simulator
from system.estimation.trial import (
    FIRST_DAMPING,
    LIMITS,
    MOST_DAMPING,
    NEAR,
    Fit,
    FitLimits,
    Iterate,
    Walk,
    are_right,
    excess,
    tried,
)
from system.estimation.whitening import Whitening

SOON = 4  # trials
MET, MUCH = 0.1, 10.0
SAME_NOISE = 1e-2  # relative change of the whitening below which it is not renewed


def maximum_posterior(
    simulator: Simulator,
    observations: Observations,
    start: Array | None = None,
    limits: FitLimits = LIMITS,
    lent: Array | None = None,
) -> Posterior:
    """The peak of the posterior within the parameters' bounds, from the standard numbers `start` (k,) or 0.

    lent: d prediction / d xi (N, C, k) for the first steps in place of the start's own, from a similar point; the
    slopes at the peak are always computed there.

    Objective J = r.r + xi.xi of the whitened residual r. The noise of inputs is updated at the peak, and the peak
    found again, as often as `limits` state. Evidence by `laplace`, with the mass within the bounds counted one
    parameter at a time. Raises NotConverged where steps run out before a peak, and the simulator's own exception
    at the start.
    """
    begun = process_time()
    fit = Fit(simulator, observations, limits)
    xi = fit.bounds.within(np.zeros(len(simulator.parameters)) if start is None else start)
    whitening = fit.whitening(xi)
    place, slopes = _descend(fit, fit.first(fit.place(xi, whitening), whitening, lent), whitening)
    for _ in range(limits.whitening_rounds - 1):
        renewed = fit.whitening(place.xi)
        if place.objective > limits.hopeless or renewed.change(whitening) < SAME_NOISE:
            break
        whitening = renewed
        place, slopes = _descend(
            fit, fit.walk(fit.iterate(place.xi, place.predictions, whitening), whitening), whitening
        )
    effort = FitEffort(fit.predictions, fit.slope_maps, process_time() - begun)
    return _posterior(fit, place, slopes, whitening, effort)


def is_peak(posterior: Posterior, limits: FitLimits = LIMITS) -> bool:
    """True unless the slopes of a fit predict a decrease with which it would not count as a peak: it was given up."""
    model = Quadratic.of(posterior.xi, posterior.residual, posterior.slopes)
    step = bounded_step(model, Bounds.of(posterior.parameters).about(posterior.xi), 0.0, np.inf)
    return model.fall(step) < _stall(posterior, limits)


def _stall(place: Iterate | Posterior, limits: FitLimits) -> float:
    """The predicted decrease below which a place that no step improves is a peak."""
    gross = place.objective > limits.gross * place.residual.size
    return max(limits.stall * excess(place), limits.coarse * place.objective if gross else 0.0)


def best_posterior(
    simulator: Simulator, observations: Observations, starts: Sequence[Array], limits: FitLimits = LIMITS
) -> Posterior:
    """The peak of greatest evidence among those found from several starts; its effort is the sum of theirs.

    For parameters without effect below a threshold, or with several peaks. Raises NotConverged where no start leads to
    a peak.
    """
    found: list[Posterior] = []
    failed: list[NotConverged] = []
    for start in starts:
        try:
            found.append(maximum_posterior(simulator, observations, start, limits))
        except NotConverged as reason:
            failed.append(reason)
    if not found:
        raise NotConverged(f"none of {len(starts)} starts leads to a peak; the last: {failed[-1]}")
    best = max(found, key=lambda posterior: posterior.log_evidence)
    return replace(
        best,
        effort=FitEffort(
            sum(each.effort.predictions for each in found),
            sum(each.effort.slopes for each in found),
            sum(each.effort.seconds for each in found),
        ),
    )


def _descend(fit: Fit, walk: Walk, whitening: Whitening) -> tuple[Iterate, Array]:
    """Go down to a peak. Return it with slopes computed no farther than NEAR from it.

    Where the simulator's slopes, which may be approximate, end before a peak, slopes by predictions continue; not where
    they are right and the valley is curved.
    """
    walk, given_up = _ended(fit, walk, whitening)
    is_short = not given_up and fit.promised(walk) >= _stall(walk.place, fit.limits)
    if is_short and not fit.exact and not are_right(fit, walk, whitening):
        fit.exact = True
        walk, given_up = _ended(fit, replace(fit.renewed(walk, whitening), damping=FIRST_DAMPING), whitening)
    if given_up:
        return walk.place, walk.slopes
    promised, limit = fit.promised(walk), _stall(walk.place, fit.limits)
    if promised >= limit:
        raise NotConverged(
            f"the fit of {walk.place.xi.size} parameters stopped at an objective of {walk.place.objective:.1f}, "
            f"a fall of {promised:.2g} still promised (limit {limit:.2g}), after {fit.predictions} "
            f"predictions. Try another start, or more steps than {fit.limits.steps}"
        )
    return walk.place, walk.slopes


def _ended(fit: Fit, walk: Walk, whitening: Whitening) -> tuple[Walk, bool]:
    """The end of `_steps`, with the simulator's slopes: failed trials at a kink reverse the corrected ones."""
    walk, given_up = _steps(fit, walk, whitening)
    return (walk if given_up else fit.walk(walk.place, whitening)), given_up


def _steps(fit: Fit, walk: Walk, whitening: Whitening) -> tuple[Walk, bool]:
    """Trials until the predicted and the achieved decrease are below tolerance; true for a hopeless peak or model.

    Beyond MOST_DAMPING no step by these slopes gains.
    """
    objectives: list[float] = []
    accepted: list[float] = []
    for step in range(fit.limits.steps):
        promised = fit.promised(walk)
        objectives.append(walk.place.objective)
        accepted += [walk.place.objective] if walk.failed == 0 else []
        if _is_hopeless(step, walk.place.objective, promised, fit.limits):
            return walk, True
        if fit.is_level(objectives):
            return walk, True
        least = _stall(walk.place, fit.limits) if fit.exact else fit.limits.change * excess(walk.place)
        is_stuck = fit.is_stuck(accepted, walk.place)
        if promised < least or walk.damping > MOST_DAMPING or is_stuck:
            if walk.moved <= NEAR:
                return walk, False
            walk = fit.walk(walk.place, whitening)
        else:
            walk = tried(fit, walk, whitening)
    return walk, False


def _is_hopeless(trials: int, objective: float, promised: float, limits: FitLimits) -> bool:
    """True where the peak that the slopes predict lies above `hopeless`, after trials from which that counts.

    Any prediction counts after `patience` trials; after SOON trials one that is met except for the share MET of the
    decrease to `hopeless`, so that the slopes are right, and one that is MUCH times as high: new slopes change it by
    less.
    """
    peak = objective - promised
    if peak <= limits.hopeless:
        return False
    is_met = promised <= MET * (objective - limits.hopeless)
    return trials >= (min(SOON, limits.patience) if is_met or peak > MUCH * limits.hopeless else limits.patience)


def _posterior(fit: Fit, place: Iterate, slopes: Array, whitening: Whitening, effort: FitEffort) -> Posterior:
    """The posterior at a peak, with the evidence of the part of its bell that lies within the bounds.

    A fit that was given up is no peak: where even the predicted peak is hopeless it has the evidence of that, else that
    of a bell about its place.
    """
    model = Quadratic.of(place.xi, place.residual, slopes)
    zero, one, bounds = np.zeros_like(place.xi), np.ones_like(place.xi), fit.bounds
    promised = model.fall(bounded_step(model, bounds.about(place.xi), 0.0, np.inf))
    is_hopeless = place.objective - promised > fit.limits.hopeless
    ended = promised < _stall(place, fit.limits) and not is_hopeless
    objective, gradient = place.objective - (promised if is_hopeless else 0.0), model.gradient if ended else zero
    below, above = bounds.lowest - place.xi, bounds.highest - place.xi
    evidence = bounded_laplace(objective, gradient, model.precision, below, above) + whitening.log_determinant
    evidence -= float(log_mass(zero, one, bounds.lowest, bounds.highest).sum())
    parameters = fit.simulator.parameters
    return Posterior(
        parameters=parameters,
        xi=place.xi,
        values=values_at(parameters, place.xi),
        residual=place.residual,
        slopes=slopes,
        precision=model.precision,
        objective=place.objective,
        log_evidence=evidence,
        predictions=place.predictions,
        whitening=whitening,
        effort=effort,
    )
