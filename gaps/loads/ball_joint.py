"""The ball joint between piston and slipper, and piston side forces: loads of both films, friction of the joint.

Vectors (..., 3) in any right-handed frame, N, m, s; leading axes are instants. a is the bore's axis out of the block,
n the swash plate's normal away from the block, B the force of the piston on the slipper:

    slipper   m_s A   = B + G_s - lift n          piston   m_p a_p = -B + G_p + L,  L . a = 0

G are the known forces on either body. The slipper's motion in the plate fixes B there, the piston's along its bore
fixes the rest of B; the lift of the slipper's film and the force L of the bore follow.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.laws.law import require_positive
from reynolds.numerics.arrays import Array

LEAST_FACING = 0.1  # cosine between bore and plate normal: a plate steeper than 84 deg pushes no piston
CREEP = 0.01  # of the shaft's speed: spin at which the joint's friction has reached 1/sqrt 2 of its size
MOST_STEPS = 60
SETTLED = 1e-10  # of the shaft's speed
ROUNDING = 1e-14  # of the parts of the minimised sum: its round-off


@dataclass(frozen=True)
class DrivenBody:
    """Piston or slipper.

    mass kg; acceleration (..., 3) m/s2 of its centre of mass; force (..., 3) N, the sum of all forces on it but the
    joint's and its own film's.
    """

    mass: float
    acceleration: Array
    force: Array

    @property
    def lack(self) -> Array:
        """Force (..., 3) N required of joint and film together."""
        return self.mass * self.acceleration - self.force


@dataclass(frozen=True)
class BallForces:
    """Forces of joint and films, N.

    ball: force (..., 3) of the piston on the slipper; lift (...): of the slipper's film away from the plate, without
    other pressing forces (retainer, spring); side: force (..., 3) of the bore's film on the piston, across the bore.
    """

    ball: Array
    lift: Array
    side: Array


def ball_forces(bore_axis: Array, plate_normal: Array, piston: DrivenBody, slipper: DrivenBody) -> BallForces:
    """Forces of joint, slipper film and bore, from both bodies' balance of forces (module docstring).

    bore_axis (..., 3), plate_normal (3,).

    The ball's acceleration is the slipper's prescribed motion along the plate: growth and tilting of its film are
    neglected (1e-4 of the rest). Raises FilmInputError where the plate hardly faces the bore (n . a < 0.1).
    """
    facing = bore_axis @ plate_normal
    if not np.min(facing) >= LEAST_FACING:
        found = f"{np.min(facing):.3g}"
        raise FilmInputError("ball joint, plate normal along the bore", found, f"at least {LEAST_FACING}")
    pressing = slipper.lack @ plate_normal
    in_plate = slipper.lack - pressing[..., None] * plate_normal
    normal = -_along(piston.lack + in_plate, bore_axis) / facing
    ball = in_plate + normal[..., None] * plate_normal
    side = piston.lack + ball
    return BallForces(ball, normal - pressing, side - _along(side, bore_axis)[..., None] * bore_axis)


def _along(vectors: Array, axis: Array) -> Array:
    """Parts (...) of vectors (..., 3) along axes (..., 3)."""
    return np.asarray(np.sum(vectors * axis, axis=-1))


def swept_acceleration(
    place: Array, axis: Array, velocity: Array | float, acceleration: Array | float, shaft_speed: float
) -> Array:
    """Acceleration (..., 3) m/s2 of a point at `place` (..., 3) m that slides along an axis turning with the shaft.

    s'' a + 2 w s' z x a - w^2 (r - z z . r): along the bore, Coriolis (zero for a cylindrical block) and centripetal, z
    the shaft's axis. velocity s' (...) m/s, acceleration s'' (...) m/s2, shaft_speed w rad/s, constant.
    """
    along, gained = np.asarray(velocity)[..., None], np.asarray(acceleration)[..., None]
    inward = shaft_speed**2 * place * [1.0, 1.0, 0.0]
    around = np.cross([0.0, 0.0, 1.0], axis)
    return np.asarray(gained * axis + 2.0 * shaft_speed * along * around - inward)


def relative_spin(
    bore_axis: Array, plate_normal: Array, shaft_speed: float, piston_spin: float, slipper_spin: float
) -> Array:
    """Angular velocity (..., 3) rad/s of the slipper against the piston: s n - w z - s_p a.

    piston_spin s_p about its axis relative to the block, slipper_spin s about the plate's normal relative to the plate,
    both rad/s; the slipper's tilting is neglected.
    """
    return np.asarray(slipper_spin * plate_normal - shaft_speed * np.array([0.0, 0.0, 1.0]) - piston_spin * bore_axis)


def ball_friction(coefficient: float, force: Array | float, radius: float, spin: Array, shaft_speed: float) -> Array:
    """Moment (..., 3) N m of the joint's friction on the slipper, -mu |B| r W/|W|; its opposite acts on the piston.

    Coulomb's law on the ball's radius (m) under a force (...) N, W the relative spin (..., 3) rad/s; |W| is replaced by
    sqrt(W^2 + (0.01 w)^2), so that a joint at rest has no friction. Exact for a contact that is small compared with the
    ball and W normal to the force; contact over the whole socket has another factor, of order one.
    """
    size = coefficient * np.abs(force) * radius / _width(spin, shaft_speed)
    return np.asarray(-size[..., None] * spin)


def bore_drag(viscosity: float, diameter: float, length: float, clearance: float) -> float:
    """Torque per spin (N m s) of a piston centred in its bore, pi mu d^3 l/(4 c). Source: Petroff 1883."""
    require_positive("bore drag", viscosity=viscosity, diameter=diameter, length=length, clearance=clearance)
    return float(np.pi * viscosity * diameter**3 * length / (4.0 * clearance))


def land_drag(viscosity: float, inner_radius: float, outer_radius: float, film_thickness: float) -> float:
    """Torque per spin (N m s) of a parallel land, pi mu (r2^4 - r1^4)/(2 h)."""
    require_positive("land drag", viscosity=viscosity, outer_radius=outer_radius, film_thickness=film_thickness)
    return float(np.pi * viscosity * (outer_radius**4 - inner_radius**4) / (2.0 * film_thickness))


@dataclass(frozen=True)
class Spins:
    """Spin (rad/s) of the piston in its bore, relative to the block, and of the slipper on the plate."""

    piston: float
    slipper: float


def free_spins(
    bore_axis: Array,
    plate_normal: Array,
    shaft_speed: float,
    friction: Array,
    piston_drag: float,
    slipper_drag: float,
    stated: tuple[float | None, float | None] = (None, None),
    driven: tuple[float, float] = (0.0, 0.0),
) -> Spins:
    """The spins at which the joint's friction and both films' drag balance about bore and plate normal.

    bore_axis (n, 3) and friction mu |B| r (n,) N m of the joint are those at n equidistant shaft angles: the friction
    of a joint that nearly sticks depends on the swing of its axes. `stated`: spins (rad/s) of piston and slipper that
    are given; None: free. `driven`: torques T (N m) by which films turn piston and slipper that do not spin; drags: N m
    s, above zero. They are the least of mean(friction |W|) + (piston_drag s_p^2 + slipper_drag s^2)/2 - T . s, a convex
    function of both, found by Newton's method. A joint with more friction than the films holds the piston back against
    the block until neither turns in space (s = 0, s_p = -w on a cylindrical block); without friction neither is turned
    (s = s_p = 0). Quasi-steady: at a piston's inertia spins follow within some 1e-2 s, so that means over a turn belong
    here. Raises FilmInputError for a drag that is not positive, FilmNotConverged where Newton's method does not settle.
    """
    require_positive("free spins", shaft_speed=shaft_speed, piston_drag=piston_drag, slipper_drag=slipper_drag)
    free = np.array([spin is None for spin in stated])
    found = np.array([spin or 0.0 for spin in stated])
    turns = np.stack([-bore_axis, np.broadcast_to(plate_normal, bore_axis.shape)], axis=2)[:, :, free]
    still = np.array([relative_spin(axis, plate_normal, shaft_speed, found[0], found[1]) for axis in bore_axis])
    drag, torque = np.diag(np.array([piston_drag, slipper_drag])[free]), np.array(driven)[free]

    def spent(spins: Array) -> Array:
        rubbed = float(np.mean(friction * _width(still + turns @ spins, shaft_speed)))
        return np.array([rubbed, 0.5 * spins @ drag @ spins, -torque @ spins])

    spins = np.zeros(int(free.sum()))
    for _ in range(MOST_STEPS):
        relative = still + turns @ spins
        width = _width(relative, shaft_speed)
        pull = np.einsum("nij,ni->nj", turns, relative) / width[:, None]
        slope = np.mean(friction[:, None] * pull, axis=0) + drag @ spins - torque
        stiff = np.einsum("nij,nik->njk", turns, turns) - np.einsum("nj,nk->njk", pull, pull)
        bend = np.mean((friction / width)[:, None, None] * stiff, axis=0) + drag
        step = np.linalg.solve(bend, -slope)
        if np.max(np.abs(step), initial=0.0) < SETTLED * shaft_speed:
            found[free] = spins
            return Spins(float(found[0]), float(found[1]))
        parts = spent(spins)
        most = parts.sum() + ROUNDING * np.abs(parts).sum()
        while spent(spins + step).sum() > most + 1e-4 * float(slope @ step):
            step = 0.5 * step
        spins = spins + step
    raise FilmNotConverged(f"spins of piston and slipper not settled after {MOST_STEPS} steps", "given spin ratios")


def _width(spin: Array, shaft_speed: float) -> Array:
    return np.asarray(np.sqrt(np.sum(spin * spin, axis=-1) + (CREEP * shaft_speed) ** 2))


def lateral_force(guide_length: float, depth: Array | float, force: Array) -> Array:
    """Generalised forces (..., 4) N of a force (..., 2) N across the bore on the piston.

    It acts `depth` (...) m inside the case edge. P0 = G s/Lg, P1 = G (1 - s/Lg): a force outside the guide (s < 0)
    pulls its ends opposite ways.
    """
    share = np.asarray(depth / guide_length)[..., None]
    return np.concatenate([share * force, (1.0 - share) * force], axis=-1)


def lateral_moment(guide_length: float, moment: Array) -> Array:
    """Generalised forces (..., 4) N of a moment (..., 2) N m on the piston, about axes across the bore.

    P0 = a x M/Lg = -P1, a the bore's axis out of the block.
    """
    couple = np.stack([-moment[..., 1], moment[..., 0]], axis=-1) / guide_length
    return np.concatenate([couple, -couple], axis=-1)
