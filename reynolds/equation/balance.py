"""The flow balance of every unknown of a film, and its slopes for Newton's method.

At unknown i, with nodal pressure p, film fraction theta and density ratio r,

    R_i = sum_j K_ij p_j + sum_j C_ij theta_j r_j + sum_j D_ij theta_j r_c + d(theta_i r_i M_i)/dt

K is the conductance, C the convection by the walls, M the lumped content. D, the least diffusion that makes C + D an
upwind scheme (Kuzmin and Turek 2002), vanishes where the film is full, since its rows sum to zero: the full film keeps
its order of accuracy, a cavity moves with the walls without overshoot, and columns that sum to zero conserve mass to
round-off. At an edge without inflow D removes the edge's film fraction from the balance beside it.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from reynolds.equation import deformation_kernels, hourglass_kernels
from reynolds.equation.coefficients import Tensor, Transport, along, at_points, times, transport
from reynolds.equation.deformation_sparsity import DeformationPattern
from reynolds.equation.hourglass import as_one, has_hourglass_mode, hourglass_slope, signs
from reynolds.fem import kernels
from reynolds.fem.space import FilmSpace
from reynolds.laws.fluid import CONSTANT
from reynolds.numerics.array_kernels import all_equal
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmProblem, Held, contents

NOTHING = 1e-12  # of the largest flow
NO_FLOW = 1e-9  # of the flow along an edge: less across it is round-off


@dataclass(frozen=True)
class FilmState:
    """State of the iteration: pressure (size,) Pa, film fraction (size,), deformation (vertices,) m."""

    pressure: Array
    film_fraction: Array
    deformation: Array


@dataclass(frozen=True)
class Operators:
    """K, C and D of the balance on the space's pattern (upper triangle, C's mirror beside it), lumped integrals.

    Each is computed on first use: a full film of constant density needs neither C nor D.
    """

    problem: FilmProblem
    transport: Transport

    @cached_property
    def stiffness(self) -> Array:
        """K, m3/(s Pa)."""
        return stiffness(self.problem.space, self.transport.conductance)

    @cached_property
    def convection(self) -> tuple[Array, Array]:
        """C and its mirror, m3/s."""
        return convection(self.problem.space, self.transport.flux)

    @cached_property
    def diffusion(self) -> Array:
        """D, m3/s; zero unless the film fraction is an unknown (JFO)."""
        diffusion = np.zeros(len(self.problem.space.pattern.indices))
        if self.problem.cavitation is Cavitation.JFO:
            pattern = self.problem.space.pattern
            kernels.upwinding(pattern.indptr, pattern.indices, *self.convection, self.leaves, diffusion)
        return diffusion

    @cached_property
    def leaves(self) -> NDArray[np.bool_]:
        """Unknowns of edges without inflow by the walls, (size,): see `without_inflow`."""
        return without_inflow(self.problem, self.transport.flux)

    @cached_property
    def advection(self) -> tuple[Array, Array]:
        """C + D and its mirror, m3/s: R by film fraction at reference density."""
        upper, lower = self.convection
        return upper + self.diffusion, lower + self.diffusion

    @cached_property
    def brim(self) -> Array:
        """Oil that leaves or stays at a full unknown, (size,) m3/s."""
        return self.advection[0][self.problem.space.pattern.diagonal] + np.maximum(self.rate, 0.0)

    @cached_property
    def lack(self) -> Array:
        """Pressure that moves as much oil out of an unknown as its film fraction does, (size,) Pa."""
        stiff = self.stiffness[self.problem.space.pattern.diagonal]
        return np.maximum(self.brim, NOTHING * self.brim.max() + 1e-300) / np.where(stiff > 0.0, stiff, 1.0)

    @cached_property
    def content(self) -> Array:
        """Integral of the content, pockets' volumes in it, (size,) m3."""
        return contents(self.problem, self.transport.content)

    @cached_property
    def rate(self) -> Array:
        """Storage rate of a full film, (size,) m3/s: its squeeze, and its content over the time step."""
        storage, squeeze = self.problem.storage, self.problem.space.lumped(self.transport.squeeze)
        return squeeze if storage is None else squeeze + self.content / storage.step

    @cached_property
    def full(self) -> tuple[Array, Array]:
        """Part of R from walls and storage in a full film at reference density, and the sum of its magnitudes.

        (size,) m3/s each: the rows of C summed in the cells, without C.
        """
        space = self.problem.space
        net, flow_scale = self.rate.copy(), np.abs(self.rate)
        tensors, loops = space.tensors, space.reference.loops
        for axis, part in enumerate(self.transport.flux):
            if part.size > 1 or part.item() != 0.0:
                gradient, flux = tensors.gradient[..., axis], space.everywhere(part)
                kernels.wall_outflow(space.dofs, tensors.shape, gradient, flux, *loops, net, flow_scale)
        return net, flow_scale


