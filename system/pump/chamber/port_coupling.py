"""Chambers and the volumes behind both ports, periodic together: port pressure ripple and flow ripple.

Where all chambers are equal the ports repeat with each piston pitch, else with the turn. With port pressures over that
time, the chambers' cycles give the inflow; `ports_volume` returns better pressures, mixed by Anderson's rule.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.anderson import History
from reynolds.numerics.arrays import Array
from system.inputs.shown import pressure_text
from system.inputs.units import TURN
from system.pump.chamber.cycle import TOLERANCE, ChamberCycle, bubbly_volume, flow_energy, solve_cycle
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.chamber.port_volume import Supply, line_power, port_balance
from system.pump.chamber.problem import ChamberProblem, PortPressure
from system.pump.laws.friction_pairs import over_chambers
from system.pump.ports.areas import PortOpening, opening_area
from system.pump.ports.lines import HeldPressure, Line, Lines, OrificeLine
from system.work.means import mean_of

ROUND_LIMIT = 60
SETTLED = 10.0
"""Change of a port pressure between two rounds, in tolerances of the chamber, at which they agree: its noise."""


@dataclass(frozen=True)
class Port:
    """One port over the turn: arrays over the cycle's shaft angles, SI, pressure gauge, flows out of the pump.

    pressure Pa; line_flow m3/s at that pressure; orifice_area m2 of the line, None without an orifice; power W, mean,
    into the line with its oil beyond that of the mean flow at the mean pressure; balance_error: oil of the port's
    volume not accounted for, of the oil through it in the time in which the port repeats.
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
    """The chambers' cycles and both ports, periodic together; `problems` are the chambers' with these pressures.

    problems, cycles: of one chamber for all, or of each of z. rounds of chambers and ports, 0 where both pressures
    are held; change: the last round's largest, Pa.
    """

    problems: tuple[ChamberProblem, ...]
    cycles: tuple[ChamberCycle, ...]
    delivery: Port
    suction: Port
    rounds: int
    change: float

    @property
    def problem(self) -> ChamberProblem:
        """The first chamber's problem, with the data common to all."""
        return self.problems[0]

    @cached_property
    def cycle(self) -> ChamberCycle:
        """The chambers' mean, each at its own angle."""
        return mean_of(self.cycles)


