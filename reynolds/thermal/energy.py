"""Temperature of a film: the energy equation, resolved across the film, convected by the film's discrete flows.

With zeta = z/h, the fixed wall at 0 and the moving wall at 1, and at a fixed place in the plane

    rho c (theta h dT/dt + h u . grad T + W dT/dzeta)
        = (k theta/h) d2T/dzeta2 + h mu |du/dz|^2 + beta T h u . grad p

(convection, conduction across, dissipation, work of compression; conduction along the film is left out, as h/L is
small). u is the velocity in the plane at this zeta and W = w - zeta dh/dt - zeta u . grad h the flow through the
levels; it follows from continuity, dW/dzeta = - div(h u) - d(theta h)/dt, and vanishes at both walls. The film
fraction theta scales storage, convection, conduction and dissipation.

In the plane the unknowns of the film are control volumes between which its discrete flows convect heat, at each
level with limited faces (of second order, no new extremum, stable in backflow); across it the equation holds at
Gauss points (`film_profile`). As flows and temperatures are polynomials that the quadrature integrates, the heat
balance closes to the error of the linear solve, and a uniform temperature stays uniform exactly. Validity: that of
the film equation, and rho c U h^2/(k L) of any size; density and c are constant here.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from reynolds.equation.balance import steep_gradient
from reynolds.equation.coefficients import at_points
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.numerics.anderson import History
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import dissipated
from reynolds.thermal import energy_kernels
from reynolds.thermal.edge_flow import EdgeFlow, edge_flow, open_unknowns
from reynolds.thermal.energy_system import HeatMatrix, solve_heat
from reynolds.thermal.film_profile import FlowProfile
from reynolds.thermal.walls import ConductingBody, Convecting, GivenTemperature, Wall, wall_rows

LEAST_WET = 1e-6  # film fraction that conducts where there is less: a dry film has its walls' temperature
LEAST_JUMP = 2e-5  # of the range of temperature: smaller jumps go upwind, for the corrections to converge
LEAST_RANGE = 1e-3  # K, where all is nearly at one temperature
CORRECTED = 1e-5  # change of the last correction over the range of temperature
PATIENCE = 40  # corrections, after which larger and larger jumps go upwind too
CLOSER = 0.1  # of the residual is left by the solve of a correction
MAX_CORRECTIONS = 100
ROUND_OFF = 1e-7  # of the heat that the film could conduct over its range of temperature: less is round-off
NO_INFLOW = 1e-9  # of the unknown's flow scale


@dataclass(frozen=True)
class Heat:
    """Properties of oil and surroundings for a film's heat.

    density (kg/m3), specific_heat (J/(kg K)), conductivity (W/(m K)) and thermal expansion (1/K; zero leaves the
    work of compression out) of the oil; the two walls; `inflow`: temperature (K) of inflow through the boundary of
    this name, and `port_temperature` of inflow at `FilmProblem.held_nodes`. Oil that leaves has its own.
    Raises FilmInputError for a property that is not positive.
    """

    density: float
    specific_heat: float
    conductivity: float
    fixed_wall: Wall
    moving_wall: Wall
    inflow: Mapping[str, float]
    expansion: float = 0.0
    port_temperature: float | None = None

    def __post_init__(self) -> None:
        for name in ("density", "specific_heat", "conductivity"):
            if not getattr(self, name) > 0.0:
                raise FilmInputError(name.replace("_", " "), f"{getattr(self, name):g}", "a positive SI value")
        for name, kelvin in self.inflow.items():
            if not (np.isfinite(kelvin) and kelvin > 0.0):
                raise FilmInputError(f"inflow temperature at {name}", f"{kelvin:g} K", "above absolute zero")

    @property
    def capacity(self) -> float:
        """rho c, J/(m3 K)."""
        return self.density * self.specific_heat

    @property
    def given(self) -> tuple[float, ...]:
        """Temperatures that the case fixes (K): of inflow first, then of walls; empty without any."""
        ports = () if self.port_temperature is None else (self.port_temperature,)
        walls = [
            float(np.mean(wall.temperature if isinstance(wall, GivenTemperature) else wall.outer_temperature))
            for wall in (self.fixed_wall, self.moving_wall)
            if isinstance(wall, GivenTemperature | Convecting)
        ]
        bodies = [
            float(np.mean(wall.reference))
            for wall in (self.fixed_wall, self.moving_wall)
            if isinstance(wall, ConductingBody)
        ]
        return (*self.inflow.values(), *ports, *walls, *bodies)

    @property
    def datum(self) -> float:
        """The lowest given temperature (K), against which heat is counted. Raises FilmInputError without one."""
        if not self.given:
            raise FilmInputError("heat", "no temperature anywhere", "one of inflow or of a wall")
        return min(self.given)


@dataclass(frozen=True)
class FilmTemperature:
    """Temperature of a film (K) and where its heat goes (W).

    temperature (size, m + 2) at the levels across (fixed wall first), mean (size,) over the thickness; heat_flux
    (2, size) W/m2 into the fixed and the moving wall; to_fixed, to_moving W; convected_out: by the oil through the
    boundary, against `datum` (K), the lowest given temperature; stored: in the oil that the film holds;
    dissipation, compression: sources. energy_balance_error: residual over the heat passed, or over
    the least that counts as heat.
    """

    solution: FilmSolution = field(repr=False)
    profile: FlowProfile = field(repr=False)
    temperature: Array
    heat_flux: Array
    to_fixed: float
    to_moving: float
    convected_out: float
    stored: float
    dissipation: float
    compression: float
    datum: float
    energy_balance_error: float
    iterations: int

    @property
    def mean(self) -> Array:
        """Mean over the thickness (size,) K."""
        return self.profile.levels.mean(self.temperature)

    @property
    def highest(self) -> Array:
        """Maximum over the thickness (size,) K, walls included, of the profile (`FilmLevels.highest`)."""
        return self.profile.levels.highest(self.temperature)

    @property
    def fixed_wall(self) -> Array:
        """Temperature of the fixed wall's surface (size,) K."""
        return self.temperature[:, 0]

    @property
    def moving_wall(self) -> Array:
        """Temperature of the moving wall's surface (size,) K."""
        return self.temperature[:, -1]


