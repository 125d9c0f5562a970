"""Initial data of a compiled transient: its constants, and oil at rest in chambers and actuator."""

from dataclasses import replace

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import TURN, Dimension, format_quantity
from system.multibody.kinematics import BoreCircle, Plate, axial_rates
from system.multibody.plate_motion import Actuator, Mechanism
from system.multibody.transient.kernels import PLATE, actuator_at
from system.pump.chamber.layout import CAVITY_PRESSURE, WAYS
from system.pump.chamber.problem import ChamberProblem
from system.pump.chamber.setup import ported_record
from system.pump.chamber.state_kernels import oil_of, oil_volume
from system.pump.laws import friction_pairs as pairs
from system.pump.laws.leakage import piston_conductance, piston_drag_flow
from system.pump.lumped import chamber_problem, full_drive, lumped_leaks, piston_area, piston_motion, port_openings
from system.pump.operating import OperatingPoint

USUAL_STEP = np.radians(0.5)
SHARE_OF_SWING = 0.5
"""Largest step times the plate's natural frequency: Verlet's rule is stable up to 2."""
FADING = 1e-3
"""Sliding of a piston, of the balls' speed on their circle, below which its Coulomb friction fades."""
TRUNNION_FADING = 0.05
"""The same of the plate in its trunnion, rad/s: it creeps rather than sticks."""


def bore_circle(pump: PumpDescription, parts: Mechanism) -> BoreCircle:
    """Circle of the bores under the plate, shaft angles from its own axis."""
    part = pump.pump
    return BoreCircle(part.pitch_radius, part.bore_cone_angle, part.cross_angle or 0.0, parts.plate.pivot_offset)


def inner_place(pump: PumpDescription, parts: Mechanism) -> float:
    """Place (m) along its bore of a ball at the inner dead centre of the largest angle."""
    shift = np.array([-full_drive(pump).dead_centre_shift])
    return float(axial_rates(bore_circle(pump, parts), Plate(parts.plate.angle_max), shift).place[0])


def plate_problem(pump: PumpDescription, point: OperatingPoint) -> ChamberProblem:
    """A chamber at full displacement, its ports counted from the plate's own axis."""
    at_full = replace(point, displacement_ratio=1.0)
    motion = piston_motion(pump, at_full)
    suction, delivery = port_openings(pump)
    found = chamber_problem(pump, at_full, motion, lumped_leaks(pump, at_full, motion))
    return replace(found, suction_port=suction, delivery_port=delivery)


def chamber_pair(acting: ChamberProblem, plain: ChamberProblem) -> np.ndarray:
    """Records (2,) that `kernels` reads: a chamber after effects, and the oil of the actuator."""
    return np.concatenate([ported_record(acting), ported_record(plain)])


def plate_record(pump: PumpDescription, point: OperatingPoint, parts: Mechanism, step: float) -> np.ndarray:
    """The constants that `transient_kernels` reads, steps of `step` s."""
    plate, circle = parts.plate, bore_circle(pump, parts)
    values = {
        "pistons": pump.pump.pistons,
        "pitch_radius": circle.pitch_radius,
        "cone": circle.cone,
        "cross": circle.cross,
        "pivot_offset": circle.pivot_offset,
        "inner_place": inner_place(pump, parts),
        "angle_min": plate.angle_min,
        "angle_max": plate.angle_max,
        "inertia": plate.inertia,
        "damping": plate.damping,
        "rubbing": plate.rubbing,
        "rubbing_rate": max(TRUNNION_FADING, 2.0 * step * plate.rubbing / plate.inertia),
        "slide": FADING * point.shaft_speed * circle.pitch_radius,
    }
    found = np.zeros(1, dtype=PLATE)
    for name, value in (values | _piston_values(pump, point) | _actuator_values(parts.actuator)).items():
        found[name] = value
    return found


