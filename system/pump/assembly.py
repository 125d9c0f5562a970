"""From one chamber's cycle and the pair losses to the pump: flows, torque, powers. The same for every fidelity."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from enum import Enum

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.shown import pressure_text
from system.inputs.units import LPM, STANDARD_ATMOSPHERE, TURN
from system.pump.bench import NOTHING_OUTSIDE, BenchReading, Efficiency, Outside, iso_efficiency, paper_efficiency
from system.pump.chamber.cycle import ChamberCycle
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.chamber.port_coupling import Port, PortedCycle
from system.pump.chamber.problem import LeakTable
from system.pump.chamber.turn import Gaps
from system.pump.laws.friction_pairs import FrictionPairs, Pair, over_chambers
from system.pump.laws.kinematics import displacement, stroke
from system.pump.operating import OperatingPoint
from system.pump.ports.areas import opening_area
from system.pump.power import (
    GapExchange,
    PowerBalance,
    bench_reading,
    gap_leakage,
    leakage_by_flow,
    metered,
    power_balance,
)
from system.pump.shaft_torque import GroupMasses, shaft_torque
from system.work.means import mean_of


class PointWarning(Enum):
    """Warnings of an operating point; none of them invalidates a number."""

    CHAMBER_CAVITATES = "chamber_cavitates"
    CHAMBER_OVERPRESSURE = "chamber_overpressure"
    ENERGY_NOT_BALANCED = "energy_not_balanced"
    FRICTION_AT_LOW_SPEED = "friction_at_low_speed"
    NO_DELIVERY = "no_delivery"
    PORT_PRESSURE_FOLLOWS_LINE = "port_pressure_follows_line"
    START_REFUSED = "start_refused"


@dataclass(frozen=True)
class Remark:
    """A warning of a point with its number, limit and remedy."""

    warning: PointWarning
    text: str

    def __str__(self) -> str:
        """Name and text."""
        return f"{self.warning.value}: {self.text}"


PORT_PRESSURE_MET = 1e-3
"""Part of the ports' pressure difference by which a port's mean pressure may differ from the operating point's."""
ENERGY_BALANCED = 5e-3
"""Energy balance error from which a point warns: five times the tolerance of every fidelity."""
OVERPRESSURE = 1.1
"""Chamber peak over the higher port pressure (both absolute) from which a point warns of trapped oil."""


@dataclass(frozen=True)
class PointChecks:
    """Relative errors of a point; those of the chamber are in its cycle.

    mass_balance_error of the delivered mass; energy_balance_error: mean torque from the forces on the rotating group
    times shaft speed against all sinks of the shaft power, each computed independently, of the shaft power;
    work_balance_error: the same with the work that the pistons do by the chambers' integration, friction in either;
    quadrature_error: of the friction power, estimated from every second shaft angle.
    """

    mass_balance_error: float
    energy_balance_error: float
    work_balance_error: float
    quadrature_error: float


@dataclass(frozen=True)
class PumpPoint:
    """One operating point of a pump, periodic: SI, pressures gauge.

    Per chamber, arrays over `cycle.shaft_angle`: `cycle` (where chambers differ their mean, each at its own angle, and
    so `leaks` and `pairs`), `delivery_area`, `suction_area` in m2; `chambers`: the cycle of each, of one where they are
    equal. Whole pump: `delivery_flow_ripple` in m3/s over the same angles (volume at chamber pressure through the
    delivery port); `delivery`, `suction`: pressure of either port and the flow and power of its line; `shaft_torque` in
    N m, from the forces on the rotating group; `leakage_flow` of each gap (mean over the revolution, all chambers,
    volume at case pressure); `exchange`, the gaps' other exchange; `bench`, the readings of a test bench;
    `geometric_displacement` and `derived_displacement` in m3 per revolution.
    """

    point: OperatingPoint
    pistons: int
    swash_angle: float
    cycle: ChamberCycle
    chambers: tuple[ChamberCycle, ...]
    delivery_area: Array
    suction_area: Array
    delivery_flow_ripple: Array
    delivery: Port
    suction: Port
    shaft_torque: Array
    leakage_flow: Gaps
    leaks: LeakTable
    pairs: FrictionPairs
    exchange: GapExchange
    bench: BenchReading
    power: PowerBalance
    geometric_displacement: float
    derived_displacement: float
    checks: PointChecks
    warnings: tuple[Remark, ...]

    @property
    def paper_efficiency(self) -> Efficiency | None:
        """The paper's Eqs. (3)-(5); None where the machine does not pump (warning `no_delivery`)."""
        return paper_efficiency(self.bench) if pumps(self.bench) else None

    @property
    def iso_efficiency(self) -> Efficiency | None:
        """ISO 4391/4409 with the derived displacement; None where the machine does not pump."""
        return iso_efficiency(self.bench, self.derived_displacement) if pumps(self.bench) else None


