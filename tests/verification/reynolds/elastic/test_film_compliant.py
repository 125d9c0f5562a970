"""Film equation: elastic walls.

Springs side by side (Winkler 1867) leave closed forms or ordinary differential equations of one dimension; a thin
elastic layer must tend to them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from reynolds import (
    ZERO,
    Body,
    Cavitation,
    Cell,
    Compliance,
    Elastic,
    FilmNotConverged,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Plane,
    Pocket,
    Supports,
    block,
    body_wall,
    both,
    film,
    film_space,
    loads,
    march,
    rectangle,
    winkler,
)
from reynolds.bodies.compliance import ElasticWalls

LENGTH, WIDE, GAP, VISCOSITY = 10e-3, 2.5e-3, 5e-6, 0.03
STIFFNESS, HIGH = 1e13, 30e6
SLIDING = (np.full((1, 1), 5.0), ZERO)


def strip(cells: int, cell: Cell = Cell.QUADRILATERAL) -> FilmSpace:
    """A strip of the infinitely wide film, its sides sewn together."""
    return film_space(rectangle((LENGTH, WIDE), (cells, 2), cell=cell, periodic_y=True))


def channel(space: FilmSpace, walls: ElasticWalls | None, high: float = HIGH) -> FilmSolution:
    posed = FilmProblem(space, film(GAP, VISCOSITY), {"left": Held(high), "right": Held(0.0)}, walls=walls)
    return FilmSolver(space).solve(posed)


def channel_flow(stiffness: float, high: float = HIGH) -> float:
    """k/(48 mu L) [(h0 + p1/k)^4 - h0^4] per width."""
    return stiffness / (48.0 * VISCOSITY * LENGTH) * ((GAP + high / stiffness) ** 4 - GAP**4)


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("dense", [False, True])
def test_winkler_channel(cell, dense, validation):
    """(h0 + p/k)^4 is linear along the channel, yet the flow is exact: the mean of h^3 p' over a cell is."""
    space = strip(16, cell)
    walls = winkler(space, STIFFNESS)
    if dense:
        walls = Compliance(walls.matrix.toarray())
    found = channel(space, walls)
    kind = f"{cell.value}, {'dense' if dense else 'sparse'} walls"
    for quantity, expected, tolerance in (
        ("flow per width", channel_flow(STIFFNESS), 1e-12),
        ("flow per width, printed digits", 2.4104167e-6, 0.5e-7 / 2.4),
    ):
        validation(
            case="Channel on Winkler's foundation",
            source="closed form",
            quantity=f"{quantity}, {kind}",
            unit="m2/s",
            expected=expected,
            obtained=loads(found).flow["right"] / WIDE,
            relative_tolerance=tolerance,
            note="exact on any mesh",
        )
    at = space.vertices[:, 0] / LENGTH
    opened = ((GAP + HIGH / STIFFNESS) ** 4 * (1.0 - at) + GAP**4 * at) ** 0.25 - GAP
    assert found.deformation == pytest.approx(opened, rel=1e-10, abs=1e-18)
    assert loads(found).mass_balance_error < 1e-13
    assert found.iterations <= 5


def test_rigid_channel(validation):
    validation(
        case="Channel on Winkler's foundation",
        source="closed form",
        quantity="flow per width between rigid walls",
        unit="m2/s",
        expected=1.0416667e-6,
        obtained=loads(channel(strip(4), None)).flow["right"] / WIDE,
        relative_tolerance=0.5e-7,
    )


