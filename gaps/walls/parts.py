"""The parts that deform: meshed from their sizes, held as they are held in the pump, loaded by their film.

    piston      hollow or solid cylinder, free: films and the ball hold it, and its rigid motion is the gap's own
    bushing     ring in the block out to the middle of the web, where it slides against the wall of the next bore
    slipper     flange on its socket: rigid over the ball, the rim bends about it
    plate       swash plate or valve plate, its back on the cradle or on the end case

A part lies in its film's own axes: slipper and valve plate under the plane z = 0, swash plate and block over it (made
from sizes under it, which is their mirror image). Cells resolve the bending of the parts; finer deformations of a body
have the size of its face's cells. `own` puts a user's mesh in place of any of them.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gaps.shapes.slipper_lands import Land
from gaps.walls.user_mesh import CHAMBER, FILM, HELD, POCKET, OwnMesh, own_body, with_faces
from reynolds.bodies.chart import Cylinder, OnSphere, Plane, Side
from reynolds.bodies.compliance import ElasticWalls
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.mesh import BodyMesh, disc, hollow_cylinder
from reynolds.bodies.supports import Supports
from reynolds.bodies.wall import Body, body_wall, face_wall
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.fem.sphere import PLANE, Sphere
from reynolds.laws.law import require_positive
from reynolds.numerics.arrays import Array

TOWARDS_FILM = Plane((0.0, 0.0, 1.0))
PINHOLE = 0.05  # of a pocket's radius
NEAR = 1e-6  # of a radius: on a mesh line or not
Cells = tuple[int, int, int]
Grooves = tuple[tuple[str, Land], ...]
EDGES = 0.8  # of a row's length along a bore, taken off at an edge and added where rows are widest


@dataclass(frozen=True)
class PistonPart:
    """A piston's outer and inner diameter (m, inner 0: solid) and length from its chamber end (m)."""

    diameter: float
    inner_diameter: float
    length: float
    elastic: Elastic
    own: OwnMesh | None = None

    def __post_init__(self) -> None:
        require_positive("piston body", diameter=self.diameter, length=self.length)
        if not 0.0 <= self.inner_diameter < self.diameter:
            raise FilmInputError("piston body", f"inner diameter {self.inner_diameter:.4g} m", "0 to the diameter")


@dataclass(frozen=True)
class BushingPart:
    """A bore's diameter, the wall around it and the guide's length (m).

    `wall` reaches to the middle of the web between two bores.
    """

    diameter: float
    wall: float
    length: float
    elastic: Elastic
    own: OwnMesh | None = None

    def __post_init__(self) -> None:
        require_positive("bushing body", diameter=self.diameter, wall=self.wall, length=self.length)


@dataclass(frozen=True)
class SlipperPart:
    """A slipper's flange (m): radii of orifice, pocket, socket and rim, its thickness, and closed grooves.

    grooves: name of the film's edge, and radii from and to.
    """

    orifice_radius: float
    pocket_radius: float
    socket_radius: float
    outer_radius: float
    thickness: float
    elastic: Elastic
    own: OwnMesh | None = None
    grooves: Grooves = ()

    def __post_init__(self) -> None:
        require_positive("slipper body", orifice=self.orifice_radius, thickness=self.thickness)
        radii = np.array([self.orifice_radius, self.pocket_radius, self.outer_radius])
        if not (np.all(np.diff(radii) > 0.0) and self.orifice_radius < self.socket_radius <= self.outer_radius):
            found = f"orifice, pocket, rim {radii.tolist()} m, socket {self.socket_radius:.4g} m"
            raise FilmInputError("slipper body", found, "radii that rise, the socket between orifice and rim")


@dataclass(frozen=True)
class PlatePart:
    """A plate under a film (m): inner (0: none) and outer radius about the film's origin, thickness.

    `pocket_radius`: of the pocket that presses on it beside the film (0: none), as `grooves` do. `over_film`: a
    user's mesh of it lies over the film, not under it. `sphere`: of its face, through the origin.
    """

    inner_radius: float
    outer_radius: float
    thickness: float
    elastic: Elastic
    pocket_radius: float = 0.0
    over_film: bool = False
    own: OwnMesh | None = None
    grooves: Grooves = ()
    sphere: Sphere = PLANE

    def __post_init__(self) -> None:
        require_positive("plate body", radius=self.outer_radius, thickness=self.thickness)
        if not 0.0 <= max(self.inner_radius, self.pocket_radius) < self.outer_radius:
            found = f"inner radius {self.inner_radius:.4g} m, pocket {self.pocket_radius:.4g} m"
            raise FilmInputError("plate body", found, "0 to the outer radius")


