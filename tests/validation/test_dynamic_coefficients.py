"""Journal bearing with two axial grooves: equilibrium, stiffness and damping.

Grooves of 20 degrees at right angles to the load, open to the ambience; mass-conserving cavitation. Lund and
Thomsen 1978, as kept in the tests of ROSS (petrobras/ross). Radius, radial clearance, viscosity and
angular speed are one; x points along the load and y 90 degrees on in the direction of rotation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from reynolds import ZERO, Cell, FilmProblem, FilmSolver, FilmSpace, Held, film, film_space, rectangle

CELLS = 144, 8  # around, over half of the length
STEP = 1e-4  # of displacement and velocity for the coefficients, in clearances (per radian)
ROUNDING = 0.005  # of the printed coefficients

# S, eccentricity ratio, attitude deg | Kxx Kxy Kyx Kyy | Bxx Bxy Byy, by L/D
LUND_THOMSEN = {
    0.5: (
        (1.656, 0.244, 65.85, 1.69, 5.06, -2.20, 1.95, 9.93, 2.15, 4.80),
        (0.917, 0.372, 57.45, 2.12, 4.01, -1.30, 1.85, 7.70, 2.06, 3.23),
        (0.580, 0.477, 51.01, 2.67, 3.70, -0.78, 1.75, 6.96, 1.94, 2.40),
        (0.379, 0.570, 45.43, 3.33, 3.64, -0.43, 1.68, 6.76, 1.87, 1.89),
        (0.244, 0.655, 40.25, 4.21, 3.74, -0.13, 1.64, 6.87, 1.82, 1.54),
    ),
    1.0: (
        (0.991, 0.150, 70.58, 1.56, 7.29, -2.16, 1.52, 14.66, 1.58, 4.49),
        (0.635, 0.224, 63.54, 1.62, 5.33, -1.57, 1.56, 10.80, 1.70, 3.41),
        (0.235, 0.460, 49.27, 2.19, 3.57, -0.80, 1.55, 7.36, 1.89, 2.19),
        (0.159, 0.559, 44.33, 2.73, 3.36, -0.48, 1.48, 6.94, 1.78, 1.74),
        (0.108, 0.650, 39.72, 3.45, 3.34, -0.23, 1.44, 6.89, 1.72, 1.43),
    ),
}


@dataclass(frozen=True)
class Bearing:
    """Half of its length, with the solver, cos and sin of the angle at the points and integrated over the film."""

    space: FilmSpace
    solver: FilmSolver
    grooves: np.ndarray
    normal: np.ndarray
    integrated: np.ndarray

    def force(self, place: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        """Force of the oil on the journal (x, y), both halves, at a place and velocity of its centre."""
        thickness = 1.0 - np.tensordot(place, self.normal, 1)
        posed = film(
            thickness, 1.0, velocity_moving=(np.ones((1, 1)), ZERO), squeeze=-np.tensordot(velocity, self.normal, 1)
        )
        problem = FilmProblem(self.space, posed, {"top": Held(0.0)}, held_nodes=self.grooves)
        return np.asarray(-2.0 * self.integrated @ self.solver.solve(problem).pressure)


def _bearing(length_over_diameter: float) -> Bearing:
    around = rectangle((2.0 * np.pi, length_over_diameter), CELLS, cell=Cell.QUADRILATERAL, periodic_x=True)
    space = film_space(around)
    angle = np.full(space.size, np.inf)
    np.minimum.at(angle, space.vertex_dofs, np.degrees(space.vertices[:, 0]))
    groove = np.minimum(np.abs(angle - 90.0), np.abs(angle - 270.0)) < 10.0 + 1e-6
    normal = np.stack([np.cos(space.points[0]), np.sin(space.points[0])])
    integrated = np.stack([space.lumped(part) for part in normal])
    return Bearing(space, FilmSolver(space), np.where(groove, 0.0, np.nan), normal, integrated)


def _slopes(bearing: Bearing, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and damping, -dF_i/dx_j and -dF_i/dv_j, by central differences."""
    rest = np.zeros(2)
    both = []
    for displaced in (True, False):
        columns = []
        for d in STEP * np.eye(2):
            ahead, behind = (
                bearing.force(place + s * d, rest) if displaced else bearing.force(place, s * d) for s in (1.0, -1.0)
            )
            columns.append((behind - ahead) / (2.0 * STEP))
        both.append(np.column_stack(columns))
    return both[0], both[1]


def _equilibrium(bearing: Bearing, load: float) -> np.ndarray:
    """Place of the journal at which the oil carries the load along x: Newton's method from half the clearance."""
    place = 0.5 * np.array([np.cos(np.radians(50.0)), np.sin(np.radians(50.0))])
    for _ in range(20):
        left = bearing.force(place, np.zeros(2)) + np.array([load, 0.0])
        if np.abs(left).max() < 1e-8 * load:
            return place
        step = np.linalg.solve(_slopes(bearing, place)[0], left)
        place = place + step * min(1.0, 0.5 * (1.0 - np.hypot(*place)) / np.hypot(*step))
    raise AssertionError(f"no equilibrium at load {load:g}")


@pytest.mark.parametrize("ratio", list(LUND_THOMSEN))
@pytest.mark.parametrize("number", range(5))
def test_two_axial_grooves(ratio, number, validation):
    sommerfeld, eccentricity, attitude, *coefficients = LUND_THOMSEN[ratio][number]
    bearing = _bearing(ratio)
    load = 4.0 * ratio / (2.0 * np.pi * sommerfeld)  # S = mu N L D/W (R/C)^2
    place = _equilibrium(bearing, load)
    stiffness, damping = (slope / load for slope in _slopes(bearing, place))
    assert damping[0, 1] == pytest.approx(damping[1, 0], rel=0.02)
    obtained = (*stiffness.ravel(), damping[0, 0], damping[0, 1], damping[1, 1])
    rows = [
        ("eccentricity ratio", "1", eccentricity, float(np.hypot(*place)), 0.01),
        ("attitude angle", "deg", attitude, float(np.degrees(np.arctan2(place[1], place[0]))), 0.5),
    ]
    names = ("Kxx", "Kxy", "Kyx", "Kyy", "Bxx", "Bxy", "Byy")
    for name, expected, value in zip(names, coefficients, obtained, strict=True):
        group = "C/W" if name[0] == "K" else "C omega/W"
        rows.append((f"{name} {group}", "1", expected, float(value), 0.06 * abs(expected) + ROUNDING))
    for quantity, unit, expected, value, tolerance in rows:
        validation(
            case="Journal bearing with two axial grooves",
            source="Lund and Thomsen 1978",
            quantity=f"{quantity}, L/D = {ratio:g}, S = {sommerfeld:g}",
            unit=unit,
            expected=expected,
            obtained=value,
            tolerance=tolerance,
            note="tolerances of ROSS: .01, .5 deg, 6 % plus rounding",
        )