def assemble(
    point: OperatingPoint,
    ported: PortedCycle,
    pairs: Sequence[FrictionPairs],
    pistons: int,
    derived_displacement: float,
    exchange: GapExchange,
    masses: Sequence[GroupMasses],
    outside: Outside[float] = NOTHING_OUTSIDE,
) -> PumpPoint:
    """The pump's flows, torque and powers from the chambers' periodic cycles and the friction of their pairs.

    pairs, masses: of one chamber for all, or of each of z. outside: flows and torque past the chambers; they do not
    load the lines on the ports. The gaps' heat follows from their flow, and the torque from the forces behind the
    losses: `put_together`.
    """
    ring = exchange.drag_power.valve_plate
    torque = shaft_torque(ported.problems, ported.cycles, pairs, masses, pistons, ring)
    leakage = leakage_by_flow(ported, pistons * point.shaft_speed / TURN, exchange)
    mean = mean_of(pairs)
    return put_together(point, ported, mean, pistons, derived_displacement, exchange, torque, leakage, outside)


def put_together(
    point: OperatingPoint,
    ported: PortedCycle,
    pairs: FrictionPairs,
    pistons: int,
    derived_displacement: float,
    exchange: GapExchange,
    torque: Array,
    leakage: Gaps,
    outside: Outside[float] = NOTHING_OUTSIDE,
) -> PumpPoint:
    """The pump from its chambers' cycle, the friction of its pairs, the shaft's torque (N,) N m by forces and the
    heat (W) of the flow through each gap.

    The bench reads the torque of `power.shaft_work`, as accurate as the chambers' integration; the torque from forces
    is as accurate as the sampling of angles. Where a line of stated orifice sets a port's pressure, the point is given
    at that pressure.
    """
    problem, cycle, asked = ported.problem, ported.cycle, point
    point = met_point(point, ported)
    rate = pistons * point.shaft_speed / TURN
    reading = bench_reading(problem, cycle, pistons, pairs.power, exchange, outside)
    point = replace(point, inlet_pressure=reading.inlet_pressure)
    past = outside.carried_off + outside.suction_loss * reading.inlet_flow
    power = power_balance(ported, reading, rate, pairs.power, leakage, past)
    torque = torque + outside.torque
    energy = abs(point.shaft_speed * float(np.mean(torque)) - power.accounted) / abs(power.shaft)
    leaks = gap_leakage(problem, cycle, rate, exchange)
    quadrature = sum(pairs.loss(pair).quadrature_error for pair in Pair)
    return PumpPoint(
        point=point,
        pistons=pistons,
        swash_angle=problem.drive.swash_angle,
        cycle=cycle,
        chambers=ported.cycles,
        delivery_area=opening_area(problem.delivery_port, cycle.shaft_angle),
        suction_area=opening_area(problem.suction_port, cycle.shaft_angle),
        delivery_flow_ripple=over_chambers([own.flow.delivery for own in ported.cycles], pistons),
        delivery=ported.delivery,
        suction=ported.suction,
        shaft_torque=torque,
        leakage_flow=leaks,
        leaks=mean_of([own.leaks for own in ported.problems]),
        pairs=pairs,
        exchange=exchange,
        bench=metered(reading, outside),
        power=power,
        geometric_displacement=displacement(pistons, problem.piston_area, stroke(problem.drive)),
        derived_displacement=derived_displacement,
        checks=PointChecks(
            mass_balance_error=cycle.checks.mass_balance_error,
            energy_balance_error=energy,
            work_balance_error=abs(power.shaft - power.accounted) / abs(power.shaft),
            quadrature_error=quadrature / pairs.power,
        ),
        warnings=(*_remarks(asked, ported, reading, leaks, pistons), *_unbalanced(energy)),
    )


def met_point(point: OperatingPoint, ported: PortedCycle) -> OperatingPoint:
    """The operating point at the ports' mean pressures, from the balance of chambers and lines."""
    problem = ported.problem
    return replace(point, delivery_pressure=problem.delivery_pressure, inlet_pressure=problem.inlet_pressure)


def pumps(reading: BenchReading) -> bool:
    """True if shaft power is consumed and oil flows from inlet to delivery: else the efficiency is not defined."""
    return reading.shaft_power > 0.0 and reading.inlet_flow > 0.0 and reading.delivery_flow > 0.0


