"""The flow balance of every unknown of a film, and its slopes for Newton's method.

At unknown i, with nodal pressure p, film fraction theta and density ratio r,

    R_i = sum_j K_ij p_j + sum_j C_ij theta_j r_j + sum_j D_ij theta_j r_c + d(theta_i r_i M_i)/dt

K is the conductance, C the walls' carrying, M the lumped content. D, the least diffusion that makes C + D an
upwind scheme (Kuzmin and Turek 2002), vanishes where the film is full, since its rows sum to zero: the full film
keeps its order of accuracy, a cavity is carried along without overshoot, and columns that sum to zero conserve
mass to round-off. At an edge over which the walls carry nothing in, D takes the edge's film fraction out of the
balance beside it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, csr_array

from reynolds import kernels
from reynolds.film import Cavitation, FilmProblem, Held
from reynolds.fluid import CONSTANT
from reynolds.mesh import Array
from reynolds.space import FilmSpace
from reynolds.transport import Tensor, Transport, along, at_points, lumped, transport

NO_FLOW = 1e-9  # of the flow along an edge: less across it is round-off


@dataclass(frozen=True)
class State:
    """A film on the way to its solution: pressure (size,) Pa, film fraction (size,), opening (vertices,) m."""

    pressure: Array
    film_fraction: Array
    opening: Array


@dataclass(frozen=True)
class Operators:
    """K, C and D of the balance on the space's pattern (upper triangle, C's mirror beside it), lumped integrals.

    content (size,) m3 = integral of the content; rate (size,) m3/s: what a full film swallows as the content
    changes: the squeeze, or content over the time step.
    """

    transport: Transport
    stiffness: Array
    convection: tuple[Array, Array]
    diffusion: Array
    content: Array
    rate: Array


def operators(problem: FilmProblem, state: State) -> Operators:
    """The balance's operators at a state; they are constant for a constant fluid between rigid walls."""
    space = problem.space
    terms = transport(problem, state.pressure, state.opening)
    content = lumped(space, terms.content)
    rate = lumped(space, terms.squeeze) if problem.storage is None else content / problem.storage.step
    carried = convection(space, terms.flux)
    diffusion = np.zeros_like(carried[0])
    if problem.cavitation is Cavitation.JFO:
        leaves = _sends_nothing(problem, terms.flux)
        kernels.upwinding(space.pattern.indptr, space.pattern.indices, *carried, leaves, diffusion)
    return Operators(terms, stiffness(space, terms.conductance), carried, diffusion, content, rate)


def _sends_nothing(problem: FilmProblem, flux: tuple[Array, Array]) -> NDArray[np.bool_]:
    """Unknowns of held edges over which the walls carry no oil into the film, (size,).

    Their film fraction is of no matter: upwinding across the way of the walls would bring it in all the same, and
    feed a cavity that runs along the side of a bearing.
    """
    space = problem.space
    held, sends = np.zeros(space.size, dtype=bool), np.zeros(space.size, dtype=bool)
    for name, condition in problem.boundary.items():
        if isinstance(condition, Held):
            out, size = space.carried_out(name, flux)
            nodes = space.facet_dofs[name]
            held[nodes] = True
            sends[nodes[:, (out < -NO_FLOW * size) | (size == 0.0)]] = True
    if problem.held_nodes is not None:
        sends |= ~np.isnan(problem.held_nodes)
    return held & ~sends


def stiffness(space: FilmSpace, conductance: Tensor) -> Array:
    """Entries of int k grad p . grad f, upper triangle in the space's pattern (m3/(s Pa)).

    `conductance` is h^3/(12 mu), its xx, yy and xy part, (cells | 1, points | 1) each, m3/(Pa s).
    """
    tensors, pattern = space.tensors, space.pattern
    data = np.zeros(len(pattern.indices))
    xx, yy, xy = conductance
    parts = [(tensors.pairs, xx)]
    if xx is not yy:
        parts = [(tensors.pairs_xx, xx), (tensors.pairs_yy, yy), (tensors.pairs_xy, xy)]
    for pairs, along_pair in parts:
        kernels.stiffness(space.dofs, pattern.slots, pattern.indptr, tensors.shape, pairs, along_pair, data)
    return data


