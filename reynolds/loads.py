"""What a pressure field does: load, moments, wall friction, dissipation, flows and their balances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reynolds import kernels
from reynolds.balance import steep_gradient
from reynolds.film import Cavitation, FilmSolution, Pocket, vertex_thickness
from reynolds.mesh import Array
from reynolds.transport import at_points


@dataclass(frozen=True)
class Loads:
    """Integrals of one film solution, SI.

    load N (integral of p); moment_x, moment_y N m (integrals of p y and of -p x about the origin);
    friction_moving, friction_fixed N: force of the oil on each wall (x, y); friction_torque_* N m about the
    origin; dissipation W; flow m3/s by boundary name, positive out of the film; squeeze_flow m3/s = integral
    of dh/dt; cavity_flow m3/s that Reynolds' condition makes the cavity supply (+) or swallow (-), zero in a
    full film; cavitated_area_fraction; mass_balance_error = |out + squeeze - cavity|, relative to the flow
    through the boundaries or the flows within the film, whichever are larger; energy_balance_error likewise
    relative to the dissipation, the walls' or the flows' power.
    """

    load: float
    moment_x: float
    moment_y: float
    pressure_max: float
    pressure_max_at: tuple[float, float]
    film_thickness_min: float
    friction_moving: tuple[float, float]
    friction_fixed: tuple[float, float]
    friction_torque_moving: float
    friction_torque_fixed: float
    dissipation: float
    flow: Mapping[str, float]
    squeeze_flow: float
    cavity_flow: float
    cavitated_area_fraction: float
    mass_balance_error: float
    energy_balance_error: float

    @property
    def throughput(self) -> float:
        """The larger of what enters and what leaves through the named boundaries, m3/s."""
        return max(sum(max(sign * flow, 0.0) for flow in self.flow.values()) for sign in (1.0, -1.0))


@dataclass(frozen=True)
class PointFields:
    """Pressure (Pa), its gradient (Pa/m) and the shear stress on both walls (Pa) at the quadrature points."""

    pressure: Array
    gradient: tuple[Array, Array]
    shear_moving: tuple[Array, Array]
    shear_fixed: tuple[Array, Array]


def point_fields(solution: FilmSolution) -> PointFields:
    """Pressure, gradient and wall shear of a solution at the quadrature points, (cells, points) each.

    Stress of the oil on the moving wall: -w h grad p - mu (U1 - U2)/h, on the fixed wall
    -(1 - w) h grad p + mu (U1 - U2)/h; w = 1/2 where viscosity does not vary across the film (parabolic plus
    linear profile). In a cavity oil fills the film fraction of the width and shears there alone (JFO); Reynolds'
    condition knows no film fraction and takes it as full.
    """
    at, at_x, at_y = evaluate(solution, solution.pressure)
    film = solution.film
    filled = at_points(solution.problem.space, solution.film_fraction)
    one, two = (filled * share * film.thickness for share in (film.moving_share, 1.0 - film.moving_share))
    drag = [
        filled * film.sliding_viscosity * (moving - fixed) / film.thickness
        for moving, fixed in zip(film.velocity_moving, film.velocity_fixed, strict=True)
    ]
    moving = (-one * at_x - drag[0], -one * at_y - drag[1])
    fixed = (-two * at_x + drag[0], -two * at_y + drag[1])
    return PointFields(at, (at_x, at_y), moving, fixed)


def evaluate(solution: FilmSolution, nodal: Array) -> tuple[Array, Array, Array]:
    """A nodal field (size,) of the solution's space and its gradient at the quadrature points."""
    space = solution.problem.space
    reference = space.reference
    out = tuple(np.empty((len(space.cells), len(reference.weights))) for _ in range(3))
    kernels.evaluate(
        space.vertices, space.cells, space.dofs, reference.value, reference.gradient,
        reference.geometry_gradient, reference.weights, nodal, *out,
    )  # fmt: skip
    return out[0], out[1], out[2]


