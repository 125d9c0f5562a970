"""Two tanks, one above the other: a simulator with named parameters for the estimation engine.

    dx1/dt = k4 u - k1 sqrt(x1)            dx2/dt = k2 sqrt(x1) - k3 sqrt(x2)            y = x2

u: voltage of the pump, x: levels in V of the sensor, both by Torricelli's law (Schoukens, Mattsson, Wigren and
Noel, Cascaded tanks benchmark, 2016). Only x2 is measured; both first levels are parameters. EXTENSIONS are the
possible additions by name.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numba import njit

from reynolds import Array
from system import Parameter, Role, Scale

SAMPLE = 4.0  # s
SUBSTEPS = 4
WEIR = 2.0  # 1/(s V^0.5): a head of a quarter of a volt passes the largest inflow
STEP = 1e-4  # of a prior spread, for slopes
ABSENT = {
    "rim_1": np.inf, "rim_2": np.inf, "spill": 0.0, "exponent_2": 0.5, "leak_1": 0.0, "leak_2": 0.0,
    "offset": 0.0, "ceiling": np.inf, "lag": 0.0,
}  # fmt: skip
ORDER = ("k1", "k2", "k3", "k4", "first_1", "first_2", *ABSENT)


def _base(name: str, scale: Scale, centre: float, spread: float, highest: float) -> Parameter:
    return Parameter(name, Role.BASE, scale, centre, spread, 0.0, highest, None, "order of magnitude of the record")


def _extension(name: str, scale: Scale, centre: float, spread: float, lowest: float, highest: float) -> Parameter:
    return Parameter(name, Role.EXTENSION, scale, centre, spread, lowest, highest, None, "the rig's size")


BASE = (
    *(_base(name, Scale.LOG, 0.05, 1.0, 1.0) for name in ("k1", "k2", "k3", "k4")),
    _base("first_1", Scale.NORMAL, 5.0, 3.0, 15.0),
    _base("first_2", Scale.NORMAL, 5.0, 3.0, 15.0),
)
RIM_1 = _extension("rim_1", Scale.LOG, 10.0, 0.5, 1.0, 40.0)
RIM_2 = _extension("rim_2", Scale.LOG, 10.0, 0.1, 5.0, 15.0)
SPILL = _extension("spill", Scale.NORMAL, 0.5, 0.3, 0.0, 1.0)
EXTENSIONS: dict[str, tuple[Parameter, ...]] = {
    "overflow of tank 1": (RIM_1, SPILL),
    "overflow of tank 2": (RIM_2,),
    "overflow of both tanks": (RIM_1, SPILL, RIM_2),
    "outflow exponent of tank 2": (_extension("exponent_2", Scale.NORMAL, 0.5, 0.1, 0.25, 1.0),),
    "leak of tank 1": (_extension("leak_1", Scale.HALF, 0.0, 0.005, 0.0, 0.05),),
    "leak of tank 2": (_extension("leak_2", Scale.HALF, 0.0, 0.005, 0.0, 0.05),),
    "sensor offset": (_extension("offset", Scale.NORMAL, 0.0, 0.5, -2.0, 2.0),),
    "sensor saturation": (_extension("ceiling", Scale.LOG, 10.0, 0.1, 5.0, 15.0),),
    "pump lag": (_extension("lag", Scale.HALF, 0.0, 10.0, 0.0, 100.0),),
}


@dataclass(frozen=True)
class Tanks:
    """The tanks under the pump's voltage (N,), one sample every 4 s; `held`: fixed values by name."""

    voltage: Array
    parameters: tuple[Parameter, ...] = BASE
    held: Mapping[str, float] = field(default_factory=dict)

    def predict(self, values: Array) -> Array:
        """Return the sensor's reading (N, 1) in V."""
        known = (
            ABSENT
            | dict(self.held)
            | {parameter.name: value for parameter, value in zip(self.parameters, values, strict=True)}
        )
        return levels(self.voltage, np.array([known[name] for name in ORDER]))[:, None]

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """Return d sensor / d value, (N, 1, k), by central differences over a ten-thousandth of each spread."""
        columns = []
        for at, parameter in enumerate(self.parameters):
            if parameter.name in names:
                step = np.zeros_like(values)
                step[at] = STEP * parameter.stretch(parameter.standard(values[at]))
                columns.append((self.predict(values + step) - self.predict(values - step)) / (2.0 * step[at]))
        return np.stack(columns, axis=-1)

    def input_slopes(self, values: Array) -> Array:
        """Return no slopes, (N, 1, 0): the pump's voltage is exact."""
        return np.zeros((self.voltage.size, 1, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Tanks:
        """Return the tanks with these parameters: replaced where a name is known, added where not."""
        given = {parameter.name: parameter for parameter in parameters}
        kept = tuple(given.pop(parameter.name, parameter) for parameter in self.parameters)
        return replace(self, parameters=(*kept, *given.values()))


@njit(cache=True, error_model="numpy")
def _rates(first, second, inflow, values):
    """Return rates of both levels in V/s; water above a rim flows as over a weir.

    A level below zero drains nothing.
    """
    upper, lower = max(first, 0.0), max(second, 0.0)
    over_1, over_2 = max(first - values[6], 0.0), max(second - values[7], 0.0)
    weir_1, weir_2 = WEIR * over_1 * np.sqrt(over_1), WEIR * over_2 * np.sqrt(over_2)
    falling = np.sqrt(upper)
    out = values[2] * np.exp(values[9] * np.log(lower + 1e-12))
    above = values[3] * inflow - values[0] * falling - values[10] * upper - weir_1
    spilt = values[8] * values[1] / values[0] * weir_1
    return above, values[1] * falling + spilt - out - values[11] * lower - weir_2


@njit(cache=True, error_model="numpy")
def levels(voltage, values):
    """Return the sensor at each sample (N,) in V, by the classical Runge-Kutta method of 1 s; values in ORDER.

    The share `spill` of the upper overflow falls into the lower tank, in the ratio of the tanks' k2 to k1.
    """
    step = SAMPLE / SUBSTEPS
    first, second, inflow = values[4], values[5], voltage[0]
    reading = np.empty(voltage.size)
    keep = np.exp(-step / values[14]) if values[14] > 0.0 else 0.0
    for at in range(voltage.size):
        reading[at] = min(second + values[12], values[13])
        for _ in range(SUBSTEPS):
            inflow = voltage[at] + keep * (inflow - voltage[at])
            a1, a2 = _rates(first, second, inflow, values)
            b1, b2 = _rates(first + 0.5 * step * a1, second + 0.5 * step * a2, inflow, values)
            c1, c2 = _rates(first + 0.5 * step * b1, second + 0.5 * step * b2, inflow, values)
            d1, d2 = _rates(first + step * c1, second + step * c2, inflow, values)
            first += step / 6.0 * (a1 + 2.0 * b1 + 2.0 * c1 + d1)
            second += step / 6.0 * (a2 + 2.0 * b2 + 2.0 * c2 + d2)
    return reading
