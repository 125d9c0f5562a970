"""The linear system of a film's temperature: blocks of nodes, swept down the flow, inside GMRES.

Heat moves with the oil, so that block Gauss-Seidel in the order of the flow is nearly exact except for backward
couplings: oil that circulates or flows back along a wall, and walls that conduct heat from place to place.
"""

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmNotConverged
from reynolds.numerics.arrays import Array
from reynolds.thermal import energy_kernels
from reynolds.thermal.edge_flow import EdgeFlow
from reynolds.thermal.film_profile import FilmLevels
from reynolds.thermal.walls import WallRows

TOLERANCE = 1e-12  # of the rise of temperature
ROUND_OFF = 1e-9  # the same where it gets no better
RESTART = 60
SWEPT = 0.3  # of the residual is left by a sweep, while sweeps alone are worth while
MAX_CYCLES = 20


class HeatMatrix:
    """Left side of the energy equation for temperatures (size, levels): Gauss points in m3/s, walls in K."""

    def __init__(
        self,
        across: FilmLevels,
        flows: EdgeFlow,
        gain: Array,
        conduction: Array,
        to_wall: Array,
        walls: tuple[WallRows, WallRows],
    ) -> None:
        """gain (size, m) and conduction (size,) m3/s of the nodes; to_wall (size,) W/(m2 K) is k/h."""
        neighbours = flows.neighbours
        self._graph = (neighbours.start, neighbours.neighbour, neighbours.edge, neighbours.sign, flows.flow)
        self._walls, self._to_wall = walls, to_wall
        # Heat into a wall: k/h dT/dzeta on the fixed one, -k/h dT/dzeta on the moving one.
        self._slopes = across.wall_slope * np.array([[1.0], [-1.0]])
        size, count = len(conduction), len(across.place)
        self._block = np.empty((size, count, count))
        rows = -np.stack([wall.by_flux * to_wall for wall in walls], axis=1)[:, :, None] * self._slopes
        rows[:, 0, 0] += walls[0].own
        rows[:, 1, -1] += walls[1].own
        energy_kernels.blocks(
            neighbours.start, neighbours.edge, neighbours.sign, flows.flow, flows.up, gain, conduction,
            across.derivative, across.second, rows, self._block,
        )  # fmt: skip
        self._inverse = np.linalg.inv(self._block)
        self._order = _order(flows)

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes and levels."""
        return self._block.shape[0], self._block.shape[1]

    def wall_flux(self, temperature: Array) -> Array:
        """Heat flux into the fixed and the moving wall (2, size) W/m2."""
        return np.asarray((temperature @ self._slopes.T).T * self._to_wall)

    def apply(self, temperature: Array) -> Array:
        """The left side of a temperature field (size, levels)."""
        out = np.empty(self.shape)
        energy_kernels.apply(*self._graph, self._block, temperature, out)
        flux = self.wall_flux(temperature)
        for side, wall in enumerate(self._walls):
            if wall.coupled is not None:
                out[:, -side] = wall.coupled(temperature[:, -side], flux[side])
        return out

    def sweep(self, right: Array) -> Array:
        """Nearly the solution: one sweep down the flow and one back up."""
        field = np.empty(self.shape)
        energy_kernels.sweep(*self._graph, self._inverse, self._order, np.ascontiguousarray(right), field)
        return field


def solve_heat(matrix: HeatMatrix, right: Array, start: Array | None, closer: float = 0.0) -> tuple[Array, int]:
    """Temperature (size, levels) with this right side, and the number of sweeps.

    Afterwards the swept residual is below 1e-12 of the swept right side (below 1e-9 where round-off is
    larger), or below `closer` of that at the start. Raises FilmNotConverged.
    """
    from scipy.sparse.linalg import LinearOperator, gmres

    size = right.size
    sweeps = 0

    def preconditioned(vector: Array) -> Array:
        nonlocal sweeps
        sweeps += 1
        return matrix.sweep(matrix.apply(vector.reshape(matrix.shape))).ravel()

    load = matrix.sweep(right).ravel()
    if not np.isfinite(load).all():
        raise FilmNotConverged(
            "the heat of the film has no way out at some places",
            "a wall that takes heat, or flow through the film (two adiabatic walls hold what arises for ever)",
        )
    answer = np.zeros(size) if start is None else start.ravel()
    scale = max(float(np.linalg.norm(load)), 1e-300)
    rest = load - preconditioned(answer)
    missed = float(np.linalg.norm(rest)) / scale
    tolerance, before = max(TOLERANCE, closer * missed), np.inf
    while missed > tolerance and missed <= SWEPT * before:  # flow carries most of the heat: sweeps alone get there
        answer, before = answer + rest, missed
        rest = load - preconditioned(answer)
        missed = float(np.linalg.norm(rest)) / scale
    operator = LinearOperator((size, size), matvec=preconditioned, dtype=float)
    for _ in range(MAX_CYCLES):
        if missed <= tolerance:
            break
        before = missed
        answer, _ = gmres(operator, load, x0=answer, rtol=tolerance, atol=0.0, restart=RESTART, maxiter=1)
        missed = float(np.linalg.norm(load - preconditioned(answer))) / scale
        # Conduction far stronger than convection leaves more round-off than the tolerance.
        if missed <= ROUND_OFF and missed > 0.5 * before:
            break
    if not missed <= max(tolerance, ROUND_OFF):
        raise FilmNotConverged(
            f"film temperature not settled after {sweeps} sweeps (residual {missed:.2g})",
            "fewer levels across the film, a finer mesh, or a wall that takes heat",
        )
    return answer.reshape(matrix.shape), sweeps


def _order(flows: EdgeFlow) -> NDArray[np.int64]:
    """Nodes in the order of the mean flow, those that oil enters first."""
    neighbours = flows.neighbours
    mean = flows.flow.mean(axis=1)
    out_flow = neighbours.sign * mean[neighbours.edge]
    first = np.argsort(-flows.leaving.mean(axis=1), kind="stable")
    order = np.empty(len(first), dtype=np.int64)
    energy_kernels.downstream(neighbours.start, neighbours.neighbour, out_flow, first, order)
    return order