def loads(solution: FilmSolution, weight: Array | None = None) -> Loads:
    """All integrals of a solution.

    `weight` (cells | 1, points | 1) leaves regions out of friction and dissipation (0 where the film is no
    film but a port); pressure integrals and flows count the whole mesh.
    """
    space, film = solution.problem.space, solution.film
    fields = point_fields(solution)
    area = space.area
    rubbing = area if weight is None else area * weight
    x, y = space.points
    moving = [float(np.sum(t * rubbing)) for t in fields.shear_moving]
    fixed = [float(np.sum(t * rubbing)) for t in fields.shear_fixed]
    flow, drawn = _edge_flows(solution)
    squeeze_flow = float(solution.swallowed.sum())
    made = solution.problem.cavitation is Cavitation.REYNOLDS
    cavity_flow = -float(solution.outflow[solution.cavity].sum()) - drawn if made else 0.0
    out = float(solution.outflow[solution.held].sum()) - drawn + _pocket_flow(solution)
    through = float(np.abs(solution.outflow[solution.held]).sum()) + float(np.abs(solution.swallowed).sum())
    peak = int(np.argmax(solution.pressure))
    load, moment_x, moment_y = pressure_integrals(solution)
    return Loads(
        load=load,
        moment_x=moment_x,
        moment_y=moment_y,
        pressure_max=float(solution.pressure[peak]),
        pressure_max_at=_place(solution, peak),
        film_thickness_min=float(min(vertex_thickness(solution).min(), film.thickness.min())),
        friction_moving=(moving[0], moving[1]),
        friction_fixed=(fixed[0], fixed[1]),
        friction_torque_moving=_torque(fields.shear_moving, x, y, rubbing),
        friction_torque_fixed=_torque(fields.shear_fixed, x, y, rubbing),
        dissipation=_dissipation(solution, weight),
        flow=flow,
        squeeze_flow=squeeze_flow,
        cavity_flow=cavity_flow,
        cavitated_area_fraction=_cavitated_fraction(solution),
        mass_balance_error=abs(out + squeeze_flow - cavity_flow) / max(through, _root_sum(solution.meeting)),
        energy_balance_error=_energy_error(solution, fields),
    )


def pressure_integrals(solution: FilmSolution) -> tuple[float, float, float]:
    """Load (N) and moments about x and y (N m): integrals of p, of p y and of -p x over the film."""
    space = solution.problem.space
    weighted = evaluate(solution, solution.pressure)[0] * space.area
    x, y = space.points
    return float(weighted.sum()), float(np.sum(weighted * y)), -float(np.sum(weighted * x))


def boundary_flows(solution: FilmSolution) -> dict[str, float]:
    """Flow through each named boundary (m3/s, positive out), from the consistent nodal residuals.

    A corner's Poiseuille flow is divided between the held boundaries that meet there by their length, its
    Couette flow by their direction. What a cavity that reaches the boundary draws is not a flow through the
    boundary. A closed boundary's flow is zero by construction.
    """
    return _edge_flows(solution)[0]


def _edge_flows(solution: FilmSolution) -> tuple[dict[str, float], float]:
    """Flow through each named boundary, and what Reynolds' condition draws (<= 0) where a cavity meets one."""
    space = solution.problem.space
    couette = _couette_through(solution)
    length, rest = np.zeros(space.size), solution.outflow.copy()
    for name, across in couette.items():
        length[space.edge_dofs[name]] += space.edge_share[name]
        rest[space.edge_dofs[name]] -= across
    # At a boundary at cavitation pressure no pressure inside is lower, so that no Poiseuille flow can enter:
    # what does in the nodal balance is the cavity's own supply in the last row of cells.
    drawn = np.zeros(space.size)
    if solution.problem.cavitation is Cavitation.REYNOLDS:
        level = solution.held & (length > 0.0) & (solution.pressure <= solution.problem.cavitation_pressure)
        drawn[level] = np.minimum(rest[level], 0.0)
    flows = dict.fromkeys(space.edge_dofs, 0.0)
    for name, across in couette.items():
        nodes = space.edge_dofs[name]
        share = space.edge_share[name] / length[nodes]
        flows[name] = float(np.sum(across + (rest - drawn)[nodes] * share))
    return flows, float(drawn.sum())


