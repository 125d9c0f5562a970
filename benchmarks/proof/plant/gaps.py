"""Flow through the three gaps as tables over pressure, integrated along the film with the laws of oil and walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .hidden import Hidden
from .machine import Array, Machine, viscosity_at
from .settings import RATED_SPEED, WARM, Settings

NODES = 161
STIFF = 1.5e8  # Pa at which a wall has become twice as stiff
ROELANDS = 5.1e-9  # 1/Pa
ROUND = 36  # places round the piston
ALONG = 12  # and along it


@dataclass(frozen=True)
class Films:
    """The gaps of N points in the order piston, slipper, plate: film (m), viscosity (Pa s) without pressure, (N,).

    flow: (N, P, 2, S) tables for the chamber, mass flow over the pressure above the case: the pistons' times the
    sealing length, and that of slipper and plate; parts: (N, 2, S) of slipper and plate alone, kg/s; drag:
    (N, 3, S) shear under pressure over that without; top: (N,) Pa, the end of the tables.
    """

    top: Array
    film: tuple[Array, Array, Array]
    viscosity: tuple[Array, Array, Array]
    flow: Array
    parts: Array
    drag: Array


def films(machine: Machine, hidden: Hidden, at: Settings, warmer: Array) -> Films:
    """The gaps with oil `warmer` (3, N) K than the case."""
    top = 1.5 * at.p_out.max() + 1.0e6
    pressure = np.linspace(0.0, top, NODES)
    stated = (machine.piston_film, machine.slipper_film, machine.plate_film)
    openings = (hidden.opening_piston, hidden.opening_slipper, hidden.opening_plate)
    warmth = (hidden.thermal_piston, hidden.thermal_slipper, hidden.thermal_plate)
    change = at.T_case - WARM
    late = change / (1.0 + np.abs(change) / 80.0)
    first, second, third = (h * (1.0 + rate * late) for h, rate in zip(stated, warmth, strict=True))
    film = (first * (1.0 + hidden.spin_leak * (at.speed / RATED_SPEED) ** 2), second, third)
    own = [viscosity_at(machine, at.T_case + rise) for rise in warmer]
    viscosity = (own[0], own[1], own[2])
    slope = [_slope(machine, hidden, mu, pressure, c) for mu, c in zip(viscosity, openings, strict=True)]
    carried = [_integral(each[0], pressure) for each in slope]
    drag = np.stack([_mean(each[1], pressure) for each in slope], axis=1)
    bore = np.stack([_bore(machine, film[0], clearance) for clearance in machine.clearance], axis=1)
    piston = bore[:, :, None] * carried[0][:, None, :]
    slipper = _slipper(machine, film[1], viscosity[1], carried[1], pressure)
    plate = _plate(machine, film[2])[:, None] * carried[2]
    shared = np.broadcast_to((slipper + plate)[:, None, :], piston.shape)
    flow = np.ascontiguousarray(np.stack([piston, shared], axis=2))
    parts = np.stack([slipper, plate], axis=1)
    return Films(np.full(at.speed.size, top), film, viscosity, flow, parts, drag)


def roelands(hidden: Hidden, viscosity: Array, pressure: Array) -> Array:
    """Viscosity under pressure (Pa) over that without, (N, S): Roelands (1966), by its slope at no pressure."""
    level = np.log(viscosity)[:, None] + 9.67
    exponent = hidden.viscosity_pressure / (ROELANDS * level)
    return np.asarray(np.exp(level * ((1.0 + ROELANDS * pressure) ** exponent - 1.0)))


def sealing_length(machine: Machine, travel: Array, stand_out: float) -> Array:
    """Engaged length of the film in m: the bushing less the piston's travel out of it."""
    return machine.engaged - travel - machine.stand_out_share * stand_out


def _slope(machine: Machine, hidden: Hidden, viscosity: Array, pressure: Array, opening: float) -> tuple[Array, Array]:
    """rho (h/h0)^3/mu and (mu/mu0)(h0/h) at each pressure, (N, S)."""
    thicker = roelands(hidden, viscosity, pressure)
    wider = 1.0 + opening * pressure / (1.0 + pressure / STIFF)
    dense = machine.density * np.exp(pressure / machine.bulk_modulus)
    return dense * wider**3 / (viscosity[:, None] * thicker), thicker / wider


def _integral(values: Array, pressure: Array) -> Array:
    """From 0 to each pressure, by the trapezoidal rule."""
    pieces = 0.5 * np.diff(pressure) * (values[:, 1:] + values[:, :-1])
    return np.concatenate([np.zeros((len(values), 1)), np.cumsum(pieces, axis=1)], axis=1)


def _mean(values: Array, pressure: Array) -> Array:
    total = _integral(values, pressure)
    total[:, 1:] /= pressure[1:]
    total[:, 0] = values[:, 0]
    return total


def _bore(machine: Machine, clearance: Array, own: float) -> Array:
    """pi d h^3/12 of a piston tilted in its bore, its slices in series: (N,)."""
    place = (np.arange(ALONG) + 0.5) / ALONG
    off = machine.eccentricity * (1.0 + machine.askew * (2.0 * place - 1.0))
    turned = 2.0 * np.pi * (np.arange(ROUND) + 0.5) / ROUND
    cube = np.mean((1.0 - off[:, None] * np.cos(turned)) ** 3, axis=1)
    return np.pi * machine.diameter / 12.0 * (own * clearance) ** 3 / np.mean(1.0 / cube)


def _slipper(machine: Machine, film: Array, viscosity: Array, carried: Array, pressure: Array) -> Array:
    """Mass flow of one slipper (N, S): driven through the land by the pressure behind its orifice with entry loss."""
    inner, outer = machine.slipper_radii
    land = 2.0 * np.pi * film**3 / (12.0 * np.log(outer / inner))
    bore, length = machine.orifice
    throat = 0.25 * np.pi * bore**2
    pocket = np.broadcast_to(pressure, carried.shape)
    for _ in range(4):
        driven = [np.interp(p, pressure, row) for p, row in zip(pocket, carried, strict=True)]
        mass = land[:, None] * np.stack(driven)
        flow = mass / machine.density
        lost = 128.0 * viscosity[:, None] * length * flow / (np.pi * bore**4)
        pocket = np.maximum(pressure - lost - 1.5 * machine.density / 2.0 * (flow / throat) ** 2, 0.0)
    return np.asarray(mass)


def _plate(machine: Machine, film: Array) -> Array:
    """h^3/12 times one pitch of both sealing rings, by rings of the land in series: (N,)."""
    r1, r2, r3, r4 = machine.plate_radii
    pitch = 2.0 * np.pi / machine.pistons

    def ring(low: float, high: float) -> float:
        edges = np.linspace(low, high, 41)
        return float(1.0 / np.sum(np.diff(edges) / (0.5 * (edges[1:] + edges[:-1]))))

    return np.asarray(film**3 / 12.0 * pitch * (ring(r1, r2) + ring(r3, r4)))
