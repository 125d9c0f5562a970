"""Hydraulic lock of a tapered piston, held and released.

A film that narrows in the direction of its flow pushes the piston to the middle, one that widens to the wall.
Small motions need one ordinary equation along the film: with the piston moved by e psi(y), pressures change by
f(y) cos(angle),

    (h^3 f')' - h^3/R^2 f = 3 (h^2 p0' psi)' e - 12 mu psi de/dt,    f = 0 at both ends,

here solved by Chebyshev collocation, without finite elements. Of a straight taper one motion is neutral: an
eccentricity in proportion to the film, psi = h, leaves the pressure as it is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import pytest
from scipy.linalg import expm

from gaps import (
    DepthPoints,
    EdgeRelief,
    Effect,
    FilmLaws,
    Physics,
    PistonDrive,
    PistonFilm,
    PistonShape,
    Profile,
    constant,
    floating_piston,
)
from reynolds import (
    ALEXANDER_2,
    Asperities,
    FilmSolver,
    Floating,
    FloatingStage,
    generalised_force,
    integrate,
    loads,
    modes_on,
    nodes_only,
    solve_stage,
    started,
)
from reynolds.numerics.dirk import AcceptedStep

DIAMETER, LENGTH, CLEARANCE, PRESSURE, VISCOSITY, TAPER = 20e-3, 30e-3, 10e-6, 30e6, 0.02, 5e-6
RADIUS = DIAMETER / 2
FULL = Physics().without(Effect.CAVITATION)
DRIVE = PistonDrive(
    shaft_speed=1.0,
    viscosity=VISCOSITY,
    case_pressure=0.0,
    cavitation_pressure=-1e5,
    piston_spin=0.0,
    bore_spin=0.0,
    chamber_pressure=constant(PRESSURE),
    reach=constant(LENGTH),
    velocity=constant(0.0),
    outer=constant(0.0, 0.0, 0.0, 0.0),
)


def _tapered(at_chamber: float, at_case: float) -> PistonShape:
    """A piston with so much taken off (m) at its chamber end and at the case edge."""
    return PistonShape(
        DIAMETER, CLEARANCE, LENGTH, piston=Profile((DepthPoints((0.0, LENGTH), (at_chamber, at_case)),))
    )


TAPERED = _tapered(TAPER, 0.0)
CENTRING, LOCKING = (
    PistonShape(DIAMETER, CLEARANCE, LENGTH, piston=Profile((EdgeRelief(edge, LENGTH - edge, TAPER),)))
    for edge in (0.0, LENGTH)
)  # taken off as a parabola: no motion of these is neutral


@dataclass(frozen=True)
class Beside:
    """Film forces at a position: on the piston at the guide's inner end and case edge (N), and leakage (m3/s)."""

    inner: np.ndarray
    outer: np.ndarray
    leakage: float


def _held(shape: PistonShape, position: np.ndarray, cells: tuple[int, int]) -> Beside:
    film = PistonFilm(shape, DRIVE, physics=FULL, cells=cells)
    problem, modes = film.problem_at(0.0), film.modes_at(0.0)
    opened = problem.film.thickness + problem.space.sample_vertices(modes @ position)
    oil = replace(problem.film, thickness=opened, thickness_at_vertices=None)
    solution = FilmSolver(problem.space).solve(replace(problem, film=oil))
    force = generalised_force(solution.pressure, modes_on(problem.space, modes), 0.0)
    return Beside(force[:2], force[2:], loads(solution).flow["case"])