def operators(problem: FilmProblem, state: FilmState) -> Operators:
    """The balance's operators at a state; they are constant for a constant fluid between rigid walls."""
    return Operators(problem, transport(problem, state.pressure, state.deformation))


def without_inflow(problem: FilmProblem, flux: tuple[Array, Array]) -> NDArray[np.bool_]:
    """Unknowns of held edges over which the walls bring no oil into the film, (size,).

    Their film fraction has no effect on the film. Upwinding across the walls' direction would nevertheless convect it
    in, and feed a cavity that runs along the side of a bearing.
    """
    space = problem.space
    held, sends = np.zeros(space.size, dtype=bool), np.zeros(space.size, dtype=bool)
    out, size = space.edge_outflow(flux)
    come_in, first = (out < -NO_FLOW * size) | (size == 0.0), 0
    for name, nodes in space.facet_dofs.items():
        facets = slice(first, first := first + nodes.shape[1])
        if isinstance(problem.boundary.get(name), Held):
            held[nodes] = True
            sends[nodes[:, come_in[facets]]] = True
    if problem.held_nodes is not None:
        sends |= ~np.isnan(problem.held_nodes)
    return held & ~sends


def stiffness(space: FilmSpace, conductance: Tensor) -> Array:
    """Entries of int k grad p . grad f, upper triangle in the space's pattern (m3/(s Pa)); see `hourglass`.

    `conductance` is h^3/(12 mu), its xx, yy and xy part, (cells | 1, points | 1) each, m3/(Pa s).
    """
    tensors, pattern = space.tensors, space.pattern
    data = np.zeros(len(pattern.indices))
    field, pairs, points = as_one(space, conductance)
    if has_hourglass_mode(space):
        hourglass_kernels.stiffness(pattern.slots, tensors.shape, pairs, tensors.parallel, field, points, data)
    else:
        kernels.stiffness(pattern.slots, tensors.shape, pairs, field, space.reference.loops[0], points, data)
    kernels.close_rows(pattern.indptr, pattern.indices, data)
    return data


def positive_share(space: FilmSpace, stiffness: Array) -> float:
    """Share of positive couplings, of cells with obtuse angles, which let a pressure overshoot."""
    off = space.pattern.indices != space.pattern.columns
    return float(np.mean(stiffness[off] > 1e-9 * np.abs(stiffness[off]).max(initial=0.0))) if off.any() else 0.0


def convection(space: FilmSpace, flux: tuple[Array, Array], *, steep: bool = False) -> tuple[Array, Array]:
    """Entries C_ij = -int f_j flux . grad f_i of the upper triangle and, slot by slot, their mirrors C_ji.

    `steep` takes the gradients of the conductance: for a flux that pressure drives.
    """
    tensors, pattern, loops = space.tensors, space.pattern, space.reference.loops
    value, gradient = space.reference.value, tensors.steep_gradient if steep else tensors.gradient
    upper, lower = (np.empty(len(pattern.indices)) for _ in range(2))
    fields = (space.everywhere(part) for part in flux)
    kernels.convection(space.dofs, pattern.slots, tensors.shape, value, gradient, *fields, *loops, upper, lower)
    return upper, lower


def density(problem: FilmProblem, pressure: Array) -> tuple[Array, Array]:
    """Density ratio of the unknowns and its slope by pressure (1/Pa), (size,) each."""
    return problem.fluid.density(pressure)


@dataclass(frozen=True)
class Balance:
    """Flow balance of each unknown, (size,) m3/s at reference density.

    net is R; flow_scale adds up the magnitudes (see `kernels.exchange`): the scale against which net is round-off.
    storage_rate: growth of its oil; upwind_exchange: flow by upwinding (zero in a full film); both are part of net.
    """

    net: Array
    flow_scale: Array
    storage_rate: Array
    upwind_exchange: Array


def flow_balance(problem: FilmProblem, parts: Operators, state: FilmState) -> Balance:
    """The balance of a state; C and D are not computed where the film is full and its density constant."""
    pattern = problem.space.pattern
    mixed = np.zeros(problem.space.size)
    driven = not all_equal(state.pressure, state.pressure[0])
    if problem.fluid is CONSTANT and all_equal(state.film_fraction, 1.0):
        net, flow_scale = parts.full
        grown = parts.rate
        if driven:
            net, flow_scale = net.copy(), flow_scale.copy()
    else:
        ratio = density(problem, state.pressure)[0]
        filling = state.film_fraction * ratio
        # Growth is filled in proportion to the filling; where the gap closes, the film fraction changes.
        grown = parts.rate * np.where(parts.rate > 0.0, filling, ratio)
        net, flow_scale = grown.copy(), np.abs(parts.rate * filling)
        kernels.convect(pattern.indptr, pattern.indices, *parts.convection, filling, net, flow_scale)
        level = cavity_density(problem) * state.film_fraction
        if level.min() < level.max():
            kernels.exchange(pattern.indptr, pattern.indices, parts.diffusion, level, mixed, flow_scale)
            net += mixed
    if driven:
        kernels.exchange(pattern.indptr, pattern.indices, parts.stiffness, state.pressure, net, flow_scale)
    if problem.storage is not None:
        before = problem.storage.held_before / problem.storage.step
        net = net - before
        grown = grown - before
    return Balance(net, flow_scale, grown, mixed)


