"""Can a block stand on its valve plate? Closed forms of the lift of a parallel film against the pistons.

Kidneys and webs at the chambers' pressure, spread evenly around; a logarithm over either land. Half a turn at
delivery pressure, half at suction pressure; a cylindrical block, the spline in the plane of the ball centres.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

LandRadii = tuple[float, float, float, float]


class LandLift(NamedTuple):
    """Integrals of p r dr (m2) and p r^2 dr (m3) over both lands and the kidneys, per unit pressure."""

    force: float
    moment: float


def land_lift(radii: LandRadii) -> LandLift:
    """Lift per angle (rad) and pressure of a parallel film between radii R1 < R2 < R3 < R4 (m).

    p = 1 from R2 to R3, ln(R4/r)/ln(R4/R3) beyond, ln(r/R1)/ln(R2/R1) within.
    """
    r1, r2, r3, r4 = radii
    outer, inner = np.log(r4 / r3), np.log(r2 / r1)
    return LandLift(
        float((r4**2 - r3**2) / (4.0 * outer) - (r2**2 - r1**2) / (4.0 * inner)),
        float((r4**3 - r3**3) / (9.0 * outer) - (r2**3 - r1**3) / (9.0 * inner)),
    )


@dataclass(frozen=True)
class BlockBalance:
    """Lift against press: land radii (m), number of pistons, their area (m2) and pitch radius (m)."""

    land_radii: LandRadii
    pistons: int
    piston_area: float
    pitch_radius: float

    @property
    def force_ratio(self) -> float:
        """Lift over the pistons' force."""
        return 2.0 * np.pi / self.pistons * land_lift(self.land_radii).force / self.piston_area

    @property
    def lift_radius(self) -> float:
        """Radius (m) at which a sector lifts."""
        lift = land_lift(self.land_radii)
        return lift.moment / lift.force

    @property
    def moment_ratio(self) -> float:
        """Moment of the lift over that of the pistons."""
        return self.force_ratio * self.lift_radius / self.pitch_radius

    def pressed_at(self, delivery: float, suction: float, spring: float) -> float:
        """Distance from the shaft (m) at which what the film does not lift presses; pressures over the case's, Pa.

        F = z Ap (pd + ps)/2 (1 - B) + spring (N), M = z Ap (pd - ps)/pi R (1 - B_M). Beyond R4 no film without
        hydrodynamic lift can hold it: the block tips. Infinite where nothing presses (F <= 0: it lifts off).
        """
        area = self.pistons * self.piston_area
        force = 0.5 * area * (delivery + suction) * (1.0 - self.force_ratio) + spring
        moment = area * (delivery - suction) / np.pi * self.pitch_radius * (1.0 - self.moment_ratio)
        return float(abs(moment) / force) if force > 0.0 else np.inf
