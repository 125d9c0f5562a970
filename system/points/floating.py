"""The floating fidelity: gaps whose films come from the balance of forces, coupled with the chambers.

Rounds alternate between the three gaps over the revolution and the chamber's cycle. The films' leakage enters the
chamber's balance, the parts' small motion changes its volume, and their friction acts on each other through the ball
joint. Friction of the three gaps is shear of their films and contact of their asperities, without Coulomb's law. The
ball joint's friction follows from its forces and spins; the other pairs are the lumped fidelity's. Films solve their
effects of [physics] (`film_effects`); its other effects act by their laws, at the pump's chambers without effects.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from gaps.revolution.march import Leg, mass_balance_error
from reynolds.errors import NotConverged
from system.description.pump import PumpDescription
from system.effects.friction import rubbed
from system.films.cycle import GapPhysics
from system.films.drives import Drives, Rubbing, no_rubbing
from system.films.parts import FloatingParts
from system.films.rotor import Rotor, rotor
from system.points.effects import at_the_ports, mean_outside
from system.points.film_effects import closed_laws
from system.points.floating_exchange import (
    FloatingGaps,
    block_torque,
    gap_exchange,
    leakage_heat,
    port_draws,
    rubbing,
    shaft_moment,
    spin_torques,
    with_floating_gaps,
)
from system.points.floating_gaps import FloatingOptions, usual_options
from system.points.floating_kinds import Group, RoundDrives, by_chamber, chamber_problems, drives_of, group_of
from system.points.floating_progress import WholeRun, shares_of_gaps
from system.points.floating_solved import Round, Solved
from system.points.gap_process import GapsBeside, gap_revolutions, gaps_apart, gaps_beside
from system.points.lumped import point_and_effects
from system.pump.assembly import PumpPoint, met_point, put_together
from system.pump.chamber.port_coupling import PortedCycle, ported_cycle
from system.pump.chamber.problem import pressure_span
from system.pump.chamber.turn import Gaps
from system.pump.film_thickness import at_temperature, unpressed
from system.pump.laws.friction_pairs import over_chambers
from system.pump.lumped import lumped_pairs, piston_motion, port_lines, swept_displacement
from system.pump.operating import OperatingPoint
from system.work.means import mean_of
from system.work.progress import Report, silent

PRESSURE_TOLERANCE = 1e-4
"""Largest change of the chamber pressure between two rounds, of delivery minus inlet pressure."""
FRICTION_TOLERANCE = 2e-3
"""Largest change of a film's friction between two rounds, of the largest force on a slipper."""
SPIN_TOLERANCE = 2e-3
"""Largest change of a spin between two rounds, of the shaft's."""
FIRST_STEP = 0.05
"""Error that the first rounds' steps may make, share of the film."""
FAR = 20.0
"""Change of a spin by a round with steps of FIRST_STEP, over its tolerance, from which the next round has them too."""
NEARLY = 6.0
"""Multiple of their tolerances within which the changes of a round count as near agreement of gaps and chambers."""
ROUND_LIMIT = 40


@dataclass(frozen=True)
class FloatingKind:
    """Equal chambers: their parts, the last drives of their gaps, the gaps and the physics of their films.

    chambers, from 0; of a pump whose chambers are all equal the first alone.
    """

    chambers: tuple[int, ...]
    rotor: Rotor
    parts: FloatingParts
    drives: Drives
    gaps: FloatingGaps
    physics: GapPhysics


@dataclass(frozen=True)
class FloatingPoint:
    """One coupled operating point: the pump, its gaps over the revolution, and the evidence of convergence.

    pump: as given; rotor: with the clearances of the point's temperature ([physics.thermal_clearance]). kinds: of
    chambers, the most common first; their block is one. mass_balance_error of each gap over the turn, the worst of its
    kinds.
    """

    pump: PumpDescription
    rotor: Rotor
    options: FloatingOptions
    pump_point: PumpPoint
    kinds: tuple[FloatingKind, ...]
    rounds: tuple[Round, ...]
    mass_balance_error: Gaps


