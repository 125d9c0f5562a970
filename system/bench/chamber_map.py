"""Chamber pressure over the turn at all points of a bench map at once: the lumped fidelity's, point by point."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.ports import map_ports
from system.description.pump import PumpDescription
from system.inputs.errors import NotConverged
from system.inputs.units import TURN
from system.pump.chamber import kernels as kernel
from system.pump.chamber.cycle import PERIODICITY, REVOLUTION_LIMIT
from system.pump.chamber.layout import (
    CARRIED_ENERGY,
    CAVITY_PRESSURE,
    DELIVERY,
    GAPS,
    INTEGRALS,
    PISTON,
    SUCTION,
    TABLE,
)
from system.pump.chamber.map_kernels import beside_map, chamber_map
from system.pump.chamber.problem import LeakTable
from system.pump.chamber.setup import periodic_cubics
from system.pump.chamber.state_kernels import CHAMBER
from system.pump.lumped import PistonMotion, chamber_problem
from system.pump.operating import OperatingPoint

OF_GAPS = ("case_pressure", "kinematic_viscosity")
"""Constants of a chamber that act by its gaps alone; ports turn from laminar to turbulent at a few kPa."""


@dataclass(frozen=True)
class Courses:
    """Periodic revolutions at N points: pressure (N, M) Pa gauge at M equidistant shaft angles from 0, and totals.

    totals (N, INTEGRALS): the integrals of `state_kernels` over one turn, one chamber. Where they were
    solved for themselves, trail: the steps of all points end to end, those of point i from begins[i] to
    begins[i + 1].
    """

    pressure: Array
    totals: Array
    trail: Array | None = None
    begins: Array | None = None


@dataclass(frozen=True)
class MapProblem:
    """The chamber at N points as compiled code reads it.

    chambers (N,) of `state_kernels.CHAMBER`, ports not yet filled in; leaks (N, 3, M); ports (N, 4):
    their state for `map_ports`.
    """

    chambers: np.ndarray
    leaks: LeakTable
    ports: Array

    @property
    def key(self) -> bytes:
        """All that the courses hang on."""
        arrays = (self.chambers, self.leaks.conductance, self.leaks.carried_flow, self.ports)
        return b"".join(array.tobytes() for array in arrays)

    def differs_in_gaps_alone(self, other: MapProblem) -> bool:
        """Whether the other's chambers differ, if at all, by what leaks out of their gaps."""
        names = [name for name in CHAMBER.names or () if name not in OF_GAPS]
        same = all(np.array_equal(self.chambers[name], other.chambers[name]) for name in names)
        return same and self.has_ports_of(other)

    def has_ports_of(self, other: MapProblem) -> bool:
        """Whether the other's ports open just as these, so that its chambers can go along these's steps."""
        return np.array_equal(self.ports, other.ports)


def map_problem(
    pump: PumpDescription, point: OperatingPoint[Array], motion: PistonMotion[Array], leaks: LeakTable
) -> MapProblem:
    """The chamber of a pump at N points, given as columns (N, 1), with gaps that leak as `leaks` (N, 3, M)."""
    problem = chamber_problem(pump, point, motion, leaks)
    chambers = np.zeros(point.shaft_speed.size, dtype=CHAMBER)
    chambers["stroke_scale"] = np.ravel(problem.drive.stroke_scale)
    chambers["cone_swash_product"] = np.ravel(problem.drive.cone_swash_product)
    for name in CHAMBER.names or ():
        if hasattr(problem, name) and not name.endswith("_port"):
            chambers[name] = np.ravel(getattr(problem, name))
    ports = np.zeros((chambers.size, 4))
    ports[:, 0], ports[:, 2:] = np.ravel(motion.drive.dead_centre_shift), 1.0
    return MapProblem(chambers, leaks, ports)


def solve_map(pump: PumpDescription, problem: MapProblem, tolerance: float) -> Courses:
    """The periodic revolution at every point, as `chamber.solve_cycle` has it for one, ports held at their means.

    Periodic to a tenth of the tolerance (PERIODICITY at least), both of the ports' pressure difference. Raises
    NotConverged with the first point that does not become periodic.
    """
    run = _Run.of(pump, problem, tolerance)
    trail, begins = chamber_map(*run.given, *run.filled)
    return replace(run.courses(problem), trail=trail, begins=begins)


def beside(pump: PumpDescription, courses: Courses, problem: MapProblem, tolerance: float) -> Courses:
    """`solve_map` of chambers that differ a little, in all but their ports' areas, from those of solved courses.

    They go along the steps of these, so that differences are smoother than those of two maps solved apart, at
    six tenths of the price. Points that those steps do not lead well are solved for themselves.
    """
    run = _Run.of(pump, problem, tolerance)
    beside_map(*run.given, courses.trail, courses.begins, *run.filled)
    return run.courses(problem)


