"""The lumped fidelity: films of given thickness, leakage by Eqs. (15)-(17), REF90's nominal losses."""

from dataclasses import dataclass
from typing import Generic, Protocol

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.ports import PortsSection
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.pump.chamber.problem import Chamber, ChamberProblem, LeakTable
from system.pump.land_losses import land_losses, slipper_way
from system.pump.laws import friction_pairs as pairs
from system.pump.laws.friction_pairs import FrictionPairs, PairLoss
from system.pump.laws.kinematics import (
    Number,
    SwashDrive,
    ball_acceleration_along_bore,
    crossed_drive,
    drive_at_ratio,
    piston_displacement,
    piston_velocity,
    slipper_sliding_speed,
    stand_out,
)
from system.pump.laws.leakage import piston_conductance, piston_drag_flow, slipper_conductance, valve_plate_conductance
from system.pump.laws.retainer import BallGuide, mean_sliding_speed, spring_force
from system.pump.operating import OperatingPoint
from system.pump.ports.areas import PortOpening
from system.pump.ports.described import line_of, relief_groove
from system.pump.ports.flow_coefficients import FlowTable, port_table
from system.pump.ports.lines import Lines
from system.pump.ports.wear import AS_DRAWN, PortWear, worn_ports
from system.pump.ports.webs import PortWebs
from system.pump.shaft_torque import GroupMasses

SAMPLES_PER_PITCH = 40
"""Sampled shaft angles for each piston pitch: 1 deg on nine pistons; even, so the quadrature can be halved."""


@dataclass(frozen=True)
class PistonMotion(Generic[Number]):
    """One piston over N equidistant shaft angles, SI: drive, velocity, acceleration along the bore,
    slipper sliding speed, engaged length and overhang of the ball.

    PistonMotion[Array]: at P operating points, each over its N angles, (P, N).
    """

    drive: SwashDrive[Number]
    shaft_angle: Array
    velocity: Array
    acceleration: Array
    sliding_speed: Array
    engaged_length: Array
    overhang: Array


class Pressed(Protocol):
    """An object with the chamber's pressure (Pa gauge) over the motion's shaft angles."""

    @property
    def pressure(self) -> Array:
        """(N,), or (P, N) at P operating points."""


@dataclass(frozen=True)
class Pressures:
    """Chamber pressures (Pa gauge) without a cycle, (N,) or (P, N)."""

    pressure: Array


def port_lines(pump: PumpDescription, point: OperatingPoint) -> Lines:
    """Lines on the ports by [delivery_line] and [suction_line].

    A tank pressure left out is the inlet's: the low-pressure side of a circuit, or the tank of the inlet.
    """
    tank = point.inlet_pressure
    return Lines(delivery=line_of(pump.delivery_line, tank), suction=line_of(pump.suction_line, tank))


def group_masses(pump: PumpDescription) -> GroupMasses:
    """Masses of piston and slipper in the lumped fidelity: together at the ball."""
    return GroupMasses(pump.piston.mass, pump.slipper.mass)


def piston_area(pump: PumpDescription) -> float:
    """Cross section of a piston in m2."""
    return np.pi / 4.0 * pump.pump.piston_diameter**2


def full_drive(pump: PumpDescription) -> SwashDrive:
    """The pump's drive at its largest swash angle."""
    part = pump.pump
    return crossed_drive(part.pitch_radius, part.bore_cone_angle, part.swash_angle_max, part.cross_angle or 0.0)


def swept_displacement(pump: PumpDescription, drive: SwashDrive) -> float:
    """Swept displacement in m3 per revolution: the displacement by the geometry of pistons and ports without any loss.

    z (Ap + pi dp delta/2) (S at which the suction port shuts - S at which the delivery port shuts). Oil drawn in after
    the suction port shut returns through the delivery port, so less than the stroke counts (1.5 % on REF90); oil
    dragged in the piston gap moves as if the piston had the mean of its own and the bore's area (+ 2 delta/dp, 0.14 %).
    Toet's method on readings (`displacement`, ISO 8426-1) finds 0.4 % less on REF90: the loss by compression and
    commutation at every pressure in proportion to speed.
    """
    area = piston_area(pump) + np.pi * pump.pump.piston_diameter * pump.piston.radial_clearance / 2.0
    ports = port_openings(pump, drive.dead_centre_shift)
    shuts = np.array([port.dead_centre + port.shuts for port in ports])
    suction, delivery = piston_displacement(drive, shuts)
    return float(pump.pump.pistons * area * (suction - delivery))


