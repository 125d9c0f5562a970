"""Chamber pressure over the turn at all points of a bench map at once: the lumped fidelity's, point by point."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from system import chamber_kernel as kernel
from system.chamber import PERIODICITY, REVOLUTION_LIMIT
from system.chamber_course import periodic_cubics, turn_nodes
from system.chamber_problem import ChamberProblem, LeakTable
from system.description import PumpDescription
from system.errors import NotConverged
from system.kinematics import Array
from system.lumped import PistonMotion, chamber_problem, port_openings
from system.map_kernels import chamber_map
from system.operating import OperatingPoint
from system.ports import TURN, as_array


@dataclass(frozen=True)
class Courses:
    """Periodic revolutions at N points: pressure (N, M) Pa gauge at M equidistant shaft angles from 0, and totals.

    totals (N, INTEGRALS): the integrals of `chamber_kernel` over one turn, one chamber.
    """

    pressure: Array
    totals: Array


@dataclass(frozen=True)
class MapProblem:
    """The chamber at N points as compiled code reads it, and what tells whether two are the same.

    chambers (N,) of `chamber_kernel.CHAMBER`; leaks (N, 3, M); shift (N,) rad: by which the ports lie later.
    """

    chambers: np.ndarray
    leaks: LeakTable
    shift: Array

    @property
    def key(self) -> bytes:
        """The content, all of it."""
        return b"".join(
            [self.chambers.tobytes(), self.leaks.conductance.tobytes(), self.leaks.carried_flow.tobytes()]
        )

    def same_but_for_leaks(self, other: MapProblem) -> bool:
        """Whether only the gaps differ, or the viscosity in the ports, which turn from laminar at a few kPa."""
        return all(
            np.array_equal(self.chambers[name], other.chambers[name])
            for name in kernel.CHAMBER.names or ()
            if name != "kinematic_viscosity"
        )


def map_problem(
    pump: PumpDescription, point: OperatingPoint[Array], motion: PistonMotion[Array], leaks: LeakTable
) -> MapProblem:
    """The chamber of a pump at N points, given as columns (N, 1), with gaps that leak as `leaks` (N, 3, M) says."""
    shift = np.broadcast_to(motion.drive.dead_centre_shift, point.shaft_speed.shape).ravel()
    straight = replace(motion, drive=replace(motion.drive, dead_centre_shift=0.0))
    problem = chamber_problem(pump, point, straight, leaks)
    chambers = np.zeros(shift.size, dtype=kernel.CHAMBER)
    chambers["stroke_scale"] = np.ravel(problem.drive.stroke_scale)
    chambers["cone_swash_product"] = np.ravel(problem.drive.cone_swash_product)
    ports = {"suction_port": 0.0, "delivery_port": np.pi}
    for name, opening in zip(ports, port_openings(pump), strict=True):
        chambers[name] = as_array(opening)
        chambers[name][:, 0] += shift
    for name in kernel.CHAMBER.names or ():
        if name not in ("stroke_scale", "cone_swash_product", *ports):
            chambers[name] = np.ravel(getattr(problem, name))
    return MapProblem(chambers, leaks, shift)


def solve_map(pump: PumpDescription, problem: MapProblem, tolerance: float) -> Courses:
    """The periodic revolution at every point, as `chamber.solve_cycle` has it for one, ports held at their means.

    Raises NotConverged with the first point that does not become periodic.
    """
    points, _, samples = problem.leaks.conductance.shape
    nodes, wheres = _nodes(pump, problem.shift, samples)
    firsts = np.cumsum([0, *(own.size for own in nodes)])
    held = np.zeros((points, 1, 2, 4))
    held[:, 0, 0, 0], held[:, 0, 1, 0] = problem.chambers["delivery_pressure"], problem.chambers["inlet_pressure"]
    pressure, totals = np.empty((points, samples)), np.empty((points, 2 * kernel.INTEGRALS))
    statuses = np.empty(points, dtype=np.int64)
    chamber_map(
        problem.chambers, _tables(problem.leaks), held, np.concatenate(nodes), firsts, np.stack(wheres),
        tolerance, max(PERIODICITY, 0.1 * tolerance), REVOLUTION_LIMIT, pressure, totals, statuses,
    )  # fmt: skip
    if np.any(statuses != kernel.OK):
        _tell(problem, int(np.argmax(statuses != kernel.OK)))
    return Courses(pressure, totals[:, : kernel.INTEGRALS])


def _nodes(pump: PumpDescription, shift: Array, samples: int) -> tuple[list[Array], list[np.ndarray]]:
    """Nodes of every point and the places of the samples in them; worked out once for each shift of the ports."""
    found = {}
    for angle in np.unique(shift):
        suction, delivery = port_openings(pump, float(angle))
        found[angle] = turn_nodes(suction, delivery, samples)
    return [found[angle][0] for angle in shift], [found[angle][1] for angle in shift]


def _tables(leaks: LeakTable) -> Array:
    """The gaps' tables (N, M, 7, 4) as the kernel reads them; the volume does not grow besides."""
    points, gaps, samples = leaks.conductance.shape
    rows = np.concatenate([leaks.conductance, leaks.carried_flow, np.zeros((points, 1, samples))], axis=1)
    cubics = periodic_cubics(rows.reshape(-1, samples)).reshape(samples, points, 2 * gaps + 1, 4)
    return np.ascontiguousarray(cubics.transpose(1, 0, 2, 3))


def _tell(problem: MapProblem, point: int) -> None:
    chamber = problem.chambers[point]
    raise NotConverged(
        f"chamber pressure at point {point + 1}: no periodic revolution at {chamber['delivery_pressure'] / 1e6:.3g} "
        f"MPa and {chamber['shaft_speed'] * 60 / TURN:.4g} r/min; check dead volume, bulk modulus and port areas"
    )
