"""The cylinder block that floats on the valve plate: film and outer forces by its film thickness and two tilts.

Film plane: the pump's x, y (x to the inner dead centre), which does not turn; the mesh is the ring of
`gaps.shapes.valve_plate_ring` and turns with the block. Coordinates q = (h on the shaft axis, rise along x, rise
along y), m, rises over R4:

    h = face(r, angle) + q0 + q1 x/R4 + q2 y/R4.

On a spherical face the film plane is the sphere's map (`reynolds.fem.sphere`) and the film opens along its normals
n by n . (lift + W x (r - S)), W the block's turning about the spline S at height s:

    h = face(r, angle) + q0 n_z + (1 + s/R) (q1 x + q2 y)/R4, x, y distances from the axes:

a turning about the sphere's centre would not change the film.

The block is held sideways and turned at the spline, a point of the shaft: as it tilts about that point the shaft does
no work on it, so that moments count about it. The pressing forces are all forces from outside on block, pistons and
slippers but those of film and kidneys, D'Alembert's included (`wrench_about`).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gaps.films.friction import WallShear, wall_shear
from gaps.films.over_turn import OverTurn
from gaps.films.physics import FilmLaws, Physics, laws_left
from gaps.shapes.profiles import PLAIN, Profile, over_part
from gaps.shapes.valve_plate_ring import SEALED, Ring, ValvePlateGeometry
from gaps.walls.pair import while_turning
from gaps.walls.parts import Pose
from reynolds.bodies.compliance import ElasticWalls
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.fem.sphere import Sphere
from reynolds.floating.coordinates import Modes, contact_force, modes_on
from reynolds.floating.problem import Floating, Outer
from reynolds.floating.stage import FloatingStage
from reynolds.laws.contact import Asperities
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Film, FilmProblem, FilmSolution, Held

LEAST_LEVERAGE = 1e-3  # 1 + s/R: below, a tilt's effect is lost in round-off and shape


@dataclass(frozen=True)
class BlockDrive:
    """Drive of the block over the turn, SI.

    shaft_speed rad/s, viscosity Pa s, pressures Pa. chamber_pressure over a chamber's own angle, Pa: one for all
    or (z,), of each. press over the shaft angle, (3,): force along z (N, negative: towards the plate) and moments
    about x and y through the spline (N m) of all forces on the rotating group besides film and kidneys
    (`wrench_about`). spline_height: of the spline over the valve plate, m.
    """

    shaft_speed: float
    viscosity: float
    suction_pressure: float
    delivery_pressure: float
    case_pressure: float
    cavitation_pressure: float
    chamber_pressure: OverTurn
    press: OverTurn
    spline_height: float


def wrench_about(places: Array, forces: Array, spline_height: float) -> Array:
    """(sum of F_z N, moments about x and y N m), (..., 3), of forces (..., n, 3) N at places (..., n, 3) m, about S.

    S is the shaft's point at `spline_height` (m) over the valve plate, on the z axis: where the shaft holds the block
    sideways.
    """
    moments = np.cross(places - np.array([0.0, 0.0, spline_height]), forces)
    return np.concatenate([forces[..., 2:], moments[..., :2]], axis=-1).sum(axis=-2)


def generalised(wrench: Array, radius: float) -> Array:
    """Generalised forces (3,) N of a wrench (F_z, M_x, M_y): a rise q1 over R4 along x turns by -q1/R4 about y."""
    force, about_x, about_y = wrench
    return np.array([force, -about_y / radius, about_x / radius])


def kidney_wrench(geometry: ValvePlateGeometry, shaft_angle: float, above: Array) -> Array:
    """(F_z, M_x, M_y) of kidney pressures (z,) Pa above case pressure on the block, sectors with square ends.

    Moments about the middle of the face, as from any point of the shaft where the face is plane.
    """
    places = geometry.kidney_places(shaft_angle)
    lever = geometry.kidney_lever
    return np.array(
        [
            float(np.sum(above)) * geometry.kidney_area,
            float(above @ np.sin(places)) * lever,
            -float(above @ np.cos(places)) * lever,
        ]
    )


@dataclass(frozen=True)
class _Turned:
    """Quantities of one shaft angle that do not depend on the position.

    depth (cells, points) m of the face below its plane; over_port (cells, 1); chamber_pressure (z,) Pa; pressed
    (3,) N: generalised pressing forces and those of the kidneys.
    """

    modes: Modes
    depth: Array
    over_port: NDArray[np.bool_]
    chamber_pressure: Array
    pressed: Array


class BlockFilm:
    """Films of the floating block on a ring; cells = (across a land, a kidney pitch), see `Ring`."""

    def __init__(
        self,
        geometry: ValvePlateGeometry,
        drive: BlockDrive,
        face: Profile = PLAIN,
        laws: FilmLaws | None = None,
        physics: Physics | None = None,
        cells: tuple[int, int] = (4, 16),
    ) -> None:
        self.geometry, self.drive = geometry, drive
        self.ring = Ring(geometry, cells)
        self._leverage = _leverage(geometry.sphere, drive.spline_height)
        self._face = over_part(face, geometry.land_radii[0], geometry.outer_radius)
        self._physics = Physics() if physics is None else physics
        self._laws = laws_left(FilmLaws() if laws is None else laws, self._physics)
        self._named = np.unique(np.concatenate(list(self.ring.space.edge_dofs.values())))
        # A stage needs the same instant many times.
        self._turned: Callable[[float], _Turned] = lru_cache(maxsize=4)(self._turned_to)

    @property
    def space(self) -> FilmSpace:
        """The mesh at shaft angle 0."""
        return self.ring.space

    def problem_at(self, time: float) -> FilmProblem:
        """The film with the block's face on the plate (q = 0) at a time (s), velocities relative to the mesh."""
        turns = np.where(self.ring.turns_with_block(self.space), 1.0, 0.0)
        return self._problem(time, turns)

    def standing_at(self, time: float) -> FilmProblem:
        """The same with velocities relative to the plate: of a block that turns but does not wobble."""
        return self._problem(time, np.zeros((1, 1)))

    def _problem(self, time: float, turns: Array) -> FilmProblem:
        """The film in a frame that turns with the block where `turns` is one, with the plate where zero."""
        drive, laws, angle = self.drive, self._laws, self._angle(time)
        at = self._turned(angle)
        space, port = at.modes.space, at.over_port
        x, y, _ = space.points_in_space
        speed = np.where(port, 0.0, drive.shaft_speed)
        plate, block = turns, 1.0 - turns
        film = Film(
            thickness=at.depth,
            viscosity=np.where(port, SEALED * drive.viscosity, drive.viscosity),
            velocity_moving=(-block * speed * y, block * speed * x),
            velocity_fixed=(plate * speed * y, -plate * speed * x),
            squeeze=ZERO,
            thickness_at_vertices=self._shape(*space.vertices.T),
        )
        case = Held(drive.case_pressure)
        kidneys = zip(self.geometry.kidneys, at.chamber_pressure, strict=True)
        return FilmProblem(
            space=space,
            film=film,
            boundary=dict.fromkeys(self.geometry.case_edges, case) | {name: Held(float(p)) for name, p in kidneys},
            cavitation=self._physics.film_rupture,
            cavitation_pressure=drive.cavitation_pressure,
            held_nodes=self.ring.port_nodes(space, drive.suction_pressure, drive.delivery_pressure),
            fluid=laws.fluid,
            surface=laws.surface,
            asperities=laws.asperities,
            walls=self._walls(angle),
        )

    def _walls(self, angle: float) -> ElasticWalls | None:
        """Both walls with the block at a shaft angle (rad): pads and plates of different sectors turn past it."""
        walls = self._laws.walls
        if walls is None:
            return None
        if not self.geometry.pads and walls.alike_around:
            return walls.at(self.space, Pose())
        return while_turning(lambda at: walls.at(self.ring.turned(at), Pose(moving=at)), angle, self.ring.column)

    def modes_at(self, time: float) -> Array:
        """Growth of the film by each coordinate at the vertices, (vertices, 3): in a plane 1, x/R4, y/R4."""
        return self._turned(self._angle(time)).modes.at_vertices

    def outer_at(self, time: float, position: Array, rate: Array) -> Outer:
        """Pressing forces and the kidneys' lift at a time (s).

        A web over a port has no contact: its part is subtracted. Between elastic walls held nodes have none.
        """
        at, nothing, asperities = self._turned(self._angle(time)), np.zeros((3, 3)), self._laws.asperities
        if asperities is None or self._laws.walls is not None:
            return Outer(at.pressed, nothing, nothing)
        gap = at.depth + at.modes.at_points @ position
        contact = contact_force(asperities, gap, at.modes, at.over_port)
        return Outer(at.pressed - contact.force, -contact.slopes, nothing)

    def chamber_pressures(self, shaft_angle: float) -> Array:
        """Pressures (z,) Pa of the chambers, chamber k at shaft angle + (k - 1) pitch."""
        places = self.geometry.kidney_places(shaft_angle)
        known = [np.broadcast_to(self.drive.chamber_pressure(float(angle)), places.shape) for angle in places]
        return np.diagonal(known).copy()

    def wall_shear(self, stage: FloatingStage) -> WallShear:
        """Shear of film and contact on block (moving) and plate, webs over the ports counted as films."""
        return wall_shear(stage.solution, self.asperities, stage.gap, self._laws.thinning)

    def friction_torque(self, space: FilmSpace, by: WallShear) -> float:
        """Torque (N m) of film and contact against the block's turning, webs over the ports left out."""
        x, y, _ = space.points_in_space
        along_x, along_y = by.on_moving
        return -float(np.sum((x * along_y - y * along_x) * space.area * self.is_film(space)))

    def tilted_torque(self, stage: FloatingStage) -> float:
        """Torque (N m) about the shaft, against its turning, of the pressure on the block's tilted face.

        Pressure of film and kidneys presses along the block's own axis, about which it has no moment: the balance of
        the forces that tip the block then has a moment about the shaft's. It has no power on the block.
        """
        _, about_x, about_y = np.asarray(self.drive.press(self._angle(stage.time)))
        rise_x, rise_y = stage.q[1:] / self.geometry.land_radii[3]
        return float(about_x * rise_x + about_y * rise_y)

    def is_film(self, space: FilmSpace) -> Array:
        """One where there is a film, zero in webs over a port, (cells, 1)."""
        return np.where(self.ring.over_port(space), 0.0, 1.0)

    def inflows(self, solution: FilmSolution, flows: Mapping[str, float]) -> tuple[Array, float, float]:
        """Flow into the film from each kidney (z,), and from suction and delivery port at their edges, m3/s.

        `flows` out of the film by `reynolds.solve.loads.boundary_flows`.
        """
        space = solution.problem.space
        suction, delivery = (
            -float(solution.outflow[np.setdiff1d(self.ring.nodes_over(space, port), self._named)].sum())
            for port in (self.geometry.suction, self.geometry.delivery)
        )
        return np.array([-flows[name] for name in self.geometry.kidneys]), suction, delivery

    @property
    def asperities(self) -> Asperities | None:
        """Asperities of the walls, if rough."""
        return self._laws.asperities

    def _turned_to(self, angle: float) -> _Turned:
        space, radius = self.ring.turned(angle), self.geometry.land_radii[3]
        pressure = self.chamber_pressures(angle)
        above = pressure - self.drive.case_pressure
        lift = kidney_wrench(self.geometry, angle, above) * [1.0, self._leverage, self._leverage]
        wrench = np.asarray(self.drive.press(angle)) + lift
        return _Turned(
            modes=modes_on(space, self._modes(space)),
            depth=self._shape(*space.points),
            over_port=self.ring.over_port(space),
            chamber_pressure=pressure,
            pressed=generalised(wrench, radius),
        )

    def _modes(self, space: FilmSpace) -> Array:
        sphere, reach = space.sphere, self._leverage / self.geometry.land_radii[3]
        x, y, _ = sphere.place(*space.vertices.T)
        return np.column_stack([sphere.normal(*space.vertices.T)[2], reach * x, reach * y])

    def _shape(self, x: Array, y: Array) -> Array:
        """Relief of the plate's face (m), by radius and the plate's own angle."""
        off_axis = np.hypot(*self.geometry.sphere.place(x, y)[:2])
        return np.asarray(self._face(off_axis, np.arctan2(y, x) - self.geometry.turned).depth)

    def _angle(self, time: float) -> float:
        return self.drive.shaft_speed * time


def _leverage(sphere: Sphere, spline_height: float) -> float:
    """1 + s/R: film opened by turning about the spline, over that by turning about the face's middle."""
    leverage = 1.0 + spline_height / sphere.radius
    if abs(leverage) < LEAST_LEVERAGE:
        found = f"a sphere about a point {-sphere.radius:.4g} m over the plate, the spline {spline_height:.4g} m"
        raise FilmInputError("block, sphere", found, "points apart: about its centre a block turns without a film")
    return leverage


def floating_block(film: BlockFilm) -> Floating:
    """The block as a floating film: coordinates (h, rise x, rise y) m, massless.

    Validity: small tilts; a plane or spherical valve plate except for its face and ports; a spline without friction.
    """
    return Floating("block", film.problem_at, film.modes_at, film.outer_at, reference=film.drive.case_pressure)


def standing_block(film: BlockFilm) -> Floating:
    """The same at one instant, for a block that turns but does not move on its plate."""
    return replace(floating_block(film), shape_at=film.standing_at)