def piston_stand_out(pump: PumpDescription, drive: SwashDrive[Number]) -> Number:
    """Length in m by which the piston is further out of its bore at inner dead centre than at full displacement.

    [piston] stand_out_share of (H_max - H)/2 (`kinematics.stand_out`): all of it where the plate pivots on the shaft
    axis, none where the inner dead centre stays; all of it by default.
    """
    share = pump.piston.stand_out_share
    return (1.0 if share is None else share) * stand_out(full_drive(pump), drive)


def piston_motion(
    pump: PumpDescription, point: OperatingPoint[Number], samples_per_pitch: int = SAMPLES_PER_PITCH
) -> PistonMotion[Number]:
    """Kinematics of one piston at the point's displacement ratio, at samples_per_pitch z shaft angles.

    By its way S and by `piston_stand_out` the engaged length is shorter and the ball's overhang longer.
    """
    drive = drive_at_ratio(full_drive(pump), point.displacement_ratio)
    samples = samples_per_pitch * pump.pump.pistons
    angle = TURN * np.arange(samples) / samples
    out = piston_stand_out(pump, drive) + piston_displacement(drive, angle)
    return PistonMotion(
        drive=drive,
        shaft_angle=angle,
        velocity=piston_velocity(drive, angle, point.shaft_speed),
        acceleration=ball_acceleration_along_bore(drive, angle, point.shaft_speed),
        sliding_speed=slipper_sliding_speed(drive, angle, point.shaft_speed),
        engaged_length=pump.piston.engaged_length - out,
        overhang=pump.piston.overhang + out,
    )


def lumped_leaks(pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number]) -> LeakTable:
    """Leakage of one chamber's gaps over shaft angle: paper Eqs. (15)-(17), viscosity at case temperature.

    With the losses of edges and of the slipper's bore in creeping flow by files (`land_losses`).
    """
    p, s, v, mu = pump.piston, pump.slipper, pump.valve_plate, point.viscosity
    losses = land_losses(pump)
    diameter = pump.pump.piston_diameter
    radii = (v.land_radius_1, v.land_radius_2, v.land_radius_3, v.land_radius_4)
    r1, r2, r3, r4 = (float(radius * v.sphere.stretch(radius)) for radius in radii)
    log_ratio, bore = slipper_way(s)
    slipper = slipper_conductance(log_ratio, s.film_thickness, s.orifice_diameter, bore, mu)
    extra_logs = losses.inner.extra_log, losses.outer.extra_log
    plate = valve_plate_conductance((r1, r2, r3, r4), v.film_thickness, pump.pump.pistons, mu, extra_logs)
    ones = np.ones_like(motion.shaft_angle)
    piston = piston_conductance(diameter, p.radial_clearance, motion.engaged_length, p.eccentricity_ratio, mu)
    dragged = piston_drag_flow(diameter, p.radial_clearance, motion.velocity)
    return LeakTable(
        conductance=np.stack([piston, slipper * ones, plate * ones], axis=-2),
        drag_flow=np.stack([dragged, 0.0 * dragged, 0.0 * dragged], axis=-2),
    )


def chamber_problem(
    pump: PumpDescription,
    point: OperatingPoint,
    motion: PistonMotion,
    leaks: LeakTable,
    wear: PortWear[float] = AS_DRAWN,
) -> ChamberProblem:
    """One chamber of the pump at the point with its ports, and with the leakage `leaks` of its gaps."""
    suction, delivery = port_openings(pump, motion.drive.dead_centre_shift, wear)
    one = chamber(pump, point, motion.drive)
    return ChamberProblem(**vars(one), delivery_port=delivery, suction_port=suction, leaks=leaks)


