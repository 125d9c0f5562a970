"""The gap between cylinder block and valve plate: the whole ring with its kidneys.

Film plane: the pump's x, y (x to the inner dead centre), which does not turn; the mesh turns with the block,
whose kidneys are holes in it. Webs between kidneys that lie over a port of the valve plate are at that port's
pressure and are no film: what flows between kidney and port there is the port's own flow, and not counted here.
Boundaries: inner, outer (case), kidney_1 .. kidney_z in the order of the chambers,
chamber k at shaft angle + (k - 1) pitch.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gaps.result import GapFilm, PositionSource, wall_power
from reynolds.film import ZERO, Cavitation, FilmProblem, FilmSolution, Held, film
from reynolds.loads import boundary_flows, loads, pressure_integrals
from reynolds.mesh import Array, rename, ring
from reynolds.solve import FilmSolver
from reynolds.space import FilmSpace, film_space

SEALED = 1e9  # viscosity of a web over a port, in oil's: the film passes nothing there


@dataclass(frozen=True)
class ValvePlateGeometry:
    """Land radii R1 < R2 < R3 < R4 (m), chambers, kidney arc (rad) and the ports' arcs (rad, from, to).

    Ports are sectors of the valve plate between R2 and R3, in pump angle; kidneys are taken as sectors of the
    same width (rounded ends are not modelled: their effect on the webs is under 0.1 of a web).
    """

    land_radii: tuple[float, float, float, float]
    pistons: int
    kidney_arc: float
    suction_arc: tuple[float, float]
    delivery_arc: tuple[float, float]


@dataclass(frozen=True)
class ValvePlateState:
    """Instant of the block, SI: shaft angle rad, pressures Pa (chamber: one a kidney), speed rad/s."""

    shaft_angle: float
    chamber_pressure: Array
    suction_pressure: float
    delivery_pressure: float
    case_pressure: float
    cavitation_pressure: float
    viscosity: float
    shaft_speed: float


@dataclass(frozen=True)
class ValvePlatePosition:
    """Film thickness on the shaft axis (m) and the block's slopes dh/dx and dh/dy (rad), fixed in space."""

    film_thickness: float
    slope_x: float
    slope_y: float


@dataclass(frozen=True)
class ValvePlateFilm:
    """The ring's film with what each chamber and port gives into it.

    chamber_flows (z,), suction_flow and delivery_flow m3/s into the film; conductances (z,) m3/(s Pa) of each
    kidney with everything else at rest and at zero pressure; carried_power W: what the flow dragged along by the
    block takes from kidneys and ports, (flow - pressure flow) x (pressure - case pressure); separating_force N of
    film, kidneys and ports above case pressure with its moments (N m, integrals of p y and of -p x).
    """

    gap: GapFilm
    chamber_flows: Array
    conductances: Array
    suction_flow: float
    delivery_flow: float
    carried_power: float
    separating_force: float
    separating_moment: tuple[float, float]


