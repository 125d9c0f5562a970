"""The fidelity fixed: leakage and viscous friction of the three gaps from films at given positions.

The parts have the positions of the pump's description. Chamber pressure and films are solved in turn until the pressure
of the whole revolution repeats. Coulomb losses are those of the lumped fidelity, since a smooth film has no contact.
Films solve some effects of [physics] themselves (`film_effects`); the others act as at the lumped fidelity.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from reynolds.errors import InputError, NotConverged
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.applied import affected_leaks
from system.effects.effect import Effects
from system.effects.friction import rubbed
from system.films.cycle import PLAIN, GapCycle, GapPhysics, gap_cycle
from system.films.parts import FloatingParts, floating_parts
from system.films.rotor import Rotor, rotor
from system.inputs.units import TURN
from system.points.effects import affected_problem, at_the_ports, mean_outside
from system.points.film_effects import FilmEffects, closed_laws, film_effects
from system.points.lumped import point_and_effects
from system.pump.assembly import PumpPoint, assemble, met_point
from system.pump.chamber.cycle import ChamberCycle, solve_cycle
from system.pump.chamber.port_coupling import PortedCycle, ported_cycle
from system.pump.chamber.problem import ChamberProblem, LeakTable
from system.pump.chamber_kinds import kinds
from system.pump.film_thickness import at_temperature, unpressed
from system.pump.land_losses import creeping_film_leaks, land_losses, with_inertia
from system.pump.laws.friction_pairs import FrictionPairs
from system.pump.lumped import (
    SAMPLES_PER_PITCH,
    PistonMotion,
    group_masses,
    lumped_pairs,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.pump.operating import OperatingPoint
from system.pump.power import GapExchange, chamber_exchange
from system.work.progress import Report, silent

POSITIONS_PER_PITCH = 4
"""Block angles a piston pitch at which films are solved: 10 deg on nine pistons; an even divisor of
SAMPLES_PER_PITCH. Five times as many move REF90's leakage by 0.1 % (benchmarks/pump.py has the cost)."""
TOLERANCE = 1e-6
"""Largest change of the chamber pressure between two rounds, of delivery minus inlet pressure."""
ROUND_LIMIT = 40
"""Rigid films of plain oil take two or three; walls that open a film to three times its thickness some twenty."""


