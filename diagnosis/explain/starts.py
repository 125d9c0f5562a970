"""Starts of fits: trial sizes of free parameters, all others at their optimum in a linear model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from diagnosis.study.model import Study
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.bounded_step import Bounds
from system.estimation.parameters import Parameter
from system.estimation.posterior import Posterior, values_at
from system.estimation.simulator import Simulator


@dataclass(frozen=True)
class Expansion:
    """A linear model of the readings: the slopes and the whitening of a posterior, and the xi (k,) of the slopes."""

    posterior: Posterior
    xi: Array


@dataclass(frozen=True)
class Trials:
    """Sizes at which free parameters are tried (spreads), factors on the best of them, and reach of the nuisances."""

    sizes: tuple[float, ...]
    beside: tuple[float, ...]
    reach: float


def start(
    study: Study, simulator: Simulator, about: Expansion, names: tuple[str, ...], trials: Trials
) -> tuple[float, Array]:
    """The objective and xi where a fit starts: the best of the trial sizes, with linear nuisances.

    about: linear model at the prior mean, or at the peak of a part of the hypothesis; its parameters but the named
    ones are the nuisances. The named parameters are tried one after the other with full predictions; a slope at 0
    may be no measure of them (a threshold, a film twice as thick). The best size is tried again a little smaller and
    larger.
    """
    nuisances = _Nuisances(study, simulator, about, names, trials.reach)
    least, found = nuisances.settled(nuisances.centre)
    for name in names:
        at = [parameter.name for parameter in simulator.parameters].index(name)
        rest = np.where(nuisances.free, nuisances.centre, found)
        for size in _signed(trials.sizes, simulator.parameters[at]):
            least, found = _better(nuisances, _with(rest, at, size), least, found)
        for beside in trials.beside if found[at] != rest[at] else ():
            for size in (beside * found[at], found[at] / beside):
                least, found = _better(nuisances, _with(rest, at, size), least, found)
    return least, found


def nearest_start(study: Study, simulator: Simulator, about: Expansion, begin: Array, way: tuple[float, ...]) -> Array:
    """The point of least objective, by predictions, on the way (k,) from the linear model's own place to a start.

    way: shares of it that are tried. Far from its place, or where readings have kinks, a linear model predicts more
    decrease than is achieved. Where its own place is the best, the parameters that are new to it are at zero. Raises
    NotConverged without any point that can be simulated.
    """
    own = about.posterior
    known = np.array([any(one.name == other.name for other in own.parameters) for one in simulator.parameters])
    place = np.zeros(known.size)
    place[known] = [
        about.xi[own.index(one.name)] for one, own_too in zip(simulator.parameters, known, strict=True) if own_too
    ]

    def objective(xi: Array) -> float:
        predicted = simulator.predict(values_at(simulator.parameters, xi))
        left = own.whitening.whiten(study.observations.values - predicted)
        return float(left @ left + xi @ xi)

    tried = [np.where(known, place + share * (begin - place), begin) for share in way]
    found: list[tuple[float, Array]] = []
    failed: list[NotConverged] = []
    for xi in (*tried, place):
        try:
            found.append((objective(xi), xi))
        except NotConverged as reason:
            failed.append(reason)
    if not found:
        raise failed[0]
    return min(found, key=lambda each: each[0])[1]


def lent_slopes(simulator: Simulator, about: Expansion, names: tuple[str, ...], begin: Array) -> Array:
    """Initial slopes (N, C, k): of nuisances those of `about`, of the named parameters those at `begin`."""
    own = about.posterior
    lent = own.whitening.unwhiten(own.slopes)
    known = {parameter.name for parameter in own.parameters} - set(names)
    values = values_at(simulator.parameters, begin)
    fresh = [parameter for parameter in simulator.parameters if parameter.name not in known]
    columns = {one.name: simulator.slopes(values, (one.name,))[..., 0] for one in fresh}
    return np.stack(
        [
            lent[..., own.index(parameter.name)]
            if parameter.name in known
            else columns[parameter.name] * parameter.stretch(float(xi))
            for parameter, xi in zip(simulator.parameters, begin, strict=True)
        ],
        axis=-1,
    )


def _with(xi: Array, at: int, size: float) -> Array:
    changed = xi.copy()
    changed[at] = size
    return changed


def _better(nuisances: _Nuisances, trial: Array, least: float, found: Array) -> tuple[float, Array]:
    """The trial's objective and xi with settled nuisances if it is less than the least so far, else these."""
    try:
        objective, settled = nuisances.settled(nuisances.bounds.within(trial))
    except NotConverged:
        return least, found
    return (objective, settled) if objective < least else (least, found)


def _signed(sizes: tuple[float, ...], parameter: Parameter) -> list[float]:
    tried = [size for one in sizes for size in (one, -one)]
    return [size for size in tried if parameter.lowest <= size <= parameter.highest]


class _Nuisances:
    """Parameters of a linear model that are not tried themselves, with their values and slopes there.

    centre (k,): xi of the simulator's parameters, those of the linear model, 0 for others.
    """

    def __init__(
        self, study: Study, simulator: Simulator, about: Expansion, names: tuple[str, ...], reach: float
    ) -> None:
        own = about.posterior
        self.study, self.simulator, self.reach, self.whitening = study, simulator, reach, own.whitening
        known = {parameter.name for parameter in own.parameters} - set(names)
        self.free = np.array([parameter.name in known for parameter in simulator.parameters])
        places = [own.index(one.name) for one in simulator.parameters if one.name in known]
        self.centre = np.zeros(self.free.size)
        self.centre[self.free] = about.xi[places]
        self.slopes = own.slopes[:, places]
        self.factor = cho_factor(self.slopes.T @ self.slopes + np.eye(len(places)))
        self.bounds = Bounds.of(simulator.parameters)

    def settled(self, xi: Array) -> tuple[float, Array]:
        """The objective and xi with the nuisances, at the centre in `xi`, at their optimum in the linear model.

        Raises NotConverged where the simulator does.
        """
        predicted = self.simulator.predict(values_at(self.simulator.parameters, xi))
        offset = self.whitening.whiten(self.study.observations.values - predicted)
        centre, tried = self.centre[self.free], xi[~self.free]
        taken = cho_solve(self.factor, self.slopes.T @ offset - centre)
        left, moved = offset - self.slopes @ taken, centre + taken
        own = np.zeros_like(xi)
        own[self.free] = np.clip(taken, -self.reach, self.reach)
        settled = self.bounds.reached(np.where(self.free, self.centre, xi), own)
        return float(left @ left + moved @ moved + tried @ tried), self.bounds.within(settled)
