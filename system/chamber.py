"""Pressure of one displacement chamber over a periodic revolution: the paper's Eqs. (14), (18)-(20), corrected.

As printed, Eq. (14) with (18) and (19) counts the displacement twice and the pump delivers nothing. Here the
chamber keeps its mass: dp/dt = (K/V)(-Ap v - q_port - sum of leaks), V = V0 + Ap S, every q > 0 out of the
chamber. The gaps' leakage is q(phi, p) = G(phi) (p - p_case) + C(phi) from a table, whoever filled it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from system import chamber_kernel as kernel
from system.errors import NotConverged
from system.kinematics import Array, SwashDrive, piston_displacement, stroke
from system.ports import TURN, PortOpening, as_array, break_angles

TOLERANCE = 1e-6
"""Largest local error of a step, of the port pressure difference; the closed revolution is good to about this."""
PERIODICITY = 1e-8
"""Largest change of the pressure at shaft angle 0 from one revolution to the next, of the pressure difference."""
REVOLUTION_LIMIT = 60
RUN_IN_NODES = 6


@dataclass(frozen=True)
class LeakTable:
    """Leakage of the piston, slipper and valve-plate gap of one chamber (rows 0, 1, 2) over one turn.

    Columns: N equidistant shaft angles 2 pi j/N from 0; conductance in m3/(s Pa), all >= 0, carried_flow in m3/s,
    both for flow out of the chamber. Between the columns runs a periodic cubic spline: with two continuous
    derivatives it keeps the integrator's order, and steps need not end on the table's angles; a linear one would
    bend at each of them. Raises ValueError for a wrong shape or a negative conductance.
    """

    conductance: Array
    carried_flow: Array

    def __post_init__(self) -> None:
        shape = self.conductance.shape
        if len(shape) != 2 or shape[0] != 3 or shape[1] < 4 or self.carried_flow.shape != shape:
            raise ValueError(
                f"leak table: found shapes {shape} and {self.carried_flow.shape}, expected (3, N) with N >= 4"
            )
        if np.any(self.conductance < 0.0):
            raise ValueError(
                f"leak table: found conductance {self.conductance.min():.3g} m3/(s Pa), expected 0 or more"
            )


@dataclass(frozen=True)
class ChamberProblem:
    """One chamber at one operating point: SI units, pressures gauge, oil properties constant."""

    drive: SwashDrive
    shaft_speed: float
    piston_area: float
    dead_volume: float
    delivery_pressure: float
    inlet_pressure: float
    case_pressure: float
    bulk_modulus: float
    density: float
    kinematic_viscosity: float
    flow_coefficient: float
    critical_reynolds: float
    delivery_port: PortOpening
    suction_port: PortOpening
    leaks: LeakTable

    def specific_volume(self, pressure: float) -> float:
        """Volume of the oil at a pressure in Pa over its volume at zero gauge pressure."""
        return float(kernel.oil_state(pressure, self.bulk_modulus)[0])


@dataclass(frozen=True)
class Paths:
    """One number, or one array over shaft angle, for each way out of the chamber."""

    delivery: Array
    suction: Array
    piston: Array
    slipper: Array
    valve_plate: Array


@dataclass(frozen=True)
class ChamberChecks:
    """How well one periodic revolution was solved.

    mass_balance_error: net outflow plus change of content, of the swept volume; energy_balance_error: indicated
    work minus all it went into (not imposed, so a measure of the whole integration) and work_error: the embedded
    method's own estimate for the indicated work, both of the ideal work, swept volume times (pressure difference
    + 1 bar); periodicity_error in Pa.
    """

    mass_balance_error: float
    energy_balance_error: float
    work_error: float
    periodicity_error: float


@dataclass(frozen=True)
class Effort:
    """What the solution took: revolutions until periodic, steps taken and refused in the last of them."""

    revolutions: int
    steps: int
    refused_steps: int


@dataclass(frozen=True)
class ChamberCycle:
    """One periodic revolution of one chamber.

    Arrays over `shaft_angle` (N equidistant in [0, 2 pi), rad): pressure in Pa gauge, volume in m3, `flow` in
    m3/s of liquid at chamber pressure, positive out. Per revolution: `outflow` in m3 at the density of zero gauge
    pressure; `path_energy` in J, throttled in the ports and given off in the gaps; `carried_energy` in J (piston,
    slipper, valve plate), the part of it that carried oil gives to the walls that carry it, which is not lost
    (negative: the walls push the oil in); `indicated_work` in J, done by the piston on the chamber: -integral of
    p dV.
    """

    shaft_angle: Array
    pressure: Array
    volume: Array
    flow: Paths
    outflow: Paths
    path_energy: Paths
    carried_energy: Array
    indicated_work: float
    checks: ChamberChecks
    effort: Effort

    @property
    def cavitates(self) -> bool:
        """Whether the chamber holds a cavity at any sampled shaft angle."""
        return bool(np.min(self.pressure) < kernel.CAVITY_PRESSURE)


def solve_cycle(problem: ChamberProblem, samples: int, tolerance: float = TOLERANCE) -> ChamberCycle:
    """The periodic revolution of a chamber, sampled at `samples` equidistant shaft angles.

    Integrates Eq. (14) in its conservative form (see `chamber_kernel`) from break to break of the ports, turn by
    turn, until the pressure at shaft angle 0 repeats to PERIODICITY. Raises NotConverged when it does not within
    REVOLUTION_LIMIT turns or when a step fails. Where the pressure falls to
    `chamber_kernel.CAVITY_PRESSURE` a cavity opens and fills again; the ports' and case's oil is always liquid.
    """
    chamber, table = _constants(problem), _spline_table(problem.leaks)
    nodes, sample_nodes = _nodes(problem, samples)
    pressures, rates = np.empty(nodes.size - 1), np.empty((nodes.size - 1, kernel.PATHS))
    totals = np.empty(2 * kernel.INTEGRALS)
    limit = PERIODICITY * _pressure_span(problem)
    start = _run_in(problem, chamber, table, nodes, tolerance)
    turns, change = 0, np.inf
    while abs(change) > limit:
        if turns == REVOLUTION_LIMIT:
            raise NotConverged(
                f"chamber pressure: after {turns} revolutions it still changes by {abs(change):.3g} Pa per "
                f"revolution, expected at most {limit:.3g} Pa; check that both ports open"
            )
        drift, steps, refused, status = kernel.revolution(
            chamber, table, nodes, start, tolerance, pressures, rates, totals
        )
        if status != kernel.OK:
            raise NotConverged(_step_message(status, problem))
        turns += 1
        change = float(pressures[-1] - start)
        start = float(pressures[-1])
    checks = _checks(problem, totals, drift, change)
    effort = Effort(turns, steps, refused)
    return _cycle(problem, effort, pressures[sample_nodes], rates[sample_nodes], totals, checks)


def _run_in(problem: ChamberProblem, chamber: np.ndarray, table: Array, nodes: Array, tolerance: float) -> float:
    """A pressure at nodes[0] that an open port has already made its own: most pumps are periodic from there on."""
    before = nodes[-RUN_IN_NODES:] - TURN
    start, found = kernel.slaved_pressure(chamber, table, before[0])
    pressures, rates = np.empty(before.size - 1), np.empty((before.size - 1, kernel.PATHS))
    totals = np.empty(2 * kernel.INTEGRALS)
    if not found:
        return problem.inlet_pressure
    *_, status = kernel.revolution(chamber, table, before, start, tolerance, pressures, rates, totals)
    return float(pressures[-1]) if status == kernel.OK else problem.inlet_pressure


def _pressure_span(problem: ChamberProblem) -> float:
    return abs(problem.delivery_pressure - problem.inlet_pressure) + 1e5


def _constants(problem: ChamberProblem) -> np.ndarray:
    chamber = np.zeros(1, dtype=kernel.CHAMBER)
    chamber["stroke_scale"] = problem.drive.stroke_scale
    chamber["cone_swash_product"] = problem.drive.cone_swash_product
    chamber["delivery_port"] = as_array(problem.delivery_port)
    chamber["suction_port"] = as_array(problem.suction_port)
    for name in kernel.CHAMBER.names or ():
        if name not in ("stroke_scale", "cone_swash_product", "delivery_port", "suction_port"):
            chamber[name] = getattr(problem, name)
    return chamber


def _nodes(problem: ChamberProblem, samples: int) -> tuple[Array, np.ndarray]:
    """One turn of angles that steps must end on, and where in nodes[1:] the samples from angle 0 lie.

    The turn begins at the sample nearest the middle of the open suction kidney: the port holds the pressure there.
    """
    port = problem.suction_port
    middle = port.dead_centre + 0.5 * (port.kidney_full_start + port.kidney_full_end)
    first = round(middle / TURN * samples) % samples
    grid = TURN * (first + np.arange(samples + 1)) / samples
    breaks = np.concatenate([break_angles(problem.suction_port), break_angles(problem.delivery_port)])
    breaks = (breaks - grid[0]) % TURN + grid[0]
    apart = np.min(np.abs(breaks[:, None] - grid), axis=1) > 1e-9
    nodes = np.unique(np.concatenate([grid, breaks[apart]]))
    return nodes, np.roll(np.searchsorted(nodes, grid[1:]) - 1, first + 1)


def _spline_table(leaks: LeakTable) -> Array:
    """Periodic cubic spline of all six rows in unit cells, shape (N, 6, 4); solved by Fourier transform."""
    rows = np.concatenate([leaks.conductance, leaks.carried_flow])
    waves = TURN * np.fft.rfftfreq(rows.shape[1])
    bend = 6.0 * (np.cos(waves) - 1.0) / (np.cos(waves) + 2.0)
    curvature = np.fft.irfft(np.fft.rfft(rows) * bend, rows.shape[1])
    after, curvature_after = np.roll(rows, -1, axis=1), np.roll(curvature, -1, axis=1)
    slope = after - rows - (2.0 * curvature + curvature_after) / 6.0
    cubic = np.stack([rows, slope, curvature / 2.0, (curvature_after - curvature) / 6.0], axis=-1)
    return np.ascontiguousarray(cubic.transpose(1, 0, 2))


def _step_message(status: int, problem: ChamberProblem) -> str:
    what = "a step became too small" if status == kernel.STEP_TOO_SMALL else "a stage found no pressure"
    return (
        f"chamber pressure: {what} at {problem.delivery_pressure / 1e6:.3g} MPa and "
        f"{problem.shaft_speed * 60 / TURN:.4g} r/min; check dead volume, bulk modulus and port areas"
    )


def _checks(problem: ChamberProblem, totals: Array, drift: float, change: float) -> ChamberChecks:
    outflow, work, energy = totals[:5], totals[5], totals[6:11]
    case = problem.case_pressure
    outside = np.array([problem.delivery_pressure, problem.inlet_pressure, case, case, case])
    carried_away = outflow @ flow_energy(outside, problem.bulk_modulus)
    swept = problem.piston_area * stroke(problem.drive)
    ideal_work = swept * _pressure_span(problem)
    return ChamberChecks(
        mass_balance_error=float(abs(outflow.sum() + drift) / swept),
        energy_balance_error=float(abs(work - energy.sum() - carried_away) / ideal_work),
        work_error=float(abs(totals[kernel.INTEGRALS + 5]) / ideal_work),
        periodicity_error=abs(change),
    )


def flow_energy(pressure: Array | float, bulk_modulus: float) -> Array:
    """Energy in J that a flow carries per m3 of its volume at zero gauge pressure: h = K (1 - exp(-p/K)).

    Pressure work plus elastic energy of an oil of constant bulk modulus; p (1 - p/2K) to second order.
    """
    return np.asarray(-bulk_modulus * np.expm1(-np.asarray(pressure) / bulk_modulus))


def _cycle(
    problem: ChamberProblem,
    effort: Effort,
    pressure: Array,
    mass_rates: Array,
    totals: Array,
    checks: ChamberChecks,
) -> ChamberCycle:
    samples = pressure.size
    angle = TURN * np.arange(samples) / samples
    liquid = np.exp(-np.maximum(pressure, kernel.CAVITY_PRESSURE) / problem.bulk_modulus)
    return ChamberCycle(
        shaft_angle=angle,
        pressure=pressure,
        volume=problem.dead_volume + problem.piston_area * piston_displacement(problem.drive, angle),
        flow=Paths(*(mass_rates * problem.shaft_speed * liquid[:, None]).T),
        outflow=Paths(*totals[:5]),
        path_energy=Paths(*totals[6:11]),
        carried_energy=totals[11:14],
        indicated_work=float(totals[5]),
        checks=checks,
        effort=effort,
    )
