"""One revolution of a chamber for the compiled integration: constants, tables, nodes, arrays of results."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.units import TURN
from system.pump.chamber import kernels as kernel
from system.pump.chamber.layout import INTEGRALS, PATHS, TABLE
from system.pump.chamber.problem import Chamber, ChamberProblem, LeakTable
from system.pump.chamber.state_kernels import CHAMBER
from system.pump.laws.kinematics import Number
from system.pump.ports.areas import PortOpening, as_array, break_angles

Constants = tuple[np.ndarray, Array, Array]
"""The record of the chamber's constants, the table of its gaps and that of its ports."""
PORT_NAMES = ("delivery_port", "suction_port")


def constants(problem: ChamberProblem) -> Constants:
    """A chamber problem as `kernels` reads it."""
    return ported_record(problem), gap_cubics(problem.leaks, problem.growth), _port_cubics(problem)


def ported_record(problem: ChamberProblem) -> np.ndarray:
    """The record (1,) of a chamber's constants with its ports."""
    record = chamber_records(problem)
    record["delivery_port"], record["suction_port"] = (as_array(problem.delivery_port), as_array(problem.suction_port))
    return record


def turn_nodes(suction: PortOpening, delivery: PortOpening, samples: int) -> tuple[Array, np.ndarray]:
    """One turn of angles on which steps must end, and the places in nodes[1:] of the samples from angle 0.

    The turn begins at the sample nearest the middle of the open suction kidney: the port holds the pressure there.
    """
    middle = suction.dead_centre + 0.5 * (suction.kidney_full_start + suction.kidney_full_end)
    first = round(middle / TURN * samples) % samples
    grid = TURN * (first + np.arange(samples + 1)) / samples
    breaks = np.concatenate([break_angles(suction), break_angles(delivery)])
    breaks = (breaks - grid[0]) % TURN + grid[0]
    apart = np.min(np.abs(breaks[:, None] - grid), axis=1) > 1e-9
    nodes = np.unique(np.concatenate([grid, breaks[apart]]))
    return nodes, np.roll(np.searchsorted(nodes, grid[1:]) - 1, first + 1)


@dataclass(frozen=True)
class Course:
    """Results of `kernels.revolution`: pressures, path rates, oil passed at nodes[1:], and the totals."""

    pressures: Array
    rates: Array
    passed: Array
    totals: Array

    @classmethod
    def over(cls, nodes: Array) -> Course:
        """An empty one for a revolution over these nodes."""
        paths = (nodes.size - 1, PATHS)
        return cls(np.empty(nodes.size - 1), np.empty(paths), np.empty(paths), np.empty(2 * INTEGRALS))

    @property
    def filled(self) -> tuple[Array, ...]:
        """The arrays that the kernel fills; it keeps no trail."""
        return self.pressures, self.rates, self.passed, self.totals, np.empty((0, kernel.TRAIL))

    def at(self, nodes: Array, where: np.ndarray) -> Course:
        """The same at the places `where` in nodes[1:], of the oil passed only the part beyond the mean flow."""
        turned = (nodes[1:] - nodes[0]) / TURN
        surge = self.passed - turned[:, None] * self.totals[:PATHS]
        return Course(self.pressures[where], self.rates[where], surge[where] - surge[where[0]], self.totals)


def chamber_records(chamber: Chamber[Number]) -> np.ndarray:
    """The records (N,) of a chamber's constants, CHAMBER without its ports: N points, or one."""
    found = np.zeros(np.size(chamber.shaft_speed), dtype=CHAMBER)
    for name in CHAMBER.names or ():
        owner = chamber if hasattr(chamber, name) else chamber.drive
        if name not in PORT_NAMES:
            found[name] = getattr(owner, name)
    return found


def gap_cubics(leaks: LeakTable, growth: Array | None = None) -> Array:
    """The gaps' table and the growth (M,) of the volume as the kernel reads them, (M, TABLE, 4).

    Of N points at once (N, M, TABLE, 4). Raises ValueError for a growth of another length than the leaks'.
    """
    *points, _, samples = leaks.conductance.shape
    grown = np.zeros(samples) if growth is None else growth
    if grown.shape != (samples,):
        raise ValueError(f"growth of the chamber: found shape {grown.shape}, expected the leak table's ({samples},)")
    rows = [leaks.conductance, leaks.drag_flow, np.broadcast_to(grown, (*points, 1, samples))]
    cubics = periodic_cubics(np.concatenate(rows, axis=-2).reshape(-1, samples))
    return np.ascontiguousarray(np.moveaxis(cubics.reshape(samples, *points, TABLE, 4), 0, -3))


def _port_cubics(problem: ChamberProblem) -> Array:
    """The pressures behind delivery and suction port as the kernel reads them, (M, 2, 4)."""
    if problem.port_pressure is None:
        held = np.zeros((1, 2, 4))
        held[0, :, 0] = problem.delivery_pressure, problem.inlet_pressure
        return held
    return periodic_cubics(np.stack([problem.port_pressure.delivery, problem.port_pressure.suction]))


def periodic_cubics(rows: Array) -> Array:
    """Periodic cubic splines of rows (n, N) at N equidistant angles in unit cells, shape (N, n, 4).

    Solved by Fourier transform.
    """
    waves = TURN * np.fft.rfftfreq(rows.shape[1])
    bend = 6.0 * (np.cos(waves) - 1.0) / (np.cos(waves) + 2.0)
    curvature = np.fft.irfft(np.fft.rfft(rows) * bend, rows.shape[1])
    after, curvature_after = np.roll(rows, -1, axis=1), np.roll(curvature, -1, axis=1)
    slope = after - rows - (2.0 * curvature + curvature_after) / 6.0
    cubic = np.stack([rows, slope, curvature / 2.0, (curvature_after - curvature) / 6.0], axis=-1)
    return np.ascontiguousarray(cubic.transpose(1, 0, 2))


def periodic_values(rows: Array, samples: int) -> Array:
    """The periodic cubic splines of rows (n, N) at `samples` equidistant angles from 0, shape (n, samples)."""
    place = np.arange(samples) * (rows.shape[1] / samples)
    cell = place.astype(int)
    cubic, x = periodic_cubics(rows)[cell], (place - cell)[:, None]
    return np.asarray((cubic[..., 0] + x * (cubic[..., 1] + x * (cubic[..., 2] + x * cubic[..., 3]))).T)
