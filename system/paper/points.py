"""Operating points of the figures of Xu, Hu, Zhang and Mao (2017), each solved once by a fidelity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from enum import Enum
from typing import Any

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import content_key
from system.description.pump import PumpDescription
from system.inputs.shown import pressure_text
from system.inputs.units import RPM
from system.paper.figure import Figure
from system.paper.film_records import films_record
from system.points.films import films_point
from system.points.floating_gaps import FloatingOptions
from system.points.lumped import lumped_point
from system.points.table.sources import FloatingRow, FloatingSolver
from system.pump.assembly import PumpPoint
from system.pump.bench import BenchReading, LossSplit, paper_efficiency, paper_losses
from system.pump.laws.friction_pairs import Pair
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.file import resolved_toml
from system.work.kept_results import KeptPoints, run_kept
from system.work.progress import Report, silent
from system.work.tasks import Executor, PartStatus, Record

POINT_FORMAT = 2
"""Raised when the same point gives other numbers: by its laws, or by the kept numbers."""
KEY_LENGTH = 24
SPEEDS = tuple(RPM * speed for speed in (1000.0, 1300.0, 1700.0, 2100.0))
PRESSURES = tuple(1e6 * pressure for pressure in (5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0))
RATIOS = (0.13, 0.28, 0.51, 0.77, 1.0)
"""The paper's levels: speed rad/s, delivery pressure Pa gauge, displacement ratio; 13 % in Figs. 2, 3 and 20."""
RATED = SPEEDS[-1]
FULL = RATIOS[-1]
NEAR_ZERO = 5e5
"""Pressure difference (Pa) assumed for the "near 0" at which Case 2 of Fig. 3 begins."""


class LossReading(Enum):
    """Reading of a pair's loss.

    WITH_SHEAR: shear of the film beside a Coulomb coefficient, REF90's loss model, or beside the contact that balance
    of forces leaves. MIXED: coefficients alone, as in the paper, whose coefficients contain the film's shear too; the
    shaft's torque then lacks the shear.
    """

    WITH_SHEAR = "with shear"
    MIXED = "mixed coefficients alone"


class PaperFidelity(Enum):
    """Fidelity of the paper's numbers: films of given thickness, solved at given positions, or floating."""

    LUMPED = "lumped"
    FIXED = "fixed"
    FLOATING = "floating"

    @property
    def readings(self) -> tuple[LossReading, ...]:
        """Readings of its losses: floating films have no coefficients."""
        return (LossReading.WITH_SHEAR,) if self is PaperFidelity.FLOATING else tuple(LossReading)


@dataclass(frozen=True)
class Place:
    """Coordinates of a point: shaft speed rad/s, delivery pressure Pa gauge, share of the full displacement."""

    speed: float
    pressure: float
    ratio: float

    @property
    def text(self) -> str:
        """In words."""
        return f"{self.speed / RPM:.0f} r/min, {pressure_text(self.pressure)}, {100.0 * self.ratio:.0f} % displacement"


@dataclass(frozen=True)
class PaperPoint:
    """A solved point, SI: bench reading, mean losses of the seven pairs (in the order of `Pair`), port throttling,
    and a chamber's pressure (Pa gauge) over its shaft angle (rad, inner dead centre at 0).

    films: of floating gaps, by `system.paper.film_records`; else None.
    """

    bench: BenchReading
    coulomb: tuple[float, ...]
    viscous: tuple[float, ...]
    throttling: float
    shaft_angle: tuple[float, ...]
    chamber_pressure: tuple[float, ...]
    films: Record | None = None

    def pair_losses(self, reading: LossReading) -> Array:
        """Losses (7,) of the pairs in W, in the order of `Pair`."""
        coulomb = np.array(self.coulomb)
        return coulomb + np.array(self.viscous) if reading is LossReading.WITH_SHEAR else coulomb

    def loss(self, pair: Pair, reading: LossReading) -> float:
        """Loss of one pair in W."""
        return float(self.pair_losses(reading)[list(Pair).index(pair)])

    def share(self, pair: Pair, reading: LossReading) -> float:
        """Share of one pair in the loss of all seven."""
        return self.loss(pair, reading) / float(self.pair_losses(reading).sum())

    def read(self, reading: LossReading) -> BenchReading:
        """Bench readings; mixed coefficients alone do not include the torque of the films' shear."""
        if reading is LossReading.WITH_SHEAR:
            return self.bench
        return replace(self.bench, shaft_torque=self.bench.shaft_torque - sum(self.viscous) / self.bench.shaft_speed)

    def overall(self, reading: LossReading) -> float:
        """Overall efficiency, the paper's Eq. (3)."""
        return paper_efficiency(self.read(reading)).overall

    def split(self, reading: LossReading) -> LossSplit:
        """Volumetric and hydromechanical loss, the paper's Eqs. (1), (2)."""
        return paper_losses(self.read(reading))


