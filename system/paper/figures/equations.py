"""Equations with misprints: printed over true value, and the impossibility that follows from each."""

from collections.abc import Callable

import numpy as np

from reynolds.numerics.arrays import Array
from system.paper.figure import Figure, Unit
from system.paper.figures.guide import ball_guide
from system.paper.judge import FigureResult, Impossibility, Judged, Range, judge, range_of
from system.paper.points import RATED, PaperPoints
from system.paper.statements import CLAIMS
from system.pump.laws.kinematics import (
    SwashDrive,
    piston_acceleration,
    piston_displacement,
    piston_velocity,
    slipper_sliding_speed,
    stroke,
)
from system.pump.laws.retainer import azimuth_rate_ratio
from system.pump.lumped import full_drive, lumped_leaks, piston_motion
from system.pump.operating import operating_point

ANGLES = 2.0 * np.pi * np.arange(720) / 720
_STEP = 1e-4  # rad, of central differences
_SAME = Range(0.999, 1.001)


def equations(points: PaperPoints) -> FigureResult:
    """Eqs. (8), (9), (12), (14) and (15) as printed against geometry and conservation."""
    drive = full_drive(points.pump)
    judged = (_eq8(drive), _eq9(drive), _eq12(points, drive), _eq14(drive), _eq15(points))
    return FigureResult(Figure.EQUATIONS, (), judged, ("The corrected forms are those of docs/theory.md.",))


def printed_acceleration(drive: SwashDrive, angle: Array, speed: float) -> Array:
    """Paper Eq. (8) as printed, m/s2."""
    t, c, s = drive.cone_swash_product, np.cos(angle), np.sin(angle)
    scale = drive.pitch_radius * speed**2 / np.sin(drive.bore_cone_angle)
    return np.asarray(scale * (t**2 * (1.0 + s**2) + c) / (1.0 + t * c) ** 3)


def printed_sliding_speed(drive: SwashDrive, angle: Array, speed: float) -> Array:
    """Paper Eq. (9) as printed, m/s."""
    g, b, c, s = drive.swash_angle, drive.bore_cone_angle, np.cos(angle), np.sin(angle)
    t, round_ = drive.cone_swash_product, c**2 + np.cos(g) ** 2 * s**2
    reach = drive.pitch_radius * np.cos(g + b) * np.sqrt(round_)
    place = reach / ((np.cos(g) * np.cos(b) - np.sin(g) * np.sin(b) * c) * np.cos(g))
    return np.asarray(place * speed * np.cos(g) * (1.0 + t) / ((1.0 - t) * round_))


def _eq8(drive: SwashDrive) -> Judged:
    claim = CLAIMS["equations.8"]
    if drive.bore_cone_angle == 0.0:
        return judge(claim, Range(1.0, 1.0), reason="a cylindrical block: the print divides by sin of a cone of 0")
    angle = np.array([0.0, np.pi])
    by_velocity = _rate(lambda at: piston_velocity(drive, at, RATED), angle) * RATED
    over = printed_acceleration(drive, angle, RATED) / by_velocity
    true = float(np.max(np.abs(piston_acceleration(drive, angle, RATED) / by_velocity - 1.0)))
    reason = f"the factor tan(cone) tan(swash) of cos(phi) is missing. With it the ratio is 1 within {true:.0e}"
    return judge(claim, range_of(over), reason=reason, impossible=_must_be_one("print over derivative", over))


def _eq9(drive: SwashDrive) -> Judged:
    over = printed_sliding_speed(drive, ANGLES, RATED) / slipper_sliding_speed(drive, ANGLES, RATED)
    reason = "Eq. (6) fixes the ball centre's position on the plate, and the derivative of this position differs"
    impossible = _must_be_one("print over derivative of the position", over)
    return judge(CLAIMS["equations.9"], range_of(over), reason=reason, impossible=impossible)


def _eq12(points: PaperPoints, drive: SwashDrive) -> Judged:
    ratio = azimuth_rate_ratio(ball_guide(points.pump), float(drive.swash_angle), ANGLES)
    reason = "points of one retainer would turn at different speeds, so their distances would change"
    impossible = _must_be_one("ratio of rates of turning between the retainer's points", ratio)
    return judge(CLAIMS["equations.12"], range_of(ratio), reason=reason, impossible=impossible)


def _eq14(drive: SwashDrive) -> Judged:
    pushed = piston_velocity(drive, ANGLES, RATED)
    shrinks = RATED * _rate(lambda at: piston_displacement(drive, at), ANGLES)
    moved = float(np.abs(pushed - shrinks).mean() * np.pi / (RATED * stroke(drive)))
    reason = "the flow q_r of Eq. (19) is dV_c/dt of Eq. (18). With both, of opposite sign, the pump delivers nothing"
    impossible = _must_be_one("displacement by the print over the true one", np.array([moved]))
    return judge(CLAIMS["equations.14"], Range(moved, moved), reason=reason, impossible=impossible)


def _eq15(points: PaperPoints) -> Judged:
    pump = points.pump
    point = operating_point(pump)
    motion = piston_motion(pump, point)
    moving = np.abs(motion.velocity) > 0.1 * np.abs(motion.velocity).max()
    printed = -0.5 * np.pi * pump.pump.piston_diameter * pump.piston.radial_clearance * motion.velocity
    over = printed[moving] / lumped_leaks(pump, point, motion).drag_flow[0][moving]
    reason = "velocity by Eq. (7) is positive out of the block, and a wall drags oil in its own direction"
    impossible = _must_be_one("printed drag flow over that of a film between a moving and a fixed wall", over)
    return judge(CLAIMS["equations.15"], range_of(over), reason=reason, impossible=impossible)


def _rate(of: Callable[[Array], Array], angle: Array) -> Array:
    """d of/d angle by central differences."""
    return np.asarray((of(angle + _STEP) - of(angle - _STEP)) / (2.0 * _STEP))


def _must_be_one(quantity: str, over: Array) -> Impossibility:
    furthest = float(over[int(np.argmax(np.abs(over - 1.0)))])
    return Impossibility(quantity, Unit.NUMBER, furthest, _SAME)
