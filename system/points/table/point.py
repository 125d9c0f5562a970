"""The table fidelity: the lumped kernel with film physics inside, by the ratios of a response table."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.friction import rubbed
from system.inputs.units import TURN
from system.points.effects import affected_problem, at_the_ports, mean_outside
from system.points.film_effects import closed_laws
from system.points.lumped import point_and_effects
from system.points.table.means import FILM_RISE, GAP_PAIRS, given_films, law_moments, plate_flow
from system.points.table.response_table import ResponseTable
from system.points.table.sources import Source
from system.pump.assembly import PumpPoint, assemble, met_point
from system.pump.chamber.cycle import solve_cycle
from system.pump.chamber.port_coupling import ported_cycle
from system.pump.chamber.problem import LeakTable
from system.pump.chamber.turn import Gaps
from system.pump.chamber_kinds import kinds
from system.pump.laws.friction_pairs import FrictionPairs, Pair, PairLoss
from system.pump.lumped import (
    PistonMotion,
    chamber_problem,
    group_masses,
    lumped_leaks,
    lumped_pairs,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.pump.operating import OperatingPoint
from system.pump.power import GapExchange, chamber_exchange, port_draw

ROUND_LIMIT = 12
SETTLED = 1e-6
"""Part of the ports' pressure difference by which the delivery pressure may miss the one that the table was asked
at: only an orifice of stated area moves it."""


@dataclass(frozen=True)
class TablePoint:
    """A point by a table: the pump, and each gap's films (m), hottest oil above the case (K), share of contact."""

    pump_point: PumpPoint
    table: ResponseTable
    film_mean: Gaps
    film_least: Gaps
    film_rise: Gaps
    contact_share: Gaps


def table_point(pump: PumpDescription, point: OperatingPoint, table: ResponseTable) -> TablePoint:
    """One periodic operating point by the lumped kernel, with leakage and friction of its gaps from the table.

    Raises InputError outside the table's box or at another inlet or case pressure, NotConverged as
    `ported_cycle` and where an orifice line does not converge, ValueError where chambers differ. Effects of [physics]
    that the table's films have not solved act by their laws.
    """
    kinds(pump).hold_alike()
    own = closed_laws(pump, floating=table.origin.source is Source.FLOATING)
    _, effects = point_and_effects(own, point)
    left = at_the_ports(point, effects)
    motion, lines, pistons = piston_motion(pump, left), port_lines(pump, left), pump.pump.pistons
    asked = left
    for _ in range(ROUND_LIMIT):
        means = table.at(asked)
        problem = affected_problem(pump, left, motion, _leaks(pump, asked, motion, means), effects)
        draws = _draws(pump, asked, means)
        none = GapExchange(Gaps(0.0, 0.0, 0.0), *draws)
        ported = ported_cycle((problem,), lines, pistons, motion.shaft_angle.size, draws=port_draw(problem, none))
        met = met_point(left, ported).delivery_pressure
        if abs(met - asked.delivery_pressure) <= SETTLED * problem.pressure_span:
            break
        asked = replace(left, delivery_pressure=met)
    else:
        raise NotConverged(
            f"table and delivery line: after {ROUND_LIMIT} rounds the delivery pressure still moves, expected at "
            f"most {SETTLED:g} of the pressure difference; leave delivery_line.orifice_area out"
        )
    cycle, met_at = ported.cycle, met_point(left, ported)
    moments = law_moments(lumped_leaks(pump, left, motion), pump, left, cycle.pressure)
    losses = _losses(lumped_pairs(pump, met_at, motion, cycle), pistons * moments.power, means)
    for one in effects:
        losses = rubbed(losses, one)
    exchange = GapExchange(chamber_exchange(cycle, pistons * point.shaft_speed / TURN).drag_power, *draws)
    derived, masses = swept_displacement(pump, motion.drive), group_masses(pump)
    outside = mean_outside(own, met_point(point, ported), effects)
    found = assemble(point, ported, (losses,), pistons, derived, exchange, (masses,), outside)
    given = given_films(pump)
    return TablePoint(
        pump_point=found,
        table=table,
        film_mean=Gaps(*(getattr(given, gap) * means[f"{gap}.film_mean"] for gap in GAP_PAIRS)),
        film_least=Gaps(*(getattr(given, gap) * means[f"{gap}.film_least"] for gap in GAP_PAIRS)),
        film_rise=Gaps(*(FILM_RISE * means[f"{gap}.film_rise"] for gap in GAP_PAIRS)),
        contact_share=Gaps(*(means[f"{gap}.contact_share"] for gap in GAP_PAIRS)),
    )


def _leaks(pump: PumpDescription, point: OperatingPoint, motion: PistonMotion, means: Mapping[str, float]) -> LeakTable:
    """Flow out of a chamber into each gap, of the table's mean and drag power: a G (p - p_case) + b C + c.

    G and C are the lumped law's, moments those at the pressure of its own cycle. The piston's drag flow is b C, the
    others' is c. A conductance is not negative: where drag exceeds the whole flow, a is 0 and c keeps the mean flow.
    """
    law = lumped_leaks(pump, point, motion)
    cycle = solve_cycle(chamber_problem(pump, point, motion, law), motion.shaft_angle.size)
    moments = law_moments(law, pump, point, cycle.pressure)
    flow = moments.flow * [means[f"{gap}.leakage"] for gap in GAP_PAIRS]
    drag_ratio = np.array([means[f"{gap}.carried"] for gap in GAP_PAIRS])
    constant = np.array([0.0, *(drag_ratio * moments.power / moments.above)[1:]])
    by_pressure = flow - constant * moments.one
    answering = np.maximum(by_pressure / moments.flow, 0.0)
    constant += (by_pressure - answering * moments.flow) / moments.one
    return LeakTable(answering[:, None] * law.conductance, drag_ratio[:, None] * law.drag_flow + constant[:, None])


def _draws(pump: PumpDescription, point: OperatingPoint, means: Mapping[str, float]) -> tuple[float, float]:
    """Flow from delivery and suction port into the valve plate's film, m3/s at port pressure."""
    scale = plate_flow(pump, point)
    return scale * means["valve_plate.delivery_draw"], scale * means["valve_plate.suction_draw"]


def _losses(by_law: FrictionPairs, power: Array, means: Mapping[str, float]) -> FrictionPairs:
    """The lumped pairs, those of gaps and joints with the table's means.

    power (3,) W: the reference power of the table's drag ratios; the table learns the loss less that power.
    """
    losses = {
        pair.value: _with_mean(
            by_law.loss(pair),
            means[f"{gap}.friction"] * by_law.loss(pair).mean + means[f"{gap}.carried"] * float(power[k]),
            means[f"{gap}.contact_share"],
        )
        for k, (gap, pair) in enumerate(GAP_PAIRS.items())
    }
    joint = by_law.piston_slipper_socket
    losses[Pair.PISTON_SLIPPER_SOCKET.value] = _with_mean(joint, means["socket.friction"] * joint.mean, 1.0)
    return replace(by_law, **losses)


def _with_mean(law: PairLoss, mean: float, contact: float) -> PairLoss:
    """A pair with another mean (W, of all), over the angle as the law has its Coulomb and its viscous part."""
    one = mean / law.count
    return PairLoss(law.count, _scaled(law.coulomb, contact * one), _scaled(law.viscous, (1.0 - contact) * one))


def _scaled(course: Array, mean: float) -> Array:
    """A course over the angle with another mean; flat where it is nothing (a coefficient of 0)."""
    own = float(np.mean(course))
    return course * (mean / own) if own > 0.0 else np.full_like(course, mean)
