"""Ports and chamber pressure over the turn at all points of a bench map at once, in the lumped fidelity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.pump.chamber import kernels as kernel, layout as col
from system.pump.chamber.cycle import PERIODICITY, REVOLUTION_LIMIT, unsolved
from system.pump.chamber.layout import CAVITY_PRESSURE, INTEGRALS
from system.pump.chamber.map_kernels import beside_map, chamber_map
from system.pump.chamber.problem import Chamber, LeakTable
from system.pump.chamber.setup import PORT_NAMES, chamber_records, gap_cubics, turn_nodes
from system.pump.chamber.state_kernels import CHAMBER
from system.pump.chamber.turn import TurnTotals, turn_totals
from system.pump.lumped import port_openings
from system.pump.ports.areas import as_array
from system.pump.ports.wear import PortWear


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

    Nodes are the breaks of the ports and, of an even number of samples, every second: over steps no
    longer the stages give the pressure as well as the steps do. Equal points share the work.
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


MORE_LEAKAGE = 1.1
"""Of the solution by which `missed_by_leakage` is found."""
DELIVERY, SUCTION = col.OUTFLOW + col.DELIVERY, col.OUTFLOW + col.SUCTION
_OUT_OF_GAPS = slice(col.OUTFLOW + col.FIRST_GAP, col.OUTFLOW + col.FIRST_GAP + col.GAPS)
_DRAG = slice(col.DRAG_ENERGY, col.DRAG_ENERGY + col.GAPS)
OF_GAPS = ("case_pressure", "kinematic_viscosity")
"""Constants of a chamber that act by its gaps alone; ports turn from laminar to turbulent at a few kPa."""


@dataclass(frozen=True)
class Courses:
    """Periodic revolutions at N points: pressure (N, M) Pa gauge at M equidistant shaft angles from 0; integrals.

    integrals: (N, INTEGRALS), of one chamber over the turn. Where they were solved by themselves, trail: the steps of
    all points end to end, those of point i from begins[i] to begins[i + 1].
    """

    pressure: Array
    integrals: Array
    trail: Array | None = None
    begins: Array | None = None

    @property
    def totals(self) -> TurnTotals[Array]:
        """The integrals by name."""
        return turn_totals(self.integrals)


@dataclass(frozen=True)
class MapProblem:
    """The chamber at N points, arrays (N,): leaks (N, 3, M), and by what its ports differ from the drawing."""

    chamber: Chamber[Array]
    leaks: LeakTable
    wear: PortWear[Array]

    @property
    def records(self) -> np.ndarray:
        """The chambers (N,) as compiled code reads them, ports not yet filled in."""
        return chamber_records(self.chamber)

    @property
    def shift(self) -> Array:
        """Angle (N,) rad by which the ports lie later."""
        return np.zeros_like(self.chamber.shaft_speed) + self.chamber.drive.dead_centre_shift

    @property
    def ports(self) -> Array:
        """Quantities by which the ports of points differ, one a row, (4, N)."""
        return np.stack([self.shift, *vars(self.wear).values()])

    @property
    def key(self) -> bytes:
        """Bytes of all that the courses depend on."""
        arrays = (self.records, self.leaks.conductance, self.leaks.drag_flow, self.ports)
        return b"".join(array.tobytes() for array in arrays)

    def differs_in_gaps_alone(self, other: MapProblem) -> bool:
        """True if the other's chambers differ by nothing but the leakage of their gaps."""
        own, others = self.records, other.records
        names = [name for name in CHAMBER.names or () if name not in OF_GAPS]
        return all(np.array_equal(own[name], others[name]) for name in names) and self.has_ports_of(other)

    def has_ports_of(self, other: MapProblem) -> bool:
        """True if the other's ports open at the same angles, so that its chambers can take the same steps."""
        return np.array_equal(self.ports, other.ports)


def solve_map(pump: PumpDescription, problem: MapProblem, tolerance: float) -> Courses:
    """The periodic revolution at every point, as `cycle.solve_cycle` solves one, ports held at their means.

    Periodic to a tenth of the tolerance (PERIODICITY at least), both of the ports' pressure difference. Raises
    NotConverged with the first point that does not become periodic.
    """
    given, filled = _run(pump, problem, tolerance)
    trail, begins = chamber_map(*given, *filled)
    return replace(_courses(problem, filled), trail=trail, begins=begins)


def beside(pump: PumpDescription, courses: Courses, problem: MapProblem, tolerance: float) -> Courses:
    """`solve_map` of chambers that differ a little, in all but their ports' areas, from those of solved courses.

    They take the same steps, so that differences are smoother than those of two maps solved apart, at six tenths
    of the cost. Points that do not converge on these steps are solved by themselves.
    """
    given, filled = _run(pump, problem, tolerance)
    beside_map(*given, courses.trail, courses.begins, *filled)
    return _courses(problem, filled)


