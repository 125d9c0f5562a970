"""A model of your own in the estimation engine: a valve, with and without a leak beside its orifice.

    python examples/own_simulator/valve.py

    Q = a sqrt(p), or with the leak Q = a sqrt(p) + b p

A model has the five members of `system.Simulator`. The readings are artificial.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reynolds import Array
from system import Channel, Observations, Parameter, Role, Scale, maximum_posterior

DROP = np.linspace(1e5, 40e5, 30)  # Pa, of each reading
SIGMA = 2e-6  # m3/s
ORIFICE = Parameter("orifice", Role.BASE, Scale.NORMAL, 1e-7, 5e-8, 0.0, 1e-6, None, "drawing")
LEAK = Parameter("leak", Role.EXTENSION, Scale.HALF, 0.0, 1e-11, 0.0, 1e-9, None, "a worn seat")


@dataclass(frozen=True)
class Valve:
    """Flow (N, 1) in m3/s through the valve at the pressure drops DROP."""

    parameters: tuple[Parameter, ...] = (ORIFICE,)

    def predict(self, values: Array) -> Array:
        """Return the flow; a parameter that the model does not have is zero."""
        known = {"leak": 0.0} | {one.name: value for one, value in zip(self.parameters, values, strict=True)}
        found: Array = (known["orifice"] * np.sqrt(DROP) + known["leak"] * DROP)[:, None]
        return found

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """Return d flow / d value, (N, 1, k), by differences; predictions decide a fit, slopes only lead it."""
        columns = []
        for at, one in enumerate(self.parameters):
            if one.name in names:
                step = 1e-4 * one.spread
                moved = np.where(np.arange(values.size) == at, values + step, values)
                columns.append((self.predict(moved) - self.predict(values)) / step)
        return np.stack(columns, axis=-1)

    def input_slopes(self, values: Array) -> Array:
        """Return no slopes, (N, 1, 0): pressure drops are known exactly."""
        return np.zeros((DROP.size, 1, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Valve:
        """Return the valve with these parameters: replaced where a name is known, added where not."""
        given = {one.name: one for one in parameters}
        kept = tuple(given.pop(one.name, one) for one in self.parameters)
        return replace(self, parameters=(*kept, *given.values()))


def readings(leak: float) -> Observations:
    """Return flows of a valve with a leak in m3/(s Pa), with noise."""
    flow = 1e-7 * np.sqrt(DROP) + leak * DROP + SIGMA * np.random.default_rng(1).standard_normal(DROP.size)
    return Observations(
        channels=(Channel("flow", None),),
        values=flow[:, None],
        sigma=np.full((DROP.size, 1), SIGMA),
        inputs=(),
        input_sigma=np.zeros((DROP.size, 0)),
        quantum=np.zeros(1),
        blocks=np.arange(DROP.size) // 10,
    )


def main(leak: float = 5e-12) -> float:
    """Print both fits; return the evidence of a leak less that of none, in nats."""
    read, evidence = readings(leak), []
    for valve in (Valve(), Valve().with_parameters((LEAK,))):
        fit = maximum_posterior(valve, read)
        evidence.append(fit.log_evidence)
        sizes = ", ".join(
            f"{one.name} {value:.3g} +- {fit.sigma(one.name):.1g}"
            for one, value in zip(valve.parameters, fit.values, strict=True)
        )
        print(f"ln evidence {fit.log_evidence:8.1f}   {sizes}")
    return evidence[1] - evidence[0]


if __name__ == "__main__":
    main()