def positive_share(space: FilmSpace, stiffness: Array) -> float:
    """Share of couplings of the wrong sign, which let a pressure overshoot: of cells with obtuse angles."""
    off = space.pattern.indices != space.pattern.columns
    return float(np.mean(stiffness[off] > 1e-9 * np.abs(stiffness[off]).max(initial=0.0))) if off.any() else 0.0


def convection(space: FilmSpace, flux: tuple[Array, Array], *, steep: bool = False) -> tuple[Array, Array]:
    """Entries C_ij = -int f_j flux . grad f_i of the upper triangle and, slot by slot, their mirrors C_ji.

    `steep` takes the gradients of the conductance: for a flux that pressure drives.
    """
    tensors, reference, pattern = space.tensors, space.reference, space.pattern
    gradient = tensors.steep_gradient if steep else tensors.gradient
    upper, lower = (np.empty(len(pattern.indices)) for _ in range(2))
    kernels.convection(space.dofs, pattern.slots, tensors.shape, reference.value, gradient, *flux, upper, lower)
    return upper, lower


def density(problem: FilmProblem, pressure: Array) -> tuple[Array, Array]:
    """Density ratio of the unknowns and its slope by pressure (1/Pa), (size,) each."""
    return problem.fluid.density(pressure)


def holds(problem: FilmProblem, parts: Operators, state: State) -> Array:
    """Oil of each unknown, m3 at reference density, (size,)."""
    return parts.content * state.film_fraction * density(problem, state.pressure)[0]


def flow_balance(problem: FilmProblem, parts: Operators, state: State) -> tuple[Array, Array]:
    """R (size,) m3/s, and the size of the flows that meet at each unknown (see `kernels.exchange`)."""
    pattern = problem.space.pattern
    filling = state.film_fraction * density(problem, state.pressure)[0]
    out, size = np.zeros(problem.space.size), np.zeros(problem.space.size)
    kernels.exchange(pattern.indptr, pattern.indices, parts.stiffness, state.pressure, out, size)
    kernels.carry(pattern.indptr, pattern.indices, *parts.convection, filling, out, size)
    mixed, mixed_size = _mixing(problem, parts, state)
    out += mixed
    size += mixed_size
    out += swallowed(problem, parts, state)
    size += np.abs(parts.rate * filling)
    return out, size


def mixing(problem: FilmProblem, parts: Operators, state: State) -> Array:
    """What upwinding exchanges between the unknowns, m3/s at reference density, (size,): zero in a full film."""
    return _mixing(problem, parts, state)[0]


def _mixing(problem: FilmProblem, parts: Operators, state: State) -> tuple[Array, Array]:
    pattern = problem.space.pattern
    out, size = np.zeros(problem.space.size), np.zeros(problem.space.size)
    level = cavity_density(problem) * state.film_fraction
    if level.min() == level.max():
        return out, size
    kernels.exchange(pattern.indptr, pattern.indices, parts.diffusion, level, out, size)
    return out, size


def swallowed(problem: FilmProblem, parts: Operators, state: State) -> Array:
    """Rate at which each unknown's oil grows, m3/s at reference density, (size,)."""
    filled = state.film_fraction if problem.storage else np.where(parts.rate > 0.0, state.film_fraction, 1.0)
    rate = parts.rate * filled * density(problem, state.pressure)[0]
    return rate if problem.storage is None else rate - problem.storage.held_before / problem.storage.step


def cavity_density(problem: FilmProblem) -> float:
    """Density ratio at the cavitation pressure."""
    return float(density(problem, np.array([problem.cavitation_pressure]))[0][0])


@dataclass(frozen=True)
class Slopes:
    """dR by nodal pressure and by nodal film fraction (upper, mirror, addition to the diagonal)."""

    by_pressure: tuple[Array, Array, Array]
    by_fraction: tuple[Array, Array, Array]


