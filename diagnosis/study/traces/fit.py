"""Recorded traces fitted alone, by the parameters of the chamber pressure and within their tolerances."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from diagnosis.study.traces.bench import TracedBench
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.bench.parameters import GROOVE_NAMES
from system.bench.sensors import TRACE_NAMES
from system.estimation.fit import maximum_posterior
from system.estimation.parameters import Parameter
from system.estimation.trial import FitLimits

MOVING = frozenset({
    "bulk_modulus", "dead_volume", "flow_coefficient", "stand_out_share", "p_out.zero", "film_thickness.piston",
    "film_thickness.slipper", "film_thickness.valve_plate", "viscosity", *GROOVE_NAMES, *TRACE_NAMES,
})  # fmt: skip
"""Parameters on which a chamber's recorded pressure over the turn depends."""
LIMITS = FitLimits(change=0.1)  # of the objective


@dataclass(frozen=True, eq=False)
class ChamberBench:
    """The traces of a bench alone: a simulator of their numbers (T, F) with their own parameters.

    All others stay at their prior mean.
    """

    traced: TracedBench
    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        """Numbers (T, F) of the traces. Raises NotConverged."""
        return self.traced.numbers(self._all(values))

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d numbers / d value of the named parameters, (T, F, len(names)), by differences."""
        return self.traced.number_slopes(self._all(values), names)

    def input_slopes(self, values: Array) -> Array:
        """(T, F, 0): set values are exact, except for the parameter p_out.zero."""
        return np.zeros((*self.traced.recorded.shape, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> ChamberBench:
        """The same with these parameters: replaced where a name is there already, added where not."""
        given = {one.name: one for one in (*self.parameters, *parameters)}
        return ChamberBench(self.traced.with_parameters(parameters), tuple(given.values()))

    def _all(self, values: Array) -> Array:
        own = {one.name: value for one, value in zip(self.parameters, values, strict=True)}
        return np.array([own.get(one.name, one.value(0.0)) for one in self.traced.parameters])


def settled_traces(traced: TracedBench, reach: float) -> Array:
    """xi (k,) of the bench's parameters at which its traces fit best, none farther than `reach` from its mean.

    A flank is no linear function of the parameters that move it: slopes at the prior mean do not remove the effect of
    tolerances. `reach` keeps the fit from following a mismatch that tolerances cannot explain. If a simulation fails,
    the mean is returned.
    """
    moving = [one for one in traced.parameters if one.name in MOVING]
    chamber = ChamberBench(traced, tuple(_within(one, reach) for one in moving))
    xi = np.zeros(len(traced.parameters))
    try:
        found = maximum_posterior(chamber, traced.trace_observations(), limits=LIMITS)
    except NotConverged:
        return xi
    xi[[one.name in MOVING for one in traced.parameters]] = found.xi
    return xi


def _within(parameter: Parameter, reach: float) -> Parameter:
    """The same, cut to `reach` either side of its mean."""
    lower, upper = max(parameter.lowest, -reach), min(parameter.highest, reach)
    return replace(parameter, lower=parameter.value(lower), upper=parameter.value(upper))
