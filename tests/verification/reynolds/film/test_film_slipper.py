"""Film equation: slippers, plain, grooved, tilted and sliding.

A ring-shaped land around a pocket at supply pressure. The film of a tilted slipper is h0 (1 + a x/r2), so that
+x points to the larger film.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    FilmMesh,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    Held,
    Loads,
    Pocket,
    annulus,
    film,
    film_space,
    loads,
    no_feed,
    ring,
)

VISCOSITY, THICKNESS, SUPPLY = 0.03, 10e-6, 20e6
INNER, OUTER = 5e-3, 10e-3
SOURCE = "own converged polar solution"


def _tilted(a: float, speed: float, n: int, cavitation: Cavitation = Cavitation.NONE) -> FilmSolution:
    space = film_space(annulus(INNER, OUTER, (n, 4 * n), cell=Cell.QUADRILATERAL))
    posed = film(
        space.sample(lambda x, y: THICKNESS * (1.0 + a * x / OUTER)),
        VISCOSITY,
        velocity_moving=(np.full((1, 1), speed), ZERO),
    )
    problem = FilmProblem(space, posed, {"inner": Held(SUPPLY), "outer": Held(0.0)}, cavitation)
    return FilmSolver(space).solve(problem)


def _lift(found: Loads) -> float:
    return found.load + np.pi * INNER**2 * SUPPLY


def _couette_through(radius: float, a: float, speed: float) -> float:
    """Closed form of the wall-driven flow out of a circle of this radius."""
    return speed * THICKNESS * a * np.pi * radius**2 / (2.0 * OUTER)


@pytest.mark.parametrize(
    ("a", "speed", "force", "moment", "flow_inner", "flow_outer"),
    [
        (0.0, 0.0, 3399.270, 0.0, 5.035956e-7, 5.035956e-7),
        (0.5, 0.0, 3456.681, -1.174660, 5.946517e-7, 5.946517e-7),
        (0.5, -10.0, 4163.694, -4.07860, 3.58916e-7, 9.47965e-7),
        (0.5, 2.0, 3315.278, -0.59387, 6.41799e-7, 5.23989e-7),
    ],
    ids=["parallel", "tilted", "tilted, -10 m/s", "tilted, +2 m/s"],
)
def test_tilted(a, speed, force, moment, flow_inner, flow_outer, validation, refine):
    def solve(n: int) -> tuple[float, ...]:
        found = loads(_tilted(a, speed, n))
        assert found.flow["inner"] + found.flow["outer"] == pytest.approx(0.0, abs=1e-12 * flow_outer)
        return (
            _lift(found),
            -found.moment_y,
            -found.flow["inner"] - _couette_through(INNER, a, speed),
            found.flow["outer"] - _couette_through(OUTER, a, speed),
        )

    quantities = (
        ("lift with the pocket", "N", force, 0.5e-3),
        ("moment integral of p x", "N m", moment, 0.5e-5),
        ("Poiseuille flow at the pocket", "m3/s", flow_inner, 0.5e-12),
        ("Poiseuille flow at the rim", "m3/s", flow_outer, 0.5e-12),
    )
    for (quantity, unit, expected, rounding), found in zip(quantities, refine(solve, (16, 32, 64)), strict=True):
        if expected == 0.0:
            assert abs(found.finest) < 1e-9 * force * OUTER
            continue
        validation(
            case="Tilted slipper",
            source=SOURCE,
            quantity=f"{quantity}, a = {a:g}, {speed:+g} m/s",
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(rounding),
            order=found.order,
        )


def test_net_flow_of_the_sliding_slipper(validation, refine):
    found = refine(lambda n: loads(_tilted(0.5, -10.0, n)).flow["outer"], (16, 32, 64))
    validation(
        case="Tilted slipper",
        source=SOURCE,
        quantity="net flow through pocket and rim, a = 0.5, -10 m/s",
        unit="m3/s",
        expected=1.62567e-7,
        obtained=found.finest,
        tolerance=found.tolerance(rounding=0.5e-12),
        order=found.order,
    )


def test_largest_pressure_of_the_sliding_slipper(validation, refine):
    found = refine(lambda n: loads(_tilted(0.5, -10.0, n)).pressure_max, (24, 48, 96))
    validation(
        case="Tilted slipper",
        source=SOURCE,
        quantity="largest pressure, a = 0.5, -10 m/s",
        unit="Pa",
        expected=23.357e6,
        obtained=found.finest,
        tolerance=found.front_tolerance(rounding=0.5e3) + 2e-4 * SUPPLY,
        note="nodal value; 2e-4 of the supply pressure for what lies between nodes",
    )


@pytest.mark.parametrize(("speed", "smallest"), [(5.0, -0.175e6), (10.0, -3.98e6)])
def test_diverging_slipper_pulls(speed, smallest, validation, refine):
    """Without cavitation the diverging film is in tension; Reynolds' condition takes the tension away."""
    found = refine(lambda n: float(_tilted(0.5, speed, n).pressure.min()), (24, 48, 96))
    validation(
        case="Tilted slipper",
        source=SOURCE,
        quantity=f"smallest pressure without cavitation, a = 0.5, {speed:+g} m/s",
        unit="Pa",
        expected=smallest,
        obtained=found.finest,
        tolerance=found.front_tolerance(rounding=0.5e3 if speed < 10.0 else 5e3) + 2e-4 * SUPPLY,
        note="nodal value; 2e-4 of the supply pressure for what lies between nodes",
    )
    linear, ruptured = _tilted(0.5, speed, 48), _tilted(0.5, speed, 48, Cavitation.REYNOLDS)
    assert ruptured.pressure.min() == 0.0
    assert loads(ruptured).load > loads(linear).load


