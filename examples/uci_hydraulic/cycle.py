"""Changes in a real rig: causes found from the difference of two mean working cycles.

    python examples/uci_hydraulic/cycle.py DATA [--cooler 20] [--valve 73] [--leak 1] [--accumulator 90]
        [--picture FILE.png]

DATA: folder of the data (see rig.py). The rig repeats a cycle of 60 s. The pump works against its relief valve; a
directional valve opens; the load pressure takes five levels. The mean cycle of the sound rig gives the model. The
estimation engine explains the difference between it and the mean cycle of another state, whose settings it does not
know, by additions to the model, one after the other.

    p(t): first-order approach to the level of each phase, slower with more gas
    Q = q0 + q1 (p - p0) - (c + V p0 / p^2) dp/dt        c, V: compliance of the oil and of the accumulator's gas
    P = e0 + e1 (p - p0), read by a meter with a lag

Readings are means over one second. A law is good to a tenth of the difference. From one state to another pressure,
flow, power and temperature may have an offset; what the oil's temperature changes is free.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from rig import ACCUMULATOR, COOLER, LEAK, UNSTABLE, VALVE, WORKING
from scipy.signal import lfilter

from reynolds import Array
from system import (
    Channel,
    FitLimits,
    FunctionSimulator,
    Ladder,
    Observations,
    Parameter,
    Role,
    Scale,
    ladder,
    maximum_posterior,
)

LPM, BAR = 1e-3 / 60.0, 1e5
CHANNELS = {"PS1": BAR, "FS1": LPM, "EPS1": 1.0, "TS1": 1.0}
FIRST = 2  # s of a cycle: before it the load of the last cycle is still falling
SECONDS = 60 - FIRST
STEP = 0.02  # s
EDGES = FIRST + STEP * np.arange(round(SECONDS / STEP) + 1)
FLOWING = slice(30, 58)  # s in which a working rig has flow
PRESSURE = 155.0 * BAR
DENSITY, FLOW_COEFFICIENT = 860.0, 0.61
FORM = 0.1  # of a difference: one sigma of its law
READ = (0.1 * BAR, 0.02 * LPM, 5.0, 0.1)  # one sigma of a mean reading about the model of the sound cycle
SAME = (0.02 * BAR, 0.01 * LPM, 2.0, 0.05)  # of a difference, where nothing has changed
LEAST = 4  # cycles of a mean
LIMITS = FitLimits(stall=10.0)  # phases begin at kinks: the last nats are out of reach
STARTS = ("opening", "start_2", "start_3", "start_4", "start_5")
LEVELS = tuple(f"level_{phase}" for phase in range(1, 6))


def _parameter(name: str, role: Role, scale: Scale, centre: float, spread: float, highest: float = np.inf) -> Parameter:
    lowest = -np.inf if scale is Scale.NORMAL else 0.0
    return Parameter(name, role, scale, centre, spread, lowest, highest, None, "the rig's size")


def _base(name: str, centre: float, spread: float) -> Parameter:
    return _parameter(name, Role.BASE, Scale.NORMAL, centre, spread)


def _size(name: str, centre: float, spread: float) -> Parameter:
    return _parameter(name, Role.BASE, Scale.LOG, centre, spread)


CYCLE = (
    _base("relief", 191.0 * BAR, 5.0 * BAR),
    *(_base(name, PRESSURE, 10.0 * BAR) for name in LEVELS),
    *(_base(name, at, 0.5) for name, at in zip(STARTS, (9.5, 19.0, 29.0, 39.0, 49.0), strict=True)),
    _size("fall", 0.3, 0.5),
    _size("approach", 0.2, 0.5),
    _base("flow", 8.0 * LPM, 1.0 * LPM),
    _base("flow_slope", 0.0, 0.02 * LPM / BAR),
    _size("oil", 1e-6 / BAR, 1.0),
    _size("gas", 250e-6, 1.0),
    _base("power", 2400.0, 300.0),
    _base("power_slope", 10.0 / BAR, 5.0 / BAR),
    _size("power_lag", 0.2, 0.7),
)
"""Parameters of the sound cycle, SI."""
OFFSET = {
    "relief": 0.15 * BAR, **dict.fromkeys(LEVELS, 0.1 * BAR), "opening": 0.01, "flow": 0.015 * LPM, "power": 15.0,
    "warmth": 1.0,
}  # fmt: skip
"""One sigma of the offset from one state to another."""
BY_WARMTH = {
    "relief": 0.3 * BAR, "load": 0.3 * BAR, "flow": 0.02 * LPM, "power": 10.0, "idle_power": 10.0, "opening": 5e-3,
    "approach": 0.02,
}  # fmt: skip
"""One sigma of what one kelvin changes; of `approach` relative."""
NUISANCES = (
    *(_base(f"offset_{name}", 0.0, sigma) for name, sigma in OFFSET.items()),
    *(_base(f"{name}_by_warmth", 0.0, sigma) for name, sigma in BY_WARMTH.items()),
    _parameter("resistance", Role.BASE, Scale.HALF, 0.0, 5.0 * BAR / LPM),
)


def _extra(name: str, spread: float, highest: float = np.inf) -> tuple[Parameter, ...]:
    return (_parameter(name, Role.EXTENSION, Scale.HALF, 0.0, spread, highest),)


def _meter(name: str, spread: float) -> tuple[Parameter, ...]:
    return (_parameter(name, Role.SENSOR, Scale.NORMAL, 0.0, spread),)


POSSIBLE: Mapping[str, tuple[Parameter, ...]] = {
    "valve opens later": _extra("delay", 0.2, 3.0),
    "accumulator with less gas": _extra("lost_gas", 0.3, 1.0),
    "leak through an orifice": _extra("leak", 5e-8),
    "cooler removes less heat": _extra("warmer", 10.0),
    "smaller displacement": _extra("smaller", 0.05, 0.9),
    "more friction of motor and pump": _extra("friction", 100.0),
    "zero of the thermometer": _meter("TS1_zero", 2.0),
    "gain of the flow meter": _meter("FS1_gain", 0.05),
    "zero of the flow meter": _meter("FS1_zero", 0.2 * LPM),
    "lag of the flow meter": _extra("FS1_lag", 0.3, 5.0),
    "gain of the pressure meter": _meter("PS1_gain", 0.01),
    "zero of the pressure meter": _meter("PS1_zero", 1.0 * BAR),
    "gain of the power meter": _meter("EPS1_gain", 0.02),
}


@dataclass(frozen=True)
class Cycle:
    """Parameters by name, SI; one that a model does not have is zero."""

    values: Mapping[str, float]

    def __getitem__(self, name: str) -> float:
        """Return a value."""
        return self.values.get(name, 0.0)

    @property
    def warmth(self) -> float:
        """K, of the oil over that of the sound rig."""
        return self["warmer"] + self["offset_warmth"]

    def shifted(self, name: str) -> float:
        """Return the offset of a quantity, with what the oil's warmth adds."""
        return self[f"offset_{name}"] + self.warmth * self[f"{name}_by_warmth"]

    @property
    def starts(self) -> Array:
        """(5,), s, of the phases."""
        later = self["delay"] + self.shifted("opening")
        return np.array([self[name] for name in STARTS]) + np.array([later, 0.0, 0.0, 0.0, 0.0])

    def compliance(self, pressure: Array) -> Array:
        """Return dV/dp (N,) in m3/Pa of oil and isothermal gas."""
        gas = self["gas"] * (1.0 - self["lost_gas"])
        return self["oil"] + gas * PRESSURE / pressure**2

    def leak(self, pressure: Array) -> Array:
        """Return the flow (N,) through the concealed orifice, of an area in m2."""
        return FLOW_COEFFICIENT * self["leak"] * np.sqrt(2.0 * pressure / DENSITY)

    @cached_property
    def course(self) -> Array:
        """Pressure at EDGES, Pa. A smaller flow through the load's resistance lowers its levels."""
        sound = np.array([self[name] for name in LEVELS])
        lost = self["smaller"] * self["flow"] + self.leak(sound)
        offsets = np.array([self[f"offset_{name}"] for name in LEVELS])
        levels = sound + offsets + self.warmth * self["load_by_warmth"] - self["resistance"] * lost
        full = Cycle({**self.values, "lost_gas": 0.0}).compliance(np.array([PRESSURE]))[0]
        slower = self.compliance(np.array([PRESSURE]))[0] / full * np.exp(self.shifted("approach"))
        times = np.where(np.arange(5) == 0, self["fall"], self["approach"]) * slower
        course = np.full(EDGES.size, self["relief"] + self.shifted("relief"))
        for start, level, time in zip(self.starts, levels, times, strict=True):
            after = start < EDGES
            before = course[max(int(np.argmax(after)) - 1, 0)]
            course[after] = level + (before - level) * np.exp(-(EDGES[after] - start) / time)
        return course

    def readings(self) -> Array:
        """Return PS1 Pa, FS1 m3/s, EPS1 W, TS1 K over the sound rig's, (58, 4), means over each second."""
        pressure, slope = 0.5 * (self.course[1:] + self.course[:-1]), np.diff(self.course) / STEP
        is_open = np.clip((EDGES[1:] - self.starts[0]) / STEP, 0.0, 1.0)
        flow = self["flow"] * (1.0 - self["smaller"]) + self["flow_slope"] * (pressure - PRESSURE)
        flow += self.shifted("flow") - self.leak(pressure) - self.compliance(pressure) * slope
        power = self["power"] + self["power_slope"] * (pressure - PRESSURE) + self["friction"] + self["offset_power"]
        warm = self["power_by_warmth"] * is_open + self["idle_power_by_warmth"] * (1.0 - is_open)
        power += self.warmth * warm - self["smaller"] * self["flow"] * pressure
        truth = (
            pressure * (1.0 + self["PS1_gain"]) + self["PS1_zero"],
            _lagging(flow * is_open, self["FS1_lag"]) * (1.0 + self["FS1_gain"]) + self["FS1_zero"],
            _lagging(power, self["power_lag"]) * (1.0 + self["EPS1_gain"]),
            np.full(pressure.size, self.warmth + self["TS1_zero"]),
        )
        return np.stack(truth, axis=1).reshape(SECONDS, -1, len(truth)).mean(axis=1)


