"""True places of the films in the pump, for pictures and VTU files."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class Frame:
    """Origin (m) and three orthonormal directions of a gap in the pump's frame, (3,) each.

    Pump frame: z is the shaft axis from valve plate to swash plate, the valve plate's face lies at z = 0 and x
    points to the inner dead centre.
    """

    origin: Array
    x: Array
    y: Array
    z: Array

    def plane(self, points: Array) -> Array:
        """Points (n, 2) m of a plane film -> (n, 3) m in the pump."""
        return self.origin + points[:, :1] * self.x + points[:, 1:] * self.y

    def cylinder(self, points: Array, radius: float) -> Array:
        """Points (n, 2) m of an unwrapped film (arc, axial) -> (n, 3) m on the cylinder about z in the pump."""
        angle = points[:, :1] / radius
        return self.origin + radius * (np.cos(angle) * self.x + np.sin(angle) * self.y) + points[:, 1:] * self.z