def test_grooved_slipper(validation, refine):
    """Two lands with a groove between them that nothing enters from outside: an isobar of unknown pressure."""
    radii = (5e-3, 7.43e-3, 7.83e-3, 10.26e-3)

    def solve(n: int) -> tuple[float, float, float]:
        lines = np.concatenate([np.linspace(*radii[:2], n + 1), np.linspace(*radii[2:], n + 1)])
        keep = np.ones((2 * n + 1, 12 * n), dtype=bool)
        keep[n] = False
        mesh = ring(lines, 12 * n, keep=keep).mesh
        middle = np.hypot(*mesh.p[:, mesh.facets].mean(axis=1))
        edge = mesh.boundary_facets()
        names = {
            "inner": edge[middle[edge] < 5.2e-3],
            "groove": edge[(middle[edge] > 7.2e-3) & (middle[edge] < 8e-3)],
            "outer": edge[middle[edge] > 10e-3],
        }
        space = film_space(FilmMesh(mesh.with_boundaries(names)), pockets=["groove"])
        held = {"inner": Held(SUPPLY), "groove": Pocket(no_feed), "outer": Held(0.0)}
        problem = FilmProblem(space, film(space.sample(THICKNESS), VISCOSITY), held)
        solution = FilmSolver(space).solve(problem)
        groove = float(solution.pressure[space.edge_dofs["groove"][0]])
        found = loads(solution)
        assert found.flow["groove"] == pytest.approx(0.0, abs=1e-12 * found.flow["outer"])
        covered = np.pi * (radii[0] ** 2 * SUPPLY + (radii[2] ** 2 - radii[1] ** 2) * groove)
        return found.flow["outer"], groove / SUPPLY, found.load + covered

    resistance = np.log(radii[1] / radii[0]) + np.log(radii[3] / radii[2])
    exact = (
        ("flow", "m3/s", np.pi * THICKNESS**3 * SUPPLY / (6.0 * VISCOSITY * resistance), 0.0),
        ("groove over supply pressure", "1", np.log(radii[3] / radii[2]) / resistance, 0.0),
        ("lift with pocket and groove", "N", 3496.390, 0.5e-3),
    )
    assert exact[0][2] == pytest.approx(5.238254e-7, rel=1e-6)
    for (quantity, unit, expected, rounding), found in zip(exact, refine(solve, (6, 12, 24)), strict=True):
        validation(
            case="Grooved slipper",
            source="closed form",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(rounding),
            order=found.order,
        )
