"""The fidelity fixed: leakage and viscous friction of the three gaps from films at given positions.

The parts have the positions of the pump's description. Chamber pressure and films are solved in turn until the pressure
of the whole revolution repeats. Coulomb losses are those of the lumped fidelity, since a smooth film has no contact.
Films solve some effects of [physics] themselves (`film_effects`); the others act as at the lumped fidelity.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from reynolds.errors import BeyondBarus, InputError, NotConverged, WallsOverlap
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.applied import affected_leaks
from system.effects.effect import Effects
from system.effects.friction import rubbed
from system.films.cycle import PLAIN, GapCycle, GapKind, GapPhysics, gap_cycles
from system.films.parts import FloatingParts, floating_parts
from system.films.rotor import Rotor, rotor
from system.inputs.units import TURN
from system.points.effects import affected_problem, at_the_ports, mean_outside
from system.points.film_effects import closed_laws, film_effects
from system.points.lumped import point_and_effects
from system.pump.assembly import PumpPoint, assemble, met_point
from system.pump.chamber.cycle import ChamberCycle, solve_cycle
from system.pump.chamber.port_coupling import PortedCycle, ported_cycle
from system.pump.chamber.problem import LeakTable, pressure_span
from system.pump.chamber_kinds import Kinds, kinds
from system.pump.film_thickness import at_temperature, unpressed
from system.pump.friction_range import with_friction_range
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
from system.work.means import mean_of
from system.work.progress import Report, silent

POSITIONS_PER_PITCH = 4
"""Block angles a piston pitch at which films are solved: 10 deg on nine pistons; an even divisor of
SAMPLES_PER_PITCH. Five times as many move REF90's leakage by 0.1 % (benchmarks/pump.py has the cost)."""
TOLERANCE = 1e-6
"""Largest change of the chamber pressure between two rounds, of delivery minus inlet pressure."""
ROUND_LIMIT = 40
"""Rigid films of plain oil need two or three rounds, walls that open a film to three times its thickness some 20."""


GIVEN_BY = {
    "piston": ("piston.radial_clearance", "piston.eccentricity_ratio"),
    "slipper": ("slipper.film_thickness", "slipper.tilt_radial, tilt_tangential or shape of its face"),
    "block": ("valve_plate.film_thickness", "valve_plate.tilt_x, tilt_y or waviness"),
}
"""Keys that hold the walls of a gap apart at its given position, and those that reduce their distance."""


@dataclass(frozen=True)
class FilmsKind:
    """Equal chambers: the rotor with their pump, its films at their positions; parts: with every assumed value; the
    films over the turn. chambers, from 0; of a pump whose chambers are all equal the first alone."""

    chambers: tuple[int, ...]
    rotor: Rotor
    parts: FloatingParts
    gaps: GapCycle