@pytest.mark.parametrize(
    ("name", "shape", "position", "force", "moment", "leakage"),
    [
        (
            "tapered", TAPERED, 0.5 * CLEARANCE * np.array([1.0, 0.0, 1.0, 0.0]),
            (-582.807, 0.5e-3), (-1.294073, 0.5e-6), (5.95936e-7, 0.5e-12),
        ),
        (
            "tilted", _tapered(0.0, 0.0), 0.5 * CLEARANCE * np.array([-1.0, 0.0, 1.0, 0.0]),
            (-3722.951, 0.5e-3), (0.0, 0.0), (2.447253e-7, 0.5e-13),
        ),
    ],
)  # fmt: skip
def test_held_piston(name, shape, position, force, moment, leakage, validation, refine):
    """Generalised forces at both ends add up to the side force, their difference to the moment."""

    def solve(n: int) -> tuple[float, float, float]:
        found = _held(shape, position, (2 * n, n))
        assert np.abs([found.inner[1], found.outer[1]]).max() < 1e-9 * abs(force[0])
        side, lever = found.inner[0] + found.outer[0], 0.5 * LENGTH
        return float(side), float(lever * (found.outer[0] - found.inner[0])), found.leakage

    found = refine(solve, (16, 32, 64))
    for (quantity, unit, (expected, rounding)), column in zip(
        (("side force", "N", force), ("moment about mid-length", "N m", moment), ("leakage", "m3/s", leakage)),
        found,
        strict=True,
    ):
        if expected == 0.0:
            assert abs(column.finest) < 1e-9 * abs(force[0]) * LENGTH
            continue
        validation(
            case="Hydraulic lock, piston held",
            source="own converged solution",
            quantity=f"{quantity}, {name}, by generalised forces",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(rounding),
            order=column.order,
        )


def _growth(shape: PistonShape) -> np.ndarray:
    """A (2, 2) 1/s of dq/dt = A q for small eccentricities at both ends of a piston in the middle."""
    points = 32
    y, d, integral = _collocation(points)
    h = CLEARANCE + shape.piston(y, np.zeros_like(y)).depth
    fall = -PRESSURE / float(integral @ h**-3) * h**-3  # p0' of a flow without divergence
    operator = d @ np.diag(h**3) @ d - np.diag(h**3) / RADIUS**2
    operator[[0, -1]] = np.eye(points + 1)[[0, -1]]
    modes = 1.0 - y / LENGTH, y / LENGTH
    stiffness, damping = np.empty((2, 2)), np.empty((2, 2))
    for j, psi in enumerate(modes):
        for matrix, source in ((stiffness, 3.0 * d @ (h**2 * fall * psi)), (damping, -12.0 * VISCOSITY * psi)):
            source[[0, -1]] = 0.0
            f = np.linalg.solve(operator, source)
            matrix[:, j] = [-np.pi * RADIUS * float(integral @ (f * phi)) for phi in modes]
    return -np.linalg.solve(damping, stiffness)