def slopes(problem: FilmProblem, parts: Operators, state: State) -> Slopes:
    """Slopes of the balance between rigid walls.

    That the diffusion D changes with the pressure is left out: it does so only where walls give way.
    """
    space, terms = problem.space, parts.transport
    ratio, ratio_slope = density(problem, state.pressure)
    row, column = space.pattern.indices, space.pattern.columns
    c_upper, c_lower = parts.convection
    p_upper = p_lower = parts.stiffness
    if problem.fluid is not CONSTANT:
        driven_x, driven_y = along(terms.conductance, steep_gradient(space, state.pressure))
        less = -terms.by_pressure
        changed = convection(space, (less * driven_x, less * driven_y), steep=True)
        filled = state.film_fraction * ratio_slope
        p_upper = parts.stiffness + changed[0] + c_upper * filled[column]
        p_lower = parts.stiffness + changed[1] + c_lower * filled[row]
    level = cavity_density(problem)
    f_upper = c_upper * ratio[column] + level * parts.diffusion
    f_lower = c_lower * ratio[row] + level * parts.diffusion
    return Slopes(
        (p_upper, p_lower, parts.rate * state.film_fraction * ratio_slope),
        (f_upper, f_lower, np.maximum(parts.rate, 0.0) * ratio),
    )


def steep_gradient(space: FilmSpace, nodal: Array) -> tuple[Array, Array]:
    """Gradient of a nodal field (size,) as the conductance has it, (cells, points) along x and y."""
    reference = space.reference
    out = tuple(np.empty(space.area.shape) for _ in range(3))
    kernels.evaluate(
        space.vertices, space.cells, space.dofs, reference.value, reference.steep_gradient,
        reference.steep_geometry, reference.weights, nodal, *out,
    )  # fmt: skip
    return out[1], out[2]


def by_opening(problem: FilmProblem, parts: Operators, state: State) -> csr_array:
    """dR by the opening at each vertex, (size, vertices) m2/s."""
    space, terms, reference = problem.space, parts.transport, problem.space.reference
    filling = state.film_fraction * density(problem, state.pressure)[0]
    driven = along(terms.conductance_slope, steep_gradient(space, state.pressure))
    full = at_points(space, filling)
    carried = (-full * terms.flux_slope[0], -full * terms.flux_slope[1])
    local = _tested(space, driven, space.tensors.steep_gradient)
    local += _tested(space, carried, space.tensors.gradient)
    if problem.storage is not None:
        per_second = np.broadcast_to(terms.content_slope / problem.storage.step, space.area.shape)
        local += np.einsum(
            "eq,qi,qv,ei->eiv", per_second * space.area, reference.value, reference.geometry_value,
            filling[space.dofs], optimize=True,
        )  # fmt: skip
    rows = np.broadcast_to(space.dofs[:, :, None], local.shape)
    columns = np.broadcast_to(space.cells[:, None, :], local.shape)
    return csr_array(
        coo_array((local.ravel(), (rows.ravel(), columns.ravel())), shape=(space.size, len(space.vertices)))
    )


def _tested(space: FilmSpace, flux: tuple[Array, Array], gradient: Array) -> Array:
    """int f_v flux . grad f_i with f_v the basis of the cell's corners, (cells, basis, corners)."""
    along = np.stack([np.broadcast_to(part, space.area.shape) for part in flux], axis=-1)
    corner = space.reference.geometry_value
    return np.asarray(np.einsum("eqd,eqid,qv->eiv", along, gradient[space.tensors.shape], corner, optimize=True))


def full_matrix(space: FilmSpace, upper: Array, lower: Array) -> csc_array:
    """The operator whose upper triangle and mirrored entries stand in the pattern's order."""
    row, column = space.pattern.indices, space.pattern.columns
    off = row != column
    return csc_array(
        coo_array(
            (
                np.concatenate([upper, lower[off]]),
                (np.concatenate([row, column[off]]), np.concatenate([column, row[off]])),
            ),
            shape=(space.size, space.size),
        )
    )
