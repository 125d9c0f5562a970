"""Position and load of a gap case: tables [position] and [load], read and written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import assert_never

import numpy as np

from reynolds.floating.pose import THINNEST
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.films.parts import FloatingParts
from system.films.positions import eccentric, instant_drives
from system.films.rotor import Rotor, travel
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension, format_quantity


@dataclass(frozen=True)
class PistonLoad:
    """Side force (x, y) N on the piston at a distance `arm` (m) beyond the bore's case-side edge."""

    force: tuple[float, float]
    arm: float


@dataclass(frozen=True)
class FaceLoad:
    """Load of a slipper's or the block's film, pocket and kidneys: N, and integrals of p y and -p x, N m."""

    force: float
    moment_x: float
    moment_y: float


Load = PistonLoad | FaceLoad


def read_position(
    table: Table, gap: Gap, rotor: Rotor, parts: FloatingParts, angle: float, pressures: Array
) -> Array | None:
    """Return position (k,) m that a table [position] states; None with its faults listed."""
    if gap is not Gap.PISTON:
        return _tilted(table, rim(gap, rotor))
    if "eccentricity_ratio" in table.values:
        ratio = table.number("eccentricity_ratio")
        outer = instant_drives(rotor, parts, angle, pressures).piston.outer(angle)
        return None if ratio is None else eccentric(rotor.pump.piston.radial_clearance, ratio, outer)
    ends = [table.pair(f"eccentricity_{end}", Dimension.LENGTH) for end in ("inner", "case")]
    return None if None in ends else np.array(ends, dtype=float).ravel()


def _tilted(table: Table, radius: float) -> Array | None:
    """Return film thickness at the origin and the rises over `radius` by the slopes, (3,) m."""
    thickness = table.positive("film_thickness", Dimension.LENGTH)
    slopes = [table.quantity(f"slope_{axis}", Dimension.ANGLE, 0.0) for axis in ("x", "y")]
    if thickness is None or None in slopes:
        return None
    return np.array([thickness, *(radius * np.tan(np.array(slopes, dtype=float)))])


def read_load(table: Table, gap: Gap, rotor: Rotor, angle: float) -> Load | None:
    """Return the load that a table [load] states; None with its faults listed."""
    if gap is Gap.PISTON:
        force = table.pair("force", Dimension.FORCE)
        arm = table.quantity("arm", Dimension.LENGTH, rotor.pump.piston.overhang + travel(rotor, angle))
        return None if force is None or arm is None else PistonLoad(force, arm)
    lift = table.quantity("force", Dimension.FORCE)
    moment_x = table.quantity("moment_x", Dimension.TORQUE, 0.0)
    moment_y = table.quantity("moment_y", Dimension.TORQUE, 0.0)
    if lift is None or moment_x is None or moment_y is None:
        return None
    return FaceLoad(lift, moment_x, moment_y)


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
        guide = parts.piston.guide_length
        engaged = min(rotor.pump.piston.engaged_length - travel(rotor, angle), guide)
        case = position[2:]
        inner = case + (position[:2] - case) * engaged / guide
        least = rotor.pump.piston.radial_clearance - max(np.hypot(*inner), np.hypot(*case))
    else:
        least = position[0] - np.hypot(*position[1:])
    return None if least > THINNEST else float(least)


def position_rows(gap: Gap, rotor: Rotor, position: Array) -> list[str]:
    """Return the table from which `read_position` reads this position."""
    if gap is Gap.PISTON:
        ends = (("inner", position[:2]), ("case", position[2:]))
        return ["[position]", *(f"eccentricity_{end} = {_both(x, y, Dimension.LENGTH)}" for end, (x, y) in ends)]
    slopes = zip(("x", "y"), np.arctan(position[1:] / rim(gap, rotor)), strict=True)
    return [
        "[position]",
        f"film_thickness = {_shown(position[0], Dimension.LENGTH)}",
        *(f"slope_{axis} = {_shown(slope, Dimension.ANGLE)}" for axis, slope in slopes),
    ]


def load_rows(load: Load) -> list[str]:
    """Return the table from which `read_load` reads this load."""
    match load:
        case PistonLoad(force, arm):
            return ["[load]", f"force = {_both(*force, Dimension.FORCE)}", f"arm = {_shown(arm, Dimension.LENGTH)}"]
        case FaceLoad(lift, moment_x, moment_y):
            return [
                "[load]",
                f"force = {_shown(lift, Dimension.FORCE)}",
                f"moment_x = {_shown(moment_x, Dimension.TORQUE)}",
                f"moment_y = {_shown(moment_y, Dimension.TORQUE)}",
            ]
    assert_never(load)


def _shown(value: float, dimension: Dimension) -> str:
    return quoted(format_quantity(float(value), dimension))


def _both(x: float, y: float, dimension: Dimension) -> str:
    return f"[{_shown(x, dimension)}, {_shown(y, dimension)}]"