def _lagging(course: Array, lag: float) -> Array:
    """Reading of a course by a meter with a first-order lag in s, settled at its beginning."""
    keep = np.exp(-STEP / lag) if lag > 0.0 else 0.0
    return course[0] + np.asarray(lfilter([1.0 - keep], [1.0, -keep], course - course[0]))


@dataclass(frozen=True)
class State:
    """Settings of the rig: cooler %, valve %, leak 0 to 2, accumulator bar."""

    cooler: int = 100
    valve: int = 100
    leak: int = 0
    accumulator: int = 130


SOUND = State()


class TooFew(ValueError):
    """A state has too few cycles for a mean."""


@dataclass(frozen=True)
class Mean:
    """Mean of several cycles and its standard error, both (58, 4), SI."""

    readings: Array
    error: Array


@dataclass(frozen=True)
class Recorded:
    """All stable cycles of the rig in which it works: settings (n, 5) and readings (n, 58, 4) in SI."""

    settings: Array
    readings: Array

    def mean(self, state: State, chosen: slice) -> Mean:
        """Return the mean of the chosen cycles of a state. Raises TooFew."""
        wanted = ((COOLER, state.cooler), (VALVE, state.valve), (LEAK, state.leak), (ACCUMULATOR, state.accumulator))
        own = self.readings[np.all([self.settings[:, at] == value for at, value in wanted], axis=0)][chosen]
        if len(own) < LEAST:
            raise TooFew(f"{state}: {len(own)} stable cycles in which the rig works, {LEAST} are needed")
        return Mean(own.mean(axis=0), own.std(axis=0, ddof=1) / np.sqrt(len(own)))


