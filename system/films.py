"""The films fidelity: leakage and viscous friction of the three gaps from films at given positions.

Parts stand where the pump's description puts them; chamber pressure and films are solved in turn until the
pressure of the whole revolution repeats. Coulomb losses are those of the lumped fidelity: a smooth rigid film
knows no contact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from system.assembly import PumpPoint, assemble, met_point
from system.chamber import ChamberCycle, solve_cycle
from system.chamber_problem import ChamberProblem, LeakTable
from system.description import PumpDescription
from system.errors import NotConverged
from system.floating_parts import FloatingParts, floating_parts
from system.gap_cycle import PLAIN, GapCycle, GapPhysics, Report, gap_cycle, silent
from system.instants import Rotor, rotor
from system.kinematics import Array
from system.land_losses import creeping_film_leaks, land_losses, with_inertia
from system.lumped import (
    SAMPLES_PER_PITCH,
    chamber_problem,
    group_masses,
    lumped_pairs,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.lumped_point import lumped_point
from system.operating import OperatingPoint
from system.pairs import FrictionPairs
from system.physics.switched import hold_plain
from system.ports import TURN
from system.ports_coupling import ported_cycle
from system.power import GapExchange, Gaps
from system.unlike import kinds

POSITIONS_PER_PITCH = 4
"""Block angles a piston pitch at which films are solved: 10 deg on nine pistons; an even divisor of
SAMPLES_PER_PITCH. Five times as many move REF90's leakage by 0.1 % (benchmarks/pump.py has the cost)."""
TOLERANCE = 1e-6
"""Largest change of the chamber pressure between two rounds, of delivery minus inlet pressure."""
ROUND_LIMIT = 12


@dataclass(frozen=True)
class FilmsPoint:
    """One coupled operating point: the pump, its films over the revolution, and the evidence of convergence.

    parts: with every value taken; rounds of films and chamber; pressure_change: the last round's largest, Pa;
    sampling_error: change of the leakage (relative) when the chamber knows only every second film angle.
    """

    rotor: Rotor
    parts: FloatingParts
    pump_point: PumpPoint
    gaps: GapCycle
    rounds: int
    pressure_change: float
    sampling_error: float


def films_point(
    pump: PumpDescription,
    point: OperatingPoint,
    *,
    physics: GapPhysics = PLAIN,
    positions_per_pitch: int = POSITIONS_PER_PITCH,
    finer: float = 1.0,
    tolerance: float = TOLERANCE,
    report: Report = silent,
) -> FilmsPoint:
    """One periodic operating point with films solved over the revolution, on meshes `finer` times the usual.

    Chamber pressure repeats to `tolerance` of the ports' difference. With heat in the physics the lumped Coulomb
    loss of the pairs warms their walls too.

    Raises NotConverged when chamber pressure and films do not settle within ROUND_LIMIT rounds, ValueError when
    `positions_per_pitch` is no even divisor of SAMPLES_PER_PITCH or chambers differ, FilmInputError where parts
    touch at a given position. Films have no history; smooth, rigid and isothermal where the physics is as given.
    """
    kinds(pump).hold_alike()
    hold_plain(pump)
    if positions_per_pitch % 2 or SAMPLES_PER_PITCH % positions_per_pitch:
        raise ValueError(
            f"positions per pitch: found {positions_per_pitch}, expected an even divisor of {SAMPLES_PER_PITCH}"
        )
    motion, lines = piston_motion(pump, point), port_lines(pump, point)
    every = SAMPLES_PER_PITCH // positions_per_pitch
    lumped = lumped_point(pump, point)
    at, parts, rounds, cycle = rotor(pump, lumped.point), floating_parts(pump), 0, lumped.cycle
    limit = tolerance * (abs(point.delivery_pressure - point.inlet_pressure) + 1e5)
    while rounds < ROUND_LIMIT:
        rounds += 1
        gaps = gap_cycle(
            at, parts, cycle.shaft_angle[::every], cycle.pressure[::every], report, physics=physics,
            rubbing=_rubbing(lumped_pairs(pump, point, motion, cycle)), finer=finer,
        )  # fmt: skip
        problem = chamber_problem(pump, point, motion, edged_leaks(pump, point, gaps))
        draws = port_draws(gaps, at.point, pump.oil.bulk_modulus)
        ported = ported_cycle((problem,), lines, pump.pump.pistons, motion.shaft_angle.size, draws=draws)
        at = rotor(pump, met_point(point, ported))
        before, cycle = cycle, ported.cycle
        change = float(np.max(np.abs(cycle.pressure - before.pressure)))
        if change <= limit:
            break
    else:
        raise NotConverged(
            f"films and chamber pressure: after {ROUND_LIMIT} rounds the pressure still changes by {change:.3g} "
            f"Pa, expected at most {limit:.3g} Pa; try the lumped fidelity, or more film angles"
        )
    exchange = gap_exchange(gaps, cycle, pump.pump.pistons, point)
    losses = with_film_shear(lumped_pairs(pump, point, motion, cycle), gaps, point.case_pressure)
    derived = swept_displacement(pump, motion.drive)
    pump_point = assemble(point, ported, (losses,), pump.pump.pistons, derived, exchange, (group_masses(pump),))
    return FilmsPoint(at, parts, pump_point, gaps, rounds, change, _sampling_error(ported.problem, cycle))


