"""Ports and chamber pressure over the turn at all points of a bench map at once, in the lumped fidelity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.pump.chamber import kernels as kernel
from system.pump.chamber.cycle import PERIODICITY, REVOLUTION_LIMIT, unsolved
from system.pump.chamber.gap_kernels import gaps_map
from system.pump.chamber.layout import INTEGRALS
from system.pump.chamber.map_kernels import beside_map, chamber_map
from system.pump.chamber.problem import Chamber, LeakTable
from system.pump.chamber.setup import PORT_NAMES, chamber_records, gap_cubics, turn_nodes
from system.pump.chamber.state_kernels import CHAMBER
from system.pump.chamber.turn import TurnTotals, turn_totals
from system.pump.lumped import port_openings
from system.pump.ports.areas import as_array
from system.pump.ports.wear import PortWear
from system.work.threads import side_by_side


@dataclass(frozen=True)
class MapPorts:
    """Suction and delivery port at N points, as compiled code reads them.

    suction, delivery: (N, PORT_SIZE); nodes: every point's nodes of a turn, end to end, of point i from firsts[i]
    to firsts[i + 1].
    """

    suction: Array
    delivery: Array
    nodes: Array
    firsts: NDArray[np.int64]


def map_ports(pump: PumpDescription, shift: Array, wear: PortWear[Array], samples: int) -> MapPorts:
    """The ports at N points, later by shift (N,) rad (`SwashDrive.dead_centre_shift`), with their wear.

    Nodes are the breaks of the ports and, of an even number of samples, every second: over steps of that length the
    stages give the pressure as accurately as the steps. Equal points share the work.
    """
    rows = np.column_stack([shift, *vars(wear).values()])
    kinds, of_point = np.unique(rows, axis=0, return_inverse=True)
    found = [_kind(pump, *map(float, kind), samples=samples) for kind in kinds]
    by_point = [found[kind] for kind in of_point.ravel()]
    suction, delivery, nodes = zip(*by_point, strict=True)
    firsts = np.cumsum([0, *(own.size for own in nodes)])
    return MapPorts(np.stack(suction), np.stack(delivery), np.concatenate(nodes), firsts)


def _kind(pump: PumpDescription, shift: float, *wear: float, samples: int) -> tuple[Array, Array, Array]:
    suction, delivery = port_openings(pump, shift, PortWear(*wear))
    ends = samples // 2 if samples % 2 == 0 else samples
    return as_array(suction), as_array(delivery), turn_nodes(suction, delivery, ends)[0]


FEWEST = 8
"""Points of a map for a thread: fewer cost less than their transfer."""
OF_GAPS = ("case_pressure", "kinematic_viscosity")
"""Constants of a chamber that act by its gaps alone; the flow of ports becomes turbulent at a few kPa."""


@dataclass(frozen=True)
class Steps:
    """Steps by which courses at N points were solved: trail, all end to end, those of point i from begins[i] on.

    records (N,) of CHAMBER, gaps (N, M, 7, 4), held (N, 1, 2, 4): chambers, tables, ports as given to compiled code.
    """

    records: np.ndarray
    gaps: Array
    held: Array
    trail: Array
    begins: NDArray[np.int64]

    def of(self, some: slice) -> NDArray[np.int64]:
        """Rows of the trail at which the steps of some of the points begin, and the row after the last one."""
        return self.begins[some.start : some.stop + 1]


@dataclass(frozen=True)
class Courses:
    """Periodic revolutions at N points: pressure (N, M) Pa gauge at M equidistant shaft angles from 0; integrals.

    integrals: (N, INTEGRALS), of one chamber over the turn; steps: those of courses that were solved by themselves.
    """

    pressure: Array
    integrals: Array
    steps: Steps | None = None

    @property
    def totals(self) -> TurnTotals[Array]:
        """The integrals by name."""
        return turn_totals(self.integrals)


@dataclass(frozen=True)
class MapProblem:
    """The chamber at N points, arrays (N,): leaks (N, 3, M), and differences of its ports from the drawing."""

    chamber: Chamber[Array]
    leaks: LeakTable
    wear: PortWear[Array]

    @cached_property
    def records(self) -> np.ndarray:
        """The chambers (N,) as compiled code reads them, without their ports."""
        return chamber_records(self.chamber)

    @property
    def shift(self) -> Array:
        """Angle (N,) rad by which the ports lie later."""
        return np.zeros_like(self.chamber.shaft_speed) + self.chamber.drive.dead_centre_shift

    @cached_property
    def ports(self) -> Array:
        """Quantities in which the ports of points differ, one a row, (4, N)."""
        return np.stack([self.shift, *vars(self.wear).values()])

    def is_that_of(self, other: MapProblem) -> bool:
        """True if all inputs of the courses are equal."""
        own, others = self.leaks, other.leaks
        return (
            np.array_equal(self.records, other.records)
            and np.array_equal(own.conductance, others.conductance)
            and np.array_equal(own.drag_flow, others.drag_flow)
            and self.has_ports_of(other)
        )

    def differs_in_gaps_alone(self, other: MapProblem) -> bool:
        """True if the other's chambers differ only by the leakage of their gaps."""
        own, others = self.records, other.records
        names = [name for name in CHAMBER.names or () if name not in OF_GAPS]
        return all(np.array_equal(own[name], others[name]) for name in names) and self.has_ports_of(other)

    def has_ports_of(self, other: MapProblem) -> bool:
        """True if the other's ports open at the same angles, so that its chambers can use the same steps."""
        return np.array_equal(self.ports, other.ports)


