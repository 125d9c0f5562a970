"""Motion of the pistons of a conical block; angle 0 is the inner dead centre."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .points import Array
from .pump import Pump


@dataclass(frozen=True)
class Motion:
    """At angles, of N strokes: travel out of the inner dead centre (m), slope (m/rad), bend (m/rad2), sliding of the
    slipper (m/rad), (N, M); tilt of the plate (rad), retracted stroke (m), (N, 1).
    """

    angle: Array
    travel: Array
    slope: Array
    bend: Array
    sliding: Array
    tilt: Array
    retracted: Array


def motion(pump: Pump, ratio: Array, angle: Array) -> Motion:
    """The motion at displacement ratios (N,) and angles (M,).

    S = R/sin b t/(1 + t) (1 - cos phi)/(1 + t cos phi), t = tan b tan g, and its derivatives.
    """
    across = pump.pitch / np.sin(pump.cone)
    full = _product(np.tan(pump.cone) * np.tan(pump.tilt), 1.0)
    t = _product(np.tan(pump.cone) * np.tan(pump.tilt), (ratio * pump.stroke)[:, None])
    tilt = np.arctan(t / np.tan(pump.cone))
    cosine, sine = np.cos(angle)[None, :], np.sin(angle)[None, :]
    under = 1.0 + t * cosine
    bend = across * (t**2 * (1.0 + sine**2) + t * cosine) / under**3
    sliding = pump.pitch * np.sqrt(sine**2 / np.cos(tilt) ** 2 + (cosine + t) ** 2) / under**2
    stroke, most = (2.0 * across * one / (1.0 - one**2) for one in (t, full))
    return Motion(
        angle=angle, travel=across * t / (1.0 + t) * (1.0 - cosine) / under, slope=across * t * sine / under**2,
        bend=bend, sliding=sliding, tilt=tilt, retracted=0.5 * (most - stroke),
    )  # fmt: skip


def _product(full: float, ratio: Array | float) -> Array:
    """t at which the stroke, as t/(1 - t^2), is a ratio of that at `full`."""
    share = np.asarray(ratio * full / (1.0 - full**2))
    return np.asarray(2.0 * share / (1.0 + np.sqrt(1.0 + 4.0 * share**2)))