def _piston_values(pump: PumpDescription, point: OperatingPoint) -> dict[str, float]:
    """Pistons and leaks, those that depend on the tilt per length or speed."""
    piston, diameter, viscosity = pump.piston, pump.pump.piston_diameter, point.viscosity
    clearance, eccentricity, one = piston.radial_clearance, piston.eccentricity_ratio, np.ones(1)
    at_full = replace(point, displacement_ratio=1.0)
    leaks = lumped_leaks(pump, at_full, piston_motion(pump, at_full)).conductance
    shear = pairs.piston_cylinder_shear(viscosity, diameter, one, one, clearance, eccentricity)
    return {
        "mass": piston.mass + pump.slipper.mass,
        "engaged_length": piston.engaged_length,
        "overhang": piston.overhang,
        "friction": pump.friction.piston_cylinder,
        "shear": float(shear[0]),
        "piston_leak": float(piston_conductance(diameter, clearance, 1.0, eccentricity, viscosity)),
        "slipper_leak": float(leaks[1, 0]),
        "ring_leak": float(leaks[2, 0]),
        "drag_area": float(piston_drag_flow(diameter, clearance, 1.0)),
    }


def _actuator_values(actuator: Actuator) -> dict[str, float]:
    return {
        "sense": actuator.sense,
        "arm": actuator.arm,
        "actuator_area": actuator.area,
        "actuator_volume": actuator.dead_volume,
        "actuator_orifice": actuator.orifice_area,
        "actuator_leak": actuator.leakage,
        "spring_rate": actuator.spring_rate,
        "spring_force": actuator.spring_force,
    }


def start_states(
    pump: PumpDescription, parts: Mechanism, records: tuple[np.ndarray, np.ndarray], angle: float, droop: float,
    pressure: Array, control: float,
) -> Array:  # fmt: skip
    """Mass (m3) and pressure (Pa) of each chamber and, last, of the actuator, at shaft angle 0 and a tilt (rad).

    records: `chamber_pair` and the plate's; droop rad, by which the plate tilts less under the pistons; pressure (z,)
    Pa of the chambers, no less than in a cavity.
    """
    chambers, plate = records
    own = TURN * np.arange(pump.pump.pistons) / pump.pump.pistons
    place = axial_rates(bore_circle(pump, parts), Plate(angle - droop), own).place - inner_place(pump, parts)
    content = pump.pump.dead_volume + piston_area(pump) * place
    reach, _ = actuator_at(chambers[1:], plate, angle, 0.0, control, np.zeros(WAYS))
    oils = [oil_of(chambers[:1])] * own.size + [oil_of(chambers[1:])]
    contents, pressures = np.append(content, reach), np.append(np.maximum(pressure, CAVITY_PRESSURE), control)
    specific = np.array([oil_volume(float(one), oil)[0] for one, oil in zip(pressures, oils, strict=True)])
    return np.ascontiguousarray(np.stack([contents / specific, pressures], axis=1))


def natural_frequency(pump: PumpDescription, parts: Mechanism, angle: float) -> float:
    """Of the plate on the oil in its actuator and in two shut chambers at their dead centres, rad/s."""
    plate, actuator, bulk = parts.plate, parts.actuator, pump.oil.bulk_modulus
    lever = actuator.area * actuator.arm * np.cos(angle)
    least = actuator.dead_volume
    own = TURN * np.arange(pump.pump.pistons) / pump.pump.pistons
    rates = axial_rates(bore_circle(pump, parts), Plate(angle), own)
    shut = 2.0 * (piston_area(pump) * float(np.max(np.abs(rates.tilt)))) ** 2 / pump.pump.dead_volume
    mass = pump.piston.mass + pump.slipper.mass
    turned = plate.inertia + mass * float(np.sum(rates.tilt**2))
    return float(np.sqrt(bulk * (lever**2 / least + shut) / turned))


def steps_a_pitch(asked: float | None, shaft_speed: float, pistons: int, swing: float, parts: Mechanism) -> int:
    """Steps in a piston pitch: of about `asked` rad each, or of USUAL_STEP and no more than the plate allows.

    Raises InputError for a step that is too long for a plate that swings by `swing` (rad/s).
    """
    longest = SHARE_OF_SWING / (swing + parts.plate.damping / parts.plate.inertia) * shaft_speed
    pitch = TURN / pistons
    if asked is None:
        return max(1, int(np.ceil(pitch / min(USUAL_STEP, longest))))
    if asked > longest:
        limit, shown = (format_quantity(one, Dimension.ANGLE, digits=3) for one in (longest, asked))
        found = f"{shown}, with a plate that swings at {swing / TURN:.0f} Hz on its oil"
        raise InputError("transient.step", found, f"at most {limit} of shaft angle")
    return max(1, round(pitch / asked))
