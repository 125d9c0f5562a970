"""A model of your own in the estimation engine: what does a valve lack whose flow is that of an orifice?

    python examples/own_simulator/valve.py [--picture FILE.png]

    Q = a sqrt(p) (1 + gain) + b p + zero        gain, b and zero are possible additions

A model is a function of named values. The readings are artificial, with a leak b.
"""

import sys
from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from reynolds import Array
from system import FunctionSimulator, Ladder, Parameter, Role, Scale, held_out, independent_observations, ladder

DROP = np.linspace(1e5, 40e5, 30)  # Pa, of each reading
SIGMA = 2e-6  # m3/s
ORIFICE = Parameter("orifice", Role.BASE, Scale.NORMAL, 1e-7, 1e-9, 0.0, 1e-6, None, "drawing")
POSSIBLE = {
    "leak": (Parameter("leak", Role.EXTENSION, Scale.HALF, 0.0, 1e-11, 0.0, 1e-9, None, "a worn seat"),),
    "gain of the meter": (Parameter("gain", Role.SENSOR, Scale.NORMAL, 0.0, 0.05, -0.3, 0.3, None, "its class"),),
    "zero of the meter": (Parameter("zero", Role.SENSOR, Scale.NORMAL, 0.0, 1e-5, -1e-4, 1e-4, None, "its class"),),
}


def flow(values: Mapping[str, float]) -> Array:
    """Return the flow (30, 1) in m3/s at DROP; a parameter that the model does not have is zero."""
    through = values["orifice"] * np.sqrt(DROP) * (1.0 + values.get("gain", 0.0))
    return np.array(through + values.get("leak", 0.0) * DROP + values.get("zero", 0.0))[:, None]


def main(leak: float = 5e-12, picture: str = "") -> tuple[str, ...]:
    """Print what a valve with a leak in m3/(s Pa) lacks, one addition after the other, and draw it; return it."""
    noise = SIGMA * np.random.default_rng(1).standard_normal((DROP.size, 1))
    read = independent_observations(["flow"], flow({"orifice": 1e-7, "leak": leak}) + noise, np.array([SIGMA]))
    found = ladder(FunctionSimulator(flow, (ORIFICE,)), read, POSSIBLE)
    for rung in found.rungs:
        print("; ".join(f"{one.name} {one.gain:+.1f} nats" for one in rung.tried))
    errors = (held_out(fit, read) for fit in (found.before, found.fit))
    print("held out: {:.2f} -> {:.2f} sigma by {}".format(*errors, ", ".join(found.kept) or "nothing"))
    if picture:
        draw(read.values, found, picture)
    return found.kept


def draw(readings: Array, found: Ladder, picture: str) -> None:
    """Draw what the orifice alone, and the model found, leave of the readings, in sigma."""
    axes = Figure(figsize=(7.2, 3.6), layout="constrained").subplots()
    for name, fit in (("orifice", found.before), (f"orifice and {', '.join(found.kept)}", found.fit)):
        axes.plot(1e-5 * DROP, (readings - fit.predictions)[:, 0] / SIGMA, "o-", markersize=4, label=name)
    axes.set(xlabel="pressure drop [bar]", ylabel="reading less model [sigma]")
    axes.legend().figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(picture=sys.argv[2] if sys.argv[1:2] == ["--picture"] else "")
