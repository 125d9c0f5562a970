"""The cause of a loss of flow in a real rig, found from cycles with a concealed leak.

    python examples/uci_hydraulic/leak.py DATA [--picture FILE.png]

DATA: folder of the data (see rig.py). Cycles without a leak give flow, motor power and pressure over the oil's
temperature, which the cooler sets. The estimation engine compares cycles with a leak with them. Neither
displacement nor speed of the pump is known: the model describes the rig, by parabolas in viscosity.

Readings are means over the cycles of one setting of cooler, valve and accumulator. Flow, power and pressure may
have an offset from one day to another.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from rig import cycle_means

from reynolds import ISO_GRADES, Array, Oil, walther
from system import Addition, Channel, Observations, Parameter, Role, Scale, additions

LPM, BAR = 1e-3 / 60.0, 1e5
COOLERS = (3, 20, 100)  # %
GRADE = ISO_GRADES["ISO VG 46"]  # not stated; the grades differ little in ratios of viscosities
DENSITY = 860.0  # kg/m3
OIL = Oil(GRADE.kinematic_viscosity_40C, GRADE.kinematic_viscosity_100C, DENSITY, 1.6e9, 1900.0)
FLOW_COEFFICIENT = 0.61  # of a sharp orifice
PRESSURE, WARM = 155.0 * BAR, 318.15  # of the middle cooler
EFFICIENCY = 0.8  # of motor and pump together
SIGMA = (0.012 * LPM, 8.0, 0.25 * BAR)  # of a setting: scatter about the model without a leak
DAY = (0.01 * LPM, 15.0, 0.1 * BAR)  # one sigma of the offset between days
STEP = 1e-4  # of a spread, for slopes
LEAST = 5  # cycles that a mean of a setting needs


def _parameter(name: str, role: Role, scale: Scale, centre: float, spread: float) -> Parameter:
    lowest = 0.0 if scale is Scale.HALF else -np.inf
    return Parameter(name, role, scale, centre, spread, lowest, np.inf, None, "the rig's size")


def _shape(name: str, size: float, centre: float) -> tuple[Parameter, ...]:
    """Return a channel's value at the middle cooler, its slope and its curvature over viscosity."""
    return tuple(
        _parameter(f"{name}{power}", Role.BASE, Scale.NORMAL, centre * (power == 0), size) for power in range(3)
    )


BASE = (
    *_shape("flow", 1.0 * LPM, 8.0 * LPM),
    *_shape("power", 300.0, 2400.0),
    *_shape("pressure", 10 * BAR, PRESSURE),
    *(_parameter(f"day_{name}", Role.SENSOR, Scale.NORMAL, 0.0, size)
      for name, size in zip(("flow", "power", "pressure"), DAY, strict=True)),
    _parameter("resistance", Role.BASE, Scale.HALF, 0.0, 5.0 * BAR / LPM),
)  # fmt: skip
FREE_LAW = (
    _parameter("size", Role.EXTENSION, Scale.HALF, 0.0, 0.5 * LPM),
    _parameter("pressure_exponent", Role.EXTENSION, Scale.NORMAL, 0.75, 0.5),
    _parameter("viscosity_exponent", Role.EXTENSION, Scale.NORMAL, -0.5, 0.5),
)
EXTENSIONS: Mapping[str, tuple[Parameter, ...]] = {
    "leak through an orifice": (_parameter("area", Role.EXTENSION, Scale.HALF, 0.0, 5e-8),),
    "leak through a gap": (_parameter("gap", Role.EXTENSION, Scale.HALF, 0.0, 0.5 * LPM),),
    "smaller displacement": (_parameter("shrunk", Role.EXTENSION, Scale.HALF, 0.0, 0.05),),
    "gain of the flow meter": (_parameter("gain", Role.EXTENSION, Scale.NORMAL, 0.0, 0.05),),
    "zero of the flow meter": (_parameter("zero", Role.EXTENSION, Scale.NORMAL, 0.0, 0.5 * LPM),),
}
ABSENT = dict.fromkeys(("area", "gap", "shrunk", "gain", "zero", "size"), 0.0) | {
    "pressure_exponent": 0.5, "viscosity_exponent": 0.0,
}  # fmt: skip


