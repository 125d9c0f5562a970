"""The floating fidelity: gaps whose films come from the balance of forces, coupled with the chambers.

Rounds of the three gaps over the revolution and of the chamber's cycle: films leak into the chamber's balance,
the parts' small motion moves its volume, and their friction loads each other through the ball joint. Friction of
the three gaps is shear of their films and contact of their asperities, with no Coulomb's law beside it; the ball
joint rubs by its forces and spins, and the other pairs are the lumped fidelity's.
"""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from gaps.revolution import Accuracy
from gaps.seen import mass_balance_error
from system.assembly import PumpPoint, met_point, put_together
from system.chamber import ChamberCycle
from system.description import PumpDescription
from system.errors import NotConverged
from system.floating_beside import Driven, PistonBeside, piston_beside
from system.floating_drives import Drives, Rubbing, drives, no_rubbing
from system.floating_exchange import (
    FloatingGaps,
    block_torque,
    gap_exchange,
    growth,
    leak_table,
    leakage_heat,
    port_draws,
    rubbing,
    shaft_moment,
    with_floating_gaps,
)
from system.floating_gaps import FloatingOptions, block_revolution, piston_revolution, slipper_revolution
from system.floating_parts import FloatingParts, floating_parts
from system.gap_cycle import Report, silent
from system.instants import Rotor, rotor
from system.lumped import (
    chamber_problem,
    lumped_pairs,
    lumped_point,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.operating import OperatingPoint
from system.ports_coupling import PortedCycle, ported_cycle
from system.power import Gaps

PRESSURE_TOLERANCE = 1e-4
"""Largest change of the chamber pressure between two rounds, of delivery minus inlet pressure."""
FRICTION_TOLERANCE = 2e-3
"""Largest change of a film's friction between two rounds, of the largest force on a slipper."""
FIRST_CLOSED = 0.05
"""Distance from the periodic motion at which the first round lets its turns be, share of the mean film."""
CLOSING = 0.5
"""The same of later rounds, over what the round before changed."""
ROUND_LIMIT = 12


@dataclass(frozen=True)
class Round:
    """One round of gaps and chamber: what it changed (as the tolerances count it), how nearly its turns closed
    (share of the mean film), films solved, time s."""

    pressure_change: float
    friction_change: float
    closed: float
    films_solved: int
    seconds: float


@dataclass(frozen=True)
class FloatingPoint:
    """One coupled operating point: the pump, its gaps over the revolution, and the evidence of convergence.

    drives: what the gaps were last driven by; mass_balance_error of each gap over the turn.
    """

    rotor: Rotor
    parts: FloatingParts
    options: FloatingOptions
    pump_point: PumpPoint
    drives: Drives
    gaps: FloatingGaps
    rounds: tuple[Round, ...]
    mass_balance_error: Gaps


def floating_point(
    pump: PumpDescription,
    point: OperatingPoint,
    options: FloatingOptions | None = None,
    *,
    side_by_side: bool = False,
    report: Report = silent,
) -> FloatingPoint:
    """One periodic operating point with the three gaps floating; side by side: the piston in a second process.

    Raises NotConverged where gaps and chamber pressure do not settle within ROUND_LIMIT rounds, FilmNotConverged
    where a film does not, ValueError for steps that do not divide among the pistons and for chambers that differ
    in their pistons or slippers.
    """
    if pump.single_pistons or pump.single_slippers:
        raise ValueError("chambers: found single pistons or slippers, expected chambers that are alike")
    options, parts = options or FloatingOptions(), floating_parts(pump)
    lumped = lumped_point(pump, point)
    still = no_rubbing(lumped.cycle.shaft_angle.size)
    state = _State(rotor(pump, lumped.point), lumped.cycle, still, None)
    rounds: list[Round] = []
    with piston_beside(parts) if side_by_side else nullcontext() as beside:
        while not rounds or not _settled(rounds[-1], options):
            if len(rounds) == ROUND_LIMIT:
                raise _not_settled(rounds[-1])
            closing = replace(options, accuracy=_loosened(options.accuracy, rounds))
            state, taken = _round(state, parts, point, closing, beside, _of_round(report, len(rounds) + 1))
            rounds.append(taken)
    return _told(pump, point, parts, options, state, tuple(rounds))


@dataclass(frozen=True)
class _State:
    """Where a round begins or ends; ported: chambers and ports of its end."""

    rotor: Rotor
    cycle: ChamberCycle
    rubbing: Rubbing
    gaps: FloatingGaps | None
    ported: PortedCycle | None = None


def _round(
    state: _State,
    parts: FloatingParts,
    point: OperatingPoint,
    options: FloatingOptions,
    beside: PistonBeside | None,
    report: Report,
) -> tuple[_State, Round]:
    """The gaps at the pressure and friction of the round before, then the chambers with these gaps."""
    began, pump, cycle = perf_counter(), state.rotor.pump, state.cycle
    asked = Driven(state.rotor, cycle.shaft_angle, cycle.pressure, state.rubbing, options)
    driven = drives(state.rotor, parts, cycle.shaft_angle, cycle.pressure, state.rubbing)
    gaps = _revolutions(asked, parts, driven, state.gaps, beside, report)
    motion, pistons = piston_motion(pump, point), pump.pump.pistons
    problem = chamber_problem(pump, point, motion, leak_table(gaps))
    problem = replace(problem, growth=growth(gaps, state.rotor, parts))
    pressures = (state.rotor.point.delivery_pressure, state.rotor.point.inlet_pressure)
    samples = cycle.shaft_angle.size
    draws = port_draws(gaps, pressures, pump.oil.bulk_modulus, samples // pistons)
    ported = ported_cycle((problem,), port_lines(pump, point), pistons, samples, draws=draws)
    rubbed = rubbing(gaps, samples)
    friction = max(
        np.abs(rubbed.piston - state.rubbing.piston).max(), np.abs(rubbed.slipper - state.rubbing.slipper).max()
    )
    taken = Round(
        float(np.max(np.abs(ported.cycle.pressure - cycle.pressure))) / problem.pressure_span,
        float(friction) / max(at.forces.lift for at in driven.group),
        options.accuracy.closed,
        sum(gap.films_solved for gap in (gaps.piston, gaps.slipper, gaps.block)),
        perf_counter() - began,
    )
    return _State(rotor(pump, met_point(point, ported)), ported.cycle, rubbed, gaps, ported), taken


def _revolutions(
    asked: Driven,
    parts: FloatingParts,
    driven: Drives,
    before: FloatingGaps | None,
    beside: PistonBeside | None,
    report: Report,
) -> FloatingGaps:
    """Each gap over the revolution, on from the round before; the piston by the process beside, if any."""
    at, options = asked.rotor, asked.options
    piston, slipper, block = (None,) * 3 if before is None else (before.piston, before.slipper, before.block)
    if beside is not None:
        beside.start(asked)
    else:
        piston = piston_revolution(at, parts, driven.piston, options, piston, report)
    slipper = slipper_revolution(at, parts, driven.slipper, options, slipper, report)
    block = block_revolution(at, parts, driven.block, options, block, report)
    if beside is not None:
        piston = beside.fetch(report)
    assert piston is not None
    return FloatingGaps(piston, slipper, block)


def _of_round(report: Report, number: int) -> Report:
    return lambda done, total, what: report(done, total, f"round {number}, {what}")


def _loosened(accuracy: Accuracy, rounds: list[Round]) -> Accuracy:
    """How exactly a round closes its turns: no better than the chambers and forces that drive them are known."""
    unknown = max(rounds[-1].pressure_change, rounds[-1].friction_change) if rounds else FIRST_CLOSED
    return replace(accuracy, closed=max(accuracy.closed, min(FIRST_CLOSED, CLOSING * unknown)))


def _settled(taken: Round, options: FloatingOptions) -> bool:
    agree = taken.pressure_change <= PRESSURE_TOLERANCE and taken.friction_change <= FRICTION_TOLERANCE
    return agree and taken.closed <= options.accuracy.closed


def _not_settled(taken: Round) -> NotConverged:
    return NotConverged(
        f"floating gaps and chamber pressure: after {ROUND_LIMIT} rounds the pressure still changes by "
        f"{taken.pressure_change:.2g} of the ports' difference (expected at most {PRESSURE_TOLERANCE:g}), "
        f"friction by {taken.friction_change:.2g} of the largest force (at most {FRICTION_TOLERANCE:g}); "
        "try more steps, a lower pressure, or the films fidelity"
    )


def _told(
    pump: PumpDescription,
    point: OperatingPoint,
    parts: FloatingParts,
    options: FloatingOptions,
    state: _State,
    rounds: tuple[Round, ...],
) -> FloatingPoint:
    """The pump with gaps and chambers that agree."""
    gaps, ported, at, pistons = state.gaps, state.ported, state.rotor, pump.pump.pistons
    assert gaps is not None
    assert ported is not None
    motion, cycle = piston_motion(pump, point), state.cycle
    driven = drives(at, parts, cycle.shaft_angle, cycle.pressure, state.rubbing)
    losses = with_floating_gaps(lumped_pairs(pump, point, motion, cycle), gaps, driven.group)
    about_shaft = losses.ball_guide_retainer, losses.front_bearing, losses.rear_bearing
    lumped = sum(loss.coulomb + loss.viscous for loss in about_shaft) / point.shaft_speed
    torque = shaft_moment(gaps, at, parts, driven.group) + block_torque(gaps, cycle.shaft_angle.size) + lumped
    pump_point = put_together(
        point,
        ported,
        losses,
        pistons,
        swept_displacement(pump, motion.drive),
        gap_exchange(gaps, pistons, point.shaft_speed),
        torque,
        leakage_heat(gaps, pistons),
    )
    missing = Gaps(
        mass_balance_error(gaps.piston), mass_balance_error(gaps.slipper), mass_balance_error(gaps.block)
    )
    return FloatingPoint(at, parts, options, pump_point, driven, gaps, rounds, missing)
