"""The ring between cylinder block and valve plate: its mesh, which turns with the block, and the ports under it.

Kidneys are holes of the mesh, kidney_1 about angle 0 at shaft angle 0; the film plane (pump's x, y, x to the inner dead
centre) does not turn. Ports are sectors of the valve plate between R2 and R3. Webs between kidneys that lie over a port
are at its pressure and are no film; a port's edge lies on the next mesh line inside it. Outer bearing pads
(`gaps.shapes.bearing_pads`) are cells of their own, fixed to the plate.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gaps.shapes.bearing_pads import EDGE, BearingPads, with_pads
from gaps.shapes.round_mesh import round_scale
from reynolds.fem.mesh import FilmMesh, rename, ring
from reynolds.fem.space import FilmSpace, film_space
from reynolds.fem.sphere import PLANE, Sphere
from reynolds.numerics.arrays import Array

SEALED = 1e6  # viscosity of a web over a port, in oil's: the film passes nothing there; laws of oil reach that far

Arc = tuple[float, float]
"""From and to, rad, in pump angle."""


@dataclass(frozen=True)
class ValvePlateGeometry:
    """Land radii R1 < R2 < R3 < R4 (m), chambers, kidney arc (rad) and the ports' arcs.

    Ports are sectors of the valve plate between R2 and R3, in pump angle, divided by the webs (from, to) in them that
    are flush with its face; `turned` is the angle (rad) from which the plate's own angles count, its ports', webs',
    pads' and face's; kidneys are modelled as sectors of the same width (without rounded ends: their effect on the webs
    is under 0.1 of a web). Radii are distances from the shaft axis, also on a `sphere`: its radius is positive where
    the plate bulges into a hollow block.
    """

    land_radii: tuple[float, float, float, float]
    pistons: int
    kidney_arc: float
    suction_arc: Arc
    delivery_arc: Arc
    webs: tuple[Arc, ...] = ()
    turned: float = 0.0
    pads: tuple[BearingPads, ...] = ()
    sphere: Sphere = PLANE

    @property
    def suction(self) -> tuple[Arc, ...]:
        """Arcs of the suction port's kidneys."""
        return self._parted(self.suction_arc)

    @property
    def delivery(self) -> tuple[Arc, ...]:
        """Arcs of the delivery port's kidneys."""
        return self._parted(self.delivery_arc)

    def _parted(self, arc: Arc) -> tuple[Arc, ...]:
        inside = sorted(web for web in self.webs if arc[0] < web[0] and web[1] < arc[1])
        edges = [self.turned + edge for edge in (arc[0], *(end for web in inside for end in web), arc[1])]
        return tuple(zip(edges[::2], edges[1::2], strict=True))

    @property
    def case_edges(self) -> tuple[str, ...]:
        """Names of the boundaries at case pressure."""
        return ("inner", "outer", EDGE) if self.pads else ("inner", "outer")

    @property
    def outer_radius(self) -> float:
        """Outer radius of lands and pads, m."""
        return max(self.land_radii[3], *(pads.outer_radius for pads in self.pads), 0.0)

    @property
    def pitch(self) -> float:
        """Angle from kidney to kidney, rad."""
        return 2.0 * np.pi / self.pistons

    @property
    def kidneys(self) -> tuple[str, ...]:
        """Names of the kidneys' boundaries, in the order of the chambers."""
        return tuple(f"kidney_{k + 1}" for k in range(self.pistons))

    def kidney_places(self, shaft_angle: float) -> Array:
        """Middles of the kidneys in pump angle, (z,) rad."""
        return np.asarray(shaft_angle + self.pitch * np.arange(self.pistons), dtype=float)

    @property
    def kidney_area(self) -> float:
        """Area of a kidney projected along the shaft, m2."""
        _, r2, r3, _ = self.land_radii
        return 0.5 * self.kidney_arc * (r3**2 - r2**2)

    @cached_property
    def kidney_lever(self) -> float:
        """Moment of a unit pressure on a kidney about the face's middle, m3.

        2 sin(arc/2) int r^2/(1 - r^2/R^2)^(1/2) dr on a sphere of radius R, whose normals meet in its centre.
        """
        _, r2, r3, _ = self.land_radii
        node, weight = np.polynomial.legendre.leggauss(16)
        radius = 0.5 * (r2 + r3) + 0.5 * (r3 - r2) * node
        lever = radius**2 / np.sqrt(1.0 - (radius / self.sphere.radius) ** 2)
        return float(np.sin(0.5 * self.kidney_arc) * (r3 - r2) * (weight @ lever))


