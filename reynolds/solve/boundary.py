"""Boundary conditions of a film problem at its unknowns, checked, and a first pressure for fed pockets."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.numerics.array_kernels import all_finite
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmProblem, Held, Pocket

Feed = Callable[[float], tuple[float, float]]
NARROW = 1e3  # Pa: of the first interval searched
MOST_DOUBLINGS = 60
NEAR = 1e-8  # of the interval
CURVED = 0.1  # change of the slope on the way: less does not disturb Newton's method


@dataclass(frozen=True)
class BoundaryValues:
    """Pressure (size,) Pa and film fraction (size,), `held` or a first guess, and the pockets."""

    pressure: Array
    film_fraction: Array
    held: NDArray[np.bool_]
    pockets: tuple[tuple[int, Pocket], ...]


def check_pressures(problem: FilmProblem) -> None:
    """Raise FilmInputError for boundary conditions without a solution.

    Faults: a boundary that is not of the mesh, a piece of the film without a pressure level, a boundary below
    cavitation pressure, or one filled in part above it; a pocket that touches another one or a held boundary; a
    mesh of which every unknown lies on a held boundary.
    """
    if spread(problem).held.all():
        found = f"{problem.space.size} unknowns, each on an edge of given pressure: none is left to solve for"
        raise FilmInputError("mesh", found, "at least 2 cells from one such edge to the next")


def spread(problem: FilmProblem) -> BoundaryValues:
    """The boundary conditions at the unknowns; raises as `check_pressures`."""
    space = problem.space
    cavitates = problem.cavitation is not Cavitation.NONE
    level = problem.cavitation_pressure if cavitates else 0.0
    pressure, fraction = np.full(space.size, level), np.ones(space.size)
    held = np.zeros(space.size, dtype=bool)
    pockets = []
    for name, condition in problem.boundary.items():
        if name not in space.edge_dofs:
            names = ", ".join(space.film_mesh.boundary_names)
            raise FilmInputError(f"boundary {name}", "no boundary of this mesh", f"one of {names}")
        nodes = space.edge_dofs[name]
        if isinstance(condition, Held):
            _check_fraction(name, condition, problem)
            pressure[nodes], fraction[nodes], held[nodes] = condition.pressure, condition.film_fraction, True
        elif len(nodes) == 1:
            pockets.append((int(nodes[0]), condition))
        else:
            raise FilmInputError(f"boundary {name}", "a pocket on separate nodes", "film_space(pockets=...)")
    if problem.held_nodes is not None:
        more = ~np.isnan(problem.held_nodes)
        pressure[more], fraction[more], held[more] = problem.held_nodes[more], 1.0, True
    if not all_finite(pressure):
        raise FilmInputError("boundary", "a pressure that is not finite", "a number of Pa")
    if pockets:
        _check_apart(held, pockets)
    _check_level(problem, held, pockets, level)
    if cavitates and (low := pressure[held].min(initial=np.inf)) < level:
        raise FilmInputError("boundary", f"pressure {low:.4g} Pa", f"at least the cavitation pressure {level:.4g} Pa")
    return BoundaryValues(pressure, fraction, held, tuple(pockets))


def _check_apart(held: NDArray[np.bool_], pockets: list[tuple[int, Pocket]]) -> None:
    nodes = [node for node, _ in pockets]
    if held[nodes].any():
        raise FilmInputError("boundary", "a pocket that touches a held pressure", "film between them")
    if len(set(nodes)) < len(nodes):
        raise FilmInputError("boundary", "pockets that touch each other", "one pocket, or film between them")


def _check_fraction(name: str, condition: Held, problem: FilmProblem) -> None:
    if not 0.0 <= condition.film_fraction <= 1.0:
        raise FilmInputError(f"boundary {name}", f"film fraction {condition.film_fraction:g}", "0 to 1")
    if condition.film_fraction == 1.0:
        return
    if problem.cavitation is not Cavitation.JFO:
        raise FilmInputError(
            f"boundary {name}",
            f"film fraction {condition.film_fraction:g} with cavitation '{problem.cavitation.value}'",
            "1, or cavitation 'jfo', whose film fraction is an unknown",
        )
    if condition.pressure != problem.cavitation_pressure:
        raise FilmInputError(
            f"boundary {name}",
            f"film fraction {condition.film_fraction:g} at {condition.pressure:.4g} Pa",
            f"the cavitation pressure {problem.cavitation_pressure:.4g} Pa, the only one of such a film",
        )


def _check_level(
    problem: FilmProblem, held: NDArray[np.bool_], pockets: list[tuple[int, Pocket]], level: float
) -> None:
    """Raise FilmInputError for a piece of the film without a pressure level."""
    space, fed = problem.space, held.copy()
    for node, pocket in pockets:
        fed[node] |= pocket.feed(level)[1] < 0.0
    if not (dry := space.pattern.pieces_without(fed)).size:
        return
    count, piece = space.pattern.pieces
    own = {name: {*piece[nodes]} for name, nodes in space.edge_dofs.items()}
    names = [name for name in space.film_mesh.boundary_names if dry[0] in own[name]]
    x, y = space.vertices[piece[space.vertex_dofs] == dry[0]].mean(axis=0)
    where = f"in {dry.size} of {count} separate pieces of the film, the first about x = {x:.4g} m, y = {y:.4g} m"
    raise FilmInputError(
        "boundary",
        f"no pressure given {where if fed.any() else 'anywhere'}",
        f"a boundary with a pressure at each piece, here {' or '.join(names) or 'of a name that the mesh lacks'}",
    )


def pressure_sending(feed: Feed, flow: float, start: float) -> float:
    """A pressure (Pa) at which a feed sends about a flow (m3/s); `start` without such a pressure or for a linear law.

    `feed` as in `problem.Pocket`: (m3/s, its slope by pressure), never rising. Behind an orifice,
    q ~ sqrt(p_supply - p), Newton's method oscillates between a pressure far from the supply's and its mirror
    image; from a pressure that sends the flow of the iteration before it converges.
    """
    from scipy.optimize import brentq

    def lacks(pressure: float) -> float:
        return feed(pressure)[0] - flow

    first = lacks(start)
    if first == 0.0 or feed(start)[1] == 0.0:
        return start
    last, width = start, NARROW if first > 0.0 else -NARROW
    for _ in range(MOST_DOUBLINGS):
        other = last + width
        if lacks(other) * first <= 0.0:
            found = float(brentq(lacks, last, other, xtol=NEAR * abs(width)))
            return start if abs(feed(found)[1] / feed(start)[1] - 1.0) < CURVED else found
        last, width = other, 2.0 * width
    return start
