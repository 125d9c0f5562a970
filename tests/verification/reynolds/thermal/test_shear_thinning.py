"""Film equation: shear-thinning oils.

Parallel plates in closed form, and by quadrature of the stress, which is linear across the film whatever the oil;
an inclined slider by the same quadrature at every place, its flow found from the ends' pressure.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, fsolve

from reynolds import (
    ZERO,
    Barus,
    Carreau,
    Cavitation,
    Cell,
    FilmInputError,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Fluid,
    Held,
    film,
    film_space,
    loads,
    rectangle,
)
from reynolds.laws.rheology import Cross, Eyring
from reynolds.thermal.shear_thinning import newtonian, solve_shear

LENGTH, WIDE, GAP, VISCOSITY, SPEED = 10e-3, 2.5e-3, 1e-5, 0.03, 10.0
SLIDING = (np.full((1, 1), SPEED), ZERO)
CARREAU, CROSS, EYRING = Carreau(0.2, 1e-5, 0.5), Cross(0.3, 1e-6, 0.8), Eyring(5e3)
OILS = pytest.mark.parametrize("law", [CARREAU, CROSS, EYRING], ids=["Carreau", "Cross", "Eyring"])
SEEN = 1e-8  # relative change at which the viscosity is settled


def strip(cells: int, cell: Cell = Cell.QUADRILATERAL) -> FilmSpace:
    return film_space(rectangle((LENGTH, WIDE), (cells, 2), cell=cell, periodic_y=True))


def posed(space: FilmSpace, thickness=GAP, velocity=(ZERO, ZERO), high: float = 0.0) -> FilmProblem:
    return FilmProblem(
        space, film(thickness, VISCOSITY, velocity_moving=velocity), {"left": Held(high), "right": Held(0.0)}
    )


def rate(law, stress):
    """Shear rate (1/s) of a stress (Pa): the law turned round by Newton's method on log(rate)."""
    stress = np.asarray(stress, dtype=float)
    size = np.maximum(np.abs(stress), 1e-9)
    log = np.log(size / VISCOSITY)
    for _ in range(15):
        missed = np.log(law(np.exp(log), VISCOSITY)) + log - np.log(size)
        ahead = np.log(law(np.exp(log + 1e-6), VISCOSITY)) + log + 1e-6 - np.log(size)
        log = log - missed / ((ahead - missed) / 1e-6)
    return np.sign(stress) * np.exp(log)


NODES, WEIGHTS = np.polynomial.legendre.leggauss(30)


def between(law, thickness: float, stress: float, gradient: float) -> tuple[float, float]:
    """Slip (m/s) and flow per width seen from the fixed wall (m2/s) of a stress in mid-film and a gradient.

    Gauss quadrature on both sides of the place without stress, where a law may have a kink.
    """
    middle = np.clip(0.5 - stress / (gradient * thickness) if gradient else 0.0, 0.0, 1.0)
    slip = flow = 0.0
    for low, high in ((0.0, middle), (middle, 1.0)):
        zeta = low + (high - low) * 0.5 * (NODES + 1.0)
        gamma = rate(law, stress + gradient * thickness * (zeta - 0.5))
        share = 0.5 * (high - low) * WEIGHTS
        slip += thickness * float(share @ gamma)
        flow += thickness**2 * float(share @ (gamma * (1.0 - zeta)))
    return slip, flow


@OILS
@pytest.mark.parametrize("cell", list(Cell))
def test_couette(law, cell, validation):
    """Uniform shear: the stress is mu(U/h) U/h on any mesh, with any levels."""
    found = loads(solve_shear(posed(strip(4, cell), velocity=SLIDING), law, count=3).film)
    validation(
        case="Couette flow of a shear-thinning oil",
        source="mu(U/h) U/h, closed form",
        quantity=f"stress on the moving wall, {type(law).__name__}, {cell.value}",
        unit="Pa",
        expected=float(law(SPEED / GAP, VISCOSITY)) * SPEED / GAP,
        obtained=-found.friction_moving[0] / (LENGTH * WIDE),
        relative_tolerance=1e-12,
    )


def test_couette_of_a_power_law(validation):
    """Far above 1/lambda Carreau is mu0 (lambda gamma)^(n-1) to (1 - n)/2 (lambda gamma)^-2."""
    time, n = 1e-3, 0.4
    found = loads(solve_shear(posed(strip(4), velocity=SLIDING), Carreau(0.0, time, n)).film)
    reduced = time * SPEED / GAP
    validation(
        case="Couette flow of a shear-thinning oil",
        source="power law, K gamma^n",
        quantity="stress on the moving wall, Carreau at lambda gamma = 1000",
        unit="Pa",
        expected=VISCOSITY * reduced ** (n - 1.0) * SPEED / GAP,
        obtained=-found.friction_moving[0] / (LENGTH * WIDE),
        relative_tolerance=0.5 * (1.0 - n) / reduced**2 * 1.01 + SEEN,
    )


