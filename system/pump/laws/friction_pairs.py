"""The seven friction pairs: one law for each, and Eq. (22) of Xu, Hu, Zhang and Mao (2017) for the mean.

Every loss is Coulomb friction, f x normal force x sliding speed, plus the shear of a Newtonian film of given
thickness. All functions work on arrays over shaft angle; forces in N, speeds in m/s, losses in W.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, Generic, cast

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.laws.kinematics import Number


class Pair(Enum):
    """The friction pairs by their field in `FrictionPairs`, in the order of every table and plot."""

    PISTON_CYLINDER = "piston_cylinder"
    SLIPPER_SWASH_PLATE = "slipper_swash_plate"
    VALVE_PLATE_CYLINDER = "valve_plate_cylinder"
    BALL_GUIDE_RETAINER = "ball_guide_retainer"
    PISTON_SLIPPER_SOCKET = "piston_slipper_socket"
    FRONT_BEARING = "front_bearing"
    REAR_BEARING = "rear_bearing"

    @property
    def words(self) -> str:
        """Name for people, both parts of the pair with a hyphen."""
        return _WORDS.get(self, self.value.replace("_", " "))


_WORDS = {
    Pair.PISTON_CYLINDER: "piston-cylinder",
    Pair.SLIPPER_SWASH_PLATE: "slipper-swash plate",
    Pair.VALVE_PLATE_CYLINDER: "valve plate-cylinder",
    Pair.BALL_GUIDE_RETAINER: "ball guide-retainer",
    Pair.PISTON_SLIPPER_SOCKET: "piston-slipper socket",
}


@dataclass(frozen=True)
class PairLoss(Generic[Number]):
    """Loss of one pair over equidistant shaft angles in W, Coulomb and viscous part, and the number of pairs.

    `count` is z for the pistons' and slippers' pairs, whose arrays belong to one of them (the mean of all where
    chambers differ), and 1 for the others. PairLoss[Array]: at N operating points, each over its M angles, (N, M);
    means (N,).
    """

    count: int
    coulomb: Array
    viscous: Array

    @property
    def mean_coulomb(self) -> Number:
        """Mean Coulomb loss of all such pairs in W, paper Eq. (22)."""
        return cast(Number, revolution_mean(self.coulomb, self.count))

    @property
    def mean_viscous(self) -> Number:
        """Mean viscous loss of all such pairs in W, paper Eq. (22)."""
        return cast(Number, revolution_mean(self.viscous, self.count))

    @property
    def mean(self) -> Number:
        """Mean loss of all such pairs in W, paper Eq. (22)."""
        return self.mean_coulomb + self.mean_viscous

    @property
    def quadrature_error(self) -> Number:
        """Estimate for `mean` in W: its change when every second shaft angle is left out."""
        total = self.coulomb + self.viscous
        return cast(Number, abs(revolution_mean(total, self.count) - revolution_mean(total[..., ::2], self.count)))


@dataclass(frozen=True)
class FrictionPairs(Generic[Number]):
    """The losses of the seven pairs, in the order of `Pair`."""

    piston_cylinder: PairLoss[Number]
    slipper_swash_plate: PairLoss[Number]
    valve_plate_cylinder: PairLoss[Number]
    ball_guide_retainer: PairLoss[Number]
    piston_slipper_socket: PairLoss[Number]
    front_bearing: PairLoss[Number]
    rear_bearing: PairLoss[Number]

    def loss(self, pair: Pair) -> PairLoss[Number]:
        """The loss of one pair."""
        return getattr(self, pair.value)

    @property
    def power(self) -> Number:
        """Mean loss of all pairs in W: the hydromechanical loss."""
        return cast(Number, sum(self.loss(pair).mean for pair in Pair))

    def share(self, pair: Pair) -> Number:
        """Share of one pair in the hydromechanical loss."""
        return self.loss(pair).mean / self.power


def revolution_mean(loss: Array, count: int) -> Any:
    """Mean power of `count` equal pairs in W; paper Eq. (22) by the periodic trapezoidal rule.

    A float for a loss (M,) over the angles, (N,) for (N, M). Spectrally accurate where the loss is smooth, second
    order in the angle step at its bends.
    """
    mean = np.mean(loss, axis=-1)
    return count * (float(mean) if loss.ndim == 1 else mean)


def over_chambers(values: Sequence[Array], pistons: int) -> Array:
    """Sum (..., N) of a periodic quantity over all chambers, each 2 pi/z further on; N a multiple of z.

    values: (..., N) over a chamber's own angle, of one chamber for all z or of each.
    """
    *points, samples = values[0].shape
    pitch = samples // pistons
    if len(values) == 1:
        return np.tile(values[0].reshape(*points, pistons, pitch).sum(axis=-2), pistons)
    return np.asarray(sum(np.roll(own, -k * pitch, axis=-1) for k, own in enumerate(values)))


def axial_force(
    pressure: Array, case_pressure: Array | float, piston_area: float, mass: float, acceleration: Array
) -> Array:
    """Force Fa = Ap (p - p_case) - m a of a piston with its slipper on the swash plate, along the bore.

    `acceleration` m/s2 is `kinematics.ball_acceleration_along_bore`: the mass counts at the ball.
    """
    return piston_area * (pressure - case_pressure) - mass * acceleration


def side_force(axial: Array, swash_angle: Array | float) -> Array:
    """Size of the swash plate's side force on a piston: |Fa| tan(gamma)."""
    return np.abs(axial) * np.tan(swash_angle)


