"""A fit in progress: its places, and trials of steps that its slopes propose.

Damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963) between bounds; a prediction accepts or rejects each. Each
step corrects the slopes (Broyden 1965). A step that leaves the floor of a curved valley is corrected back to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds, Quadratic, bounded_step
from system.estimation.observations import Observations
from system.estimation.posterior import Posterior, standard_slopes, values_at
from system.estimation.simulator import Simulator
from system.estimation.whitening import Whitening, whitener

HARDER, EASIER = 8.0, 1.0 / 8.0  # the damping after a trial that failed, that achieved its prediction
GROWTH = 2.0  # of that factor with each trial that fails in a row
LEAST_DAMPING, FIRST_DAMPING, MOST_DAMPING = 1e-7, 1e-6, 1e6  # of the sensitivities: valleys have far smaller ones
CORRECTIONS, LEFT = 6, 0.8  # of a trial, down to the floor of a curved valley: each leaves less than this share
LOCAL = 1e2  # damping from which a failed trial shows wrong slopes here, not the curve on the way
SHORT = 1e-3  # in xi: over shorter steps the solvers' own error exceeds the change of the readings
GOOD = 0.5  # share of the predicted decrease: below it the slopes are computed anew
TRUE, LONGER = 0.75, 2.0  # share of the predicted decrease from which the next step may be so many times as long
STEP = 0.05  # in xi, of slopes by predictions: over shorter ones other steps of the solver would count
PROBE = 0.01  # in xi, of a step that shows whether slopes are right
FAR = 1.0  # in xi: slopes from farther away are computed anew where a step is curved
NEAR = 0.02  # in xi: slopes taken no farther away are valid for a peak and its covariance


@dataclass(frozen=True)
class FitLimits:
    """End of a fit: steps at most, change of the objective, largest first step in xi, rounds of whitening.

    stall: predicted fall of the objective below which a point that no step improves counts as a peak; like the change
    it is in units of the objective per reading where that is above one. Half a nat suits smooth models; for models with
    kinks more decrease is predicted than achieved. hopeless: an objective above which a fit is useless. After
    `patience` trials, or fewer where slopes are right, a fit whose predicted objective is not lower ends, with the
    evidence of the predicted peak. gross: objective per reading of a model that is wrong; its fit ends where `level`
    trials gain less than the share `coarse` of the objective. stuck: steps that together gain less than `change`, after
    which slopes give no further gain.
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
class Iterate:
    """State of a fit: xi, predictions (N, C), whitened residual (n,), objective."""

    xi: Array
    predictions: Array
    residual: Array
    objective: float


@dataclass(frozen=True)
class Walk:
    """A place, the slopes for its next step and the xi of their computation, damping and largest length of that step.

    longest: in any xi, in units of the largest first step; it grows while steps of that length achieve the predicted
    decrease. failed: trials in a row.
    """

    place: Iterate
    slopes: Array
    taken: Array
    damping: float
    longest: float = 1.0
    failed: int = 0

    @property
    def moved(self) -> float:
        """Largest distance in any xi from the point where the slopes were computed."""
        return _apart(self.place.xi, self.taken)