def recorded(data: Path) -> Recorded:
    """Return the cycles of a folder."""
    settings = np.loadtxt(data / "profile.txt")
    found = {name: np.loadtxt(data / f"{name}.txt.gz") * unit for name, unit in CHANNELS.items()}
    works = (settings[:, UNSTABLE] == 0) & (found["FS1"][:, FLOWING].mean(axis=1) >= WORKING * LPM)
    return Recorded(settings[works], np.stack([rows[works, FIRST:] for rows in found.values()], axis=2))


def explained(data: Recorded, state: State) -> tuple[Ladder, tuple[float, float]]:
    """Return what the rig lacks in a state beside the sound one, and the root mean square error, in sigma, of cycles
    of this state that were not fitted, before and after.
    """
    sound = data.mean(SOUND, slice(None))
    values = _model(sound.readings)
    here = Cycle(values).readings()
    fitted, kept_apart = (_difference(sound, data.mean(state, slice(half, None, 2))) for half in (0, 1))
    found = ladder(FunctionSimulator(partial(_change, values, here), NUISANCES), fitted, POSSIBLE, limits=LIMITS)
    errors = ((kept_apart.values - fit.predictions) / kept_apart.sigma for fit in (found.before, found.fit))
    before, after = (float(np.sqrt(np.nanmean(error**2))) for error in errors)
    return found, (before, after)


def _difference(sound: Mean, other: Mean) -> Observations:
    """Readings of a state less those of the sound rig."""
    difference = other.readings - sound.readings
    difference[:, 3] = np.where(np.arange(SECONDS) == 0, difference[:, 3].mean(), np.nan)
    squares = sound.error**2 + other.error**2 + (FORM * np.nan_to_num(difference)) ** 2 + np.square(SAME)
    return _observed(difference, np.sqrt(squares))


def _change(sound: Mapping[str, float], here: Array, values: Mapping[str, float]) -> Array:
    """The readings (58, 4) with further values, over those of the sound rig."""
    return Cycle({**sound, **values}).readings() - here