def chamber(pump: PumpDescription, point: OperatingPoint[Number], drive: SwashDrive[Number]) -> Chamber[Number]:
    """One chamber of the pump at the point; of N points, arrays (N,), N chambers."""
    area = piston_area(pump)
    return Chamber(
        drive=drive,
        shaft_speed=point.shaft_speed,
        piston_area=area,
        dead_volume=pump.pump.dead_volume + area * stand_out(full_drive(pump), drive),
        delivery_pressure=point.delivery_pressure,
        inlet_pressure=point.inlet_pressure,
        case_pressure=point.case_pressure,
        bulk_modulus=pump.oil.bulk_modulus,
        density=pump.oil.density,
        kinematic_viscosity=point.viscosity / pump.oil.density,
        flow_coefficient=pump.ports.flow_coefficient,
        critical_reynolds=pump.ports.critical_reynolds,
    )


def port_openings(
    pump: PumpDescription, shift: float = 0.0, wear: PortWear[float] = AS_DRAWN
) -> tuple[PortOpening, PortOpening]:
    """The valve plate's ports with their wear, suction from shaft angle 0 on and delivery from pi.

    With a cross angle both lie later by the drive's `dead_centre_shift`, `shift`: the plate's own dead centres.
    """
    suction, delivery = pump.ports.sides
    return worn_ports(_port_opening(pump, suction, shift), _port_opening(pump, delivery, np.pi + shift), wear)


def _port_opening(pump: PumpDescription, p: PortsSection, dead_centre: float) -> PortOpening:
    radius = pump.valve_plate.kidney_pitch_radius
    return PortOpening(
        dead_centre=dead_centre,
        kidney_start=p.groove_end,
        kidney_full_start=p.kidney_full_start,
        kidney_full_end=p.kidney_full_end,
        kidney_end=p.kidney_end,
        kidney_area=p.kidney_area,
        grooves=tuple(relief_groove(groove, p.kidney_full_end, radius) for groove in p.relief_grooves),
        webs=PortWebs(pump.valve_plate.kidney_arc, p.web_spans),
        coefficients=_coefficients(pump.ports, p),
    )


def _coefficients(ports: PortsSection, side: PortsSection) -> FlowTable:
    """Flow coefficients of one side, scaled by [ports] flow_coefficient; none without a file."""
    if ports.coefficient_file is None or side.coefficient_file is None:
        return FlowTable()
    return port_table(ports.coefficient_file, side.coefficient_file, ports.critical_reynolds)


def piston_forces(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], cycle: Pressed
) -> tuple[Array, Array]:
    """Force of one piston with its slipper along the bore and size of the swash plate's side force on it, in N."""
    mass = pump.piston.mass + pump.slipper.mass
    area = piston_area(pump)
    axial = pairs.axial_force(cycle.pressure, point.case_pressure, area, mass, motion.acceleration)
    return axial, pairs.side_force(axial, motion.drive.swash_angle)


def block_clamping(pump: PumpDescription, point: OperatingPoint[Number], cycle: Pressed) -> Array:
    """Normal force in N of the block's friction on the valve plate."""
    pressed = pairs.over_chambers([cycle.pressure - point.case_pressure], pump.pump.pistons)
    force = piston_area(pump) * pressed
    return pairs.clamping_force(force, pump.valve_plate.residual_clamping, block_spring(pump))


