"""The plant: the pump with floating films of all physics, solved directly at the points of a campaign, not by table."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from system.points.floating import floating_point
from system.points.floating_gaps import usual_options
from system.pump.operating import OperatingPoint, operating_point

from ..campaigns import Campaign
from ..film_plant import ATMOSPHERE, COLUMNS
from ..plant.bench import Truth
from ..plant.losses import Losses
from ..plant.machine import CELSIUS, Array
from ..plant.settings import RPM, Settings
from ..sensors import Readings, read
from .films import pump

KEPT = Path(__file__).resolve().parent / "truth.csv"
POINTS, EVERY, SEED = 40, 2, 11
SPEED, PRESSURE = (1030.0, 2140.0), (5.3, 24.3)  # r/min, MPa
INLET_COOLER = 2.0  # K


def set_points() -> Array:
    """Rows (N, 2) of r/min and MPa: every second of a Latin hypercube, in the order of the speed."""
    rng = np.random.default_rng(SEED)
    share = np.stack([(rng.permutation(POINTS) + rng.uniform(size=POINTS)) / POINTS for _ in range(2)], axis=1)
    low, high = np.array([SPEED[0], PRESSURE[0]]), np.array([SPEED[1], PRESSURE[1]])
    rows = low + share * (high - low)
    return rows[np.argsort(rows[:, 0])][::EVERY]


def point_at(row: Array) -> OperatingPoint:
    """The operating point of a row."""
    return operating_point(pump(), shaft_speed=float(row[0]) * RPM, delivery_pressure=1e6 * float(row[1]))


def solved(row: Array) -> tuple[float, float, float, float]:
    """True readings at a row of `set_points`: delivery, inlet, drain L/min, torque N m; raises NotConverged."""
    bench = floating_point(pump(), point_at(row), usual_options(pump().pump.pistons)).pump_point.bench
    return 6e4 * bench.delivery_flow, 6e4 * bench.inlet_flow, 6e4 * bench.drain_flow, bench.shaft_torque


def keep(rows: list[tuple[float, ...]]) -> None:
    """Write the truths (COLUMNS), points in the order of `set_points`."""
    with KEPT.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        table.writerows([[f"{value:.8g}" for value in row] for row in rows])


def truth_row(row: Array) -> tuple[float, ...]:
    """A row of the file: the point and its true readings."""
    return float(row[0]), 1.0, float(row[1]), pump().operating.temperature - CELSIUS, *solved(row)


def readings(seed: int) -> tuple[Campaign, Readings]:
    """Readings of the plant by the bench's sensors, calibrations and noise drawn by the seed."""
    rows = np.loadtxt(KEPT, delimiter=",", skiprows=1)
    rpm, stroke, pressure, warmth, out, drawn, drain, torque = rows.T
    ones, own = np.ones(len(rows)), pump().operating
    at = Settings(
        rpm * RPM, stroke, 1e6 * pressure + ATMOSPHERE, (own.inlet_pressure + ATMOSPHERE) * ones,
        (own.case_pressure + ATMOSPHERE) * ones, warmth + CELSIUS - INLET_COOLER, warmth + CELSIUS,
    )  # fmt: skip
    none = Losses(*np.zeros((4, len(rows))))
    truth = Truth(out / 6e4, drawn / 6e4, drain / 6e4, torque, np.zeros(1), np.zeros((len(rows), 1)), none)
    campaign = Campaign("floating films", at)
    return campaign, read(campaign, at, truth, (), np.random.default_rng(seed))
