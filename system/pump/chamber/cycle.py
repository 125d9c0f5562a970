"""Pressure of one displacement chamber over a periodic revolution.

Eqs. (14) and (18)-(20) of Xu, Hu, Zhang and Mao (2017), corrected.

As printed, Eq. (14) with (18) and (19) counts the displacement twice and the pump delivers nothing. Here the chamber
keeps its mass: dp/dt = (K/V)(-Ap v - q_port - sum of leaks), V = V0 + Ap S, every q > 0 out of the chamber. The gaps'
leakage is q(phi, p) = G(phi) (p - p_case) + C(phi) from a table; V may also grow by the parts' own small motion, and
the pressures behind the ports may vary over the turn.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.inputs.units import STANDARD_ATMOSPHERE, TURN
from system.pump.chamber import kernels as kernel
from system.pump.chamber.layout import CAVITY_PRESSURE, INTEGRALS, PORTS, WORK
from system.pump.chamber.map_kernels import periodic
from system.pump.chamber.problem import Chamber, ChamberProblem
from system.pump.chamber.setup import Course, chamber_records, constants, periodic_values, turn_nodes
from system.pump.chamber.state_kernels import energy_at, oil_of
from system.pump.chamber.trail_kernels import NOT_PERIODIC
from system.pump.chamber.turn import Paths, TurnTotals, turn_totals
from system.pump.laws.kinematics import Number, piston_displacement, stroke

TOLERANCE = 1e-6
"""Largest local error of a step, of the port pressure difference; the closed revolution has about this accuracy."""
PERIODICITY = 1e-8
"""Largest change of the oil held from one revolution to the next, as `oil_change`, of the pressure difference."""
REVOLUTION_LIMIT = 60


@dataclass(frozen=True)
class ChamberChecks:
    """Errors of one periodic revolution.

    mass_balance_error: net outflow plus change of content, of the swept volume; energy_balance_error: indicated work
    less all sinks (not imposed, so a measure of the whole integration) and work_error: the embedded method's own
    estimate for the indicated work, both of the ideal work, swept volume times (pressure difference + 1 bar);
    periodicity_error in Pa.
    """

    mass_balance_error: float
    energy_balance_error: float
    work_error: float
    periodicity_error: float


@dataclass(frozen=True)
class Effort:
    """Effort of the solution: revolutions until periodic, steps taken in the last of them."""

    revolutions: int
    steps: int


@dataclass(frozen=True)
class ChamberCycle(TurnTotals):
    """One periodic revolution of one chamber.

    Arrays over `shaft_angle` (N equidistant in [0, 2 pi), rad): pressure in Pa gauge, volume in m3, `flow` in m3/s of
    liquid at chamber pressure, positive out. Per revolution beside its totals: `growth_work` in J, the part of the
    indicated work done by the growth of the volume in place of the piston's way. `surge` (2, N) in m3 at zero gauge
    pressure: the oil into either port since shaft angle 0 beyond the mean flow.
    """

    shaft_angle: Array
    pressure: Array
    volume: Array
    flow: Paths[Array]
    growth_work: float
    surge: Array
    checks: ChamberChecks
    effort: Effort

    @property
    def cavitates(self) -> bool:
        """True if the chamber has a cavity at any sampled shaft angle."""
        return bool(np.min(self.pressure) < CAVITY_PRESSURE)


def solve_cycle(problem: ChamberProblem, samples: int, tolerance: float = TOLERANCE) -> ChamberCycle:
    """The periodic revolution of a chamber, sampled at `samples` equidistant shaft angles.

    Integrates Eq. (14) in its conservative form (see `state_kernels`) from break to break of the ports, turn by turn,
    until the oil in the chamber where a turn begins repeats to PERIODICITY. Raises NotConverged when it does not within
    REVOLUTION_LIMIT turns or when a step fails. Where the pressure falls to CAVITY_PRESSURE a cavity opens and fills
    again; the ports' and case's oil is always liquid.
    """
    nodes, sample_nodes = turn_nodes(problem.suction_port, problem.delivery_port, samples)
    course = Course.over(nodes)
    limits = tolerance, PERIODICITY, REVOLUTION_LIMIT
    solved = periodic(constants(problem), nodes, limits, course.filled)
    turns, steps, drift, change, status = solved
    if status == NOT_PERIODIC:
        limit = PERIODICITY * problem.pressure_span
        raise NotConverged(
            f"chamber pressure: after {turns} revolutions its oil still changes as by {abs(change):.3g} Pa a "
            f"revolution, expected at most {limit:.3g} Pa; check that both ports open"
        )
    if status != kernel.OK:
        what = "a step became too small" if status == kernel.STEP_TOO_SMALL else "a stage found no pressure"
        raise unsolved(what, problem.delivery_pressure, problem.shaft_speed)
    checks = _checks(problem, course.totals, drift, change)
    return _cycle(problem, Effort(turns, steps), course.at(nodes, sample_nodes), checks)


def unsolved(what: str, delivery_pressure: float, shaft_speed: float) -> NotConverged:
    """The error of a chamber without a periodic turn at a point, Pa and rad/s."""
    return NotConverged(
        f"chamber pressure: {what} at {delivery_pressure / 1e6:.3g} MPa and {shaft_speed * 60 / TURN:.4g} r/min; "
        "check dead volume, bulk modulus and port areas"
    )


def _checks(problem: ChamberProblem, integrals: Array, drift: float, change: float) -> ChamberChecks:
    totals = turn_totals(integrals)
    to_case = totals.outflow.gaps * energy_at(problem.case_pressure, oil_of(chamber_records(problem)))
    taken = totals.port_energy.sum() + to_case
    swept = problem.piston_area * stroke(problem.drive)
    ideal_work = swept * problem.pressure_span
    return ChamberChecks(
        mass_balance_error=float(abs(totals.outflow.total + drift) / swept),
        energy_balance_error=float(abs(totals.indicated_work - totals.path_energy.total - taken) / ideal_work),
        work_error=float(abs(integrals[INTEGRALS + WORK]) / ideal_work),
        periodicity_error=abs(change),
    )


def flow_energy(pressure: Array | float, bulk_modulus: float) -> Array:
    """Energy in J that a flow carries per m3 of its volume at zero gauge pressure: h = K (1 - exp(-p/K)).

    Pressure work plus elastic energy of an oil of constant bulk modulus; p (1 - p/2K) to second order.
    """
    return np.asarray(-bulk_modulus * np.expm1(-np.asarray(pressure) / bulk_modulus))


def specific_volume(pressure: Number, bulk_modulus: float) -> Number:
    """Volume of liquid oil at a pressure in Pa over its volume at zero gauge pressure: exp(-p/K)."""
    found: Any = np.exp(-pressure / bulk_modulus)
    return float(found) if isinstance(pressure, float) else found


def bubbly_volume(pressure: Number, chamber: Chamber[Any]) -> Number:
    """Volume of a chamber's oil with its bubbles at a pressure in Pa, over that of liquid at zero gauge pressure."""
    absolute: Any = pressure + STANDARD_ATMOSPHERE
    bubbles = chamber.free_air * (STANDARD_ATMOSPHERE / absolute) ** chamber.air_exponent
    return specific_volume(pressure, chamber.bulk_modulus) + bubbles


