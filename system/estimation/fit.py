"""The peak of the posterior, by damped Gauss-Newton steps. Slopes propose a step, a prediction decides it.

Levenberg (1944) and Marquardt (1963), with bounds. Each step corrects the slopes (Broyden 1965), so that approximate
slopes still lead to the peak of the true objective. They are computed again at the peak, and where a step achieves
little of its predicted reduction. A step that leaves the floor of a curved valley is curved back to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf
from time import process_time

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds, Quadratic, bounded_step
from system.estimation.observations import Observations
from system.estimation.posterior import FitEffort, Posterior, bounded_laplace, log_mass, standard_slopes, values_at
from system.estimation.simulator import Simulator
from system.estimation.whitening import Whitening, whitener

HARDER, EASIER = 4.0, 1.0 / 3.0  # the damping after a trial that failed, that kept its promise
LEAST_DAMPING, FIRST_DAMPING, MOST_DAMPING = 1e-6, 1e-2, 1e6
LOCAL = 1e2  # damping from which a failed trial shows wrong slopes here, not the curve on the way
SHORT = 1e-3  # in xi: over shorter steps the solvers' own error exceeds the change of the readings
GOOD = 0.5  # share of the promised fall: below it the slopes are asked for anew
TRUE, LONGER = 0.75, 2.0  # share of the promised fall from which the next step may be so many times as long
STEP = 0.05  # in xi, of slopes by predictions: over shorter ones steps that the solver takes otherwise would count
NEAR = 0.02  # in xi: slopes taken no farther away are valid for a peak and its covariance
SAME_NOISE = 1e-2  # relative change of the whitening below which it is not renewed


@dataclass(frozen=True)
class FitLimits:
    """End of a fit: steps at most, change of the objective, largest first step in xi, rounds of whitening.

    stall: predicted fall of the objective below which a point that no step improves counts as a peak; like the
    change it is in units of the objective per reading where that is above one. Half a nat suits smooth models;
    models with kinks predict more than they achieve. hopeless: an objective above which a fit is of no use. After
    `patience` trials a fit whose predicted objective is not lower ends, with the evidence of the predicted peak.
    gross: objective per reading of a model that is wrong; its fit ends where `level` trials gain less than the share
    `coarse` of the objective. stuck: trials after which a fit that gained less than `change` goes no farther by its
    slopes.
    """

    steps: int = 100
    change: float = 1e-2
    largest_step: float = 2.0
    whitening_rounds: int = 2
    stall: float = 1.0
    hopeless: float = inf
    patience: int = 4
    gross: float = 3.0
    coarse: float = 1e-2
    level: int = 8
    stuck: int = 6


LIMITS = FitLimits()


@dataclass(frozen=True)
class _Iterate:
    """State of a fit: xi, predictions (N, C), whitened residual (n,), objective."""

    xi: Array
    predictions: Array
    residual: Array
    objective: float


@dataclass(frozen=True)
class _Walk:
    """A place, the slopes that lead on from it and the xi they were taken at, damping and most length of the next step.

    longest: in any xi, in units of the largest first step; it grows while steps of that length keep their promise.
    """

    place: _Iterate
    slopes: Array
    taken: Array
    damping: float
    longest: float = 1.0

    @property
    def moved(self) -> float:
        """Largest distance in any xi from the point where the slopes were computed."""
        return _apart(self.place.xi, self.taken)


class _Fit:
    """A fit in progress: the model, the readings, and the cost so far."""

    def __init__(self, simulator: Simulator, observations: Observations, limits: FitLimits) -> None:
        self.simulator, self.observations, self.limits = simulator, observations, limits
        self.bounds = Bounds.of(simulator.parameters)
        self.predictions = self.slope_maps = 0
        self.failed_at = -limits.level  # predictions when the simulator failed last
        self.taken, self.raw = np.full(len(simulator.parameters), np.inf), np.zeros(0)  # the last slopes, where
        self.exact = False  # slopes by predictions: those of the simulator may be approximate

    def place(self, xi: Array, whitening: Whitening) -> _Iterate:
        """Predict at xi. Raises NotConverged where the simulator does."""
        self.predictions += 1
        return self.iterate(xi, self.simulator.predict(values_at(self.simulator.parameters, xi)), whitening)

    def trial(self, xi: Array, whitening: Whitening) -> _Iterate | None:
        """Predict at the xi within the bounds; None where the simulator fails."""
        try:
            return self.place(self.bounds.within(xi), whitening)
        except NotConverged:
            self.failed_at = self.predictions
            return None

    def iterate(self, xi: Array, predictions: Array, whitening: Whitening) -> _Iterate:
        """A place with its residual by a whitening."""
        residual = whitening.whiten(self.observations.values - predictions)
        return _Iterate(xi, predictions, residual, float(residual @ residual + xi @ xi))

    def walk(self, place: _Iterate, whitening: Whitening) -> _Walk:
        """A walk from a place, with the last slopes where they were taken near it."""
        if not _apart(place.xi, self.taken) <= NEAR:
            self.slopes(place.xi)
        return _Walk(place, whitening.whiten(self.raw), self.taken, LEAST_DAMPING)

    def first(self, place: _Iterate, whitening: Whitening, lent: Array | None) -> _Walk:
        """The walk from the start, with slopes from elsewhere where they are lent."""
        if lent is None:
            return self.walk(place, whitening)
        return _Walk(place, whitening.whiten(lent), np.full_like(place.xi, np.inf), LEAST_DAMPING)

    def renewed(self, walk: _Walk, whitening: Whitening) -> _Walk:
        """The same place with slopes taken there."""
        self.slopes(walk.place.xi)
        return replace(walk, slopes=whitening.whiten(self.raw), taken=self.taken)

    def moved_slopes(self, slopes: Array, xi: Array, other: Array) -> Array:
        """Slopes (n, k) at xi as those at another xi, for readings linear along the curves of the bounds."""
        return slopes * np.exp(self.bounds.bend * (other - xi))

    def slopes(self, xi: Array) -> None:
        """Take d prediction / d xi at xi."""
        self.slope_maps += 1
        self.taken, self.raw = xi, self._by_predictions(xi) if self.exact else standard_slopes(self.simulator, xi)

    def _by_predictions(self, xi: Array) -> Array:
        """d prediction / d xi (N, C, k) by central differences of predictions, one-sided beside a bound."""
        columns = []
        for at in range(xi.size):
            below, above = xi.copy(), xi.copy()
            below[at] = max(xi[at] - STEP, self.bounds.lowest[at])
            above[at] = min(xi[at] + STEP, self.bounds.highest[at])
            ends = [self.simulator.predict(values_at(self.simulator.parameters, each)) for each in (below, above)]
            columns.append((ends[1] - ends[0]) / (above[at] - below[at]))
        self.predictions += 2 * xi.size
        return np.stack(columns, axis=-1)

    def whitening(self, xi: Array) -> Whitening:
        """The whitening with the input slopes at xi."""
        values = values_at(self.simulator.parameters, xi)
        return whitener(self.observations, self.simulator.input_slopes(values))

    def is_level(self, objectives: Sequence[float]) -> bool:
        """True for a model that is wrong and gains little: `level` trials brought a share `coarse` at most.

        Not where the simulator failed in these trials.
        """
        limits = self.limits
        if len(objectives) <= limits.level or objectives[-1] <= limits.gross * self.observations.measured.sum():
            return False
        if self.predictions - self.failed_at <= 2 * limits.level:
            return False
        return objectives[-1 - limits.level] < (1.0 + limits.coarse) * objectives[-1]

    def is_stuck(self, objectives: Sequence[float], place: _Iterate) -> bool:
        """True if the last `stuck` trials together brought less than a change that counts."""
        back = self.limits.stuck
        gained = objectives[-1 - back] - objectives[-1] if len(objectives) > back else inf
        return gained < self.limits.change * _excess(place)

    def promised(self, walk: _Walk) -> float:
        """By how much the objective would fall to the peak that the slopes promise."""
        model = Quadratic.of(walk.place.xi, walk.place.residual, walk.slopes)
        return model.fall(bounded_step(model, self.bounds.about(model.xi), 0.0, np.inf))


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
    fit = _Fit(simulator, observations, limits)
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
    """True unless the slopes of a fit promise a fall with which it would not count as a peak: it was given up."""
    model = Quadratic.of(posterior.xi, posterior.residual, posterior.slopes)
    step = bounded_step(model, Bounds.of(posterior.parameters).about(posterior.xi), 0.0, np.inf)
    return model.fall(step) < _stall(posterior, limits)


def _stall(place: _Iterate | Posterior, limits: FitLimits) -> float:
    """The fall promised with which a place that no step betters is a peak."""
    gross = place.objective > limits.gross * place.residual.size
    return max(limits.stall * _excess(place), limits.coarse * place.objective if gross else 0.0)


def _excess(place: _Iterate | Posterior) -> float:
    """The objective per reading where that is above one: what fits badly is not worth a fine fit."""
    return max(1.0, place.objective / place.residual.size)


def best_posterior(
    simulator: Simulator, observations: Observations, starts: Sequence[Array], limits: FitLimits = LIMITS
) -> Posterior:
    """The peak of greatest evidence among those found from several starts; its effort is theirs together.

    For parameters that do nothing below a threshold, or whose effect has several peaks. Raises NotConverged
    where no start leads to a peak.
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


