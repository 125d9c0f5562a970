"""Flows and torques outside the gaps: bypass flows, drag on the shaft, errors of the reading."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .hidden import Hidden
from .machine import Array, Machine, viscosity_at
from .motion import full_stroke
from .settings import RATED_SPEED, RPM, WARM, Settings


@dataclass(frozen=True)
class Byways:
    """From delivery to inlet, delivery to case, inlet to case (m3/s), and torque on the shaft (N m), (N,)."""

    across: Array
    delivery_to_case: Array
    inlet_to_case: Array
    torque: Array


def byways(machine: Machine, hidden: Hidden, at: Settings, flow: Array) -> Byways:
    """All of them at points where the pump itself delivers `flow` (N,) m3/s."""
    viscosity = viscosity_at(machine, at.T_case)
    return Byways(
        across=_short_circuit(machine, hidden, at, viscosity) + _cross_leak(hidden, at, viscosity)
        + hidden.seepage * np.maximum(at.p_out - 28.0e6, 0.0),
        delivery_to_case=_control(machine, hidden, at, viscosity),
        inlet_to_case=_squeezed(machine, hidden, at) + _lifted(machine, hidden, at, viscosity)[0]
        + hidden.windage * at.ratio**2 * (at.speed / RATED_SPEED) * np.sqrt(at.p_out / 20.0e6),
        torque=_drag(machine, hidden, at, viscosity, flow) + _strange(machine, hidden, at, viscosity)
        + _decompressed(machine, hidden, at) + _lifted(machine, hidden, at, viscosity)[1],
    )  # fmt: skip


def meter(hidden: Hidden, at: Settings) -> Array:
    """Factor on the delivery meter: a resonance of the line, a bell over speed that moves with the speed of sound."""
    centre = 1500.0 * RPM * (1.0 - 0.0025 * (at.T_case - WARM))
    return 1.0 + hidden.resonance * np.exp(-(((at.speed - centre) / (110.0 * RPM)) ** 2))


def _short_circuit(machine: Machine, hidden: Hidden, at: Settings, viscosity: Array) -> Array:
    """A worn edge: its discharge coefficient falls at small Reynolds number."""
    speed = np.sqrt(2.0 * (at.p_out - at.p_in) / machine.density)
    width = np.sqrt(4.0 * abs(hidden.short_circuit) / np.pi)
    reynolds = np.maximum(machine.density * speed * width / viscosity, 1e-9)
    return np.asarray(0.65 * hidden.short_circuit * speed / (1.0 + np.sqrt(30.0 / reynolds)))


def _cross_leak(hidden: Hidden, at: Settings, viscosity: Array) -> Array:
    """A slit whose walls deform a little."""
    drop = at.p_out - at.p_in
    return np.asarray(hidden.cross_leak * drop / viscosity * (1.0 + drop / 4.0e8))


def _control(machine: Machine, hidden: Hidden, at: Settings, viscosity: Array) -> Array:
    """A bleed of an annular slit ahead of an orifice: at 20 MPa and 25 mPa s each takes half of the drop."""
    area, drop = hidden.control_flow, at.p_out - at.p_case
    if area == 0.0:
        return np.zeros_like(drop)
    turbulent = machine.density / (2.0 * (0.62 * abs(area)) ** 2)
    reference = np.sqrt(10.0e6 / turbulent)
    laminar = 10.0e6 / reference * viscosity / 0.025
    return np.asarray(np.sign(area) * 2.0 * drop / (laminar + np.sqrt(laminar**2 + 4.0 * turbulent * drop)))


def _squeezed(machine: Machine, hidden: Hidden, at: Settings) -> Array:
    """Slippers that rise and settle once a turn, less under load."""
    area = machine.pistons * np.pi * machine.slipper_radii[1] ** 2
    return np.asarray(area * hidden.squeeze * at.speed / (2.0 * np.pi) / (1.0 + at.p_out / 120.0e6))


def _lifted(machine: Machine, hidden: Hidden, at: Settings, viscosity: Array) -> tuple[Array, Array]:
    """Slippers of the suction half that their own weight turns off the plate (m3/s into the case, N m less drag).

    .98 N m at 2100 rpm against chamber and retainer, 77 N on 8.4 mm; a share of them that grows with the ratio.
    """
    tips = 0.98 * (at.speed / RATED_SPEED) ** 2
    holds = np.maximum(machine.area * (at.p_in - at.p_case) + 77.0, 1.0) * 8.4e-3
    film = machine.slipper_film + hidden.lift / (1.0 + (holds / tips) ** 8)
    inner, outer = machine.slipper_radii
    bore, length = machine.orifice
    throttled = 128.0 * viscosity * length / (np.pi * bore**4)

    def through(gap: Array | float) -> Array:
        land = 6.0 * viscosity * np.log(outer / inner) / (np.pi * gap**3)
        return np.asarray(0.5 * machine.pistons * (at.p_in - at.p_case) / (land + throttled))

    half = 0.5 * machine.pistons * viscosity * np.pi * (outer**2 - inner**2) * at.speed * machine.radius**2
    return through(film) - through(machine.slipper_film), half * (1.0 / film - 1.0 / machine.slipper_film)


def _decompressed(machine: Machine, hidden: Hidden, at: Settings) -> Array:
    """Work that the dead volumes do not return (N m): oil stiffer under pressure, faster ports lose more."""
    stroke = full_stroke(machine, machine.swash)
    dead = machine.pistons * (machine.dead_volume + machine.area * stroke * (1.0 - at.ratio) / 2.0)
    held = dead * (at.p_out - at.p_in) ** 2 / (2.0 * (machine.bulk_modulus + 5.0 * at.p_out))
    return np.asarray(hidden.compression * (at.speed / RATED_SPEED) ** 0.15 * held / (2.0 * np.pi))


def _drag(machine: Machine, hidden: Hidden, at: Settings, viscosity: Array, flow: Array) -> Array:
    turned = at.speed / RATED_SPEED
    churning = hidden.churning * 1.46 * turned**1.8 * (viscosity / 0.0258) ** 0.2
    seal = hidden.seal * (1.0 + 0.3 * (at.p_case / 0.15e6 - 1.0) + 0.05 * np.log(turned))
    charge = hidden.charge_pump * (at.p_in - at.p_case) / (2.0 * np.pi) / 0.85
    swept = flow / at.speed
    throttled = hidden.throttling * 0.1e6 * (np.maximum(flow, 0.0) / (188.7e-3 / 60.0)) ** 1.75 * swept
    return np.asarray(churning + seal + charge + throttled)


def _strange(machine: Machine, hidden: Hidden, at: Settings, viscosity: Array) -> Array:
    """Torque of effects in no catalogue: N m at 2100 rpm, 20 MPa, 50 degC in the case."""
    turned, thick = at.speed / RATED_SPEED, viscosity / 0.0258
    root = hidden.root_drag * np.sqrt(at.p_out / 20.0e6) * thick * turned
    foam = hidden.foam * turned**3 * 0.15e6 / at.p_case
    whirl = hidden.whirl * np.sin(2.0 * np.pi * at.speed / (700.0 * RPM))
    cold = hidden.cold_seal * np.exp(-(at.T_case - WARM) / 8.0) * (at.p_out / 20.0e6)
    return np.asarray(root + foam + whirl + cold)