@pytest.mark.parametrize("high", [2e7, 8e7])
def test_poiseuille_of_ree_and_eyring(high, validation):
    """gamma = (tau0/mu0) sinh(tau/tau0): q = 2 H^2 (tau0/mu0) (cosh a/a - sinh a/a^2), a = G H/tau0, H = h/2."""
    half = GAP / 2.0
    a = high / LENGTH * half / EYRING.stress
    exact = 2.0 * half**2 * EYRING.stress / VISCOSITY * (np.cosh(a) / a - np.sinh(a) / a**2)
    flows = [
        loads(solve_shear(posed(strip(4), high=high), EYRING, count=count).film).flow["right"] / WIDE
        for count in (8, 12)
    ]
    validation(
        case="Poiseuille flow of a shear-thinning oil",
        source="Ree-Eyring's law, closed form",
        quantity=f"flow per width at a wall stress of {a:g} tau0, 12 levels",
        unit="mm2/s",
        expected=exact * 1e6,
        obtained=flows[1] * 1e6,
        tolerance=1e6 * (abs(flows[1] - flows[0]) + 10.0 * SEEN * exact),
        note="tolerance: the step from 8 levels",
    )


def test_levels_converge():
    """Spectral: the error of the Ree-Eyring flow falls by orders with each two levels."""
    high, half = 4e7, GAP / 2.0
    a = high / LENGTH * half / EYRING.stress
    exact = 2.0 * half**2 * EYRING.stress / VISCOSITY * (np.cosh(a) / a - np.sinh(a) / a**2)
    errors = []
    for count in (4, 6, 8, 10):
        found = solve_shear(posed(strip(2), high=high), EYRING, count=count, tolerance=1e-12)
        errors.append(abs(loads(found.film).flow["right"] / WIDE / exact - 1.0))
    assert all(after < 0.1 * before for before, after in pairwise(errors)), errors


@OILS
@pytest.mark.parametrize("high", [1e6, 2e7, -4e6])
def test_couette_and_poiseuille(law, high, validation):
    """Sliding and pressure together: the stress in mid-film that gives the slip, by root finding."""
    gradient = -high / LENGTH
    limit = VISCOSITY * SPEED / GAP + 0.5 * abs(gradient) * GAP
    stress = brentq(lambda s: between(law, GAP, s, gradient)[0] - SPEED, 0.0, 2.0 * limit, xtol=1e-10 * limit)
    exact = (stress + 0.5 * gradient * GAP, between(law, GAP, stress, gradient)[1])
    values = []
    for count in (10, 16):
        problem = replace(posed(strip(4), velocity=SLIDING, high=high), cavitation=Cavitation.NONE)
        found = loads(solve_shear(problem, law, count=count).film)
        values.append((-found.friction_moving[0] / (LENGTH * WIDE), found.flow["right"] / WIDE))
    for k, (quantity, unit) in enumerate((("stress on the moving wall", "Pa"), ("flow per width", "m2/s"))):
        validation(
            case="Couette and Poiseuille flow of a shear-thinning oil",
            source="stress linear across the film: root and Gauss quadrature",
            quantity=f"{quantity}, {type(law).__name__}, {high * 1e-6:g} MPa, 16 levels",
            unit=unit,
            expected=exact[k],
            obtained=values[1][k],
            tolerance=abs(values[1][k] - values[0][k]) + 10.0 * SEEN * abs(exact[k]),
            note="tolerance: the step from 10 levels",
        )


def test_pressure_across_the_sliding(validation):
    """Sliding along y thins the oil that pressure drives along x: the magnitude of both shears counts."""
    high, across = 2e7, (ZERO, np.full((1, 1), SPEED))
    gradient = high / LENGTH

    def fluidity(drag: float, zeta: float) -> float:
        stress = np.hypot(drag, gradient * GAP * (zeta - 0.5))
        return float(rate(EYRING, stress) / stress)

    def slip(drag: float) -> float:
        return 2.0 * GAP * drag * quad(lambda z: fluidity(drag, z), 0.5, 1.0, epsrel=1e-11)[0]

    drag = brentq(lambda s: slip(s) - SPEED, 1.0, VISCOSITY * SPEED / GAP, xtol=1e-9)
    bent, _ = quad(lambda z: fluidity(drag, z) * (z - 0.5) ** 2, 0.5, 1.0, epsrel=1e-11)
    found = loads(solve_shear(posed(strip(4), velocity=across, high=high), EYRING, count=12).film)
    for quantity, unit, expected, obtained in (
        ("flow per width", "mm2/s", 2e6 * gradient * GAP**3 * bent, found.flow["right"] / WIDE * 1e6),
        ("stress along the sliding", "Pa", drag, -found.friction_moving[1] / (LENGTH * WIDE)),
    ):
        validation(
            case="Pressure flow of an Eyring oil across its sliding",
            source="stress linear across the film: root and quadrature",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=obtained,
            relative_tolerance=1e-6,
            note="tolerance: 12 levels, on a smooth profile",
        )


