"""Floating films: squeezed and hydrostatic, in closed form.

A disc or a ring that sinks under a load, a slipper that its pocket lifts: the position follows from the balance of
forces at each instant.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
import skfem
from scipy.optimize import brentq

from reynolds import (
    ALEXANDER_2,
    BACKWARD_EULER,
    ZERO,
    Asperities,
    Boundary,
    Cell,
    Film,
    FilmInputError,
    FilmMesh,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Floating,
    FloatingStage,
    Held,
    Outer,
    Pocket,
    Tableau,
    advance,
    annulus,
    contact_pressure,
    film,
    film_space,
    full_film,
    generalised_force,
    modes_on,
    rectangle,
    solve_stage,
    started,
    steady,
)
from reynolds.fem.mesh import loop_names

VISCOSITY, LOAD, START, END = 0.03, 100.0, 20e-6, 10e-3
OUTER, INNER = 10e-3, 5e-3
SOURCE = "closed form, integrated in time"


def _film(space: FilmSpace, held: dict[str, Boundary], asperities: Asperities | None = None) -> FilmProblem:
    """The flat film at position zero."""
    oil = Film(ZERO, np.full((1, 1), VISCOSITY), (ZERO, ZERO), (ZERO, ZERO), ZERO)
    return FilmProblem(space, oil, held, asperities=asperities)


def _sinking(
    problem: FilmProblem, outer: Outer | None = None, pockets: dict | None = None, inertia: np.ndarray | None = None
) -> Floating:
    """A flat wall that may only approach, under LOAD if nothing else is given."""
    pressed = steady(np.array([-LOAD])) if outer is None else outer
    up = np.ones((len(problem.space.vertices), 1))
    return Floating("wall", lambda t: problem, lambda t: up, lambda t, q, rate: pressed, 0.0, pockets or {}, inertia)


def _position(floating: Floating, tableau: Tableau, steps: int) -> float:
    """Position (m) after END in equal steps."""
    solve = partial(solve_stage, FilmSolver(floating.shape_at(0.0).space), floating)
    state = started(floating, 0.0, np.array([START]))
    for _ in range(steps):
        state = advance(tableau, solve, state, END / steps).state
    return float(state.q[0])


def _falls(resistance: float, time: float) -> float:
    """Position (m) at a time under a film force resistance V/h^3: 1/h^2 grows by 2 LOAD t/resistance."""
    return float((START**-2 + 2.0 * LOAD * time / resistance) ** -0.5)


def _ring(n: int) -> FilmSpace:
    return film_space(annulus(INNER, OUTER, (n, 6 * n)))


def _slipper(n: int) -> FilmSpace:
    return film_space(annulus(INNER, OUTER, (n, 6 * n)), pockets=("inner",))


def _disc(n: int) -> FilmSpace:
    mesh = skfem.MeshTri.init_circle(int(np.log2(n))).scaled(OUTER)
    return film_space(FilmMesh(mesh.with_boundaries(loop_names(mesh))))


def _strip(cells: int = 8) -> FilmSpace:
    return film_space(rectangle((0.02, 0.005), (cells, 2), cell=Cell.QUADRILATERAL, periodic_y=True))


SHORE: dict[str, Boundary] = {"left": Held(0.0), "right": Held(0.0)}


def _resistance(space: FilmSpace, held: dict[str, Boundary]) -> float:
    """Force h^3/V of the film as this mesh has it: time alone is then tested against the closed form."""
    posed = film(1e-5, VISCOSITY, squeeze=np.full((1, 1), -1.0))
    up = modes_on(space, np.ones((len(space.vertices), 1)))
    pressure = FilmSolver(space).solve(FilmProblem(space, posed, held)).pressure
    return float(generalised_force(pressure, up, 0.0)[0]) * 1e-15


DISC = 1.5 * np.pi * VISCOSITY * OUTER**4
SHARE = INNER / OUTER
RING = DISC * (1.0 - SHARE**4 + (1.0 - SHARE**2) ** 2 / np.log(SHARE))


@pytest.mark.parametrize("shape", ["disc", "annulus"])
def test_sinking(shape, validation, refine):
    """Mesh and steps refined together, both of second order."""

    def solve(n: int) -> float:
        space = _disc(n) if shape == "disc" else _ring(n // 2)
        held: dict[str, Boundary] = {"outer": Held(0.0), "inner": Held(0.0)}
        problem = _film(space, {name: held[name] for name in space.edge_dofs})
        return _position(_sinking(problem), ALEXANDER_2, n)

    found = refine(solve, (8, 16, 32))
    expected = _falls(DISC if shape == "disc" else RING, END)
    if shape == "disc":
        assert expected == pytest.approx(15.98270e-6, abs=0.5e-11)
    validation(
        case="Film squeezed out by a load",
        source=SOURCE,
        quantity=f"thickness of the {shape} after 10 ms",
        unit="m",
        expected=expected,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize(("tableau", "order"), [(BACKWARD_EULER, 1.0), (ALEXANDER_2, 2.0)])
def test_order_in_time(tableau, order, validation, refine):
    space = _strip()
    floating = _sinking(_film(space, SHORE))
    found = refine(lambda n: _position(floating, tableau, n), (10, 20, 40), order)
    validation(
        case="Film squeezed out by a load, steps alone",
        source="closed form, with the mesh's own film force",
        quantity=f"thickness of a strip after 10 ms, {tableau.order}. order",
        unit="m",
        expected=_falls(_resistance(space, SHORE), END),
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("step", [1e-4, 1e-2, 1.0, 100.0])
def test_one_implicit_step(step):
    """c (h0 - h)/step = W h^3: however long the step, from a guess that leaves no film and one far away."""
    space = _strip()
    floating, solver = _sinking(_film(space, SHORE)), FilmSolver(space)
    c = _resistance(space, SHORE)
    expected = brentq(lambda h: c * (START - h) / step - LOAD * h**3, 1e-9, START, xtol=1e-18)
    before = full_film(floating, 0.0, np.array([START]))
    for guess in (START, -1e-6, 10.0 * START):
        stage = solve_stage(solver, floating, step, before, step, np.array([guess]), None)
        assert stage.q[0] == pytest.approx(expected, rel=1e-7)
        assert stage.film_force[0] == pytest.approx(LOAD, rel=1e-7)


def test_step_with_inertia():
    """m (v - v0)/step = c (h0 - h)/(step h^3) - W with v = (h - h0)/step."""
    space, step, mass, speed = _strip(), 1e-3, 5.0, -0.01
    floating = _sinking(_film(space, SHORE), inertia=np.array([[mass]]))
    c = _resistance(space, SHORE)

    def rest(h: float) -> float:
        rate = (h - START) / step
        return -c * rate / h**3 - LOAD - mass * (rate - speed) / step

    before = full_film(floating, 0.0, np.array([START]), np.array([speed]))
    stage = solve_stage(FilmSolver(space), floating, step, before, step, np.array([START]), None)
    assert stage.q[0] == pytest.approx(brentq(rest, 1e-7, START, xtol=1e-18), rel=1e-7)
    assert stage.holds[-1] == pytest.approx((stage.q[0] - START) / step)


ROUGH = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)


@pytest.mark.parametrize("load", [1e2, 1e4])
def test_comes_to_rest_on_its_roughness(load):
    """A step so long that no oil is left to move: the asperities alone bear the load, the mean planes overlap."""
    space = _strip()
    floating = _sinking(_film(space, SHORE, ROUGH), steady(np.array([-load])))
    area = 0.02 * 0.005
    expected = brentq(lambda gap: float(contact_pressure(ROUGH, gap).value) * area - load, -2e-6, 4e-6, xtol=1e-15)
    before = full_film(floating, 0.0, np.array([START]))
    stage = solve_stage(FilmSolver(space), floating, 1e12, before, 1e12, np.array([START]), None)
    assert (expected < 0.0) == (load == 1e4)
    assert stage.q[0] == pytest.approx(expected, abs=1e-6 * ROUGH.height)
    assert stage.contact_force[0] == pytest.approx(load, rel=1e-6)
    assert stage.solution.film.thickness.min() > 0.0


SUPPLY, BALANCE, ORIFICE = 20e6, 1.2, 1e-13  # Pa, lift at supply pressure over load, m3/(s Pa)
LOG = np.log(OUTER / INNER)
CARRIED = np.pi * SUPPLY * (OUTER**2 - INNER**2) / (2.0 * LOG) / BALANCE
POCKET = SUPPLY / BALANCE


def _hydrostatic_film() -> float:
    return float((6.0 * VISCOSITY * LOG * ORIFICE * (SUPPLY - POCKET) / (np.pi * POCKET)) ** (1.0 / 3.0))


def _hydrostatic_rate(h: float) -> float:
    """Rate k/c (1/s) at which a disturbance dies: stiffness by supply and land, damping by land and pocket."""
    stiffness = 3.0 * CARRIED / h * (1.0 - POCKET / SUPPLY)
    effective = np.pi * (OUTER**2 - INNER**2) / (2.0 * LOG)
    land = np.pi * h**3 / (6.0 * VISCOSITY * LOG)
    return float(stiffness / (RING / h**3 + effective**2 / (ORIFICE + land)))


def _lifted(n: int, step: float) -> FloatingStage:
    """The slipper after a step, from the film at which it is in balance."""
    space = _slipper(n)
    fed: dict[str, Boundary] = {
        "inner": Pocket(lambda p: (ORIFICE * (SUPPLY - p), -ORIFICE)), "outer": Held(0.0)
    }  # fmt: skip
    pockets = {"inner": np.array([np.pi * INNER**2])}
    floating = _sinking(_film(space, fed), steady(np.array([-CARRIED])), pockets)
    at = np.array([_hydrostatic_film()])
    return solve_stage(FilmSolver(space), floating, step, full_film(floating, 0.0, at), step, at, None)


def test_hydrostatic_slipper(validation, refine):
    """Balance 1.2: the film that a capillary and the land make, and how fast the slipper comes back to it."""

    def solve(n: int) -> tuple[float, float]:
        rest = _lifted(n, 1e6)
        before = np.zeros((len(rest.holds), 1))
        before[:-1, 0], before[-1, 0] = rest.solution.problem.space.share, 1.0  # a full film lifted by one metre
        before[rest.solution.problem.space.edge_dofs["inner"], 0] += np.pi * INNER**2
        step = 1.0 / _hydrostatic_rate(_hydrostatic_film())
        left = float(_lifted(n, step).propagated(before)[0][0, 0])  # 1/(1 + rate step) of a disturbance
        return float(rest.q[0]), (1.0 / left - 1.0) / step

    lift, rate = refine(solve, (8, 16, 32))
    for quantity, unit, expected, found in (
        ("film thickness", "m", _hydrostatic_film(), lift),
        ("rate at which a disturbance dies", "1/s", _hydrostatic_rate(_hydrostatic_film()), rate),
    ):
        validation(
            case="Hydrostatic slipper of balance 1.2",
            source="closed form",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(),
            order=found.order,
        )


def test_nothing_to_float_on():
    """A wall pulled off by more than a film can hold has no position; the error names part and time."""
    floating = _sinking(_film(_strip(), SHORE), steady(np.array([1.0])))
    before = full_film(floating, 0.0, np.array([START]))
    solver = FilmSolver(floating.shape_at(0.0).space)
    with pytest.raises(FilmNotConverged, match=r"wall at 0\.001 s"):
        solve_stage(solver, floating, 1e-3, before, 1e-3, np.array([START]), None)


def test_walls_that_overlap_at_the_start():
    with pytest.raises(FilmInputError, match="wall at 0 s: a least gap of -1e-06 m; expected walls apart"):
        full_film(_sinking(_film(_strip(), SHORE)), 0.0, np.array([-1e-6]))


def test_smooth_walls_that_touch():
    """A step after which a film of some molecules would be left names that, and what would bear the load."""
    floating = _sinking(_film(_strip(), SHORE))
    before = full_film(floating, 0.0, np.array([START]))
    solver = FilmSolver(floating.shape_at(0.0).space)
    with pytest.raises(FilmNotConverged, match=r"walls that touch: least gap 1.*asperities"):
        solve_stage(solver, floating, 1e13, before, 1e13, np.array([START]), None)
