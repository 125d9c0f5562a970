"""Power balance of the shaft: each sink computed on its own."""

from dataclasses import dataclass, replace
from typing import Generic

from system.inputs.units import TURN
from system.pump.bench import BenchReading, Outside, elastic_energy
from system.pump.chamber.cycle import bubbly_volume, flow_energy, specific_volume
from system.pump.chamber.port_coupling import PortedCycle
from system.pump.chamber.problem import Chamber, ChamberProblem
from system.pump.chamber.setup import chamber_records
from system.pump.chamber.state_kernels import energy_at, oil_of
from system.pump.chamber.turn import Gaps, TurnTotals
from system.pump.laws.kinematics import Number


@dataclass(frozen=True)
class GapExchange(Generic[Number]):
    """Exchange of the gaps besides the leakage of one chamber, mean over the revolution.

    drag_power: power in W that oil dragged along by moving walls returns to them, all chambers; delivery_draw,
    suction_draw: flow in m3/s (at port pressure) from the ports themselves into the valve plate's film.
    """

    drag_power: Gaps[Number]
    delivery_draw: Number
    suction_draw: Number


def chamber_exchange(totals: TurnTotals[Number], rate: Number) -> GapExchange[Number]:
    """The exchange of gaps that depend on their own chamber alone; `rate` is chambers times turns per second."""
    drag = totals.drag_energy
    each = rate * drag.piston, rate * drag.slipper, rate * drag.valve_plate
    return GapExchange(Gaps(*each), 0.0 * rate, 0.0 * rate)


@dataclass(frozen=True)
class PowerBalance:
    """Sinks of the shaft power, mean over a revolution, in W: the fields except `shaft` add up to it.

    hydraulic: p Q summed over delivery, inlet (negative) and case; elastic: stored in the oil that leaves, less that
    which enters (compression: a machine downstream can recover it); ripple: additional power into both ports' lines, as
    pressure and flow pulse together; leakage: turned into heat in each gap by the pressure; throttling_delivery,
    throttling_suction: in the ports; friction: the seven pairs; extended: losses by effects of [physics] outside the
    chambers and the pairs.
    """

    shaft: float
    hydraulic: float
    elastic: float
    ripple: float
    leakage: Gaps
    throttling_delivery: float
    throttling_suction: float
    friction: float
    extended: float

    @property
    def throttling(self) -> float:
        """Both ports together."""
        return self.throttling_delivery + self.throttling_suction

    @property
    def accounted(self) -> float:
        """Sum of all sinks of the shaft power."""
        delivered = self.hydraulic + self.elastic + self.ripple
        return delivered + self.leakage.total + self.throttling + self.friction + self.extended


def port_draw(chamber: Chamber[Number], exchange: GapExchange[Number]) -> tuple[Number, Number]:
    """Flow of the valve plate's film from delivery and suction port, m3/s at zero gauge pressure."""
    return (
        exchange.delivery_draw / specific_volume(chamber.delivery_pressure, chamber.bulk_modulus),
        exchange.suction_draw / specific_volume(chamber.inlet_pressure, chamber.bulk_modulus),
    )


def gap_leakage(
    chamber: Chamber[Number], totals: TurnTotals[Number], rate: Number, exchange: GapExchange[Number]
) -> Gaps[Number]:
    """Leakage of each gap to the case, mean, all chambers, in m3/s at case pressure."""
    case, out = specific_volume(chamber.case_pressure, chamber.bulk_modulus), totals.outflow
    from_ports = case * sum(port_draw(chamber, exchange))
    scale = rate * case
    return Gaps(scale * out.piston, scale * out.slipper, scale * out.valve_plate + from_ports)


