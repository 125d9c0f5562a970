"""From one chamber's cycle and the pair losses to the pump: flows, torque, powers. The same for every fidelity."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from system.bench import BenchReading, Efficiency, elastic_energy, iso_efficiency, paper_efficiency
from system.chamber import ChamberCycle, Paths, flow_energy
from system.chamber_kernel import CAVITY_PRESSURE
from system.chamber_problem import ChamberProblem, LeakTable
from system.kinematics import Array, stroke
from system.operating import OperatingPoint
from system.pairs import FrictionPairs, Pair, over_chambers
from system.ports import TURN, opening_area
from system.units import STANDARD_ATMOSPHERE


class PointWarning(Enum):
    """What a reader of the numbers must know; none of them makes a number void."""

    CHAMBER_CAVITATES = "chamber_cavitates"
    CHAMBER_OVERPRESSURE = "chamber_overpressure"
    NO_DELIVERY = "no_delivery"


@dataclass(frozen=True)
class Remark:
    """A warning of a point with its number, limit and remedy."""

    warning: PointWarning
    text: str

    def __str__(self) -> str:
        """Name and text."""
        return f"{self.warning.value}: {self.text}"


OVERPRESSURE = 1.1
"""Chamber peak over the higher port pressure (both absolute) from which trapped oil is told."""


@dataclass(frozen=True)
class Gaps:
    """One number for each of the three gaps."""

    piston: float
    slipper: float
    valve_plate: float

    @property
    def total(self) -> float:
        """All three together."""
        return self.piston + self.slipper + self.valve_plate


@dataclass(frozen=True)
class GapExchange:
    """What the gaps exchange beside one chamber's leakage, mean over the revolution.

    carried: power in W that oil dragged along by moving walls gives them back, all chambers; delivery_draw,
    suction_draw: flow in m3/s (at port pressure) that the valve plate's film takes from the ports themselves.
    """

    carried: Gaps
    delivery_draw: float
    suction_draw: float


def chamber_exchange(cycle: ChamberCycle, rate: float) -> GapExchange:
    """The exchange of gaps that know nothing but their own chamber; `rate` is chambers times turns per second."""
    return GapExchange(Gaps(*(rate * float(work) for work in cycle.carried_energy)), 0.0, 0.0)


@dataclass(frozen=True)
class PowerBalance:
    """Where the shaft power goes, mean over a revolution, in W: the fields but `shaft` add up to it.

    hydraulic: p Q summed over delivery, inlet (negative) and case; elastic: stored in the oil that leaves, less
    that which enters (compression: a machine downstream can take it back); leakage: turned into heat in each gap
    by the pressure; throttling_delivery, throttling_suction: in the ports; friction: the seven pairs.
    """

    shaft: float
    hydraulic: float
    elastic: float
    leakage: Gaps
    throttling_delivery: float
    throttling_suction: float
    friction: float

    @property
    def throttling(self) -> float:
        """Both ports together."""
        return self.throttling_delivery + self.throttling_suction

    @property
    def accounted(self) -> float:
        """All that the shaft power goes into."""
        return self.hydraulic + self.elastic + self.leakage.total + self.throttling + self.friction


@dataclass(frozen=True)
class PointChecks:
    """Relative errors of a point; those of the chamber are in its cycle.

    mass_balance_error of the delivered mass; energy_balance_error of the shaft power; quadrature_error: of the
    friction power, estimated from every second shaft angle.
    """

    mass_balance_error: float
    energy_balance_error: float
    quadrature_error: float


@dataclass(frozen=True)
class PumpPoint:
    """One operating point of a pump, periodic: SI, pressures gauge.

    Per chamber, arrays over `cycle.shaft_angle`: `cycle`, `delivery_area`, `suction_area` in m2. Whole pump:
    `delivery_flow_ripple` in m3/s over the same angles (volume at chamber pressure through the delivery port);
    `leakage_flow` of each gap (mean over the revolution, all chambers, volume at case pressure); `bench`, what a
    test bench reads; `geometric_displacement` and `derived_displacement` in m3 per revolution.
    """

    point: OperatingPoint
    swash_angle: float
    cycle: ChamberCycle
    delivery_area: Array
    suction_area: Array
    delivery_flow_ripple: Array
    leakage_flow: Gaps
    leaks: LeakTable
    pairs: FrictionPairs
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
    problem: ChamberProblem,
    cycle: ChamberCycle,
    pairs: FrictionPairs,
    pistons: int,
    derived_displacement: float,
    exchange: GapExchange,
) -> PumpPoint:
    """The pump's flows, torque and powers from one chamber's periodic cycle and the friction of its pairs.

    Shaft torque = (indicated power - power that carried oil gives to the moving walls + friction)/w. The second
    term is the pull of the gap's pressure gradient on the piston: with it the torque, like the flow, belongs to
    the mean of piston and bore area, and the energy balance closes.
    """
    rate = pistons * point.shaft_speed / TURN
    power = _power_balance(point, problem, cycle, rate, pairs.power, exchange)
    reading = _reading(point, problem, cycle.outflow, rate, power.shaft, exchange)
    quadrature = sum(pairs.loss(pair).quadrature_error for pair in Pair)
    return PumpPoint(
        point=point,
        swash_angle=problem.drive.swash_angle,
        cycle=cycle,
        delivery_area=opening_area(problem.delivery_port, cycle.shaft_angle),
        suction_area=opening_area(problem.suction_port, cycle.shaft_angle),
        delivery_flow_ripple=over_chambers(cycle.flow.delivery, pistons),
        leakage_flow=_leakage_flow(problem, cycle.outflow, rate, exchange),
        leaks=problem.leaks,
        pairs=pairs,
        bench=reading,
        power=power,
        geometric_displacement=pistons * problem.piston_area * stroke(problem.drive),
        derived_displacement=derived_displacement,
        checks=PointChecks(
            mass_balance_error=cycle.checks.mass_balance_error,
            energy_balance_error=abs(power.shaft - power.accounted) / abs(power.shaft),
            quadrature_error=quadrature / pairs.power,
        ),
        warnings=tuple(_remarks(point, cycle, reading)),
    )


def pumps(reading: BenchReading) -> bool:
    """Whether shaft power goes in and oil goes from inlet to delivery: elsewhere an efficiency is void."""
    return reading.shaft_power > 0.0 and reading.inlet_flow > 0.0 and reading.delivery_flow > 0.0


def _remarks(point: OperatingPoint, cycle: ChamberCycle, reading: BenchReading) -> Iterator[Remark]:
    if not pumps(reading):
        yield Remark(
            PointWarning.NO_DELIVERY,
            f"delivery flow {reading.delivery_flow * 6e4:.3g} L/min, inlet flow {reading.inlet_flow * 6e4:.3g} "
            f"L/min, shaft power {reading.shaft_power:.3g} W (limit: all above 0): leakage takes more than the "
            "pistons move, efficiencies are void; raise speed or displacement, lower pressure or temperature",
        )
    degrees = np.degrees(cycle.shaft_angle)
    if cycle.cavitates:
        low = degrees[cycle.pressure <= CAVITY_PRESSURE]
        yield Remark(
            PointWarning.CHAMBER_CAVITATES,
            f"a cavity opens in the chamber (vacuum at {low.size} of {degrees.size} sampled shaft angles, from "
            f"{low.min():.0f} to {low.max():.0f} deg): a starved inlet, or both ports shut while the piston moves "
            "out; air release is not modelled; raise the inlet pressure, or let the ports change over sooner",
        )
    highest = max(point.delivery_pressure, point.inlet_pressure)
    limit = OVERPRESSURE * (highest + STANDARD_ATMOSPHERE) - STANDARD_ATMOSPHERE
    peak = int(np.argmax(cycle.pressure))
    if cycle.pressure[peak] > limit:
        yield Remark(
            PointWarning.CHAMBER_OVERPRESSURE,
            f"the chamber peaks at {cycle.pressure[peak] * 1e-6:.1f} MPa at {degrees[peak]:.0f} deg (limit "
            f"{limit * 1e-6:.1f} MPa, {OVERPRESSURE - 1.0:.0%} over the port): both ports shut while the piston "
            "moves in; let the port shut later, or the relief groove of the next begin earlier",
        )


def _leakage_flow(problem: ChamberProblem, outflow: Paths, rate: float, exchange: GapExchange) -> Gaps:
    scale = rate * problem.specific_volume(problem.case_pressure)
    draw = problem.specific_volume(problem.case_pressure) * sum(_port_draw(problem, exchange))
    return Gaps(
        scale * float(outflow.piston), scale * float(outflow.slipper), scale * float(outflow.valve_plate) + draw
    )


def _port_draw(problem: ChamberProblem, exchange: GapExchange) -> tuple[float, float]:
    """What the valve plate's film takes from delivery and suction port, m3/s at zero gauge pressure."""
    return (
        exchange.delivery_draw / problem.specific_volume(problem.delivery_pressure),
        exchange.suction_draw / problem.specific_volume(problem.inlet_pressure),
    )


