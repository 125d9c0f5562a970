"""Ball guide and retainer: motion and force, Eqs. (10)-(13) and (23)-(25) of Xu, Hu, Zhang and Mao (2017).

The retainer follows the swash plate, tilted by the swash angle, on a ball guide that turns with the shaft. They
touch on a circle of latitude of the ball. Coordinates: x along the shaft, origin in the ball's centre; psi is the
angle round the retainer's own axis, zero in the plane of the largest tilt.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.laws.kinematics import Number

QUADRATURE_POINTS = 256
"""Points of the periodic rule round the contact circle: exact to round-off for the smooth speeds here."""


class RetainerMotion(Enum):
    """Rotation of the retainer's contact points."""

    RIGID = "rigid retainer turning at shaft speed"
    PRINTED = "paper Eq. (12): the contact point keeps the azimuth of the ball guide"


@dataclass(frozen=True)
class BallGuide:
    """Ball guide radius in m and latitude of the contact circle in rad (above the plane square to the shaft)."""

    radius: float
    contact_latitude: float


def contact_point(guide: BallGuide, swash_angle: float, psi: Array | float) -> Array:
    """Position op' of a contact point on the tilted retainer in m, shape (3, ...); paper Eq. (10)."""
    sl, cl = np.sin(guide.contact_latitude), np.cos(guide.contact_latitude)
    sg, cg = np.sin(swash_angle), np.cos(swash_angle)
    psi = np.asarray(psi, dtype=float)
    return guide.radius * np.stack([sl * cg + cl * sg * np.cos(psi), cl * cg * np.cos(psi) - sl * sg, cl * np.sin(psi)])


def relative_locus(guide: BallGuide, swash_angle: float, psi: Array | float) -> Array:
    """Motion locus op' - op of the retainer against its reference point in m, shape (3, ...); paper Eq. (10)."""
    return contact_point(guide, swash_angle, psi) - contact_point(guide, 0.0, psi)


def azimuth_rate_ratio(guide: BallGuide, swash_angle: Array | float, psi: Array | float) -> Array:
    """The paper's k(psi) = (dpsi/dt)/w of Eq. (12), for a contact point that keeps the ball guide's azimuth."""
    sl, cl = np.sin(guide.contact_latitude), np.cos(guide.contact_latitude)
    sg, cg = np.sin(swash_angle), np.cos(swash_angle)
    reach = cl * cg * np.cos(psi) - sl * sg
    return np.asarray((reach**2 + (cl * np.sin(psi)) ** 2) / (cl**2 * cg - sl * cl * sg * np.cos(psi)))


def relative_velocity(
    guide: BallGuide,
    swash_angle: Number,
    psi: Array | float,
    shaft_speed: Number,
    motion: RetainerMotion = RetainerMotion.RIGID,
) -> Array:
    """Sliding velocity of the retainer on the ball guide in m/s, shape (3, ...); paper Eq. (11).

    dV = d(op')/dt - w x op' with dpsi/dt = k w. RIGID has k = 1, the motion of a rigid body; PRINTED has k of Eq. (12),
    which no rigid body has. The wrong signs in the print follow from the cross product.
    """
    sl, cl = np.sin(guide.contact_latitude), np.cos(guide.contact_latitude)
    sg, cg = np.sin(swash_angle), np.cos(swash_angle)
    psi = np.asarray(psi, dtype=float)
    k = np.ones_like(psi)
    if motion is RetainerMotion.PRINTED:
        k = azimuth_rate_ratio(guide, swash_angle, psi)
    along = -k * sg * cl * np.sin(psi)
    across = (1.0 - k * cg) * cl * np.sin(psi)
    upward = (k - cg) * cl * np.cos(psi) + sl * sg
    return guide.radius * shaft_speed * np.stack([along, across, upward])


def mean_sliding_speed(
    guide: BallGuide, swash_angle: Number, shaft_speed: Number, motion: RetainerMotion = RetainerMotion.RIGID
) -> Number:
    """Mean of |dV| round the contact circle in m/s: Eq. (25) per unit of uniform normal force and friction."""
    psi = 2.0 * np.pi * np.arange(QUADRATURE_POINTS) / QUADRATURE_POINTS
    velocity = relative_velocity(guide, swash_angle, psi, shaft_speed, motion)
    speed = np.linalg.norm(velocity, axis=0)
    return np.mean(speed, axis=-1, keepdims=speed.ndim > 1)


def spring_force(preload: float, stiffness: float, compression: float) -> float:
    """Force of the block spring in N; paper Eq. (13) with preload = k dx0: F = k (dx0 + d_rb)."""
    return preload + stiffness * compression


def tipping_share(pistons: int) -> float:
    """Share of the retainer's normal force with which one slipper tips it about those across.

    The plate, free to tilt on its ball, then rests on that slipper and on those nearest to its opposite, c times
    the pitch radius beyond the ball: c/(1 + c), c = cos(pi/z) of two of them for an odd number z, else 1.
    """
    across = np.cos(np.pi / pistons) if pistons % 2 else 1.0
    return float(across / (1.0 + across))


def uniform_normal_force(spring: float, guide: BallGuide, tilt_cosine: float) -> float:
    """Sum of the contact's normal forces in N, spread evenly; paper Eq. (23) without its friction term.

    Eq. (23) alone does not fix the distribution. An even one gives sum F_n = F_s/(sin(l) cos(g)).
    tilt_cosine: cos(g).
    """
    return float(spring / (np.sin(guide.contact_latitude) * tilt_cosine))
