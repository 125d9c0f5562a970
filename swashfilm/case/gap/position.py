"""Position and load of a gap case: tables [position] and [load]."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, assert_never

import numpy as np

from reynolds.floating.pose import THINNEST
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.films.parts import FloatingParts
from system.films.positions import eccentric, instant_drives
from system.films.rotor import Rotor, engaged_share, travel
from system.inputs.sections.fields import Angle, AnyLength, Height, Micrometres, Several, field_type
from system.inputs.units import Dimension

Eccentricity = Annotated[tuple[float, float], Several(2), Dimension.LENGTH, Micrometres]
Moment = Annotated[float, Dimension.TORQUE]


@dataclass(frozen=True, kw_only=True)
class RatioSection:
    """[position]: piston in the direction of its load."""

    eccentricity_ratio: float


@dataclass(frozen=True, kw_only=True)
class EndsSection:
    """[position]: piston by both ends of its guide."""

    eccentricity_inner: Eccentricity  # along x and y, at the guide's inner end
    eccentricity_case: Eccentricity  # along x and y, at the bore's case edge


@dataclass(frozen=True, kw_only=True)
class TiltSection:
    """[position]: slipper or cylinder block."""

    film_thickness: Height  # at the origin
    slope_x: Angle = 0.0
    slope_y: Angle = 0.0


@dataclass(frozen=True, kw_only=True)
class PistonLoad:
    """[load]: side force on the piston."""

    force: Annotated[tuple[float, float], Several(2), Dimension.FORCE]  # along x and y of the pump
    arm: AnyLength | None = None  # of the force beyond the bore's case edge; left out: the overhang there


@dataclass(frozen=True, kw_only=True)
class FaceLoad:
    """[load]: load of a slipper's or the block's film, pocket and kidneys."""

    force: Annotated[float, Dimension.FORCE]
    moment_x: Moment = 0.0  # integral of p y
    moment_y: Moment = 0.0  # integral of -p x


Position = RatioSection | EndsSection | TiltSection
Load = PistonLoad | FaceLoad
POSITIONS = {gap: field_type(RatioSection | EndsSection if gap is Gap.PISTON else TiltSection) for gap in Gap}
LOADS = {gap: field_type(PistonLoad if gap is Gap.PISTON else FaceLoad) for gap in Gap}
"""Forms of the tables [position] and [load] by gap."""


def pose_of(stated: Position, gap: Gap, rotor: Rotor, parts: FloatingParts, angle: float, pressures: Array) -> Array:
    """Return a position (k,) m: eccentricities, or film thickness and the rises over the rim by the slopes."""
    match stated:
        case RatioSection(eccentricity_ratio=ratio):
            outer = instant_drives(rotor, parts, angle, pressures).piston.outer(angle)
            return eccentric(rotor.pump.piston.radial_clearance, ratio, outer)
        case EndsSection(eccentricity_inner=inner, eccentricity_case=case):
            return np.array([*inner, *case])
        case TiltSection(film_thickness=thickness, slope_x=slope_x, slope_y=slope_y):
            return np.array([thickness, *(rim(gap, rotor) * np.tan(np.array([slope_x, slope_y])))])
    assert_never(stated)


def with_arm(load: Load, rotor: Rotor, angle: float) -> Load:
    """Return the load, of a piston with its arm."""
    if not isinstance(load, PistonLoad) or load.arm is not None:
        return load
    return replace(load, arm=rotor.pump.piston.overhang + float(travel(rotor, angle)))


def rim(gap: Gap, rotor: Rotor) -> float:
    """Return the outer radius (m) at which the rises of a slipper or the block are measured."""
    match gap:
        case Gap.SLIPPER:
            return rotor.pump.slipper.lands.outer_radius
        case Gap.VALVE_PLATE:
            return rotor.pump.valve_plate.land_radius_4
        case Gap.PISTON:
            raise ValueError("a piston's position is two eccentricities")
    assert_never(gap)


def touching(gap: Gap, rotor: Rotor, parts: FloatingParts, angle: float, position: Array | None) -> float | None:
    """Return the least film (m) of plain parts that touch at a position; None where they do not touch."""
    if position is None:
        return None
    if gap is Gap.PISTON:
        case = position[2:]
        inner = case + (position[:2] - case) * engaged_share(rotor, parts.piston.guide_length, np.array([angle]))
        least = rotor.pump.piston.radial_clearance - max(np.hypot(*inner), np.hypot(*case))
    else:
        least = position[0] - np.hypot(*position[1:])
    return None if least > THINNEST else float(least)


def stated_position(gap: Gap, rotor: Rotor, pose: Array) -> Position:
    """Return the table that has this position."""
    if gap is Gap.PISTON:
        inner_x, inner_y, case_x, case_y = pose.tolist()
        return EndsSection(eccentricity_inner=(inner_x, inner_y), eccentricity_case=(case_x, case_y))
    slope_x, slope_y = np.arctan(pose[1:] / rim(gap, rotor)).tolist()
    return TiltSection(film_thickness=float(pose[0]), slope_x=slope_x, slope_y=slope_y)
