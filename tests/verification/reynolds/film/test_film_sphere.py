"""Film equation: films on a sphere, by its stereographic map.

A seat from the polar angle a to b: film, lift and friction have closed forms; a shell that turns about any axis
through the centre of the sphere drags oil through a concentric film without pressure.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from reynolds import (
    Asperities,
    Cavitation,
    ContactLoadOutput,
    FilmInputError,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    annulus,
    contact_pressure,
    film,
    film_gradients,
    film_space,
    loads,
)
from reynolds.fem.sphere import PLANE, Sphere
from reynolds.solve.load_search import RigidLoad, carry_load
from reynolds.solve.loads import pressure_integrals

RADIUS, FROM, TO = 40e-3, 0.5, 1.2  # m, rad
SPHERE = Sphere(RADIUS)
VISCOSITY, THICKNESS, DROP, SPIN = 0.03, 1e-5, 20e6, 100.0
LAND = float(np.log(np.tan(0.5 * TO) / np.tan(0.5 * FROM)))
MESHES = (8, 16, 32)


def seat(n: int, sphere: Sphere = SPHERE) -> FilmSpace:
    """n cells from edge to edge."""
    ends = (float(2.0 * RADIUS * np.tan(0.5 * angle)) for angle in (FROM, TO))
    return film_space(annulus(*ends, (n, 6 * n)), sphere=sphere)


def turning(space: FilmSpace, axis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Velocity along the film (x, y as on the map) of a shell that turns about the sphere's centre."""
    x, y = space.points
    place = np.stack(space.points_in_space) + np.array([0.0, 0.0, RADIUS])[:, None, None]
    velocity = np.cross(axis, place, axisa=0, axisb=0, axisc=0)
    step = 1e-6 * RADIUS
    found = []
    for dx, dy in ((step, 0.0), (0.0, step)):
        ends = [np.stack(SPHERE.place(x + side * dx, y + side * dy)) for side in (1.0, -1.0)]
        along = ends[0] - ends[1]
        found.append(np.sum(velocity * along, axis=0) / np.linalg.norm(along, axis=0))
    return found[0], found[1]


def solved(space: FilmSpace, thickness=THICKNESS, inner: float = 0.0, **motion) -> FilmSolution:
    posed = film(thickness, VISCOSITY, **motion)
    edges = {"inner": Held(inner), "outer": Held(0.0)}
    return FilmSolver(space).solve(FilmProblem(space, posed, edges, Cavitation.NONE))


def test_the_map_is_the_sphere():
    """Places lie on it, normals out of it, steps on the map are `scale` times as long there."""
    x, y = np.meshgrid(np.linspace(-0.05, 0.05, 7), np.linspace(-0.04, 0.03, 6))
    for sphere in (SPHERE, Sphere(-RADIUS)):
        centre = np.array([0.0, 0.0, -sphere.radius])[:, None, None]
        place, normal = np.stack(sphere.place(x, y)), np.stack(sphere.normal(x, y))
        assert np.allclose(place - centre, sphere.radius * normal, atol=1e-15)
        assert np.allclose(np.linalg.norm(normal, axis=0), 1.0)
        step = np.stack(sphere.place(x + 1e-7, y)) - np.stack(sphere.place(x - 1e-7, y))
        assert np.allclose(np.linalg.norm(step, axis=0), 2e-7 * sphere.scale(x, y), rtol=1e-6)
        off_axis = np.hypot(*place[:2])
        inside = np.hypot(x, y) < RADIUS  # beyond the equator the distance from the axis falls again
        assert np.allclose((sphere.stretch(off_axis) * off_axis)[inside], np.hypot(x, y)[inside])
    with pytest.raises(FilmInputError, match="less than the sphere's radius"):
        SPHERE.stretch(RADIUS)


def test_hydrostatic_seat(validation, refine):
    """Leakage and lift of a concentric spherical seat, the recess full."""

    def solve(n: int) -> tuple[float, float]:
        solution = solved(seat(n), inner=DROP)
        recess = DROP * np.pi * (RADIUS * np.sin(FROM)) ** 2
        return loads(solution).flow["outer"], pressure_integrals(solution)[0] + recess

    flow = np.pi * THICKNESS**3 * DROP / (6.0 * VISCOSITY * LAND)
    lift = np.pi * RADIUS**2 * DROP * (np.cos(FROM) - np.cos(TO)) / LAND
    for k, (name, unit, exact) in enumerate((("leakage", "m3/s", flow), ("lift with recess", "N", lift))):
        got = refine(lambda n, k=k: solve(n)[k], MESHES)
        validation(
            case="hydrostatic spherical seat", source="closed form (Pinkus and Sternlicht 1961)", quantity=name,
            unit=unit, expected=exact, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
        )  # fmt: skip


def test_squeezed_seat(validation, refine):
    """A seat that closes along its axis at 1 mm/s, case pressure at both edges."""
    speed = 1e-3
    factor = 6.0 * VISCOSITY * RADIUS**2 * speed / THICKNESS**3
    constant = (np.cos(FROM) - np.cos(TO)) / LAND

    def pressure(angle: float) -> float:
        return float(factor * (np.cos(angle) - np.cos(TO) - constant * np.log(np.tan(TO / 2) / np.tan(angle / 2))))

    exact = quad(lambda t: 2.0 * np.pi * RADIUS**2 * pressure(t) * np.sin(t) * np.cos(t), FROM, TO)[0]

    def solve(n: int) -> float:
        space = seat(n)
        return pressure_integrals(solved(space, squeeze=-speed * space.axial_share))[0]

    got = refine(solve, MESHES)
    validation(
        case="squeezed spherical seat", source="closed form", quantity="axial load", unit="N",
        expected=exact, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
    )  # fmt: skip


