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

from gaps.result import GapFilm, PositionSource, wall_power
from gaps.ring import SEALED, Ring, ValvePlateGeometry
from reynolds.film import ZERO, Cavitation, FilmProblem, FilmSolution, Held, film
from reynolds.loads import boundary_flows, loads, pressure_integrals
from reynolds.mesh import Array
from reynolds.solve import FilmSolver


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
    """Film thickness on the shaft axis (m) and the block's slopes dh/dx and dh/dy (rad), fixed in space.

    On a sphere: how far the block stands off along the axis, and how far it is turned about the face's middle.
    """

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
        self._ring = Ring(geometry, cells)
        self._solver = FilmSolver(self._ring.space)
        self._last: FilmSolution | None = None

    def problem(self, state: ValvePlateState, position: ValvePlatePosition) -> FilmProblem:
        """The film problem at a shaft angle; raises FilmInputError where the block touches the plate."""
        space = self._ring.turned(state.shaft_angle)
        x, y, _ = space.points_in_space
        port = self._ring.over_port(space)
        speed = np.where(port, 0.0, state.shaft_speed)
        boundary = dict.fromkeys(self.geometry.case_edges, Held(state.case_pressure))
        boundary |= {
            name: Held(float(p)) for name, p in zip(self.geometry.kidneys, state.chamber_pressure, strict=True)
        }
        return FilmProblem(
            space=space,
            film=film(
                position.film_thickness * space.axial_share + position.slope_x * x + position.slope_y * y,
                np.where(port, SEALED * state.viscosity, state.viscosity),
                velocity_moving=(-speed * y, speed * x),
            ),
            boundary=boundary,
            cavitation=Cavitation.JFO,
            cavitation_pressure=state.cavitation_pressure,
            held_nodes=self._ring.port_nodes(space, state.suction_pressure, state.delivery_pressure),
        )

    def at(self, state: ValvePlateState, position: ValvePlatePosition, pressing_force: float) -> ValvePlateFilm:
        """The ring's film at a given position, and how much of the pressing force (N) it holds."""
        solution = self._last = self._solver.solve(self.problem(state, position), self._last)
        is_film = np.where(self._ring.over_port(solution.problem.space), 0.0, 1.0)
        integrals = loads(solution, is_film)
        given = self._inflows(solution)
        still = self._inflows(self._at_rest(solution))
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
            leakage_flow=sum(integrals.flow[edge] for edge in self.geometry.case_edges),
            conductance=0.0,
            friction_power=wall_power(solution, is_film),
            required_load=pressing_force,
            carried_load=force,
            verdict="position given",
        )
        conductances = self._conductances(solution)
        total = replace(gap, conductance=float(conductances.sum()))
        return ValvePlateFilm(
            total, chambers, conductances, float(given[-2]), float(given[-1]), carried, force, moment
        )

    def _inflows(self, solution: FilmSolution) -> Array:
        """Flow into the film (m3/s) from each kidney, then from suction and delivery port (at their edges)."""
        space = solution.problem.space
        flows = boundary_flows(solution)
        named = np.zeros(space.size, dtype=bool)
        for nodes in space.edge_dofs.values():
            named[nodes] = True
        inflows = [-flows[name] for name in self.geometry.kidneys]
        for port in (self.geometry.suction, self.geometry.delivery):
            nodes = self._ring.nodes_over(space, port)
            inflows.append(float(-solution.outflow[nodes[~named[nodes]]].sum()))
        return np.array(inflows)

    def _at_rest(self, solution: FilmSolution) -> FilmSolution:
        """The same film and pressures with the block at rest: the pressure flow alone."""
        film_at_rest = replace(solution.problem.film, velocity_moving=(ZERO, ZERO))
        return self._solver.solve(replace(solution.problem, film=film_at_rest, cavitation=Cavitation.NONE))

    def _separating(self, solution: FilmSolution, state: ValvePlateState) -> tuple[float, tuple[float, float]]:
        """Force between block and plate above case pressure: mesh integral plus kidneys."""
        load, moment_x, moment_y = pressure_integrals(solution)
        above = np.asarray(state.chamber_pressure) - state.case_pressure
        centre = self.geometry.kidney_places(state.shaft_angle)
        area, lever = self.geometry.kidney_area, self.geometry.kidney_lever
        lift = load - state.case_pressure * float(solution.problem.space.axial_area.sum())
        return lift + float(above.sum()) * area, (
            moment_x + float(np.sum(above * np.sin(centre))) * lever,
            moment_y - float(np.sum(above * np.cos(centre))) * lever,
        )

    def _conductances(self, solution: FilmSolution) -> Array:
        """d flow / d pressure of each kidney, the other edges at rest, m3/(s Pa)."""
        problem = solution.problem
        still = replace(problem.film, velocity_moving=(ZERO, ZERO))
        ports = self._ring.port_nodes(problem.space, 0.0, 0.0)
        found = []
        for name in self.geometry.kidneys:
            edges = {edge: Held(1.0 if edge == name else 0.0) for edge in problem.boundary}
            answer = self._solver.solve(
                FilmProblem(problem.space, still, edges, Cavitation.NONE, held_nodes=ports)
            )
            found.append(-boundary_flows(answer)[name])
        return np.array(found)
