"""Integrals of a film solution: load, moments, wall friction, dissipation, flows and their balances."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reynolds.equation.balance import steep_gradient
from reynolds.equation.coefficients import along, at_points, isotropic
from reynolds.equation.hourglass import saved_heat
from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.fem import kernels
from reynolds.laws.contact import contact_pressure
from reynolds.laws.roughness import Directional, pressure_factors, shear_factors, sliding_factor
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmSolution, Pocket
from reynolds.solve.rubbing import rubbing


@dataclass(frozen=True)
class Loads:
    """Integrals of one film solution, SI.

    load N (integral of p); contact_load N, borne by asperities besides (on a sphere both along z); moment_x, moment_y
    N m (integrals of p y and of -p x about the origin, p with the contact's pressure); friction_moving, friction_fixed
    N: force of oil and contact on each wall (x, y); friction_torque_* N m about the origin; dissipation W, contact
    included; flow m3/s by boundary name, positive out of the film; squeeze_flow m3/s, growth of the film's oil;
    cavity_flow m3/s, supply (+) or sink (-) of the cavity under Reynolds' condition, else zero; film_fraction_min,
    cavitated_area_fraction;
    mass_balance_error = |out + squeeze - cavity|, relative to the flow through the boundaries or the flows within the
    film, whichever are larger; energy_balance_error likewise relative to the dissipation, the walls' or the flows'
    power: round-off between smooth walls and with oil of constant density; else the terms left out: the pressure on the
    asperities' flanks, by the shear stress factors, and the work of compression.
    """

    load: float
    contact_load: float
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
    film_fraction_min: float
    cavitated_area_fraction: float
    mass_balance_error: float
    energy_balance_error: float

    @property
    def throughput(self) -> float:
        """The larger of inflow and outflow through the named boundaries, m3/s."""
        return max(sum(max(sign * flow, 0.0) for flow in self.flow.values()) for sign in (1.0, -1.0))


@dataclass(frozen=True)
class PointFields:
    """Fields at the quadrature points, (cells, points) each.

    Film pressure (Pa), its gradient (Pa/m), contact pressure (Pa), and the shear stress on both walls (Pa), that
    of contact included; filled: share of the width in which oil shears, times the shear factor of roughness
    (cells | 1, points | 1).
    """

    pressure: Array
    gradient: tuple[Array, Array]
    contact_pressure: Array
    shear_moving: tuple[Array, Array]
    shear_fixed: tuple[Array, Array]
    filled: Array


def point_fields(solution: FilmSolution) -> PointFields:
    """Pressure, its gradient, contact pressure and wall shear of a solution at the quadrature points.

    Stress of the oil on the moving wall: -w h grad p - mu (U1 - U2)/h, on the fixed wall
    -(1 - w) h grad p + mu (U1 - U2)/h; w = 1/2 where viscosity does not vary across the film (parabolic plus
    linear profile). Rough walls: each term with its shear stress factor (Patir and Cheng 1979). In a cavity oil
    fills the film fraction of the width and shears there alone (JFO); Reynolds' condition has no film fraction
    and counts it as full. Walls that touch rub with the boundary friction of their asperities.
    """
    at, at_x, at_y = evaluate(solution, solution.pressure)
    problem, film = solution.problem, solution.film
    filled = at_points(problem.space, solution.film_fraction)
    slip = tuple(a - b for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True))
    drag = tuple(filled * film.sliding_viscosity * part / film.thickness for part in slip)
    pull = tuple(filled * film.thickness * part for part in (at_x, at_y))
    on_moving, on_fixed = drag, drag
    if problem.surface is not None:
        factors = shear_factors(problem.surface, film.thickness)
        pull = _turned(factors.pressure, pull)
        cross = _turned(factors.sliding, drag)
        filled = filled * factors.couette.value
        on_moving = tuple(factors.couette.value * d - c for d, c in zip(drag, cross, strict=True))
        on_fixed = tuple(factors.couette.value * d + c for d, c in zip(drag, cross, strict=True))
    contact = rubbing(film, problem.asperities, solution.gap, problem.space.area.shape)
    w = film.moving_share
    moving = [-w * p - d - r for p, d, r in zip(pull, on_moving, contact.resists, strict=True)]
    fixed = [-(1.0 - w) * p + d + r for p, d, r in zip(pull, on_fixed, contact.resists, strict=True)]
    return PointFields(at, (at_x, at_y), contact.pressure, (moving[0], moving[1]), (fixed[0], fixed[1]), filled)


def _turned(tensor: Directional, vector: tuple[Array, ...]) -> tuple[Array, Array]:
    x, y = vector
    return tensor.x.value * x + tensor.xy.value * y, tensor.xy.value * x + tensor.y.value * y


def evaluate(solution: FilmSolution, nodal: Array) -> tuple[Array, Array, Array]:
    """A nodal field (size,) of the solution's space and its gradient at the quadrature points."""
    space = solution.problem.space
    reference = space.reference
    out = tuple(np.empty((len(space.cells), len(reference.weights))) for _ in range(3))
    kernels.evaluate(
        space.vertices, space.cells, space.dofs, reference.value, reference.gradient,
        reference.geometry_gradient, reference.weights, nodal, *out,
    )  # fmt: skip
    return out[0], *space.on_film((out[1], out[2]), space.scale)


def loads(solution: FilmSolution, weight: Array | None = None) -> Loads:
    """All integrals of a solution.

    `weight` (cells | 1, points | 1) leaves regions out of friction and dissipation (0 over a port); pressure
    integrals and flows count the whole mesh.
    """
    space, film = solution.problem.space, solution.film
    fields = point_fields(solution)
    area = space.area
    counted = area if weight is None else area * weight
    x, y, _ = space.points_in_space
    moving = [float(np.sum(t * counted)) for t in fields.shear_moving]
    fixed = [float(np.sum(t * counted)) for t in fields.shear_fixed]
    flow, drawn = _edge_flows(solution)
    squeeze_flow = float(solution.storage_rate.sum())
    made = solution.problem.cavitation is Cavitation.REYNOLDS
    cavity_flow = -float(solution.outflow[solution.cavity].sum()) - drawn if made else 0.0
    out = float(solution.outflow[solution.held].sum()) - drawn + _pocket_flow(solution)
    through = float(np.abs(solution.outflow[solution.held]).sum()) + float(np.abs(solution.storage_rate).sum())
    peak = int(np.argmax(solution.pressure))
    load, moment_x, moment_y = pressure_integrals(solution)
    return Loads(
        load=load,
        contact_load=float(np.sum(fields.contact_pressure * space.axial_area)),
        moment_x=moment_x,
        moment_y=moment_y,
        pressure_max=float(solution.pressure[peak]),
        pressure_max_at=space.place(peak),
        film_thickness_min=float(min(vertex_thickness(solution).min(), film.thickness.min())),
        friction_moving=(moving[0], moving[1]),
        friction_fixed=(fixed[0], fixed[1]),
        friction_torque_moving=_torque(fields.shear_moving, x, y, counted),
        friction_torque_fixed=_torque(fields.shear_fixed, x, y, counted),
        dissipation=_dissipation(solution, fields, weight),
        flow=flow,
        squeeze_flow=squeeze_flow,
        cavity_flow=cavity_flow,
        film_fraction_min=float(solution.film_fraction.min()),
        cavitated_area_fraction=cavitated_fraction(solution),
        mass_balance_error=abs(out + squeeze_flow - cavity_flow) / max(through, _root_sum(solution.flow_scale)),
        energy_balance_error=_energy_error(solution, fields),
    )


def pressure_integrals(solution: FilmSolution) -> tuple[float, float, float]:
    """Load (N) and moments about x and y (N m): integrals of p, of p y and of -p x over the film.

    The moments count the pressure of contact too. On a sphere the load is that along z; its normals meet in its
    centre, so that the moments about the origin are the same integrals.
    """
    space = solution.problem.space
    film = pressed = evaluate(solution, solution.pressure)[0]
    x, y, _ = space.points_in_space
    if solution.problem.asperities is not None:
        pressed = film + contact_pressure(solution.problem.asperities, solution.gap).value
    both = pressed * space.area
    return float(np.sum(film * space.axial_area)), float(np.sum(both * y)), -float(np.sum(both * x))


def boundary_flows(solution: FilmSolution) -> dict[str, float]:
    """Flow through each named boundary (m3/s, positive out), from the consistent nodal residuals.

    A corner's Poiseuille flow is divided between the held boundaries that meet there by their length, its Couette flow
    by their direction. The supply of a cavity at the boundary is not a flow through the boundary. A closed boundary's
    flow is zero by construction; a second name of edges that have a condition under their first one is left out.
    """
    return _edge_flows(solution)[0]


def _edge_flows(solution: FilmSolution) -> tuple[dict[str, float], float]:
    """Flow through each named boundary, and the cavity's supply (<= 0) under Reynolds' condition at boundaries."""
    space = solution.problem.space
    couette = couette_through(solution)
    length, rest = np.zeros(space.size), solution.outflow.copy()
    for name, across in couette.items():
        length[space.edge_dofs[name]] += space.edge_share[name]
        rest[space.edge_dofs[name]] -= across
    # At a boundary at cavitation pressure no pressure inside is lower, so that no Poiseuille flow can enter:
    # inflow in the nodal balance is the cavity's own supply in the last row of cells.
    drawn = np.zeros(space.size)
    if solution.problem.cavitation is Cavitation.REYNOLDS:
        level = solution.held & (length > 0.0) & (solution.pressure <= solution.problem.cavitation_pressure)
        drawn[level] = np.minimum(rest[level], 0.0)
    flows = dict.fromkeys((name for name in space.edge_dofs if not _counted_by_another(solution, name)), 0.0)
    for name, across in couette.items():
        nodes = space.edge_dofs[name]
        share = space.edge_share[name] / length[nodes]
        flows[name] = float(np.sum(across + (rest - drawn)[nodes] * share))
    return flows, float(drawn.sum())


def _counted_by_another(solution: FilmSolution, name: str) -> bool:
    """True for a boundary without a condition that shares edges with one that has: the flow is that one's."""
    conditions = solution.problem.boundary
    if name in conditions:
        return False
    return not solution.problem.space.film_mesh.sharing[name].isdisjoint(conditions)


def couette_through(solution: FilmSolution) -> dict[str, Array]:
    """Couette flow (m3/s, positive out) at each unknown of each boundary with a condition, by its name."""
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


def dissipated(solution: FilmSolution, filled: Array | None = None) -> tuple[Array, Array]:
    """Heat at each quadrature point, (cells, points) W: of the flow that pressure drives, and of sliding.

    h^3/(12 mu) |grad p|^2 and mu |U1 - U2|^2 / h, the latter where oil fills the film, times the area element and,
    between rough walls, Patir and Cheng's factors; sliding with the boundary friction of contact. `filled` as
    in `PointFields`, if known.
    """
    film, space, surface = solution.film, solution.problem.space, solution.problem.surface
    slip = tuple(a - b for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True))
    if filled is None:
        filled = at_points(space, solution.film_fraction)
        if surface is not None:
            filled = filled * sliding_factor(surface, film.thickness).value
    sliding = filled * film.sliding_viscosity * (slip[0] ** 2 + slip[1] ** 2) / film.thickness
    contact = rubbing(film, solution.problem.asperities, solution.gap, space.area.shape)
    return _driven(solution), (sliding + contact.heat) * space.area


