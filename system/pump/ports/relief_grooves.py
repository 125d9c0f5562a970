"""Relief grooves of the valve plate's ports: the throat between a groove and the kidney that passes over it.

A groove begins where it has no depth, sinks evenly to its full depth, and ends in the port; ahead of the port's
kidney or, shutting last, behind it. Its throat is the section under the kidney's edge square to the bottom, the
narrowest that the oil passes.
"""

from dataclasses import dataclass

import numba
import numpy as np

from reynolds.numerics.arrays import Array

SIZE = 4
"""Numbers of a groove as compiled code reads it: begins, deep, scale, roundness."""


@dataclass(frozen=True)
class ReliefGroove:
    """A groove by the angles (rad, from its port's dead centre) at which it begins and at which it is deepest.

    begins > deep: behind the port. Throat at a share x of the way: area x^2 where `roundness` is 0, else
    area times the segment of depth x of a circle of that radius (`segment_area`). area in m2.
    """

    begins: float
    deep: float
    area: float
    roundness: float = 0.0

    @property
    def largest(self) -> float:
        """Throat at the deepest place, m2."""
        return float(throat_area(self.deep, self.row))

    @property
    def row(self) -> Array:
        """The groove as compiled code reads it."""
        return np.array([self.begins, self.deep, self.area, self.roundness])

    @property
    def breaks(self) -> tuple[float, ...]:
        """Angles (rad) at which the law changes."""
        ends = (self.begins, self.deep)
        if 0.0 < self.roundness < 1.0:
            return (*ends, self.begins + self.roundness * (self.deep - self.begins))
        return ends


def v_groove(begins: float, deep: float, depth: float, angle: float, radius: float) -> ReliefGroove:
    """A groove of triangular section, `angle` (rad) between its flanks, sinking to `depth` (m) along a radius (m).

    Throat d^2 tan(angle/2) cos(slope), tan(slope) = depth/(radius |deep - begins|): the triangle of depth d under
    the kidney's edge, leant square to the bottom.
    """
    return ReliefGroove(begins, deep, _leant(begins, deep, depth, radius) * depth**2 * np.tan(0.5 * angle))


def round_groove(begins: float, deep: float, depth: float, width: float, radius: float) -> ReliefGroove:
    """A groove cut by a round tool of `width` (m), sinking to `depth` (m) along a radius (m).

    Throat: the circular segment under the kidney's edge, below half a width upright walls, leant as `v_groove`.
    """
    return ReliefGroove(begins, deep, _leant(begins, deep, depth, radius) * depth**2, 0.5 * width / depth)


def _leant(begins: float, deep: float, depth: float, radius: float) -> float:
    """Cosine of the bottom's slope."""
    way = radius * abs(deep - begins)
    return way / float(np.hypot(way, depth))


@numba.njit("f8(f8,f8)", cache=True)
def segment_area(depth, radius):  # type: ignore[no-untyped-def]
    """Area of the segment of a circle cut `depth` deep, with upright walls from its middle on."""
    if depth >= radius:
        return 0.5 * np.pi * radius * radius + 2.0 * radius * (depth - radius)
    left = radius - depth
    return radius * radius * np.arccos(left / radius) - left * np.sqrt(depth * (radius + left))


@numba.njit("f8(f8,f8[:])", cache=True)
def throat_area(angle, groove):  # type: ignore[no-untyped-def]
    """Throat (m2) at an angle (rad) from the port's dead centre; `groove` is a `ReliefGroove.row`."""
    part = min((angle - groove[0]) / (groove[1] - groove[0]), 1.0)
    if part <= 0.0:
        return 0.0
    if groove[3] == 0.0:
        return groove[2] * part * part
    return groove[2] * segment_area(part, groove[3])
