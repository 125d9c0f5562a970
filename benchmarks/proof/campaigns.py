"""Campaigns of the bench: set points of five campaigns, their control accuracy, and the measured channels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from itertools import product

import numpy as np

from .plant.machine import CELSIUS, Array
from .plant.settings import RATED_SPEED, RPM, Settings

BAR = 1e5
ALL = ("Q_out", "Q_in", "Q_case", "torque")
INPUTS = ("speed", "ratio", "p_out", "p_in", "p_case", "T_in", "T_case")


@dataclass(frozen=True)
class Campaign:
    """Set points in the order of measurement; outputs and inputs with a sensor; points with traces.

    uncoupled: points beside which the torque meter is read without the pump.
    """

    name: str
    points: Settings
    outputs: tuple[str, ...] = ALL
    inputs: tuple[str, ...] = INPUTS
    traces: tuple[int, ...] = ()
    circuit: str = "closed"
    uncoupled: tuple[int, ...] = ()


@cache
def campaigns() -> dict[str, Campaign]:
    """All of them by name."""
    found = (
        Campaign("map", _map(), traces=(6, 27, 90, 111)),
        Campaign("ovens", _ovens()),
        Campaign("scattered", _scattered(90, 7)),
        Campaign("short", _charged(_scattered(60, 8)), inputs=tuple(one for one in INPUTS if one != "p_in")),
        Campaign("open circuit", _open(), circuit="open"),
        Campaign("no inlet meter", _scattered(140, 9), outputs=("Q_out", "Q_case", "torque")),
        Campaign("grid", _grid(), outputs=("Q_out", "Q_case", "torque")),
    )
    return {one.name: one for one in found}


def held(campaign: Campaign, rng: np.random.Generator) -> Settings:
    """The true points: near the set points, as accurately as a bench holds them."""
    points, count = campaign.points, campaign.points.speed.size
    spread: Mapping[str, float | Array] = {
        "speed": 1.0 * RPM,
        "p_out": 0.7 * BAR,
        "p_in": 0.004 * points.p_in,
        "p_case": 0.015 * BAR,
        "T_in": 0.7,
    }
    moved = {name: getattr(points, name) + sigma * rng.normal(size=count) for name, sigma in spread.items()}
    warmer = points.T_case - points.T_in
    return replace(points, **moved, T_case=moved["T_in"] + warmer + 0.4 * rng.normal(size=count))


def _map() -> Settings:
    """112 points: 4 strokes, 4 speeds, 7 pressures, one temperature, closed circuit."""
    speeds = (1000.0, 1367.0, 1733.0, 2100.0)
    return _settings(product((0.28, 0.51, 0.77, 1.0), speeds, range(75, 376, 50), (50.0,)))


def _ovens() -> Settings:
    """168 points: 3 inlet temperatures, 2 strokes, 4 speeds, 7 pressures."""
    warm = product((35.0, 50.0, 70.0), (0.5, 1.0), (400.0, 900.0, 1500.0, 2100.0), range(75, 376, 50))
    return _settings((stroke, speed, pressure, oven) for oven, stroke, speed, pressure in warm)


def _grid() -> Settings:
    """36 points over the range of an ordinary bench at one temperature: 3 strokes, 3 speeds, 4 pressures."""
    return _settings(product((0.2, 0.6, 1.0), (525.0, 1312.5, 2100.0), (58.5, 156.0, 253.5, 351.0), (50.0,)))


def _scattered(count: int, seed: int) -> Settings:
    """A Latin hypercube over stroke, speed, pressure, inlet temperature, charge and case pressure."""
    rng = np.random.default_rng(seed)
    share = np.stack([(rng.permutation(count) + rng.uniform(size=count)) / count for _ in range(6)], axis=1)
    low = np.array([0.2, 300.0, 50.0, 35.0, 15.0, 0.0])
    high = np.array([1.0, 2400.0, 380.0, 75.0, 30.0, 2.0])
    rows = low + share * (high - low)
    rows = rows[np.argsort(rows[:, 3], kind="stable")]
    rows[:, 0] = np.round(rows[:, 0], 4)
    found = _settings(tuple(row[:4]) for row in rows)
    return replace(found, p_in=rows[:, 4] * BAR, p_case=found.p_case + rows[:, 5] * BAR)


def _charged(points: Settings) -> Settings:
    """The same at one charge pressure."""
    return replace(points, p_in=np.full(points.speed.size, 25.0 * BAR))


def _open() -> Settings:
    """100 points out of a tank: 80 scattered, then the inlet throttled in steps at two speeds."""
    throttled = [(speed, bar) for speed in (1800.0, 2200.0) for bar in np.linspace(1.15, 0.7, 10)]
    steps = _settings((1.0, speed, 200.0, 45.0) for speed, _ in throttled)
    inlet = np.array([bar for _, bar in throttled]) * BAR
    steps = replace(steps, p_in=inlet, p_case=np.full(inlet.size, 1.1 * BAR))
    return _joined(_drawing(_scattered(80, 10)), steps)


def _joined(first: Settings, second: Settings) -> Settings:
    pairs = ((one.name, getattr(first, one.name), getattr(second, one.name)) for one in fields(Settings))
    return Settings(**{name: np.concatenate([one, other]) for name, one, other in pairs})


def _drawing(points: Settings) -> Settings:
    """The same out of a tank: inlet 0.8 to 1.5 bar absolute, case near the tank, up to 2300 rpm."""
    share = (points.p_in / BAR - 15.0) / 15.0
    speed = np.minimum(points.speed, 2300.0 * RPM)
    return replace(points, speed=speed, p_in=(0.8 + 0.7 * share) * BAR, p_case=(1.0 + 0.1 * points.p_case / BAR) * BAR)


def _settings(rows: Iterator[tuple[float, float, float, float]]) -> Settings:
    """Settings of rows of stroke, rpm, bar, degC; the case is warmer with larger losses."""
    stroke, rpm, bar, celsius = np.array(list(rows), dtype=float).T
    speed, p_out = rpm * RPM, bar * BAR
    load = speed / RATED_SPEED * (1.0 + p_out / 20.0e6)
    ones: Array = np.ones_like(stroke)
    inlet = celsius + CELSIUS
    return Settings(
        speed, stroke, p_out, 25.0 * BAR * ones, (1.30 + 0.04 * load) * BAR, inlet, inlet + 2.0 + 1.5 * load
    )