def piston_body(part: PistonPart, cells: Cells = (3, 16, 18)) -> Body:
    """The piston about z, its chamber end at z = 0; faces outer (film), bottom, top and, hollow, inner.

    `chamber` is its end and its inside: where the chamber's pressure is.

    Free: no point of it is held in the pump. The resultant of films, ball and inertia bends nothing (inertia relief),
    and rigid motion is the gap's own coordinates. The ball's force, which the film's balances, is spread over the
    volume: the bending that it causes between ball and bore is neglected.
    """
    radius = 0.5 * part.diameter
    chart = Cylinder(radius, Side.SHAFT)
    if part.own:
        return own_body(part.own, part.elastic, chart)
    if part.inner_diameter > 0.0:
        mesh = hollow_cylinder((0.5 * part.inner_diameter, radius), part.length, cells)
    else:
        mesh = disc(radius, part.length, (max(cells[1] // 4, 1), cells[0], cells[2]))
    mesh = _drawn(mesh, part.length, cells[2], closer_at_start)
    wet = [mesh.mesh.boundaries[name] for name in ("bottom", "inner") if name in mesh.face_names]
    mesh = with_faces(mesh, {CHAMBER: np.concatenate(wet)})
    return Body(mesh, part.elastic, Supports(), "outer", chart)


def bushing_body(part: BushingPart, cells: Cells = (3, 16, 18)) -> Body:
    """The bore's wall about z from the guide's inner end, z = 0, to its case edge; faces inner (film), outer.

    Its outer face slides: between two equal bores the middle of the web does not move sideways. Stiffer than a bore
    beside one at low pressure, far stiffer than a ring of its own (Lame's).
    """
    radius = 0.5 * part.diameter
    chart = Cylinder(radius, Side.BORE)
    if part.own:
        return own_body(part.own, part.elastic, chart)
    mesh = _drawn(
        hollow_cylinder((radius, radius + part.wall), part.length, cells), part.length, cells[2], closer_at_end
    )
    return Body(mesh, part.elastic, Supports(symmetry=("outer",)), "inner", chart)


def slipper_body(part: SlipperPart, cells: Cells = (8, 24, 2)) -> Body:
    """The slipper's flange under z = 0; faces film (on top, from just inside the pocket's edge), pocket, held.

    Held where the ball presses, on the back up to the socket's radius: the gap's coordinates are those of the
    socket. Mesh lines lie on the pocket's and the socket's edge.
    """
    if part.own:
        return own_body(part.own, part.elastic, TOWARDS_FILM)
    edges = part.pocket_radius, part.socket_radius, *_edges(part.grooves)
    mesh = _rings(part.orifice_radius, edges, part.outer_radius, part.thickness, cells)
    mesh = with_faces(
        mesh,
        {
            FILM: _facets(mesh, "top", from_cell_over=part.pocket_radius),
            POCKET: _facets(mesh, "top", up_to=part.pocket_radius),
            HELD: _facets(mesh, "bottom", up_to=part.socket_radius),
        }
        | _groove_faces(mesh, part.grooves),
    )
    return Body(mesh, part.elastic, Supports(clamped=(HELD,)), FILM, TOWARDS_FILM)


def plate_body(part: PlatePart, cells: Cells = (6, 36, 2)) -> Body:
    """A plate under z = 0; faces top (film), bottom, outer and, with a hole, inner; with a pocket, pocket.

    Its back is held: the swash plate's on the cradle bearing, the valve plate's on the end case. Ports are not cut out:
    a valve plate is modelled as its solid ring. About a pocket's middle the mesh leaves a pinhole.
    """
    if part.own:
        return own_body(part.own, part.elastic, OnSphere(part.sphere, part.over_film))
    if part.pocket_radius > part.inner_radius:
        hole = part.inner_radius or PINHOLE * part.pocket_radius
        edges = part.pocket_radius, *_edges(part.grooves)
        mesh = _rings(hole, edges, part.outer_radius, part.thickness, cells)
        pocket = {POCKET: _facets(mesh, "top", up_to=part.pocket_radius)}
        mesh = with_faces(mesh, pocket | _groove_faces(mesh, part.grooves))
    elif part.inner_radius > 0.0:
        mesh = _rings(part.inner_radius, (), part.outer_radius, part.thickness, cells)
    else:
        across = max(cells[1] // 4, 1)
        mesh = disc(part.outer_radius, part.thickness, (across, cells[0], cells[2]), bottom=-part.thickness)
    # A body over a film is its mirror image under one: there the sphere bulges the other way.
    sphere = Sphere(-part.sphere.radius) if part.over_film else part.sphere
    return Body(_on(sphere, mesh), part.elastic, Supports(clamped=("bottom",)), "top", OnSphere(sphere))


def part_wall(body: Body, film: FilmSpace, *, folder: Path | None = None) -> ElasticWalls:
    """Compliance of one part for its film, by the smaller number: its face's nodes or the film's unknowns.

    Pocket and grooves of the film press on the part's faces of those names, where it has them. Raises
    FilmInputError where the face does not lie under the film.
    """
    alone = [name for name, unknowns in film.edge_dofs.items() if len(unknowns) == 1]
    pockets = {name: name for name in alone if name in body.mesh.face_names}
    found = face_wall(body, film, pockets=pockets, folder=folder)
    if 2 * found.matrix.rank < film.size:
        return found
    return body_wall(body, film, pockets=pockets, folder=folder)


def _rings(start: float, edges: tuple[float, ...], end: float, thickness: float, cells: Cells) -> BodyMesh:
    """An annular plate under z = 0 with mesh lines at radii `edges`, about cells[0] in all across it."""
    knots = np.unique([start, *edges, end])
    spaces = np.maximum(1, np.round(cells[0] * np.diff(knots) / (end - start))).astype(int)
    within = [np.linspace(a, b, n + 1)[1:] for a, b, n in zip(knots[:-1], knots[1:], spaces, strict=True)]
    lines = np.concatenate([knots[:1], *within])
    body = hollow_cylinder((start, end), thickness, (len(lines) - 1, *cells[1:]), bottom=-thickness)
    # Moved radius by radius, arcs stay arcs.
    places = body.mesh.doflocs.copy()
    radius = np.hypot(*places[:2])
    places[:2] *= np.interp(radius, np.linspace(start, end, len(lines)), lines) / radius
    return replace(body, mesh=replace(body.mesh, doflocs=places))


def _drawn(body: BodyMesh, length: float, cells: int, draw: Callable[[Array], Array]) -> BodyMesh:
    """A body from z = 0 to a length (m) with its even layers of cells drawn along z."""
    layers = np.linspace(0.0, 1.0, cells + 1)
    places = body.mesh.doflocs.copy()
    places[2] = np.interp(places[2], length * layers, length * draw(layers))
    return replace(body, mesh=replace(body.mesh, doflocs=places))


def _on(sphere: Sphere, body: BodyMesh) -> BodyMesh:
    """A plate whose top is that sphere, its thickness along z as it was; straight edges become parabolas."""
    if sphere.is_plane:
        return body
    places = body.mesh.doflocs.copy()
    reach = np.hypot(*places[:2])
    places[2] -= sphere.radius * (1.0 - np.sqrt(1.0 - (reach / sphere.radius) ** 2))
    return replace(body, mesh=replace(body.mesh, doflocs=places))


def _edges(grooves: Grooves) -> tuple[float, ...]:
    return tuple(radius for _, radii in grooves for radius in radii)


def _groove_faces(body: BodyMesh, grooves: Grooves) -> dict[str, NDArray[np.int64]]:
    """The facets of the top between the radii of each groove."""
    return {
        name: np.setdiff1d(_facets(body, "top", up_to=b), _facets(body, "top", up_to=a)) for name, (a, b) in grooves
    }


def _facets(body: BodyMesh, face: str, *, up_to: float = np.inf, from_cell_over: float = 0.0) -> NDArray[np.int64]:
    """Facets of a face within a radius, and from the ring of cells on that ends at another.

    A film's sectors are straight: their middles lie a little inside the radius at which the film begins.
    """
    mesh = body.mesh
    facets = np.asarray(mesh.boundaries[face])
    outer = np.hypot(*mesh.p[:2])[mesh.facets[:, facets]].max(axis=0)
    return facets[(outer < up_to * (1.0 + NEAR)) & (outer > from_cell_over * (1.0 - NEAR))]


@dataclass(frozen=True)
class Pose:
    """Pose of both parts relative to the film: reach (m) of a piston's chamber end inside the case edge, angles.

    Angles (rad) in the film's axes: of the moving part (piston, slipper, block) and fixed one (bushing, plate).
    """

    reach: float = 0.0
    moving: float = 0.0
    fixed: float = 0.0


def closer_at_both(share: Array) -> Array:
    """Even shares (0 .. 1) of a bore's length drawn to both edges, whose wedges bear; widest in the middle."""
    return np.asarray(share - EDGES / (2.0 * np.pi) * np.sin(2.0 * np.pi * share))


def closer_at_start(share: Array) -> Array:
    """Even shares drawn to the first edge, as they were in the middle and widest at the last."""
    return np.asarray(share - EDGES / np.pi * np.sin(np.pi * share))


def closer_at_end(share: Array) -> Array:
    """The mirror image of `closer_at_start`."""
    return 1.0 - closer_at_start(1.0 - share)