@dataclass(frozen=True)
class FilmsPoint:
    """One coupled operating point: the pump, its films over the revolution, and the evidence of convergence.

    kinds: of chambers, the most common first; their ring is one. physics of their films; rounds of films and chamber;
    pressure_change: the last round's largest, Pa; sampling_error: relative change of the leakage when the chamber uses
    only every second film angle.
    """

    kinds: tuple[FilmsKind, ...]
    physics: GapPhysics
    pump_point: PumpPoint
    rounds: int
    pressure_change: float
    sampling_error: float

    @property
    def rotor(self) -> Rotor:
        """The rotor with the pump of the most common kind."""
        return self.kinds[0].rotor

    @property
    def parts(self) -> FloatingParts:
        """The parts of the most common kind."""
        return self.kinds[0].parts

    @property
    def gaps(self) -> GapCycle:
        """The films of the most common kind."""
        return self.kinds[0].gaps


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
    are on in addition to `physics`. With heat the pairs' Coulomb loss warms their walls too. Chambers that differ have
    the films of their kind, at the mean pressure of its chambers, and a ring over the turn.

    Raises NotConverged when chamber pressure and films do not converge within ROUND_LIMIT rounds, or viscosity
    grows without bound, ValueError when `positions_per_pitch` is no even divisor of SAMPLES_PER_PITCH, InputError where
    parts touch at a given position. Films have no history; they are smooth, and rigid and isothermal except for
    [physics].
    """
    if positions_per_pitch % 2 or SAMPLES_PER_PITCH % positions_per_pitch:
        raise ValueError(
            f"positions per pitch: found {positions_per_pitch}, expected an even divisor of {SAMPLES_PER_PITCH}"
        )
    every, work = SAMPLES_PER_PITCH // positions_per_pitch, _work(pump, point, physics)
    group, cycles, rounds = work.group, work.cycles, 0
    limit = tolerance * pressure_span(point.delivery_pressure, point.inlet_pressure)
    while rounds < ROUND_LIMIT:
        rounds += 1
        try:
            gaps = gap_cycles(
                group, cycles[0].shaft_angle[::every], [one[::every] for one in work.pressures(cycles)], report,
                physics=work.physics, rubbing=work.rubbing(cycles), finer=finer,
            )  # fmt: skip
        except InputError as reason:
            raise _of_pump(pump, reason) from None
        ported, leaks = _ported(work, gaps, group[0].rotor.point)
        met = met_point(work.point, ported)
        group = tuple(replace(one, rotor=rotor(one.rotor.pump, met)) for one in group)
        before, cycles = cycles, ported.cycles
        change = max(float(np.abs(one.pressure - old.pressure).max()) for one, old in zip(cycles, before, strict=True))
        if change <= limit:
            break
    else:
        raise NotConverged(
            f"films and chamber pressure: after {ROUND_LIMIT} rounds the pressure still changes by {change:.3g} "
            f"Pa, expected at most {limit:.3g} Pa; try the lumped fidelity, more film angles, stiffer walls"
        )
    sampled = _sampling_error(work, ported, leaks)
    whole = with_friction_range(pump, _pump_point(work, point, gaps, ported))
    kinds_found = [FilmsKind(one.chambers, one.rotor, one.parts, films) for one, films in zip(group, gaps, strict=True)]
    return FilmsPoint(tuple(kinds_found), work.physics, whole, rounds, change, sampled)


def _of_pump(pump: PumpDescription, reason: InputError) -> InputError | NotConverged:
    """The reason in the pump's words: parts that touch, oil that stiffens without bound; else the reason itself.

    Beyond Barus' law: where plain oil would reach the pressure 1/a, (1 - exp(-a p))/a of the stiffening oil reaches it
    at no pressure.
    """
    if isinstance(reason, WallsOverlap):
        path, with_it = GIVEN_BY[reason.part]
        return InputError(path, f"{reason.found} at the given position", f"walls apart: more of it, or less {with_it}")
    stated = pump.physics.viscosity_pressure
    if stated is None or not isinstance(reason, BeyondBarus):
        return reason
    return NotConverged(
        "physics.viscosity_pressure: between rigid walls a film has no solution where plain oil would come to "
        f"{1e-6 / stated.coefficient:.3g} MPa, one over the coefficient; a part is too close to its wall: give a "
        "smaller piston.eccentricity_ratio or tilt, [physics.elastic_opening] for that gap, warmer oil or the "
        "lumped fidelity"
    )


@dataclass(frozen=True)
class _Coupling:
    """Constants of the rounds, and their start: films and cycles of the lumped pump without effects.

    pump: with only those effects that films do not solve; kinds: of its chambers; point: with the stroke after effects;
    motions, effects (none without an active law) and films by kind, cycles by chamber.
    """

    pump: PumpDescription
    kinds: Kinds
    point: OperatingPoint
    motions: tuple[PistonMotion, ...]
    effects: tuple[Effects[float], ...]
    group: tuple[GapKind, ...]
    physics: GapPhysics
    cycles: tuple[ChamberCycle, ...]

    @property
    def acting(self) -> tuple[tuple[Effects[float], ...], ...]:
        """The effects of each kind, one or none."""
        return tuple(self.effects[kind : kind + 1] for kind in range(len(self.kinds.pumps)))

    @property
    def by_chamber(self) -> tuple[Effects[float], ...]:
        """The effects of each chamber, of one where all are equal; none without an active law."""
        return self.kinds.by_chamber(self.effects) if self.effects else ()

    def pressures(self, cycles: Sequence[ChamberCycle]) -> list[Array]:
        """Pressure (N,) Pa of each kind, the mean of its chambers."""
        return [np.mean([cycles[k].pressure for k in one.chambers], axis=0) for one in self.group]

    def losses(self, cycles: Sequence[ChamberCycle], gaps: Sequence[GapCycle] | None = None) -> list[FrictionPairs]:
        """The pairs' losses of each chamber at its cycle's pressures, with the shear of these films and the
        contributions of effects.
        """
        found = []
        for kind, cycle in zip(self.kinds.of_chamber, cycles, strict=True):
            loss = lumped_pairs(self.kinds.pumps[kind], self.point, self.motions[kind], cycle)
            if gaps is not None:
                loss = with_film_shear(loss, gaps[kind], self.point.case_pressure)
            for one in self.acting[kind]:
                loss = rubbed(loss, one)
            found.append(loss)
        return found

    def rubbing(self, cycles: Sequence[ChamberCycle]) -> list[tuple[float, float, float]]:
        """Mean Coulomb loss (W) of one piston and one slipper of each kind, and of the ring."""
        losses = self.losses(cycles)
        each = [mean_of([losses[k] for k in one.chambers]) for one in self.group]
        ring = mean_of(losses).valve_plate_cylinder.mean_coulomb
        one_of = [(one.piston_cylinder, one.slipper_swash_plate) for one in each]
        return [
            (piston.mean_coulomb / piston.count, slipper.mean_coulomb / slipper.count, ring)
            for piston, slipper in one_of
        ]


def _work(pump: PumpDescription, point: OperatingPoint, physics: GapPhysics) -> _Coupling:
    warm = at_temperature(pump, point.temperature)
    own, found = closed_laws(warm), kinds(warm)
    plain, effects = point_and_effects(own, point)
    by_chamber = found.by_chamber(effects) if effects else ()
    asked, left = at_the_ports(point, by_chamber), at_the_ports(plain.point, by_chamber)
    group = []
    for kind, one in enumerate(found.pumps):
        described = unpressed(one, point.case_pressure)
        at = rotor(described, left)
        films = film_effects(at, floating_parts(described), one, physics)
        group.append(GapKind(at, films.parts, found.chambers(kind)))
    closed = replace(found, pumps=tuple(closed_laws(one) for one in found.pumps))
    motions = tuple(piston_motion(one, asked) for one in closed.pumps)
    return _Coupling(own, closed, asked, motions, effects, tuple(group), films.physics, plain.chambers)


def _ported(work: _Coupling, gaps: Sequence[GapCycle], met: OperatingPoint) -> tuple[PortedCycle, list[LeakTable]]:
    """Chambers and ports with the films' leaks, ports from `met`; and these leaks by kind, without closed-form laws."""
    leaks = [edged_leaks(one, work.point, films) for one, films in zip(work.kinds.pumps, gaps, strict=True)]
    problems = [
        affected_problem(one, work.point, motion, leak, acting)
        for one, motion, leak, acting in zip(work.kinds.pumps, work.motions, leaks, work.acting, strict=True)
    ]
    lines, draws = port_lines(work.pump, work.point), port_draws(gaps[0], met, work.pump.oil.bulk_modulus)
    samples = work.motions[0].shaft_angle.size
    found = ported_cycle(work.kinds.by_chamber(problems), lines, work.pump.pump.pistons, samples, draws=draws)
    return found, leaks


