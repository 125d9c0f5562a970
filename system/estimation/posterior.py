"""The posterior of the parameters about its peak, and its evidence, with priors that end at bounds."""

from dataclasses import dataclass, replace
from functools import cached_property
from time import process_time

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.special import log_ndtr

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds
from system.estimation.observations import Observations
from system.estimation.parameters import Parameter
from system.estimation.simulator import Simulator
from system.estimation.whitening import Whitening, whitener


def laplace(objective: float, precision: Array) -> float:
    """ln evidence -J/2 - ln det(precision)/2 of a peak (Laplace 1774; MacKay 2003, chapter 27).

    J = r.r + xi.xi; constants that all hypotheses on the same readings share are left out. Exact where the
    readings are linear in the parameters and no bound is near.
    """
    return -0.5 * objective - 0.5 * float(np.linalg.slogdet(precision)[1])


def log_mass(centre: Array, sigma: Array, lowest: Array, highest: Array) -> Array:
    """ln of the mass of N(centre, sigma^2) between two bounds, without loss of digits in either tail."""
    low, high = (lowest - centre) / sigma, (highest - centre) / sigma
    mirrored = low > 0
    low, high = np.where(mirrored, -high, low), np.where(mirrored, -low, high)
    upper, lower = log_ndtr(high), log_ndtr(low)
    return upper + np.log1p(-np.exp(lower - upper))


def bounded_laplace(objective: float, gradient: Array, precision: Array, below: Array, above: Array) -> float:
    """ln of the integral of exp(-J/2) between bounds over (2 pi)^(k/2), J = objective - 2 gradient.d + d.precision.d.

    below, above: (k,), from d = 0 to the bounds. Parameters on a bound to which the gradient points (A) are integrated
    from there one at a time, the others (F) at their peak given these:

        -J_F/2 - ln det P_FF/2 + sum over A [G^2/(2 S) - ln S/2 + ln mass], G, S: gradient and precision given F

    and the mass of F between its bounds one at a time. Exact for one parameter on a bound, and for several that the
    precision does not couple.
    """
    held = ((below >= 0.0) & (gradient < 0.0)) | ((above <= 0.0) & (gradient > 0.0))
    free = ~held
    factor = cho_factor(precision[np.ix_(free, free)])
    step = cho_solve(factor, gradient[free])
    coupled = precision[np.ix_(held, free)]
    rest = gradient[held] - coupled @ step
    own = np.diag(precision)[held] - np.einsum("af,fa->a", coupled, cho_solve(factor, coupled.T))
    sigma = np.sqrt(np.diag(cho_solve(factor, np.eye(step.size))))
    found = laplace(objective - float(gradient[free] @ step), precision[np.ix_(free, free)])
    found += float(log_mass(step, sigma, below[free], above[free]).sum())
    at_bounds = log_mass(rest / own, own**-0.5, below[held], above[held])
    return found + float((0.5 * rest**2 / own - 0.5 * np.log(own) + at_bounds).sum())


UNINFORMED = 1e-9  # share of its prior variance by which a parameter must be known better to have a pull


@dataclass(frozen=True)
class FitEffort:
    """Cost of a fit: predictions, slopes (maps of all columns), seconds of process time."""

    predictions: int
    slopes: int
    seconds: float