class ValvePlateGap:
    """Films of the ring; cells = (cells across a land, cells a kidney pitch).

    Mesh lines lie on the kidneys' edges; a port's edge is taken at the next mesh line inside it, so `cells[1]`
    should put one there (a multiple of 16 does for REF90 at the film angles).
    """

    def __init__(self, geometry: ValvePlateGeometry, cells: tuple[int, int] = (8, 32)) -> None:
        self.geometry = geometry
        self._space = _ring_space(geometry, cells)
        self._solver = FilmSolver(self._space)
        self._last: FilmSolution | None = None
        self._kidneys = [f"kidney_{k + 1}" for k in range(geometry.pistons)]
        _, r2, r3, _ = geometry.land_radii
        radius = np.hypot(*self._space.vertices.T)
        self._in_kidney_ring = (radius > r2 * (1.0 - 1e-9)) & (radius < r3 * (1.0 + 1e-9))

    def problem(self, state: ValvePlateState, position: ValvePlatePosition) -> FilmProblem:
        """The film problem at a shaft angle; raises FilmInputError where the block touches the plate."""
        c, s = np.cos(state.shaft_angle), np.sin(state.shaft_angle)
        space = self._space.moved(self._space.vertices @ np.array([[c, s], [-s, c]]))
        x, y = space.points
        port = self._over_port(space, state)
        speed = np.where(port, 0.0, state.shaft_speed)
        boundary = {"inner": Held(state.case_pressure), "outer": Held(state.case_pressure)}
        boundary |= {name: Held(float(p)) for name, p in zip(self._kidneys, state.chamber_pressure, strict=True)}
        return FilmProblem(
            space=space,
            film=film(
                position.film_thickness + position.slope_x * x + position.slope_y * y,
                np.where(port, SEALED * state.viscosity, state.viscosity),
                velocity_moving=(-speed * y, speed * x),
            ),
            boundary=boundary,
            cavitation=Cavitation.JFO,
            cavitation_pressure=state.cavitation_pressure,
            held_nodes=self._port_nodes(space.vertices, state),
        )

    def at(self, state: ValvePlateState, position: ValvePlatePosition, pressing_force: float) -> ValvePlateFilm:
        """The ring's film at a given position, and how much of the pressing force (N) it holds."""
        solution = self._last = self._solver.solve(self.problem(state, position), self._last)
        is_film = np.where(self._over_port(solution.problem.space, state), 0.0, 1.0)
        integrals = loads(solution, is_film)
        given = self._inflows(solution, state)
        still = self._inflows(self._at_rest(solution), state)
        above = np.array([*state.chamber_pressure, state.suction_pressure, state.delivery_pressure])
        carried = float((given - still) @ (above - state.case_pressure))
        chambers = given[:-2]
        force, moment = self._separating(solution, state)
        gap = GapFilm(
            solution=solution,
            loads=integrals,
            source=PositionSource.GIVEN,
            position=np.array([position.film_thickness, position.slope_x, position.slope_y]),
            chamber_flow=float(chambers.sum()),
            leakage_flow=integrals.flow["inner"] + integrals.flow["outer"],
            conductance=0.0,
            friction_power=wall_power(solution, is_film),
            required_load=pressing_force,
            carried_load=force,
            verdict="position given",
        )
        conductances = self._conductances(solution, state)
        total = replace(gap, conductance=float(conductances.sum()))
        return ValvePlateFilm(
            total, chambers, conductances, float(given[-2]), float(given[-1]), carried, force, moment
        )

    def _ports(self, state: ValvePlateState) -> list[tuple[tuple[float, float], float]]:
        return [
            (self.geometry.suction_arc, state.suction_pressure),
            (self.geometry.delivery_arc, state.delivery_pressure),
        ]

    def _port_nodes(self, vertices: Array, state: ValvePlateState, *, at_rest: bool = False) -> Array:
        """Pressure of the unknowns over a port (Pa, or 0 at rest), NaN elsewhere and on the kidneys' edges."""
        nodes = np.full(self._space.size, np.nan)
        for arc, pressure in self._ports(state):
            nodes[self._nodes_in(vertices, arc)] = 0.0 if at_rest else pressure
        for name in self._kidneys:
            nodes[self._space.edge_dofs[name]] = np.nan
        return nodes

    def _vertices_in(self, vertices: Array, arc: tuple[float, float]) -> NDArray[np.bool_]:
        """Vertices of the kidney ring that lie over a port, its edges included."""
        angle = np.arctan2(vertices[:, 1], vertices[:, 0])
        span = (angle - arc[0] + 1e-9) % (2.0 * np.pi)
        return self._in_kidney_ring & (span <= arc[1] - arc[0] + 2e-9)

    def _nodes_in(self, vertices: Array, arc: tuple[float, float]) -> NDArray[np.signedinteger]:
        """Unknowns over a port, those of kidneys included."""
        return np.unique(self._space.vertex_dofs[self._vertices_in(vertices, arc)])

    def _over_port(self, space: FilmSpace, state: ValvePlateState) -> NDArray[np.bool_]:
        """Cells that lie over a port with all their corners, (cells, 1)."""
        over = [self._vertices_in(space.vertices, arc)[space.cells].all(axis=1) for arc, _ in self._ports(state)]
        return np.any(over, axis=0)[:, None]

    def _inflows(self, solution: FilmSolution, state: ValvePlateState) -> Array:
        """Flow into the film (m3/s) from each kidney, then from suction and delivery port (at their edges)."""
        space = solution.problem.space
        flows = boundary_flows(solution)
        named = np.zeros(space.size, dtype=bool)
        for nodes in space.edge_dofs.values():
            named[nodes] = True
        inflows = [-flows[name] for name in self._kidneys]
        for arc, _ in self._ports(state):
            nodes = self._nodes_in(space.vertices, arc)
            inflows.append(float(-solution.outflow[nodes[~named[nodes]]].sum()))
        return np.array(inflows)

    def _at_rest(self, solution: FilmSolution) -> FilmSolution:
        """The same film and pressures with the block at rest: the pressure flow alone."""
        film_at_rest = replace(solution.problem.film, velocity_moving=(ZERO, ZERO))
        return self._solver.solve(replace(solution.problem, film=film_at_rest, cavitation=Cavitation.NONE))

    def _separating(self, solution: FilmSolution, state: ValvePlateState) -> tuple[float, tuple[float, float]]:
        """Force between block and plate above case pressure: mesh integral plus kidneys."""
        load, moment_x, moment_y = pressure_integrals(solution)
        _, r2, r3, _ = self.geometry.land_radii
        above = np.asarray(state.chamber_pressure) - state.case_pressure
        centre = state.shaft_angle + 2.0 * np.pi / self.geometry.pistons * np.arange(self.geometry.pistons)
        area = 0.5 * self.geometry.kidney_arc * (r3**2 - r2**2)
        lever = 2.0 * np.sin(0.5 * self.geometry.kidney_arc) * (r3**3 - r2**3) / 3.0
        lift = load - state.case_pressure * float(solution.problem.space.area.sum())
        return lift + float(above.sum()) * area, (
            moment_x + float(np.sum(above * np.sin(centre))) * lever,
            moment_y - float(np.sum(above * np.cos(centre))) * lever,
        )

    def _conductances(self, solution: FilmSolution, state: ValvePlateState) -> Array:
        """d flow / d pressure of each kidney, the other edges at rest, m3/(s Pa)."""
        problem = solution.problem
        still = replace(problem.film, velocity_moving=(ZERO, ZERO))
        ports = self._port_nodes(problem.space.vertices, state, at_rest=True)
        found = []
        for name in self._kidneys:
            edges = {edge: Held(1.0 if edge == name else 0.0) for edge in problem.boundary}
            answer = self._solver.solve(
                FilmProblem(problem.space, still, edges, Cavitation.NONE, held_nodes=ports)
            )
            found.append(-boundary_flows(answer)[name])
        return np.array(found)


