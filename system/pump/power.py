"""Where the shaft power goes: one sink for each thing that takes it, computed on its own."""

from __future__ import annotations

from dataclasses import dataclass

from system.pump.bench import BenchReading, elastic_energy
from system.pump.chamber.cycle import ChamberCycle, flow_energy
from system.pump.chamber.port_coupling import PortedCycle
from system.pump.chamber.problem import ChamberProblem


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
    that which enters (compression: a machine downstream can take it back); ripple: what both ports' lines take
    besides, as pressure and flow pulse together; leakage: turned into heat in each gap by the pressure;
    throttling_delivery, throttling_suction: in the ports; friction: the seven pairs; extended: what effects of
    [physics] carry off past the chambers and the pairs.
    """

    shaft: float
    hydraulic: float
    elastic: float
    ripple: float
    leakage: Gaps
    throttling_delivery: float
    throttling_suction: float
    friction: float
    extended: float = 0.0

    @property
    def throttling(self) -> float:
        """Both ports together."""
        return self.throttling_delivery + self.throttling_suction

    @property
    def accounted(self) -> float:
        """All that the shaft power goes into."""
        delivered = self.hydraulic + self.elastic + self.ripple
        return delivered + self.leakage.total + self.throttling + self.friction + self.extended


def port_draw(problem: ChamberProblem, exchange: GapExchange) -> tuple[float, float]:
    """What the valve plate's film takes from delivery and suction port, m3/s at zero gauge pressure."""
    return (
        exchange.delivery_draw / problem.specific_volume(problem.delivery_pressure),
        exchange.suction_draw / problem.specific_volume(problem.inlet_pressure),
    )


def shaft_work(cycle: ChamberCycle, rate: float, friction: float, exchange: GapExchange) -> float:
    """Shaft power in W by the pistons' work on the chambers, less what carried oil gives back, and friction.

    What carried oil gives is the pull of the gap's pressure gradient on the piston: with it the torque, like the
    flow, belongs to the mean of piston and bore area.
    """
    return rate * cycle.indicated_work - exchange.carried.total + friction


def leakage_by_flow(ported: PortedCycle, rate: float, exchange: GapExchange) -> Gaps:
    """What pressure turns into heat in each gap (W), from what flows and what that gives the walls it meets."""
    problem, energy, carried = ported.problem, ported.cycle.path_energy, exchange.carried
    modulus = problem.bulk_modulus
    pressures = (problem.delivery_pressure, problem.inlet_pressure)
    from_ports = sum(
        draw * float(flow_energy(pressure, modulus) - flow_energy(problem.case_pressure, modulus))
        for draw, pressure in zip(port_draw(problem, exchange), pressures, strict=True)
    )
    return Gaps(
        rate * float(energy.piston) - carried.piston,
        rate * float(energy.slipper) - carried.slipper,
        rate * float(energy.valve_plate) + from_ports - carried.valve_plate,
    )


def power_balance(
    ported: PortedCycle, reading: BenchReading, rate: float, friction: float, leakage: Gaps
) -> PowerBalance:
    """A reading's shaft power and its sinks.

    rate: chambers times turns per second; friction: W of all pairs; leakage: W of each gap.
    """
    problem, cycle = ported.problem, ported.cycle
    ports = (
        (reading.delivery_flow, reading.delivery_pressure),
        (-reading.inlet_flow, reading.inlet_pressure),
        (reading.drain_flow, reading.drain_pressure),
    )
    energy, modulus = cycle.path_energy, problem.bulk_modulus
    return PowerBalance(
        shaft=reading.shaft_power,
        hydraulic=sum(flow * pressure for flow, pressure in ports),
        elastic=sum(flow * elastic_energy(pressure, modulus) for flow, pressure in ports),
        ripple=ported.delivery.ripple_power + ported.suction.ripple_power,
        leakage=leakage,
        throttling_delivery=rate * float(energy.delivery),
        throttling_suction=rate * float(energy.suction),
        friction=friction,
    )