def piston_cylinder_coulomb(
    friction: float, side: Array, engaged_length: Array, overhang: Array, velocity: Array
) -> Array:
    """Loss f Fs (l + 2c)/l |v|: the side force, c outside the bore, is held by reactions at both ends of l."""
    return friction * side * (engaged_length + 2.0 * overhang) / engaged_length * np.abs(velocity)


def piston_cylinder_shear(
    viscosity: Array | float,
    piston_diameter: float,
    engaged_length: Array,
    velocity: Array,
    radial_clearance: float,
    eccentricity_ratio: float,
) -> Array:
    """Shear loss mu pi dp l v^2/(delta sqrt(1 - eps^2)) of a parallel eccentric annulus (Petroff, Sommerfeld)."""
    area = np.pi * piston_diameter * engaged_length
    return viscosity * area * velocity**2 / (radial_clearance * np.sqrt(1.0 - eccentricity_ratio**2))


def slipper_swash_plate_coulomb(friction: float, axial: Array, swash_angle: Array | float, speed: Array) -> Array:
    """Loss f |Fa|/cos(gamma) v_s of one slipper on the swash plate."""
    return friction * np.abs(axial) / np.cos(swash_angle) * speed


def slipper_swash_plate_shear(viscosity: Array | float, land_area: float, speed: Array, film_thickness: float) -> Array:
    """Shear loss mu A v_s^2/delta of one slipper's lands, A = pi (r2^2 - r1^2) in m2 of a single one."""
    return viscosity * land_area * speed**2 / film_thickness


def piston_slipper_socket_coulomb(
    friction: float, axial: Array, swash_angle: Number, ball_radius: float, shaft_speed: Number
) -> Array:
    """Loss f |Fa|/cos(gamma) r_ball w sin(gamma): the slipper tilts once per turn on its ball."""
    return friction * np.abs(axial) / np.cos(swash_angle) * ball_radius * shaft_speed * np.sin(swash_angle)


def clamping_force(pressure_force: Array, residual_clamping: float, spring: float) -> Array:
    """Force that the valve plate bears as contact: the unbalanced part of the pressure force, and the spring."""
    return residual_clamping * pressure_force + spring


def valve_plate_coulomb(friction: float, clamping: Array, shaft_speed: Array | float, mean_radius: float) -> Array:
    """Loss f N w R_v of the block on the valve plate."""
    return friction * np.abs(clamping) * shaft_speed * mean_radius


def valve_plate_shear(
    viscosity: Number,
    land_radii: tuple[float, float, float, float],
    shaft_speed: Number,
    mean_radius: float,
    film_thickness: float,
) -> Number:
    """Shear loss mu A_lands (w R_v)^2/delta of both sealing lands, taken at the mean radius.

    REF90's nominal law; the integral of r^2 over lands far from the mean radius is larger (13 % on REF90).
    """
    r1, r2, r3, r4 = land_radii
    lands = np.pi * (r2**2 - r1**2 + r4**2 - r3**2)
    return viscosity * lands * (shaft_speed * mean_radius) ** 2 / film_thickness


def pads_shear(viscosity: Number, area: float, mean_speed: Number, film_thickness: float) -> Number:
    """Shear loss mu A (w R_m)^2/delta of outer bearing pads, at the speed (m/s) on their mean radius."""
    return viscosity * area * mean_speed**2 / film_thickness


def ball_guide_coulomb(friction: float, spring: float, contact_latitude: float, mean_sliding_speed: Number) -> Number:
    """Loss f F_s/sin(latitude) mean|dV| of ball guide and retainer.

    REF90's nominal law: it omits the cos(gamma) of Eq. (23) (see `retainer.uniform_normal_force`, 4 % at 16.2 deg).
    Independent of pressure.
    """
    return friction * spring / np.sin(contact_latitude) * mean_sliding_speed


def bearing_coulomb(
    friction: float, share: float, side_sum: Array, shaft_speed: Array | float, diameter: float
) -> Array:
    """Loss f share sum(Fs) w d/2 of one shaft bearing that bears its share of all pistons' side forces."""
    return friction * share * side_sum * shaft_speed * diameter / 2.0