@dataclass(frozen=True)
class _Terms:
    """The equation's terms at the unknowns: flows m3/s, heat W, conductance (size,) W/K of k theta/h."""

    flows: EdgeFlow
    conductance: Array
    area: Array
    entering: Array  # (size, m) m3/s of inflow, positive
    inflow: Array  # (size,) K
    before: Array  # (size,) m3/s: oil of one step ago over the step
    old: Array  # (size, m) K
    heat: Array  # (size, m) W
    datum: float


def solve_energy(
    solution: FilmSolution,
    heat: Heat,
    profile: FlowProfile,
    *,
    start: Array | None = None,
    before: Array | None = None,
    at_once: bool = False,
    corrected: float = CORRECTED,
) -> FilmTemperature:
    """The temperature of a solved film, whose viscosities follow `profile`.

    `start` (size, m + 2) K is a first guess; `before` (size, m + 2) K is the temperature one time step ago, needed
    where the film problem has a storage, unless the temperature follows `at_once`: without dT/dt, stored oil having the
    temperature of its place. The last correction of faces to second order changes the temperature by `corrected` of its
    range at most, or by CORRECTED where that is larger. Afterwards the energy balance closes to 1e-9 of the heat passed
    (1e-8 where conduction outweighs convection 1e4 times). Raises FilmInputError where oil enters without a
    temperature, and FilmNotConverged.
    """
    terms = _terms(solution, heat, profile, before, at_once)
    matrix, right = _equations(solution, heat, profile, terms)
    guess = None if start is None else start - terms.datum
    rise, iterations = _sharpened(terms, matrix, right, guess, max(corrected, CORRECTED))
    return _answer(solution, heat, profile, terms, matrix, rise, iterations)


