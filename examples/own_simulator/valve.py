"""A model of your own in the estimation engine: a valve, with and without a leak beside its orifice.

    python examples/own_simulator/valve.py

    Q = a sqrt(p), or with the leak Q = a sqrt(p) + b p

A model is a function of named values. The readings are artificial.
"""

from collections.abc import Mapping

import numpy as np

from reynolds import Array
from system import FunctionSimulator, Parameter, Role, Scale, independent_observations, maximum_posterior

DROP = np.linspace(1e5, 40e5, 30)  # Pa, of each reading
SIGMA = 2e-6  # m3/s
ORIFICE = Parameter("orifice", Role.BASE, Scale.NORMAL, 1e-7, 5e-8, 0.0, 1e-6, None, "drawing")
LEAK = Parameter("leak", Role.EXTENSION, Scale.HALF, 0.0, 1e-11, 0.0, 1e-9, None, "a worn seat")


def flow(values: Mapping[str, float]) -> Array:
    """Return the flow (30, 1) in m3/s at DROP; a parameter that the model does not have is zero."""
    found: Array = (values["orifice"] * np.sqrt(DROP) + values.get("leak", 0.0) * DROP)[:, None]
    return found


def main(leak: float = 5e-12) -> float:
    """Print both fits to a valve with a leak in m3/(s Pa); return the evidence of a leak less that of none, in nats."""
    noise = SIGMA * np.random.default_rng(1).standard_normal((DROP.size, 1))
    read = independent_observations(["flow"], flow({"orifice": 1e-7, "leak": leak}) + noise, np.array([SIGMA]))
    evidence = []
    for parameters in ((ORIFICE,), (ORIFICE, LEAK)):
        fit = maximum_posterior(FunctionSimulator(flow, parameters), read)
        evidence.append(fit.log_evidence)
        sizes = (
            f"{one.name} {value:.3g} +- {fit.sigma(one.name):.1g}"
            for one, value in zip(parameters, fit.values, strict=True)
        )
        print(f"ln evidence {fit.log_evidence:8.1f}   {', '.join(sizes)}")
    return evidence[1] - evidence[0]


if __name__ == "__main__":
    main()