def _slider(law, ratio: float) -> tuple[float, float]:
    """Load and friction per width (N/m) of the wide slider by quadrature across and along."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    places, weights = 0.5 * LENGTH * (nodes + 1.0), 0.5 * LENGTH * weights
    thickness = GAP * (ratio - (ratio - 1.0) * places / LENGTH)
    stiff = VISCOSITY * SPEED / GAP

    def local(flow: float, h: float) -> np.ndarray:
        # From the fixed wall: gamma = du/dz, and the flow is int (h - z) gamma dz.
        def missed(found):
            slip, carried = between(law, h, found[0] * stiff, found[1] * stiff / h)
            return np.array([slip / SPEED - 1.0, (carried - flow) / (SPEED * GAP)])

        return fsolve(missed, np.array([0.2 * GAP / h, 0.3 * (1.0 - 2.0 * flow / (SPEED * h))]), xtol=1e-10)

    def along(flow: float) -> tuple[np.ndarray, np.ndarray]:
        both = np.array([local(flow, h) for h in thickness])
        return both[:, 0] * stiff, both[:, 1] * stiff / thickness

    newton = SPEED * GAP * ratio / (ratio + 1.0)
    flow = brentq(lambda q: weights @ along(q)[1] / (stiff / GAP * LENGTH), 0.8 * newton, 1.25 * newton, rtol=1e-9)
    stress, gradient = along(flow)
    load = -float(weights @ (gradient * places))  # by parts: p vanishes at both ends
    return load, float(weights @ (stress + 0.5 * gradient * thickness))


@pytest.mark.parametrize(("law", "ratio"), [(CARREAU, 3.0), (EYRING, 2.0)], ids=["Carreau", "Eyring"])
def test_wide_slider(law, ratio, validation, refine):
    """The film solves along, the levels across: both against quadrature."""

    def solve(cells: int) -> tuple[float, float]:
        space = strip(cells)
        wedge = space.sample(lambda x, y: GAP * (ratio - (ratio - 1.0) * x / LENGTH))
        found = loads(solve_shear(posed(space, wedge, SLIDING), law, count=12).film)
        return found.load / WIDE, -found.friction_moving[0] / WIDE

    columns = refine(solve, (32, 64, 128))
    for quantity, expected, column in zip(("load", "friction"), _slider(law, ratio), columns, strict=True):
        validation(
            case="Wide slider, shear-thinning oil",
            source="stress linear across the film: roots and Gauss quadrature at each place",
            quantity=f"{quantity} per width, inlet/outlet {ratio:g}, {type(law).__name__}",
            unit="N/m",
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(rounding=1e-6 * expected),
            order=column.order,
            note="12 levels across: 1e-6",
        )


@pytest.mark.parametrize("cavitation", list(Cavitation))
def test_newtonian_oil_is_the_film_itself(cavitation):
    """With pressure law and cavity: the same film to round-off, in the round that sees that nothing changes."""
    space = film_space(rectangle((LENGTH, LENGTH), (12, 6)))
    wedge = space.sample(lambda x, y: GAP * (1.5 + np.cos(2.0 * np.pi * x / LENGTH)))
    oil = film(wedge, VISCOSITY, velocity_moving=SLIDING)
    sides = dict.fromkeys(("left", "right", "bottom", "top"), Held(0.0))
    problem = FilmProblem(space, oil, sides, cavitation, fluid=Fluid(viscosity=Barus(2e-8)))
    plain, found = FilmSolver(space).solve(problem), solve_shear(problem, newtonian)
    assert found.rounds == 1
    assert found.film.pressure == pytest.approx(plain.pressure, rel=1e-9, abs=1e-7 * plain.pressure.max())
    assert found.film.film_fraction == pytest.approx(plain.film_fraction, abs=1e-9)


@OILS
def test_cavity_and_balances(law):
    """A JFO journal of an oil that thins and stiffens under pressure: mass and energy to round-off."""
    space = film_space(rectangle((LENGTH, LENGTH / 2), (32, 6), cell=Cell.QUADRILATERAL))
    thickness = space.sample(lambda x, y: GAP * (1.0 + 0.7 * np.cos(2.0 * np.pi * x / LENGTH)))
    problem = replace(
        posed(space, thickness, SLIDING, 2e5),
        boundary={"left": Held(2e5), "right": Held(2e5), "bottom": Held(0.0), "top": Held(0.0)},
        fluid=Fluid(viscosity=Barus(2e-8)),
    )
    found = solve_shear(problem, law)
    done = loads(found.film)
    assert found.film.cavity.any()
    assert done.mass_balance_error < 1e-9
    assert done.energy_balance_error < 1e-9
    assert done.load < loads(FilmSolver(space).solve(problem)).load
    again = solve_shear(problem, law, start=found)
    assert again.rounds <= 2
    assert loads(again.film).load == pytest.approx(done.load, rel=1e-6)


def test_what_cannot_be_posed():
    problem = posed(strip(4), velocity=SLIDING)
    found = solve_shear(problem, CARREAU, count=4)
    with pytest.raises(FilmInputError, match="same space and levels"):
        solve_shear(problem, CARREAU, count=6, start=found)
    with pytest.raises(FilmInputError, match="viscosity across the film"):
        solve_shear(problem, lambda gamma, mu: mu - gamma)