def _descend(fit: _Fit, walk: _Walk, whitening: Whitening) -> tuple[_Iterate, Array]:
    """Go down to a peak. Return it with slopes taken no farther than NEAR from it.

    Where the simulator's slopes, which may be approximate, end short of a peak, slopes by predictions lead on.
    """
    walk, given_up = _steps(fit, walk, whitening)
    if walk.damping > MOST_DAMPING and not fit.exact and fit.promised(walk) >= _stall(walk.place, fit.limits):
        fit.exact = True
        walk, given_up = _steps(fit, replace(fit.renewed(walk, whitening), damping=FIRST_DAMPING), whitening)
    if given_up:
        return walk.place, walk.slopes
    promised, limit = fit.promised(walk), _stall(walk.place, fit.limits)
    if promised >= limit:
        raise NotConverged(
            f"the fit of {walk.place.xi.size} parameters stopped at an objective of {walk.place.objective:.1f}, "
            f"a fall of {promised:.2g} still promised (limit {limit:.2g}), after {fit.predictions} "
            f"predictions. Try another start, or more steps than {fit.limits.steps}"
        )
    walk = walk if walk.moved <= NEAR else fit.renewed(walk, whitening)
    return walk.place, walk.slopes


def _steps(fit: _Fit, walk: _Walk, whitening: Whitening) -> tuple[_Walk, bool]:
    """Trials until nothing more is promised or gained; true where the predicted peak is of no use, or the model.

    Beyond MOST_DAMPING no step by these slopes gains.
    """
    objectives: list[float] = []
    for step in range(fit.limits.steps):
        promised = fit.promised(walk)
        objectives.append(walk.place.objective)
        if step >= fit.limits.patience and walk.place.objective - promised > fit.limits.hopeless:
            return walk, True
        if fit.is_level(objectives):
            return walk, True
        least = _stall(walk.place, fit.limits) if fit.exact else fit.limits.change * _excess(walk.place)
        is_stuck = fit.is_stuck(objectives, walk.place)
        if promised < least or walk.damping > MOST_DAMPING or is_stuck:
            if walk.moved <= NEAR:
                return (replace(walk, damping=inf) if is_stuck else walk), False
            walk = fit.walk(walk.place, whitening)
        else:
            walk = _tried(fit, walk, whitening)
    return walk, False


