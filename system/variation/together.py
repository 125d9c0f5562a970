"""All operating points of a pump solved at once at the lumped fidelity, by the kernels of the test bench."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.chamber_map import Courses, solve_map
from system.bench.setting import Setting
from system.description.parts import MaterialsSection, SurfacesSection
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.points.table.means import given_films
from system.pump.bench import NOTHING_OUTSIDE
from system.pump.chamber.cycle import TOLERANCE
from system.pump.land_losses import land_losses
from system.pump.laws.kinematics import drive_at_ratio
from system.pump.lumped import full_drive, lumped_leaks, lumped_pairs, piston_motion, port_lines, swept_displacement
from system.pump.operating import OperatingPoint
from system.pump.ports.lines import Lines
from system.pump.ports.wear import PortWear
from system.pump.power import bench_reading, chamber_exchange, gap_leakage
from system.variation.chamber_numbers import pressure_numbers
from system.variation.measures import NUMBERS


@dataclass(frozen=True)
class TogetherSolver:
    """`lumped_point` at many points of a pump at once, without the course over the turn: a third of the time.

    For pumps that `solves_together` accepts.
    """

    words = "lumped"
    cost = 0.0015

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of the numbers besides pump and points."""
        return {"fidelity": "lumped, all points together"}

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """Without materials and surfaces."""
        return replace(pump, materials=MaterialsSection(), surfaces=SurfacesSection())

    def solve_all(self, pump: PumpDescription, points: Sequence[OperatingPoint]) -> list[list[float | None]]:
        """The NUMBERS of every point, None for those of flows over the turn and of films. Raises NotConverged."""
        column = {name: np.array([[getattr(point, name)] for point in points]) for name in vars(points[0])}
        at = OperatingPoint(**column)
        motion, ones = piston_motion(pump, at), np.ones(len(points))
        given = Setting(pump, at, motion, lumped_leaks(pump, at, motion), PortWear(0.0 * ones, ones, ones))
        return _numbers(given, solve_map(pump, given.problem, TOLERANCE))


def solves_together(pump: PumpDescription) -> bool:
    """True for a pump without effects of [physics], lines on its ports and lands that lose by inertia."""
    own = pump.operating
    asked = OperatingPoint(own.speed, own.pressure, own.inlet_pressure, own.case_pressure, 1.0, own.temperature, 1.0)
    return not pump.physics.on and port_lines(pump, asked) == Lines() and not land_losses(pump).any


def _numbers(given: Setting, courses: Courses) -> list[list[float | None]]:
    chamber, totals, pistons = given.problem.chamber, courses.totals, given.pump.pump.pistons
    rate = pistons * chamber.shaft_speed / TURN
    exchange = chamber_exchange(totals, rate)
    power = lumped_pairs(given.pump, given.point, given.motion, courses).power
    read = bench_reading(chamber, totals, pistons, power, exchange, NOTHING_OUTSIDE)
    leak, films = gap_leakage(chamber, totals, rate, exchange), given_films(given.pump)
    columns = {
        **vars(read),
        "loss": read.shaft_power - sum(flow * pressure for flow, pressure in read.ports),
        "swept_displacement": _swept(given),
        **pressure_numbers(given.pump, given.point, courses.pressure),
        **{f"leakage.{gap}": value for gap, value in vars(leak).items()},
        **{f"film_least.{gap}": value for gap, value in vars(films).items()},
        **{f"film_temperature.{gap}": given.point.temperature[:, 0] for gap in vars(films)},
    }
    count = len(courses.pressure)
    found = [np.broadcast_to(columns[name], count) if name in columns else [None] * count for name in NUMBERS]
    return [[None if value is None else float(value) for value in row] for row in zip(*found, strict=True)]


def _swept(given: Setting) -> Array:
    """Return the swept displacement (N,) m3/rev of every point, computed once for each displacement ratio."""
    ratios, of_point = np.unique(given.point.displacement_ratio.ravel(), return_inverse=True)
    full = full_drive(given.pump)
    own = [swept_displacement(given.pump, drive_at_ratio(full, float(ratio))) for ratio in ratios]
    return np.array(own)[of_point]