@dataclass(frozen=True)
class FilmsPoint:
    """One coupled operating point: the pump, its films over the revolution, and the evidence of convergence.

    rotor: of the pump with its films at their positions; parts: with every assumed value, physics of their films;
    rounds of films and chamber; pressure_change: the last round's largest, Pa; sampling_error: relative change of
    the leakage when the chamber uses only every second film angle.
    """

    rotor: Rotor
    parts: FloatingParts
    physics: GapPhysics
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

    Chamber pressure repeats to `tolerance` of the ports' difference. The effects of [physics] that films solve
    are on in addition to `physics`. With heat the pairs' Coulomb loss warms their walls too.

    Raises NotConverged when chamber pressure and films do not converge within ROUND_LIMIT rounds, or viscosity
    grows without bound, ValueError when `positions_per_pitch` is no even divisor of SAMPLES_PER_PITCH or chambers
    differ, InputError where parts touch at a given position. Films have no history; they are smooth, and
    rigid and isothermal except for [physics].
    """
    kinds(pump).hold_alike()
    if positions_per_pitch % 2 or SAMPLES_PER_PITCH % positions_per_pitch:
        raise ValueError(
            f"positions per pitch: found {positions_per_pitch}, expected an even divisor of {SAMPLES_PER_PITCH}"
        )
    every, work = SAMPLES_PER_PITCH // positions_per_pitch, _work(pump, point, physics)
    at, cycle, rounds = work.rotor, work.cycle, 0
    limit = tolerance * (abs(point.delivery_pressure - point.inlet_pressure) + 1e5)
    while rounds < ROUND_LIMIT:
        rounds += 1
        try:
            gaps = gap_cycle(
                at, work.films.parts, cycle.shaft_angle[::every], cycle.pressure[::every], report,
                physics=work.films.physics, rubbing=_rubbing(work.losses(cycle)), finer=finer,
            )  # fmt: skip
        except InputError as reason:
            raise _run_away(pump, reason) from None
        ported, leaks = _ported(work, gaps, at.point)
        at = rotor(at.pump, met_point(work.point, ported))
        before, cycle = cycle, ported.cycle
        change = float(np.max(np.abs(cycle.pressure - before.pressure)))
        if change <= limit:
            break
    else:
        raise NotConverged(
            f"films and chamber pressure: after {ROUND_LIMIT} rounds the pressure still changes by {change:.3g} "
            f"Pa, expected at most {limit:.3g} Pa; try the lumped fidelity, more film angles, stiffer walls"
        )
    sampled = _sampling_error(ported.problem, leaks, work.effects, cycle)
    whole, films = _pump_point(work, point, gaps, ported), work.films
    return FilmsPoint(at, films.parts, films.physics, whole, gaps, rounds, change, sampled)


def _run_away(pump: PumpDescription, reason: InputError) -> InputError | NotConverged:
    """The reason itself, or in the pump's words that its oil stiffens without bound, beyond Barus' law.

    Where plain oil would come to 1/a, (1 - exp(-a p))/a of the stiffening oil does at no pressure.
    """
    stated = pump.physics.viscosity_pressure
    if stated is None or not reason.where.startswith("Barus"):
        return reason
    return NotConverged(
        "physics.viscosity_pressure: between rigid walls a film has no solution where plain oil would come to "
        f"{1e-6 / stated.coefficient:.3g} MPa, one over the coefficient; a part is too close to its wall: give a "
        "smaller piston.eccentricity_ratio or tilt, [physics.elastic_opening] for that gap, warmer oil or the "
        "lumped fidelity"
    )


@dataclass(frozen=True)
class _Coupling:
    """Constants of the rounds, and their start: rotor and cycle of the lumped pump without effects.

    pump: with only those effects that films do not solve; point: with the stroke after effects.
    """

    pump: PumpDescription
    point: OperatingPoint
    motion: PistonMotion
    effects: tuple[Effects[float], ...]
    films: FilmEffects
    rotor: Rotor
    cycle: ChamberCycle

    def losses(self, cycle: ChamberCycle, gaps: GapCycle | None = None) -> FrictionPairs:
        """The pairs' losses at a cycle's pressures, with the shear of these films and the contributions of
        effects.
        """
        found = lumped_pairs(self.pump, self.point, self.motion, cycle)
        if gaps is not None:
            found = with_film_shear(found, gaps, self.point.case_pressure)
        for one in self.effects:
            found = rubbed(found, one)
        return found


def _work(pump: PumpDescription, point: OperatingPoint, physics: GapPhysics) -> _Coupling:
    warm = at_temperature(pump, point.temperature)
    own, described = closed_laws(warm), unpressed(warm, point.case_pressure)
    plain, effects = point_and_effects(own, point)
    asked, at = at_the_ports(point, effects), rotor(described, at_the_ports(plain.point, effects))
    films = film_effects(at, floating_parts(described), warm, physics)
    return _Coupling(own, asked, piston_motion(own, asked), effects, films, at, plain.cycle)


def _ported(work: _Coupling, gaps: GapCycle, met: OperatingPoint) -> tuple[PortedCycle, LeakTable]:
    """Chambers and ports with the films' leaks, ports as `met` before; and these leaks without closed-form laws."""
    leaks = edged_leaks(work.pump, work.point, gaps)
    problem = affected_problem(work.pump, work.point, work.motion, leaks, work.effects)
    lines, draws = port_lines(work.pump, work.point), port_draws(gaps, met, work.pump.oil.bulk_modulus)
    samples = work.motion.shaft_angle.size
    return ported_cycle((problem,), lines, work.pump.pump.pistons, samples, draws=draws), leaks


def _pump_point(work: _Coupling, asked: OperatingPoint, gaps: GapCycle, ported: PortedCycle) -> PumpPoint:
    """The pump whose films and chambers agree."""
    pump, pistons = work.pump, work.pump.pump.pistons
    exchange = gap_exchange(gaps, ported.cycle, pistons, work.point)
    losses, derived = work.losses(ported.cycle, gaps), swept_displacement(pump, work.motion.drive)
    outside = mean_outside(pump, met_point(asked, ported), work.effects)
    return assemble(asked, ported, (losses,), pistons, derived, exchange, (group_masses(pump),), outside)


