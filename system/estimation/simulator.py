"""Interface of a simulator that can be fitted: named parameters, predictions, slopes."""

from __future__ import annotations

from typing import Protocol

from reynolds.numerics.arrays import Array
from system.estimation.parameters import Parameter


class Simulator(Protocol):
    """A model of the N points and C channels of some observations, in SI.

    `values` are those of `parameters`, in their order. Predictions determine a fit; slopes only lead it and may be
    approximate.
    """

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """All parameters with their priors; the order of every vector of values."""

    def predict(self, values: Array) -> Array:
        """Readings (N, C) at the values (k,). Raises NotConverged."""

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d readings / d value of the named parameters, (N, C, len(names)), in SI per SI."""

    def input_slopes(self, values: Array) -> Array:
        """d readings / d input, (N, C, M), for the inputs of the observations in their order, in SI per SI."""

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Simulator:
        """The same model with these parameters: replaced where a name is there already, added where not."""