def floating_point(
    pump: PumpDescription,
    point: OperatingPoint,
    options: FloatingOptions | None = None,
    *,
    near: FloatingPoint | None = None,
    side_by_side: bool = False,
    report: Report = silent,
    solved: Solved | None = None,
) -> FloatingPoint:
    """One periodic operating point with the three gaps floating; side by side: in processes of their own.

    near: a point of the same pump, whose motion, temperatures, spins and chambers this one starts from. solved: is
    filled with rounds and gaps as they are solved, and keeps them where a later one fails. Raises NotConverged where
    gaps and chamber pressure do not settle within ROUND_LIMIT rounds, FilmNotConverged where a film does not,
    ValueError for steps that do not divide among the pistons, InputError for a film that thermal expansion closes.
    """
    options = options or usual_options(pump.pump.pistons)
    group, asked = _beginning(pump, point, options)
    left = at_the_ports(point, group.by_chamber)
    gaps: tuple[FloatingGaps, ...] | None = None
    solved = solved or Solved()
    rounds = solved.rounds
    if near is not None:
        gaps = tuple(_begun(kind.gaps) for kind in near.kinds)
        asked = _driven_as(asked, near)
    apart = gaps_apart(options.physics) if side_by_side else ()
    whole = WholeRun(report, ROUND_LIMIT, shares_of_gaps({gap for one in apart for gap in one}))
    with gaps_beside(group, apart, gaps) as beside:
        while not rounds or not (rounds[-1].settled and _agree(rounds[-1])):
            if len(rounds) == ROUND_LIMIT:
                raise _not_settled(rounds[-1])
            closing = replace(asked, options=_approaching(options, rounds, cold=near is None))
            found = _round(closing, group, left, gaps, beside, whole.begun(), solved)
            asked, gaps = found.asked, found.gaps
            rounds.append(found.taken)
            whole.ended(max(change / tolerance for change, tolerance in _changes(found.taken)))
    found = replace(found, asked=replace(asked, options=options))
    return _floating_point(pump, point, group, found, tuple(rounds))


def _beginning(pump: PumpDescription, point: OperatingPoint, options: FloatingOptions) -> tuple[Group, RoundDrives]:
    """The kinds of chambers with the effects of [physics], and the first drives: the lumped pump without effects."""
    warm = at_temperature(pump, point.temperature)
    own, described = closed_laws(warm, floating=True), unpressed(warm, point.case_pressure)
    plain, effects = point_and_effects(own, point)
    group, angle = group_of(rotor(described, plain.point), options.physics, effects), plain.cycle.shaft_angle
    still = (no_rubbing(angle.size),) * len(group.parts)
    pressures = tuple(one.pressure for one in plain.chambers)
    at = rotor(described, at_the_ports(plain.point, group.by_chamber))
    return group, RoundDrives(at, angle, pressures, still, (None,) * len(group.parts), options)


def _begun(gaps: FloatingGaps) -> FloatingGaps:
    """Gaps of another point as a start: their films' meshes and oil are that point's."""
    return replace(gaps, piston=gaps.piston.bare, slipper=gaps.slipper.bare, block=gaps.block.bare)


def _driven_as(asked: RoundDrives, near: FloatingPoint) -> RoundDrives:
    """The drives with friction, spins and chamber pressures of another point.

    The difference of floating from lumped chamber pressures goes with the pressure difference of the ports.
    """
    _, lumped = _beginning(near.pump, near.pump_point.point, near.options)
    here, there = (
        pressure_span(at.delivery_pressure, at.inlet_pressure) for at in (asked.rotor.point, near.pump_point.point)
    )
    share = here / there
    changed = [share * (one.pressure - own) for one, own in zip(near.pump_point.chambers, lumped.pressure, strict=True)]
    changes = [np.interp(asked.shaft_angle, lumped.shaft_angle, one, period=2.0 * np.pi) for one in changed]
    return replace(
        asked,
        pressure=tuple(own + change for own, change in zip(asked.pressure, changes, strict=True)),
        rubbing=tuple(rubbing(kind.gaps, asked.shaft_angle.size) for kind in near.kinds),
        spin_torques=tuple(
            replace(spin_torques(kind.gaps, kind.rotor, kind.drives.group), tried=()) for kind in near.kinds
        ),
    )