class Fit:
    """A fit in progress: the model, the readings, and the cost so far."""

    def __init__(self, simulator: Simulator, observations: Observations, limits: FitLimits) -> None:
        self.simulator, self.observations, self.limits = simulator, observations, limits
        self.bounds = Bounds.of(simulator.parameters)
        self.predictions = self.slope_maps = 0
        self.failed_at = -limits.level  # predictions when the simulator failed last
        self.taken, self.raw = np.full(len(simulator.parameters), np.inf), np.zeros(0)  # the last slopes, where
        self.exact = False  # slopes by predictions: those of the simulator may be approximate

    def place(self, xi: Array, whitening: Whitening) -> Iterate:
        """Predict at xi. Raises NotConverged where the simulator does."""
        self.predictions += 1
        return self.iterate(xi, self.simulator.predict(values_at(self.simulator.parameters, xi)), whitening)

    def trial(self, xi: Array, whitening: Whitening) -> Iterate | None:
        """Predict at the xi within the bounds; None where the simulator fails."""
        try:
            return self.place(self.bounds.within(xi), whitening)
        except NotConverged:
            self.failed_at = self.predictions
            return None

    def iterate(self, xi: Array, predictions: Array, whitening: Whitening) -> Iterate:
        """A place with its residual by a whitening."""
        residual = whitening.whiten(self.observations.values - predictions)
        return Iterate(xi, predictions, residual, float(residual @ residual + xi @ xi))

    def walk(self, place: Iterate, whitening: Whitening) -> Walk:
        """A walk from a place, with the last slopes if they were computed near it."""
        if not _apart(place.xi, self.taken) <= NEAR:
            self.slopes(place.xi)
        return Walk(place, whitening.whiten(self.raw), self.taken, LEAST_DAMPING)

    def first(self, place: Iterate, whitening: Whitening, lent: Array | None) -> Walk:
        """The walk from the start, with slopes from elsewhere where they are lent."""
        if lent is None:
            return self.walk(place, whitening)
        return Walk(place, whitening.whiten(lent), np.full_like(place.xi, np.inf), LEAST_DAMPING)

    def renewed(self, walk: Walk, whitening: Whitening) -> Walk:
        """The same place with slopes computed there."""
        self.slopes(walk.place.xi)
        return replace(walk, slopes=whitening.whiten(self.raw), taken=self.taken)

    def moved_slopes(self, slopes: Array, xi: Array, other: Array) -> Array:
        """Slopes (n, k) at xi as those at another xi, for readings linear along the curves of the bounds."""
        return slopes * np.exp(self.bounds.bend * (other - xi))

    def slopes(self, xi: Array) -> None:
        """Compute d prediction / d xi at xi."""
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

    def is_stuck(self, objectives: Sequence[float], place: Iterate) -> bool:
        """True if the last `stuck` steps together brought less than a change that counts."""
        back = self.limits.stuck
        gained = objectives[-1 - back] - objectives[-1] if len(objectives) > back else inf
        return gained < self.limits.change * excess(place)

    def promised(self, walk: Walk) -> float:
        """Decrease of the objective to the peak that the slopes predict."""
        model, step = self.to_peak(walk)
        return model.fall(step)

    def to_peak(self, walk: Walk) -> tuple[Quadratic, Array]:
        """The model by the slopes of a walk, and the step (k,) to its peak."""
        model = Quadratic.of(walk.place.xi, walk.place.residual, walk.slopes)
        return model, bounded_step(model, self.bounds.about(model.xi), 0.0, np.inf)


def are_right(fit: Fit, walk: Walk, whitening: Whitening) -> bool:
    """True if the objective falls towards the peak as steeply as the slopes predict, to GOOD; two predictions."""
    place, (model, step) = walk.place, fit.to_peak(walk)
    step *= PROBE / float(np.abs(step).max())
    before, after = (fit.trial(fit.bounds.reached(place.xi, sign * step), whitening) for sign in (-1.0, 1.0))
    if before is None or after is None:
        return False
    change = 0.5 * (before.residual - after.residual)
    return float(place.residual @ change - place.xi @ step) >= GOOD * float(model.gradient @ step)


