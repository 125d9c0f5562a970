"""Steady viscous flow: boundary conditions, Stokes' equations, and Newton's method on Navier-Stokes'.

rho (u . grad) u = div(2 mu sym grad u) - grad p + f,   div u = 0
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import bmat
from scipy.sparse.linalg import splu

from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.numerics.arrays import Array
from reynolds.stokes.space import Sparse, StokesSpace, convection, divergence, viscous

TOLERANCE = 1e-10
"""Last step of the velocity by Newton's method, relative to the largest velocity."""
MOST_STEPS = 12
SMALLEST_SHARE = 1 / 64
"""Of a step of the density on the way to its end; a smaller one is a failure."""


@dataclass(frozen=True)
class HeldVelocities:
    """Velocity unknowns whose values are given: `unknowns` (K,) by number, `values` (K,) in m/s."""

    unknowns: NDArray[np.int64]
    values: Array


@dataclass(frozen=True)
class FlowProblem:
    """A flow to be solved: dynamic viscosity in Pa s, held velocities, and the momentum's other forces (N,).

    Forces are N per m of width, about an axis N per radian. Where a boundary is neither held nor pushed, its traction
    is zero. `enclosed`: velocity is held all round, the pressure is known up to a constant, its first unknown is zero.
    """

    space: StokesSpace
    viscosity: float
    held: HeldVelocities
    force: Array | None = None
    enclosed: bool = False

    def __post_init__(self) -> None:
        if not self.viscosity > 0.0:
            raise FilmInputError("viscosity", f"found {self.viscosity:g} Pa s", "more than zero")


@dataclass(frozen=True)
class Flow:
    """A solved flow: velocity (N,) in m/s, pressure (M,) in Pa, the density in kg/m3 (0: Stokes), steps taken."""

    problem: FlowProblem
    velocity: Array
    pressure: Array
    density: float
    steps: int


def held(space: StokesSpace, boundary: str, profile: Callable[[Array], Array] | None = None) -> HeldVelocities:
    """The velocity on a named boundary: (2, ..) in m/s at places (2, ..) in m; left out: a wall at rest."""
    unknowns = np.asarray(space.velocity.get_dofs(boundary).all())
    if profile is None:
        return HeldVelocities(unknowns, np.zeros(unknowns.size))
    both = profile(space.velocity.doflocs[:, unknowns])
    along_x = np.isin(unknowns, space.velocity.get_dofs(boundary).all("u^1"))
    return HeldVelocities(unknowns, np.where(along_x, both[0], both[1]))


def straight(space: StokesSpace, boundary: str) -> HeldVelocities:
    """No velocity along y on a named boundary: an end that flow passes square to it, or an axis of symmetry."""
    unknowns = np.asarray(space.velocity.get_dofs(boundary).all("u^2"))
    return HeldVelocities(unknowns, np.zeros(unknowns.size))


def together(parts: Iterable[HeldVelocities]) -> HeldVelocities:
    """All held velocities; of an unknown held twice the first part counts (a wall's corner, then its inlet)."""
    parts = list(parts)
    unknowns, first = np.unique(np.concatenate([part.unknowns for part in parts]), return_index=True)
    return HeldVelocities(unknowns, np.concatenate([part.values for part in parts])[first])


def solve_stokes(problem: FlowProblem) -> Flow:
    """The flow without inertia: one sparse factorisation."""
    return _newton(problem, _system(problem), 0.0, np.zeros(problem.space.size), most=1)


def solve_navier_stokes(problem: FlowProblem, densities: Sequence[float], start: Flow | None = None) -> list[Flow]:
    """The flow at each density in kg/m3, in their order, each from the one before (the first from Stokes flow).

    Newton's method; where it does not converge in MOST_STEPS steps the way from one density to the next is halved.
    Raises FilmNotConverged where that fails, mostly as the flow is no longer steady or the mesh too coarse.
    """
    system = _system(problem)
    flow = start or solve_stokes(problem)
    found = []
    for density in densities:
        flow = _continued(problem, system, flow, density)
        found.append(flow)
    return found


def _continued(problem: FlowProblem, system: Sparse, start: Flow, density: float) -> Flow:
    """The flow at a density, by as many intermediate steps as necessary."""
    flow, share = start, 1.0
    while flow.density != density:
        rest = density - flow.density
        next_density = density if share >= 1.0 else flow.density + share * rest
        try:
            flow = _newton(problem, system, next_density, np.concatenate([flow.velocity, flow.pressure]), MOST_STEPS)
            share = min(1.0, 2.0 * share)
        except FilmNotConverged as reason:
            share /= 2.0
            if share < SMALLEST_SHARE:
                raise FilmNotConverged(
                    f"Navier-Stokes flow: no steady flow found beyond a density of {flow.density:g} kg/m3 on the "
                    f"way to {density:g} ({reason.what})",
                    "a smaller Reynolds number, a finer mesh",
                ) from None
    return flow


def _system(problem: FlowProblem) -> Sparse:
    """The linear part of all equations, (N + M, N + M)."""
    continuity = divergence(problem.space)
    return bmat([[problem.viscosity * viscous(problem.space), continuity.T], [continuity, None]]).tocsr()


def _newton(problem: FlowProblem, system: Sparse, density: float, start: Array, most: int) -> Flow:
    """Newton's method at one density from a start; raises FilmNotConverged after `most` steps or a diverging one."""
    space, count = problem.space, problem.space.velocity.N
    unknowns = start.copy()
    unknowns[problem.held.unknowns] = problem.held.values
    fixed = np.append(problem.held.unknowns, count) if problem.enclosed else problem.held.unknowns
    free = np.setdiff1d(np.arange(space.size), fixed)
    force = np.zeros(count) if problem.force is None else problem.force
    change = fastest = np.inf
    for step in range(1, most + 1):
        rest, slope = -(system @ unknowns), system
        rest[:count] += force
        if density > 0.0:
            inertia, by_velocity = convection(space, unknowns[:count])
            rest[:count] -= density * inertia
            slope = system + bmat([[density * by_velocity, None], [None, _empty(space)]]).tocsr()
        way = _solved(slope[free][:, free], rest[free])
        unknowns[free] += way
        change = float(np.abs(way[: np.searchsorted(free, count)]).max())
        fastest = float(np.abs(unknowns[:count]).max())
        if density == 0.0 or change <= TOLERANCE * fastest:  # of a fluid at rest both are zero
            return Flow(problem, unknowns[:count], unknowns[count:], density, step)
        if not change < 1e3 * fastest:
            break
    raise FilmNotConverged(
        f"last change {change:.1e} m/s of a velocity up to {fastest:.1e} m/s", "a smaller step of the density"
    )


def _empty(space: StokesSpace) -> Sparse:
    """The pressure's own block, which is empty."""
    from scipy.sparse import csr_matrix

    return csr_matrix((space.pressure.N, space.pressure.N))


def _solved(matrix: Sparse, rest: Array) -> Array:
    """One step: the pattern is symmetric, and so ordered it has 2/3 of the fill of the default ordering."""
    factors = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True})
    return np.asarray(factors.solve(rest))
