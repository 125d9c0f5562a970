"""One implicit step of a floating film by a single Newton's method on its pressures, its filling and its position.

Film and forces approach their balance together, so that a step costs two or three linear solves where a film
solved anew at each position takes ten. Near a solution it is as sure; far from one `step.solve_stage`, which
falls back on films in balance, is.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reynolds.compiled.film import CompiledFilm, FilmBalance, Linearised, compiled_film, linearised, pocket_volumes
from reynolds.compiled.gap_table_kernels import contact_forces
from reynolds.equation.rough_overlap import film_between
from reynolds.errors import FilmNotConverged, InputError
from reynolds.floating.coordinates import ContactForce, generalised_force
from reynolds.floating.pockets import filled
from reynolds.floating.pose import lowest_gap
from reynolds.floating.problem import Outer
from reynolds.floating.sensitivity import FilmSensitivity
from reynolds.floating.stage import EXACT, Closeness, FloatingStage
from reynolds.floating.trial import FloatingInstant, StepStart, Trial, joined, parted, room_within, solved
from reynolds.linear.factor import GeneralFactor
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution, Storage

MOST_STEPS = 12
TOLERANCE = 1e-8  # of the magnitudes that balance in a generalised force
FILM_TOLERANCE = 1e-11  # of the flows that meet at an unknown
LOOSE_FILM = 1e-5  # the same where the next step would be within the closeness


@dataclass(frozen=True)
class JointState:
    """Position (k,) m, film and forces on the way to their balance, as `trial.Trial` has them."""

    q: Array
    rate: Array
    gap: Array
    corner_gap: Array | None
    least: float
    film: FilmBalance
    film_force: Array
    contact: ContactForce | None
    outer: Outer
    missing: Array
    size: Array

    @property
    def missed(self) -> float:
        """Largest imbalance of a force over the magnitudes that balance."""
        return float(np.max(np.abs(self.missing) / np.maximum(self.size, 1e-6 * float(np.max(self.size)) + 1e-300)))


@dataclass(frozen=True)
class JointStage(FloatingStage):
    """A stage whose film and forces balance together.

    slopes: of the balance at the last Newton step; film_slopes (size, k): changes of the film by the position, stiff
    (k, k) N/m: d(Q + P - M q'')/dq, both there. Slopes serve until the next stage is solved.
    """

    balance: FilmBalance = field(repr=False, kw_only=True)
    slopes: Linearised = field(repr=False, kw_only=True)
    film_slopes: FilmSensitivity = field(repr=False, kw_only=True)
    stiff: Array = field(kw_only=True)

    @cached_property
    def holds(self) -> Array:
        """State at the end of the step, one vector, as `FloatingStage.holds`; its oil is what the flows leave."""
        return joined(self.instant.floating, StepStart(self.balance.holds, self.q, self.rate))

    @property
    def by_position(self) -> FilmSensitivity:
        """Sensitivity of the film to its position."""
        return self.film_slopes

    @property
    def force_slopes(self) -> Array:
        """d(Q + P - M q'')/dq over the step, (k, k) N/m."""
        return self.stiff

    def ahead(self, q: Array) -> FilmSolution:
        """A guess of the film at another position (k,) m, along its slopes."""
        return self.trial.solution

    def propagated(self, before: Array) -> tuple[Array, Array]:
        """Change of q (k, m) and of `holds` (held, m) by changes (held, m) of the state before."""
        instant = self.instant
        floating, modes = instant.floating, instant.modes
        changed = parted(floating, before, len(self.balance.oil.pressure))
        film = FilmSensitivity(*self.slopes.parted(self.slopes.changes(changed.oil / instant.step)))
        missing = instant.missing_by_before(self.trial, film, changed)
        q = -solved(self.stiff, missing, floating.name)
        pressure = film.pressure + self.film_slopes.pressure @ q
        fraction = film.film_fraction + self.film_slopes.film_fraction @ q
        oil = self.slopes.oil_by_state(pressure, fraction)
        oil += self.slopes.oil_by_thickness(modes.at_points, modes.pockets) @ q
        return q, joined(floating, StepStart(oil, q, (q - changed.position) / instant.step))


class JointSearch:
    """Newton's method on film and position at one instant."""

    def __init__(self, instant: FloatingInstant, factor: GeneralFactor, close: Closeness) -> None:
        self._instant, self._factor, self._close = instant, factor, close
        self._shape = instant.shape
        self.films = 0

    def stage(self, q: Array, warm: FilmSolution) -> JointStage | None:
        """The stage reached from a position (k,) m and a film near it; None where the way is not plain."""
        try:
            at = self._at(q, warm.pressure, warm.film_fraction, warm.cavity)
            for _ in range(MOST_STEPS):
                if at is None:
                    return None
                slopes, by, stiff, film_step, step = self._newton(at)
                new = self._moved(at, slopes, by, film_step, step)
                if new is not None and self._settled(new, stiff):
                    if self._close == EXACT:
                        slopes, by, stiff, _, _ = self._newton(new)
                    return self._stage(new, slopes, by, stiff)
                at = new
        except (FilmNotConverged, InputError):  # a law ends, or no force resists: films in balance tell why
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

    def _at(self, q: Array, pressure: Array, fraction: Array, cavity: NDArray[np.bool_]) -> JointState | None:
        """Film and forces at a state; None where walls overlap."""
        instant, shape = self._instant, self._shape
        self.films += 1
        gap, corners = shape.film.thickness + instant.modes.rise(q), shape.film.thickness_at_vertices
        least = float(gap.min())
        if corners is not None:
            corners = corners + instant.modes.at_vertices @ q
            if shape.asperities is not None and shape.surface is not None:
                corners = None  # summits bear at the points
            else:
                least = min(least, float(corners.min()))
        if not least > lowest_gap(shape):
            return None
        compiled = self._filled(q)
        held = compiled.setting.held
        pressure = np.where(held, compiled.setting.pressure, pressure)
        fraction = np.where(held, compiled.setting.film_fraction, fraction)
        film = compiled.at(gap, pressure, fraction, cavity & ~held)
        contact = None
        if shape.asperities is not None:
            c = film.coefficients
            force, slopes, size = contact_forces(c.contact, c.contact_slope, shape.space.area, instant.modes.at_points)
            contact = ContactForce(force, slopes, size)
        rate = (q - instant.before.position) / instant.step
        outer = instant.floating.outer_at(instant.time, q, rate)
        film_force = generalised_force(pressure, instant.modes, instant.floating.reference)
        missing, size = instant.balance_of(pressure, film_force, contact, outer, rate)
        return JointState(q, rate, gap, corners, least, film, film_force, contact, outer, missing, size)

    def _newton(self, at: JointState) -> tuple[Linearised, FilmSensitivity, Array, Array, Array]:
        """Slopes there, changes of the film by the position, of the forces, and the steps of film and position."""
        instant, modes = self._instant, self._instant.modes
        slopes = linearised(at.film, self._factor)
        loads = np.column_stack([at.film.fed[0], slopes.by_thickness(modes.at_points, modes.pockets)])
        changes = slopes.changes(-loads)
        film_step, by_position = changes[:, :1], changes[:, 1:]
        by = FilmSensitivity(*slopes.parted(by_position))
        stiff = instant.stiffness(modes.weights.T @ by.pressure, at.contact, at.outer)
        missing = at.missing + modes.weights.T @ slopes.parted(film_step)[0][:, 0]
        return slopes, by, stiff, changes, -solved(stiff, missing, instant.floating.name)

    def _moved(
        self, at: JointState, slopes: Linearised, by: FilmSensitivity, changes: Array, step: Array
    ) -> JointState | None:
        """The state one Newton step on, the step of the position cut where it leaves no gap."""
        room = room_within(self._shape, at, self._instant.modes.at_vertices @ step)
        share = min(1.0, room)
        film = changes[:, 0] + share * (changes[:, 1:] @ step)
        return self._at(at.q + share * step, *slopes.stepped(film))

    def _settled(self, at: JointState, stiff: Array) -> bool:
        """True if film and forces balance, or would in a step within the closeness."""
        if at.film.imbalance <= FILM_TOLERANCE and at.missed <= TOLERANCE:
            return True
        if at.film.imbalance > LOOSE_FILM:
            return False
        ahead = solved(stiff, at.missing, self._instant.floating.name)
        allowed = self._close.share * float(at.film.coefficients.film.min()) + self._close.floor
        return bool(np.abs(self._instant.modes.at_vertices @ ahead).max() <= allowed)

    def _stage(self, at: JointState, slopes: Linearised, by: FilmSensitivity, stiff: Array) -> JointStage:
        instant, shape, c = self._instant, self._shape, at.film.coefficients
        corners = shape.film.thickness_at_vertices
        if corners is not None:
            corners = film_between(shape, corners + instant.modes.at_vertices @ at.q).value
        problem = replace(
            shape,
            film=replace(shape.film, thickness=c.film, thickness_at_vertices=corners),
            asperities=None,
            boundary=filled(instant.floating, shape, at.q),
            storage=Storage(instant.before.oil, instant.step),
        )
        trial = Trial(
            q=at.q,
            rate=at.rate,
            gap=at.gap,
            corner_gap=at.corner_gap,
            least=at.least,
            thicker=np.ascontiguousarray(c.film_slope[:, :, None] * instant.modes.at_points),
            solution=at.film.solution(problem),
            film_force=at.film_force,
            contact=at.contact,
            outer=at.outer,
            missing=at.missing,
            size=at.size,
        )
        return JointStage(
            instant.time, trial, instant, self.films, self.films - 1, np.zeros_like(at.q), None,
            balance=at.film, slopes=slopes, film_slopes=by, stiff=stiff,
        )  # fmt: skip