def _tried(fit: _Fit, walk: _Walk, whitening: Whitening) -> _Walk:
    """One trial: the new point where the objective falls, with damping and slopes updated from the result."""
    place = walk.place
    model = Quadratic.of(place.xi, place.residual, walk.slopes)
    step = bounded_step(model, fit.bounds.about(place.xi), walk.damping, walk.longest * fit.limits.largest_step)
    promised = model.fall(step)
    trial = fit.trial(fit.bounds.reached(place.xi, step), whitening) if promised > 0 else None
    if trial is None:
        return replace(walk, damping=_damping(walk.damping, 0.0), longest=1.0)
    straight = kept = (place.objective - trial.objective) / promised
    if straight < GOOD:
        corrected = fit.trial(_corrected(fit, walk, trial), whitening)
        if corrected is not None and corrected.objective < trial.objective:
            trial, kept = corrected, (place.objective - corrected.objective) / promised
    slopes = walk.slopes
    went = fit.bounds.step_to(place.xi, trial.xi)
    if (kept > 0 or walk.damping > LOCAL) and np.abs(went).max() > SHORT:
        missed = place.residual - trial.residual - slopes @ went
        slopes = slopes + np.outer(missed, went) / (went @ went)
    slopes = fit.moved_slopes(slopes, place.xi, trial.xi) if kept > 0 else slopes
    longest = walk.longest * LONGER if straight >= TRUE else walk.longest if kept > GOOD else 1.0
    here = _Walk(trial if kept > 0 else place, slopes, walk.taken, _damping(walk.damping, kept), longest)
    return fit.renewed(here, whitening) if straight < GOOD and here.moved > SHORT else here


def _corrected(fit: _Fit, walk: _Walk, trial: _Iterate) -> Array:
    """The xi of a trial corrected along a curved valley, from the slopes' prediction down to its floor.

    Half the second derivative of the readings along the step, solved with the slopes (geodesic acceleration;
    Transtrum and Sethna 2012), with no component longer than the step.
    """
    step = fit.bounds.step_to(walk.place.xi, trial.xi)
    missed = walk.place.residual - trial.residual - walk.slopes @ step
    slopes = fit.moved_slopes(walk.slopes, walk.place.xi, trial.xi)
    curved = Quadratic(trial.xi, -slopes.T @ missed, slopes.T @ slopes + np.eye(step.size))
    longest = float(np.abs(step).max())
    return fit.bounds.reached(trial.xi, bounded_step(curved, fit.bounds.about(trial.xi), walk.damping, longest))


def _apart(one: Array, other: Array) -> float:
    """The largest distance of any xi."""
    return float(np.abs(one - other).max(initial=0.0))


def _damping(damping: float, kept: float) -> float:
    """The damping after a trial that kept this share of the fall promised (Nielsen 1999)."""
    if kept <= 0:
        return max(damping * HARDER, FIRST_DAMPING)
    return max(damping * max(EASIER, 1.0 - (2.0 * kept - 1.0) ** 3), LEAST_DAMPING)


def _posterior(fit: _Fit, place: _Iterate, slopes: Array, whitening: Whitening, effort: FitEffort) -> Posterior:
    """The posterior at a peak, with the evidence of the part of its bell that lies within the bounds.

    A fit that was given up is no peak: where even the promised peak is hopeless it has the evidence of that, else that
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
