"""The piston that floats in its bore: film, motion and forces by its eccentricities at both ends of the guide.

Film plane: x = radius x angle in [0, pi d), sewn; y along the bore's axis out of the block, from the guide's inner
end (0) to its case edge (guide_length). Angle 0 points to the inner dead centre's side; the plane does not turn
with the block, so that bore and piston both spin in it. Coordinates q = (ex0, ey0, ex1, ey1), m: the eccentricity
of the piston's axis at two stations fixed in the bore, the guide's inner end (0) and its case edge (1). With s the
depth inside the case edge, s = guide_length - y,

    h = c + bore(s) + piston(depth from its end) - e(s) . (cos, sin),   e(s) = e1 + (e0 - e1) s/guide_length.

The mesh covers the engaged length and stretches as the piston moves; wall velocities are relative to it. Between
elastic walls its rows are closer at both edges.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from gaps.films.friction import WallShear, wall_shear
from gaps.films.over_turn import OverTurn
from gaps.films.physics import FilmLaws, Physics, laws_left
from gaps.films.piston_deformation import PistonDeformation, piston_deformation, slope_along
from gaps.shapes.profiles import PLAIN, Profile, Relief
from gaps.walls.pair import BoreWalls
from gaps.walls.parts import Pose, closer_at_both
from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.errors import FilmInputError
from reynolds.fem.mesh import Cell, rectangle, rename
from reynolds.fem.space import FilmSpace, film_space
from reynolds.floating.problem import Floating, Outer, steady
from reynolds.floating.stage import FloatingStage
from reynolds.laws.contact import Asperities
from reynolds.laws.law import require_positive
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Film, FilmProblem, Held, widened
from reynolds.solve.loads import evaluate


@dataclass(frozen=True)
class PistonShape:
    """Piston diameter, radial clearance and guide length in the bore (m), and the relief of either part.

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
    """Drive of a piston over the turn, SI.

    shaft_speed rad/s; viscosity Pa s and pressures Pa; spins rad/s of piston and bore about the bore's axis in the
    frame that does not turn. Over the shaft angle: chamber_pressure Pa; reach m, depth of the piston's end inside the
    case edge; velocity m/s of the piston out of the block, -d reach/dt; outer (4,) N, all generalised forces except
    those of the film (`gaps.loads.ball_joint`).
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
    """Friction of a film on its piston.

    force N along the bore, out of the block, beside the chamber's pressure on the nominal section; torque N m
    about its axis; moment (2,) N m of the axial shear about axes across the bore; power W, spent by both parts.
    """

    force: float
    torque: float
    moment: Array
    power: float


@dataclass(frozen=True)
class _Driven:
    """Drive of a piston at one time: reach m, velocity m/s, chamber_pressure Pa, see `PistonDrive`."""

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
        # Of length one; the engaged length stretches it along the bore.
        self._unit = film_space(rename(mesh, {"bottom": "chamber", "top": "case"}))
        if self._walls is not None:
            around, along = self._unit.vertices.T
            self._unit = self._unit.moved(np.column_stack([around, closer_at_both(along)]))
        self._space = self._unit
        self._points, self._vertices = self._unit.points, self._unit.vertices.T
        angle = 2.0 * self._vertices[0] / shape.diameter
        # A stage needs the same instant many times.
        self._driven: Callable[[float], _Driven] = lru_cache(maxsize=4)(self._driven_at)
        self._towards = np.column_stack([np.cos(angle), np.sin(angle)])

    def space_at(self, time: float) -> FilmSpace:
        """The mesh over the engaged length at a time (s); raises FilmInputError where it is zero."""
        around, along = self._vertices
        axial = self.shape.guide_length - self._engaged(time) * (1.0 - along)
        if not np.array_equal(self._space.vertices[:, 1], axial):
            self._space = self._unit.moved(np.column_stack([around, axial]))
        return self._space

    def problem_at(self, time: float) -> FilmProblem:
        """The film of the piston in the middle of its bore at a time (s), walls relative to the mesh."""
        return self._problem(time, self._mesh_velocity(time), ZERO)

    def standing_at(self, time: float) -> FilmProblem:
        """The same in a fixed mesh, squeezed by the moving profiles: of a piston held across its bore."""
        drive = self.drive
        _, along, around = self._relief(time, *self._points)
        bore = self._bore_relief(time, *self._points).around
        velocity = self._driven(time).velocity
        return self._problem(time, ZERO, -velocity * along - drive.piston_spin * around - drive.bore_spin * bore)

    def _problem(self, time: float, mesh_velocity: Array, squeeze: Array) -> FilmProblem:
        """The film in a mesh that moves along the bore at `mesh_velocity` (m/s), squeezed at dh/dt (m/s)."""
        space, drive, laws = self.space_at(time), self.drive, self._laws
        moving, fixed = self._velocities(time)
        film = Film(
            thickness=self._thickness(time, *self._points),
            viscosity=np.full((1, 1), drive.viscosity),
            velocity_moving=(moving[0], moving[1] - mesh_velocity),
            velocity_fixed=(fixed[0], fixed[1] - mesh_velocity),
            squeeze=squeeze,
            thickness_at_vertices=self._thickness(time, *self._vertices),
        )
        pressure = self._driven(time).chamber_pressure
        walls = None
        if self._walls is not None:
            pose = self._pose(time)
            walls = self._walls.at(space, pose)
            film = widened(space, film, pressure * self._walls.by_chamber(space, pose).deformation)
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

    def wall_shear(self, stage: FloatingStage) -> WallShear:
        """Shear of film and contact on piston (moving) and bore."""
        return wall_shear(stage.solution, self.asperities, stage.gap, self._laws.thinning)

    def deformation(self, stage: FloatingStage) -> PistonDeformation | None:
        """Deformation of both parts; None between rigid walls."""
        if self._walls is None:
            return None
        pressure = self._driven(stage.time).chamber_pressure
        return piston_deformation(self._walls, stage, self._pose(stage.time), pressure)

    def friction(self, stage: FloatingStage, by: WallShear, given: PistonDeformation | None = None) -> PistonFriction:
        """Friction on the piston along and around the bore from the shear on its wall.

        `given`: the deformation, whose slope adds a force.
        """
        space = stage.solution.problem.space
        radius, angle = 0.5 * self.shape.diameter, 2.0 * space.points[0] / self.shape.diameter
        walls = self._velocities(stage.time)
        around, along = (part * space.area for part in by.on_moving)
        stresses, velocities = (*by.on_moving, *by.on_fixed), (*walls[0], *walls[1])
        above = self._above(stage, by.contact)
        flank = self._flank_force(stage, above, given)
        sheared = sum(float(np.sum(t * u * space.area)) for t, u in zip(stresses, velocities, strict=True))
        return PistonFriction(
            force=float(along.sum()) + flank + self._tilted_force(stage, above),
            torque=radius * float(around.sum()),
            moment=radius * np.array([np.sum(along * np.sin(angle)), -np.sum(along * np.cos(angle))]),
            power=-sheared - flank * float(walls[0][1].item()),
        )

    def _above(self, stage: FloatingStage, contact: Array) -> Array:
        """Pressure of film and contact above the case's (cells, points) Pa; that on elastic walls has contact in it."""
        found = evaluate(stage.solution, stage.wall_pressure)[0] - self.drive.case_pressure
        return np.asarray(found + contact if self._walls is None else found)

    def _flank_force(self, stage: FloatingStage, above: Array, given: PistonDeformation | None) -> float:
        """Force (N) out of the block of pressure on the piston's profile and deformation, beside a plain piston's.

        -int (p - p_case) d relief/dy dA of film and contact, and the chamber's pressure on the relief at the
        film's edge: a groove under one pressure has no force.
        """
        space, (around, along) = stage.solution.problem.space, self._points
        chamber = self._driven(stage.time).chamber_pressure - self.drive.case_pressure
        taken_off = self._relief(stage.time, *self._vertices).depth
        slope = self._relief(stage.time, around, along).along
        if given is not None:
            taken_off, slope = taken_off + given.piston, slope + slope_along(stage.solution, given.piston)
        return -float(np.sum(above * slope * space.area)) - chamber * self._on_chamber_edge(taken_off)

    def _tilted_force(self, stage: FloatingStage, above: Array) -> float:
        """Force (N) out of the block of pressure on a piston tilted in its bore, -int (p - p_case) d(phi q)/dy dA.

        The film's pressure acts across the piston's own axis, along which it slides: its share along the bore loads the
        piston and has no power.
        """
        slope = slope_along(stage.solution, self.modes_at(stage.time) @ stage.q)
        return -float(np.sum(above * slope * stage.solution.problem.space.area))

    def _relief(self, time: float, around: Array, along: Array) -> Relief:
        """Relief of the piston at places of the unit mesh; it moves and turns with the piston."""
        reach = self._driven(time).reach
        depth = self._engaged(time) * (1.0 - along)
        return self.shape.piston(reach - depth, 2.0 * around / self.shape.diameter - self.drive.piston_spin * time)

    def _on_chamber_edge(self, at_vertices: Array) -> float:
        """Integral (m2) along the film's edge at the chamber of lengths (vertices,) m."""
        nodal = np.zeros(self._unit.size)
        nodal[self._unit.vertex_dofs] = at_vertices
        return float(nodal[self._unit.edge_dofs["chamber"]] @ self._unit.edge_share["chamber"])

    def chamber_flow(self, stage: FloatingStage, flows: Mapping[str, float], given: PistonDeformation | None) -> float:
        """Flow (m3/s) out of the chamber, which grows by the piston's nominal section and the deformation `given`.

        `flows` out of the film by `reynolds.solve.loads.boundary_flows`. The film's edge moves with the piston's end
        and sweeps the clearance there, which is an additional outflow; the piston's relief is no part of the section.
        """
        swept = 0.0
        if self._driven(stage.time).reach < self.shape.guide_length:
            clearance = vertex_thickness(stage.solution) - (0.0 if given is None else given.film)
            swept = self._on_chamber_edge(clearance)
        return self.standing_flow(stage, flows) + self._driven(stage.time).velocity * swept

    def standing_flow(self, stage: FloatingStage, flows: Mapping[str, float]) -> float:
        """The same (m3/s) in a fixed mesh (`standing_at`)."""
        velocity = self._driven(stage.time).velocity
        taken_off = self._on_chamber_edge(self._relief(stage.time, *self._vertices).depth)
        return -velocity * taken_off - flows["chamber"]

    @property
    def asperities(self) -> Asperities | None:
        """Asperities of the walls, if rough."""
        return self._laws.asperities

    def _angle(self, time: float) -> float:
        return self.drive.shaft_speed * time

    def _driven_at(self, time: float) -> _Driven:
        drive, angle = self.drive, self._angle(time)
        return _Driven(float(drive.reach(angle)), float(drive.velocity(angle)), float(drive.chamber_pressure(angle)))

    def _pose(self, time: float) -> Pose:
        """Pose of piston and bore relative to the film."""
        drive = self.drive
        return Pose(self._driven(time).reach, drive.piston_spin * time, drive.bore_spin * time)

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

        With this rate a stretching film stores as much oil as the walls bring.
        """
        if self._driven(time).reach >= self.shape.guide_length:
            return ZERO
        return np.asarray(self._driven(time).velocity * (1.0 - self._points[1]))

    def _thickness(self, time: float, around: Array, along: Array) -> Array:
        """Film (m) of a centred piston at places of the unit mesh."""
        bore, piston = self._bore_relief(time, around, along).depth, self._relief(time, around, along).depth
        return np.asarray(self.shape.radial_clearance + bore + piston)

    def _bore_relief(self, time: float, around: Array, along: Array) -> Relief:
        """Relief of the bore at places of the unit mesh; it turns with the block."""
        angle, depth = 2.0 * around / self.shape.diameter, self._engaged(time) * (1.0 - along)
        return self.shape.bore(depth, angle - self.drive.bore_spin * time)


def floating_piston(film: PistonFilm) -> Floating:
    """A piston as a floating film: coordinates (ex0, ey0, ex1, ey1) m, massless across the
    bore.

    Validity: eccentricities and clearance small beside the radius; forces above case pressure.
    """
    return Floating("piston", film.problem_at, film.modes_at, film.outer_at, reference=film.drive.case_pressure)


def standing_piston(film: PistonFilm) -> Floating:
    """The same at one instant, for a piston that moves along its bore and turns but does not move across it."""
    return replace(floating_piston(film), shape_at=film.standing_at)
