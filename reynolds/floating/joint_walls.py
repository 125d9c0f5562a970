"""Walls of a film whose pressures and position are found together: the gap between them, contact, and their slopes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from reynolds.compiled.contact_kernels import settle
from reynolds.compiled.film import FilmBalance, Linearised, linearised, linearised_soft
from reynolds.compiled.gap_table import gap_table
from reynolds.compiled.gap_table_kernels import contact_forces
from reynolds.equation.coefficients import WIDEST
from reynolds.equation.deformation import (
    DEEPEST,
    FELT,
    TOLERANCE,
    Meeting,
    Touch,
    given_gap,
    meeting_of,
    resisted,
    settled_deformation,
)
from reynolds.errors import FilmNotConverged
from reynolds.floating.coordinates import ContactForce, SoftContact, soft_contact
from reynolds.floating.pose import lowest_gap, rigid_gap
from reynolds.floating.trial import FloatingInstant
from reynolds.laws.contact import LOWEST_RATIO
from reynolds.laws.law import Tangent
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class WallPose:
    """Gap between the mean planes at the points (cells, points) and vertices (vertices,) m, and the least of both.

    corner_gap is None where it is not known; deformation (vertices,) m of elastic walls; touch: their contact.
    """

    gap: Array
    corner_gap: Array | None
    least: float
    deformation: Array | None = None
    touch: Touch | None = None


@dataclass(frozen=True)
class RigidWalls:
    """Rigid walls: contact by the gap at the points."""

    instant: FloatingInstant

    def pose(self, q: Array, pressure: Array, near: Array | None) -> WallPose | None:
        """The walls at a position (k,) m; None where they overlap further than contact goes."""
        gap, corners, least = rigid_gap(self.instant.shape, self.instant.modes, q)
        return WallPose(gap, corners, least) if least > lowest_gap(self.instant.shape) else None

    def contact(self, pose: WallPose, film: FilmBalance) -> ContactForce | None:
        """Force of the asperities."""
        if self.instant.shape.asperities is None:
            return None
        c, area = film.coefficients, self.instant.shape.space.area
        return ContactForce(*contact_forces(c.contact, c.contact_slope, area, self.instant.modes.at_points))

    def growth(self, contact: ContactForce | None) -> Array:
        """Growth of the gap by each coordinate at constant pressure, (cells, points, k)."""
        return self.instant.modes.at_points

    def linearised(self, film: FilmBalance, pose: WallPose) -> Linearised:
        """The slopes of the film's balance."""
        return linearised(film, self.instant.solver.slopes_factor)

    def grown(self, contact: ContactForce | None) -> Array:
        """The same at the vertices, (vertices, k)."""
        return self.instant.modes.at_vertices

    def deformed(self, contact: ContactForce | None, pressure: Array) -> Array:
        """Deformation (vertices, m) m by changes (size, m) Pa of the film's pressure: none."""
        return np.zeros((len(self.instant.shape.space.vertices), pressure.shape[1]))


@dataclass(frozen=True)
class SoftWalls:
    """Elastic walls: they deform under film and contact, which acts at the vertices."""

    instant: FloatingInstant

    @cached_property
    def _meeting(self) -> Meeting | None:
        return None if self.instant.shape.asperities is None else meeting_of(self.instant.shape)

    @cached_property
    def _given(self) -> Array:
        return given_gap(self.instant.shape)

    def pose(self, q: Array, pressure: Array, near: Array | None) -> WallPose | None:
        """The walls at a position (k,) m under pressures (size,) Pa; `near`: a guess of their deformation."""
        shape, modes, meeting = self.instant.shape, self.instant.modes, self._meeting
        assert shape.walls is not None
        deformation = np.asarray(shape.walls.matrix @ pressure)
        undeformed, touch = self._given + modes.at_vertices @ q, None
        if meeting is not None:
            deformation, touch = _settled(meeting, undeformed, deformation, deformation if near is None else near)
        gap = shape.film.thickness + modes.rise(q) + shape.space.sample_vertices(deformation)
        corners = None if shape.film.thickness_at_vertices is None else undeformed + deformation
        least = min(float(part.min()) for part in (gap, corners) if part is not None)
        thinnest = lowest_gap(shape) if meeting is not None else 0.0
        if not (least > thinnest and gap.max() < WIDEST * np.abs(shape.film.thickness).max()):
            return None
        return WallPose(gap, corners, least, deformation, touch)

    def contact(self, pose: WallPose, film: FilmBalance) -> ContactForce | None:
        """Force of the asperities."""
        return None if pose.touch is None else soft_contact(pose.touch, self.instant.modes)

    def growth(self, contact: ContactForce | None) -> Array:
        """Growth of the gap by each coordinate at constant pressure, (cells, points, k)."""
        if not isinstance(contact, SoftContact):
            return self.instant.modes.at_points
        space = self.instant.shape.space
        return np.ascontiguousarray(space.reference.geometry_value @ contact.grown[space.cells])

    def linearised(self, film: FilmBalance, pose: WallPose) -> Linearised:
        """The slopes of the film's balance."""
        shape, solver = self.instant.shape, self.instant.solver
        assert shape.walls is not None
        wider = shape.walls.matrix if pose.touch is None else resisted(pose.touch)
        return linearised_soft(film, wider, solver.patterns, solver.near_factor)

    def grown(self, contact: ContactForce | None) -> Array:
        """The same at the vertices, (vertices, k)."""
        return contact.grown if isinstance(contact, SoftContact) else self.instant.modes.at_vertices

    def deformed(self, contact: ContactForce | None, pressure: Array) -> Array:
        """Deformation (vertices, m) m by changes (size, m) Pa of the film's pressure, at constant position."""
        if isinstance(contact, SoftContact):
            return contact.deformation(pressure)
        walls = self.instant.shape.walls
        assert walls is not None
        return np.asarray(walls.matrix @ pressure)


def _settled(meeting: Meeting, given: Array, alone: Array, start: Array) -> tuple[Array, Touch]:
    """The deformation in balance with contact and that contact, as `equation.deformation` has them."""
    law, compliance = meeting.asperities, meeting.compliance
    if not isinstance(compliance, np.ndarray):
        found = settled_deformation(meeting, given, alone, start)
        return found, meeting.at(given + found)
    start = np.maximum(start, law.summit_height - DEEPEST * law.height - given)
    lowest, enough = law.summit_height + LOWEST_RATIO * law.height, TOLERANCE * (np.max(np.abs(given)) + law.height)
    table, stiff = gap_table(None, law, elastic=True), FELT * law.elastic_factor * law.modulus / law.height
    found, bears, slopes, converged = settle(
        table, compliance, meeting.seats, meeting.shares, given, alone, start, lowest, enough, stiff
    )
    if not converged:
        raise FilmNotConverged("deformation of walls in contact not converged", "a thicker film, or stiffer walls")
    return found, Touch(meeting, Tangent(bears, slopes), np.flatnonzero(-slopes > stiff))


JointWalls = RigidWalls | SoftWalls


def walls_of(instant: FloatingInstant) -> JointWalls:
    """The walls of an instant."""
    return RigidWalls(instant) if instant.shape.walls is None else SoftWalls(instant)
