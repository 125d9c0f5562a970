"""Retainer and ball guide: force of the spring and friction, on guide and slippers.

The retainer turns with the shaft's speed about the plate's normal n, on a ball guide that turns about the shaft: they
slide by W = w (n - z) about the guide's centre, in which both axes meet. The normals of the contact's circle of
latitude have equal shares along n and no sum across, so the guide's axial balance gives the sum along n, F_s/cos g, at
any pressure. Friction -q dV/|dV|, with q spread evenly round the circle, is a force along the tilt axis and a moment;
its power is -q mean |dV|.

The retainer transmits both to the slippers, R n in their ball centres and H in the plane, with sum and moment
about the guide's centre in balance, and without friction on them: sum H . (v - w n x P) = 0. Of all such forces
the smallest in the sense of least squares are used: those of equal springs at the slippers, R even except for the
part that balances the moment.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.multibody.kinematics import BallMotion
from system.pump.laws.retainer import QUADRATURE_POINTS, BallGuide, uniform_normal_force

SAME = 1e-10  # share of the largest singular value below which a condition has no content


@dataclass(frozen=True)
class GuideContact:
    """Of the ball guide on the retainer: force (3,) N, normals and friction, and moment (3,) N m about its
    centre."""

    force: Array
    moment: Array


@dataclass(frozen=True)
class Hold:
    """Of the retainer on one slipper over N own shaft angles: pressing (N,) N along n, pushing (3, N) N in the
    plate; both in the ball centre."""

    pressing: Array
    pushing: Array


def contact_circle(guide: BallGuide, plate_axes: Array) -> Array:
    """Places (3, Q) m of the contact's circle about the guide's centre; plate_axes (3, 3) as
    `directions.plate_axes`."""
    psi = 2.0 * np.pi * np.arange(QUADRATURE_POINTS) / QUADRATURE_POINTS
    steepest, across, normal = plate_axes[:, :, None]
    level = np.cos(guide.contact_latitude) * (np.cos(psi) * steepest + np.sin(psi) * across)
    return np.asarray(guide.radius * (level + np.sin(guide.contact_latitude) * normal))


def guide_contact(guide: BallGuide, plate_axes: Array, speed: float, spring: float, loss: float) -> GuideContact:
    """The contact under a spring force (N) whose friction consumes `loss` (W) at a shaft speed (rad/s).

    A circle that does not slide (no tilt) has no friction.
    """
    pressed = spring / plate_axes[2, 2] * plate_axes[2]
    places = contact_circle(guide, plate_axes)
    turning = speed * (plate_axes[2] - np.array([0.0, 0.0, 1.0]))
    sliding = np.cross(turning, places, axisb=0, axisc=0)
    sizes = np.linalg.norm(sliding, axis=0)
    if loss == 0.0 or not np.all(sizes > 0.0):
        return GuideContact(pressed, np.zeros(3))
    friction = -loss / np.mean(sizes) * sliding / sizes
    moment = np.cross(places, friction, axis=0)
    return GuideContact(pressed + friction.mean(axis=1), moment.mean(axis=1))


def guide_loss(friction: float, spring: float, guide: BallGuide, plate_axes: Array, speed: float) -> float:
    """Coulomb's loss (W) by the guide's own balance: f F_s/(sin l cos g) mean |dV|.

    1/cos g of `pairs.ball_guide_coulomb`, REF90's nominal law (4 % at 16.2 deg).
    """
    turning = speed * (plate_axes[2] - np.array([0.0, 0.0, 1.0]))
    sliding = np.cross(turning, contact_circle(guide, plate_axes), axisb=0, axisc=0)
    normals = uniform_normal_force(spring, guide, plate_axes[2, 2])
    return float(friction * normals * np.mean(np.linalg.norm(sliding, axis=0)))


def hold(contact: GuideContact, motion: BallMotion, plate_axes: Array, speed: float, pistons: int) -> Hold:
    """Forces of the retainer on a slipper, over the shaft angles of `motion`, a multiple of the pistons."""
    step = motion.place.shape[1] // pistons
    flat = np.tensordot(plate_axes[:2], motion.place, axes=1)
    onward = np.stack([-flat[1], flat[0]])
    slip = np.tensordot(plate_axes[:2], motion.velocity, axes=1) - speed * onward
    radius = float(np.sqrt(np.mean(np.sum(flat**2, axis=0))))
    flat, onward, slip = (_all_slippers(one, step) for one in (flat / radius, onward / radius, slip / (radius * speed)))
    force, moment = plate_axes @ contact.force, plate_axes @ contact.moment / radius
    count = flat.shape[-1]
    ones, zeros = np.ones((1, pistons, count)), np.zeros((1, pistons, count))
    level = np.array([force[2], moment[0], moment[1]])
    pressing = _least(np.concatenate([ones, flat[1:], -flat[:1]]), level)
    along = np.concatenate([ones, zeros, onward[:1], slip[:1]])
    across = np.concatenate([zeros, ones, onward[1:], slip[1:]])
    in_plane = _least(np.concatenate([along, across], axis=1), np.array([force[0], force[1], moment[2], 0.0]))
    pushing = np.tensordot(plate_axes[:2].T, np.stack([in_plane[0], in_plane[pistons]]), axes=1)
    return Hold(pressing[0], pushing)


def _all_slippers(values: Array, step: int) -> Array:
    """Values (2, N) of one slipper over its own angles, of all z at each shaft angle: (2, z, N)."""
    pistons = values.shape[1] // step
    return np.stack([np.roll(values, -k * step, axis=1) for k in range(pistons)], axis=1)


def _least(conditions: Array, wanted: Array) -> Array:
    """The smallest x (n, N) with conditions (m, n, N) x = wanted (m,)."""
    inverse = np.linalg.pinv(np.moveaxis(conditions, -1, 0), rcond=SAME)
    return np.asarray(np.moveaxis(inverse @ wanted, 0, -1))
