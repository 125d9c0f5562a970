"""Film equation: published tables of journal bearings.

Butenschoen 1976, rotation and squeeze; Raimondi and Boyd 1958; the short bearing of Ocvirk 1953 and half of the
long bearing's full film (Guembel 1914). Radius, radial clearance, viscosity and surface speed are one; angles run
from the largest film in the direction of sliding. Half of the bearing's width: the midplane is a closed boundary.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Loads,
    film,
    film_space,
    loads,
    point_fields,
    rectangle,
)

ROUND = 2.0 * np.pi
SLIDING = (np.ones((1, 1)), ZERO)
ADVISED = 0.005  # tolerance from the scatter of the table for Butenschoen's tables


def _space(aspect: float, eccentricity: float, around: int, *, periodic: bool = False) -> FilmSpace:
    """Half a bearing of L/D = aspect, lines gathered at the smallest film and at the free side.

    Around, tan(angle/2) = f tan(s/2): with f = sqrt((1 + eps)/(1 - eps)) the lines would follow Sommerfeld's angle
    and leave the large film to a few cells.
    """
    cells = (around, around // 4)
    space = film_space(rectangle((1.0, 1.0), cells, cell=Cell.QUADRILATERAL, periodic_x=periodic))
    s, y = space.vertices.T
    e = abs(eccentricity)
    gathered = ((1.0 + e) / (1.0 - e)) ** 0.35
    turn = ROUND * (s - 0.5)  # from the smallest film on
    angle = np.pi + 2.0 * np.arctan2(np.sin(0.5 * turn), gathered * np.cos(0.5 * turn))
    return space.moved(np.column_stack([angle, aspect * (1.0 - (1.0 - y) ** 1.5)]))


def _force(solution: FilmSolution) -> tuple[float, float]:
    """Force on half of the journal along the line of centres (to the smallest film) and across it."""
    space = solution.problem.space
    pull = point_fields(solution).pressure * space.area
    angle = space.points[0]
    return float(-np.sum(pull * np.cos(angle))), float(np.sum(pull * np.sin(angle)))


def _rotating(aspect: float, eccentricity: float, around: int) -> tuple[float, float, Loads]:
    """Sommerfeld number So = F psi^2/(mu omega B D), attitude angle (deg) and integrals."""
    space = _space(aspect, eccentricity, around)
    posed = film(space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x)), 1.0, velocity_moving=SLIDING)
    held = {name: Held(0.0) for name in ("left", "right", "top")}
    solution = FilmSolver(space).solve(FilmProblem(space, posed, held, Cavitation.REYNOLDS))
    along, across = _force(solution)
    attitude = float(np.degrees(np.arctan2(across, along)))
    return float(np.hypot(along, across)) / (2.0 * aspect), attitude, loads(solution)


WIDTHS = (1.0, 1 / 2, 1 / 2.5, 1 / 3, 1 / 4, 1 / 5, 1 / 6, 1 / 8)  # B/D
SOMMERFELD = {
    0.5: (0.8903, 0.3124, 0.2117, 0.1522, 0.0888, 0.0579, 0.0406, 0.0231),
    0.8: (3.5663, 1.7339, 1.2756, 0.9687, 0.6043, 0.4085, 0.2930, 0.1706),
    0.95: (18.7895, 13.3083, 11.2225, 9.4993, 6.9248, 5.1833, 3.9831, 2.5202),
    0.99: (107.787, 93.788),
    0.999: (1174.54,),
}
ATTITUDE = (56.705, 54.993, 54.603, 54.348, 54.069, 53.922, 53.863, 53.784)  # deg, eps = .5
SIDE_FLOW = (0.7852, 0.4694, 0.384, 0.324, 0.246, 0.198, 0.1655, 0.1245)  # Q/(R^3 psi omega), eps = .5


@pytest.mark.parametrize("eccentricity", SOMMERFELD)
def test_butenschoen_rotation(eccentricity, validation):
    for k, (aspect, printed) in enumerate(zip(WIDTHS, SOMMERFELD[eccentricity], strict=False)):
        so, attitude, found = _rotating(aspect, eccentricity, 160)
        rows = [("Sommerfeld number So", "1", printed, so)]
        if eccentricity == 0.5:
            rows += [
                ("attitude angle", "deg", ATTITUDE[k], attitude),
                ("side flow Q/(R^3 psi omega)", "1", SIDE_FLOW[k], 2.0 * found.flow["top"]),
            ]
        for quantity, unit, expected, obtained in rows:
            validation(
                case="Rotating journal bearing, Butenschoen's table",
                source="Butenschoen 1976",
                quantity=f"{quantity}, B/D = 1/{1.0 / aspect:g}, eccentricity ratio {eccentricity:g}",
                unit=unit,
                expected=expected,
                obtained=obtained,
                relative_tolerance=ADVISED,
                note="tolerance from the scatter of the table",
            )


def test_slips_of_the_rotation_table(validation, refine):
    """Three numbers of the table that its neighbours contradict, with converged values beside them."""
    for quantity, aspect, eccentricity, printed, expected, rounding in (
        ("attitude angle", 0.25, 0.2, 75.287, 75.378, 0.5e-3),
        ("side flow Q/(R^3 psi omega)", 0.5, 0.9, 0.8453, 0.8494, 0.5e-4),
        ("side flow Q/(R^3 psi omega)", 1.0, 0.1, 0.1603, 0.1611, 0.5e-4),
    ):

        def solve(n: int, quantity=quantity, aspect=aspect, eccentricity=eccentricity) -> float:
            _, attitude, found = _rotating(aspect, eccentricity, n)
            return attitude if quantity == "attitude angle" else 2.0 * found.flow["top"]

        column = refine(solve, (48, 96, 192))
        validation(
            case="Rotating journal bearing, slips of Butenschoen's table",
            source="own converged solution",
            quantity=f"{quantity}, B/D = {aspect:g}, eccentricity ratio {eccentricity:g}",
            unit="deg" if quantity == "attitude angle" else "1",
            expected=expected,
            obtained=column.finest,
            tolerance=column.front_tolerance(rounding),
            note=f"printed {printed:g}: a slip",
        )


RAIMONDI_BOYD = {  # L/D: S, attitude deg, f R/C, Q/(R C N L), Qs/Q, mean over largest pressure
    1.0: (0.121, 50.58, 3.22, 4.33, 0.680, 0.415),
    0.5: (0.319, 48.14, 8.10, 4.85, 0.730, 0.365),
    0.25: (1.07, 46.72, 26.7, 4.99, 0.746, 0.334),
}
GROUPS = (
    ("S", "1"), ("attitude angle", "deg"), ("friction f R/C", "1"), ("inflow Q/(R C N L)", "1"),
    ("side flow over inflow", "1"), ("mean over largest pressure", "1"),
)  # fmt: skip


@pytest.mark.parametrize("aspect", RAIMONDI_BOYD)
def test_raimondi_and_boyd(aspect, validation):
    so, attitude, found = _rotating(aspect, 0.6, 160)
    force = 2.0 * so * aspect  # on the half of it
    obtained = (
        1.0 / (ROUND * so), attitude, -found.friction_moving[0] / force, -ROUND * found.flow["left"] / aspect,
        -found.flow["top"] / found.flow["left"], force / (2.0 * aspect) / found.pressure_max,
    )  # fmt: skip
    for (quantity, unit), expected, value in zip(GROUPS, RAIMONDI_BOYD[aspect], obtained, strict=True):
        validation(
            case="Rotating journal bearing, Raimondi and Boyd's table",
            source="Raimondi and Boyd 1958",
            quantity=f"{quantity}, L/D = {aspect:g}, eccentricity ratio 0.6",
            unit=unit,
            expected=expected,
            obtained=value,
            relative_tolerance=0.015,
            note="spot values; they agree with converged solutions to 1 to 1.5 %",
        )


@pytest.mark.parametrize(("aspect", "eccentricity"), [(1.0, 0.6), (0.5, 0.4), (0.25, 0.8)])
def test_friction_is_couette_and_the_load_s_moment(aspect, eccentricity, validation, refine):
    """f/psi = pi/(So sqrt(1 - eps^2)) + (eps/2) sin phi, the film sheared all round."""

    def solve(n: int) -> float:
        so, attitude, found = _rotating(aspect, eccentricity, n)
        drag = np.pi / (so * np.sqrt(1.0 - eccentricity**2))
        closed = drag + 0.5 * eccentricity * np.sin(np.radians(attitude))
        return float(-found.friction_moving[0] / (2.0 * so * aspect) / closed)

    column = refine(solve, (48, 96, 192))
    validation(
        case="Rotating journal bearing, friction from load and attitude",
        source="closed form",
        quantity=f"friction over the closed form, L/D = {aspect:g}, eccentricity ratio {eccentricity:g}",
        unit="1",
        expected=1.0,
        obtained=column.finest,
        tolerance=column.front_tolerance(),
    )


def _squeezed(aspect: float, eccentricity: float, around: int) -> float:
    """Sommerfeld number F psi^2/(mu epsdot B D) of a journal that moves along the line of centres."""
    space = _space(aspect, eccentricity, around, periodic=True)
    thickness = space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x))
    posed = film(thickness, 1.0, squeeze=space.sample(lambda x, y: np.cos(x)))
    problem = FilmProblem(space, posed, {"top": Held(0.0)}, Cavitation.REYNOLDS)
    return _force(FilmSolver(space).solve(problem))[0] / (2.0 * aspect)


def test_butenschoen_squeeze(validation):
    table = {
        1.0: {-0.8: 0.6293, -0.4: 1.1391, 0.0: 2.4076, 0.4: 6.8503, 0.8: 50.349},
        0.5: {0.0: 0.7224, 0.8: 26.676},
        0.25: {0.0: 0.1919, 0.8: 9.6161},
    }
    for aspect, row in table.items():
        for eccentricity, printed in row.items():
            validation(
                case="Squeezed journal bearing, Butenschoen's table",
                source="Butenschoen 1976",
                quantity=f"Sommerfeld number So, B/D = {aspect:g}, eccentricity ratio {eccentricity:g}",
                unit="1",
                expected=printed,
                obtained=_squeezed(aspect, eccentricity, 160),
                relative_tolerance=ADVISED,
                note="tolerance from the scatter of the table",
            )


def test_slips_of_the_squeeze_table(validation, refine):
    for aspect, eccentricity, printed, expected, rounding in (
        (1 / 2, 0.1, 0.9814, 0.9315, 0.5e-4),
        (1 / 2.5, 0.8, 15.94, 19.95, 0.5e-2),
        (1 / 6, 0.99, 2331.0, 3340.0, 0.5),
        (1 / 8, -0.95, 0.0085, 0.00886, 0.5e-5),
    ):
        column = refine(lambda n, a=aspect, e=eccentricity: _squeezed(a, e, n), (48, 96, 192))
        validation(
            case="Squeezed journal bearing, slips of Butenschoen's table",
            source="own converged solution",
            quantity=f"Sommerfeld number So, B/D = 1/{1.0 / aspect:g}, eccentricity ratio {eccentricity:g}",
            unit="1",
            expected=expected,
            obtained=column.finest,
            tolerance=column.front_tolerance(rounding),
            note=f"printed {printed:g}: a slip",
        )


def _half_of_the_full_film(aspect: float, eccentricity: float, cells: tuple[int, int]) -> tuple[float, float]:
    """Force along the line of centres and across it of the film from its largest thickness to its smallest.

    The full film's pressure is odd about both, so that zero pressure there leaves it as it is. Sides free
    (`aspect` L/D), or closed for a strip of a long bearing (`aspect` zero).
    """
    space = film_space(rectangle((np.pi, aspect or 0.1), cells, cell=Cell.QUADRILATERAL))
    posed = film(space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x)), 1.0, velocity_moving=SLIDING)
    held = {name: Held(0.0) for name in (("left", "right", "top") if aspect else ("left", "right"))}
    return _force(FilmSolver(space).solve(FilmProblem(space, posed, held, Cavitation.NONE)))


@pytest.mark.parametrize(("eccentricity", "load", "attitude"), [(0.2, 1.901961, 82.596), (0.5, 5.153165, 69.819)])
def test_guembel(eccentricity, load, attitude, validation, refine):
    """w* = w psi^2/(mu omega R), only the half with pressure above zero counted."""

    def solve(n: int) -> tuple[float, float]:
        along, across = _half_of_the_full_film(0.0, eccentricity, (n, 1))
        return float(np.hypot(along, across) / 0.1), float(np.degrees(np.arctan2(across, along)))

    for (quantity, unit, expected, rounding), column in zip(
        (("load w psi^2/(mu omega R)", "1", load, 0.5e-6), ("attitude angle", "deg", attitude, 0.5e-3)),
        refine(solve, (64, 128, 256)),
        strict=True,
    ):
        validation(
            case="Long journal bearing, half of the full film",
            source="Guembel 1914, closed form",
            quantity=f"{quantity}, eccentricity ratio {eccentricity:g}",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(rounding),
            order=column.order,
        )


@pytest.mark.parametrize(
    ("eccentricity", "load", "attitude"), [(0.2, 0.345093, 75.431), (0.5, 1.500762, 53.680), (0.9, 48.012285, 20.826)]
)
def test_ocvirk(eccentricity, load, attitude, validation, refine):
    """So (D/L)^2 of ever shorter bearings, L/D = 2/n, on meshes refined with them: both errors of second order."""

    def solve(n: int) -> tuple[float, float]:
        aspect = 2.0 / n
        along, across = _half_of_the_full_film(aspect, eccentricity, (2 * n, n // 4))
        so = float(np.hypot(along, across)) / (2.0 * aspect)
        return so / aspect**2, float(np.degrees(np.arctan2(across, along)))

    for (quantity, unit, expected, rounding), column in zip(
        (("So (D/L)^2", "1", load, 0.5e-6), ("attitude angle", "deg", attitude, 0.5e-3)),
        refine(solve, (64, 128, 256)),
        strict=True,
    ):
        validation(
            case="Short journal bearing, half of the full film",
            source="Ocvirk 1953, closed form",
            quantity=f"{quantity}, eccentricity ratio {eccentricity:g}",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(rounding),
            order=column.order,
            note="L/D = 1/32, 1/64, 1/128",
        )