def _pump_point(work: _Coupling, asked: OperatingPoint, gaps: Sequence[GapCycle], ported: PortedCycle) -> PumpPoint:
    """The pump whose films and chambers agree."""
    pump, pistons = work.pump, work.pump.pump.pistons
    exchange = gap_exchange(gaps[0], ported.cycle, pistons, work.point)
    each = [swept_displacement(one, motion.drive) for one, motion in zip(work.kinds.pumps, work.motions, strict=True)]
    derived, masses = float(np.mean(work.kinds.by_chamber(each))), [group_masses(one) for one in work.kinds.pumps]
    outside = mean_outside(pump, met_point(asked, ported), work.by_chamber)
    losses, of_chamber = work.losses(ported.cycles, gaps), work.kinds.by_chamber(masses)
    return assemble(asked, ported, losses, pistons, derived, exchange, of_chamber, outside)


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
    """The pairs with the viscous part of the three gaps' pairs from the films, linear between film angles.

    Linear interpolation between equidistant angles preserves the mean of the film solves exactly.
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


def _sampling_error(work: _Coupling, ported: PortedCycle, leaks: Sequence[LeakTable]) -> float:
    """Relative change of the leakage when the chambers use only every second angle of the films' leaks."""
    fine, rough = 0.0, 0.0
    for one, leak, acting in zip(work.group, leaks, work.acting, strict=True):
        halved = LeakTable(leak.conductance[:, ::2].copy(), leak.drag_flow[:, ::2].copy())
        for effects in acting:
            halved = affected_leaks(halved, effects)
        first = one.chambers[0]
        cycle, problem = ported.cycles[first], replace(ported.problems[first], leaks=halved)
        coarse = solve_cycle(problem, cycle.shaft_angle.size)
        fine += len(one.chambers) * float(cycle.outflow.gaps)
        rough += len(one.chambers) * float(coarse.outflow.gaps)
    return abs(rough - fine) / abs(fine)