@dataclass(frozen=True)
class _Run:
    """What the compiled maps are given, and what they fill: pressures, totals, statuses."""

    given: tuple[Any, ...]
    filled: tuple[Array, Array, Array]

    @classmethod
    def of(cls, pump: PumpDescription, problem: MapProblem, tolerance: float) -> _Run:
        points, _, samples = problem.leaks.conductance.shape
        ports = map_ports(pump, problem.ports, samples)
        chambers = problem.chambers.copy()
        chambers["suction_port"], chambers["delivery_port"] = ports.suction, ports.delivery
        held = np.zeros((points, 1, 2, 4))
        held[:, 0, 0, 0], held[:, 0, 1, 0] = chambers["delivery_pressure"], chambers["inlet_pressure"]
        control = tolerance, max(PERIODICITY, 0.1 * tolerance), REVOLUTION_LIMIT
        given = chambers, _tables(problem.leaks), held, ports.nodes, ports.firsts, control
        totals = np.empty((points, 2 * INTEGRALS))
        return cls(given, (np.empty((points, samples)), totals, np.empty(points, dtype=np.int64)))

    def courses(self, problem: MapProblem) -> Courses:
        """What was filled. Raises NotConverged with the first point that is not periodic."""
        pressure, totals, statuses = self.filled
        if np.any(statuses != kernel.OK):
            _tell(problem, int(np.argmax(statuses != kernel.OK)))
        return Courses(pressure, totals[:, :INTEGRALS])


def other_gaps(courses: Courses, solved: MapProblem, other: MapProblem) -> Courses:
    """The courses of chambers that differ in their gaps alone, the pressure taken as it is.

    What a gap lets out more, at that pressure, on the delivery half of the turn is missing at the delivery port,
    on the suction half at the suction port. Changes of leakage are good to 0.5 %, what the ports miss by it to
    some 8 %: for the slopes of a fit, not for its predictions.
    """
    before, after = (_gap_rates(courses.pressure, problem) for problem in (solved, other))
    samples = courses.pressure.shape[1]
    angle = TURN * np.arange(samples) / samples - solved.ports[:, :1]
    delivering = np.sin(angle) < 0.0
    mass, work = after[0] - before[0], after[1] - before[1]
    totals = courses.totals.copy()
    totals[:, DELIVERY] -= (mass.sum(axis=1) * delivering).mean(axis=1)
    totals[:, SUCTION] -= (mass.sum(axis=1) * ~delivering).mean(axis=1)
    totals[:, PISTON : PISTON + GAPS] += mass.mean(axis=2)
    totals[:, CARRIED_ENERGY : CARRIED_ENERGY + GAPS] += work.mean(axis=2)
    return Courses(courses.pressure, totals)


def _gap_rates(pressure: Array, problem: MapProblem) -> tuple[Array, Array]:
    """Of each gap (N, 3, M): oil out in m3 at zero gauge pressure, and work of carried oil in J, a turn."""
    case = problem.chambers["case_pressure"][:, None, None]
    modulus = problem.chambers["bulk_modulus"][:, None, None]
    inside = np.maximum(pressure, CAVITY_PRESSURE)[:, None, :]
    dense = np.exp(inside / modulus) * TURN / problem.chambers["shaft_speed"][:, None, None]
    flow = problem.leaks.conductance * (pressure[:, None, :] - case) + problem.leaks.carried_flow
    fall = modulus * (np.exp(-case / modulus) - np.exp(-inside / modulus))
    return flow * dense, problem.leaks.carried_flow * dense * fall


def _tables(leaks: LeakTable) -> Array:
    """The gaps' tables (N, M, 7, 4) as the kernel reads them; the volume does not grow besides."""
    points, _, samples = leaks.conductance.shape
    rows = np.concatenate([leaks.conductance, leaks.carried_flow, np.zeros((points, 1, samples))], axis=1)
    cubics = periodic_cubics(rows.reshape(-1, samples)).reshape(samples, points, TABLE, 4)
    return np.ascontiguousarray(cubics.transpose(1, 0, 2, 3))


def _tell(problem: MapProblem, point: int) -> None:
    chamber = problem.chambers[point]
    raise NotConverged(
        "chamber pressure: no periodic revolution at "
        f"{chamber['delivery_pressure'] / 1e6:.3g} MPa and {chamber['shaft_speed'] * 60 / TURN:.4g} r/min; check "
        "dead volume, bulk modulus and port areas"
    )
