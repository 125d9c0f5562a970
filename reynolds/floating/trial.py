"""A floating film tried at one position: its forces, which are to balance, and their exact slopes."""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from reynolds.equation.deformation import touch_at
from reynolds.equation.thickness_kernels import mixed
from reynolds.errors import FilmNotConverged
from reynolds.floating.coordinates import (
    ContactForce,
    Modes,
    SoftContact,
    contact_force,
    generalised_force,
    modes_on,
    soft_contact,
)
from reynolds.floating.pockets import filled, pockets_grown
from reynolds.floating.pose import THINNEST, PosedFilm, deformed_pose, lowest_gap, posed
from reynolds.floating.problem import Floating, Outer
from reynolds.floating.sensitivity import FilmSensitivity, oil_slopes, response, thickness_load
from reynolds.linear.factor import ITERATIVE_TOLERANCE
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmProblem, FilmSolution, Storage, holds_oil
from reynolds.solve.solver import FilmSolver, as_given

LEAST_SHARE = 0.2  # of the least gap that a step may leave
DEEPEST = 3.0  # standard deviations of the summits by which a step may press the walls together
NEXT = 1e-2  # of the least film or of the summits' height
SOFT_TOLERANCE = 1e-6  # of slopes between elastic walls, which only steer the turn's closure
TOUCHING = "asperities that bear where walls touch, an edge relief, a finer mesh, or less load"
ROUNDING = 1e-6  # share of the largest magnitude below which another counts as zero


@dataclass(frozen=True)
class StepStart:
    """State of a floating film between two steps.

    oil (size,) m3 at reference density, position q (k,) m and, where the walls have inertia, rate dq/dt (k,) m/s;
    also changes of them, (size, m) and so on.
    """

    oil: Array
    position: Array
    rate: Array


def joined(floating: Floating, held: StepStart) -> Array:
    """The state as one vector, or its changes as columns."""
    parts = [held.oil, held.position] if floating.inertia is None else [held.oil, held.position, held.rate]
    return np.concatenate(parts)


def parted(floating: Floating, held: Array, size: int) -> StepStart:
    """The inverse of `joined`, for a film of so many unknowns."""
    k = len(held) - size if floating.inertia is None else (len(held) - size) // 2
    oil, position, rate = held[:size], held[size : size + k], held[size + k :]
    return StepStart(oil, position, np.zeros_like(position) if floating.inertia is None else rate)


@dataclass(frozen=True)
class Trial:
    """A film at a position q (k,) m and rate m/s over the step.

    gap (cells, points) m between the mean planes, deformation included, corner_gap (vertices,) m the same where
    it is known, least the smallest of both; thicker (cells, points, k): growth of the film by q at constant
    pressure; film_force Q (k,) N without contact; missing (k,) N: residual of the balance, and `size` (k,) N, the
    magnitudes in it.
    """

    q: Array
    rate: Array
    gap: Array
    corner_gap: Array | None
    least: float
    thicker: Array
    solution: FilmSolution
    film_force: Array
    contact: ContactForce | None
    outer: Outer
    missing: Array
    size: Array

    @property
    def missed(self) -> float:
        """Largest imbalance over the magnitudes that balance."""
        return float(np.max(np.abs(self.missing) / self.scale))

    @property
    def scale(self) -> Array:
        """Magnitudes that balance (k,) N, at least the round-off of the largest."""
        return force_scale(self.size)


class Posed(Protocol):
    """Gap of a film at a position: at its points (cells, points) and corners (vertices,) m, and the least."""

    @property
    def gap(self) -> Array:
        """At the points, m."""

    @property
    def corner_gap(self) -> Array | None:
        """At the vertices, m; None where it is not known."""

    @property
    def least(self) -> float:
        """The least of both, m."""


def force_scale(size: Array) -> Array:
    """Magnitudes that balance (k,) N, raised at least to the round-off of the largest."""
    return np.maximum(size, ROUNDING * float(np.max(size)) + 1e-300)


