"""Spins of piston and slipper about their own axes: stated, or free between ball joint and films."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from gaps.loads.ball_joint import Spins, bore_drag, free_spins, land_drag
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.pump.laws.directions import bore_axis, plate_axes
from system.pump.laws.kinematics import SwashDrive, stroke
from system.pump.lumped import piston_area, piston_stand_out
from system.pump.operating import OperatingPoint

FLATTEST = 0.1  # of the estimated drag: the least change of a film's torque with spin
STEEPEST = 3.0  # of the drag of the line through rest: the most
NEAREST = 0.5  # of a spin: less is left only where the line through rest says so
REMEMBERED = 5  # rounds, whose films set the next spins
ESTIMATED = 36  # shaft angles at which the joint's axes swing before films are solved


@dataclass(frozen=True)
class SpunFilms:
    """Films solved at spins: mean torques (N m) on piston and slipper there."""

    turned: Spins
    torques: tuple[float, float]


@dataclass(frozen=True)
class SpinTorques:
    """Torques that determine spins: friction mu |B| r (n,) N m of the joint at n equidistant shaft angles; drags (N m
    s) of both films, and torques (N m) of the films on parts without spin.

    tried: the films of the last rounds at this point, the latest last; empty: estimated, or films of another point.
    careful: the same by lines through rest, for spins that `drags` lead far towards rest; None where they are equal to
    these.
    """

    friction: Array
    drags: tuple[float, float]
    driven: tuple[float, float] = (0.0, 0.0)
    tried: tuple[SpunFilms, ...] = ()
    careful: SpinTorques | None = None


def spins(pump: PumpDescription, point: OperatingPoint, drive: SwashDrive, torques: SpinTorques) -> Spins:
    """Spins (rad/s) of the piston relative to the block and of the slipper in space, constant over the turn.

    spin_ratio times shaft speed where stated; where left out, that at which the joint's friction and the films' drags
    balance (`gaps.loads.ball_joint.free_spins`).
    """
    speed, ratios = point.shaft_speed, (pump.piston.spin_ratio, pump.slipper.spin_ratio)
    piston, slipper = (None if ratio is None else ratio * speed for ratio in ratios)
    if piston is not None and slipper is not None:
        return Spins(piston, slipper)
    found = _balanced(speed, drive, torques, (piston, slipper))
    if torques.careful is not None and _far(torques.tried[-1].turned, found):
        return _balanced(speed, drive, torques.careful, (piston, slipper))
    return found


def _far(last: Spins, found: Spins) -> bool:
    """True if a spin is less than NEAREST of the last, or changes sign: lines of two spins are not valid so far."""
    both = (last.piston, found.piston), (last.slipper, found.slipper)
    return any(before != 0.0 and after / before < NEAREST for before, after in both)


def _balanced(
    speed: float, drive: SwashDrive, torques: SpinTorques, stated: tuple[float | None, float | None]
) -> Spins:
    """The spins at which friction and films balance at a shaft speed (rad/s)."""
    angles = TURN * np.arange(len(torques.friction)) / len(torques.friction)
    return free_spins(
        bore_axis=bore_axis(drive, angles),
        plate_normal=plate_axes(drive)[2],
        shaft_speed=speed,
        friction=torques.friction,
        piston_drag=torques.drags[0],
        slipper_drag=torques.drags[1],
        stated=stated,
        driven=torques.driven,
    )


def estimated_torques(pump: PumpDescription, point: OperatingPoint, drive: SwashDrive) -> SpinTorques:
    """Torques that determine spins before any film is solved.

    The friction is that of the turn's mean force, Ap (mean of both ports' pressures - p_case)/cos(g); drags are
    Petroff's of a centred piston at mid stroke and of the slipper's parallel lands at `film_thickness`.
    """
    part, slipper = pump.piston, pump.slipper
    above = 0.5 * (point.delivery_pressure + point.inlet_pressure) - point.case_pressure
    force = piston_area(pump) * abs(above) / math.cos(drive.swash_angle)
    engaged = part.engaged_length - piston_stand_out(pump, drive) - 0.5 * stroke(drive)
    length = min(engaged, part.guide_length or engaged)
    lands = (land_drag(point.viscosity, *land, slipper.film_thickness) for land in slipper.lands.radii)
    return SpinTorques(
        np.full(ESTIMATED, pump.friction.piston_slipper_socket * force * slipper.ball_joint_radius),
        (bore_drag(point.viscosity, pump.pump.piston_diameter, length, part.radial_clearance), math.fsum(lands)),
    )


def torques_of_films(
    estimated: SpinTorques, friction: Array, spun: SpunFilms, before: tuple[SpunFilms, ...] = ()
) -> SpinTorques:
    """Torques that determine the next spins, by films just solved and those of the rounds `before` at the same point.

    Each film's torque is approximated by a line over spin: through rest where its own torque alone is known (drag, if
    it exceeds the estimated one; the remainder is the film's drive), else by `_drag`. friction as `SpinTorques` has it.
    """
    tried = (*before, spun)[-REMEMBERED:]
    spins = [[one.turned.piston for one in tried], [one.turned.slipper for one in tried]]
    torques = [[one.torques[part] for one in tried] for part in range(2)]
    rest = [_through_rest(spins[k][-1], torques[k][-1], estimated.drags[k]) for k in range(2)]
    careful = _by_lines(friction, rest, spun, tried)
    if len(tried) == 1:
        return careful
    drags = [_drag(spins[k], torques[k], estimated.drags[k], rest[k]) for k in range(2)]
    return replace(_by_lines(friction, drags, spun, tried), careful=careful)


def _by_lines(friction: Array, drags: list[float], spun: SpunFilms, tried: tuple[SpunFilms, ...]) -> SpinTorques:
    """Torques on lines of these drags (N m s) through those of films just solved."""
    piston, slipper = drags
    driven = spun.torques[0] + piston * spun.turned.piston, spun.torques[1] + slipper * spun.turned.slipper
    return SpinTorques(friction, (piston, slipper), driven, tried)


def _through_rest(spin: float, torque: float, least: float) -> float:
    """Drag (N m s) by one spin (rad/s) with its torque (N m), at least `least`."""
    return max(least, -torque / spin) if spin else least


def _drag(spins: list[float], torques: list[float], least: float, through_rest: float) -> float:
    """Drag (N m s) of a film by its torques (N m) at the spins (rad/s) tried: the decrease of the torque with spin.

    The slope between the last two spins, at least FLATTEST of the estimated drag `least` and at most that of the line
    through rest. The drag of a film that warms and lifts decreases as it turns faster; spins then move farther each
    round, until they pass the balance. Once the balance lies between two tried spins, the slope is at least that to
    either of them, and at most STEEPEST times that through rest. Between two spins that are nearly equal, pressures and
    friction have changed the torque as well; a slope from these alone would hold a spin off its balance.
    """
    last, torque = spins[-1], torques[-1]
    if spins[-2] == last:
        return through_rest
    slopes = [_slope(spin, other, last, torque) for spin, other in zip(spins[:-1], torques[:-1], strict=True)]
    between = [min(slopes[k], STEEPEST * through_rest) for k in _around(spins)]
    return max(min(through_rest, slopes[-1]), FLATTEST * least, *between)


def _slope(spin: float, torque: float, last: float, last_torque: float) -> float:
    """Drag (N m s) between two spins with their torques; 0 between equal ones."""
    return (torque - last_torque) / (last - spin) if spin != last else 0.0


def _around(spins: list[float]) -> tuple[int, ...]:
    """Numbers of the tried spins next to the last one on both sides, from which the next ones came towards it.

    Empty where a side has none: the balance is not known to lie between two spins.
    """
    last, way = spins[-1], np.sign(np.diff(spins))
    below = [k for k, to in enumerate(way) if to > 0.0 and spins[k] < last]
    above = [k for k, to in enumerate(way) if to < 0.0 and spins[k] > last]
    if not below or not above:
        return ()
    return max(below, key=lambda k: spins[k]), min(above, key=lambda k: spins[k])
