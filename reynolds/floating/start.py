"""Start of a march of a floating film: its oil at a position, and the change of the oil with the position."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.floating.joint import JointStage
from reynolds.floating.pockets import pockets_grown
from reynolds.floating.problem import Floating
from reynolds.floating.sensitivity import FilmSensitivity, oil_slopes
from reynolds.floating.stage import FloatingStage
from reynolds.floating.step import InitialFilm, full_film, solve_stage
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import State, StateTangent
from reynolds.solve.solver import FilmSolver

NUDGE = 1e-9  # m: of the position, for the slope of what a film holds, which is linear but for rough walls that touch

NEAR = 1e-9  # of the mesh: round-off of a place


def started(floating: Floating, time: float, q: Array, initial: InitialFilm | None = None) -> State[FloatingStage]:
    """A film at rest at a position (k,) m, full or `initial` (`full_film`), with the tangent of its position.

    Raises FilmInputError where walls overlap, as `full_film` does.
    """
    q = np.asarray(q, dtype=float)
    columns = []
    for nudge in NUDGE * np.eye(len(q)):
        ahead, behind = (full_film(floating, time, q + sign * nudge, initial=initial) for sign in (1.0, -1.0))
        columns.append((ahead - behind) / (2.0 * NUDGE))
    tangent = StateTangent(np.eye(len(q)), np.column_stack(columns))
    return State(time, q, full_film(floating, time, q, initial=initial), np.zeros(len(q)), tangent=tangent)


def pressed(solver: FilmSolver, floating: Floating, start: State[FloatingStage], step: float) -> State[FloatingStage]:
    """The start with deformed elastic walls, before significant flow: one implicit step (s).

    Elastic walls follow a load at once, in a step of any length. Raises as `solve_stage`.
    """
    stage = solve_stage(solver, floating, start.time, start.held, step, start.q, start.stage)
    assert start.tangent is not None
    return replace(
        start, q=stage.q, held=stage.holds, tangent=StateTangent(*stage.propagated(start.tangent.held)), stage=stage
    )


def restarted(floating: Floating, time: float, last: State[FloatingStage], q: Array) -> State[FloatingStage]:
    """The end of a march moved to a position (k,) m: the start of the next one, with its tangent.

    The film fraction of each place stays, and its oil changes with the film over it; so does the rate. A mesh that
    turned by a pitch has other unknowns in each place. Raises FilmInputError where the oil of an unknown
    falls below zero, and for a mesh that does not return.
    """
    stage = last.stage
    if stage is None:
        return started(floating, time, q)
    k = len(stage.q)
    nothing = np.zeros((stage.instant.shape.space.size, k))
    film, parts = stage.trial.solution, stage.instant.solver.operators(stage.trial.solution)
    oil = oil_slopes(film, stage.trial.thicker, FilmSensitivity(nothing, nothing), parts)
    oil = oil + pockets_grown(film, stage.instant.modes)
    beside = np.zeros((len(last.held) - len(oil), k))  # position, and rates where walls have inertia
    beside[:k] = np.eye(k)
    places = places_of(floating.shape_at(time).space, stage.instant.shape.space)
    seats = places.unknowns
    slopes = np.vstack([oil[seats], beside])
    held = np.concatenate([last.held[: len(oil)][seats], last.held[len(oil) :]]) + slopes @ (q - stage.q)
    least = float(held[: len(oil)].min())
    if least < min(0.0, float(last.held[: len(oil)].min())):
        found = f"{least:.3g} m3 of oil at an unknown, {np.abs(q - stage.q).max():.3g} m from the last position"
        raise FilmInputError(f"{floating.name}, start of a turn", found, "a position nearer to it")
    warm = stage if places.same else stage.turned(seats, places.vertices) if isinstance(stage, JointStage) else None
    tangent = StateTangent(np.eye(k), slopes)
    return State(time, np.asarray(q, dtype=float), held, last.rate, last.acceleration, warm, tangent)


class Places(NamedTuple):
    """Vertex (vertices,) and unknown (size,) of a moved mesh at the place of each of a mesh."""

    vertices: NDArray[np.intp]
    unknowns: NDArray[np.intp]

    @property
    def same(self) -> bool:
        """True if each is at its own place."""
        return np.array_equal(self.unknowns, np.arange(len(self.unknowns)))


def places_of(space: FilmSpace, other: FilmSpace) -> Places:
    """The places of a mesh on a moved one. Raises FilmInputError where places differ by more than round-off."""
    near = NEAR * float(np.ptp(space.vertices, axis=0).max())
    if np.abs(space.vertices - other.vertices).max() <= near:
        return Places(np.arange(len(space.vertices)), np.arange(space.size))
    distance, vertex = cKDTree(other.vertices).query(space.vertices)
    if distance.max() > near or space.degree > 1:
        found = f"vertices up to {distance.max():.3g} m away"
        raise FilmInputError("mesh at the end of a turn", found, "those of its start, or turned by a pitch")
    seats = np.empty(space.size, dtype=np.intp)
    seats[space.vertex_dofs] = other.vertex_dofs[vertex]
    return Places(vertex, seats)