def test_walls_that_overlap_until_they_give_way(validation):
    """Undeformed they would cut 2 um into each other; the pressure at both ends holds them apart."""
    space, overlap, ends = strip(16), -2e-6, (60e6, 40e6)
    posed = replace(film(GAP, VISCOSITY), thickness=np.full((1, 1), overlap))
    held = {"left": Held(ends[0]), "right": Held(ends[1])}
    found = FilmSolver(space).solve(FilmProblem(space, posed, held, walls=winkler(space, STIFFNESS)))
    high, low = ((overlap + p / STIFFNESS) ** 4 for p in ends)
    validation(
        case="Channel on Winkler's foundation",
        source="closed form",
        quantity="flow per width, 60 to 40 MPa, walls that overlap by 2 um undeformed",
        unit="m2/s",
        expected=STIFFNESS / (48.0 * VISCOSITY * LENGTH) * (high - low),
        obtained=loads(found).flow["right"] / WIDE,
        relative_tolerance=1e-11,
        note="exact on any mesh",
    )


def test_two_walls_give_way_as_one_of_their_sum():
    space = strip(12)
    soft = winkler(space, STIFFNESS)
    flow = loads(channel(space, both(soft, soft))).flow["right"] / WIDE
    assert flow == pytest.approx(channel_flow(0.5 * STIFFNESS), rel=1e-12)


def test_thin_elastic_layer_is_a_winkler_foundation(tmp_path, validation):
    """A layer bonded to a rigid bed: k = E (1 - nu)/((1 + nu)(1 - 2 nu) t) as t/L tends to zero."""
    layer = Elastic(2e9, 0.2)
    modulus = layer.youngs_modulus * 0.8 / (1.2 * 0.6)
    space = strip(24)
    missed = []
    for thickness in (LENGTH / 8.0, LENGTH / 16.0, LENGTH / 32.0):
        body = block((LENGTH, WIDE, thickness), (24, 1, 2), origin=(0.0, 0.0, -thickness))
        held = Supports(clamped=("bottom",), symmetry=("left", "right", "front", "back"))
        walls = body_wall(Body(body, layer, held, "top", Plane((0.0, 0.0, 1.0))), space, folder=tmp_path).matrix
        soft = Compliance(walls * (modulus / thickness) / STIFFNESS)  # every layer scaled to one stiffness
        missed.append(loads(channel(space, soft)).flow["right"] / WIDE / channel_flow(STIFFNESS) - 1.0)
    assert abs(missed[2]) < 0.5 * abs(missed[1]) < 0.25 * abs(missed[0])
    validation(
        case="Channel on a thin elastic layer",
        source="confined compression",
        quantity="flow per width over Winkler's, t/L = 1/32",
        unit="1",
        expected=1.0,
        obtained=1.0 + missed[2],
        tolerance=abs(missed[1] - missed[2]),
        note="falls at least as t/L; tolerance: what halving the layer still changes",
    )


def _bearing_strip(cells: int) -> tuple[FilmSpace, np.ndarray]:
    """A film that narrows and widens, h = 2 um (1 + 6 (x/L - 1/2)^2)."""
    space = film_space(rectangle((LENGTH, WIDE), (cells, 1), cell=Cell.QUADRILATERAL, periodic_y=True))
    return space, space.sample(lambda x, y: _narrowing(x))


def _narrowing(x: np.ndarray | float) -> np.ndarray | float:
    return 2e-6 * (1.0 + 6.0 * (x / LENGTH - 0.5) ** 2)


def _shoot(stiffness: float, *, ruptures: bool) -> tuple[float, float]:
    """Load and flow per width by shooting: h^3/(12 mu) p' = U h/2 - q, h = rigid + p/k.

    From p = 0 at the inlet with that q which gives p = 0 at the outlet or, for Reynolds' rupture, p = p' = 0.
    """

    def slope(x, y, q):
        h = _narrowing(x) + y[0] / stiffness
        return [(0.5 * 5.0 * h - q) * 12.0 * VISCOSITY / h**3, y[0]]

    def turns(x, y, q):  # p' comes back to zero behind the peak: rupture if p is zero there
        return slope(x, y, q)[0] if ruptures and x > 0.5 * LENGTH else -1.0

    def closes(x, y, q):
        return _narrowing(x) + y[0] / stiffness - 1e-8

    turns.terminal, turns.direction, closes.terminal = True, 1.0, True

    def run(q):
        return solve_ivp(slope, (0.0, LENGTH), [0.0, 0.0], args=(q,), events=(turns, closes), method="LSODA",
                         rtol=1e-11, atol=1e-4, max_step=LENGTH / 400)  # fmt: skip

    narrowest = 0.5 * 5.0 * 2e-6
    q = brentq(lambda q: run(q).y[0, -1], narrowest, 2.5 * narrowest, xtol=1e-18, rtol=1e-13)
    return float(run(q).y[1, -1]), float(q)


