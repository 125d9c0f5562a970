"""Recordings whose plant is the film simulation: the fidelity proof.

A point is the fidelity fixed (`system.points.films.films_point`): three gaps solved on meshes over the turn, parts
at the places that the pump file gives, with one piece of film physics that the lumped simulation leaves out. A
point takes half a second to two, a warm one ten, so that the true readings are kept beside this file; sensors read
them as those of the other plant.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum
from itertools import product
from pathlib import Path

import numpy as np

from gaps.films.physics import Effect
from reynolds.errors import FilmNotConverged, InputError
from reynolds.laws.oil import walther
from system.films.cycle import PLAIN, SMOOTH, GapPhysics
from system.points.films import films_point
from system.pump.operating import operating_point
from system.pump_file.file import load_pump

from .campaigns import Campaign
from .plant.bench import Truth
from .plant.losses import Losses
from .plant.machine import CELSIUS, Array
from .plant.settings import RPM, Settings
from .sensors import Readings, read
from .writing import BENCH

KEPT = Path(__file__).resolve().parent / "film_truths"
ATMOSPHERE = 101325.0
POSITIONS, ONE_ROUND = 2, 0.5  # a piston pitch; films at the lumped chamber's pressure, which leakage hardly moves
COLUMNS = (
    "speed_rpm", "displacement_ratio", "p_out_MPa_gauge", "T_case_degC", "Q_out_lpm", "Q_in_lpm", "Q_case_lpm",
    "torque_Nm",
)  # fmt: skip
SPEEDS, PRESSURES, WARMTHS = (600, 1000, 1500, 2100), (6, 12, 18, 24, 30, 35), (42, 60)
INLET, CASE = 2.5e6, 0.15e6  # Pa gauge
SEED = 7


class FilmCase(Enum):
    """Physics of the plant's films beyond rigid walls and oil at the case's temperature and any pressure."""

    RIGID = "rigid"
    VISCOSITY_PRESSURE = "viscosity_pressure"
    ELASTIC_SLIPPER = "elastic_slipper"
    WARM = "warm"
    ELASTIC_AND_WARM = "elastic_and_warm"


@dataclass(frozen=True)
class FilmPlant:
    """One of them: the right verdict, id and gap if it acts in one; physics; mesh; points."""

    case: FilmCase
    concealed: tuple[tuple[str, str | None], ...]
    physics: GapPhysics
    finer: float
    points: int


def cases() -> tuple[FilmPlant, ...]:
    """All plants, the one without additional physics first."""
    stiff, warm = SMOOTH.including(Effect.PRESSURE_VISCOSITY), SMOOTH.including(Effect.HEAT)
    soft, both = SMOOTH.including(Effect.ELASTIC_WALLS), warm.including(Effect.ELASTIC_WALLS)
    opens, heats = ("elastic_opening", "slipper"), ("film_heating", None)
    return (
        FilmPlant(FilmCase.RIGID, (), PLAIN, 0.5, 48),
        FilmPlant(FilmCase.VISCOSITY_PRESSURE, (("viscosity_pressure", None),), GapPhysics.alike(stiff), 0.5, 48),
        FilmPlant(FilmCase.ELASTIC_SLIPPER, (opens,), GapPhysics(slipper=soft), 0.5, 44),
        FilmPlant(FilmCase.WARM, (heats,), GapPhysics.alike(warm), 0.5, 48),
        FilmPlant(FilmCase.ELASTIC_AND_WARM, (heats, opens), GapPhysics(warm, both, warm), 0.5, 48),
    )


def set_points(count: int) -> Array:
    """Rows (count, 4) of rpm, stroke, MPa, degC at full stroke: evenly from a grid, as accurate as a bench."""
    rng = np.random.default_rng(SEED)
    grid = list(product(WARMTHS, SPEEDS, PRESSURES))
    rows = []
    for k in np.linspace(0, len(grid) - 1, count).round().astype(int):
        warmth, speed, pressure = grid[k]
        warmer = 0.12 * pressure * rng.uniform(0.6, 1.4) + 2e-3 * speed
        held = speed * (1.0 + 1e-3 * rng.standard_normal()), pressure + 0.3 * rng.standard_normal()
        rows.append((held[0], 1.0, held[1], warmth + warmer))
    return np.array(rows)


def solved(plant: FilmPlant, row: Array) -> tuple[float, float, float, float]:
    """True readings of a plant at a row of `set_points`: delivery, inlet, drain L/min, torque N m."""
    pump = load_pump(BENCH)
    rpm, stroke, pressure, warmth = map(float, row)
    kelvin = warmth + CELSIUS
    point = replace(
        operating_point(pump), shaft_speed=rpm * RPM, displacement_ratio=stroke, delivery_pressure=1e6 * pressure,
        inlet_pressure=INLET, case_pressure=CASE, temperature=kelvin,
        viscosity=float(walther(kelvin, pump.oil.fluid) * pump.oil.density),
    )  # fmt: skip
    bench = films_point(
        pump, point, physics=plant.physics, positions_per_pitch=POSITIONS, finer=plant.finer, tolerance=ONE_ROUND
    ).pump_point.bench
    return 6e4 * bench.delivery_flow, 6e4 * bench.inlet_flow, 6e4 * bench.drain_flow, bench.shaft_torque


def made(plant: FilmPlant) -> Iterator[tuple[float, ...]]:
    """The rows of a plant's file, point by point; one without a solution of a film is left out and reported."""
    for row in set_points(plant.points):
        try:
            yield *map(float, row), *solved(plant, row)
        except (InputError, FilmNotConverged) as reason:
            print(f"{plant.case.value}: left out {row}: {reason}", flush=True)


def make(plant: FilmPlant) -> None:
    """Solve a plant and keep its file."""
    KEPT.mkdir(exist_ok=True)
    with (KEPT / f"{plant.case.value}.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for row in made(plant):
            table.writerow([f"{value:.8g}" for value in row])
            file.flush()


def truths(plant: FilmPlant) -> Array:
    """The kept rows (N, 8) of a plant, in the order of COLUMNS."""
    return np.loadtxt(KEPT / f"{plant.case.value}.csv", delimiter=",", skiprows=1)


def readings(plant: FilmPlant, seed: int) -> tuple[Campaign, Readings]:
    """Readings of a plant by the bench's sensors, calibrations and noise drawn by the seed."""
    rows = truths(plant)
    rpm, stroke, pressure, warmth, out, drawn, drain, torque = rows.T
    none = Losses(*np.zeros((4, len(rows))))
    ones, kelvin = np.ones(len(rows)), warmth + CELSIUS
    at = Settings(
        rpm * RPM, stroke, 1e6 * pressure + ATMOSPHERE, (INLET + ATMOSPHERE) * ones, (CASE + ATMOSPHERE) * ones,
        kelvin - 8.0, kelvin,
    )  # fmt: skip
    truth = Truth(out / 6e4, drawn / 6e4, drain / 6e4, torque, np.zeros(1), np.zeros((len(rows), 1)), none)
    campaign = Campaign(plant.case.value, at)
    return campaign, read(campaign, at, truth, (), np.random.default_rng(seed))
