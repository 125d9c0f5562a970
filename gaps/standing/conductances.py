"""Conductances of the film of a part that stands still: pressure flow between walls at rest, without cavitation.

Thickness and viscosity are those under the film's pressure, so that flows are linear in the pressures; walls are as
rough as those of the film.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from gaps.films.block import BlockFilm
from gaps.films.slipper import SlipperFilm
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Boundary, Cavitation, FilmProblem, FilmSolution, Held, Pocket, no_feed
from reynolds.solve.loads import boundary_flows
from reynolds.solve.solver import FilmSolver


def walls_at_rest(
    solution: FilmSolution, boundary: Mapping[str, Boundary], held_nodes: Array | None = None
) -> FilmProblem:
    """The same film between walls at rest, with other pressures at its edges and held nodes."""
    problem = solution.problem
    still = replace(
        problem.film, viscosity=solution.film.viscosity, velocity_moving=(ZERO, ZERO), velocity_fixed=(ZERO, ZERO),
        squeeze=ZERO,
    )  # fmt: skip
    return FilmProblem(problem.space, still, boundary, Cavitation.NONE, held_nodes=held_nodes, surface=problem.surface)


def piston_conductance(solver: FilmSolver, stage: FloatingStage) -> float:
    """Flow from chamber to case per pressure difference, m3/(s Pa)."""
    edges: dict[str, Boundary] = {"chamber": Held(1.0), "case": Held(0.0)}
    return boundary_flows(solver.solve(walls_at_rest(stage.solution, edges)))["case"]


def slipper_conductance(solver: FilmSolver, film: SlipperFilm, stage: FloatingStage) -> float:
    """Flow per pressure difference through orifice and lands in series, m3/(s Pa), the orifice at its present flow."""
    land, orifice = slipper_land_conductance(solver, film, stage), film.throttling(stage)
    return land * orifice / (land + orifice)


def slipper_land_conductance(solver: FilmSolver, film: SlipperFilm, stage: FloatingStage) -> float:
    """Flow from pocket to case per pressure difference, m3/(s Pa)."""
    lands = film.shape.lands
    edges: dict[str, Boundary] = {name: Pocket(no_feed) for name in lands.closed}
    edges |= {"pocket": Held(1.0)} | dict.fromkeys(lands.open, Held(0.0))
    flows = boundary_flows(solver.solve(walls_at_rest(stage.solution, edges)))
    return sum(flows[name] for name in lands.open)


def kidney_conductances(solver: FilmSolver, film: BlockFilm, stage: FloatingStage) -> Array:
    """d flow / d pressure (z,) m3/(s Pa) of each kidney, the other edges and the ports held."""
    problem = stage.solution.problem
    ports = film.ring.port_nodes(problem.space, 0.0, 0.0)
    found = []
    for name in film.geometry.kidneys:
        edges: dict[str, Boundary] = {edge: Held(float(edge == name)) for edge in problem.boundary}
        found.append(-boundary_flows(solver.solve(walls_at_rest(stage.solution, edges, ports)))[name])
    return np.array(found)


def drag_power(solver: FilmSolver, film: BlockFilm, stage: FloatingStage) -> float:
    """Power of the block's drag flow from kidneys and ports, W.

    (flow - pressure flow) x (pressure - case pressure).
    """
    drive, problem = film.drive, stage.solution.problem
    still = solver.solve(walls_at_rest(stage.solution, problem.boundary, problem.held_nodes))
    above = film.chamber_pressures(drive.shaft_speed * stage.time)
    pressures = np.array([*above, drive.suction_pressure, drive.delivery_pressure]) - drive.case_pressure
    return float((_inflows(film, stage.solution) - _inflows(film, still)) @ pressures)


def _inflows(film: BlockFilm, solution: FilmSolution) -> Array:
    chambers, suction, delivery = film.inflows(solution, boundary_flows(solution))
    return np.array([*chambers, suction, delivery])