@dataclass(frozen=True)
class _Found:
    """End of a round: the next drives, gaps by kind, chambers and ports, and the record of the round."""

    asked: RoundDrives
    gaps: tuple[FloatingGaps, ...]
    ported: PortedCycle
    taken: Round


def _round(
    asked: RoundDrives,
    group: Group,
    point: OperatingPoint,
    before: tuple[FloatingGaps, ...] | None,
    beside: Sequence[GapsBeside],
    report: Report,
    solved: Solved,
) -> _Found:
    """The gaps at the pressure and friction of the round before, then the chambers with these gaps."""
    began, pump, pistons = perf_counter(), asked.rotor.pump, asked.rotor.pump.pump.pistons
    for process in beside:
        process.start(asked)
    driven = drives_of(asked, group)
    gaps = gap_revolutions(asked, group, driven, before, beside, report, solved)
    problems = chamber_problems(asked, group, point, piston_motion(pump, point), gaps)
    pressures = asked.rotor.point.delivery_pressure, asked.rotor.point.inlet_pressure
    samples = asked.shaft_angle.size
    drawn = samples // pistons if group.kinds.alike else samples
    draws = port_draws(gaps[0].block, pressures, pump.oil.bulk_modulus, drawn)
    ported = ported_cycle(problems, port_lines(pump, point), pistons, samples, draws=draws)
    turning = group.rotors(asked)
    following = replace(
        asked,
        rotor=rotor(pump, met_point(point, ported)),
        pressure=tuple(cycle.pressure for cycle in ported.cycles),
        rubbing=tuple(rubbing(own, samples) for own in gaps),
        spin_torques=tuple(
            spin_torques(own, at, of.group, torques.tried if torques else ())
            for own, at, of, torques in zip(gaps, turning, driven, asked.spin_torques, strict=True)
        ),
    )
    turned = [*(gap for own in gaps for gap in (own.piston, own.slipper)), gaps[0].block]
    taken = Round(
        float(np.max(np.abs(np.array(following.pressure) - asked.pressure))) / problems[0].pressure_span,
        max(map(_rubbing_change, asked.rubbing, following.rubbing))
        / max(float(one.group.forces.lift.max()) for one in driven),
        _spins_change(turning, group, following),
        asked.options.accuracy.settled,
        sum(gap.films_solved for gap in turned),
        perf_counter() - began,
        {leg: sum(gap.spent.get(leg, 0.0) for gap in turned) for leg in Leg},
    )
    return _Found(following, gaps, ported, taken)


def _rubbing_change(one: Rubbing, other: Rubbing) -> float:
    """Largest change of a film's friction, N."""
    return float(max(np.abs(one.piston - other.piston).max(), np.abs(one.slipper - other.slipper).max()))


def _spins_change(turning: Sequence[Rotor], group: Group, following: RoundDrives) -> float:
    """Largest change of a spin to the next round, of the shaft's, by the torques' lines and by those through rest.

    Lines of two spins may be so steep that any spin is a solution.
    """
    through_rest = tuple(own and (own.careful or own) for own in following.spin_torques)
    ways = group.rotors(following), group.rotors(replace(following, spin_torques=through_rest))
    return max(_spin_change(one, after) for way in ways for one, after in zip(turning, way, strict=True))


def _spin_change(one: Rotor, other: Rotor) -> float:
    """Largest change of a spin, of the shaft's."""
    before, after = one.spins, other.spins
    change = max(abs(after.piston - before.piston), abs(after.slipper - before.slipper))
    return change / one.point.shaft_speed