@dataclass(frozen=True)
class Rig:
    """The rig at N settings: viscosity over that of the middle cooler, pressure in Pa, leak on (1) or off (0)."""

    viscosity: Array
    pressure: Array
    leaking: Array
    parameters: tuple[Parameter, ...] = BASE

    def predict(self, values: Array) -> Array:
        """Return flow in m3/s, motor power in W and pressure in Pa, (N, 3)."""
        has = ABSENT | {one.name: float(value) for one, value in zip(self.parameters, values, strict=True)}
        warm, load = self.viscosity - 1.0, self.pressure / PRESSURE
        flow, power, pressure = (
            has[f"{name}0"] + has[f"{name}1"] * warm + has[f"{name}2"] * warm**2
            for name in ("flow", "power", "pressure")
        )
        law = has["size"] * load ** has["pressure_exponent"] * self.viscosity ** has["viscosity_exponent"]
        orifice = FLOW_COEFFICIENT * has["area"] * np.sqrt(2.0 * self.pressure / DENSITY)
        lost = orifice + has["gap"] * load / self.viscosity + has["shrunk"] * flow + law
        saved = has["shrunk"] * flow * self.pressure / EFFICIENCY
        missing = lost + has["gain"] * flow + has["zero"]
        changes = (has["day_flow"] - missing, has["day_power"] - saved, has["day_pressure"] - has["resistance"] * lost)
        both = zip((flow, power, pressure), changes, strict=True)
        return np.stack([sound + self.leaking * change for sound, change in both], axis=1)

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """Return d readings / d value, (N, 3, k), by central differences."""
        columns = []
        for at, one in enumerate(self.parameters):
            if one.name in names:
                step = np.zeros_like(values)
                step[at] = STEP * one.spread
                columns.append((self.predict(values + step) - self.predict(values - step)) / (2.0 * step[at]))
        return np.stack(columns, axis=-1)

    def input_slopes(self, values: Array) -> Array:
        """Return no slopes, (N, 3, 0): errors of temperature and pressure are negligible."""
        return np.zeros((self.viscosity.size, 3, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Rig:
        """Return the rig with these parameters added."""
        return replace(self, parameters=(*self.parameters, *parameters))


def settings(data: Path, leak: int) -> Array:
    """Return means over the cycles of each setting, rows of p bar, Q L/min, P W, T degC."""
    found = []
    for cooler in COOLERS:
        rows = cycle_means(data, leak, cooler)
        groups = (rows[rows[:, 0] == one, 1:] for one in np.unique(rows[:, 0]))
        found += [group.mean(axis=0) for group in groups if len(group) >= LEAST]
    return np.stack(found)


def rig_of(sound: Array, leaking: Array) -> tuple[Rig, Observations]:
    """Return the rig and its readings: settings without a leak, then those with one."""
    pressure, flow, power, celsius = np.concatenate([sound, leaking]).T
    viscosity = walther(celsius + 273.15, OIL) / walther(WARM, OIL)
    leak = np.repeat([0.0, 1.0], [len(sound), len(leaking)])
    read = Observations(
        channels=tuple(Channel(one, None) for one in ("Q_out", "power", "p_out")),
        values=np.stack([flow * LPM, power, pressure * BAR], axis=1),
        sigma=np.tile(SIGMA, (leak.size, 1)),
        inputs=(),
        input_sigma=np.zeros((leak.size, 0)),
        quantum=np.zeros(3),
        blocks=np.arange(leak.size),
    )
    return Rig(viscosity, pressure * BAR, leak), read


def explanations(data: Path, leak: int) -> tuple[Addition, ...]:
    """Return every explanation of the cycles with this leak, the one of greatest evidence first."""
    return additions(*rig_of(settings(data, 0), settings(data, leak)), EXTENSIONS).tried


def free_law(data: Path, leak: int) -> Addition:
    """Return the fit of a leak ~ p^k nu^m, k and m free."""
    rig, read = rig_of(settings(data, 0), settings(data, leak))
    return additions(rig, read, {"leak by a free law": FREE_LAW}).tried[0]


def diameter(area: float) -> float:
    """Return the diameter in m of a round orifice of this area in m2."""
    return float(np.sqrt(4.0 * area / np.pi))


def main(words: Sequence[str]) -> None:
    """Print explanations of each leak, the orifice's diameter, and the exponents of a free law."""
    data, gains = Path(words[0]), {}
    for leak in (1, 2):
        found = explanations(data, leak)
        gains[f"leak {leak}"] = {each.name: each.gain for each in found}
        print(f"leak {leak}: ln evidence over no change")
        for each in found:
            print(f"  {each.name:26s} {each.gain:9.1f}")
        orifice = next(each for each in found if each.name == "leak through an orifice")
        area, sigma = orifice.size("area")
        print(f"  orifice {1e3 * diameter(area):.3f} +- {500 * diameter(area) * sigma / area:.3f} mm")
        law = free_law(data, leak)
        for name in ("viscosity_exponent", "pressure_exponent"):
            print("  {} {:.2f} +- {:.2f}".format(name.replace("_", " "), *law.size(name)))

    if words[1:2] == ["--picture"]:
        draw(gains, words[2])


def draw(gains: Mapping[str, Mapping[str, float]], picture: str) -> None:
    """Draw the evidence of each explanation of each leak."""
    figure = Figure(figsize=(9.0, 2.8), layout="constrained")
    for axes, (leak, own) in zip(figure.subplots(1, len(gains), sharey=True), gains.items(), strict=True):
        names = list(next(iter(gains.values())))[::-1]
        axes.barh(names, [own[name] for name in names])
        axes.set(title=leak, xlabel="ln evidence over no change [nats]")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1:])