def _sharpened(
    terms: _Terms, matrix: HeatMatrix, right: Array, guess: Array | None, corrected: float
) -> tuple[Array, int]:
    """The rise with faces of second order: upwind solves, each with the last field's correction on the right.

    Faces of a jump of temperature below `least` are upwind: it grows where the corrections do not converge.
    """
    neighbours, flow = terms.flows.neighbours, terms.flows.flow
    graph = (neighbours.start, neighbours.neighbour, neighbours.edge, neighbours.sign, flow)
    history, iterations, rise = History(), 0, guess
    if rise is None:
        rise, iterations = solve_heat(matrix, right, None)
    added, whole = np.empty_like(terms.entering), right.copy()
    for correction in range(MAX_CORRECTIONS):
        spread = max(float(np.ptp(rise)), LEAST_RANGE)
        least = LEAST_JUMP * spread * 2.0 ** max(0, correction - PATIENCE)
        energy_kernels.sharpen(*graph, terms.entering, terms.inflow - terms.datum, rise, least, added)
        whole[:, 1:-1] = right[:, 1:-1] + added
        found, sweeps = solve_heat(matrix, whole, rise, CLOSER)
        iterations += sweeps
        change = float(np.abs(found - rise).max())
        if change <= corrected * spread:
            found, sweeps = solve_heat(matrix, whole, found)
            return found, iterations + sweeps
        rise = history.extrapolate(rise, found)
    raise FilmNotConverged(
        f"film temperature not settled after {MAX_CORRECTIONS} corrections (it still changes by {change:.2g} K)",
        "a finer or more even mesh",
    )


def _terms(solution: FilmSolution, heat: Heat, profile: FlowProfile, before: Array | None, at_once: bool) -> _Terms:
    space, film = solution.problem.space, solution.film
    flows = edge_flow(solution, profile)
    wet = np.maximum(at_points(space, solution.film_fraction), LEAST_WET)
    inflow = _inflow_temperature(solution, heat)
    storage, m = solution.problem.storage, len(profile.levels.weights)
    oil, old = np.zeros(space.size), np.zeros((space.size, m))
    if storage is not None and not at_once:
        if before is None or before.shape != (space.size, m + 2):
            found = "none" if before is None else f"shape {before.shape}"
            expected = f"({space.size}, {m + 2}) K, from which a film that stores oil starts"
            raise FilmInputError("temperature one step ago", found, expected)
        oil, old = storage.held_before / storage.step, before[:, 1:-1]
    return _Terms(
        flows=flows,
        conductance=space.lumped(wet * heat.conductivity / film.thickness),
        area=space.lumped(np.ones((1, 1))),
        entering=np.where(np.isnan(inflow)[:, None], 0.0, np.maximum(-flows.leaving, 0.0)),
        inflow=np.where(np.isnan(inflow), 0.0, inflow),
        before=oil,
        old=old,
        heat=dissipation(solution, profile),
        datum=heat.datum,
    )


def _inflow_temperature(solution: FilmSolution, heat: Heat) -> Array:
    """Temperature of the inflow at each unknown (size,) K; NaN without inflow."""
    space, boundary = solution.problem.space, solution.problem.boundary
    if unknown := set(heat.inflow) - set(boundary):
        expected = f"one of {', '.join(sorted(boundary))}, through which oil can pass"
        raise FilmInputError(f"inflow temperature at {', '.join(sorted(unknown))}", "no open boundary", expected)
    total, length = np.zeros(space.size), np.zeros(space.size)
    for name, kelvin in heat.inflow.items():
        # A corner of two boundaries has a share of each by its length; a pocket's single unknown has its own.
        total[space.edge_dofs[name]] += space.edge_share[name] * kelvin
        length[space.edge_dofs[name]] += space.edge_share[name]
    found = np.where(length > 0.0, total / np.where(length > 0.0, length, 1.0), np.nan)
    named = np.zeros(space.size, dtype=bool)
    for name in boundary:
        named[space.edge_dofs[name]] = True
    if heat.port_temperature is not None:
        found[~named & open_unknowns(solution)] = heat.port_temperature
    net = np.where(open_unknowns(solution), solution.outflow, 0.0)
    dry = np.isnan(found) & (net < -NO_INFLOW * solution.flow_scale)
    if dry.any():
        names = [name for name in boundary if dry[space.edge_dofs[name]].any()] or ["held nodes"]
        where = f"inflow temperature at {', '.join(names)}"
        raise FilmInputError(where, f"none, and {-net[dry].sum():.3g} m3/s of oil enter", "a temperature in K")
    return found


