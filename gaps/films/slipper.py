"""The slipper that floats on the swash plate: film, pocket and outer forces by its film thickness and two tilts.

Film plane: origin under the ball joint, x along the plate's steepest line, y its tilt axis, z the plate's normal
away from the block; it travels with the ball and does not turn. Coordinates q = (h under the ball, rise along x,
rise along y), m, rises over the outer radius r2 of the last land:

    h = face(r) + q0 + q1 x/r2 + q2 y/r2.

Boundaries: pocket, case, and groove_1, groove_2, .. between lands (`gaps.shapes.slipper_lands`).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from gaps.films.friction import WallShear, wall_shear
from gaps.films.over_turn import OverTurn
from gaps.films.physics import FilmLaws, Physics, laws_left
from gaps.shapes.orifice_table import OrificeTable
from gaps.shapes.profiles import PLAIN, Profile, over_part
from gaps.shapes.slipper_lands import SlipperLands, slipper_mesh
from gaps.walls.pair import while_turning
from gaps.walls.parts import Pose
from reynolds.bodies.compliance import ElasticWalls
from reynolds.fem.space import FilmSpace, film_space
from reynolds.floating.problem import Floating, Outer
from reynolds.floating.stage import FloatingStage
from reynolds.laws.contact import Asperities
from reynolds.laws.law import Tangent, require_positive
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Boundary, Film, FilmProblem, Held, Pocket, no_feed

RIM_PLACES = 48  # around a slipper, at which its retainer presses
ROUND_OFF = 1e-13  # of a retainer's force


@dataclass(frozen=True)
class PocketOrifice:
    """Diameter and length (m) of the bore that feeds the pocket; flow coefficient of its ends, None: no loss there.

    With a flow coefficient Cd entry and exit lose rho/2 (q/(Cd A))^2 in addition to the laminar loss. A table gives the
    whole pressure drop, in place of both.
    """

    diameter: float
    length: float
    flow_coefficient: float | None = None
    table: OrificeTable | None = None


@dataclass(frozen=True)
class SlipperShape:
    """Lands and their grooves, the orifice, and the relief of the face; `face` counts places by the radius."""

    lands: SlipperLands
    orifice: PocketOrifice
    face: Profile = PLAIN

    @property
    def outer_radius(self) -> float:
        """Outer radius of the last land (m)."""
        return self.lands.outer_radius


@dataclass(frozen=True)
class Retainer:
    """A plate over the slippers: reached where the film at the rim exceeds `clearance` (m).

    stiffness N/m, of the whole rim together. Above a force of `limit` (N) the plate itself yields, as a spring of
    `rate` (N/m).
    """

    clearance: float
    stiffness: float
    limit: float = np.inf
    rate: float = 0.0


@dataclass(frozen=True)
class SlipperDrive:
    """Drive of a slipper over the turn, SI.

    shaft_speed rad/s; viscosity Pa s, density kg/m3, pressures Pa; spin rad/s about the plate's normal. Over the shaft
    angle: chamber_pressure Pa; sliding (2,) m/s over the plate along x and y; outer (3,) N, all generalised forces
    except those of film, pocket and retainer (`face_force`). inertia (3, 3) kg: generalised masses of the moving parts
    (`face_inertia`), None: massless.
    """

    shaft_speed: float
    viscosity: float
    density: float
    case_pressure: float
    cavitation_pressure: float
    spin: float
    chamber_pressure: OverTurn
    sliding: OverTurn
    outer: OverTurn
    retainer: Retainer | None = None
    inertia: Array | None = None


def face_force(outer_radius: float, lift: Array | float, pressed: Array) -> Array:
    """Generalised forces (..., 3) N that ask of a film a lift (...) N and int p (x, y) dA = pressed, (..., 2) N m."""
    return -np.concatenate([np.asarray(lift)[..., None], pressed / outer_radius], axis=-1)


def face_inertia(outer_radius: float, lifted: float, mass: float, centre_of_mass: float, tilt: float) -> Array:
    """Generalised masses (3, 3) kg of a slipper that moves with its piston along a bore tilted by `tilt` (rad).

    Both, `lifted` kg, move by h/cos(tilt) as the film grows by h. A slipper of `mass` kg tilts about the ball, its
    centre of mass l (m) from there: m (l^2 + r2^2/4), as a disc of its rim. Small compared with a film's damping, but
    decisive without it: when a slipper lifts off until its retainer stops it.
    """
    turned = mass * (centre_of_mass**2 + 0.25 * outer_radius**2) / outer_radius**2
    return np.diag([lifted / np.cos(tilt) ** 2, turned, turned])


def pressed_by(inertia: Array, centre_of_mass: float, friction: Array, ball_height: float, ball_moment: Array) -> Array:
    """int p (x, y) dA (N m) that the film must give to keep the slipper's moments about the ball in balance.

    l m A - H T + n x M: inertia m A (..., 2) N of its centre of mass, l (m) from the ball towards the face; friction T
    (..., 2) N of the plate on the face, H (m) from the ball; moment M (..., 2) N m of the joint on the slipper. All
    along the plate's x and y; the slipper's moments of inertia are neglected.
    """
    turned = np.stack([-ball_moment[..., 1], ball_moment[..., 0]], axis=-1)
    return np.asarray(centre_of_mass * inertia - ball_height * friction + turned)


def hagen_poiseuille_conductance(diameter: float, length: float, viscosity: float) -> float:
    """Laminar flow per pressure drop of a capillary, pi d^4/(128 mu l), m3/(s Pa); paper Eq. (16).

    Valid for l/d > 3 or so and Re d/l << 64; a short orifice adds rho/2 (q/(Cd A))^2.
    """
    return float(np.pi * diameter**4 / (128.0 * viscosity * length))


def orifice_and_capillary(drop: float, conductance: float, loss: float) -> Tangent:
    """Flow q (m3/s) and dq/d drop of a bore with laminar and Bernoulli's loss in series: drop = q/G + k q |q|.

    conductance G m3/(s Pa) by Hagen and Poiseuille; loss k = rho/(2 (Cd A)^2), Pa s2/m6, 0: none. Validity: laminar in
    the bore, Re d/l << 64 except for the loss k.
    """
    root = np.sqrt(1.0 + 4.0 * loss * conductance**2 * abs(drop))
    return Tangent(2.0 * conductance * drop / (1.0 + root), conductance / root)


def supply(shape: PocketOrifice, viscosity: float, density: float) -> Callable[[float], Tangent]:
    """Flow through the orifice by the pressure drop over it (Pa).

    viscosity Pa s, density kg/m3; raises FilmInputError for sizes that are not positive.
    """
    require_positive("slipper orifice", diameter=shape.diameter, length=shape.length, viscosity=viscosity)
    if (table := shape.table) is not None:
        return partial(table.flow, diameter=shape.diameter, viscosity=viscosity, density=density)
    conductance = hagen_poiseuille_conductance(shape.diameter, shape.length, viscosity)
    loss = 0.0
    if shape.flow_coefficient is not None:
        loss = 0.5 * density / (shape.flow_coefficient * 0.25 * np.pi * shape.diameter**2) ** 2
    return partial(orifice_and_capillary, conductance=conductance, loss=loss)


@dataclass(frozen=True)
class _Fed:
    """Inflow of a pocket (m3/s) by its pressure (Pa), and its slope: from a chamber (Pa) through its orifice."""

    chamber: float
    through: Callable[[float], Tangent]

    def __call__(self, pressure: float) -> tuple[float, float]:
        flow, slope = self.through(self.chamber - pressure)
        return float(flow), -float(slope)


def retainer_force(retainer: Retainer, position: Array) -> Outer:
    """Force of a retainer around the rim: springs k/N at N places there, where the film exceeds the clearance.

    P = -k mean <rise - clearance - u> (1, cos, sin) over the rim, rise = q0 + q1 cos + q2 sin, of a plate that has
    moved by u: pressure only, with a potential, so that it does no work over a turn.
    """
    angle = 2.0 * np.pi * np.arange(RIM_PLACES) / RIM_PLACES
    places = np.column_stack([np.ones(RIM_PLACES), np.cos(angle), np.sin(angle)])
    over = places @ position - retainer.clearance
    lifted = _plate_rise(retainer, over)
    pressed = np.maximum(over - lifted, 0.0)
    reached = places[pressed > 0.0]
    stiffness = retainer.stiffness / RIM_PLACES
    slopes = stiffness * reached.T @ reached
    if lifted > 0.0 and len(reached):
        along = stiffness * reached.sum(axis=0)
        slopes -= np.outer(along, along) / (stiffness * len(reached) + retainer.rate)
    return Outer(-stiffness * pressed @ places, -slopes, np.zeros((3, 3)))


def _plate_rise(retainer: Retainer, over: Array) -> float:
    """Rise u (m) of the plate at which k mean <over - u> is limit + rate u; 0 where it is less than the limit.

    By Newton's method, exact on a convex piecewise linear function.
    """
    lifted, smallest = 0.0, ROUND_OFF * retainer.stiffness * float(np.abs(over).max())
    for _ in range(RIM_PLACES):
        pressed = np.maximum(over - lifted, 0.0)
        rest = retainer.stiffness * float(pressed.mean()) - retainer.limit - retainer.rate * lifted
        if rest <= smallest:
            break
        lifted += rest / (retainer.stiffness * float(np.mean(pressed > 0.0)) + retainer.rate)
    return lifted


@dataclass(frozen=True)
class SlipperFriction:
    """Friction of a film on its slipper.

    force (2,) N along the plate's x and y: the opposite of that on the plate, so that pressure on the slope of
    the slipper's face counts; torque N m about its normal; power W, spent by slipper and plate on shearing the
    film, relative to the slipper.
    """

    force: Array
    torque: float
    power: float


class SlipperFilm:
    """Films of one floating slipper on a ring mesh, cells = (across each land, around)."""

    def __init__(
        self,
        shape: SlipperShape,
        drive: SlipperDrive,
        laws: FilmLaws | None = None,
        physics: Physics | None = None,
        cells: tuple[int, int] = (12, 48),
    ) -> None:
        self.shape, self.drive = shape, drive
        self._physics = Physics() if physics is None else physics
        self._laws = laws_left(FilmLaws() if laws is None else laws, self._physics)
        self._around = cells[1]
        self._space = film_space(slipper_mesh(shape.lands.radii, cells), pockets=shape.lands.closed)
        self._supply = supply(shape.orifice, drive.viscosity, drive.density)
        self._relief = over_part(shape.face, shape.lands.inner_radius, shape.lands.outer_radius)

    @property
    def space(self) -> FilmSpace:
        """The mesh, which travels with the ball."""
        return self._space

    def problem_at(self, time: float) -> FilmProblem:
        """The film with the slipper's face on the plate (q = 0) at a time (s), relative to the slipper."""
        space, drive, laws = self._space, self.drive, self._laws
        x, y = space.points
        along, across = drive.sliding(self._angle(time))
        film = Film(
            thickness=self._face(time, *space.points),
            viscosity=np.full((1, 1), drive.viscosity),
            velocity_moving=(-drive.spin * y, drive.spin * x),
            velocity_fixed=(np.full((1, 1), -float(along)), np.full((1, 1), -float(across))),
            squeeze=ZERO,
            thickness_at_vertices=self._face(time, *space.vertices.T),
        )
        return FilmProblem(
            space=space,
            film=film,
            boundary=self._boundary(time),
            cavitation=self._physics.film_rupture,
            cavitation_pressure=drive.cavitation_pressure,
            fluid=laws.fluid,
            surface=laws.surface,
            asperities=laws.asperities,
            walls=self._walls(time),
        )

    def _walls(self, time: float) -> ElasticWalls | None:
        """Both walls at a time (s); a spinning slipper of different sectors turns in its film."""
        walls = self._laws.walls
        if walls is None:
            return None
        if walls.alike_around or self.drive.spin == 0.0:
            return walls.at(self._space, Pose())
        column = 2.0 * np.pi / self._around
        return while_turning(lambda at: walls.at(self._space, Pose(moving=at)), self.drive.spin * time, column)

    def modes_at(self, time: float) -> Array:
        """Growth of the film by each coordinate at the vertices, (vertices, 3): 1, x/r2, y/r2."""
        x, y = self._space.vertices.T / self.shape.outer_radius
        return np.column_stack([np.ones_like(x), x, y])

    @property
    def pockets(self) -> dict[str, Array]:
        """Area (3,) m2 by which the volume of pocket and closed grooves grows with each coordinate."""
        return {name: np.array([area, 0.0, 0.0]) for name, area in self.shape.lands.closed_areas.items()}

    def outer_at(self, time: float, position: Array, rate: Array) -> Outer:
        """Outer generalised forces at a time (s) and position, with the retainer's."""
        given = np.asarray(self.drive.outer(self._angle(time)))
        if self.drive.retainer is None:
            return Outer(given, np.zeros((3, 3)), np.zeros((3, 3)))
        held = retainer_force(self.drive.retainer, position)
        return replace(held, force=given + held.force)

    def is_held(self, position: Array) -> bool:
        """True if the retainer presses at a position."""
        retainer = self.drive.retainer
        return retainer is not None and bool(retainer_force(retainer, position).force.any())

    def wall_shear(self, stage: FloatingStage) -> WallShear:
        """Shear of film and contact on slipper (moving) and plate."""
        return wall_shear(stage.solution, self.asperities, stage.gap, self._laws.thinning)

    def friction(self, stage: FloatingStage, by: WallShear) -> SlipperFriction:
        """Friction of film and contact of the lands on the slipper; friction of the pocket's oil is neglected."""
        space = stage.solution.problem.space
        x, y = space.points
        along, across = (part * space.area for part in by.on_moving)
        torque = float(np.sum(x * across - y * along))
        plate = np.array([np.sum(part * space.area) for part in by.on_fixed])
        sliding = np.asarray(self.drive.sliding(self._angle(stage.time)))
        return SlipperFriction(force=-plate, torque=torque, power=float(sliding @ plate) - self.drive.spin * torque)

    def supplied(self, stage: FloatingStage) -> tuple[float, float]:
        """Pressure (Pa) in the pocket and flow (m3/s) through the orifice into it."""
        solution = stage.solution
        pocket = float(solution.pressure[solution.problem.space.edge_dofs["pocket"][0]])
        return pocket, float(self._supply(self.chamber_pressure(stage.time) - pocket)[0])

    def throttling(self, stage: FloatingStage) -> float:
        """Flow through the orifice per pressure drop over it, m3/(s Pa), at its present flow."""
        pocket, fed = self.supplied(stage)
        drop = self.chamber_pressure(stage.time) - pocket
        return fed / drop if drop else float(self._supply(0.0)[1])

    def chamber_pressure(self, time: float) -> float:
        """Pressure (Pa) of the chamber at a time (s)."""
        return float(self.drive.chamber_pressure(self._angle(time)))

    @property
    def asperities(self) -> Asperities | None:
        """Asperities of the walls, if rough."""
        return self._laws.asperities

    def _angle(self, time: float) -> float:
        return self.drive.shaft_speed * time

    def _boundary(self, time: float) -> dict[str, Boundary]:
        lands, feed = self.shape.lands, _Fed(self.chamber_pressure(time), self._supply)
        still = {name: Pocket(no_feed) for name in lands.closed}
        return still | {"pocket": Pocket(feed)} | dict.fromkeys(lands.open, Held(self.drive.case_pressure))

    def _face(self, time: float, x: Array, y: Array) -> Array:
        """Relief of the face (m) at places; it turns with the slipper."""
        # The mesh's sectors are straight: between their corners the radius is a little less than the land's.
        radius = np.maximum(np.hypot(x, y), self.shape.lands.inner_radius)
        return np.asarray(self._relief(radius, np.arctan2(y, x) - self.drive.spin * time).depth)


def floating_slipper(film: SlipperFilm) -> Floating:
    """A slipper as a floating film: coordinates (h, rise x, rise y) m.

    Validity: film thin beside the land's width; forces above case pressure.
    """
    return Floating(
        "slipper",
        film.problem_at,
        film.modes_at,
        film.outer_at,
        reference=film.drive.case_pressure,
        pockets=film.pockets,
        inertia=film.drive.inertia,
    )
