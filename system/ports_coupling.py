"""Chambers and the volumes behind both ports, periodic together: port pressure ripple and flow ripple.

All chambers are alike, so that the ports repeat with each piston pitch. Given port pressures over a pitch, one
chamber's cycle says what comes in; `ports_volume` answers with better pressures, mixed by Anderson's rule.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reynolds.anderson import History
from system.chamber import TOLERANCE, ChamberCycle, flow_energy, solve_cycle
from system.chamber_kernel import CAVITY_PRESSURE
from system.chamber_problem import ChamberProblem, PortPressure
from system.errors import NotConverged
from system.kinematics import Array
from system.lines import HeldPressure, Line, Lines, OrificeLine
from system.pairs import over_chambers
from system.ports import TURN, PortOpening, opening_area
from system.ports_volume import Supply, line_power, port_balance

ROUND_LIMIT = 60
SETTLED = 10.0
"""Change of a port pressure between two rounds, in tolerances of the chamber, at which they agree: its noise."""


@dataclass(frozen=True)
class Port:
    """One port over the turn: arrays over the cycle's shaft angles, SI, pressure gauge, flows out of the pump.

    pressure Pa; line_flow m3/s at that pressure; orifice_area m2 of the line, None without an orifice; power W,
    mean, that the line takes with its oil beyond that of the mean flow at the mean pressure; balance_error: oil of
    the port's volume not accounted for, of the oil through it in a piston pitch.
    """

    pressure: Array
    line_flow: Array
    orifice_area: float | None
    ripple_power: float
    balance_error: float

    @property
    def mean_pressure(self) -> float:
        """Mean over the turn, Pa."""
        return float(np.mean(self.pressure))


@dataclass(frozen=True)
class PortedCycle:
    """A chamber's cycle and both ports, periodic together; `problem` is the chamber's with these port pressures.

    rounds of chamber and ports, 0 where both pressures are held; change: the last round's largest, Pa.
    """

    problem: ChamberProblem
    cycle: ChamberCycle
    delivery: Port
    suction: Port
    rounds: int
    change: float


def ported_cycle(
    problem: ChamberProblem,
    lines: Lines,
    pistons: int,
    samples: int,
    tolerance: float = TOLERANCE,
    draws: tuple[Array | float, Array | float] = (0.0, 0.0),
) -> PortedCycle:
    """The periodic revolution of a pump's chambers together with the volumes behind its ports.

    `problem` gives the ports' mean pressures: held, met by an orifice of free area, or where an orifice of stated
    area begins its search. draws in m3/s at zero gauge pressure: what films take from delivery and suction port, a
    mean or (samples/pistons,) over a pitch from shaft angle 0.
    Raises NotConverged when ports and chambers do not agree within ROUND_LIMIT rounds, where a port cavitates, and
    as `solve_cycle`.
    """
    cycle = solve_cycle(problem, samples, tolerance)
    drawn = [np.broadcast_to(np.asarray(draw, dtype=float), samples // pistons) for draw in draws]
    sides = (
        _Side(lines.delivery, 0, problem.delivery_pressure, problem.delivery_port, drawn[0], pistons),
        _Side(lines.suction, 1, problem.inlet_pressure, problem.suction_port, drawn[1], pistons),
    )
    pressure = np.stack([side.first_pressure(problem, cycle) for side in sides])
    rounds, change = 0, 0.0
    if lines != Lines():
        problem, cycle, pressure, rounds, change = _agree(sides, pressure, problem, samples, tolerance)
    delivery, suction = (side.port(p, problem, cycle) for side, p in zip(sides, pressure, strict=True))
    return PortedCycle(problem, cycle, delivery, suction, rounds, change)


def _agree(
    sides: tuple[_Side, _Side], pressure: Array, problem: ChamberProblem, samples: int, tolerance: float
) -> tuple[ChamberProblem, ChamberCycle, Array, int, float]:
    """Rounds of chamber and ports from port pressures (2, M) until these repeat: what `PortedCycle` says of it."""
    history, limit = History(), SETTLED * tolerance * problem.pressure_span
    for rounds in range(1, ROUND_LIMIT + 1):
        problem = _with_ports(problem, pressure, sides[0].pistons)
        cycle = solve_cycle(problem, samples, tolerance)
        image = np.stack([side.better(p, problem, cycle) for side, p in zip(sides, pressure, strict=True)])
        change = float(np.max(np.abs(image - pressure)))
        if change <= limit:
            return problem, cycle, pressure, rounds, change
        pressure = history.extrapolate(pressure, image)
    for side, found in zip(sides, pressure, strict=True):
        side.hold_liquid(found)
    raise NotConverged(
        f"port pressures: after {ROUND_LIMIT} rounds of chambers and ports they still change by {change:.3g} Pa, "
        f"expected at most {limit:.3g} Pa; give a larger volume behind the port"
    )


@dataclass(frozen=True)
class _Side:
    """One port while it is sought: `index` 0 delivery, 1 suction; `wanted` mean pressure Pa."""

    line: Line
    index: int
    wanted: float
    opening: PortOpening
    draw: Array
    pistons: int

    def supply(self, problem: ChamberProblem, cycle: ChamberCycle) -> Supply:
        """What all chambers bring to this port over a piston pitch."""
        pitch = cycle.shaft_angle.size // self.pistons
        open_volume = cycle.volume * (opening_area(self.opening, cycle.shaft_angle) > 0.0)
        path = (cycle.outflow.delivery, cycle.outflow.suction)[self.index]
        return Supply(
            period=TURN / (self.pistons * problem.shaft_speed),
            mean=self.pistons * problem.shaft_speed / TURN * float(path),
            surge=over_chambers(cycle.surge[self.index], self.pistons)[:pitch],
            draw=self.draw,
            open_volume=self.pistons * float(np.mean(open_volume)),
        )

    def first_pressure(self, problem: ChamberProblem, cycle: ChamberCycle) -> Array:
        """The wanted pressure over a pitch, or Bernoulli's for its flow through an orifice of stated area."""
        pitch, first = cycle.shaft_angle.size // self.pistons, self.wanted
        if isinstance(self.line, OrificeLine) and self.line.area is not None:
            flow = self.supply(problem, cycle).mean - float(np.mean(self.draw))
            speed = flow / (problem.flow_coefficient * self.line.area)
            first = self.line.tank_pressure + 0.5 * problem.density * speed * abs(speed)
        return np.full(pitch, first)

    def better(self, pressure: Array, problem: ChamberProblem, cycle: ChamberCycle) -> Array:
        """The next pressure over a pitch."""
        if isinstance(self.line, HeldPressure):
            return pressure
        supply = self.supply(problem, cycle)
        return port_balance(self.line, pressure, self.wanted, supply, problem).next_pressure

    def port(self, pressure: Array, problem: ChamberProblem, cycle: ChamberCycle) -> Port:
        """The port as it was found; raises NotConverged where it cavitates."""
        self.hold_liquid(pressure)
        if isinstance(self.line, HeldPressure):
            return Port(
                np.tile(pressure, self.pistons), self._through(pressure[0], problem, cycle), None, 0.0, 0.0
            )
        supply, modulus = self.supply(problem, cycle), problem.bulk_modulus
        balance = port_balance(self.line, pressure, self.wanted, supply, problem)
        flow = balance.line.flow
        steady = float(np.mean(flow * np.exp(pressure / modulus))) * flow_energy(float(np.mean(pressure)), modulus)
        lost = float(np.max(np.abs(balance.rest))) + abs(balance.mean_rest) * supply.period
        return Port(
            pressure=np.tile(pressure, self.pistons),
            line_flow=np.tile(flow, self.pistons),
            orifice_area=balance.line.area,
            ripple_power=line_power(flow, pressure, problem) - float(steady),
            balance_error=lost / (abs(supply.mean) * supply.period),
        )

    def hold_liquid(self, pressure: Array) -> None:
        """Raise NotConverged where the port's oil would not stay liquid."""
        if pressure.min() < CAVITY_PRESSURE:
            name = ("delivery", "suction")[self.index]
            raise NotConverged(
                f"{name} port: its pressure falls to {pressure.min() * 1e-6:.3g} MPa, expected liquid oil, above "
                f"{CAVITY_PRESSURE * 1e-6:.3g} MPa; give a larger volume, orifice or mean pressure"
            )

    def _through(self, pressure: float, problem: ChamberProblem, cycle: ChamberCycle) -> Array:
        """What all chambers push through the port, m3/s at its pressure, less what films draw."""
        flow = (cycle.flow.delivery, cycle.flow.suction)[self.index]
        mass_flow = flow * np.exp(np.maximum(cycle.pressure, CAVITY_PRESSURE) / problem.bulk_modulus)
        thin = np.exp(-pressure / problem.bulk_modulus)
        return np.asarray((over_chambers(mass_flow, self.pistons) - np.tile(self.draw, self.pistons)) * thin)


def _with_ports(problem: ChamberProblem, pressure: Array, pistons: int) -> ChamberProblem:
    """The chamber with port pressures (2, M) over a pitch."""
    turn = np.tile(pressure, pistons)
    delivery, inlet = (float(mean) for mean in pressure.mean(axis=1))
    ports = PortPressure(turn[0], turn[1])
    return replace(problem, delivery_pressure=delivery, inlet_pressure=inlet, port_pressure=ports)