def lumped_pairs(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], cycle: Pressed
) -> FrictionPairs[Number]:
    """REF90's nominal losses of the seven pairs at the pressures of a cycle (sampled at the motion's angles)."""
    axial, side = piston_forces(pump, point, motion, cycle)
    side_sum = pairs.over_chambers([side], pump.pump.pistons)
    bearings, friction = pump.bearings, pump.friction
    front = pairs.bearing_coulomb(
        friction.front_bearing, bearings.front_share, side_sum, point.shaft_speed, bearings.front_diameter
    )
    rear = pairs.bearing_coulomb(
        friction.rear_bearing, bearings.rear_share, side_sum, point.shaft_speed, bearings.rear_diameter
    )
    none = np.zeros_like(axial)
    return FrictionPairs(
        piston_cylinder=_piston_cylinder(pump, point, motion, side),
        slipper_swash_plate=_slipper_swash_plate(pump, point, motion, axial),
        valve_plate_cylinder=_valve_plate_cylinder(pump, point, cycle),
        ball_guide_retainer=_ball_guide_retainer(pump, point, motion),
        piston_slipper_socket=_piston_slipper_socket(pump, point, motion, axial),
        front_bearing=PairLoss(1, front, none),
        rear_bearing=PairLoss(1, rear, none),
    )


def _piston_cylinder(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], side: Array
) -> PairLoss[Number]:
    length, velocity = motion.engaged_length, motion.velocity
    coulomb = pairs.piston_cylinder_coulomb(pump.friction.piston_cylinder, side, length, motion.overhang, velocity)
    viscous = pairs.piston_cylinder_shear(
        point.viscosity,
        pump.pump.piston_diameter,
        length,
        velocity,
        pump.piston.radial_clearance,
        pump.piston.eccentricity_ratio,
    )
    return PairLoss(pump.pump.pistons, coulomb, viscous)


def _slipper_swash_plate(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], axial: Array
) -> PairLoss[Number]:
    s, speed = pump.slipper, motion.sliding_speed
    coulomb = pairs.slipper_swash_plate_coulomb(
        pump.friction.slipper_swash_plate, axial, motion.drive.swash_angle, speed
    )
    viscous = pairs.slipper_swash_plate_shear(point.viscosity, s.lands.land_area, speed, s.film_thickness)
    return PairLoss(pump.pump.pistons, coulomb, viscous)


def _piston_slipper_socket(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number], axial: Array
) -> PairLoss[Number]:
    coulomb = pairs.piston_slipper_socket_coulomb(
        pump.friction.piston_slipper_socket,
        axial,
        motion.drive.swash_angle,
        pump.slipper.ball_joint_radius,
        point.shaft_speed,
    )
    return PairLoss(pump.pump.pistons, coulomb, np.zeros_like(axial))


def _valve_plate_cylinder(pump: PumpDescription, point: OperatingPoint[Number], cycle: Pressed) -> PairLoss[Number]:
    v, radius = pump.valve_plate, pump.valve_plate.kidney_pitch_radius
    clamping = block_clamping(pump, point, cycle)
    coulomb = pairs.valve_plate_coulomb(pump.friction.valve_plate_cylinder, clamping, point.shaft_speed, radius)
    radii = (v.land_radius_1, v.land_radius_2, v.land_radius_3, v.land_radius_4)
    shear = pairs.valve_plate_shear(point.viscosity, radii, point.shaft_speed, radius, v.film_thickness)
    for pads in v.bearing_pads:
        speed = point.shaft_speed * pads.mean_radius
        shear = shear + pairs.pads_shear(point.viscosity, pads.area, speed, v.film_thickness)
    return PairLoss(1, coulomb, np.full_like(coulomb, shear))


def _ball_guide_retainer(
    pump: PumpDescription, point: OperatingPoint[Number], motion: PistonMotion[Number]
) -> PairLoss[Number]:
    guide = BallGuide(pump.ball_guide.radius, pump.ball_guide.contact_latitude)
    speed = mean_sliding_speed(guide, motion.drive.swash_angle, point.shaft_speed)
    friction = pump.friction.ball_guide_retainer
    loss = pairs.ball_guide_coulomb(friction, block_spring(pump), guide.contact_latitude, speed)
    coulomb = loss * np.ones_like(motion.shaft_angle)
    return PairLoss(1, coulomb, np.zeros_like(coulomb))


def block_spring(pump: PumpDescription) -> float:
    """Force of the block spring in N, paper Eq. (13)."""
    guide = pump.ball_guide
    return spring_force(guide.spring_preload, guide.spring_stiffness, guide.spring_compression)
