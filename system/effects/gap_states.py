"""The three gaps over the turn at points of a bench map, as inputs of the laws of effects."""

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.effect import BenchState, GapCourse, Value
from system.effects.state import GAPS
from system.pump.laws import friction_pairs as pairs
from system.pump.laws.friction_pairs import FrictionPairs
from system.pump.lumped import PistonMotion, Pressed, block_clamping, lumped_leaks, piston_forces
from system.pump.operating import OperatingPoint, flat


def gap_courses(
    pump: PumpDescription,
    point: OperatingPoint[Array],
    motion: PistonMotion[Array],
    cycle: Pressed,
    losses: FrictionPairs[Array],
) -> dict[Gap, GapCourse]:
    """Films of given thickness at N points with their losses before any change by laws.

    The normal force is the pairs' Coulomb loss at a coefficient and a speed of one.
    """
    axial, side = piston_forces(pump, point, motion, cycle)
    ones = np.ones_like(axial)
    lengths = motion.engaged_length
    plate = pump.valve_plate
    inner, outer = plate.land_radius_1, plate.land_radius_4
    lands = np.pi * (plate.land_radius_2**2 - inner**2 + outer**2 - plate.land_radius_3**2)
    above = cycle.pressure - point.case_pressure
    leakage = lumped_leaks(pump, point, motion).conductance * above[:, None, :]
    leakage[:, GAPS.index(Gap.VALVE_PLATE)] *= pump.pump.pistons
    found = {
        Gap.PISTON: (
            np.abs(motion.velocity),
            pump.piston.radial_clearance,
            pairs.piston_cylinder_coulomb(1.0, side, lengths, motion.overhang, ones),
            losses.piston_cylinder,
            np.pi * pump.pump.piston_diameter * np.ones(len(axial)),
            np.pi * pump.pump.piston_diameter * lengths.mean(axis=1),
        ),
        Gap.SLIPPER: (
            motion.sliding_speed,
            pump.slipper.film_thickness,
            pairs.slipper_swash_plate_coulomb(1.0, axial, motion.drive.swash_angle, ones),
            losses.slipper_swash_plate,
            np.full(len(axial), 2.0 * pump.slipper.land_outer_radius),
            np.full(len(axial), pump.slipper.lands.land_area),
        ),
        Gap.VALVE_PLATE: (
            point.shaft_speed * plate.kidney_pitch_radius * ones,
            plate.film_thickness,
            np.abs(block_clamping(pump, point, cycle)),
            losses.valve_plate_cylinder,
            np.full(len(axial), plate.land_radius_4 - inner),
            np.full(len(axial), lands + sum(pads.area for pads in plate.bearing_pads)),
        ),
    }
    return {
        gap: GapCourse(
            pressure=above,
            sliding_speed=speed * ones,
            film=film * ones,
            normal_force=force,
            coulomb=loss.coulomb * ones,
            viscous=loss.viscous * ones,
            leakage=leakage[:, GAPS.index(gap)],
            width=width,
            land_area=area,
        )
        for gap, (speed, film, force, loss, width, area) in found.items()
    }


def bench_state(pump: PumpDescription, point: OperatingPoint[Value], hours: Value) -> BenchState[Value]:
    """N points, given as columns (N, 1), and the hours (N,) run until then, as inputs of laws; or one point."""
    at = flat(point)
    return BenchState(
        speed=at.shaft_speed,
        displacement_ratio=at.displacement_ratio,
        delivery_pressure=at.delivery_pressure,
        inlet_pressure=at.inlet_pressure,
        case_pressure=at.case_pressure,
        viscosity=at.viscosity,
        temperature=at.temperature,
        hours=hours,
        geometry=pump,
    )