def test_pressure_around_the_seat_turns_it(validation, refine):
    """p = p1 cos(phi) along the inner edge: its harmonic is rho cos(phi) and cos(phi)/rho, rho on the map."""
    one, two = (2.0 * RADIUS * np.tan(0.5 * angle) for angle in (FROM, TO))

    def lever(rho: float) -> float:
        sized = float(SPHERE.scale(np.array(rho), np.array(0.0)))
        return (two / rho - rho / two) / (two / one - one / two) * rho**2 * sized**3

    exact = float(np.pi * DROP * quad(lever, one, two)[0])

    def solve(n: int) -> float:
        space = seat(n)
        held = np.full(space.size, np.nan)
        nodes = space.edge_dofs["inner"]
        x, y = np.array([space.place(int(node)) for node in nodes]).T
        held[nodes] = DROP * x / np.hypot(x, y)
        still = film(THICKNESS, VISCOSITY)
        problem = FilmProblem(space, still, {"outer": Held(0.0)}, Cavitation.NONE, held_nodes=held)
        return -pressure_integrals(FilmSolver(space).solve(problem))[2]

    got = refine(solve, MESHES)
    validation(
        case="spherical seat, pressure one-sided", source="closed form", quantity="moment about the middle",
        unit="N m", expected=exact, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
    )  # fmt: skip


def test_spinning_seat_drags(validation, refine):
    """Friction torque and power about the axis."""
    c1, c2 = np.cos(FROM), np.cos(TO)
    exact = 2.0 * np.pi * VISCOSITY * SPIN * RADIUS**4 / THICKNESS * (c1 - c2 - (c1**3 - c2**3) / 3.0)

    def solve(n: int) -> float:
        space = seat(n)
        x, y, _ = space.points_in_space
        done = loads(solved(space, velocity_moving=(-SPIN * y, SPIN * x)))
        assert done.dissipation == pytest.approx(-done.friction_torque_moving * SPIN, rel=1e-12)
        return -done.friction_torque_moving

    got = refine(solve, MESHES)
    validation(
        case="spinning spherical seat", source="closed form (Pinkus and Sternlicht 1961)", quantity="torque",
        unit="N m", expected=exact, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
    )  # fmt: skip


def test_a_shell_turning_about_any_axis_makes_no_pressure():
    """In a concentric film: what the shell drags in at one side leaves at the other; errors fall with h^2."""
    axis, errors = np.array([70.0, -40.0, 30.0]), []
    for n in MESHES:
        space = seat(n)
        solution = solved(space, velocity_moving=turning(space, axis))
        errors.append(np.abs(solution.pressure).max())
        # Edges of a mesh are chords: what leaves by all of them is little of what passes through one.
        leaves = loads(solution).flow
        assert abs(leaves["inner"]) + abs(leaves["outer"]) < 1e-9 * THICKNESS * RADIUS**2 * np.linalg.norm(axis)
    natural = 6.0 * VISCOSITY * np.linalg.norm(axis) * RADIUS**2 / THICKNESS**2
    assert errors[-1] < 1e-3 * natural
    assert np.log2(errors[1] / errors[2]) > 1.7


def test_balances_close():
    """Flow and power of a tilted, turning, squeezed seat with a cavity of no kind: round-off."""
    space = seat(8)
    x, _, _ = space.points_in_space
    moving = turning(space, np.array([20.0, 50.0, 100.0]))
    solution = solved(space, THICKNESS + 1e-4 * x, DROP, velocity_moving=moving, squeeze=1e-4 * space.axial_share)
    done = loads(solution)
    assert done.mass_balance_error < 1e-10
    assert done.energy_balance_error < 1e-10


def test_a_large_sphere_is_a_plane():
    """To (reach/R)^2, here 4e-7."""
    space, flat = seat(8, Sphere(1e2)), seat(8, PLANE)
    done = []
    for one in (space, flat):
        x, y, _ = one.points_in_space
        done.append(loads(solved(one, THICKNESS + 1e-4 * x, DROP, velocity_moving=(-SPIN * y, SPIN * x))))
    for name in ("load", "moment_x", "moment_y", "dissipation", "friction_torque_moving", "pressure_max"):
        assert getattr(done[0], name) == pytest.approx(getattr(done[1], name), rel=1e-6), name


def test_asperities_bear_along_the_axis_as_the_film_does():
    """One pressure of the film and one of contact all over the seat: both loads are those on its projected area."""
    space, rough = seat(8), Asperities(2e10, 5e-6, 5e-7, 1e11, 0.1)
    edges = {"inner": Held(DROP), "outer": Held(DROP)}
    problem = FilmProblem(space, film(1e-6, VISCOSITY), edges, Cavitation.NONE, asperities=rough)
    solver = FilmSolver(space)
    solution = solver.solve(problem)
    found, bears = loads(solution), float(contact_pressure(rough, 1e-6).value)
    assert found.contact_load == pytest.approx(found.load * bears / DROP, rel=1e-12)
    (by_film,) = film_gradients(solver, solution, [ContactLoadOutput()])
    assert by_film.value == pytest.approx(found.contact_load, rel=1e-12)
    carried = carry_load(problem, RigidLoad(found.load + found.contact_load), solver.solve)
    assert carried.position.separation == pytest.approx(0.0, abs=1e-11)
