"""A floating film at the end of an implicit step: position, forces, oil, and their slopes."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from reynolds.equation.rough_overlap import as_shaped
from reynolds.floating.coordinates import SoftContact
from reynolds.floating.problem import Outer
from reynolds.floating.sensitivity import FilmSensitivity
from reynolds.floating.trial import FloatingInstant, StepStart, Trial, joined, parted
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.iterate import is_linear


@dataclass(frozen=True)
class Closeness:
    """Length of a last Newton step (share of the least film, and m) after which the film is not solved again.

    Oil and forces then follow the position along their slopes, with an error of its square. Zero for both: steps
    until the forces balance.
    """

    share: float = 0.0
    floor: float = 0.0

    def allows(self, film: Array) -> float:
        """Allowed length (m) at a film thickness (cells, points) m."""
        return self.share * float(film.min()) + self.floor


EXACT = Closeness()


@dataclass(frozen=True)
class FloatingStage:
    """A floating film at the end of an implicit step: a `Stage` of `numerics.dirk`.

    films: number solved; steps: of Newton's method. The film is the last one tried, and `shift` (k,) m the way
    from there to the balance of forces, see `Closeness`.
    """

    time: float
    trial: Trial = field(repr=False)
    instant: FloatingInstant = field(repr=False)
    films: int
    steps: int
    shift: Array
    known: FilmSensitivity | None = field(repr=False, default=None)

    @property
    def q(self) -> Array:
        """Position (k,), m."""
        return self.trial.q + self.shift

    @cached_property
    def solution(self) -> FilmSolution:
        """The film in balance, with its storage, between rigid walls of its deformed shape.

        It follows the shift along its slopes, and so do its flows: oil is conserved to the square of the shift.
        """
        return as_shaped(self.balanced)

    @property
    def deformation(self) -> Array:
        """Opening of the film by its elastic walls, (vertices,) m; zero between rigid ones."""
        return self.balanced.deformation

    @cached_property
    def balanced(self) -> FilmSolution:
        """The film in balance, between elastic walls if they are."""
        if not self.shift.any():
            return self.trial.solution
        return self.instant.moved(self.trial, self.shift, self.by_position)

    @cached_property
    def gap(self) -> Array:
        """Distance of the mean planes at the quadrature points (cells, points), m, deformation included."""
        if not self.shift.any():
            return self.trial.gap
        return self.trial.gap + self.instant.shape.space.sample_vertices(self._grown @ self.shift)

    @property
    def least_gap(self) -> float:
        """Least distance of the mean planes, m."""
        if not self.shift.any():
            return self.trial.least
        corners = self.trial.corner_gap
        least = float(self.gap.min())
        return least if corners is None else min(least, float((corners + self._grown @ self.shift).min()))

    @cached_property
    def _grown(self) -> Array:
        """Growth of the gap by each coordinate at the vertices, (vertices, k)."""
        return self.instant.grown(self.trial, self.by_position)

    @property
    def film_force(self) -> Array:
        """Q without contact, (k,) N."""
        return self.trial.film_force + self._along(lambda: self.instant.film_slopes(self.by_position))

    @property
    def contact_force(self) -> Array:
        """Share of the asperities in Q, (k,) N."""
        contact = self.trial.contact
        if contact is None:
            return np.zeros(len(self.q))
        return contact.force + self._along(lambda: contact.slopes + contact.by_pressure(self.by_position.pressure))

    @property
    def wall_pressure(self) -> Array:
        """Pressure (size,) Pa of the film on its walls and, where these are elastic, of the asperities too."""
        contact = self.trial.contact
        if not isinstance(contact, SoftContact):
            return self.solution.pressure
        touch = contact.touch
        bears = touch.bears.value + self._along(lambda: touch.bears.slope[:, None] * self._grown)
        return self.solution.pressure + touch.meeting.on_unknowns(bears)

    @property
    def outer(self) -> Outer:
        """P and its slopes."""
        outer = self.trial.outer
        more = self._along(lambda: outer.by_position + outer.by_rate / self.instant.step)
        return replace(outer, force=outer.force + more)

    @property
    def rate(self) -> Array:
        """dq/dt over the step, (k,) m/s."""
        return self.trial.rate + self.shift / self.instant.step

    @property
    def inertia_force(self) -> Array:
        """-M q'' over the step, (k,) N."""
        return self.instant.inertia_force(self.rate)

    def _along(self, slopes: Callable[[], Array]) -> Array | float:
        """Change of forces of such slopes by the shift."""
        return slopes() @ self.shift if self.shift.any() else 0.0

    @cached_property
    def holds(self) -> Array:
        """State at the end of the step, one vector: oil (size,) m3, q (k,) m and, with inertia, dq/dt (k,) m/s."""
        oil = self.trial.solution.holds
        if self.shift.any():
            oil = oil + self.instant.oil_moved(self.trial, self.by_position, self.shift[:, None])[:, 0]
        return joined(self.instant.floating, StepStart(oil, self.q, self.rate))

    @cached_property
    def by_position(self) -> FilmSensitivity:
        """Sensitivity of the film to its position: by the film's last factor while no other film is solved."""
        if self.known is not None:
            return self.known
        return self.instant.by_position(self.trial, self.instant.exactness)

    @cached_property
    def force_slopes(self) -> Array:
        """d(Q + P - M q'')/dq over the step, (k, k) N/m: stiffness and, by the step, damping."""
        return self.instant.slopes(self.trial, self.by_position)

    def ahead(self, q: Array) -> FilmSolution:
        """A guess of the film at another position (k,) m: this one if linear, else along its slopes."""
        if is_linear(self.trial.solution.problem):
            return self.trial.solution
        return self.instant.ahead(self.trial, q - self.trial.q, self.by_position)

    def moved(self, change: Array) -> Array:
        """Change of the gap (cells, points) m by one of the position (k,) m, elastic walls following."""
        return self.instant.shape.space.sample_vertices(self._grown @ change)

    @property
    def yardstick(self) -> Array:
        """Film thickness (cells, points) m as the scale of its changes.

        Where elastic walls flatten summits, at least their height.
        """
        thickness, shape = self.trial.solution.film.thickness, self.instant.shape
        if shape.walls is None or shape.asperities is None:
            return thickness
        return np.maximum(thickness, shape.asperities.height)

    def propagated(self, before: Array) -> tuple[Array, Array]:
        """Change of q (k, m) and of `holds` (held, m) by changes (held, m) of the state before.

        Exact at constant cavity; costs k + m right-hand sides on the film's last factor, and a new factor
        where the solver has solved another film since.
        """
        floating = self.instant.floating
        changed = parted(floating, before, len(self.trial.solution.pressure))
        after = self.instant.onward(self.trial, self.by_position, self.force_slopes, changed)
        return after.position, joined(floating, after)