class Ring:
    """The ring's space; cells = (cells across a land, cells a kidney pitch), mesh lines on the kidneys' edges.

    `space` is that of the film, on a sphere if the face is one; `column` the mean angle (rad) of a cell.
    """

    def __init__(self, geometry: ValvePlateGeometry, cells: tuple[int, int]) -> None:
        self.geometry = geometry
        ring_mesh = _ring_mesh(geometry, cells)
        # Pressure over a pad is a parabola, over a land nearly a line: twice the cells.
        mesh = with_pads(ring_mesh, geometry.pads, 2 * cells[0], geometry.turned) if geometry.pads else ring_mesh
        drawn = film_space(mesh)
        self.space = _on(geometry.sphere, drawn)
        self.column = geometry.pitch / cells[1]
        self._vertices, self._cells = ring_mesh.mesh.p.shape[1], ring_mesh.mesh.t.shape[1]
        radius = np.hypot(*drawn.vertices.T)
        _, r2, r3, _ = np.array(geometry.land_radii) * radius[: self._vertices].max() / geometry.land_radii[3]
        self._in_kidney_ring = (radius > r2 * (1.0 - 1e-9)) & (radius < r3 * (1.0 + 1e-9))

    def turned(self, shaft_angle: float) -> FilmSpace:
        """The space with the block at a shaft angle (rad); pads do not move."""
        return self.space.moved(self._at(shaft_angle))

    def turns_with_block(self, space: FilmSpace) -> NDArray[np.bool_]:
        """Cells of the ring, which turn, not those of the pads, (cells, 1)."""
        return (np.arange(len(space.cells)) < self._cells)[:, None]

    def nodes_over(self, space: FilmSpace, arcs: tuple[Arc, ...]) -> NDArray[np.signedinteger]:
        """Unknowns over a port's kidneys (rad), those of the block's kidneys and of the edges included."""
        over = [self._vertices_in(space.vertices, arc) for arc in arcs]
        return np.unique(space.vertex_dofs[np.any(over, axis=0)])

    def over_port(self, space: FilmSpace) -> NDArray[np.bool_]:
        """Cells that lie over a port with all their corners, (cells, 1)."""
        arcs = (*self.geometry.suction, *self.geometry.delivery)
        over = [self._vertices_in(space.vertices, arc)[space.cells].all(axis=1) for arc in arcs]
        return np.any(over, axis=0)[:, None]

    def port_nodes(self, space: FilmSpace, suction: float, delivery: float) -> Array:
        """Pressure (size,) Pa of the unknowns over a port, NaN elsewhere and on the kidneys' edges."""
        nodes = np.full(space.size, np.nan)
        nodes[self.nodes_over(space, self.geometry.suction)] = suction
        nodes[self.nodes_over(space, self.geometry.delivery)] = delivery
        for name in self.geometry.kidneys:
            nodes[space.edge_dofs[name]] = np.nan
        return nodes

    def _at(self, angle: float) -> Array:
        """Vertices (n, 2) m with the block at a shaft angle (rad)."""
        vertices = self.space.vertices.copy()
        vertices[: self._vertices] = _turned(vertices[: self._vertices], angle)
        return vertices

    def _vertices_in(self, vertices: Array, arc: tuple[float, float]) -> NDArray[np.bool_]:
        """Vertices of the kidney ring that lie over a port, its edges included."""
        angle = np.arctan2(vertices[:, 1], vertices[:, 0])
        span = (angle - arc[0] + 1e-9) % (2.0 * np.pi)
        return self._in_kidney_ring & (span <= arc[1] - arc[0] + 2e-9)


def _on(sphere: Sphere, drawn: FilmSpace) -> FilmSpace:
    """The film on a sphere, drawn by distances from its axis."""
    if sphere.is_plane:
        return drawn
    stretch = sphere.stretch(np.hypot(*drawn.vertices.T))
    return replace(drawn, vertices=np.ascontiguousarray(drawn.vertices * stretch[:, None]), sphere=sphere)


def _turned(vertices: Array, angle: float) -> Array:
    """Points (n, 2) rotated about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(vertices @ np.array([[c, s], [-s, c]]))


def _ring_mesh(geometry: ValvePlateGeometry, cells: tuple[int, int]) -> FilmMesh:
    """The ring at shaft angle 0 with kidneys left out, kidney_1 about angle 0; lines on the kidneys' edges."""
    r1, r2, r3, r4 = geometry.land_radii
    land, per_pitch = cells
    lines = [np.linspace(a, b, land + 1) for a, b in ((r1, r2), (r2, r3), (r3, r4))]
    pitch = geometry.pitch
    per_kidney = min(max(round(per_pitch * geometry.kidney_arc / pitch), 1), per_pitch - 1)
    around = per_pitch * geometry.pistons
    keep = np.ones((3 * land, around), dtype=bool)
    keep[land : 2 * land, np.arange(around) % per_pitch < per_kidney] = False
    mesh = ring(np.concatenate([lines[0], lines[1][1:], lines[2][1:]]), around, keep=keep)
    names = {f"hole_{k}": name for k, name in enumerate(geometry.kidneys)}
    mesh = rename(mesh, names)
    # Equal sectors become kidney and web of their own widths, the first kidney's middle at angle 0.
    x, y = mesh.mesh.p
    column = np.round(np.arctan2(y, x) / (2.0 * np.pi) * around) % around
    within = np.interp(column % per_pitch, [0, per_kidney, per_pitch], [0.0, geometry.kidney_arc, pitch])
    angle = column // per_pitch * pitch + within - 0.5 * geometry.kidney_arc
    corners = np.append(np.unique(np.round(angle % (2.0 * np.pi), 9)), 0.0)
    corners[-1] = corners[0] + 2.0 * np.pi
    places = round_scale(np.diff(corners)) * np.hypot(x, y) * np.vstack([np.cos(angle), np.sin(angle)])
    return replace(mesh, mesh=replace(mesh.mesh, doflocs=np.ascontiguousarray(places)))