def _cycle(problem: ChamberProblem, effort: Effort, course: Course, checks: ChamberChecks) -> ChamberCycle:
    samples = course.pressures.size
    angle = TURN * np.arange(samples) / samples
    growth = 0.0 if problem.growth is None else periodic_values(problem.growth[None], samples)[0]
    flowing = bubbly_volume(np.maximum(course.pressures, CAVITY_PRESSURE), problem)
    return ChamberCycle(
        **vars(turn_totals(course.totals)),
        shaft_angle=angle,
        pressure=course.pressures,
        volume=problem.dead_volume + problem.piston_area * piston_displacement(problem.drive, angle) + growth,
        flow=Paths(*(course.rates * problem.shaft_speed * flowing[:, None]).T),
        growth_work=_growth_work(problem, course.pressures),
        surge=course.passed[:, :PORTS].T,
        checks=checks,
        effort=effort,
    )


def _growth_work(problem: ChamberProblem, pressure: Array) -> float:
    """-integral of p d(growth) in J by the trapezoidal rule over the sampled pressures (N,)."""
    if problem.growth is None:
        return 0.0
    growth = periodic_values(problem.growth[None], pressure.size)[0]
    return float(0.5 * np.sum(pressure * (np.roll(growth, 1) - np.roll(growth, -1))))