def dissipation(solution: FilmSolution, profile: FlowProfile) -> Array:
    """Heat that arises at each unknown and Gauss point, per zeta, (size, m) W.

    h mu |du/dz|^2 with tau = mu du/dz = mu_c (U1 - U2)/h + (z - zbar) grad p: its two squares and their product
    are integrated over the plane by the film's quadrature, so that the sum is the dissipation of `loads`: with the
    friction of walls in contact, spread as that of sliding, and with that of mixing at the ends of a cavity.
    """
    space, film = solution.problem.space, solution.film
    driven, sliding = dissipated(solution)
    along = steep_gradient(space, solution.pressure)
    slip = [one - two for one, two in zip(film.velocity_moving, film.velocity_fixed, strict=True)]
    filled = at_points(space, solution.film_fraction)
    mixed = 2.0 * filled * film.thickness * (slip[0] * along[0] + slip[1] * along[1])
    parts = (
        (sliding / space.area, profile.sliding_heat),
        (driven / space.area, profile.driven_heat),
        (mixed, profile.mixed_heat),
    )
    # Mixing sums to zero, so that any level of pressure is right: above the cavity's no heat is negative.
    mixed_up = (solution.pressure - solution.problem.cavitation_pressure) * solution.upwind_exchange
    return np.asarray(sum(space.lumped(part)[:, None] * shape for part, shape in parts) + mixed_up[:, None])


def _equations(solution: FilmSolution, heat: Heat, profile: FlowProfile, terms: _Terms) -> tuple[HeatMatrix, Array]:
    """Left and right side for the rise above the datum; Gauss points in m3/s (K), walls in K."""
    across, flows, space = profile.levels, terms.flows, solution.problem.space
    g = terms.conductance / terms.area
    walls = [wall_rows(wall, space, terms.area, g) for wall in (heat.fixed_wall, heat.moving_wall)]
    work = heat.expansion / heat.capacity * flows.working
    right = np.empty((space.size, len(across.place)))
    right[:, 0], right[:, -1] = (wall.right - wall.of_uniform * terms.datum for wall in walls)
    right[:, 1:-1] = (
        terms.entering * (terms.inflow - terms.datum)[:, None]
        + terms.before[:, None] * (terms.old - terms.datum)
        + work * terms.datum
        + terms.heat / heat.capacity
    )
    gain = terms.entering + terms.before[:, None] - work
    return HeatMatrix(across, flows, gain, terms.conductance / heat.capacity, g, (walls[0], walls[1])), right


def _answer(
    solution: FilmSolution,
    heat: Heat,
    profile: FlowProfile,
    terms: _Terms,
    matrix: HeatMatrix,
    rise: Array,
    iterations: int,
) -> FilmTemperature:
    weights, flows, inner = profile.levels.weights, terms.flows, rise[:, 1:-1]
    flux = matrix.wall_flux(rise)
    to_fixed, to_moving = (float(terms.area @ one) for one in flux)
    enters = terms.entering * (terms.inflow - terms.datum)[:, None]
    leaves = (flows.leaving + terms.entering) * inner
    grown = terms.before[:, None] * (inner - (terms.old - terms.datum))
    convected = heat.capacity * float(((leaves - enters) @ weights).sum())
    stored = heat.capacity * float(((grown + flows.storage_rate[:, None] * inner) @ weights).sum())
    spent = float((terms.heat @ weights).sum())
    pressed = heat.expansion * float((flows.working * (inner + terms.datum) @ weights).sum())
    missing = convected + stored + to_fixed + to_moving - spent - pressed
    scale = abs(convected) + abs(stored) + abs(to_fixed) + abs(to_moving) + spent + abs(pressed)
    scale = max(scale, ROUND_OFF * float(terms.conductance.sum() * np.abs(rise).max()))
    return FilmTemperature(
        solution=solution,
        profile=profile,
        temperature=rise + terms.datum,
        heat_flux=flux,
        to_fixed=to_fixed,
        to_moving=to_moving,
        convected_out=convected,
        stored=stored,
        dissipation=spent,
        compression=pressed,
        datum=terms.datum,
        energy_balance_error=abs(missing) / scale if scale > 0.0 else 0.0,
        iterations=iterations,
    )