def ported_cycle(
    problems: Sequence[ChamberProblem],
    lines: Lines,
    pistons: int,
    samples: int,
    tolerance: float = TOLERANCE,
    draws: tuple[Array | float, Array | float] = (0.0, 0.0),
) -> PortedCycle:
    """The periodic revolution of a pump's chambers together with the volumes behind its ports.

    `problems`: one for all chambers, or one for each of z. They give the ports' mean pressures: held, met by an orifice
    of free area, or where an orifice of stated area begins its search. draws in m3/s at zero gauge pressure: the flow
    from delivery and suction port into films, a mean or over a pitch from shaft angle 0, (samples/pistons,); where
    chambers differ over the turn, (samples,). Raises NotConverged when ports and chambers do not agree within
    ROUND_LIMIT rounds, where a port cavitates, and as `solve_cycle`.
    """
    solved = _Solved.by(problems, samples, tolerance)
    repeats, problem = pistons if len(problems) == 1 else 1, problems[0]
    drawn = [np.broadcast_to(np.asarray(draw, dtype=float), samples // repeats) for draw in draws]
    sides = (
        _Side(lines.delivery, 0, problem.delivery_pressure, problem.delivery_port, drawn[0], pistons, repeats),
        _Side(lines.suction, 1, problem.inlet_pressure, problem.suction_port, drawn[1], pistons, repeats),
    )
    pressure = np.stack([side.first_pressure(solved) for side in sides])
    rounds, change = 0, 0.0
    if lines != Lines():
        solved, pressure, rounds, change = _agree(sides, pressure, solved, samples, tolerance)
    delivery, suction = (side.port(p, solved) for side, p in zip(sides, pressure, strict=True))
    return PortedCycle(solved.problems, solved.cycles, delivery, suction, rounds, change)


@dataclass(frozen=True)
class _Solved:
    """Chambers while the ports are sought: of one for all, or of each."""

    problems: tuple[ChamberProblem, ...]
    cycles: tuple[ChamberCycle, ...]

    @classmethod
    def by(cls, problems: Sequence[ChamberProblem], samples: int, tolerance: float) -> _Solved:
        """Problems with their cycles."""
        return cls(tuple(problems), tuple(solve_cycle(problem, samples, tolerance) for problem in problems))

    @property
    def oil(self) -> ChamberProblem:
        """The problem of the first chamber: ports and oil are the same for all."""
        return self.problems[0]


def _agree(
    sides: tuple[_Side, _Side], pressure: Array, solved: _Solved, samples: int, tolerance: float
) -> tuple[_Solved, Array, int, float]:
    """Rounds of chambers and ports from port pressures (2, M) until these repeat, as in `PortedCycle`."""
    history, limit = History(), SETTLED * tolerance * solved.oil.pressure_span
    for rounds in range(1, ROUND_LIMIT + 1):
        turn, pitch = np.tile(pressure, sides[0].repeats), samples // sides[0].pistons
        problems = [_with_ports(one, np.roll(turn, k * pitch, axis=1)) for k, one in enumerate(solved.problems)]
        solved = _Solved.by(problems, samples, tolerance)
        image = np.stack([side.better(p, solved) for side, p in zip(sides, pressure, strict=True)])
        change = float(np.max(np.abs(image - pressure)))
        if change <= limit:
            return solved, pressure, rounds, change
        pressure = history.extrapolate(pressure, image)
    for side, found in zip(sides, pressure, strict=True):
        side.hold_liquid(found)
    raise NotConverged(
        f"port pressures: after {ROUND_LIMIT} rounds of chambers and ports they still change by {change:.3g} Pa, "
        f"expected at most {limit:.3g} Pa; give a larger volume behind the port"
    )


@dataclass(frozen=True)
class _Side:
    """One port while it is sought.

    index 0 delivery, 1 suction; wanted: mean pressure Pa; repeats: times in a turn.
    """

    line: Line
    index: int
    wanted: float
    opening: PortOpening
    draw: Array
    pistons: int
    repeats: int

    def supply(self, solved: _Solved) -> Supply:
        """Oil from all chambers into this port until it repeats."""
        angle, speed = solved.cycles[0].shaft_angle, solved.oil.shaft_speed
        is_open = opening_area(self.opening, angle) > 0.0
        out = [(cycle.outflow.delivery, cycle.outflow.suction)[self.index] for cycle in solved.cycles]
        surge = over_chambers([cycle.surge[self.index] for cycle in solved.cycles], self.pistons)
        open_volume = np.mean([np.mean(cycle.volume * is_open) for cycle in solved.cycles])
        return Supply(
            period=TURN / (self.repeats * speed),
            mean=self.pistons * speed / TURN * float(np.mean(out)),
            surge=surge[: angle.size // self.repeats],
            draw=self.draw,
            open_volume=self.pistons * float(open_volume),
        )

    def first_pressure(self, solved: _Solved) -> Array:
        """The wanted pressure over time, or Bernoulli's for its flow through an orifice of stated area."""
        problem, first = solved.oil, self.wanted
        if isinstance(self.line, OrificeLine) and self.line.area is not None:
            flow = self.supply(solved).mean - float(np.mean(self.draw))
            speed = flow / (problem.flow_coefficient * self.line.area)
            first = self.line.tank_pressure + 0.5 * problem.density * speed * abs(speed)
        return np.full(self.draw.size, first)

    def better(self, pressure: Array, solved: _Solved) -> Array:
        """The next pressure over time."""
        if isinstance(self.line, HeldPressure):
            return pressure
        return port_balance(self.line, pressure, self.wanted, self.supply(solved), solved.oil).next_pressure

    def port(self, pressure: Array, solved: _Solved) -> Port:
        """The port as it was found; raises NotConverged where it cavitates."""
        self.hold_liquid(pressure)
        if isinstance(self.line, HeldPressure):
            return Port(np.tile(pressure, self.repeats), self._through(pressure[0], solved), None, 0.0, 0.0)
        problem, supply, modulus = solved.oil, self.supply(solved), solved.oil.bulk_modulus
        balance = port_balance(self.line, pressure, self.wanted, supply, problem)
        flow = balance.line.flow
        steady = float(np.mean(flow * np.exp(pressure / modulus))) * flow_energy(float(np.mean(pressure)), modulus)
        lost = float(np.max(np.abs(balance.rest))) + abs(balance.mean_rest) * supply.period
        return Port(
            pressure=np.tile(pressure, self.repeats),
            line_flow=np.tile(flow, self.repeats),
            orifice_area=balance.line.area,
            ripple_power=line_power(flow, pressure, problem) - float(steady),
            balance_error=lost / (abs(supply.mean) * supply.period),
        )

    def hold_liquid(self, pressure: Array) -> None:
        """Raise NotConverged where the port's oil would not stay liquid."""
        if pressure.min() < CAVITY_PRESSURE:
            name = ("delivery", "suction")[self.index]
            raise NotConverged(
                f"{name} port: its pressure falls to {pressure_text(pressure.min())}, expected liquid oil, above "
                f"{pressure_text(CAVITY_PRESSURE)}; give a larger volume, orifice or mean pressure"
            )

    def _through(self, pressure: float, solved: _Solved) -> Array:
        """Flow of all chambers through the port, m3/s at its pressure, less the draw of the films."""
        mass_flow = [
            (cycle.flow.delivery, cycle.flow.suction)[self.index]
            / bubbly_volume(np.maximum(cycle.pressure, CAVITY_PRESSURE), solved.oil)
            for cycle in solved.cycles
        ]
        taken = np.tile(self.draw, self.repeats)
        through = over_chambers(mass_flow, self.pistons) - taken
        return np.asarray(through * bubbly_volume(pressure, solved.oil))


def _with_ports(problem: ChamberProblem, pressure: Array) -> ChamberProblem:
    """The chamber with port pressures (2, N) over its own angle."""
    delivery, inlet = (float(mean) for mean in pressure.mean(axis=1))
    ports = PortPressure(pressure[0], pressure[1])
    return replace(problem, delivery_pressure=delivery, inlet_pressure=inlet, port_pressure=ports)