def cavity_density(problem: FilmProblem) -> float:
    """Density ratio at the cavitation pressure."""
    if problem.fluid is CONSTANT:
        return 1.0
    return float(density(problem, np.array([problem.cavitation_pressure]))[0][0])


@dataclass(frozen=True)
class Slopes:
    """dR by nodal pressure and by nodal film fraction (upper, mirror, addition to the diagonal)."""

    by_pressure: tuple[Array, Array, Array]
    by_fraction: tuple[Array, Array, Array]


def slopes(problem: FilmProblem, parts: Operators, state: FilmState) -> Slopes:
    """Slopes of the balance between rigid walls.

    The change of the diffusion D with the pressure is left out; it exists only between elastic walls.
    """
    space, terms = problem.space, parts.transport
    grows = np.maximum(parts.rate, 0.0)
    if problem.fluid is CONSTANT:
        return Slopes((parts.stiffness, parts.stiffness, np.zeros(space.size)), (*parts.advection, grows))
    ratio, ratio_slope = density(problem, state.pressure)
    row, column = space.pattern.indices, space.pattern.columns
    c_upper, c_lower = parts.convection
    driven_x, driven_y = along(terms.conductance, steep_gradient(space, state.pressure))
    less = -terms.by_pressure
    changed = convection(space, (less * driven_x, less * driven_y), steep=True)
    if has_hourglass_mode(space):
        grows_by = times(terms.conductance, terms.by_pressure)
        grown = hourglass_slope(space, terms.conductance, grows_by, state.pressure)
        points = space.reference.loops[1]
        hourglass_kernels.convected(space.dofs, space.pattern.slots, space.reference.value, grown, points, *changed)
    filled = state.film_fraction * ratio_slope
    p_upper = parts.stiffness + changed[0] + c_upper * filled[column]
    p_lower = parts.stiffness + changed[1] + c_lower * filled[row]
    level = cavity_density(problem)
    f_upper = c_upper * ratio[column] + level * parts.diffusion
    f_lower = c_lower * ratio[row] + level * parts.diffusion
    return Slopes((p_upper, p_lower, parts.rate * filled), (f_upper, f_lower, grows * ratio))


def steep_gradient(space: FilmSpace, nodal: Array) -> tuple[Array, Array]:
    """Gradient of a nodal field (size,) by the conductance's tables, (cells, points) along x and y."""
    reference = space.reference
    out = tuple(np.empty(space.area.shape) for _ in range(3))
    kernels.evaluate(
        space.vertices, space.cells, space.dofs, reference.value, reference.steep_gradient,
        reference.steep_geometry, reference.weights, nodal, *out,
    )  # fmt: skip
    return space.on_film((out[1], out[2]), space.steep_scale)


def by_deformation(
    problem: FilmProblem, parts: Operators, state: FilmState, rows: Array, at: DeformationPattern
) -> csr_array:
    """dR by the deformation at each vertex, (size, vertices) m2/s, each row times its factor in `rows` (size,)."""
    space, terms, reference = problem.space, parts.transport, problem.space.reference
    filling = state.film_fraction * density(problem, state.pressure)[0]
    driven = along(terms.conductance_slope, steep_gradient(space, state.pressure))
    twisted = hourglass_slope(space, terms.conductance, terms.conductance_slope, state.pressure)
    full = at_points(space, filling)
    dragged = (full * terms.flux_slope[0], full * terms.flux_slope[1])
    stored = 0.0 if problem.storage is None else terms.content_slope / problem.storage.step
    data, tensors = np.empty(at.entries), space.tensors
    deformation_kernels.slopes_by_deformation(
        space.dofs, at.slots, tensors.shape, reference.value, tensors.steep_gradient, tensors.gradient,
        reference.geometry_value, signs(space), space.area,
        *(space.everywhere(part) for part in (*driven, twisted, *dragged, np.atleast_2d(stored))),
        filling, rows, *reference.loops, data,
    )  # fmt: skip
    return at.matrix(data)