def _run(pump: PumpDescription, problem: MapProblem, tolerance: float) -> tuple[tuple[Any, ...], tuple[Array, ...]]:
    """Arguments of the compiled maps, and the arrays that they fill: pressures, totals, statuses."""
    points, _, samples = problem.leaks.conductance.shape
    ports, records = map_ports(pump, problem.shift, problem.wear, samples), problem.records
    for name, rows in zip(PORT_NAMES, (ports.delivery, ports.suction), strict=True):
        records[name] = rows
    held = np.zeros((points, 1, 2, 4))
    held[:, 0, :, 0] = np.column_stack([records["delivery_pressure"], records["inlet_pressure"]])
    control = tolerance, max(PERIODICITY, 0.1 * tolerance), REVOLUTION_LIMIT
    given = records, gap_cubics(problem.leaks), held, ports.nodes, ports.firsts, control
    totals = np.empty((points, 2 * INTEGRALS))
    return given, (np.empty((points, samples)), totals, np.empty(points, dtype=np.int64))


def _courses(problem: MapProblem, filled: tuple[Array, ...]) -> Courses:
    """The courses that were filled. Raises NotConverged with the first point that is not periodic."""
    pressure, totals, statuses = filled
    if np.any(statuses != kernel.OK):
        first = int(np.argmax(statuses != kernel.OK))
        at = float(problem.chamber.delivery_pressure[first]), float(problem.chamber.shaft_speed[first])
        raise unsolved("no periodic revolution", *at)
    return Courses(pressure, totals[:, :INTEGRALS])


def other_gaps(courses: Courses, solved: MapProblem, other: MapProblem, missed: Array | None = None) -> Courses:
    """The courses of chambers that differ in their gaps alone, the pressure taken as it is.

    What a gap lets out more, at that pressure, on the delivery half of the turn is missing at the delivery port,
    on the suction half at the suction port. Changes of leakage are good to 0.5 %, what the ports miss by it to
    some 8 %, both to some .5 % with what this misses (`missed_by_leakage`). For the slopes of a fit.
    """
    integrals = courses.integrals.copy()
    lost, suction, out, pulled = _lost(courses, solved, other)
    integrals[:, DELIVERY] -= lost
    integrals[:, SUCTION] -= suction
    integrals[:, _OUT_OF_GAPS] += out
    integrals[:, _DRAG] += pulled
    if missed is not None:
        integrals += lost[:, None] * missed
    return Courses(courses.pressure, integrals)


def missed_by_leakage(pump: PumpDescription, courses: Courses, problem: MapProblem, tolerance: float) -> Array:
    """Error of `other_gaps` in each integral per m3 that the delivery half loses, (N, INTEGRALS).

    The pressure follows leakage where a chamber is shut, so that the next port makes up for it and the work changes:
    by a solution `beside` with MORE_LEAKAGE times the leakage, whose errors are small beside its change.
    """
    conductance = MORE_LEAKAGE * problem.leaks.conductance
    more = replace(problem, leaks=LeakTable(conductance, problem.leaks.drag_flow))
    lost = _lost(courses, problem, more)[0]
    apart = beside(pump, courses, more, tolerance).integrals - other_gaps(courses, problem, more).integrals
    return np.divide(apart, lost[:, None], out=np.zeros_like(apart), where=lost[:, None] > 0.0)


def _lost(courses: Courses, solved: MapProblem, other: MapProblem) -> tuple[Array, Array, Array, Array]:
    """More oil out in m3 a turn: of all gaps in the delivery half and in the suction half (N,), of each gap in the
    whole turn (N, 3), and more work of dragged oil in J (N, 3).
    """
    before, after = (_gap_rates(courses.pressure, problem) for problem in (solved, other))
    samples = courses.pressure.shape[1]
    delivering = np.sin(TURN * np.arange(samples) / samples - solved.shift[:, None]) < 0.0
    mass, work = after[0] - before[0], after[1] - before[1]
    lost = mass.sum(axis=1)
    return (lost * delivering).mean(axis=1), (lost * ~delivering).mean(axis=1), mass.mean(axis=2), work.mean(axis=2)


def _gap_rates(pressure: Array, problem: MapProblem) -> tuple[Array, Array]:
    """Of each gap (N, 3, M): oil out in m3 at zero gauge pressure, and work of dragged oil in J, a turn."""
    case, modulus = problem.chamber.case_pressure[:, None, None], problem.chamber.bulk_modulus
    inside = np.maximum(pressure, CAVITY_PRESSURE)[:, None, :]
    dense = np.exp(inside / modulus) * TURN / problem.chamber.shaft_speed[:, None, None]
    flow = problem.leaks.conductance * (pressure[:, None, :] - case) + problem.leaks.drag_flow
    fall = modulus * (np.exp(-case / modulus) - np.exp(-inside / modulus))
    return flow * dense, problem.leaks.drag_flow * dense * fall