def solve_map(pump: PumpDescription, problem: MapProblem, tolerance: float) -> Courses:
    """The periodic revolution at every point, as `cycle.solve_cycle` solves one, ports held at their means.

    Periodic to a tenth of the tolerance (PERIODICITY at least), both of the ports' pressure difference. Raises
    NotConverged with the first point that does not become periodic.
    """
    run = _run(pump, problem, tolerance)
    found = side_by_side(lambda some: chamber_map(*run.given(some), *run.filled(some)), len(run.records), FEWEST)
    counts = [np.diff(begins) for _, begins in found]
    begins = np.concatenate([[0], np.cumsum(np.concatenate(counts))])
    trail = np.concatenate([own for own, _ in found])
    return replace(_courses(problem, run), steps=Steps(run.records, run.gaps, run.held, trail, begins))


def beside(pump: PumpDescription, courses: Courses, problem: MapProblem, tolerance: float) -> Courses:
    """`solve_map` of chambers with small differences from those of solved courses, except in their ports' areas.

    They use the same steps, so that differences are smoother than those of two independent maps, at six tenths of the
    cost. Points that do not converge on these steps are solved by themselves. Raises ValueError for courses that were
    not solved by themselves.
    """
    steps, run = _steps(courses), _run(pump, problem, tolerance)

    def along(some: slice) -> None:
        beside_map(*run.given(some), steps.trail, steps.of(some), *run.filled(some))

    side_by_side(along, len(run.records), FEWEST)
    return _courses(problem, run)


@dataclass(frozen=True)
class _Run:
    """Arguments of the compiled maps, and the arrays over the points that they fill."""

    records: np.ndarray
    gaps: Array
    held: Array
    nodes: Array
    firsts: NDArray[np.int64]
    control: tuple[float, float, int]
    pressures: Array
    totals: Array
    statuses: NDArray[np.int64]

    def given(self, some: slice) -> tuple[Any, ...]:
        """Arguments for some of the points."""
        firsts = self.firsts[some.start : some.stop + 1]
        return self.records[some], self.gaps[some], self.held[some], self.nodes, firsts, self.control

    def filled(self, some: slice) -> tuple[Array, Array, NDArray[np.int64]]:
        """Arrays to be filled for some of the points: pressures, totals, statuses."""
        return self.pressures[some], self.totals[some], self.statuses[some]


def _run(pump: PumpDescription, problem: MapProblem, tolerance: float) -> _Run:
    points, _, samples = problem.leaks.conductance.shape
    ports, records = map_ports(pump, problem.shift, problem.wear, samples), problem.records.copy()
    for name, rows in zip(PORT_NAMES, (ports.delivery, ports.suction), strict=True):
        records[name] = rows
    held = np.zeros((points, 1, 2, 4))
    held[:, 0, :, 0] = np.column_stack([records["delivery_pressure"], records["inlet_pressure"]])
    control = tolerance, max(PERIODICITY, 0.1 * tolerance), REVOLUTION_LIMIT
    given = records, gap_cubics(problem.leaks), held, ports.nodes, ports.firsts, control
    totals = np.empty((points, 2 * INTEGRALS))
    return _Run(*given, np.empty((points, samples)), totals, np.empty(points, dtype=np.int64))


def _courses(problem: MapProblem, run: _Run) -> Courses:
    """The courses that were filled. Raises NotConverged with the first point that is not periodic."""
    if np.any(run.statuses != kernel.OK):
        first = int(np.argmax(run.statuses != kernel.OK))
        at = float(problem.chamber.delivery_pressure[first]), float(problem.chamber.shaft_speed[first])
        raise unsolved("no periodic revolution", *at)
    return Courses(run.pressures, run.totals[:, :INTEGRALS])


def other_gaps(courses: Courses, other: MapProblem) -> Courses:
    """The courses of chambers that differ from those of solved courses in their gaps alone, to first order.

    Linear in the change of pressure, along the solved steps (`gap_kernels`), for slopes of a fit: changes of the
    ports' oil, leakage and work by films and viscosity are within 1 % of those of fine steps. The pressure is that
    of the solved courses. Raises ValueError for courses that were not solved by themselves.
    """
    steps = _steps(courses)
    records, changes = other.records.copy(), np.empty_like(courses.integrals)
    for name in PORT_NAMES:
        records[name] = steps.records[name]
    given = steps.records, steps.gaps, steps.held, records, gap_cubics(other.leaks)

    def change(some: slice) -> None:
        gaps_map(*(one[some] for one in given), steps.trail, steps.of(some), changes[some])

    side_by_side(change, len(records), FEWEST)
    return Courses(courses.pressure, courses.integrals + changes)


def _steps(courses: Courses) -> Steps:
    if courses.steps is None:
        raise ValueError("courses along another's steps: found none, expected courses of solve_map")
    return courses.steps
