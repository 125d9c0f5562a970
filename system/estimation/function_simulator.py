"""A function of named values as a simulator, with slopes by differences."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.estimation.parameters import Parameter, Scale

STEP = 1e-4  # of a parameter's spread: slopes lead a fit, predictions decide it


@dataclass(frozen=True)
class FunctionSimulator:
    """A model whose readings are law(values by name), (N, C) in SI; its inputs are known exactly.

    A parameter that the model lacks is absent from the names: `values.get("leak", 0.0)`. See `Simulator`.
    """

    law: Callable[[Mapping[str, float]], Array]
    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        """Readings (N, C) at the values (k,)."""
        return self.law({one.name: float(value) for one, value in zip(self.parameters, values, strict=True)})

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d readings / d value of the named parameters, (N, C, len(names)), by differences towards the prior's
        centre where a bound is near.
        """
        here, columns = self.predict(values), {}
        for at, one in enumerate(self.parameters):
            if one.name in names:
                size = abs(values[at]) if one.scale is Scale.LOG else 1.0
                step = STEP * one.spread * size * (1.0 if values[at] <= one.centre or one.scale is Scale.HALF else -1.0)
                moved = np.where(np.arange(len(values)) == at, values + step, values)
                columns[one.name] = (self.predict(moved) - here) / step
        return np.stack([columns[name] for name in names], axis=-1)

    def input_slopes(self, values: Array) -> Array:
        """No slopes, (N, C, 0)."""
        return np.zeros((*self.predict(values).shape, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> FunctionSimulator:
        """The same law with these parameters: replaced where a name is there already, added where not."""
        given = {one.name: one for one in parameters}
        kept = tuple(given.pop(one.name, one) for one in self.parameters)
        return replace(self, parameters=(*kept, *given.values()))
