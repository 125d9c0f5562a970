"""Exchange of three floating gaps with chambers, shaft and power balance, over the turn.

Arrays over n equidistant angles of a chamber from 0, those of the gaps' reported angles. Of the block only a
pitch is known where chambers are equal; then it repeats.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gaps.films.reports import BlockReport, GapReport, PistonReport, Reported, SlipperReport
from gaps.revolution.march import GapRevolution
from reynolds.numerics.arrays import Array
from system.films.drives import GroupBalance, Rubbing
from system.films.parts import FloatingParts
from system.films.rotor import Rotor, travel, valve_plate_geometry
from system.films.spins import SpinTorques, SpunFilms, torques_of_films
from system.inputs.units import TURN
from system.pump.chamber.problem import LeakTable
from system.pump.chamber.setup import periodic_values
from system.pump.chamber.turn import Gaps
from system.pump.laws.directions import bore_axis, bore_sides, plate_axes
from system.pump.laws.friction_pairs import FrictionPairs, PairLoss
from system.pump.lumped import piston_area
from system.pump.power import GapExchange


@dataclass(frozen=True)
class FloatingGaps:
    """The gaps of one chamber: its piston, its slipper, and the block over a pitch, or over the turn.

    chamber, from 0: where chambers differ, the one whose gaps they are.
    """

    piston: GapRevolution[PistonReport]
    slipper: GapRevolution[SlipperReport]
    block: GapRevolution[BlockReport]
    chamber: int = 0


def of_each(revolution: GapRevolution[Reported], value: Callable[[Reported], float | Array]) -> Array:
    """Values of `value` at each reported angle, (n, ...), from shaft angle 0 on."""
    return np.roll(np.array([value(instant.report) for instant in revolution.turn.instants]), 1, axis=0)


def passing(revolution: GapRevolution[Reported], value: Callable[[Reported], float | Array]) -> Array:
    """Means of `value` around each reported angle, (n, ...), from shaft angle 0 on."""
    return around(np.roll(np.array([value(instant.passed) for instant in revolution.turn.instants]), 1, axis=0))


def around(means: Array) -> Array:
    """Means over the steps on both sides of equidistant angles, (n, ...), from means up to each angle.

    The total over the turn is unchanged, for bursts of any length.
    """
    return np.asarray(0.5 * (means + np.roll(means, -1, axis=0)))


def positions(revolution: GapRevolution[Reported]) -> Array:
    """Positions (n, k) m from shaft angle 0 on."""
    return np.roll(revolution.positions, 1, axis=0)


def resampled(values: Array, samples: int) -> Array:
    """Periodic values (n, ...) at as many equidistant angles as wanted, by the chambers' cubic splines.

    The mean over the turn stays the same.
    """
    count = len(values)
    if samples == count:
        return values
    rows = np.ascontiguousarray(values.reshape(count, -1).T)
    return np.asarray(periodic_values(rows, samples).T.reshape(samples, *values.shape[1:]))


def leak_table(gaps: FloatingGaps) -> LeakTable:
    """Flow out of the chamber into each gap, by its angle; it changes with the pressure in the next round only."""
    piston = passing(gaps.piston, lambda report: float(report.flow[0]))
    slipper = passing(gaps.slipper, lambda report: float(report.flow[0]))
    flow = np.stack([piston, slipper, chamber_draws(gaps.block, gaps.chamber, len(piston))])
    return LeakTable(np.zeros_like(flow), flow)


def chamber_draws(block: GapRevolution[BlockReport], chamber: int, steps: int) -> Array:
    """Flow (steps,) m3/s out of a chamber into the block's film, in the mean around the chamber's own angles.

    If the block is known over a pitch alone, each of its chambers gives a part.
    """
    flow = np.array([instant.passed.flow for instant in block.turn.instants])
    known, pistons = flow.shape
    own = (np.arange(1, known + 1)[:, None] + steps // pistons * np.arange(pistons)) % steps
    found = np.empty(steps)
    if known == steps:
        found[own[:, chamber]] = flow[:, chamber]
    else:
        found[own] = flow
    return around(found)


def ball_shift(gaps: FloatingGaps, rotor: Rotor, parts: FloatingParts) -> Array:
    """Displacement of the ball from its place in rigid parts without films, (n, 3) m.

    The piston's axis leaves the bore's by e at the ball; the slipper keeps the ball on the swash plate, its film
    h thick, so the ball also moves along the bore: d = e - a (n . e + h)/(n . a).
    """
    normal, across = plate_axes(rotor.drive)[2], axis_shift(gaps, rotor, parts, 0.0)
    axis, film = bore_axis(rotor.drive, shaft_angles(len(across))), positions(gaps.slipper)[:, 0]
    return np.asarray(across - axis * ((across @ normal + film) / (axis @ normal))[:, None])


def axis_shift(gaps: FloatingGaps, rotor: Rotor, parts: FloatingParts, inside: float) -> Array:
    """Distance (n, 3) m of the piston's axis from the bore's, `inside` (m) of the ball into the bore."""
    piston, angles = positions(gaps.piston), shaft_angles(len(gaps.piston.positions))
    depth = inside - rotor.pump.piston.overhang - travel(rotor, angles)
    inner, case = piston[:, :2], piston[:, 2:]
    across = case + (inner - case) * (depth / parts.piston.guide_length)[:, None]
    return np.vecmat(across, bore_sides(rotor.drive, angles))


def shaft_angles(count: int) -> Array:
    """Equidistant shaft angles (count,) rad from 0."""
    return TURN * np.arange(count) / count


def growth(gaps: FloatingGaps, rotor: Rotor, parts: FloatingParts) -> Array:
    """Growth (n,) m3 of the chamber by the parts' small motion: the ball along its bore, the block's lift, and the
    deformation of piston and bore.

    Ap (d . a) - Ap z + A_kidney z_kidney, z the block's distance from the plate at the bore and at the kidney.
    """
    pump, plate = rotor.pump, valve_plate_geometry(rotor.pump)
    block, rim = positions(gaps.block), plate.land_radii[3]
    pistons, shift = pump.pump.pistons, ball_shift(gaps, rotor, parts)
    block = np.tile(block, (len(shift) // len(block), 1))
    block = np.roll(block, gaps.chamber * len(shift) // pistons, axis=0)
    angle = shaft_angles(len(shift))
    along = np.sum(shift * bore_axis(rotor.drive, angle), axis=1)
    rise = (block[:, 1] * np.cos(angle) + block[:, 2] * np.sin(angle)) / rim
    lifted, area = block[:, 0] + pump.pump.pitch_radius * rise, piston_area(pump)
    kidney = plate.kidney_area * block[:, 0] + plate.kidney_lever * rise
    swollen = of_each(gaps.piston, lambda report: report.chamber_growth)
    return np.asarray(area * (along - lifted) + kidney + swollen)


def rubbing(gaps: FloatingGaps, samples: int) -> Rubbing:
    """Forces of the films on piston and slipper at `samples` angles."""
    return Rubbing(
        resampled(of_each(gaps.piston, lambda report: report.friction.force), samples),
        resampled(of_each(gaps.piston, lambda report: report.friction.moment), samples),
        resampled(of_each(gaps.slipper, lambda report: report.friction.force), samples),
    )


def spin_torques(
    gaps: FloatingGaps, rotor: Rotor, group: GroupBalance, tried: tuple[SpunFilms, ...] = ()
) -> SpinTorques:
    """Torques on the spins of piston and slipper by their films and the joint's forces, means over the turn.

    tried: films of the rounds before at the same point, from which the change of torque with spin follows.
    """
    pump = rotor.pump
    force = np.linalg.norm(group.forces.ball, axis=-1)
    friction = pump.friction.piston_slipper_socket * force * pump.slipper.ball_joint_radius
    torques = (
        _mean(gaps.piston, lambda report: report.friction.torque),
        _mean(gaps.slipper, lambda report: report.friction.torque),
    )
    return torques_of_films(rotor.estimated_torques, friction, SpunFilms(rotor.spins, torques), tried)


def shaft_moment(gaps: FloatingGaps, rotor: Rotor, parts: FloatingParts, group: GroupBalance) -> Array:
    """Torque (N,) N m by which the piston with its slipper resists the shaft, from the forces on them.

    The moment about the shaft of the swash plate's force and friction and of inertia, at the places where the
    films hold the parts; the plate balances the joint's friction about its normal. The joint's forces neglect the
    acceleration d'' of the parts' small motion. To first order this is m d'' . r' on the shaft, by virtual work
    on the rigid parts, r' = dr/d angle of their centres of mass.
    """
    ball, normal = ball_shift(gaps, rotor, parts), plate_axes(rotor.drive)[2]
    axis = bore_axis(rotor.drive, shaft_angles(len(ball)))
    along = np.sum(ball * axis, axis=1)[:, None] * axis
    piston = along + axis_shift(gaps, rotor, parts, parts.piston.centre_of_mass)
    shift = resampled(np.stack([piston, ball, ball], axis=1), len(group.places))
    turned = np.cross(group.places + shift, group.forces_there)[..., 2].sum(axis=-1) + group.couple[:, 2]
    rubbed = group.ball_moment @ normal * normal[2]
    return np.asarray(rubbed - turned + _swung(rotor, group.places[:, :2], shift[:, :2]))


def _swung(rotor: Rotor, places: Array, shift: Array) -> Array:
    """Torque (N,) N m of the inertia of small motion, sum of m w^2 d'' . r' over the places (N, 2, 3) m.

    Piston first, then slipper; derivatives by central differences, whose mean work is that of the parts'
    acceleration along the small motion.
    """
    step = TURN / len(places)
    masses = np.array([rotor.pump.piston.mass, rotor.pump.slipper.mass])
    rate = (np.roll(places, -1, axis=0) - np.roll(places, 1, axis=0)) / (2.0 * step)
    bend = (np.roll(shift, -1, axis=0) - 2.0 * shift + np.roll(shift, 1, axis=0)) / step**2
    return np.asarray(rotor.point.shaft_speed**2 * np.sum(bend * rate, axis=2) @ masses)


def block_torque(block: GapRevolution[BlockReport], samples: int) -> Array:
    """Torque (samples,) N m of the valve plate's film and of the kidneys against the block's turning."""
    turns = round(TURN / block.angles[-1])
    return resampled(np.tile(passing(block, lambda report: report.torque + report.tilted_torque), turns), samples)


def with_floating_gaps(losses: FrictionPairs, gaps: FloatingGaps, group: GroupBalance) -> FrictionPairs:
    """The pairs with those of the three gaps from their films: shear of oil as viscous, rubbing as Coulomb's.

    The joint's friction is that of its forces and spins. Ball guide and bearings are unchanged.
    """
    pistons, joint = losses.piston_cylinder.count, group.joint_loss
    samples = len(joint)
    return replace(
        losses,
        piston_cylinder=_pair(pistons, gaps.piston, samples),
        slipper_swash_plate=_pair(pistons, gaps.slipper, samples),
        valve_plate_cylinder=_pair(1, gaps.block, samples),
        piston_slipper_socket=PairLoss(pistons, joint, np.zeros_like(joint)),
    )


def _pair(count: int, revolution: GapRevolution[Reported], samples: int) -> PairLoss:
    turns = round(TURN / revolution.angles[-1])
    rubbed, sheared = (
        resampled(np.tile(passing(revolution, value), turns), samples)
        for value in (lambda report: report.heat.rubbing, lambda report: report.heat.shear)
    )
    return PairLoss(count, rubbed, sheared)


def leakage_heat(gaps: FloatingGaps, pistons: int) -> Gaps:
    """Heat (W) of the flow that pressure drives through the gaps, the slippers' orifices with them, mean."""
    return Gaps(
        pistons * _mean(gaps.piston, lambda report: report.heat.flow),
        pistons * _mean(gaps.slipper, lambda report: report.heat.flow + report.orifice_heat),
        _mean(gaps.block, lambda report: report.heat.flow),
    )


