"""Numbers of a varied pump that follow from the pressure in its chambers: peak, noise, cavity, moment, balance.

Flow ripple, rise of pressure and moment on the swash plate are the sources of noise that valve plates are optimised by
(Seeniraj and Ivantysynova 2006, "Impact of valve plate design on noise, volumetric efficiency and control effort in an
axial piston pump").
"""

from __future__ import annotations

from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.pump.assembly import PumpPoint
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.laws.friction_pairs import over_chambers
from system.pump.laws.kinematics import Number, SwashDrive, drive_at_ratio
from system.pump.lumped import full_drive, piston_area
from system.pump.operating import OperatingPoint

OF_PRESSURE = (
    "chamber_pressure_peak", "pressure_rate", "cavitated_share", "swash_moment.mean", "swash_moment.amplitude",
    "slipper_balance",
)  # fmt: skip
OF_FLOW = ("reverse_flow.delivery", "reverse_flow.inlet", "delivery_flow_ripple", "inlet_flow_ripple")


def pressure_numbers(pump: PumpDescription, point: OperatingPoint[Number], pressure: Array) -> dict[str, Any]:
    """Return the numbers OF_PRESSURE, SI, at one point with a chamber's pressure (M,) Pa, or (N,) at N with (N, M).

    point: of N points columns (N, 1). pressure_rate: root mean square over the turn, by differences of the sampled
    angles; cavitated_share: of the turn; amplitude of the moment: from the least to the largest.
    """
    drive = drive_at_ratio(full_drive(pump), point.displacement_ratio)
    angles = np.linspace(0.0, TURN, pressure.shape[-1], endpoint=False)
    moment = pressure_moment(drive, angles, piston_area(pump) * (pressure - point.case_pressure), pump.pump.pistons)
    step = np.roll(pressure, -1, axis=-1) - np.roll(pressure, 1, axis=-1)
    rate = point.shaft_speed * step / (2.0 * TURN / pressure.shape[-1])
    return {
        "chamber_pressure_peak": pressure.max(axis=-1),
        "pressure_rate": np.sqrt(np.mean(rate**2, axis=-1)),
        "cavitated_share": np.mean(pressure <= CAVITY_PRESSURE, axis=-1),
        "swash_moment.mean": moment.mean(axis=-1),
        "swash_moment.amplitude": np.ptp(moment, axis=-1),
        "slipper_balance": np.broadcast_to(slipper_balance(pump, drive), (*pressure.shape[:-1], 1))[..., 0],
    }


def pressure_moment(drive: SwashDrive[Number], shaft_angle: Array, force: Array, pistons: int) -> Array:
    """Return the moment (.., N) N m of the pistons' pressure forces (.., N) N about the axis that the plate swings by.

    By virtual work M = -sum F dl/dalpha, l = (R/cos beta) T/(1 + tan beta T) the way of a piston into the block from
    the plane of no displacement, T = tan(tilt) cos(phi), dT/dalpha = cos(phi - shift) + tan(tilt) cos(shift) T of a
    plate that swings with its cross angle. Positive: increases the swash angle, as in a transient. Without inertia and
    friction, which `forces.csv` of a run holds.
    """
    tilt, shift, cone = np.tan(drive.swash_angle), drive.dead_centre_shift, drive.bore_cone_angle
    slope = tilt * np.cos(shaft_angle)
    swing = np.cos(shaft_angle - shift) + tilt * np.cos(shift) * slope
    way = drive.pitch_radius / np.cos(cone) * swing / (1.0 + np.tan(cone) * slope) ** 2
    return -over_chambers([force * way], pistons)


def slipper_balance(pump: PumpDescription, drive: SwashDrive[Number]) -> Any:
    """Return the force of pocket and lands on a slipper over the pressure force that presses it on the plate.

    The pocket has p 6 d^4 ln(r2/r1)/(6 d^4 ln(r2/r1) + 128 h^3 l) behind its bore of diameter d and length l, laminar
    in both, at the film h that the file states (Eq. (16) of the paper, `slipper_conductance`).
    """
    own = pump.slipper
    lands, bore = (
        6.0 * own.orifice_diameter**4 * own.lands.log_ratio,
        128.0 * own.film_thickness**3 * own.orifice_length,
    )
    return lands / (lands + bore) * own.lands.effective_area * np.cos(drive.swash_angle) / piston_area(pump)


def flow_numbers(point: PumpPoint) -> dict[str, float]:
    """Return the numbers OF_FLOW of a point, m3/s, all chambers.

    reverse_flow: mean over the turn of what flows out of the delivery port into chambers, and out of chambers into the
    inlet, volume at chamber pressure; ripples: of the flow into the delivery line and out of the inlet line, from the
    least to the largest over the turn, volume at the port's pressure, as a run of the pump tells them.
    """
    flows = [one.flow for one in point.chambers]
    each = point.pistons / len(flows)
    return {
        "reverse_flow.delivery": each * sum(float(np.mean(np.maximum(-one.delivery, 0.0))) for one in flows),
        "reverse_flow.inlet": each * sum(float(np.mean(np.maximum(one.suction, 0.0))) for one in flows),
        "delivery_flow_ripple": float(np.ptp(point.delivery.line_flow)),
        "inlet_flow_ripple": float(np.ptp(point.suction.line_flow)),
    }