@dataclass(frozen=True)
class FloatingInstant:
    """A floating film at a time (s): its shape, and its state one implicit step (s) before."""

    solver: FilmSolver
    floating: Floating
    time: float
    step: float
    shape: FilmProblem
    modes: Modes
    before: StepStart

    def tried(self, q: Array, warm: FilmSolution | None) -> Trial:
        """The film at a position; raises FilmNotConverged where walls overlap or the film does not converge."""
        at = posed(self.shape, self.modes, q)
        if self.shape.walls is None and not at.least > lowest_gap(self.shape):
            raise FilmNotConverged(f"walls that touch: least gap {at.least:.3g} m", TOUCHING)
        return self._balanced(q, at, self.solver.solve(self._problem(q, at), warm))

    def _problem(self, q: Array, at: PosedFilm) -> FilmProblem:
        """The film at a position, an implicit step after the state before."""
        storage = Storage(self.before.oil, self.step)
        boundary = filled(self.floating, self.shape, q)
        return replace(self.shape, film=at.film, asperities=at.asperities, boundary=boundary, storage=storage)

    def _balanced(self, q: Array, at: PosedFilm, solution: FilmSolution) -> Trial:
        reference, contact = self.floating.reference, self._contact(at, solution)
        if self.shape.walls is not None:
            at = deformed_pose(at, solution, contact)
        rate = (q - self.before.position) / self.step
        force = generalised_force(solution.pressure, self.modes, reference)
        outer = self.floating.outer_at(self.time, q, rate)
        missing, size = self.balance_of(solution.pressure, force, contact, outer, rate)
        return Trial(
            q, rate, at.gap, at.corner_gap, at.least, at.thicker, solution, force, contact, outer, missing, size
        )

    def balance_of(
        self, pressure: Array, force: Array, contact: ContactForce | None, outer: Outer, rate: Array
    ) -> tuple[Array, Array]:
        """Residual of the forces' balance (k,) N, and the magnitudes in it (k,) N.

        `force` (k,) N: that of film pressures (size,) Pa.
        """
        pushed = self.inertia_force(rate)
        size = np.abs(pressure - self.floating.reference) @ np.abs(self.modes.weights)
        missing, size = force + outer.force + pushed, size + np.abs(outer.force) + np.abs(pushed)
        if contact is not None:
            missing, size = missing + contact.force, size + contact.size
        return missing, size

    def inertia_force(self, rate: Array) -> Array:
        """-M q'' (k,) N of a rate (k,) m/s over the step."""
        if self.floating.inertia is None:
            return np.zeros_like(rate)
        return np.asarray(-self.floating.inertia @ (rate - self.before.rate) / self.step)

    def _contact(self, at: PosedFilm, solution: FilmSolution) -> ContactForce | None:
        if self.shape.asperities is None:
            return None
        if self.shape.walls is None:
            return contact_force(self.shape.asperities, at.gap, self.modes)
        return soft_contact(touch_at(solution.problem, solution.deformation), self.modes)

    def room(self, at: Trial, step: Array, film: FilmSensitivity) -> float:
        """The share of a step (k,) m, maybe more than one, that leaves as much gap as one step may take.

        Elastic walls follow the pressure of the step, `film` per unit of it.
        """
        return room_within(self.shape, at, self.grown(at, film) @ step)

    def grown(self, at: Trial, film: FilmSensitivity) -> Array:
        """Growth of the gap by each coordinate at the vertices, (vertices, k), elastic walls following."""
        if self.shape.walls is None:
            return self.modes.at_vertices
        if isinstance(at.contact, SoftContact):
            return at.contact.deformation(film.pressure) + at.contact.grown
        return self.shape.walls.matrix @ film.pressure + self.modes.at_vertices

    def ahead(self, at: Trial, step: Array, film: FilmSensitivity) -> FilmSolution:
        """The film a step (k,) m on along its slopes: a first guess of the film there.

        Between elastic walls a step at constant pressure would close the gap by all of it.
        """
        found = at.solution
        pressure = np.where(found.held, found.pressure, found.pressure + film.pressure @ step)
        fraction, level = found.film_fraction + film.film_fraction @ step, found.problem.cavitation_pressure
        cavity = found.cavity
        if found.problem.cavitation is Cavitation.JFO:  # unknowns that fill up, and that cavitate
            cavity = np.where(cavity, fraction < 1.0, ~found.held & (pressure < level))
        if found.problem.cavitation is not Cavitation.NONE:
            pressure = np.maximum(pressure, level)
        fraction = np.clip(fraction, 0.0, 1.0)
        found = replace(found, cavity=cavity)
        if found.problem.walls is None:
            return replace(found, pressure=pressure, film_fraction=fraction)
        opened = found.deformation + (self.grown(at, film) - self.modes.at_vertices) @ step
        return replace(found, pressure=pressure, film_fraction=fraction, deformation=opened)

    def moved(self, at: Trial, step: Array, film: FilmSensitivity) -> FilmSolution:
        """The film a step (k,) m on along its slopes, its flows those of these pressures."""
        q = at.q + step
        return as_given(self._problem(q, posed(self.shape, self.modes, q)), self.ahead(at, step, film))

    def touching(self, at: Posed) -> bool:
        """True where the film is nearly closed, or contact is near the end of its law."""
        asperities = self.shape.asperities
        height = THINNEST if asperities is None else asperities.height
        return at.least - lowest_gap(self.shape) < NEXT * height

    @property
    def exactness(self) -> float:
        """Tolerance of linear solves for slopes, which are costly between elastic walls."""
        return ITERATIVE_TOLERANCE if self.shape.walls is None else SOFT_TOLERANCE

    def by_position(self, at: Trial, tolerance: float) -> FilmSensitivity:
        """Sensitivity of the film to the position, by the film's last factor, to a tolerance of linear solves."""
        parts = self.solver.operators(at.solution)
        load = thickness_load(at.solution, at.thicker, parts) + pockets_grown(at.solution, self.modes) / self.step
        return response(self.solver, at.solution, -load, tolerance)

    def slopes(self, at: Trial, film: FilmSensitivity) -> Array:
        """d missing/dq, (k, k) N/m."""
        total = self.stiffness(self.film_slopes(film), at.contact, at.outer)
        return total if at.contact is None else total + at.contact.by_pressure(film.pressure)

    def stiffness(self, of_film: Array, contact: ContactForce | None, outer: Outer) -> Array:
        """d missing/dq, (k, k) N/m, except for contact by the film's pressure; of_film: dQ/dq without contact."""
        total = of_film + outer.by_position + outer.by_rate / self.step
        if contact is not None:
            total = total + contact.slopes
        if self.floating.inertia is not None:
            total = total - self.floating.inertia / self.step**2
        return np.asarray(total)

    def film_slopes(self, film: FilmSensitivity) -> Array:
        """dQ/dq without contact, (k, k) N/m."""
        return np.asarray(self.modes.weights.T @ film.pressure)

    def oil_moved(self, at: Trial, own: FilmSensitivity, moved: Array) -> Array:
        """Change of the unknowns' oil, (size, m) m3, with the position (k, m) m alone."""
        both = FilmSensitivity(own.pressure @ moved, own.film_fraction @ moved)
        return self._oil_by(at, both, moved)

    def _oil_by(self, at: Trial, both: FilmSensitivity, moved: Array) -> Array:
        """Change of the unknowns' oil, pockets included, with film and position (k, m) m."""
        thicker = mixed(at.thicker, np.ascontiguousarray(moved))
        oil = oil_slopes(at.solution, thicker, both, self.solver.operators(at.solution))
        return np.asarray(oil + pockets_grown(at.solution, self.modes) @ moved)

    def by_before(self, at: Trial, changed: StepStart) -> tuple[FilmSensitivity, Array]:
        """Change of the film and of `missing` (k, m) with the state before, at constant position."""
        film = response(self.solver, at.solution, changed.oil / self.step, self.exactness)
        pressed = self.film_slopes(film)
        if at.contact is not None:
            pressed = pressed + at.contact.by_pressure(film.pressure)
        return film, self.missing_by_before(at, pressed, changed)

    def missing_by_before(self, at: Trial, pressed: Array, changed: StepStart) -> Array:
        """Change of `missing` (k, m) with the state before, at constant position.

        pressed (k, m) N: change of the forces of film and contact by the film's change.
        """
        missing = pressed - at.outer.by_rate @ changed.position / self.step
        if self.floating.inertia is not None:
            missing += self.floating.inertia @ (changed.position / self.step + changed.rate) / self.step
        return np.asarray(missing)

    def onward(self, at: Trial, own: FilmSensitivity, slopes: Array, changed: StepStart) -> StepStart:
        """Change of the state at the end of the step with that before it, in balance.

        `own` and `slopes`: sensitivities of film and forces to the position.
        """
        film, missing = self.by_before(at, changed)
        q = -solved(slopes, missing, self.floating.name)
        both = FilmSensitivity(film.pressure + own.pressure @ q, film.film_fraction + own.film_fraction @ q)
        return StepStart(self._oil_by(at, both, q), q, (q - changed.position) / self.step)


