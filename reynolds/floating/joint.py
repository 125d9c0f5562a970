"""One implicit step of a floating film by a single Newton's method on its pressures, its filling and its position.

Film and forces approach their balance together. A step takes two or three linear solves, where a search over
positions with a film in balance at each takes ten. The method converges near a solution; `step.solve_stage` uses films
in balance where it does not.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reynolds.compiled.film import CompiledFilm, FilmBalance, Linearised, compiled_film, pocket_volumes
from reynolds.errors import FilmNotConverged, InputError
from reynolds.floating.coordinates import ContactForce, generalised_force
from reynolds.floating.joint_walls import JointWalls, WallPose, walls_of
from reynolds.floating.pockets import filled
from reynolds.floating.pose import posed, rigid_film
from reynolds.floating.problem import Outer
from reynolds.floating.sensitivity import FilmSensitivity
from reynolds.floating.stage import EXACT, Closeness, FloatingStage
from reynolds.floating.trial import FloatingInstant, StepStart, Trial, force_scale, joined, parted, room_within, solved
from reynolds.laws.law import Tangent
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, FilmSolution, Storage

MOST_STEPS = 20
MOST_HALVINGS, FEW_HALVINGS = 8, 3  # of a step where a law ends, and where flows are no nearer to balance
TOLERANCE = 1e-8  # of the magnitudes that balance in a generalised force
FILM_TOLERANCE = 1e-11  # of the flows that meet at an unknown
LOOSE_FILM = 1e-5  # the same where the next step would be within the closeness
KEPT = 1e-3  # the same below which slopes serve once more
KEPT_GAIN = 0.1  # of a step's imbalance, that the step before may have left for its slopes to serve


@dataclass(frozen=True)
class JointState:
    """Position (k,) m, walls, film and forces on the way to their balance, as `trial.Trial` has them."""

    q: Array
    rate: Array
    pose: WallPose
    film: FilmBalance
    film_force: Array
    contact: ContactForce | None
    outer: Outer
    missing: Array
    size: Array

    @property
    def missed(self) -> float:
        """Largest imbalance of a force over the magnitudes that balance."""
        return float(np.max(np.abs(self.missing) / force_scale(self.size)))


@dataclass(frozen=True)
class JointSlopes:
    """Slopes of film and forces at a state, ready for Newton's method; they are kept until others are made.

    by_position: changes of the film by the position, growth (cells, points, k) of the gap at constant pressure;
    opened (vertices, k): growth of the gap, the film in balance, as contact of the first state lets it; stiff (k, k)
    N/m: d(Q + P - M q'')/dq, the film in balance.
    """

    at: JointState
    film: Linearised
    by_position: FilmSensitivity
    growth: Array
    contact: ContactForce | None
    opened: Array
    stiff: Array


@dataclass(frozen=True)
class FilmStep:
    """The film's Newton step at constant position.

    Changes of pressures (size,) Pa and of film fractions (size,), the walls' deformation (vertices,) m by it, and the
    change (k,) N of the forces of film and contact.
    """

    pressure: Array
    fraction: Array
    deformed: Array
    pressed: Array


@dataclass(frozen=True)
class JointStage(FloatingStage):
    """A stage whose film and forces balance together; its slopes are those of the last Newton step."""

    state: JointState = field(repr=False, kw_only=True)
    slopes: JointSlopes = field(repr=False, kw_only=True)
    walls: JointWalls = field(repr=False, kw_only=True)

    @cached_property
    def holds(self) -> Array:
        """State at the end of the step, one vector, as `FloatingStage.holds`; its oil is what the flows leave."""
        return joined(self.instant.floating, StepStart(self.state.film.holds, self.q, self.rate))

    @property
    def by_position(self) -> FilmSensitivity:
        """Sensitivity of the film to its position."""
        return self.slopes.by_position

    @property
    def force_slopes(self) -> Array:
        """d(Q + P - M q'')/dq over the step, (k, k) N/m."""
        return self.slopes.stiff

    def ahead(self, q: Array) -> FilmSolution:
        """A guess of the film at another position (k,) m: this one, from which cavities change least."""
        return self.trial.solution

    def turned(self, unknowns: NDArray[np.intp], vertices: NDArray[np.intp]) -> JointStage:
        """The same on a mesh turned by a pitch, as a guess of its film: the unknown and vertex at each place there."""
        film = self.trial.solution
        moved = replace(
            film, pressure=film.pressure[unknowns], film_fraction=film.film_fraction[unknowns],
            cavity=film.cavity[unknowns], deformation=film.deformation[vertices],
        )  # fmt: skip
        return replace(self, trial=replace(self.trial, solution=moved))

    def propagated(self, before: Array) -> tuple[Array, Array]:
        """Change of q (k, m) and of `holds` (held, m) by changes (held, m) of the state before."""
        instant, slopes, own = self.instant, self.slopes.film, self.by_position
        changed = parted(instant.floating, before, len(self.state.film.oil.pressure))
        film = FilmSensitivity(*slopes.parted(slopes.changes(changed.oil / instant.step)))
        deformed = self.walls.deformed(self.slopes.contact, film.pressure)
        pressed = _pressed(instant, self.slopes.contact, film.pressure, deformed)
        missing = instant.missing_by_before(self.trial, pressed, changed)
        q = -solved(self.force_slopes, missing, instant.floating.name)
        pressure, fraction = film.pressure + own.pressure @ q, film.film_fraction + own.film_fraction @ q
        space, opened = instant.shape.space, deformed + self.slopes.opened @ q
        wider = np.ascontiguousarray(space.reference.geometry_value @ opened[space.cells])
        oil = slopes.oil_by_state(pressure, fraction) + slopes.oil_by_thickness(wider, instant.modes.pockets @ q)
        return q, joined(instant.floating, StepStart(oil, q, (q - changed.position) / instant.step))


class JointSearch:
    """Newton's method on film and position at one instant."""

    def __init__(self, instant: FloatingInstant, close: Closeness) -> None:
        self._instant, self._close, self._shape = instant, close, instant.shape
        self._walls = walls_of(instant)
        self.films = 0

    def stage(self, q: Array, warm: FilmSolution) -> JointStage | None:
        """The stage reached from a position (k,) m and a film near it; None where the iteration fails."""
        try:
            at, slopes = self._at(q, warm.pressure, warm.film_fraction, warm.cavity, warm.deformation), None
            for _ in range(MOST_STEPS):
                if at is None:
                    return None
                slopes, film_step = self._linearised(at) if slopes is None else self._kept(slopes, at)
                new = self._moved(slopes, film_step)
                if new is not None and self._settled(new, slopes):
                    if self._close == EXACT:
                        slopes, _ = self._linearised(new)
                    return self._stage(new, slopes)
                at = new
        except (FilmNotConverged, InputError):  # a law ends, or no force resists: films in balance give the reason
            return None
        return None

    @cached_property
    def _film(self) -> CompiledFilm:
        before, shape = self._instant.before, self._shape
        return compiled_film(shape, before.oil, self._instant.step, np.zeros(shape.space.size))

    def _filled(self, q: Array) -> CompiledFilm:
        """The film with its pockets' volumes at a position."""
        floating = self._instant.floating
        if not floating.pockets:
            return self._film
        return self._film.with_pockets(pocket_volumes(self._shape, filled(floating, self._shape, q)))

    def _at(
        self, q: Array, pressure: Array, fraction: Array, cavity: NDArray[np.bool_], near: Array | None
    ) -> JointState | None:
        """Film and forces at a state; None where walls overlap. `near` (vertices,) m: a guess of their deformation."""
        instant, compiled = self._instant, self._filled(q)
        self.films += 1
        held = compiled.setting.held
        pressure = np.where(held, compiled.setting.pressure, pressure)
        fraction = np.where(held, compiled.setting.film_fraction, fraction)
        pose = self._walls.pose(q, pressure, near)
        if pose is None or instant.touching(pose):
            return None
        film = compiled.at(pose.gap, pressure, fraction, cavity & ~held)
        contact = self._walls.contact(pose, film)
        rate = (q - instant.before.position) / instant.step
        outer = instant.floating.outer_at(instant.time, q, rate)
        film_force = generalised_force(pressure, instant.modes, instant.floating.reference)
        missing, size = instant.balance_of(pressure, film_force, contact, outer, rate)
        return JointState(q, rate, pose, film, film_force, contact, outer, missing, size)

    def _linearised(self, at: JointState) -> tuple[JointSlopes, FilmStep]:
        """Slopes at a state, and the film's Newton step there."""
        walls, instant, contact = self._walls, self._instant, at.contact
        film, growth = walls.linearised(at.film, at.pose), walls.growth(contact)
        loads = np.column_stack([at.film.fed[0], film.by_thickness(growth, instant.modes.pockets)])
        pressure, fraction = film.parted(film.changes(-loads))
        deformed = walls.deformed(contact, pressure)
        pressed = _pressed(instant, contact, pressure, deformed)
        stiff = instant.stiffness(pressed[:, 1:], contact, at.outer)
        opened, by = walls.grown(contact) + deformed[:, 1:], FilmSensitivity(pressure[:, 1:], fraction[:, 1:])
        step = FilmStep(pressure[:, 0], fraction[:, 0], deformed[:, 0], pressed[:, 0])
        return JointSlopes(at, film, by, growth, contact, opened, stiff), step

    def _kept(self, slopes: JointSlopes, at: JointState) -> tuple[JointSlopes, FilmStep]:
        """The same by the slopes of the step before, near balance and of the same cavity; else at the state."""
        last, imbalance = slopes.at.film, at.film.imbalance
        if imbalance > min(KEPT, KEPT_GAIN * last.imbalance) or not np.array_equal(at.film.cavity, last.cavity):
            return self._linearised(at)
        kept = replace(slopes, at=at, film=replace(slopes.film, balance=at.film))
        pressure, fraction = kept.film.parted(kept.film.changes(-at.film.fed[0][:, None]))
        deformed = self._walls.deformed(kept.contact, pressure)
        pressed = _pressed(self._instant, kept.contact, pressure, deformed)
        return kept, FilmStep(pressure[:, 0], fraction[:, 0], deformed[:, 0], pressed[:, 0])

    def _moved(self, slopes: JointSlopes, film: FilmStep) -> JointState | None:
        """The state one Newton step on, the step of the position cut where it leaves no gap.

        The step is halved where a law ends and, to one eighth, until flows are nearer to balance; if they never are,
        the longest one counts: cavities open and close on the way.
        """
        at, by = slopes.at, slopes.by_position
        step = -solved(slopes.stiff, at.missing + film.pressed, self._instant.floating.name)
        step = min(1.0, room_within(self._shape, at.pose, slopes.opened @ step)) * step
        pressure, fraction = film.pressure + by.pressure @ step, film.fraction + by.film_fraction @ step
        opened = film.deformed + slopes.opened @ step
        longest: JointState | None = None
        for halvings in range(MOST_HALVINGS):
            share = 0.5**halvings
            new = self._tried(slopes, share * step, share * pressure, share * fraction, share * opened)
            if new is None:
                continue
            if new.film.missing <= at.film.missing:
                return new
            longest = new if longest is None else longest
            if halvings >= FEW_HALVINGS:
                break
        return longest

    def _tried(
        self, slopes: JointSlopes, step: Array, pressure: Array, fraction: Array, opened: Array
    ) -> JointState | None:
        """The state a step on, changes of position, pressure, filling and gap; None where a law or the gap ends."""
        at, near = slopes.at, slopes.at.pose.deformation
        if near is not None:
            near = near + opened - self._instant.modes.at_vertices @ step
        try:
            return self._at(at.q + step, *slopes.film.stepped(pressure, fraction), near)
        except (FilmNotConverged, InputError):
            return None

    def _settled(self, at: JointState, slopes: JointSlopes) -> bool:
        """True if film and forces balance, or would in a step within the closeness."""
        if at.film.imbalance <= FILM_TOLERANCE and at.missed <= TOLERANCE:
            return True
        if at.film.imbalance > LOOSE_FILM:
            return False
        ahead = solved(slopes.stiff, at.missing, self._instant.floating.name)
        allowed = self._close.allows(at.film.coefficients.film)
        return bool(np.abs(self._instant.modes.at_vertices @ ahead).max() <= allowed)

    def _problem(self, at: JointState) -> FilmProblem:
        """The film at a state as a problem of its own: elastic walls with their shape before they deform."""
        instant, shape = self._instant, self._shape
        if shape.walls is None:
            c = at.film.coefficients
            film = rigid_film(shape, instant.modes, at.q, Tangent(c.film, c.film_slope))
        else:
            film = posed(shape, instant.modes, at.q).film
        return replace(
            shape,
            film=film,
            asperities=None if shape.walls is None else shape.asperities,
            boundary=filled(instant.floating, shape, at.q),
            storage=Storage(instant.before.oil, instant.step),
        )

    def _stage(self, at: JointState, slopes: JointSlopes) -> JointStage:
        instant, growth = self._instant, slopes.growth
        if self._shape.walls is None:
            growth = np.ascontiguousarray(at.film.coefficients.film_slope[:, :, None] * growth)
        trial = Trial(
            q=at.q,
            rate=at.rate,
            gap=at.pose.gap,
            corner_gap=at.pose.corner_gap,
            least=at.pose.least,
            thicker=growth,
            solution=at.film.solution(self._problem(at), at.pose.deformation),
            film_force=at.film_force,
            contact=at.contact,
            outer=at.outer,
            missing=at.missing,
            size=at.size,
        )
        films = self.films
        return JointStage(
            instant.time, trial, instant, films, films - 1, np.zeros_like(at.q), state=at, slopes=slopes,
            walls=self._walls,
        )  # fmt: skip


def _pressed(instant: FloatingInstant, contact: ContactForce | None, pressure: Array, deformed: Array) -> Array:
    """Change of the forces of film and contact, (k, m) N, by that of the film's pressure (size, m) Pa and walls."""
    found = instant.modes.weights.T @ pressure
    return np.asarray(found if contact is None else found + contact.by_deformation(deformed))