# Without cavitation, pressures below zero would close springs as soft as the others.
@pytest.mark.parametrize(
    ("kind", "stiffness"), [(Cavitation.NONE, 2e14), (Cavitation.REYNOLDS, 2e13), (Cavitation.JFO, 2e13)]
)
def test_soft_film_that_ruptures(kind, stiffness, validation, refine):
    """Narrowing and widening film on springs, in one dimension: JFO ruptures where Reynolds' condition does."""

    def solve(cells: int) -> tuple[float, float]:
        space, thickness = _bearing_strip(cells)
        posed = film(thickness, VISCOSITY, velocity_moving=SLIDING)
        ends = {"left": Held(0.0), "right": Held(0.0)}
        found = loads(FilmSolver(space).solve(FilmProblem(space, posed, ends, kind, walls=winkler(space, stiffness))))
        assert found.mass_balance_error < 1e-12
        assert (found.cavitated_area_fraction > 0.05) == (kind is not Cavitation.NONE)
        return found.load / WIDE, -found.flow["left"] / WIDE

    load, flow = _shoot(stiffness, ruptures=kind is not Cavitation.NONE)
    for quantity, expected, column in zip(
        ("load per width, N/m", "flow per width, um2/s"), (load, 1e12 * flow), refine(solve, (64, 128, 256), 2.0),
        strict=True,
    ):  # fmt: skip
        scale = 1.0 if quantity.startswith("load") else 1e12
        tolerance = column.tolerance() if kind is Cavitation.NONE else column.front_tolerance()
        validation(
            case="Film on springs that narrows and widens",
            source="shooting in one dimension",
            quantity=f"{quantity.split(',')[0]}, cavitation {kind.value}",
            unit=quantity.split(", ")[1],
            expected=expected,
            obtained=scale * column.finest,
            tolerance=scale * tolerance,
            order=column.order,
        )


def test_soft_chamber_in_time(validation):
    """A film at one pressure, fed through a leak g (ps - p): A d(h + p/k)/dt = inflow, implicit Euler.

    Every step is (p1 - p0) A/(k dt) + A V = g (ps - p1); without d(p/k)/dt it were p1 = ps - A V/g at once.
    """
    space = film_space(rectangle((LENGTH, WIDE), (2, 1), periodic_y=True), pockets=("left",))
    thin = 1e-13  # Pa s: all of the film is at the pocket's pressure
    area, leak, supply, speed = LENGTH * WIDE, 2e-15, 20e6, -1e-4
    storage = area / STIFFNESS  # m3/Pa
    time_constant = storage / leak

    def problem(t: float) -> FilmProblem:
        fed = Pocket(lambda p: (leak * (supply - p), -leak))
        return FilmProblem(space, film(GAP + speed * t, thin), {"left": fed}, walls=winkler(space, STIFFNESS))

    def pressures(steps: int) -> list[float]:
        instants = march(FilmSolver(space), problem, 2.0 * time_constant, 2.0 * time_constant / steps)
        return [float(instant.solution.pressure.mean()) for instant in instants]

    count = 8
    step, expected = 2.0 * time_constant / count, [0.0]
    for _ in range(count):
        expected.append((expected[-1] * storage / step - area * speed + leak * supply) / (storage / step + leak))
    assert pressures(count) == pytest.approx(expected[1:], rel=1e-8)
    rest = supply - area * speed / leak
    coarse, fine = (pressures(n)[-1] for n in (100, 200))
    validation(
        case="Chamber between soft walls, squeezed",
        source="ordinary differential equation, closed form",
        quantity="pressure after two time constants",
        unit="MPa",
        expected=1e-6 * rest * (1.0 - np.exp(-2.0)),
        obtained=1e-6 * (2.0 * fine - coarse),
        tolerance=1e-6 * abs(fine - coarse) * 0.05,
        note="extrapolated from 100 and 200 steps",
    )


