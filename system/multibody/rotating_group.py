"""Forces between all parts of the rotating group over a turn: the paper's virtual prototype, in closed form.

Motion is prescribed by shaft angle and swash angle, pressures and friction are those of an operating point, so
every joint follows from the balance of one body after the other: slipper and piston (`joints`), retainer and
ball guide (`retainer_body`), block, shaft and swash plate (`shaft_body`). Pump frame of
`system.pump.laws.directions`. The plate pivots where the plane of the ball centres cuts the shaft. Chambers that
differ have each its own pressure and masses, and the mean friction of all.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.multibody.joints import Levers, SetForces, SetLoads, set_forces, wrench
from system.multibody.kinematics import SHAFT, BallMotion, Plate, ball_motion, circle_of, swash_angle
from system.multibody.places import GroupPlaces, group_places
from system.multibody.retainer import GuideContact, Hold, guide_contact, hold
from system.multibody.shaft import (
    BlockReactions,
    PlateReactions,
    ShaftDrag,
    ShaftReactions,
    block_reactions,
    plate_reactions,
    shaft_reactions,
)
from system.pump.assembly import PumpPoint
from system.pump.chamber_kinds import kinds
from system.pump.laws.directions import plate_axes
from system.pump.laws.friction_pairs import Pair, over_chambers
from system.pump.laws.kinematics import SwashDrive, displacement, drive_at_ratio, piston_acceleration, stroke
from system.pump.laws.retainer import BallGuide
from system.pump.lumped import block_spring, chamber_problem, full_drive, group_masses, piston_area, piston_motion
from system.pump.operating import OperatingPoint
from system.pump.shaft_torque import GroupMasses, forces_by_loss


@dataclass(frozen=True)
class TurningGroup:
    """The group of a pump in motion at N shaft angles (rad): drive, places of its joints, plate_axes (3, 3),
    motion of a ball over its own angle, places in the pump; spring N."""

    pump: PumpDescription
    point: OperatingPoint
    drive: SwashDrive
    shaft_angle: Array
    places: GroupPlaces
    plate_axes: Array
    ball: BallMotion
    spring: float

    @property
    def pistons(self) -> int:
        """Number of pistons."""
        return self.pump.pump.pistons

    @property
    def tilt_axis(self) -> Array:
        """Unit vector (3,) about which the plate swings; with a cross angle not square to the dead centres."""
        shift = float(self.drive.dead_centre_shift)
        return np.array([-np.sin(shift), np.cos(shift), 0.0])

    def whole(self, of_chambers: Sequence[Array]) -> Array:
        """The sum (.., N) over all chambers at each shaft angle, of one for all or of each."""
        return over_chambers(of_chambers, self.pistons)


@dataclass(frozen=True)
class ChamberLoads:
    """Of one chamber: masses kg of piston and slipper, levers in the bore, known forces."""

    masses: GroupMasses
    levers: Levers
    known: SetLoads


@dataclass(frozen=True)
class JointForces:
    """All joints at N shaft angles, vectors (3, N) in N and wrenches (6, N) about the pump's origin.

    loads, sets: of each chamber over its own angle, of one where chambers are equal. hold: of the retainer on a slipper
    over its own angle; guide: of the ball guide on the retainer; guide_spline: of the shaft on the ball guide.
    """

    group: TurningGroup
    loads: tuple[ChamberLoads, ...]
    sets: tuple[SetForces, ...]
    hold: Hold
    guide: GuideContact
    drag: ShaftDrag
    guide_spline: Array
    block: BlockReactions
    shaft: ShaftReactions
    plate: PlateReactions


def joint_forces(pump: PumpDescription, found: PumpPoint) -> JointForces:
    """The forces between all parts at an operating point, with friction from the losses.

    A loss at a sliding speed is a force loss/speed (`shaft_torque.forces_by_loss`). Torques of [physics] effects on the
    shaft outside the pairs are no joint of the group and are not included.
    """
    full = full_drive(pump)
    ratio = found.geometric_displacement / displacement(pump.pump.pistons, piston_area(pump), stroke(full))
    group = turning_group(pump, replace(found.point, displacement_ratio=ratio))  # effects may have changed it
    return joined(group, _loads_by_loss(group, found), found)


def joined(group: TurningGroup, loads: Sequence[ChamberLoads], found: PumpPoint) -> JointForces:
    """The forces between all parts from known forces on pistons and slippers, of one chamber for all or of each.

    Friction about the shaft is that of the point's losses.
    """
    sets, held, guide = _held_sets(group, loads, found.pairs.ball_guide_retainer.mean)
    drag = _shaft_drag(found)
    spline = _guide_spline(group, guide)
    block = block_reactions(_on_block(group, loads, sets), group.places, drag)
    on_shaft = -block.spline - spline
    if not group.places.retained:
        on_shaft = on_shaft + wrench(group.spring * SHAFT, np.zeros((3, 1)))
    on_plate = -group.whole([wrench(one.plate, group.ball.place, one.plate_moment) for one in sets])
    shaft = shaft_reactions(on_shaft, group.places, drag)
    plate = plate_reactions(on_plate, group.places, group.tilt_axis, swash_angle(group.drive))
    return JointForces(group, tuple(loads), sets, held, guide, drag, spline, block, shaft, plate)


def turning_group(pump: PumpDescription, point: OperatingPoint) -> TurningGroup:
    """The group at an operating point, over the shaft angles that the lumped fidelity samples."""
    drive, places = drive_at_ratio(full_drive(pump), point.displacement_ratio), group_places(pump)
    angle = piston_motion(pump, point).shaft_angle
    ball = ball_motion(circle_of(drive), Plate(drive.swash_angle), angle, point.shaft_speed)
    lifted = replace(ball, place=ball.place + places.pivot * SHAFT)
    return TurningGroup(pump, point, drive, angle, places, plate_axes(drive), lifted, block_spring(pump))


def _loads_by_loss(group: TurningGroup, found: PumpPoint) -> tuple[ChamberLoads, ...]:
    pump, point = group.pump, group.point
    motion = piston_motion(pump, point)
    problem = chamber_problem(pump, point, motion, found.leaks)
    rubbing = forces_by_loss(problem, found.cycle, found.pairs, group_masses(pump))
    in_plate = np.tensordot(group.plate_axes[:2].T, rubbing.on_slipper, axes=1)
    joint = rubbing.joint * SHAFT
    of, loads = kinds(pump), []
    for own, cycle in zip(of.by_chamber(of.pumps), found.chambers, strict=True):
        pushed = rubbing.along_bore + piston_area(pump) * (cycle.pressure - found.cycle.pressure)
        loads.append(ChamberLoads(group_masses(own), levers(own, point), SetLoads(pushed, in_plate, joint)))
    return tuple(loads)


def levers(pump: PumpDescription, point: OperatingPoint) -> Levers:
    """Levers of a piston in its bore over the turn: the guiding land is no longer than the engaged length."""
    motion = piston_motion(pump, point)
    land = np.inf if pump.piston.guide_length is None else pump.piston.guide_length
    return Levers(motion.overhang, np.minimum(motion.engaged_length, land), pump.slipper.centre_of_mass_to_ball)


def _held_sets(
    group: TurningGroup, loads: Sequence[ChamberLoads], guide_loss: float
) -> tuple[tuple[SetForces, ...], Hold, GuideContact]:
    """Pistons and slippers under the forces of the retainer, whose friction consumes guide_loss (W)."""
    part, speed, axes = group.pump.ball_guide, group.point.shaft_speed, group.plate_axes
    pressed = group.spring if group.places.retained else 0.0
    guide = guide_contact(BallGuide(part.radius, part.contact_latitude), axes, speed, pressed, guide_loss)
    about_guide = replace(group.ball, place=group.ball.place - group.places.pivot * SHAFT)
    held = hold(guide, about_guide, axes, speed, group.pistons)
    gain = piston_acceleration(group.drive, group.shaft_angle, speed)
    normal = axes[2][:, None]
    sets = [set_forces(group.ball, gain, speed, normal, own.masses, own.levers, own.known, held) for own in loads]
    return tuple(sets), held, guide


def _shaft_drag(found: PumpPoint) -> ShaftDrag:
    """Friction torque about the shaft without that of the ball guide: loss over speed, less the torque that
    dragged oil returns to the ring.
    """
    speed = found.point.shaft_speed
    rubbing = (Pair.VALVE_PLATE_CYLINDER, Pair.FRONT_BEARING, Pair.REAR_BEARING)
    losses = (found.pairs.loss(pair) for pair in rubbing)
    plate, front, rear = ((loss.coulomb + loss.viscous) / speed for loss in losses)
    return ShaftDrag(plate - found.exchange.drag_power.valve_plate / speed, front, rear)


def _guide_spline(group: TurningGroup, guide: GuideContact) -> Array:
    """Wrench of the shaft on the ball guide, (6, N): balance of retainer and spring, none along the shaft."""
    sideways = guide.force[:, None] * np.array([[1.0], [1.0], [0.0]])
    found = wrench(sideways, group.places.pivot * SHAFT, guide.moment[:, None])
    return np.broadcast_to(found, (6, group.shaft_angle.size))


def _on_block(group: TurningGroup, loads: Sequence[ChamberLoads], sets: Sequence[SetForces]) -> Array:
    """Wrench on the block without valve plate and spline, (6, N): bores, the oil over the pistons, spring."""
    axis, each = group.ball.axis, []
    for own, one in zip(loads, sets, strict=True):
        on_axis = wrench(-own.known.along_bore * axis, group.ball.place, -one.twist * axis)
        each.append(on_axis + wrench(-one.edge, one.edge_place) + wrench(-one.inner, one.inner_place))
    found = group.whole(each)
    found[2] -= group.spring
    return found