def _collocation(points: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Chebyshev points on [0, LENGTH], differentiation matrix (Trefethen 2000) and weights of the integral."""
    y = np.cos(np.pi * np.arange(points + 1) / points)
    c = np.where((np.arange(points + 1) % points) == 0, 2.0, 1.0) * (-1.0) ** np.arange(points + 1)
    d = np.outer(c, 1.0 / c) / (y[:, None] - y[None, :] + np.eye(points + 1))
    d -= np.diag(d.sum(axis=1))
    k = np.arange(points + 1)
    of_series = np.where(k % 2 == 0, 2.0 / (1.0 - np.where(k % 2 == 0, k, 0) ** 2), 0.0)
    integral = of_series @ np.linalg.inv(np.polynomial.chebyshev.chebvander(y, points))
    return 0.5 * LENGTH * (1.0 + y), 2.0 / LENGTH * d, 0.5 * LENGTH * integral


def _first_step(floating: Floating, step: float) -> FloatingStage:
    """One step of the piston let go in the middle."""
    start = started(floating, 0.0, np.zeros(4))
    solver = FilmSolver(floating.shape_at(0.0).space)
    return solve_stage(solver, floating, step, start.held, step, start.q, None)


def _film_growth(shape: PistonShape, n: int) -> np.ndarray:
    """The same by stiffness K and damping C of the finite elements: exact slopes of two steps are K - C/step."""
    floating = floating_piston(PistonFilm(shape, DRIVE, physics=FULL, cells=(2 * n, n)))
    long, short = 1e-2, 1e-4
    slow, fast = (_first_step(floating, step).force_slopes[::2, ::2] for step in (long, short))
    damping = (slow - fast) / (1.0 / short - 1.0 / long)
    return np.linalg.solve(damping, slow + damping / long)


def _pair(growth: np.ndarray) -> tuple[float, float]:
    """Growth (1/s) and angular frequency (rad/s) of two conjugate motions: both ends take turns."""
    one = np.linalg.eigvals(growth)[0]
    assert one.imag != 0.0
    return float(one.real), float(abs(one.imag))


@pytest.mark.parametrize(("name", "shape"), [("centring", CENTRING), ("locking", LOCKING)])
def test_rates_of_small_motions(name, shape, validation, refine):
    exact = _pair(_growth(shape))
    found = refine(lambda n: _pair(_film_growth(shape, n)), (12, 24, 48))
    for quantity, expected, column in zip(("rate of growth", "angular frequency"), exact, found, strict=True):
        validation(
            case="Hydraulic lock, small motions about the middle",
            source="ordinary equation along the film, by collocation",
            quantity=f"{quantity}, {name} parabola",
            unit="1/s",
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(),
            order=column.order,
        )
    assert (exact[0] > 0.0) == (name == "locking")


def _let_go(shape: PistonShape, laws: FilmLaws, at: float, times: np.ndarray) -> list[AcceptedStep[FloatingStage]]:
    """The way of a piston let go at an eccentricity (m) parallel to its bore."""
    floating = floating_piston(PistonFilm(shape, DRIVE, laws, FULL, (24, 12)))
    start = started(floating, 0.0, at * np.array([1.0, 0.0, 1.0, 0.0]))
    solve = partial(solve_stage, FilmSolver(floating.shape_at(0.0).space), floating)
    return list(integrate(ALEXANDER_2, solve, start, times[1:], nodes_only))


def test_released_piston_floats_back(validation):
    """Let go at 0.3 of the clearance it finds the middle, at last as small motions do."""
    growth = _film_growth(CENTRING, 12)
    decay, turn = _pair(growth)
    times = np.linspace(0.0, 7.0, 141) / -decay
    way = np.array([taken.state.q for taken in _let_go(CENTRING, FilmLaws(), 0.3 * CLEARANCE, times)])
    assert np.abs(way[:, 1::2]).max() < 1e-9 * CLEARANCE
    early, late = (np.abs(part).max() for part in (way[:20], way[-20:]))
    assert late < 1e-2 * early
    span, back = times[1] - times[0], 20
    expected = expm(growth * span * back) @ way[-1 - back, ::2]
    size = float(np.abs(way[-1 - back]).max())
    for end, (alone, obtained) in enumerate(zip(expected, way[-1, ::2], strict=True)):
        validation(
            case="Hydraulic lock released",
            source="small motions on the same mesh, by the matrix exponential",
            quantity=f"eccentricity at end {end} of the guide over the largest a time of decay before",
            unit="1",
            expected=float(alone) / size,
            obtained=float(obtained) / size,
            # Each step of second order: (step |rate|)^3 times a constant below 1/6, and as many steps.
            tolerance=back * (span * float(np.hypot(decay, turn))) ** 3 / 6.0,
        )


def test_straight_taper_comes_to_rest_on_its_neutral_line(validation):
    """e in proportion to the film, 15 to 10 um, whatever of it is left."""
    neutral, fast = sorted(np.abs(np.linalg.eigvals(_film_growth(TAPERED, 12))))
    assert neutral < 1e-9 * fast
    times = np.linspace(0.0, 20.0, 41) / fast
    last = _let_go(TAPERED, FilmLaws(), 0.3 * CLEARANCE, times)[-1].state.q
    validation(
        case="Hydraulic lock released",
        source="closed form: h (1 - eps cos) leaves the pressure as it is",
        quantity="eccentricity at the wide end over that at the narrow one, straight taper",
        unit="1",
        expected=(CLEARANCE + TAPER) / CLEARANCE,
        obtained=float(last[0] / last[2]),
        tolerance=1e-5,
        note="after 20 times of its other motion",
    )


def test_locked_piston_comes_to_its_asperities():
    """With its taper turned round the piston runs to the wall, and the asperities bear what the film presses."""
    rough = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)
    way = _let_go(_tapered(0.0, TAPER), FilmLaws(asperities=rough), 0.1 * CLEARANCE, np.linspace(0.0, 0.45, 46))
    gaps = np.array([taken.stage.least_gap for taken in way])
    assert (np.diff(gaps) < 0.0).all()
    last = way[-1].stage
    assert gaps[-1] < 2.0 * rough.height
    pushed = last.contact_force[0] + last.contact_force[2]
    assert pushed < -10.0
    assert last.film_force[0] + last.film_force[2] == pytest.approx(-pushed, rel=1e-6)