@pytest.mark.parametrize("stiffness", [1e10, None])
def test_squeezed_strip_in_time(stiffness, validation, refine):
    """A strip squeezed at a constant speed from t = 0, deformation small beside h: pressure diffuses,

        (1/k) dp/dt = h^3/(12 mu) p'' + V,  p = parabola - sum over odd n of decaying sines;

    between rigid walls the parabola stands at once.
    """
    speed, gap = 1e-9, 50e-6  # small: p/k stays below 1e-6 of the gap
    conductance = gap**3 / (12.0 * VISCOSITY)
    soft = 1e10 if stiffness is None else stiffness
    diffusivity = conductance * soft
    until = 0.05 * LENGTH**2 / diffusivity
    odd = np.arange(1, 60, 2)
    decay = 1.0 if stiffness is None else 1.0 - np.exp(-diffusivity * (odd * np.pi / LENGTH) ** 2 * until)
    exact = float(np.sum(8.0 * speed * LENGTH**3 / (conductance * (odd * np.pi) ** 4) * decay))

    def solve(n: int) -> float:
        space = strip(n)

        def problem(t: float) -> FilmProblem:
            walls = None if stiffness is None else winkler(space, stiffness)
            ends = {"left": Held(0.0), "right": Held(0.0)}
            return FilmProblem(space, film(gap - speed * t, VISCOSITY), ends, Cavitation.NONE, walls=walls)

        *_, last = march(FilmSolver(space), problem, until, until / n)
        return loads(last.solution).load / WIDE

    found = refine(solve, (16, 32, 64), 1.0 if stiffness else 2.0)
    validation(
        case="Strip between soft walls, squeezed from rest",
        source="diffusion, Fourier series",
        quantity="load per width, " + ("rigid" if stiffness is None else "Winkler walls"),
        unit="N/m",
        expected=exact,
        obtained=found.finest,
        tolerance=found.tolerance() + 1e-5 * exact,
        order=found.order,
        note="cells and steps refined together; 1e-5: what the change of h does to h^3",
    )


def test_energy_between_soft_walls():
    """Flow and wall power is what is dissipated: the walls' own work is stored, in a steady film none."""
    space = film_space(rectangle((LENGTH, LENGTH), (12, 12)))
    thickness = space.sample(lambda x, y: 2e-6 * (2.0 - x / LENGTH))
    ends = dict.fromkeys(("left", "right", "top", "bottom"), Held(0.0))
    posed = film(thickness, VISCOSITY, velocity_moving=SLIDING)
    problem = FilmProblem(space, posed, ends, Cavitation.NONE, walls=winkler(space, STIFFNESS))
    assert loads(FilmSolver(space).solve(problem)).energy_balance_error < 1e-9


def test_errors():
    quadratic = film_space(rectangle((LENGTH, WIDE), (4, 2)), degree=2)
    ends = {"left": Held(HIGH), "right": Held(0.0)}
    # Soft walls alone may carry a quadratic pressure.
    soft = FilmProblem(quadratic, film(GAP, VISCOSITY), ends, Cavitation.NONE, walls=winkler(quadratic, STIFFNESS))
    flow = loads(FilmSolver(quadratic).solve(soft)).flow["right"] / WIDE
    assert flow == pytest.approx(channel_flow(STIFFNESS), rel=2e-2)
    space = strip(8)
    closing = Compliance(-winkler(space, 5e12).matrix)
    with pytest.raises(FilmNotConverged, match=r"elastic walls leave.*Try: a thicker film, stiffer walls"):
        channel(space, closing)
