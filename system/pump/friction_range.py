"""Speeds at which the coefficients of [friction] are known."""

from dataclasses import replace

from system.description.pump import PumpDescription
from system.inputs.units import Dimension, format_quantity
from system.pump.assembly import PointWarning, PumpPoint, Remark

LEAST_TESTED = 1000.0 / 2100.0
"""Least of the speeds at which the paper determines its coefficients, over the rated speed (Xu et al. 2017)."""
FAR_BELOW = 0.5
"""Share of the least tested speed that counts as far below it.

Films and Hersey number H go with speed. At half of the tested H nothing tells whether films still part the faces.
"""
ROUNDING = 1e-9  # relative; a speed stated as the limit itself is not below it


def with_friction_range(pump: PumpDescription, found: PumpPoint) -> PumpPoint:
    """The point with a warning where its friction is that of constant coefficients far below the speeds of a test."""
    limit, speed = FAR_BELOW * LEAST_TESTED * pump.pump.rated_speed, found.point.shaft_speed
    if pump.physics.mixed_friction is not None or speed >= (1.0 - ROUNDING) * limit:
        return found
    turning, least, tested = (
        format_quantity(value, Dimension.ANGULAR_SPEED, digits=3) for value in (speed, limit, limit / FAR_BELOW)
    )
    text = (
        f"the shaft turns at {turning} (limit {least}: half of {tested}, the least speed of the tests behind the "
        "constant coefficients of [friction], in shares of the rated speed): faces touch at low speed and friction "
        "rises, which no coefficient here includes, so that torque is a lower bound and efficiency an upper one; "
        "[physics.mixed_friction], or --fidelity floating"
    )
    return replace(found, warnings=(*found.warnings, Remark(PointWarning.FRICTION_AT_LOW_SPEED, text)))