def bench_reading(
    chamber: Chamber[Number],
    totals: TurnTotals[Number],
    pistons: int,
    friction: Number,
    exchange: GapExchange[Number],
    outside: Outside[Number] | Outside[float],
) -> BenchReading[Number]:
    """Flows and torque of a pump by its chambers' totals, the friction (W) of its pairs and the flows past them.

    Bubbles in the oil count in the flows of delivery and inlet, not in the drain's, where they leave the oil. The
    torque is that of `shaft_work`, as accurate as the chambers' integration. The delivery's flow is the pump's own,
    before the factor of its meter (`metered`).
    """
    rate, out = pistons * chamber.shaft_speed / TURN, totals.outflow
    delivered = rate * out.delivery * bubbly_volume(chamber.delivery_pressure, chamber)
    inlet = chamber.inlet_pressure + outside.suction_loss
    drawn_in = -rate * out.suction * bubbly_volume(inlet, chamber)
    drained = gap_leakage(chamber, totals, rate, exchange).total
    work = shaft_work(totals, rate, friction, exchange)
    return BenchReading(
        shaft_speed=chamber.shaft_speed,
        shaft_torque=work / chamber.shaft_speed + outside.torque,
        delivery_pressure=chamber.delivery_pressure,
        inlet_pressure=inlet,
        drain_pressure=chamber.case_pressure,
        delivery_flow=delivered - exchange.delivery_draw + outside.delivery,
        inlet_flow=drawn_in + exchange.suction_draw + outside.inlet,
        drain_flow=drained + outside.drain,
    )


def metered(reading: BenchReading[Number], outside: Outside[Number] | Outside[float]) -> BenchReading[Number]:
    """The reading with the delivery flow that its meter shows."""
    return replace(reading, delivery_flow=reading.delivery_flow * outside.delivery_reading)


def shaft_work(totals: TurnTotals[Number], rate: Number, friction: Number, exchange: GapExchange[Number]) -> Number:
    """Shaft power in W by the pistons' work on the chambers, less the drag power, and friction.

    The drag power is the pull of the gap's pressure gradient on the piston: with it the torque, like the
    flow, belongs to the mean of piston and bore area.
    """
    return rate * totals.indicated_work - exchange.drag_power.total + friction


def leakage_by_flow(ported: PortedCycle, rate: float, exchange: GapExchange) -> Gaps:
    """Heat of the pressure flow in each gap (W): energy that the flow loses less its work on the walls."""
    problem, energy, drag = ported.problem, ported.cycle.path_energy, exchange.drag_power
    modulus = problem.bulk_modulus
    pressures = (problem.delivery_pressure, problem.inlet_pressure)
    from_ports = sum(
        draw * float(flow_energy(pressure, modulus) - flow_energy(problem.case_pressure, modulus))
        for draw, pressure in zip(port_draw(problem, exchange), pressures, strict=True)
    )
    return Gaps(
        rate * float(energy.piston) - drag.piston,
        rate * float(energy.slipper) - drag.slipper,
        rate * float(energy.valve_plate) + from_ports - drag.valve_plate,
    )


def power_balance(
    ported: PortedCycle, reading: BenchReading, rate: float, friction: float, leakage: Gaps, extended: float
) -> PowerBalance:
    """A reading's shaft power and its sinks.

    rate: chambers times turns per second; friction: W of all pairs; leakage: W of each gap; extended: W of losses
    outside chambers and pairs.
    """
    energy, ports = ported.cycle.path_energy, reading.ports
    return PowerBalance(
        shaft=reading.shaft_power,
        hydraulic=sum(flow * pressure for flow, pressure in ports),
        elastic=sum(flow * _held_energy(pressure, ported.problem) for flow, pressure in ports),
        ripple=ported.delivery.ripple_power + ported.suction.ripple_power,
        leakage=leakage,
        throttling_delivery=rate * float(energy.delivery),
        throttling_suction=rate * float(energy.suction),
        friction=friction,
        extended=extended,
    )


def _held_energy(pressure: float, chamber: ChamberProblem) -> float:
    """Energy in J per m3 that oil and its bubbles hold at a gauge pressure; of oil alone `elastic_energy`."""
    if not chamber.free_air:
        return elastic_energy(pressure, chamber.bulk_modulus)
    return energy_at(pressure, oil_of(chamber_records(chamber))) / bubbly_volume(pressure, chamber) - pressure