def _approaching(options: FloatingOptions, rounds: list[Round], *, cold: bool) -> FloatingOptions:
    """Accuracy of a round's gaps: one turn of each until they nearly agree with the chambers.

    The first rounds of `cold` gaps, which have no start, have wide steps, until the spins are nearly those of the
    films.
    """
    exact = options.accuracy
    if cold and all(taken.spin_change > FAR * SPIN_TOLERANCE for taken in rounds):
        exact = replace(exact, step=max(exact.step, FIRST_STEP))
    settled = bool(rounds) and (rounds[-1].settled or _agree(rounds[-1], NEARLY))
    return replace(options, accuracy=replace(exact, settled=settled))


def _agree(taken: Round, times: float = 1.0) -> bool:
    """True if a round's changes are within the tolerances, or within this multiple of them."""
    return all(change <= times * tolerance for change, tolerance in _changes(taken))


def _changes(taken: Round) -> tuple[tuple[float, float], ...]:
    """The changes of a round, each with its tolerance."""
    return (
        (taken.pressure_change, PRESSURE_TOLERANCE),
        (taken.friction_change, FRICTION_TOLERANCE),
        (taken.spin_change, SPIN_TOLERANCE),
    )


def _not_settled(taken: Round) -> NotConverged:
    return NotConverged(
        f"floating gaps and chamber pressure: after {ROUND_LIMIT} rounds the pressure still changes by "
        f"{taken.pressure_change:.2g} of the ports' difference (expected at most {PRESSURE_TOLERANCE:g}), "
        f"friction by {taken.friction_change:.2g} of the largest force (at most {FRICTION_TOLERANCE:g}), a spin "
        f"by {taken.spin_change:.2g} of the shaft's (at most {SPIN_TOLERANCE:g}); "
        "try more steps, a lower pressure, or the fidelity fixed"
    )


def _floating_point(
    pump: PumpDescription, point: OperatingPoint, group: Group, found: _Found, rounds: tuple[Round, ...]
) -> FloatingPoint:
    """The pump with gaps and chambers that agree."""
    asked, ported, block = found.asked, found.ported, found.gaps[0].block
    pistons, speed, samples = asked.rotor.pump.pump.pistons, point.shaft_speed, asked.shaft_angle.size
    effects, left = group.by_chamber, at_the_ports(point, group.by_chamber)
    rotors = group.rotors(asked)
    of_kinds = [
        FloatingKind(group.kinds.chambers(kind), *each, group.physics)
        for kind, each in enumerate(zip(rotors, group.parts, drives_of(asked, group), found.gaps, strict=True))
    ]
    chambers = list(zip(group.kinds.by_chamber(of_kinds), by_chamber(group, found.gaps), ported.cycles, strict=True))
    each, derived = [], []
    for own, gaps, cycle in chambers:
        motion = piston_motion(own.rotor.pump, left)
        each.append(with_floating_gaps(lumped_pairs(own.rotor.pump, left, motion, cycle), gaps, own.drives.group))
        derived.append(swept_displacement(own.rotor.pump, motion.drive))
    losses = mean_of([rubbed(*one) for one in zip(each, effects, strict=True)] if effects else each)
    about_shaft = losses.ball_guide_retainer, losses.front_bearing, losses.rear_bearing
    moments = [shaft_moment(gaps, own.rotor, own.parts, own.drives.group) for own, gaps, _ in chambers]
    lumped = sum(loss.coulomb + loss.viscous for loss in about_shaft) / speed
    pump_point = put_together(
        point,
        ported,
        losses,
        pistons,
        float(np.mean(derived)),
        mean_of([gap_exchange(gaps, pistons, speed) for _, gaps, _ in chambers]),
        over_chambers(moments, pistons) + block_torque(block, samples) + lumped,
        mean_of([leakage_heat(gaps, pistons) for _, gaps, _ in chambers]),
        mean_outside(closed_laws(asked.rotor.pump, floating=True), met_point(point, ported), effects),
    )
    missing = Gaps(
        max(mass_balance_error(own.piston) for own in found.gaps),
        max(mass_balance_error(own.slipper) for own in found.gaps),
        mass_balance_error(block),
    )
    return FloatingPoint(pump, asked.rotor, asked.options, pump_point, tuple(of_kinds), rounds, missing)
