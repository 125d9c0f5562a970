"""Pressure of one displacement chamber over a periodic revolution.

Eqs. (14) and (18)-(20) of Xu, Hu, Zhang and Mao (2017), corrected.

As printed, Eq. (14) with (18) and (19) counts the displacement twice and the pump delivers nothing. Here the
chamber keeps its mass: dp/dt = (K/V)(-Ap v - q_port - sum of leaks), V = V0 + Ap S, every q > 0 out of the
chamber. The gaps' leakage is q(phi, p) = G(phi) (p - p_case) + C(phi) from a table, whoever filled it; V may
grow besides by what the parts themselves move, and the pressures behind the ports may vary over the turn.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.errors import NotConverged
from system.inputs.units import TURN
from system.pump.chamber import kernels as kernel
from system.pump.chamber.layout import (
    CARRIED_ENERGY,
    CAVITY_PRESSURE,
    GAPS,
    INTEGRALS,
    OUTFLOW,
    PATH_ENERGY,
    PATHS,
    PISTON,
    PORT_ENERGY,
    PORTS,
    WORK,
)
from system.pump.chamber.map_kernels import run_in
from system.pump.chamber.problem import ChamberProblem
from system.pump.chamber.setup import Course, constants, periodic_values, turn_nodes
from system.pump.chamber.state_kernels import oil_change
from system.pump.laws.kinematics import piston_displacement, stroke

TOLERANCE = 1e-6
"""Largest local error of a step, of the port pressure difference; the closed revolution is good to about this."""
PERIODICITY = 1e-8
"""Largest change of the oil held from one revolution to the next, as `oil_change`, of the pressure difference."""
REVOLUTION_LIMIT = 60


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
    (negative: the walls push the oil in); `indicated_work` in J, done on the chamber: -integral of p dV, and
    `growth_work`, the part of it that the growth of the volume does in place of the piston's way; `port_energy`
    (2,) in J, pressure work and elastic energy of the oil that goes into delivery and suction port. `surge` (2, N)
    in m3 at zero gauge pressure: what has gone into either since shaft angle 0 beyond the mean flow.
    """

    shaft_angle: Array
    pressure: Array
    volume: Array
    flow: Paths
    outflow: Paths
    path_energy: Paths
    carried_energy: Array
    indicated_work: float
    growth_work: float
    port_energy: Array
    surge: Array
    checks: ChamberChecks
    effort: Effort

    @property
    def cavitates(self) -> bool:
        """Whether the chamber holds a cavity at any sampled shaft angle."""
        return bool(np.min(self.pressure) < CAVITY_PRESSURE)


def solve_cycle(problem: ChamberProblem, samples: int, tolerance: float = TOLERANCE) -> ChamberCycle:
    """The periodic revolution of a chamber, sampled at `samples` equidistant shaft angles.

    Integrates Eq. (14) in its conservative form (see `state_kernels`) from break to break of the ports,
    turn by turn, until the oil in the chamber where a turn begins repeats to PERIODICITY. Raises NotConverged when
    it does not within REVOLUTION_LIMIT turns or when a step fails. Where the pressure falls to
    CAVITY_PRESSURE a cavity opens and fills again; the ports' and case's oil is always
    liquid.
    """
    given = constants(problem)
    nodes, sample_nodes = turn_nodes(problem.suction_port, problem.delivery_port, samples)
    course = Course.over(nodes)
    limit = PERIODICITY * problem.pressure_span
    start = run_in(given, nodes, tolerance, course.totals)
    turns, change = 0, np.inf
    while abs(change) > limit:
        if turns == REVOLUTION_LIMIT:
            raise NotConverged(
                f"chamber pressure: after {turns} revolutions its oil still changes as by {abs(change):.3g} Pa a "
                f"revolution, expected at most {limit:.3g} Pa; check that both ports open"
            )
        drift, steps, refused, status = course.run(given, nodes, start, tolerance)
        if status != kernel.OK:
            raise NotConverged(_step_message(status, problem))
        turns += 1
        change = oil_change(start, course.pressures[-1], problem.bulk_modulus)
        start = float(course.pressures[-1])
    checks = _checks(problem, course.totals, drift, change)
    effort = Effort(turns, steps, refused)
    return _cycle(problem, effort, course.at(nodes, sample_nodes), course.totals, checks)


def _step_message(status: int, problem: ChamberProblem) -> str:
    what = "a step became too small" if status == kernel.STEP_TOO_SMALL else "a stage found no pressure"
    return (
        f"chamber pressure: {what} at {problem.delivery_pressure / 1e6:.3g} MPa and "
        f"{problem.shaft_speed * 60 / TURN:.4g} r/min; check dead volume, bulk modulus and port areas"
    )


def _checks(problem: ChamberProblem, totals: Array, drift: float, change: float) -> ChamberChecks:
    outflow, energy = totals[OUTFLOW : OUTFLOW + PATHS], totals[PATH_ENERGY : PATH_ENERGY + PATHS]
    to_case = outflow[PISTON:].sum() * flow_energy(problem.case_pressure, problem.bulk_modulus)
    carried_away = totals[PORT_ENERGY : PORT_ENERGY + PORTS].sum() + to_case
    swept = problem.piston_area * stroke(problem.drive)
    ideal_work = swept * problem.pressure_span
    return ChamberChecks(
        mass_balance_error=float(abs(outflow.sum() + drift) / swept),
        energy_balance_error=float(abs(totals[WORK] - energy.sum() - carried_away) / ideal_work),
        work_error=float(abs(totals[INTEGRALS + WORK]) / ideal_work),
        periodicity_error=abs(change),
    )


def flow_energy(pressure: Array | float, bulk_modulus: float) -> Array:
    """Energy in J that a flow carries per m3 of its volume at zero gauge pressure: h = K (1 - exp(-p/K)).

    Pressure work plus elastic energy of an oil of constant bulk modulus; p (1 - p/2K) to second order.
    """
    return np.asarray(-bulk_modulus * np.expm1(-np.asarray(pressure) / bulk_modulus))


def _cycle(
    problem: ChamberProblem, effort: Effort, course: Course, totals: Array, checks: ChamberChecks
) -> ChamberCycle:
    samples = course.pressures.size
    angle = TURN * np.arange(samples) / samples
    growth = 0.0 if problem.growth is None else periodic_values(problem.growth[None], samples)[0]
    liquid = np.exp(-np.maximum(course.pressures, CAVITY_PRESSURE) / problem.bulk_modulus)
    return ChamberCycle(
        shaft_angle=angle,
        pressure=course.pressures,
        volume=problem.dead_volume + problem.piston_area * piston_displacement(problem.drive, angle) + growth,
        flow=Paths(*(course.rates * problem.shaft_speed * liquid[:, None]).T),
        outflow=Paths(*totals[OUTFLOW : OUTFLOW + PATHS]),
        path_energy=Paths(*totals[PATH_ENERGY : PATH_ENERGY + PATHS]),
        carried_energy=totals[CARRIED_ENERGY : CARRIED_ENERGY + GAPS],
        indicated_work=float(totals[WORK]),
        growth_work=_growth_work(problem, course.pressures),
        port_energy=totals[PORT_ENERGY : PORT_ENERGY + PORTS],
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