def _rubbing(losses: FrictionPairs) -> tuple[float, float, float]:
    """Mean Coulomb loss (W) of one piston, one slipper and the ring."""
    pairs = losses.piston_cylinder, losses.slipper_swash_plate, losses.valve_plate_cylinder
    piston, slipper, ring = (pair.mean_coulomb / pair.count for pair in pairs)
    return piston, slipper, ring


def leak_table(gaps: GapCycle, case_pressure: float) -> LeakTable:
    """Flow out of one chamber into each gap as G (p - p_case) + C, exact at the pressures of `gaps`."""
    return LeakTable(gaps.conductance, gaps.flow - gaps.conductance * (gaps.chamber_pressure - case_pressure))


def edged_leaks(pump: PumpDescription, point: OperatingPoint, gaps: GapCycle) -> LeakTable:
    """`leak_table` with the losses of the lands' edges from files (`land_losses`); pressures of films remain."""
    leaks = leak_table(gaps, point.case_pressure)
    if not land_losses(pump).any:
        return leaks
    creeping = creeping_film_leaks(pump, leaks, point.viscosity)
    drop = gaps.chamber_pressure - point.case_pressure
    return with_inertia(pump, creeping, drop, point.viscosity, bore=False)


def gap_exchange(gaps: GapCycle, cycle: ChamberCycle, pistons: int, point: OperatingPoint) -> GapExchange:
    """Power of the oil that moving walls drag along, and the flow from the ports into the valve plate's film."""
    by_chamber = chamber_exchange(cycle, pistons * point.shaft_speed / TURN).drag_power
    return GapExchange(replace(by_chamber, valve_plate=float(gaps.drag_power.mean())), *_mean_draws(gaps))


def _mean_draws(gaps: GapCycle) -> tuple[float, float]:
    """Flow from delivery and suction port into the valve plate's film, mean, m3/s."""
    reports = [film.report for film in gaps.valve_plate]
    return float(np.mean([one.delivery_draw for one in reports])), float(np.mean([one.suction_draw for one in reports]))


def port_draws(gaps: GapCycle, point: OperatingPoint, bulk_modulus: float) -> tuple[float, float]:
    """Flow from delivery and suction port into the valve plate's film, mean, m3/s at zero gauge pressure."""
    delivery, suction = _mean_draws(gaps)
    dense = np.exp(np.array([point.delivery_pressure, point.inlet_pressure]) / bulk_modulus)
    return delivery * float(dense[0]), suction * float(dense[1])


def film_shear(gaps: GapCycle, case_pressure: float) -> tuple[Array, Array, Array]:
    """Viscous loss (W) of one piston (N,), one slipper (N,) and the ring (N/z,).

    Power of the walls plus the power returned by the oil that they drag along, P + C (p - p_case): the film's
    dissipation less that of its pressure flow, which is leakage loss.
    """
    dragged = leak_table(gaps, case_pressure).drag_flow * (gaps.chamber_pressure - case_pressure)
    piston = np.array([film.friction_power for film in gaps.piston]) + dragged[0]
    slipper = np.array([film.friction_power for film in gaps.slipper]) + dragged[1]
    ring = np.array([film.friction_power for film in gaps.valve_plate]) + gaps.drag_power
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


def _sampling_error(
    problem: ChamberProblem, leaks: LeakTable, effects: Sequence[Effects[float]], cycle: ChamberCycle
) -> float:
    """Relative change of the leakage when the chamber knows only every second angle of the films' leaks."""
    halved = LeakTable(leaks.conductance[:, ::2].copy(), leaks.drag_flow[:, ::2].copy())
    for one in effects:
        halved = affected_leaks(halved, one)
    coarse = solve_cycle(replace(problem, leaks=halved), cycle.shaft_angle.size)
    fine, rough = (float(c.outflow.piston + c.outflow.slipper + c.outflow.valve_plate) for c in (cycle, coarse))
    return abs(rough - fine) / abs(fine)
