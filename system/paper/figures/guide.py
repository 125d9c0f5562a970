"""Figs. 15 and 19: ball guide and retainer, by the paper's equations and by rigid bodies."""

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.units import RPM
from system.multibody.retainer import contact_circle, guide_loss
from system.paper.figure import Curve, Figure, FigureAxis, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Range, judge, range_of
from system.paper.points import FULL, PRESSURES, RATED, SPEEDS, LossReading, PaperPoints
from system.paper.statements import CLAIMS
from system.pump.laws.directions import plate_axes
from system.pump.laws.friction_pairs import Pair, ball_guide_coulomb
from system.pump.laws.kinematics import SwashDrive, drive_at_ratio
from system.pump.laws.retainer import BallGuide, RetainerMotion, mean_sliding_speed, relative_locus
from system.pump.lumped import block_spring, full_drive

AZIMUTHS = 2.0 * np.pi * np.arange(361) / 360


def fig15(points: PaperPoints) -> FigureResult:
    """Locus of a contact point on the retainer against its place on the ball guide over a turn."""
    guide, drive = ball_guide(points.pump), full_drive(points.pump)
    printed = relative_locus(guide, float(drive.swash_angle), AZIMUTHS)
    rigid = rigid_locus(guide, drive, AZIMUTHS)
    off = float(np.max(np.linalg.norm(rigid - printed, axis=0)))
    length = float(np.sum(np.linalg.norm(np.diff(printed, axis=1), axis=0)))
    laws = {"Eq. (10)": printed, "rigid retainer turned about the plate's normal": rigid}
    shaft = FigureAxis("along the shaft", Unit.LENGTH)
    panels = (
        Panel(
            "Relative locus, in the pump", PanelKind.TRUE_SCALE,
            FigureAxis("normal to the shaft, in the plane of tilt", Unit.LENGTH), shaft,
            tuple(Curve(name, way[1], way[0]) for name, way in laws.items()),
        ),
        Panel(
            "Relative locus, on the ball guide", PanelKind.TRUE_SCALE,
            FigureAxis("round the ball guide", Unit.LENGTH), shaft,
            tuple(Curve(name, way[2] * np.cos(AZIMUTHS) - way[1] * np.sin(AZIMUTHS), way[0])
                  for name, way in laws.items()),
        ),
    )  # fmt: skip
    sizes = " x ".join(f"{Unit.LENGTH.factor * float(np.ptp(row)):.2f}" for row in printed[:2])
    remarks = (
        f"The locus spans {sizes} mm along the shaft and normal to it in the plane of tilt, and 0 along the tilt axis.",
        "Fig. 15 (b) is a photograph of wear patterns, without a counterpart here.",
    )
    reason = "the closed form has no start-up, in which the paper's simulation differs"
    judged = (judge(CLAIMS["fig15.agrees"], Range(0.0, off / length), reason=reason),)
    return FigureResult(Figure.FIG15, panels, judged, remarks)


def fig19(points: PaperPoints) -> FigureResult:
    """Loss of ball guide and retainer over speed at full displacement: nominal law, multibody, and printed k."""
    pump = points.pump
    guide, spring = ball_guide(pump), block_spring(pump)
    drive, friction = drive_at_ratio(full_drive(pump), FULL), pump.friction.ball_guide_retainer
    axes = plate_axes(drive)
    law, printed = (
        np.array([
            ball_guide_coulomb(friction, spring, guide.contact_latitude,
                               mean_sliding_speed(guide, float(drive.swash_angle), speed, motion))
            for speed in SPEEDS
        ])
        for motion in RetainerMotion
    )  # fmt: skip
    bodies = np.array([guide_loss(friction, spring, guide, axes, speed) for speed in SPEEDS])
    x = np.array(SPEEDS)
    curves = (Curve("equation (25), rigid retainer", x, law), Curve("multibody", x, bodies),
              Curve("equation (25), k as printed", x, printed))  # fmt: skip
    loss = FigureAxis("loss", Unit.POWER)
    panels = (
        Panel("Loss of ball guide and retainer over speed", PanelKind.LINES,
              FigureAxis("shaft speed", Unit.SPEED), loss, curves),
        Panel("The pump's own, over pressure", PanelKind.LINES,
              FigureAxis("delivery pressure", Unit.PRESSURE), loss, _over_pressure(points)),
    )  # fmt: skip
    apart = bodies / law - 1.0
    tilt = 1.0 / float(np.cos(drive.swash_angle))
    judged = (
        judge(CLAIMS["fig19.agrees"], range_of(apart[:-1]),
              reason=f"normals by the guide's balance are 1/cos(swash angle) = {tilt:.4f} times those of the law"),
        judge(CLAIMS["fig19.rated"], _same(float(apart[-1] / np.mean(apart[:-1]))),
              reason="the paper names vibration as the cause; rigid bodies in a prescribed motion do not vibrate"),
    )  # fmt: skip
    rated = SPEEDS.index(RATED)
    remark = (
        f"At rated speed: law {law[rated]:.1f} W, multibody {bodies[rated]:.1f} W, k as printed {printed[rated]:.1f} W."
    )
    return FigureResult(Figure.FIG19, panels, judged, (remark, "None of the three depends on pressure."))


def _over_pressure(points: PaperPoints) -> tuple[Curve, ...]:
    """Loss of the pair in the solved points, speed by speed."""
    pair, shear, x = Pair.BALL_GUIDE_RETAINER, LossReading.WITH_SHEAR, np.array(PRESSURES)
    rows = {speed: points.over_pressure(speed, FULL) for speed in SPEEDS}
    return tuple(
        Curve(f"{speed / RPM:.0f} r/min", x, np.array([one.loss(pair, shear) for one in row]))
        for speed, row in rows.items()
    )


def ball_guide(pump: PumpDescription) -> BallGuide:
    """The ball guide of a pump."""
    return BallGuide(pump.ball_guide.radius, pump.ball_guide.contact_latitude)


def rigid_locus(guide: BallGuide, drive: SwashDrive, angles: Array) -> Array:
    """Way (3, n) m of a retainer's point against its place on the ball guide, both turned as rigid bodies.

    The retainer turns about the plate's normal, the guide about the shaft, by the same angles (rad); both points
    begin in the plane of tilt. Axes of Eq. (10): along the shaft, square to it in the plane of tilt, tilt axis.
    """
    axes, upright = plate_axes(drive), np.eye(3)
    begin = [contact_circle(guide, own)[:, 0] for own in (axes, upright)]
    way = turned(begin[0], axes[2], angles - np.pi) - turned(begin[1], upright[2], angles - np.pi)
    return np.stack([way[2], -way[0], -way[1]])


def turned(vector: Array, axis: Array, angles: Array) -> Array:
    """A vector (3,) turned about a unit axis (3,) by angles (n,) rad, (3, n) (Rodrigues 1840)."""
    along = axis * float(axis @ vector)
    across = np.cross(axis, vector)
    return np.asarray(along[:, None] + np.outer(vector - along, np.cos(angles)) + np.outer(across, np.sin(angles)))


def _same(value: float) -> Range:
    return Range(value, value)