def room_within(shape: FilmProblem, at: Posed, growth: Array) -> float:
    """The share of a growth of the gap (vertices,) m, maybe more than one, that leaves as much as one step may take.

    A step leaves a fifth of the least gap, or closes rough walls by three standard deviations of the summits; a step of
    smooth elastic ones has no limit, since they yield more the nearer they come.
    """
    if shape.walls is not None and shape.asperities is None:
        return np.inf
    asperities, floor = shape.asperities, LEAST_SHARE * at.least
    if asperities is not None:
        floor = min(floor, at.least - DEEPEST * asperities.height)
    floor = max(floor, lowest_gap(shape))
    falls = [(at.gap - floor, -shape.space.sample_vertices(growth))]
    if at.corner_gap is not None:
        falls.append((at.corner_gap - floor, -growth))
    return min(
        float(np.min(np.divide(gap, fall, out=np.full(fall.shape, np.inf), where=fall > 0.0))) for gap, fall in falls
    )


def instant_of(solver: FilmSolver, floating: Floating, time: float, step: float, held: Array) -> FloatingInstant:
    """The floating film at the end of a step; raises FilmNotConverged for negative oil before the step."""
    shape = floating.shape_at(time)
    modes = modes_on(shape.space, floating.modes_at(time), floating.pockets)
    before = parted(floating, held, shape.space.size)
    if not holds_oil(shape, before.oil):
        raise FilmNotConverged(
            f"{floating.name}: {before.oil.min():.3g} m3 of oil left in a cavity between two stages",
            "a shorter step, or implicit Euler",
        )
    return FloatingInstant(solver, floating, time, step, shape, modes, before)


def solved(slopes: Array, load: Array, name: str) -> Array:
    """x with slopes x = load; raises FilmNotConverged where no force resists a motion."""
    try:
        return np.asarray(np.linalg.solve(slopes, load))
    except np.linalg.LinAlgError:
        raise FilmNotConverged(f"{name}: no force resists some motion of the walls", "a shorter step") from None