def _couette_through(solution: FilmSolution) -> dict[str, Array]:
    """Couette flow (m3/s, positive out) at each unknown of each boundary with a condition."""
    space = solution.problem.space
    nodal = solution.film_fraction[:, None] * np.column_stack([space.to_unknowns(f) for f in solution.flux])
    return {
        name: np.sum(nodal[space.edge_dofs[name]] * space.edge_normal[name], axis=1)
        for name in space.edge_dofs
        if name in solution.problem.boundary
    }


def _pocket_flow(solution: FilmSolution) -> float:
    space = solution.problem.space
    return sum(
        float(solution.outflow[space.edge_dofs[name]].sum())
        for name, condition in solution.problem.boundary.items()
        if isinstance(condition, Pocket)
    )


def _torque(shear: tuple[Array, Array], x: Array, y: Array, area: Array) -> float:
    return float(np.sum((x * shear[1] - y * shear[0]) * area))


def dissipated(solution: FilmSolution) -> tuple[Array, Array]:
    """Heat at each quadrature point, (cells, points) W: of the flow that pressure drives, and of sliding.

    h^3/(12 mu) |grad p|^2 and mu |U1 - U2|^2 / h, the latter where oil fills the film, times the area element.
    """
    film, space = solution.film, solution.problem.space
    slip = sum((a - b) ** 2 for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True))
    along_x, along_y = steep_gradient(space, solution.pressure)
    driven = film.thickness**3 / (12.0 * film.viscosity) * (along_x**2 + along_y**2)
    sliding = at_points(space, solution.film_fraction) * film.sliding_viscosity * slip / film.thickness
    return driven * space.steep_area, sliding * space.area


def _dissipation(solution: FilmSolution, weight: Array | None = None) -> float:
    driven, sliding = dissipated(solution)
    return float(np.sum((driven + sliding) * (1.0 if weight is None else weight)))


def _root_sum(within: Array) -> float:
    """Root of the sum of squares: over a mesh of n x n unknowns, each with 1/n of the flow, about the flow."""
    return max(float(np.linalg.norm(within)), 1e-300)


def _energy_error(solution: FilmSolution, fields: PointFields) -> float:
    """Shear work of the walls + flow work at boundaries and cavity - squeeze work, against dissipation."""
    film, area = solution.film, solution.problem.space.area
    walls = -sum(
        float(np.sum((m * u1 + f * u2) * area))
        for m, f, u1, u2 in zip(
            fields.shear_moving, fields.shear_fixed, film.velocity_moving, film.velocity_fixed, strict=True
        )
    )
    flow = -float(np.sum(solution.outflow * solution.pressure))
    squeeze = float(np.sum(solution.pressure * solution.swallowed))
    spent = _dissipation(solution)
    scale = max(spent, abs(walls), abs(flow), _root_sum(solution.meeting * solution.pressure))
    return abs(walls + flow - squeeze - spent) / scale


def _cavitated_fraction(solution: FilmSolution) -> float:
    if not solution.cavity.any():
        return 0.0
    space = solution.problem.space
    inside, _, _ = evaluate(solution, solution.cavity.astype(float))
    return float(np.sum(inside * space.area) / np.sum(space.area))


def _place(solution: FilmSolution, node: int) -> tuple[float, float]:
    space = solution.problem.space
    cell, local = (int(k[0]) for k in np.nonzero(space.dofs == node))
    corners = space.vertices[space.cells[cell]]
    if local < len(corners):
        return float(corners[local, 0]), float(corners[local, 1])
    return float(corners[:, 0].mean()), float(corners[:, 1].mean())