def _ring_space(geometry: ValvePlateGeometry, cells: tuple[int, int]) -> FilmSpace:
    """The ring at shaft angle 0 with kidneys left out, kidney_1 about angle 0; lines on the kidneys' edges."""
    r1, r2, r3, r4 = geometry.land_radii
    land, per_pitch = cells
    lines = [np.linspace(a, b, land + 1) for a, b in ((r1, r2), (r2, r3), (r3, r4))]
    pitch = 2.0 * np.pi / geometry.pistons
    per_kidney = min(max(round(per_pitch * geometry.kidney_arc / pitch), 1), per_pitch - 1)
    around = per_pitch * geometry.pistons
    keep = np.ones((3 * land, around), dtype=bool)
    keep[land : 2 * land, np.arange(around) % per_pitch < per_kidney] = False
    mesh = ring(np.concatenate([lines[0], lines[1][1:], lines[2][1:]]), around, keep=keep)
    names = {f"hole_{k}": f"kidney_{k + 1}" for k in range(geometry.pistons)}
    space = film_space(rename(mesh, names))
    # Equal sectors become kidney and web of their own widths, the first kidney's middle at angle 0.
    x, y = space.vertices.T
    column = np.round(np.arctan2(y, x) / (2.0 * np.pi) * around) % around
    within = np.interp(column % per_pitch, [0, per_kidney, per_pitch], [0.0, geometry.kidney_arc, pitch])
    angle = column // per_pitch * pitch + within - 0.5 * geometry.kidney_arc
    return space.moved(np.hypot(x, y)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))
