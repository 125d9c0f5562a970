"""Tipping of a block on its valve plate: lift of a parallel film against the pistons.

Kidneys and webs at the chambers' pressure, spread evenly around; a logarithm over either land. Half a turn at
delivery pressure, half at suction pressure; a cylindrical block, the spline in the plane of the ball centres.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from reynolds.fem.sphere import PLANE, Sphere
from reynolds.numerics.arrays import Array

LandRadii = tuple[float, float, float, float]


class LandLift(NamedTuple):
    """Integrals of p r dr (m2) and p r^2 dr (m3) over both lands and the kidneys, per unit pressure."""

    force: float
    moment: float


def land_lift(radii: LandRadii, sphere: Sphere = PLANE) -> LandLift:
    """Lift per angle (rad) and pressure of a parallel film between radii R1 < R2 < R3 < R4 (m).

    p = 1 from R2 to R3, ln(R4/r)/ln(R4/R3) beyond, ln(r/R1)/ln(R2/R1) within; on a sphere these are logarithms of
    tan(t/2) of the polar angle, the force is that along the shaft, the moment, about the face's middle, int
    p r^2/(1 - r^2/R^2)^(1/2) dr.
    """
    r1, r2, r3, r4 = radii
    lands = (_land(r2, r1, sphere), _between(r2, r3, sphere, lambda r: np.ones_like(r)), _land(r3, r4, sphere))
    return LandLift(sum(land.force for land in lands), sum(land.moment for land in lands))


def _land(high: float, low: float, sphere: Sphere) -> LandLift:
    """The same of a land whose pressure falls from one to zero."""
    top, bottom = np.log(high * sphere.stretch(high)), np.log(low * sphere.stretch(low))
    first, last = min(high, low), max(high, low)
    return _between(first, last, sphere, lambda r: (np.log(r * sphere.stretch(r)) - bottom) / (top - bottom))


def _between(first: float, last: float, sphere: Sphere, pressure: Callable[[Array], Array]) -> LandLift:
    node, weight = np.polynomial.legendre.leggauss(32)  # smooth: exact to round-off
    r = 0.5 * (first + last) + 0.5 * (last - first) * node
    lifts = 0.5 * (last - first) * weight * pressure(r) * r
    return LandLift(float(lifts.sum()), float(lifts @ (r / np.sqrt(1.0 - (r / sphere.radius) ** 2))))


@dataclass(frozen=True)
class BlockBalance:
    """Lift against press: land radii (m), number of pistons, their area (m2) and pitch radius (m).

    Moments count about the spline, whose height (m) over the plate matters on a `sphere` alone.
    """

    land_radii: LandRadii
    pistons: int
    piston_area: float
    pitch_radius: float
    sphere: Sphere = PLANE
    spline_height: float = 0.0

    @property
    def force_ratio(self) -> float:
        """Lift over the pistons' force."""
        return 2.0 * np.pi / self.pistons * land_lift(self.land_radii, self.sphere).force / self.piston_area

    @property
    def lift_radius(self) -> float:
        """Lever (m) about the face's middle with which a sector lifts; in a plane the radius."""
        lift = land_lift(self.land_radii, self.sphere)
        return lift.moment / lift.force

    @property
    def moment_ratio(self) -> float:
        """Moment of the lift over that of the pistons."""
        return self._leverage * self.force_ratio * self.lift_radius / self.pitch_radius

    @property
    def _leverage(self) -> float:
        return 1.0 + self.spline_height / self.sphere.radius

    def lift(self, places: Array, above: Array) -> Array:
        """(F_z N, moments about x and y through the spline N m) of the lands' lift, a sector of each chamber.

        places: angles (z,) rad of the chambers; above: their pressures (z,) Pa over the case's.
        """
        land = land_lift(self.land_radii, self.sphere)
        forces = 2.0 * np.pi / self.pistons * land.force * above
        lever = self._leverage * self.lift_radius
        return np.array([forces.sum(), lever * (forces @ np.sin(places)), -lever * (forces @ np.cos(places))])

    def pressed_at(self, delivery: float, suction: float, spring: float) -> float:
        """Distance from the shaft (m) of the force that the film does not balance; pressures over the case's, Pa.

        F = z Ap (pd + ps)/2 (1 - B) + spring (N), M = z Ap (pd - ps)/pi R (1 - B_M), placed as `pressed_by` does.
        """
        area = self.pistons * self.piston_area
        force = 0.5 * area * (delivery + suction) * (1.0 - self.force_ratio) + spring
        moment = area * (delivery - suction) / np.pi * self.pitch_radius * (1.0 - self.moment_ratio)
        return self.pressed_by(force, moment)

    def pressed_by(self, force: float, moment: float) -> float:
        """Distance from the shaft (m) at which a force (N) with a moment about the spline (N m) presses.

        Beyond the face no film without hydrodynamic lift can hold it: the block tips. Infinite without a pressing force
        (F <= 0: the block lifts off).
        """
        if force <= 0.0:
            return np.inf
        lever = abs(moment) / (force * self._leverage)
        return float(lever / np.hypot(1.0, lever / self.sphere.radius))

    def force_within(self, radius: float, moment: float) -> float:
        """Force (N) that with a moment about the spline (N m) presses at a distance (m) from the shaft."""
        return float(abs(moment) * np.sqrt(1.0 - (radius / self.sphere.radius) ** 2) / (radius * self._leverage))