def paper_point(found: PumpPoint) -> PaperPoint:
    """Numbers of a solved point for the paper's figures."""
    losses = [found.pairs.loss(pair) for pair in Pair]
    return PaperPoint(
        bench=found.bench,
        coulomb=tuple(loss.mean_coulomb for loss in losses),
        viscous=tuple(loss.mean_viscous for loss in losses),
        throttling=found.power.throttling,
        shaft_angle=tuple(found.cycle.shaft_angle.tolist()),
        chamber_pressure=tuple(found.cycle.pressure.tolist()),
    )


@dataclass(frozen=True)
class PaperWork:
    """Solves the paper's points of a pump: a `system.work.tasks.WorkInRows`; options: of floating gaps.

    floating: the row of floating points whose last one the next starts from.
    """

    pump: PumpDescription
    fidelity: PaperFidelity
    options: FloatingOptions = field(default_factory=FloatingOptions)
    floating: FloatingRow | None = None

    def row(self) -> PaperWork:
        """The same, whose floating points start from the one before."""
        return replace(self, floating=FloatingSolver(self.options).row())

    def key(self, part: Place) -> str:
        """Name of all inputs of the point's numbers."""
        stated = sorted(FloatingSolver(self.options).stated.items()) if self.fidelity is PaperFidelity.FLOATING else ()
        files = filter(None, self.pump.file_contents)
        return content_key(POINT_FORMAT, self.fidelity, resolved_toml(self.pump), part, stated, *files)[:KEY_LENGTH]

    def solve(self, part: Place) -> Record:
        """The point as JSON; raises as the fidelity."""
        return asdict(self.solved(part))

    def solved(self, place: Place) -> PaperPoint:
        """The point itself; raises as the fidelity."""
        point = self.at(place)
        if self.fidelity is PaperFidelity.LUMPED:
            return paper_point(lumped_point(self.pump, point))
        if self.fidelity is PaperFidelity.FIXED:
            return paper_point(films_point(self.pump, point).pump_point)
        found = (self.floating or FloatingSolver(self.options).row()).floating(self.pump, point)
        return replace(paper_point(found.pump_point), films=films_record(found))

    def at(self, place: Place) -> OperatingPoint:
        """The point of a place; KeyError if it was not solved."""
        return operating_point(
            self.pump, shaft_speed=place.speed, delivery_pressure=place.pressure, displacement_ratio=place.ratio
        )


@dataclass(frozen=True)
class PaperPoints:
    """A pump's solved points by place."""

    pump: PumpDescription
    fidelity: PaperFidelity
    points: Mapping[Place, PaperPoint]

    def at(self, speed: float, pressure: float, ratio: float) -> PaperPoint:
        """The point of a place; KeyError where it was not requested."""
        return self.points[Place(speed, pressure, ratio)]

    def over_pressure(self, speed: float, ratio: float) -> tuple[PaperPoint, ...]:
        """The points over PRESSURES."""
        return tuple(self.at(speed, pressure, ratio) for pressure in PRESSURES)


