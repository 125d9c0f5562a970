"""Search for the physics that a model lacks: additions are compared by evidence until none gains."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reynolds.errors import InputError, NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.fit import best_posterior, maximum_posterior
from system.estimation.folds import left_out
from system.estimation.observations import Observations
from system.estimation.parameters import Parameter
from system.estimation.posterior import Posterior
from system.estimation.simulator import Simulator
from system.estimation.trial import LIMITS, FitLimits

WORTH = 3.0  # nats, odds of 20 to 1, that an addition of a ladder has to gain
STARTS = (0.1, -0.5, 1.0)  # sizes of an addition, in spreads, at which fits start


@dataclass(frozen=True)
class Addition:
    """A model with an addition: its gain in ln evidence over the model without it, and its fit."""

    name: str
    gain: float
    fit: Posterior

    def size(self, parameter: str) -> tuple[float, float]:
        """A parameter and one sigma of it, SI."""
        return float(self.fit.values[self.fit.index(parameter)]), self.fit.sigma(parameter)


@dataclass(frozen=True)
class Rung:
    """Additions to a model: the fit without them, those that were fitted, the best first, and the failures as text.

    dropped: of a ladder, the names of earlier additions that are not needed beside the best; unfitted: as text, those
    that stay because the model without them could not be fitted.
    """

    before: Posterior
    tried: tuple[Addition, ...]
    failed: tuple[str, ...]
    dropped: tuple[str, ...] = ()
    unfitted: tuple[str, ...] = ()

    @property
    def taken(self) -> Addition | None:
        """The addition of greatest evidence, None where its gain is below `WORTH`."""
        return self.tried[0] if self.tried and self.tried[0].gain >= WORTH else None

    @property
    def rivals(self) -> tuple[Addition, ...]:
        """Additions that the readings do not distinguish from the chosen one: within `WORTH` nats of it."""
        best = self.taken
        return () if best is None else tuple(one for one in self.tried[1:] if one.gain > best.gain - WORTH)


@dataclass(frozen=True)
class Ladder:
    """Result of the search: the steps, the additions that are kept in their order, and the fit with all of them."""

    rungs: tuple[Rung, ...]
    kept: tuple[str, ...]
    fit: Posterior

    @property
    def before(self) -> Posterior:
        """The fit of the model without additions."""
        return self.rungs[0].before

    def rivals(self, name: str) -> tuple[str, ...]:
        """Names of the additions that the readings did not distinguish from a kept one when it was chosen."""
        rung = next(one for one in reversed(self.rungs) if one.taken is not None and one.taken.name == name)
        return tuple(one.name for one in rung.rivals)


def held_out(fit: Posterior, observations: Observations) -> float:
    """Root mean square, in sigma, of the readings of each block as the fit without that block predicts them.

    Each fit is repeated by one linear step (`folds.left_out`): exact for linear readings.
    """
    error = left_out(fit, observations.blocks) / fit.whitening.sigma
    return float(np.sqrt(np.mean(error[observations.measured] ** 2)))


def additions(
    simulator: Simulator,
    observations: Observations,
    possible: Mapping[str, Sequence[Parameter]],
    without: Posterior | None = None,
    limits: FitLimits = LIMITS,
    plain: Observations | None = None,
) -> Rung:
    """A model with each of the possible additions (new parameters, by name) in turn.

    without: the fit of the model itself, where it is known; fits start from its peak. plain: the same readings with
    simpler noise; their fit is one start more, since noise with memory has many peaks. An addition whose parameters
    the model has already is left out. Raises NotConverged where the model itself cannot be fitted.
    """
    if without is None:
        without = maximum_posterior(simulator, observations, limits=limits)
    known = {one.name for one in simulator.parameters}
    found: list[Addition] = []
    failed: list[str] = []
    for name, own in possible.items():
        fresh = tuple(one for one in own if one.name not in known)
        if not fresh:
            continue
        try:
            grown = simulator.with_parameters(fresh)
            starts = _starts(without, fresh)
            if plain is not None:
                starts.append(best_posterior(grown, plain, starts, limits).xi)
            fit = best_posterior(grown, observations, starts, limits)
            found.append(Addition(name, fit.log_evidence - without.log_evidence, fit))
        except NotConverged as reason:
            failed.append(f"{name}: {reason}")
    return Rung(without, tuple(sorted(found, key=lambda each: -each.gain)), tuple(failed))


def ladder(
    simulator: Simulator,
    observations: Observations,
    possible: Mapping[str, Sequence[Parameter]],
    renewed: Callable[[Posterior], Observations] | None = None,
    limits: FitLimits = LIMITS,
    most: int = 6,
) -> Ladder:
    """Additions one after the other, each beside those before it, as long as one gains `WORTH` nats: `most` steps.

    An earlier addition whose evidence falls below that beside a later one is dropped (stepwise selection; Efroymson
    1960). renewed: the observations with the noise that a fit leaves, where it is not known. Raises InputError without
    any possible addition, NotConverged as `additions`.
    """
    if not possible:
        raise InputError("ladder", "no possible addition", "one at least")
    model = _Model(simulator, possible, (), maximum_posterior(simulator, observations, limits=limits))
    rungs: list[Rung] = []
    plain = None if renewed is None else observations
    while len(rungs) < most:
        if renewed is not None and plain is not None:
            begun = maximum_posterior(model.simulator, plain, model.fit.xi, limits)
            observations = renewed(begun)
            model = replace(model, fit=best_posterior(model.simulator, observations, [model.fit.xi, begun.xi], limits))
        rung = additions(model.simulator, observations, model.open, model.fit, limits, plain)
        if rung.taken is None:
            rungs.append(rung)
            break
        grown = replace(model, names=(*model.names, rung.taken.name), fit=rung.taken.fit)
        model, unfitted = _without_idle(grown, observations, limits)
        dropped = tuple(name for name in grown.names if name not in model.names)
        rungs.append(replace(rung, dropped=dropped, unfitted=unfitted))
    return Ladder(tuple(rungs), model.names, model.fit)


@dataclass(frozen=True)
class _Model:
    """A base simulator with some of the possible additions, and its fit."""

    base: Simulator
    possible: Mapping[str, Sequence[Parameter]]
    names: tuple[str, ...]
    fit: Posterior

    @property
    def simulator(self) -> Simulator:
        """The base with all the additions; a parameter that two of them share occurs once."""
        added = {one.name: one for name in self.names for one in self.possible[name]}
        return self.base.with_parameters(tuple(added.values())) if added else self.base

    @property
    def open(self) -> Mapping[str, Sequence[Parameter]]:
        """Additions that are not in the model."""
        return {name: own for name, own in self.possible.items() if name not in self.names}


def _without_idle(model: _Model, observations: Observations, limits: FitLimits) -> tuple[_Model, tuple[str, ...]]:
    """A model without those additions, the last one apart, that gain less than `WORTH` nats beside the others.

    An addition without which the model cannot be fitted stays: these as text, with the reason.
    """
    unfitted: list[str] = []
    for name in model.names[:-1]:
        fewer = replace(model, names=tuple(one for one in model.names if one != name))
        simulator = fewer.simulator
        known = dict(zip((one.name for one in model.fit.parameters), model.fit.xi, strict=True))
        start = np.array([known[one.name] for one in simulator.parameters])
        try:
            fit = maximum_posterior(simulator, observations, start, limits)
        except NotConverged as reason:
            unfitted.append(f"{name}: {reason}")
            continue
        if model.fit.log_evidence - fit.log_evidence < WORTH:
            return _without_idle(replace(fewer, fit=fit), observations, limits)
    return model, tuple(unfitted)


def _starts(without: Posterior, fresh: Sequence[Parameter]) -> list[Array]:
    """The peak without an addition, with each of the sizes of it that its bounds allow."""
    lowest, highest = (np.array([getattr(one, end) for one in fresh]) for end in ("lowest", "highest"))
    sizes = [np.clip(np.full(len(fresh), size), lowest, highest) for size in STARTS]
    return [np.append(without.xi, size) for size in {tuple(size): size for size in sizes}.values()]