def _driven(solution: FilmSolution) -> Array:
    """Heat of the flow that pressure drives, (cells, points) W, by each cell's conductance."""
    film, space, surface = solution.film, solution.problem.space, solution.problem.surface
    smooth = film.thickness**3 / (12.0 * film.viscosity)
    tensor = isotropic(smooth)
    if surface is not None:
        factor = pressure_factors(surface, film.thickness)
        x, xy, y = (smooth * part.value for part in factor)
        tensor = isotropic(x) if factor.x is factor.y else (x, y, xy)
    gradient = steep_gradient(space, solution.pressure)
    flow = along(tensor, gradient)
    heat = (flow[0] * gradient[0] + flow[1] * gradient[1]) * space.steep_area
    whole, less = heat.sum(axis=1), saved_heat(space, tensor, solution.pressure)
    left = 1.0 - np.divide(less, whole, out=np.zeros_like(less), where=whole > 0.0)
    return np.asarray(heat * left[:, None])


def _dissipation(solution: FilmSolution, fields: PointFields, weight: Array | None = None) -> float:
    """Heat of the film (W), with that of mixing in the cells at the ends of a cavity."""
    driven, sliding = dissipated(solution, fields.filled)
    mixed = float(np.sum(solution.pressure * solution.upwind_exchange))
    return float(np.sum((driven + sliding) * (1.0 if weight is None else weight))) + mixed


def _root_sum(within: Array) -> float:
    """Root of the sum of squares: over a mesh of n x n unknowns, each with 1/n of the flow, about the flow."""
    return max(float(np.sqrt(np.sum(within * within))), 1e-300)


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
    squeeze = float(np.sum(solution.pressure * solution.storage_rate))
    spent = _dissipation(solution, fields)
    scale = max(spent, abs(walls), abs(flow), _root_sum(solution.flow_scale * solution.pressure))
    return abs(walls + flow - squeeze - spent) / scale


def cavitated_fraction(solution: FilmSolution) -> float:
    """Share of the film's area in its cavity."""
    if not solution.cavity.any():
        return 0.0
    space = solution.problem.space
    inside, _, _ = evaluate(solution, solution.cavity.astype(float))
    return float(np.sum(inside * space.area) / np.sum(space.area))
