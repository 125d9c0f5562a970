"""The table fidelity: the lumped kernel with the film physics of a response table's ratios."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from reynolds.errors import NotConverged
from system.description.pump import PumpDescription
from system.effects.friction import rubbed
from system.inputs.units import TURN
from system.points.effects import affected_problem, at_the_ports, mean_outside
from system.points.film_effects import closed_laws
from system.points.lumped import point_and_effects
from system.points.table.gap_numbers import gap_leaks, gap_losses, port_draws
from system.points.table.means import FILM_RISE, GAP_PAIRS, given_films
from system.points.table.response_table import ResponseTable
from system.points.table.sources import Source
from system.pump.assembly import PumpPoint, assemble, met_point
from system.pump.chamber.cycle import solve_cycle
from system.pump.chamber.port_coupling import ported_cycle
from system.pump.chamber.problem import LeakTable
from system.pump.chamber.turn import Gaps
from system.pump.chamber_kinds import kinds
from system.pump.friction_range import with_friction_range
from system.pump.lumped import (
    PistonMotion,
    chamber_problem,
    group_masses,
    lumped_leaks,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.pump.operating import OperatingPoint
from system.pump.power import GapExchange, chamber_exchange, port_draw

ROUND_LIMIT = 12
SETTLED = 1e-6
"""Part of the ports' pressure difference by which the delivery pressure may differ from the one of the table: only an
orifice of stated area changes it."""


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

    The pump is the table's own, of any dimensions in the box. Raises InputError outside the box or at another inlet or
    case pressure, NotConverged as `ported_cycle` and where an orifice line does not converge, ValueError where chambers
    differ. Effects of [physics] that the table's films have not solved act by their laws; pressure that the inlet loses
    ahead of the suction port acts on the films as it does on the lumped law, the reference of the table's ratios.
    """
    kinds(pump).hold_alike()
    own = closed_laws(pump, floating=table.origin.source is Source.FLOATING)
    _, effects = point_and_effects(own, point)
    left = at_the_ports(point, effects)
    motion, lines, pistons = piston_motion(pump, left), port_lines(pump, left), pump.pump.pistons
    asked = left
    for _ in range(ROUND_LIMIT):
        means = table.at(pump, replace(asked, inlet_pressure=point.inlet_pressure))
        problem = affected_problem(pump, left, motion, _leaks(pump, asked, motion, means), effects)
        draws = port_draws(pump, asked, means)
        none = GapExchange(Gaps(0.0, 0.0, 0.0), draws.delivery, draws.suction)
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
    losses = gap_losses(pump, met_at, motion, cycle, means)
    for one in effects:
        losses = rubbed(losses, one)
    exchange = GapExchange(
        chamber_exchange(cycle, pistons * point.shaft_speed / TURN).drag_power, draws.delivery, draws.suction
    )
    derived, masses = swept_displacement(pump, motion.drive), group_masses(pump)
    outside = mean_outside(own, met_point(point, ported), effects)
    found = assemble(point, ported, (losses,), pistons, derived, exchange, (masses,), outside)
    if table.origin.source is Source.FIXED:
        found = with_friction_range(pump, found)
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
    """The gaps' flows at the pressure of the lumped law's own cycle."""
    law = chamber_problem(pump, point, motion, lumped_leaks(pump, point, motion))
    return gap_leaks(pump, point, motion, solve_cycle(law, motion.shaft_angle.size), means)
