"""The plant run at its points: flows, shaft torque, chamber pressure."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .byways import byways, meter
from .chamber_kernels import DELIVERY, GAMMA, PISTON, PLATE, SUCTION, density, turns
from .gaps import Films, films, sealing_length
from .hidden import NOTHING, Hidden
from .losses import Losses, losses
from .machine import Array, Machine
from .motion import Motion, full_stroke, motion, swash_at
from .settings import RATED_SPEED, Settings
from .suction_line import port_pressure

STEPS = 720
BEGIN = 0.5 * np.pi  # middle of the suction stroke, the port wide open
DISSOLVED = 8.0e6  # Pa at which no free air is left
WARM_ROUNDS = 3  # rounds between a film's loss and its warmth


@dataclass(frozen=True)
class Truth:
    """Flows at their own port's pressure (m3/s), torque (N m), (N,); angle (M,) and chamber pressure (N, M) Pa
    absolute, from wide-open suction on; losses of the pairs. drains: (N, 3), outflow through the gaps of pistons,
    slippers and plate alone.
    """

    Q_out: Array
    Q_in: Array
    Q_case: Array
    torque: Array
    angle: Array
    pressure: Array
    lost: Losses
    drains: Array | None = None

    @property
    def Q_piston(self) -> Array:
        """Leakage of the pistons, (N,)."""
        return self._drain(0)

    @property
    def Q_slipper(self) -> Array:
        """Leakage of the slippers, (N,)."""
        return self._drain(1)

    @property
    def Q_valve_plate(self) -> Array:
        """Leakage of the valve plate, (N,)."""
        return self._drain(2)

    def _drain(self, gap: int) -> Array:
        if self.drains is None:
            raise ValueError("this plant has one drain for all gaps")
        return self.drains[:, gap]

    @property
    def outputs(self) -> Array:
        """(N, 4) in the order Q_out, Q_in, Q_case, torque."""
        return np.stack([self.Q_out, self.Q_in, self.Q_case, self.torque], axis=1)


def run(machine: Machine, at: Settings, hidden: Hidden = NOTHING, steps: int = STEPS) -> Truth:
    """The steady state of the machine with its concealed effects."""
    at = replace(at, ratio=_drooped(hidden, at))
    angle = BEGIN + np.linspace(0.0, 2.0 * np.pi, steps + 1)
    stages = np.concatenate([[angle[0]], np.stack([angle[:-1] + GAMMA * np.diff(angle), angle[1:]], axis=1).ravel()])
    moves = [motion(machine, ratio, stages) for ratio in at.ratio]
    ends = [motion(machine, ratio, angle[1:]) for ratio in at.ratio]
    at = _behind_its_line(machine, hidden, at, angle, moves)
    warmer = np.zeros((3, at.speed.size))
    for _ in range(1 + WARM_ROUNDS * (hidden.film_heating != 0.0)):
        gaps = films(machine, hidden, at, warmer)
        pressure, out = _chambers(machine, hidden, at, angle, moves, gaps)
        lost = losses(machine, hidden, at, ends, gaps, pressure)
        warmer = _warmth(machine, hidden, at, gaps, lost, out, pressure)
    return _read(machine, hidden, at, angle, pressure, out, lost, gaps)


def _drooped(hidden: Hidden, at: Settings) -> Array:
    """The stroke under the plate's moment: its stop deflects by the same angle at every stroke."""
    return at.ratio - hidden.droop * at.p_out * (1.0 + 0.15 * at.speed / RATED_SPEED)


def _chambers(
    machine: Machine, hidden: Hidden, at: Settings, angle: Array, moves: list[Motion], gaps: Films
) -> tuple[Array, Array]:
    """Chamber pressure (N, M), mean of the pistons, and the outflow of a chamber in a turn (N, 5): kg by path, J."""
    kinds, points = len(machine.clearance), len(moves)
    courses = np.stack([_courses(machine, move, gaps.film[0][k]) for k, move in enumerate(moves)])
    states = np.stack([at.p_case, at.p_in, at.p_out, gaps.viscosity[1], gaps.top], axis=1)
    reach = (machine.port_angles[0] - hidden.erosion, *machine.port_angles[1:])
    wider = machine.groove * (1.0 + 4.0 * hidden.erosion)
    ports = np.array([*reach, wider, machine.kidney, machine.flow_coefficient, machine.critical_reynolds])
    pressure, out = np.zeros((points, kinds, angle.size - 1)), np.zeros((points, kinds, 5))
    turns(angle, courses, at.speed, states, ports, gaps.flow, _oil(machine, hidden), pressure, out)
    return pressure.mean(axis=1), out.mean(axis=1)