def _reading(
    point: OperatingPoint,
    problem: ChamberProblem,
    outflow: Paths,
    rate: float,
    shaft_power: float,
    exchange: GapExchange,
) -> BenchReading:
    delivered = rate * float(outflow.delivery) * problem.specific_volume(point.delivery_pressure)
    drawn_in = -rate * float(outflow.suction) * problem.specific_volume(point.inlet_pressure)
    return BenchReading(
        shaft_speed=point.shaft_speed,
        shaft_torque=shaft_power / point.shaft_speed,
        delivery_pressure=point.delivery_pressure,
        inlet_pressure=point.inlet_pressure,
        drain_pressure=point.case_pressure,
        delivery_flow=delivered - exchange.delivery_draw,
        inlet_flow=drawn_in + exchange.suction_draw,
        drain_flow=_leakage_flow(problem, outflow, rate, exchange).total,
    )


def _power_balance(
    point: OperatingPoint,
    problem: ChamberProblem,
    cycle: ChamberCycle,
    rate: float,
    friction: float,
    exchange: GapExchange,
) -> PowerBalance:
    reading = _reading(point, problem, cycle.outflow, rate, 0.0, exchange)
    ports = (
        (reading.delivery_flow, point.delivery_pressure),
        (-reading.inlet_flow, point.inlet_pressure),
        (reading.drain_flow, point.case_pressure),
    )
    energy, carried = cycle.path_energy, exchange.carried
    modulus = problem.bulk_modulus
    from_ports = sum(
        draw * float(flow_energy(pressure, modulus) - flow_energy(point.case_pressure, modulus))
        for draw, pressure in zip(
            _port_draw(problem, exchange), (point.delivery_pressure, point.inlet_pressure), strict=True
        )
    )
    return PowerBalance(
        shaft=rate * cycle.indicated_work - carried.total + friction,
        hydraulic=sum(flow * pressure for flow, pressure in ports),
        elastic=sum(flow * elastic_energy(pressure, modulus) for flow, pressure in ports),
        leakage=Gaps(
            rate * float(energy.piston) - carried.piston,
            rate * float(energy.slipper) - carried.slipper,
            rate * float(energy.valve_plate) + from_ports - carried.valve_plate,
        ),
        throttling_delivery=rate * float(energy.delivery),
        throttling_suction=rate * float(energy.suction),
        friction=friction,
    )
