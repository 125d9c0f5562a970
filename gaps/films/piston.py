"""The piston that floats in its bore: film, motion and forces by its eccentricities at both ends of the guide.

Film plane: x = radius x angle in [0, pi d), sewn; y along the bore's axis out of the block, from the guide's inner
end (0) to its case edge (guide_length). Angle 0 points to the inner dead centre's side; the plane does not turn
with the block, so that bore and piston both spin in it. Coordinates q = (ex0, ey0, ex1, ey1), m: the eccentricity
of the piston's axis at two stations fixed in the bore, the guide's inner end (0) and its case edge (1). With s the
depth inside the case edge, s = guide_length - y,

    h = c + bore(s) + piston(depth from its end) - e(s) . (cos, sin),   e(s) = e1 + (e0 - e1) s/guide_length.

The mesh spans what is engaged and stretches as the piston moves; wall velocities are relative to it. Between walls
that give way its rows are closer at both edges.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from gaps.films.friction import Rubbed, rubbed
from gaps.films.over_turn import OverTurn
from gaps.films.physics import FilmLaws, Physics, laws_left
from gaps.films.piston_deformation import Yielding, yielding
from gaps.shapes.profiles import PLAIN, Profile, Relief
from gaps.walls.pair import BoreWalls
from gaps.walls.parts import Stand, closer_at_both
from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.errors import FilmInputError
from reynolds.fem.mesh import Cell, rectangle, rename
from reynolds.fem.space import FilmSpace, film_space
from reynolds.floating.problem import Floating, Outer, steady
from reynolds.floating.step import Stage
from reynolds.laws.contact import Asperities
from reynolds.laws.law import require_positive
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Film, FilmProblem, Held
from reynolds.solve.loads import evaluate


@dataclass(frozen=True)
class PistonShape:
    """Piston diameter, radial clearance and guide length in the bore (m), and what is taken off either part.

    `piston` counts places from the piston's chamber end, `bore` from the guide's case edge inwards.
    """

    diameter: float
    radial_clearance: float
    guide_length: float
    piston: Profile = PLAIN
    bore: Profile = PLAIN

    def __post_init__(self) -> None:
        require_positive(
            "piston", diameter=self.diameter, clearance=self.radial_clearance, guide_length=self.guide_length
        )


@dataclass(frozen=True)
class PistonDrive:
    """What drives a piston over the turn, SI.

    shaft_speed rad/s; viscosity Pa s and pressures Pa; spins rad/s of piston and bore about the bore's axis in the
    frame that does not turn. Over the shaft angle: chamber_pressure Pa; reach m, how far inside the case edge the
    piston's end stands; velocity m/s of the piston out of the block, -d reach/dt; outer (4,) N, the generalised
    forces of all but the film (`gaps.loads.ball_joint`).
    """

    shaft_speed: float
    viscosity: float
    case_pressure: float
    cavitation_pressure: float
    piston_spin: float
    bore_spin: float
    chamber_pressure: OverTurn
    reach: OverTurn
    velocity: OverTurn
    outer: OverTurn


@dataclass(frozen=True)
class PistonFriction:
    """What a film does to its piston besides bearing it.

    force N along the bore, out of the block, beside the chamber's pressure on the nominal section; torque N m
    about its axis; moment (2,) N m of the axial shear about axes across the bore; power W, what both parts spend.
    """

    force: float
    torque: float
    moment: Array
    power: float


@dataclass(frozen=True)
class _Driven:
    """What drives a piston at one time: reach m, velocity m/s, chamber_pressure Pa, as `PistonDrive` has them."""

    reach: float
    velocity: float
    chamber_pressure: float


class PistonFilm:
    """Films of one floating piston on one mesh, cells = (around, along)."""

    def __init__(
        self,
        shape: PistonShape,
        drive: PistonDrive,
        laws: FilmLaws | None = None,
        physics: Physics | None = None,
        cells: tuple[int, int] = (48, 16),
    ) -> None:
        self.shape, self.drive = shape, drive
        self._physics = Physics() if physics is None else physics
        self._laws = laws_left(FilmLaws() if laws is None else laws, self._physics)
        walls = self._laws.walls
        assert walls is None or isinstance(walls, BoreWalls)
        self._walls: BoreWalls | None = walls
        mesh = rectangle((np.pi * shape.diameter, 1.0), cells, cell=Cell.QUADRILATERAL, periodic_x=True)
        # Of length one; what is engaged stretches its places and keeps their angles.
        self._unit = film_space(rename(mesh, {"bottom": "chamber", "top": "case"}))
        if self._walls is not None:
            around, along = self._unit.vertices.T
            self._unit = self._unit.moved(np.column_stack([around, closer_at_both(along)]))
        self._space = self._unit
        self._points, self._vertices = self._unit.points, self._unit.vertices.T
        angle = 2.0 * self._vertices[0] / shape.diameter
        # A stage asks for the same instant many times over.
        self._driven: Callable[[float], _Driven] = lru_cache(maxsize=4)(self._driven_at)
        self._towards = np.column_stack([np.cos(angle), np.sin(angle)])

    def space_at(self, time: float) -> FilmSpace:
        """The mesh over what is engaged at a time (s); raises FilmInputError where nothing is."""
        around, along = self._vertices
        axial = self.shape.guide_length - self._engaged(time) * (1.0 - along)
        if not np.array_equal(self._space.vertices[:, 1], axial):
            self._space = self._unit.moved(np.column_stack([around, axial]))
        return self._space

    def problem_at(self, time: float) -> FilmProblem:
        """The film of the piston in the middle of its bore at a time (s), walls relative to the mesh."""
        return self._problem(time, self._mesh_velocity(time), ZERO)

    def standing_at(self, time: float) -> FilmProblem:
        """The same in a mesh that stands, squeezed by the profiles that pass: of a piston held across its bore."""
        drive = self.drive
        _, along, around = self._relief(time, *self._points)
        bore = self._bore_relief(time, *self._points).around
        velocity = self._driven(time).velocity
        return self._problem(time, ZERO, -velocity * along - drive.piston_spin * around - drive.bore_spin * bore)

    def _problem(self, time: float, carried: Array, squeeze: Array) -> FilmProblem:
        """The film seen from a mesh that moves along the bore at `carried` (m/s), squeezed at dh/dt (m/s)."""
        space, drive, laws = self.space_at(time), self.drive, self._laws
        moving, fixed = self._velocities(time)
        film = Film(
            thickness=self._thickness(time, *self._points),
            viscosity=np.full((1, 1), drive.viscosity),
            velocity_moving=(moving[0], moving[1] - carried),
            velocity_fixed=(fixed[0], fixed[1] - carried),
            squeeze=squeeze,
            thickness_at_vertices=self._thickness(time, *self._vertices),
        )
        pressure = self._driven(time).chamber_pressure
        walls = None
        if self._walls is not None:
            stand = self._stand(time)
            walls = self._walls.at(space, stand)
            film = widened(space, film, pressure * self._walls.by_chamber(space, stand).opened)
        return FilmProblem(
            space=space,
            film=film,
            boundary={"chamber": Held(pressure), "case": Held(drive.case_pressure)},
            cavitation=self._physics.film_rupture,
            cavitation_pressure=drive.cavitation_pressure,
            fluid=laws.fluid,
            surface=laws.surface,
            asperities=laws.asperities,
            walls=walls,
        )

    def modes_at(self, time: float) -> Array:
        """Growth of the film by each coordinate at the vertices, (vertices, 4): -(cos, sin) (s, Lg - s)/Lg."""
        share = (self._engaged(time) / self.shape.guide_length * (1.0 - self._vertices[1]))[:, None]
        return -np.hstack([share * self._towards, (1.0 - share) * self._towards])

    def outer_at(self, time: float, position: Array, rate: Array) -> Outer:
        """Outer generalised forces; they depend on the shaft's angle alone."""
        return steady(self.drive.outer(self._angle(time)))

    def rubbed(self, stage: Stage) -> Rubbed:
        """What film and contact do to piston (moving) and bore."""
        return rubbed(stage.solution, self.asperities, stage.gap)

    def yielding(self, stage: Stage) -> Yielding | None:
        """How the parts have given way; None between rigid walls."""
        if self._walls is None:
            return None
        pressure = self._driven(stage.time).chamber_pressure
        return yielding(self._walls, stage, self._stand(stage.time), pressure)

    def friction(self, stage: Stage, by: Rubbed, given: Yielding | None = None) -> PistonFriction:
        """What film and contact do to the piston along and around the bore, told from what they do to its wall.

        `given`: the dents that it carries along.
        """
        space = stage.solution.problem.space
        radius, angle = 0.5 * self.shape.diameter, 2.0 * space.points[0] / self.shape.diameter
        walls = self._velocities(stage.time)
        around, along = (part * space.area for part in by.on_moving)
        stresses, velocities = (*by.on_moving, *by.on_fixed), (*walls[0], *walls[1])
        flank = self._flank_force(stage, by.contact, given)
        sheared = sum(float(np.sum(t * u * space.area)) for t, u in zip(stresses, velocities, strict=True))
        return PistonFriction(
            force=float(along.sum()) + flank,
            torque=radius * float(around.sum()),
            moment=radius * np.array([np.sum(along * np.sin(angle)), -np.sum(along * np.cos(angle))]),
            power=-sheared - flank * float(walls[0][1].item()),
        )

    def _flank_force(self, stage: Stage, contact: Array, given: Yielding | None) -> float:
        """Force (N) out of the block of pressure on the piston's profile and dents, beside a plain piston's.

        -int (p - p_case) d relief/dy dA of film and contact, and the chamber's pressure on what is taken off where
        the film begins: a groove filled with one pressure pushes nowhere.
        """
        solution, drive = stage.solution, self.drive
        space, (around, along) = solution.problem.space, self._points
        above = evaluate(solution, stage.borne)[0] - drive.case_pressure
        chamber = self._driven(stage.time).chamber_pressure - drive.case_pressure
        taken_off = self._relief(stage.time, *self._vertices).depth
        slope = self._relief(stage.time, around, along).along
        if given is None:
            above = above + contact
        else:
            taken_off, slope = taken_off + given.dented, slope + given.slope(solution)
        return -float(np.sum(above * slope * space.area)) - chamber * self._on_chamber_edge(taken_off)

    def _relief(self, time: float, around: Array, along: Array) -> Relief:
        """What is taken off the piston at places of the unit mesh; it moves and turns with the piston."""
        reach = self._driven(time).reach
        depth = self._engaged(time) * (1.0 - along)
        return self.shape.piston(reach - depth, 2.0 * around / self.shape.diameter - self.drive.piston_spin * time)

    def _on_chamber_edge(self, at_vertices: Array) -> float:
        """Integral (m2) along the film's edge at the chamber of lengths (vertices,) m."""
        nodal = np.zeros(self._unit.size)
        nodal[self._unit.vertex_dofs] = at_vertices
        return float(nodal[self._unit.edge_dofs["chamber"]] @ self._unit.edge_share["chamber"])

    def chamber_flow(self, stage: Stage, flows: Mapping[str, float], given: Yielding | None) -> float:
        """Flow (m3/s) out of the chamber, which grows by the piston's nominal section and by what `given` swells.

        `flows` out of the film as `reynolds.solve.loads.boundary_flows` has them. The film's edge moves with the
        piston's end and sweeps the clearance there, which flows out besides; what is taken off the piston never
        was part of the section.
        """
        swept = 0.0
        if self._driven(stage.time).reach < self.shape.guide_length:
            clearance = vertex_thickness(stage.solution) - (0.0 if given is None else given.opened)
            swept = self._on_chamber_edge(clearance)
        return self.standing_flow(stage, flows) + self._driven(stage.time).velocity * swept

    def standing_flow(self, stage: Stage, flows: Mapping[str, float]) -> float:
        """The same (m3/s) in a mesh that stands (`standing_at`)."""
        velocity = self._driven(stage.time).velocity
        taken_off = self._on_chamber_edge(self._relief(stage.time, *self._vertices).depth)
        return -velocity * taken_off - flows["chamber"]

    @property
    def asperities(self) -> Asperities | None:
        """What touches where the walls do."""
        return self._laws.asperities

    def _angle(self, time: float) -> float:
        return self.drive.shaft_speed * time

    def _driven_at(self, time: float) -> _Driven:
        drive, angle = self.drive, self._angle(time)
        return _Driven(
            float(drive.reach(angle)), float(drive.velocity(angle)), float(drive.chamber_pressure(angle))
        )

    def _stand(self, time: float) -> Stand:
        """How piston and bore stand beside the film."""
        drive = self.drive
        return Stand(self._driven(time).reach, drive.piston_spin * time, drive.bore_spin * time)

    def _engaged(self, time: float) -> float:
        """Length of the film (m): up to the piston's end, or to the guide's where the piston passes it."""
        reach = self._driven(time).reach
        if not reach > 0.0:
            where = f"piston at {np.degrees(self._angle(time)) % 360.0:.1f} deg"
            raise FilmInputError(where, f"its end {reach * 1e3:.3g} mm inside the bore", "an engaged length")
        return min(reach, self.shape.guide_length)

    def _velocities(self, time: float) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Velocity of piston and bore, m/s, around and along."""
        radius, drive = 0.5 * self.shape.diameter, self.drive
        axial = np.full((1, 1), self._driven(time).velocity)
        piston, bore = (np.full((1, 1), spin * radius) for spin in (drive.piston_spin, drive.bore_spin))
        return (piston, axial), (bore, ZERO)

    def _mesh_velocity(self, time: float) -> Array:
        """Velocity of the mesh along the bore, m/s: that of the piston at its end, none at the case edge.

        As the mesh's own rate it is what makes a stretching film store as much oil as the walls bring.
        """
        if self._driven(time).reach >= self.shape.guide_length:
            return ZERO
        return np.asarray(self._driven(time).velocity * (1.0 - self._points[1]))

    def _thickness(self, time: float, around: Array, along: Array) -> Array:
        """Film (m) of a centred piston at places of the unit mesh."""
        bore, piston = self._bore_relief(time, around, along).depth, self._relief(time, around, along).depth
        return np.asarray(self.shape.radial_clearance + bore + piston)

    def _bore_relief(self, time: float, around: Array, along: Array) -> Relief:
        """What is taken off the bore at places of the unit mesh; it turns with the block."""
        angle, depth = 2.0 * around / self.shape.diameter, self._engaged(time) * (1.0 - along)
        return self.shape.bore(depth, angle - self.drive.bore_spin * time)


def widened(space: FilmSpace, film: Film, opened: Array) -> Film:
    """A film whose walls open at the vertices by (vertices,) m that its own pressure does not cause."""
    corners = film.thickness_at_vertices
    return replace(
        film,
        thickness=film.thickness + space.sample_vertices(opened),
        thickness_at_vertices=None if corners is None else corners + opened,
    )


def floating_piston(film: PistonFilm) -> Floating:
    """A piston as `reynolds.floating.problem` takes it: coordinates (ex0, ey0, ex1, ey1) m, massless across the
    bore.

    Validity: eccentricities and clearance small beside the radius; forces above case pressure.
    """
    return Floating("piston", film.problem_at, film.modes_at, film.outer_at, reference=film.drive.case_pressure)


def standing_piston(film: PistonFilm) -> Floating:
    """The same at one instant, for a piston that moves along its bore and turns but does not move across it."""
    return replace(floating_piston(film), shape_at=film.standing_at)