def gap_exchange(gaps: FloatingGaps, pistons: int, shaft_speed: float) -> GapExchange:
    """Power of the gaps on the moving parts, and the block's draws.

    Heat of sliding less the power of the walls, and power of films on the parts' small motion: both reach the
    chambers without the shaft.
    """
    return GapExchange(
        drag_power=Gaps(
            pistons * (_mean(gaps.piston, lambda one: _rubbed(one) - one.friction.power) + _pushed(gaps.piston)),
            pistons * (_mean(gaps.slipper, lambda one: _rubbed(one) - one.friction.power) + _pushed(gaps.slipper)),
            _mean(gaps.block, lambda one: _rubbed(one) - one.torque * shaft_speed) + _pushed(gaps.block),
        ),
        delivery_draw=_mean(gaps.block, lambda report: report.delivery_draw),
        suction_draw=_mean(gaps.block, lambda report: report.suction_draw),
    )


def _pushed(revolution: GapRevolution[Reported]) -> float:
    """Power (W) of a film on the parts that press on it, mean over the turn."""
    return float(np.mean([instant.pushed for instant in revolution.turn.instants]))


def _rubbed(report: GapReport) -> float:
    return report.heat.shear + report.heat.rubbing


def _mean(revolution: GapRevolution[Reported], value: Callable[[Reported], float]) -> float:
    return float(np.mean([value(instant.passed) for instant in revolution.turn.instants]))


def port_draws(
    block: GapRevolution[BlockReport], pressures: tuple[float, float], modulus: float, count: int
) -> tuple[Array, Array]:
    """Flow from delivery and suction port into the block's film over its period, (count,) m3/s at zero gauge."""
    delivery = resampled(passing(block, lambda report: report.delivery_draw), count)
    suction = resampled(passing(block, lambda report: report.suction_draw), count)
    dense = np.exp(np.array(pressures) / modulus)
    return np.asarray(delivery * dense[0]), np.asarray(suction * dense[1])