def _remarks(
    asked: OperatingPoint, ported: PortedCycle, reading: BenchReading, leaks: Gaps[float], pistons: int
) -> Iterator[Remark]:
    yield from _ports_off(asked, ported, reading)
    if not pumps(reading):
        a_turn = displacement(pistons, ported.problem.piston_area, stroke(ported.problem.drive))
        yield _no_delivery(reading, leaks, a_turn * reading.shaft_speed / TURN)
    degrees = np.degrees(ported.cycles[0].shaft_angle)
    cycle, name = _chamber_by(ported, lambda one: -float(one.pressure.min()))
    if cycle.cavitates:
        low = degrees[cycle.pressure <= CAVITY_PRESSURE]
        yield Remark(
            PointWarning.CHAMBER_CAVITATES,
            f"a cavity opens in {name} (vacuum at {low.size} of {degrees.size} sampled shaft angles, from "
            f"{low.min():.0f} to {low.max():.0f} deg): a starved inlet, or both ports shut while the piston moves "
            "out; air release is not modelled; raise the inlet pressure, or let the ports change over sooner",
        )
    highest = max(float(ported.delivery.pressure.max()), float(ported.suction.pressure.max()))
    limit = OVERPRESSURE * (highest + STANDARD_ATMOSPHERE) - STANDARD_ATMOSPHERE
    cycle, name = _chamber_by(ported, lambda one: float(one.pressure.max()))
    peak = int(np.argmax(cycle.pressure))
    if cycle.pressure[peak] > limit:
        yield Remark(
            PointWarning.CHAMBER_OVERPRESSURE,
            f"{name} peaks at {pressure_text(cycle.pressure[peak])} at {degrees[peak]:.0f} deg (limit "
            f"{pressure_text(limit)}, {OVERPRESSURE - 1.0:.0%} over the port): both ports shut while the piston "
            "moves in; let the port shut later, or the relief groove of the next begin earlier",
        )


def _no_delivery(reading: BenchReading, leaks: Gaps[float], moved: float) -> Remark:
    """The remark of a machine that does not pump: its oil drives it, leaks, or goes back to the inlet in the chambers.

    moved: flow (m3/s) of the pistons.
    """
    if reading.inlet_flow > 0.0 and reading.delivery_flow > 0.0:
        why = "the oil drives the shaft, as in a motor; efficiencies of a pump are void"
    elif leaks.total >= moved:
        why = _leaking(leaks)
    else:
        why = _carried_back(moved, leaks.total, moved - leaks.total - reading.delivery_flow)
    return Remark(
        PointWarning.NO_DELIVERY,
        f"delivery flow {reading.delivery_flow * LPM:.3g} L/min, inlet flow {reading.inlet_flow * LPM:.3g} L/min, "
        f"shaft power {reading.shaft_power:.3g} W (limit: all above 0): {why}",
    )


def _leaking(leaks: Gaps[float]) -> str:
    """Leakage above the flow of the pistons, with the gap that leaks most."""
    widest = max(fields(leaks), key=lambda gap: float(getattr(leaks, gap.name))).name
    return (
        f"leakage takes more than the pistons move, {getattr(leaks, widest) * LPM:.3g} of {leaks.total * LPM:.3g} "
        f"L/min through the {widest.replace('_', ' ')} gap, efficiencies are void; a tighter gap there, more speed or "
        "displacement, less pressure or temperature"
    )


def _carried_back(moved: float, leakage: float, back: float) -> str:
    """Flow back in the chambers above that of the pistons less the leakage; all in m3/s."""
    return (
        f"the pistons move {moved * LPM:.3g} L/min, of which leakage takes {leakage * LPM:.3g} L/min; the chambers "
        f"take {back * LPM:.3g} L/min back from delivery to inlet, as oil pressed in their dead volume or through "
        "ports that change over at other angles, efficiencies are void; a larger displacement, a smaller dead_volume, "
        "less pressure, or other port angles"
    )


def _unbalanced(energy: float) -> Iterator[Remark]:
    """A remark where the power of the forces on the shaft differs from the sum of all sinks."""
    if energy > ENERGY_BALANCED:
        yield Remark(
            PointWarning.ENERGY_NOT_BALANCED,
            f"the torque of the forces on the rotating group and all that the shaft power goes into differ by "
            f"{energy:.2%} of it (limit {ENERGY_BALANCED:.1%}): more steps of floating gaps, and spins left free, "
            "since what drives one that is stated gives power that is not the shaft's",
        )


def _chamber_by(ported: PortedCycle, size: Callable[[ChamberCycle], float]) -> tuple[ChamberCycle, str]:
    """The chamber that is largest by a measure, and its name."""
    number = int(np.argmax([size(cycle) for cycle in ported.cycles]))
    return ported.cycles[number], "the chamber" if len(ported.cycles) == 1 else f"chamber {number + 1}"


def _ports_off(asked: OperatingPoint, ported: PortedCycle, reading: BenchReading) -> Iterator[Remark]:
    """A remark for each port whose line keeps another mean pressure than requested.

    At the inlet by its gauge, ahead of what effects take from it before the suction port.
    """
    allowed = PORT_PRESSURE_MET * ported.problem.pressure_span
    wanted = (asked.delivery_pressure, asked.inlet_pressure)
    met = (reading.delivery_pressure, reading.inlet_pressure)
    for name, found, pressure in zip(("delivery", "inlet"), met, wanted, strict=True):
        if abs(found - pressure) > allowed:
            yield Remark(
                PointWarning.PORT_PRESSURE_FOLLOWS_LINE,
                f"the mean {name} pressure is {pressure_text(found)}, what the orifice of its line "
                f"makes of the flow, not {pressure_text(pressure)} (limit {pressure_text(allowed)} off); leave "
                "the orifice's area out and it is found",
            )
