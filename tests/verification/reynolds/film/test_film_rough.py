"""Film equation: rough walls.

The average flow of Patir and Cheng 1978, 1979: parallel films in closed form, a slider by quadrature, ridges at an
angle, squeeze, and the Stribeck curve. The factors are written out here once more, for Peklenik numbers 1/3, 1, 3.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.stats import norm

from reynolds import (
    ZERO,
    Asperities,
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Loads,
    Surface,
    film,
    film_space,
    loads,
    march,
    rectangle,
)

LENGTH, WIDE, VISCOSITY, SPEED = 10e-3, 2.5e-3, 0.03, 2.0
SIGMA = 0.5e-6
MOVING = (np.full((1, 1), SPEED), ZERO)
GAMMAS = [1.0 / 3.0, 1.0, 3.0]


def phi_x(ratio, gamma):
    if gamma == 3.0:
        return 1.0 + 0.225 * ratio**-1.5
    c, r = {1.0 / 3.0: (1.18, 0.42), 1.0: (0.90, 0.56)}[gamma]
    return 1.0 - c * np.exp(-r * ratio)


def phi_s(ratio, gamma):
    a1, p1, p2, p3, a2 = {
        1.0 / 3.0: (1.858, 1.01, 0.76, 0.03, 1.561),
        1.0: (1.899, 0.98, 0.92, 0.05, 1.126),
        3.0: (1.560, 0.85, 1.13, 0.08, 0.556),
    }[gamma]
    near = a1 * ratio**p1 * np.exp(-p2 * ratio + p3 * ratio**2)
    return np.where(ratio <= 5.0, near, a2 * np.exp(-0.25 * ratio))


def phi_fs(ratio, gamma):
    a3, p4, p5, p6 = {1.0 / 3.0: (12.3, 2.32, 2.30, 0.10), 1.0: (11.1, 2.31, 2.38, 0.11), 3.0: (9.8, 2.25, 2.80, 0.18)}[
        gamma
    ]
    return a3 * ratio**p4 * np.exp(-p5 * ratio + p6 * ratio**2) if ratio < 7.0 else 0.0


def phi_fp(ratio, gamma):
    d, s = {1.0 / 3.0: (1.47, 0.58), 1.0: (1.40, 0.66), 3.0: (0.98, 0.79)}[gamma]
    return 1.0 - d * np.exp(-s * ratio)


def phi_f(ratio):
    """h E[1/hT] by quadrature: heights of density 35/32 (1 - s^2)^3 on +-3 sigma, hT above sigma/100.

    As published, the limit sigma/100 stays in the logarithm alone, which would grow without bound.
    """
    z = ratio / 3.0
    if z > 1.0:
        return 35.0 / 32.0 * z * quad(lambda s: (1.0 - s**2) ** 3 / (z + s), -1.0, 1.0, epsrel=1e-12)[0]
    middle = (1.0 - z**2) ** 3
    rest, _ = quad(lambda t: ((1.0 - (t - z) ** 2) ** 3 - middle) / t, 0.0, 1.0 + z, epsrel=1e-12)
    return 35.0 / 32.0 * z * (rest + middle * np.log(300.0 * (1.0 + z)))


def content(ratio):
    return SIGMA * (ratio * norm.cdf(ratio) + norm.pdf(ratio))


def walls(gamma: float, *, share: float = 1.0, lay: float = 0.0) -> Surface:
    """Of composite roughness SIGMA, `share` of the variance on the moving wall."""
    return Surface(SIGMA * np.sqrt(share), SIGMA * np.sqrt(1.0 - share), gamma, gamma, lay)


def strip(cells: int, cell: Cell = Cell.QUADRILATERAL) -> FilmSpace:
    return film_space(rectangle((LENGTH, WIDE), (cells, 2), cell=cell, periodic_y=True))


def channel(surface: Surface, ratio: float, high: float, velocity=(ZERO, ZERO)) -> Loads:
    space = strip(4, Cell.TRIANGLE)
    ends = {"left": Held(high), "right": Held(0.0)}
    posed = film(ratio * SIGMA, VISCOSITY, velocity_moving=velocity)
    return loads(FilmSolver(space).solve(FilmProblem(space, posed, ends, Cavitation.NONE, surface=surface)))


@pytest.mark.parametrize("gamma", GAMMAS)
@pytest.mark.parametrize("ratio", [1.0, 3.0, 6.0])
def test_parallel_film(gamma, ratio, validation):
    """Pressure flow phi_x h^3 p/(12 mu L), sliding flow U/2 (hT + sigma phi_s), each alone."""
    h = ratio * SIGMA
    pressed = channel(walls(gamma), ratio, 1e6).flow["right"] / WIDE
    slid = channel(walls(gamma), ratio, 0.0, MOVING).flow["right"] / WIDE
    across = channel(walls(gamma, lay=np.pi / 2.0), ratio, 1e6).flow["right"] / WIDE
    smooth = h**3 * 1e6 / (12.0 * VISCOSITY * LENGTH)
    for quantity, expected, obtained in (
        ("pressure flow over the smooth one", phi_x(ratio, gamma), pressed / smooth),
        ("the same across the lay", phi_x(ratio, {1 / 3: 3.0, 1.0: 1.0, 3.0: 1 / 3}[gamma]), across / smooth),
        ("sliding flow/(U h)", 0.5 * (content(ratio) + SIGMA * phi_s(ratio, gamma)) / h, slid / (SPEED * h)),
    ):
        validation(
            case="Parallel film between rough walls",
            source="Patir and Cheng 1978, 1979",
            quantity=f"{quantity}, h/sigma = {ratio:g}, gamma = {gamma:.3g}",
            unit="1",
            expected=float(expected),
            obtained=obtained,
            relative_tolerance=1e-12,
            note="exact on any mesh",
        )


@pytest.mark.parametrize("share", [1.0, 0.7, 0.5, 0.0])
def test_only_a_difference_of_roughness_carries(share):
    """Shear flow U sigma (V1 - V2) Phi_s/2: a moving rough wall carries more oil, a fixed one holds it back."""
    ratio = 2.0
    flow = channel(walls(1.0, share=share), ratio, 0.0, MOVING).flow["right"] / WIDE
    extra = (2.0 * share - 1.0) * SIGMA * phi_s(ratio, 1.0)
    assert flow == pytest.approx(0.5 * SPEED * (content(ratio) + extra), rel=1e-12)


@pytest.mark.parametrize("gamma", GAMMAS)
@pytest.mark.parametrize("ratio", [1.0, 2.0, 4.0])
def test_friction_of_a_parallel_film(gamma, ratio):
    """mu U/h (phi_f -+ phi_fs (V1 - V2)) and phi_fp h/2 dp/dx on the walls, against the factors by quadrature."""
    share, high = 0.8, 2e6
    found = channel(walls(gamma, share=share), ratio, high, MOVING)
    h, area = ratio * SIGMA, LENGTH * WIDE
    drag, pull = VISCOSITY * SPEED / h * area, 0.5 * h * high / LENGTH * phi_fp(ratio, gamma) * area
    sliding = (2.0 * share - 1.0) * phi_fs(ratio, gamma)
    assert found.friction_moving[0] == pytest.approx(pull - drag * (phi_f(ratio) - sliding), rel=1e-8)
    assert found.friction_fixed[0] == pytest.approx(pull + drag * (phi_f(ratio) + sliding), rel=1e-8)


def _slider_by_quadrature(surface_gamma: float, share: float, ratio: float) -> tuple[float, float]:
    """Load and flow per width of a slider h = (2 - x/L) h0.

    p' = 12 mu/(phi_x h^3) (U/2 (hT + sigma phi_s) - q).
    """
    x, weight = np.polynomial.legendre.leggauss(120)
    # Phi_s changes its formula at h = 5 sigma: no interval may cross that.
    cut = float(np.clip(2.0 - 5.0 / ratio, 0.0, 1.0))
    x = np.concatenate([0.5 * cut * (x + 1.0), cut + 0.5 * (1.0 - cut) * (x + 1.0)])
    weight = np.concatenate([0.5 * cut * weight, 0.5 * (1.0 - cut) * weight])
    at = ratio * (2.0 - x)
    resists = 12.0 * VISCOSITY / (phi_x(at, surface_gamma) * (at * SIGMA) ** 3)
    carried = 0.5 * SPEED * (content(at) + (2.0 * share - 1.0) * SIGMA * phi_s(at, surface_gamma))
    flow = np.sum(weight * resists * carried) / np.sum(weight * resists)
    # Load = integral of p = - integral of x p' since p vanishes at both ends.
    return float(-np.sum(weight * x * resists * (carried - flow)) * LENGTH**2), float(flow)


@pytest.mark.parametrize("gamma", GAMMAS)
@pytest.mark.parametrize(("share", "ratio"), [(1.0, 1.2), (0.0, 3.0), (0.5, 1.2)])
def test_rough_slider(gamma, share, ratio, validation, refine):
    def solve(cells: int) -> tuple[float, float]:
        space = strip(cells)
        posed = film(space.sample(lambda x, y: ratio * SIGMA * (2.0 - x / LENGTH)), VISCOSITY, velocity_moving=MOVING)
        ends = {"left": Held(0.0), "right": Held(0.0)}
        found = loads(FilmSolver(space).solve(FilmProblem(space, posed, ends, surface=walls(gamma, share=share))))
        return found.load / WIDE, 1e6 * found.flow["right"] / WIDE

    load, flow = _slider_by_quadrature(gamma, share, ratio)
    names = ("load per width, N/m", "flow per width, mm2/s")
    for name, expected, column in zip(names, (load, 1e6 * flow), refine(solve, (32, 64, 128)), strict=True):
        quantity, unit = name.split(", ")
        validation(
            case="Rough slider, h1/h0 = 2",
            source="quadrature with Patir and Cheng's factors",
            quantity=f"{quantity}, h0/sigma = {ratio:g}, gamma = {gamma:.3g}, {share:g} of it moving",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(),
            order=column.order,
        )


def _pad(turn: float, lay: float, cavitation: Cavitation) -> FilmSolution:
    """A pad sliding along its own x, its mesh, motion and lay turned together."""
    space = film_space(rectangle((LENGTH, LENGTH), (8, 8), cell=Cell.QUADRILATERAL))
    flat = space.vertices
    space = space.moved(flat @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]))
    thickness = space.sample_vertices(SIGMA * (2.0 + 8.0 * (flat[:, 0] / LENGTH - 0.6) ** 2))
    velocity = (np.full((1, 1), SPEED * np.cos(turn)), np.full((1, 1), SPEED * np.sin(turn)))
    ends = dict.fromkeys(("left", "right", "top", "bottom"), Held(0.0))
    posed = film(thickness, VISCOSITY, velocity_moving=velocity)
    surface = walls(3.0, share=0.8, lay=lay + turn)
    return FilmSolver(space).solve(FilmProblem(space, posed, ends, cavitation, surface=surface))


@pytest.mark.parametrize("cavitation", [Cavitation.NONE, Cavitation.JFO])
def test_ridges_at_an_angle(cavitation):
    """Turning film and ridges together changes nothing; turning the ridges alone does."""
    lay = 0.7
    straight = _pad(0.0, lay, cavitation)
    for turn in (0.5, 2.0):
        turned = _pad(turn, lay, cavitation)
        assert turned.pressure == pytest.approx(straight.pressure, rel=1e-8, abs=1e-8 * straight.pressure.max())
        assert turned.film_fraction == pytest.approx(straight.film_fraction, abs=1e-8)
        one, other = loads(straight), loads(turned)
        assert np.hypot(*other.friction_moving) == pytest.approx(np.hypot(*one.friction_moving), rel=1e-10)
    assert loads(straight).mass_balance_error < 1e-12
    across = loads(_pad(0.0, lay + np.pi / 2.0, cavitation))
    assert abs(across.load / loads(straight).load - 1.0) > 0.01
    mirrored = _pad(0.0, -lay, cavitation)
    assert loads(mirrored).load == pytest.approx(loads(straight).load, rel=1e-8)


def test_ridges_lead_the_oil_aside(validation):
    """A wide film with ridges at an angle: q_x = (phi_x cos^2 + phi_y sin^2), what leads aside passes the seam."""
    lay, ratio = 0.5, 1.5
    along, across = phi_x(ratio, 3.0), phi_x(ratio, 1.0 / 3.0)
    flow = channel(walls(3.0, lay=lay), ratio, 1e6).flow["right"] / WIDE
    validation(
        case="Parallel film between rough walls",
        source="Patir and Cheng 1978, turned as a tensor",
        quantity="pressure flow over the smooth one, gamma = 3, lay at 0.5 rad, h/sigma = 1.5",
        unit="1",
        expected=along * np.cos(lay) ** 2 + across * np.sin(lay) ** 2,
        obtained=flow * 12.0 * VISCOSITY * LENGTH / (1e6 * (ratio * SIGMA) ** 3),
        relative_tolerance=1e-12,
    )


@pytest.mark.parametrize("ratio", [1.0, 2.5])
def test_squeeze_moves_the_mean_content(ratio, validation):
    """Walls that approach displace N(h/sigma) V, not V: load phi_c mu V L^3/(phi_x h^3) per width."""
    space, speed = strip(40), -1e-3
    posed = film(ratio * SIGMA, VISCOSITY, squeeze=np.full((1, 1), speed))
    ends = {"left": Held(0.0), "right": Held(0.0)}
    found = loads(FilmSolver(space).solve(FilmProblem(space, posed, ends, surface=walls(1.0))))
    assert found.squeeze_flow == pytest.approx(norm.cdf(ratio) * speed * LENGTH * WIDE, rel=1e-12)
    exact = norm.cdf(ratio) * VISCOSITY * -speed * LENGTH**3 / (phi_x(ratio, 1.0) * (ratio * SIGMA) ** 3)
    validation(
        case="Rough strip squeezed",
        source="closed form with Patir and Cheng's factors",
        quantity=f"load per width, h/sigma = {ratio:g}",
        unit="N/m",
        expected=exact,
        obtained=found.load / WIDE,
        relative_tolerance=1.001 / 40.0**2,
        note="pressure exact at the nodes, trapezium rule between: 1/n^2",
    )


def test_squeeze_in_time_keeps_every_drop():
    """Over a step the film loses hT(t) - hT(t + dt), whatever the step."""
    space = strip(6)

    def problem(t: float) -> FilmProblem:
        posed = film(SIGMA * (3.0 - 2.0 * t), VISCOSITY)
        return FilmProblem(space, posed, {"left": Held(0.0), "right": Held(0.0)}, surface=walls(1.0))

    before = 3.0
    for instant in march(FilmSolver(space), problem, 1.0, 0.25):
        now = 3.0 - 2.0 * instant.time
        left = instant.solution.outflow[instant.solution.held].sum() * instant.step
        assert left == pytest.approx((content(before) - content(now)) * LENGTH * WIDE, rel=1e-11, abs=0.0)
        before = now


def test_thick_film_is_smooth():
    space = strip(16)
    thickness = space.sample(lambda x, y: 1e3 * SIGMA * (2.0 - x / LENGTH))
    posed = film(thickness, VISCOSITY, velocity_moving=MOVING)
    smooth = FilmProblem(space, posed, {"left": Held(0.0), "right": Held(0.0)})
    one, other = (loads(FilmSolver(space).solve(replace(smooth, surface=s))) for s in (None, walls(1.0)))
    assert other.load == pytest.approx(one.load, rel=1e-9)
    assert other.flow["right"] == pytest.approx(one.flow["right"], rel=1e-9)
    assert other.friction_moving[0] == pytest.approx(one.friction_moving[0], rel=1e-5)


BEARING = Asperities(2e10, 5e-6, SIGMA, 100e9, 0.1, summit_height=0.2e-6)
LOAD = 2e6 * LENGTH * WIDE


def _rubbing(speed: float) -> tuple[float, float, float]:
    """Friction coefficient, share of the load on asperities, and h0/sigma of a slider under LOAD."""
    space = strip(24)
    surface = walls(1.0, share=0.5)

    def found(log_ratio: float) -> Loads:
        thickness = space.sample(lambda x, y: SIGMA * np.exp(log_ratio) + 1e-6 * (1.0 - x / LENGTH))
        posed = film(thickness, VISCOSITY, velocity_moving=(np.full((1, 1), speed), ZERO))
        ends = {"left": Held(0.0), "right": Held(0.0)}
        return loads(FilmSolver(space).solve(FilmProblem(space, posed, ends, surface=surface, asperities=BEARING)))

    def unbalance(log_ratio: float) -> float:
        got = found(log_ratio)
        return (got.load + got.contact_load) / LOAD - 1.0

    place = brentq(unbalance, np.log(0.05), np.log(100.0), xtol=1e-6)
    got = found(place)
    return -got.friction_moving[0] / LOAD, got.contact_load / LOAD, float(np.exp(place))


def test_stribeck_curve():
    """Boundary friction at rest, least friction where the asperities come clear, then viscous drag."""
    speeds = np.geomspace(1e-5, 30.0, 27)
    friction, share, ratio = np.array([_rubbing(speed) for speed in speeds]).T
    least = int(np.argmin(friction))
    assert 3 < least < len(speeds) - 4
    assert np.all(np.diff(friction[: least + 1]) < 0.0)
    assert np.all(np.diff(friction[least:]) > 0.0)
    assert np.all(np.diff(share) < 0.0)
    assert np.all(np.diff(ratio) > 0.0)
    # At rest all the load is on the asperities; at the least friction hardly any.
    assert share[0] > 0.99
    assert friction[0] == pytest.approx(BEARING.friction_coefficient, rel=0.01)
    assert share[least] < 0.05 < share[least - 6]
    assert 1.5 < ratio[least] < 5.0
    assert share[-1] < 1e-6