def _rubbing(losses: FrictionPairs) -> tuple[float, float, float]:
    """Mean Coulomb loss (W) of one piston, one slipper and the ring."""
    pairs = losses.piston_cylinder, losses.slipper_swash_plate, losses.valve_plate_cylinder
    piston, slipper, ring = (pair.mean_coulomb / pair.count for pair in pairs)
    return piston, slipper, ring


def leak_table(gaps: GapCycle, case_pressure: float) -> LeakTable:
    """Flow out of one chamber into each gap as G (p - p_case) + C, exact at the pressures of `gaps`."""
    return LeakTable(gaps.conductance, gaps.flow - gaps.conductance * (gaps.chamber_pressure - case_pressure))


def edged_leaks(pump: PumpDescription, point: OperatingPoint, gaps: GapCycle) -> LeakTable:
    """`leak_table` with what the lands' edges lose where files say it (`land_losses`); pressures of films stay."""
    leaks = leak_table(gaps, point.case_pressure)
    if not land_losses(pump).any:
        return leaks
    creeping = creeping_film_leaks(pump, leaks, point.viscosity)
    drop = gaps.chamber_pressure - point.case_pressure
    return with_inertia(pump, creeping, drop, point.viscosity, bore=False)


def gap_exchange(gaps: GapCycle, cycle: ChamberCycle, pistons: int, point: OperatingPoint) -> GapExchange:
    """Power of the oil that moving walls drag along, and what the valve plate's film takes from the ports."""
    rate = pistons * point.shaft_speed / TURN
    piston, slipper = rate * cycle.carried_energy[:2]
    return GapExchange(
        carried=Gaps(float(piston), float(slipper), float(gaps.carried_power.mean())),
        delivery_draw=float(np.mean([film.delivery_flow for film in gaps.valve_plate])),
        suction_draw=float(np.mean([film.suction_flow for film in gaps.valve_plate])),
    )


def port_draws(gaps: GapCycle, point: OperatingPoint, bulk_modulus: float) -> tuple[float, float]:
    """What the valve plate's film takes from delivery and suction port, mean, m3/s at zero gauge pressure."""
    delivery = float(np.mean([film.delivery_flow for film in gaps.valve_plate]))
    suction = float(np.mean([film.suction_flow for film in gaps.valve_plate]))
    dense = np.exp(np.array([point.delivery_pressure, point.inlet_pressure]) / bulk_modulus)
    return delivery * float(dense[0]), suction * float(dense[1])


def film_shear(gaps: GapCycle, case_pressure: float) -> tuple[Array, Array, Array]:
    """Viscous loss (W) of one piston (N,), one slipper (N,) and the ring (N/z,).

    Power of the walls plus what the oil they drag along gives back, P + C (p - p_case): the film's dissipation
    less that of its pressure flow, which is leakage loss.
    """
    carried = leak_table(gaps, case_pressure).carried_flow * (gaps.chamber_pressure - case_pressure)
    piston = np.array([film.friction_power for film in gaps.piston]) + carried[0]
    slipper = np.array([film.friction_power for film in gaps.slipper]) + carried[1]
    ring = np.array([film.gap.friction_power for film in gaps.valve_plate]) + gaps.carried_power
    return piston, slipper, ring


def with_film_shear(losses: FrictionPairs, gaps: GapCycle, case_pressure: float) -> FrictionPairs:
    """The pairs with the viscous part of the three gaps' pairs from the films, between film angles linear.

    Linear between equidistant angles keeps the mean of the film solves exactly.
    """
    piston, slipper, ring = film_shear(gaps, case_pressure)
    samples = losses.piston_cylinder.viscous.size
    ring_turn = np.tile(ring, len(gaps.shaft_angle) // len(ring))
    return replace(
        losses,
        piston_cylinder=replace(losses.piston_cylinder, viscous=_refine(piston, samples)),
        slipper_swash_plate=replace(losses.slipper_swash_plate, viscous=_refine(slipper, samples)),
        valve_plate_cylinder=replace(losses.valve_plate_cylinder, viscous=_refine(ring_turn, samples)),
    )


def _refine(periodic: Array, samples: int) -> Array:
    turns = np.arange(samples) / samples
    return np.interp(turns, np.arange(periodic.size) / periodic.size, periodic, period=1.0)


def _sampling_error(problem: ChamberProblem, cycle: ChamberCycle) -> float:
    """Relative change of the leakage when the chamber knows only every second film angle."""
    leaks = problem.leaks
    halved = LeakTable(leaks.conductance[:, ::2].copy(), leaks.carried_flow[:, ::2].copy())
    coarse = solve_cycle(replace(problem, leaks=halved), cycle.shaft_angle.size)
    fine, rough = (float(c.outflow.piston + c.outflow.slipper + c.outflow.valve_plate) for c in (cycle, coarse))
    return abs(rough - fine) / abs(fine)
