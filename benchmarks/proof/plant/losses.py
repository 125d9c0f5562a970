"""Losses of the pump's pairs over a turn: friction, shear, and concealed effects in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .gaps import Films, sealing_length
from .hidden import Hidden
from .machine import Array, Machine
from .motion import Motion
from .settings import Settings

HERSEY = 1.5e-7  # mu v b/N at which contact bears half of its load at rest
CARREAU = 5.0e-6  # s
THINNING = 0.6  # Carreau's exponent


@dataclass(frozen=True)
class Losses:
    """Mean power in W, (N,): of all pistons, all slippers, the plate; and of parts without a film."""

    piston: Array
    slipper: Array
    plate: Array
    others: Array

    @property
    def total(self) -> Array:
        """All of them together."""
        return self.piston + self.slipper + self.plate + self.others


def losses(machine: Machine, hidden: Hidden, at: Settings, moves: list[Motion], gaps: Films, pressure: Array) -> Losses:
    """Losses at the chamber pressure (N, M), Pa absolute, over the angles of the motions."""
    rows = [_point(machine, hidden, at, moves[k], gaps, pressure[k], k) for k in range(len(moves))]
    return Losses(*np.array(rows).T)


def _point(
    machine: Machine, hidden: Hidden, at: Settings, move: Motion, gaps: Films, pressure: Array, k: int
) -> tuple[float, float, float, float]:
    omega, above = at.speed[k], pressure - at.p_case[k]
    axial = machine.area * above - machine.mass * move.acceleration * omega**2
    side, pressed = np.abs(axial) * np.tan(move.swash), np.abs(axial) / np.cos(move.swash)
    speed, sliding = np.abs(move.speed) * omega, move.sliding * omega
    piston = _piston(machine, hidden, move, gaps, (side, speed, above), k)
    slipper = _slipper(machine, hidden, gaps, (pressed, sliding, above), k)
    plate = _plate(machine, hidden, gaps, float(np.mean(above)), omega, k)
    others = _others(machine, move, side, pressed, omega)
    return float(np.mean(piston)) * machine.pistons, float(np.mean(slipper)) * machine.pistons, plate, others


def _piston(
    machine: Machine, hidden: Hidden, move: Motion, gaps: Films, drive: tuple[Array, Array, Array], k: int
) -> Array:
    side, speed, above = drive
    out = machine.stand_out_share * move.stand_out
    length = sealing_length(machine, move.travel, move.stand_out)
    normal = side * (length + 2.0 * (machine.overhang + move.travel + out)) / length
    film, viscosity = gaps.film[0][k], gaps.viscosity[0][k]
    askew = machine.eccentricity * (1.0 + machine.askew * np.linspace(-0.95, 0.95, 20))
    wetted = np.pi * machine.diameter * length * np.mean(1.0 / np.sqrt(1.0 - askew**2))
    shear = _shear(hidden, gaps, 0, k, above, speed) * viscosity * wetted * speed**2 / film
    contact = _contact(hidden, viscosity, speed, machine.diameter, normal)
    return np.asarray((machine.friction_piston + contact) * normal * speed + shear)


def _slipper(machine: Machine, hidden: Hidden, gaps: Films, drive: tuple[Array, Array, Array], k: int) -> Array:
    pressed, sliding, above = drive
    inner, outer = machine.slipper_radii
    film, viscosity = gaps.film[1][k], gaps.viscosity[1][k]
    area = np.pi * (outer**2 - inner**2)
    shear = _shear(hidden, gaps, 1, k, above, sliding) * viscosity * area * sliding**2 / film
    load = machine.slipper_residual * pressed
    dry = _contact(hidden, viscosity, sliding, 2.0 * outer, load) * load * sliding
    return np.asarray(machine.friction_slipper * pressed * sliding + shear + dry)


def _plate(machine: Machine, hidden: Hidden, gaps: Films, above: float, omega: float, k: int) -> float:
    r1, r2, r3, r4 = machine.plate_radii
    film, viscosity = gaps.film[2][k], gaps.viscosity[2][k]
    speed = np.array([omega * machine.plate_friction_radius])
    load = machine.plate_residual * machine.pistons * machine.area * above + machine.guide[2]
    area = np.pi * (r2**2 - r1**2 + r4**2 - r3**2)
    shear = _shear(hidden, gaps, 2, k, np.array([above]), speed) * viscosity * area * speed**2 / film
    contact = _contact(hidden, viscosity, speed, r4 - r1, np.array([load]))
    return float(((machine.friction_plate + contact) * load * speed + shear)[0])


def _others(machine: Machine, move: Motion, side: Array, pressed: Array, omega: float) -> float:
    """Ball joints, guide and retainer turning rigidly, shaft bearings."""
    joint = machine.friction_socket * pressed * machine.joint_radius * omega * np.sin(move.swash)
    radius, latitude, spring = machine.guide
    sin_g, rest = np.sin(move.swash), 1.0 - np.cos(move.swash)
    slip = radius * np.sqrt(2.0 * rest - (np.sin(latitude) * rest - np.cos(latitude) * np.cos(move.angle) * sin_g) ** 2)
    guide = machine.friction_guide * spring / np.sin(latitude) * float(np.mean(slip)) * omega
    force = machine.pistons * float(np.mean(side))
    turning = zip(
        (machine.friction_front, machine.friction_rear), machine.bearing_shares, machine.bearing_diameters, strict=True
    )
    bearings = sum(f * share * force * omega * diameter / 2.0 for f, share, diameter in turning)
    return machine.pistons * float(np.mean(joint)) + guide + bearings


def _shear(hidden: Hidden, gaps: Films, gap: int, k: int, above: Array, speed: Array) -> Array:
    """Factor on the shear of a film: thickened under pressure, thinned by rate after Carreau (1972)."""
    grid = np.linspace(0.0, gaps.top[k], gaps.drag.shape[2])
    rate = speed / gaps.film[gap][k]
    kept = (1.0 + (CARREAU * rate) ** 2) ** (0.5 * (THINNING - 1.0))
    thinned = 1.0 - hidden.shear_thinning * (1.0 - kept)
    return np.asarray(np.interp(np.maximum(above, 0.0), grid, gaps.drag[k, gap]) * thinned)


def _contact(hidden: Hidden, viscosity: float, speed: Array, width: float, load: Array) -> Array:
    """Coefficient that dry contact adds: f/(1 + (H/H0)^1.3), H = mu v b/N of the pair at that angle."""
    hersey = viscosity * speed * width / np.maximum(np.abs(load), 1.0)
    return np.asarray(hidden.mixed_friction / (1.0 + (hersey / HERSEY) ** 1.3))