def _model(sound: Array) -> dict[str, float]:
    """Values of CYCLE by name, fitted to the mean cycle of the sound rig."""
    over = sound - np.array([0.0, 0.0, 0.0, sound[:, 3].mean()])
    read = _observed(over, np.tile(READ, (SECONDS, 1)))
    fit = maximum_posterior(FunctionSimulator(lambda values: Cycle(values).readings(), CYCLE), read)
    return {one.name: float(value) for one, value in zip(fit.parameters, fit.values, strict=True)}


def _observed(values: Array, sigma: Array) -> Observations:
    """Readings (58, 4) with their noise; a tenth of the cycle is one block."""
    return Observations(
        channels=tuple(Channel(name, None) for name in CHANNELS),
        values=values,
        sigma=sigma,
        inputs=(),
        input_sigma=np.zeros((SECONDS, 0)),
        quantum=np.zeros(len(CHANNELS)),
        blocks=np.arange(SECONDS) * 10 // SECONDS,
    )


def size(found: Ladder, name: str) -> str:
    """Return the size of an addition with its unit: of an orifice its diameter."""
    parameter = POSSIBLE[name][0].name
    value = float(found.fit.values[found.fit.index(parameter)])
    sigma = found.fit.sigma(parameter)
    if parameter == "leak":
        bore = np.sqrt(4.0 * value / np.pi)
        return f"{1e3 * bore:.3f} +- {500.0 * bore * sigma / value:.3f} mm"
    unit, scale = UNITS[parameter]
    return f"{value / scale:.3g} +- {sigma / scale:.1g} {unit}"


UNITS = {
    "delay": ("s", 1.0), "lost_gas": ("%", 0.01), "warmer": ("K", 1.0), "smaller": ("%", 0.01), "friction": ("W", 1.0),
    "TS1_zero": ("K", 1.0), "FS1_gain": ("%", 0.01), "FS1_zero": ("L/min", LPM), "FS1_lag": ("s", 1.0),
    "PS1_gain": ("%", 0.01), "PS1_zero": ("bar", BAR), "EPS1_gain": ("%", 0.01),
}  # fmt: skip


def main(words: Sequence[str]) -> None:
    """Print what was tried, what is kept, and how well each tenth of the cycle is predicted."""
    parser = argparse.ArgumentParser(description="Causes of a change in the cycle of the ZeMA rig.")
    parser.add_argument("data", type=Path)
    for name, choices in (("cooler", (20, 100)), ("valve", (73, 80, 90, 100)), ("leak", (0, 1, 2))):
        parser.add_argument(f"--{name}", type=int, choices=choices, default=getattr(SOUND, name))
    parser.add_argument("--accumulator", type=int, choices=(90, 100, 115, 130), default=SOUND.accumulator)
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args(words)
    state = State(asked.cooler, asked.valve, asked.leak, asked.accumulator)
    data = recorded(asked.data)
    try:
        found, errors = explained(data, state)
    except TooFew as reason:
        raise SystemExit(str(reason)) from reason
    for rung in found.rungs:
        print("; ".join(f"{one.name} {one.gain:+.0f}" for one in rung.tried[:4]), "nats")
        for failure in rung.failed:
            print(f"not fitted: {failure}")
    for name in found.kept:
        rivals = found.rivals(name)
        print(f"kept: {name}, {size(found, name)}" + (f", not told from {', '.join(rivals)}" if rivals else ""))
    print("cycles of this state that were not fitted: {:.2f} -> {:.2f} sigma".format(*errors))

    if asked.picture:
        change = _difference(data.mean(SOUND, slice(None)), data.mean(state, slice(0, None, 2))).values
        draw(change, found, asked.picture)


def draw(change: Array, found: Ladder, picture: Path) -> None:
    """Draw the change of pressure, flow and power over the mean cycle, as read and as explained."""
    figure = Figure(figsize=(8.0, 5.2), layout="constrained")
    panels = figure.subplots(3, 1, sharex=True)
    shown = zip(panels, (BAR, LPM, 1.0), ("pressure [bar]", "flow [L/min]", "power [W]"), strict=True)
    for column, (axes, unit, name) in enumerate(shown):
        axes.plot(FIRST + np.arange(SECONDS), change[:, column] / unit, ".", color="#888888", label="read")
        axes.plot(FIRST + np.arange(SECONDS), found.fit.predictions[:, column] / unit, label=", ".join(found.kept))
        axes.set(ylabel=name)
    panels[0].set(title="change from the mean cycle of the sound rig")
    panels[0].legend(fontsize="small")
    panels[-1].set(xlabel="time in the cycle [s]")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1:])