@dataclass(frozen=True)
class Posterior:
    """Parameters at the peak of the posterior, or at the peak of its linear form about the prior mean.

    xi, values: (k,), standard numbers and SI values. residual: (n,), whitened, one for each reading; slopes: (n, k), d
    prediction / d xi, whitened; precision: (k, k) = slopes^T slopes + 1; objective: residual^2 + xi^2; log_evidence:
    natural logarithm, without the constants that all hypotheses on these readings share; predictions: (N, C) in SI.
    """

    parameters: tuple[Parameter, ...]
    xi: Array
    values: Array
    residual: Array
    slopes: Array
    precision: Array
    objective: float
    log_evidence: float
    predictions: Array
    whitening: Whitening
    effort: FitEffort

    @cached_property
    def covariance(self) -> Array:
        """(k, k), of xi: the inverse of the precision."""
        return cho_solve(cho_factor(self.precision), np.eye(self.xi.size))

    @cached_property
    def pulls(self) -> Array:
        """(k,), xi / sqrt(1 - its variance): N(0, 1) where the priors are right; 0 without information."""
        gained = 1.0 - np.diag(self.covariance)
        informed = gained > UNINFORMED
        return np.where(informed, self.xi / np.sqrt(np.where(informed, gained, 1.0)), 0.0)

    @property
    def at_bounds(self) -> NDArray[np.bool_]:
        """(k,), parameters whose value is a bound: their sigma, of a slope there, does not hold."""
        ends = zip(self.parameters, self.xi, strict=True)
        return np.array([xi <= one.lowest or xi >= one.highest for one, xi in ends], dtype=bool)

    def index(self, name: str) -> int:
        """The index of a parameter in every vector. Raises InputError for an unknown name."""
        names = [parameter.name for parameter in self.parameters]
        if name not in names:
            raise InputError("posterior", f"parameter {name!r}", f"one of {', '.join(names)}")
        return names.index(name)

    def sigma(self, name: str) -> float:
        """One sigma of a parameter in SI, to first order about the peak."""
        at = self.index(name)
        return abs(self.parameters[at].stretch(self.xi[at])) * float(np.sqrt(self.covariance[at, at]))

    def correlation(self, first: str, second: str) -> float:
        """Correlation of two parameters, -1 to 1."""
        one, two = self.index(first), self.index(second)
        covariance = self.covariance
        return float(covariance[one, two] / np.sqrt(covariance[one, one] * covariance[two, two]))


def values_at(parameters: tuple[Parameter, ...], xi: Array) -> Array:
    """SI values (k,) of standard numbers."""
    return np.array([parameter.value(number) for parameter, number in zip(parameters, xi, strict=True)])


def standard_slopes(simulator: Simulator, xi: Array) -> Array:
    """d readings / d xi, (N, C, k), in SI per standard number, of all parameters of a simulator."""
    parameters = simulator.parameters
    slopes = simulator.slopes(values_at(parameters, xi), tuple(parameter.name for parameter in parameters))
    stretch = np.array([parameter.stretch(number) for parameter, number in zip(parameters, xi, strict=True)])
    return slopes * stretch


def settled(posterior: Posterior) -> Posterior:
    """A fit at the exact peak of its own linear form, for the parameters that are on no bound.

    A fit ends close to its peak. The difference is negligible for its objective, but not for a column that the
    parameters nearly absorb: g = v.r grows with the remaining gradient A^T r - xi. Scores and evidences about a
    fit use this form.
    """
    bounds = Bounds.of(posterior.parameters)
    free = (posterior.xi > bounds.lowest) & (posterior.xi < bounds.highest)
    slopes, precision = posterior.slopes[:, free], posterior.precision[np.ix_(free, free)]
    gradient = slopes.T @ posterior.residual - posterior.xi[free]
    step = cho_solve(cho_factor(precision), gradient)
    return replace(
        posterior,
        parameters=tuple(one for one, own in zip(posterior.parameters, free, strict=True) if own),
        xi=posterior.xi[free] + step,
        values=posterior.values[free],
        residual=posterior.residual - slopes @ step,
        slopes=slopes,
        precision=precision,
        objective=posterior.objective - float(gradient @ step),
    )


def linear_posterior(simulator: Simulator, observations: Observations, about: Array | None = None) -> Posterior:
    """The posterior of the model made linear about xi = `about` (k,), the prior mean if None: one prediction, one set
    of slopes.

    Peak H xi = A^T r0, r = r0 - A xi, r0 the linear model's residual at xi = 0. Bounds do not hold here: a score tests
    the direction of a parameter, and a wrong model would move a bounded fit to its corners.
    """
    begun = process_time()
    parameters = simulator.parameters
    start = np.zeros(len(parameters)) if about is None else about
    values = values_at(parameters, start)
    predictions = simulator.predict(values)
    whitening = whitener(observations, simulator.input_slopes(values))
    raw = standard_slopes(simulator, start)
    slopes = whitening.whiten(raw)
    offset = whitening.whiten(observations.values - predictions) + slopes @ start
    precision = slopes.T @ slopes + np.eye(start.size)
    xi = cho_solve(cho_factor(precision), slopes.T @ offset)
    residual = offset - slopes @ xi
    objective = float(residual @ residual + xi @ xi)
    return Posterior(
        parameters=parameters,
        xi=xi,
        values=values_at(parameters, xi),
        residual=residual,
        slopes=slopes,
        precision=precision,
        objective=objective,
        log_evidence=laplace(objective, precision) + whitening.log_determinant,
        predictions=predictions + raw @ (xi - start),
        whitening=whitening,
        effort=FitEffort(1, 1, process_time() - begun),
    )