def near_zero(pump: PumpDescription) -> float:
    """Delivery pressure (Pa gauge) at which Case 2 of Fig. 3 begins: NEAR_ZERO above the inlet's."""
    return pump.operating.inlet_pressure + NEAR_ZERO


def places_of(pump: PumpDescription, figures: Sequence[Figure]) -> tuple[Place, ...]:
    """The points required by some figures, each once."""
    low = (near_zero(pump), *PRESSURES)
    plan = _grid(SPEEDS, PRESSURES, RATIOS[1:])
    needs: dict[Figure, tuple[Place, ...]] = {
        Figure.TABLE1: _grid((RATED,), (PRESSURES[0], PRESSURES[-1]), (FULL,)),
        Figure.FIG2: _grid((RATED,), PRESSURES, RATIOS),
        Figure.FIG3: (
            *_grid((RATED,), PRESSURES[:1], RATIOS),
            *_grid((RATED,), low, RATIOS[:1]),
            *_grid((RATED,), PRESSURES[-1:], (FULL,)),
        ),
        Figure.FIG8: _grid((RATED,), PRESSURES[-1:], (FULL,)),
        Figure.FIG9: _grid((RATED,), (PRESSURES[0], PRESSURES[-1]), RATIOS[1:]),
        Figure.FIG10: _grid((RATED,), PRESSURES[-1:], (FULL,)),
        Figure.FIG11: _grid((RATED,), (PRESSURES[0], PRESSURES[-1]), (FULL,)),
        Figure.FIG13: plan,
        Figure.FIG16: plan,
        Figure.FIG17: _grid(SPEEDS, PRESSURES, (FULL,)),
        Figure.FIG18: _grid((RATED,), PRESSURES, (FULL,)),
        Figure.FIG19: _grid(SPEEDS, PRESSURES, (FULL,)),
        Figure.FIG20: _grid((RATED,), PRESSURES[:1], RATIOS),
        Figure.FIG21: _grid((RATED,), PRESSURES, RATIOS[1:2]),
        Figure.FIG22: _grid(SPEEDS, PRESSURES[:1], RATIOS[1:2]),
    }
    return tuple(dict.fromkeys(place for figure in figures for place in needs.get(figure, ())))


def _grid(speeds: Sequence[float], pressures: Sequence[float], ratios: Sequence[float]) -> tuple[Place, ...]:
    return tuple(Place(n, p, ratio) for ratio in ratios for n in speeds for p in pressures)


def solve_points(
    work: PaperWork, places: Sequence[Place], store: KeptPoints, executor: Executor, report: Report = silent
) -> PaperPoints:
    """The places solved, or read from `store`. Raises InputError for the first that has no solution."""
    pump, fidelity = work.pump, work.fidelity
    if fidelity is PaperFidelity.LUMPED:  # costlier to keep than to solve
        solved = {}
        for done, place in enumerate(places):
            report(done, len(places), "lumped points")
            solved[place] = work.solved(place)
        return PaperPoints(pump, fidelity, solved)
    rows = sorted(places, key=lambda place: (place.ratio, place.speed, place.pressure), reverse=True)
    kept = run_kept(work, rows, store, executor, batch=len(PRESSURES), report=report)
    for place, outcome in zip(rows, kept.outcomes, strict=True):
        if outcome.status is not PartStatus.SOLVED:
            raise InputError(f"paper's point {place.text}", outcome.reason, "a point that can be solved")
    points = {place: _point(one.record) for place, one in zip(rows, kept.outcomes, strict=True)}
    return PaperPoints(pump, fidelity, points)


def _point(record: Mapping[str, Any]) -> PaperPoint:
    coulomb, viscous, angle, pressure = (
        tuple(record[name]) for name in ("coulomb", "viscous", "shaft_angle", "chamber_pressure")
    )
    bench, films = BenchReading(**record["bench"]), record["films"]
    return PaperPoint(bench, coulomb, viscous, record["throttling"], angle, pressure, films)