def tried(fit: Fit, walk: Walk, whitening: Whitening) -> Walk:
    """One trial: the new point where the objective falls, with damping and slopes updated from the result."""
    place = walk.place
    model = Quadratic.of(place.xi, place.residual, walk.slopes)
    step = bounded_step(model, fit.bounds.about(place.xi), walk.damping, walk.longest * fit.limits.largest_step)
    promised = model.fall(step)
    trial = fit.trial(fit.bounds.reached(place.xi, step), whitening) if promised > 0 else None
    if trial is None:
        return replace(walk, damping=_harder(walk), longest=1.0, failed=walk.failed + 1)
    straight = (place.objective - trial.objective) / promised
    if straight >= GOOD:
        slopes = _by_secant(walk.slopes, place.residual - trial.residual, fit.bounds.step_to(place.xi, trial.xi))
        slopes = fit.moved_slopes(slopes, place.xi, trial.xi)
    else:
        trial, slopes = _on_the_floor(fit, walk, trial, promised, whitening)
    kept = (place.objective - trial.objective) / promised
    longest = walk.longest * LONGER if straight >= TRUE else walk.longest if kept > GOOD else 1.0
    if kept > 0:
        here = Walk(trial, slopes, walk.taken, _easier(walk.damping, kept), longest)
    else:
        is_local = walk.damping > LOCAL
        went = fit.bounds.step_to(place.xi, trial.xi)
        slopes = _by_secant(walk.slopes, place.residual - trial.residual, went) if is_local else walk.slopes
        here = replace(walk, slopes=slopes, damping=_harder(walk), longest=longest, failed=walk.failed + 1)
    is_old = here.moved > (SHORT if kept < GOOD else FAR)
    return fit.renewed(here, whitening) if straight < GOOD and is_old else here


def _on_the_floor(fit: Fit, walk: Walk, trial: Iterate, promised: float, whitening: Whitening) -> tuple[Iterate, Array]:
    """A trial that is corrected down to the floor of a curved valley, and the slopes there.

    The floor is the residual that the slopes predict at the trial's step. The first correction is half the second
    derivative of the readings along the step, solved with the slopes (geodesic acceleration; Transtrum and Sethna
    2012). Further corrections follow, each with slopes corrected by the last one, while each leaves less than LEFT of
    the missing decrease. No component of a correction is longer than the step.
    """
    step = fit.bounds.step_to(walk.place.xi, trial.xi)
    floor, longest = walk.place.residual - walk.slopes @ step, float(np.abs(step).max())
    slopes = fit.moved_slopes(walk.slopes, walk.place.xi, trial.xi)
    least = walk.place.objective - promised
    for _ in range(CORRECTIONS):
        curved = Quadratic(trial.xi, slopes.T @ (trial.residual - floor), slopes.T @ slopes + np.eye(step.size))
        moved = bounded_step(curved, fit.bounds.about(trial.xi), walk.damping, longest)
        corrected = fit.trial(fit.bounds.reached(trial.xi, moved), whitening)
        if corrected is None or corrected.objective >= trial.objective:
            break
        left = (corrected.objective - least) / (trial.objective - least)
        went = fit.bounds.step_to(trial.xi, corrected.xi)
        slopes = _by_secant(slopes, trial.residual - corrected.residual, went)
        slopes, trial = fit.moved_slopes(slopes, trial.xi, corrected.xi), corrected
        if left > LEFT or trial.objective - least <= (1.0 - TRUE) * promised:
            break
    return trial, slopes


def _by_secant(slopes: Array, change: Array, went: Array) -> Array:
    """Slopes (n, k) that give the change (n,) of the readings over a step (k,), otherwise unchanged (Broyden 1965)."""
    if np.abs(went).max() <= SHORT:
        return slopes
    return slopes + np.outer(change - slopes @ went, went) / (went @ went)


def _apart(one: Array, other: Array) -> float:
    """The largest distance of any xi."""
    return float(np.abs(one - other).max(initial=0.0))


def _harder(walk: Walk) -> float:
    """The damping after a trial that failed; its factor grows with the failures in a row."""
    return max(walk.damping * HARDER * GROWTH**walk.failed, FIRST_DAMPING)


def _easier(damping: float, kept: float) -> float:
    """The damping after a trial that achieved this share of the predicted decrease (Nielsen 1999)."""
    return max(damping * max(EASIER, 1.0 - (2.0 * kept - 1.0) ** 3), LEAST_DAMPING)


def excess(place: Iterate | Posterior) -> float:
    """The objective per reading where that is above one: a bad model does not need an accurate fit."""
    return max(1.0, place.objective / place.residual.size)