def _behind_its_line(machine: Machine, hidden: Hidden, at: Settings, angle: Array, moves: list[Motion]) -> Settings:
    """The points with the pressure at the port behind the inlet line."""
    if hidden.suction == 0.0:
        return at

    def drawn(points: NDArray[np.int64], pressure: Array) -> Array:
        own = replace(at.of(points), p_in=pressure)
        gaps = films(machine, hidden, own, np.zeros((3, points.size)))
        _, out = _chambers(machine, hidden, own, angle, [moves[k] for k in points], gaps)
        return _through_inlet(machine, hidden, own, out)

    return replace(at, p_in=port_pressure(hidden.suction, at, drawn))


def _through_inlet(machine: Machine, hidden: Hidden, at: Settings, out: Array) -> Array:
    """m3/s (N,) that chambers draw, at the inlet's pressure."""
    rate = machine.pistons * at.speed / (2.0 * np.pi) * out[:, SUCTION]
    return -rate / np.array([density(p, _oil(machine, hidden)) for p in at.p_in])


def _oil(machine: Machine, hidden: Hidden) -> tuple[float, float, float, float, float]:
    return machine.density, machine.bulk_modulus, hidden.stiffening, hidden.air, DISSOLVED


def _courses(machine: Machine, move: Motion, clearance: float) -> Array:
    """(P, 2 M + 1, 4) of `chamber_kernels.turn`, but dragged flow per rad/s, for each distinct piston."""
    stroke = full_stroke(machine, swash_at(machine, machine.stroke))
    own_stroke = full_stroke(machine, move.swash)
    volume = machine.dead_volume + machine.area * ((stroke - own_stroke) / 2.0 + move.travel)
    length = sealing_length(machine, move.travel, move.stand_out)
    rows = []
    for own in machine.clearance:
        half = 0.5 * np.pi * machine.diameter * own * clearance
        rows.append(np.stack([volume, (machine.area + half) * move.speed, length, half * move.speed], axis=1))
    return np.stack(rows)


def _warmth(
    machine: Machine, hidden: Hidden, at: Settings, gaps: Films, lost: Losses, out: Array, pressure: Array
) -> Array:
    """Kelvin (3, N) by which films are warmer than the case: their loss carried off by the oil through them."""
    if hidden.film_heating == 0.0:
        return np.zeros((3, at.speed.size))
    turn = at.speed / (2.0 * np.pi)
    through = [machine.pistons * np.abs(out[:, PISTON]) * turn]
    through += [_through(machine, at, gaps, part, pressure) for part in range(2)]
    inner, outer = machine.slipper_radii
    r1, r4 = machine.plate_radii[0], machine.plate_radii[3]
    swept = (
        np.zeros_like(turn),
        machine.pistons * gaps.film[1] * at.speed * machine.radius * (outer - inner),
        gaps.film[2] * at.speed * machine.plate_friction_radius * (r4 - r1),
    )
    rises = []
    for mass, drag, power in zip(through, swept, (lost.piston, lost.slipper, lost.plate), strict=True):
        carried = machine.specific_heat * (mass + machine.density * drag)
        rises.append(hidden.film_heating * power / carried)
    return np.stack(rises)


def _through(machine: Machine, at: Settings, gaps: Films, part: int, pressure: Array) -> Array:
    """kg/s (N,) through all slippers (part 0) or the plate (1), by the chamber's mean pressure over the turn."""
    above = np.maximum(pressure - at.p_case[:, None], 0.0)
    grid = np.linspace(0.0, gaps.top[0], gaps.parts.shape[2])
    mass = [np.mean(np.interp(above[k], grid, gaps.parts[k, part])) for k in range(len(above))]
    return machine.pistons * np.array(mass)


def _read(
    machine: Machine, hidden: Hidden, at: Settings, angle: Array, pressure: Array, out: Array, lost: Losses, gaps: Films
) -> Truth:
    oil = _oil(machine, hidden)
    rate = (machine.pistons * at.speed / (2.0 * np.pi))[:, None] * out
    dense = {name: np.array([density(p, oil) for p in getattr(at, name)]) for name in ("p_out", "p_case")}
    delivered, taken = rate[:, DELIVERY] / dense["p_out"], _through_inlet(machine, hidden, at, out)
    leaked = (rate[:, PISTON] + rate[:, PLATE]) / machine.density
    slippers = _through(machine, at, gaps, 0, pressure) / machine.density
    pistons, plate = rate[:, PISTON] / machine.density, rate[:, PLATE] / machine.density - slippers
    past = byways(machine, hidden, at, delivered)
    return Truth(
        Q_out=(delivered - past.across - past.delivery_to_case) * meter(hidden, at),
        Q_in=taken - past.across + past.inlet_to_case,
        Q_case=leaked + past.delivery_to_case + past.inlet_to_case,
        torque=(rate[:, 4] + lost.total) / at.speed + past.torque,
        angle=angle[1:], pressure=pressure, lost=lost, drains=np.stack([pistons, slippers, plate], axis=1),
    )  # fmt: skip
