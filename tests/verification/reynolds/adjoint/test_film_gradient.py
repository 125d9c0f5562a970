"""Film equation: derivatives by the film thickness.

Against differences of the films themselves, and closed forms. Each film is solved once more a little thicker and
thinner along a random field, with the same cavity; every output that `loads` has follows its gradient. The compiled
film takes no complex numbers, so that steps are real.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.sparse import csr_array

from reynolds import (
    CONSTANT,
    ZERO,
    Array,
    Asperities,
    Barus,
    Cavitation,
    Cell,
    DissipationOutput,
    FilmGradient,
    FilmInputError,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    FlowOutput,
    Fluid,
    Held,
    LoadOutput,
    Pocket,
    RationalDensity,
    Storage,
    Surface,
    annulus,
    film,
    film_gradients,
    film_space,
    held_gradient,
    loads,
    output_names,
    rectangle,
    weakly_active,
)
from reynolds.bodies.compliance import LowRank
from reynolds.fem.sphere import Sphere
from reynolds.solve.bearing import bearing_load, radius_around

LENGTH, WIDTH = 0.3, 0.05  # m
VISCOSITY = 0.03  # Pa s
OIL = Fluid(Barus(2e-8), RationalDensity(0.59e9, 1.34))
ROUGH = Surface(4e-7, 3e-7, 3.0, 1.0 / 3.0, 0.3)
SUMMITS = Asperities(2e10, 5e-6, 5e-7, 1e11, 0.1)
STEP = 1e-5  # of the mean film: differences lose 1e-11 of the outputs over it


@dataclass(frozen=True)
class Walls:
    """Elastic walls of a compliance (vertices, size) m/Pa."""

    matrix: Array | csr_array | LowRank


def springs(softness: float) -> Callable[[FilmSpace], Walls]:
    """Walls of which each place opens by the pressure above it."""

    def made(space: FilmSpace) -> Walls:
        count = len(space.vertices)
        places = (np.arange(count), space.vertex_dofs)
        return Walls(csr_array((np.full(count, softness), places), shape=(count, space.size)))

    return made


def spread(softness: float) -> Callable[[FilmSpace], Walls]:
    """Walls that open around each pressure too."""

    def made(space: FilmSpace) -> Walls:
        places = np.zeros((space.size, 2))
        places[space.vertex_dofs] = space.vertices
        distance = np.linalg.norm(space.vertices[:, None] - places[None], axis=2)
        return Walls(softness / (0.01 + distance))

    return made


def of_few(softness: float) -> Callable[[FilmSpace], Walls]:
    """The same by two smooth shapes, as a product."""

    def made(space: FilmSpace) -> Walls:
        x, y = space.vertices.T
        left = np.column_stack([np.sin(2.0 * np.pi * x / LENGTH) + 1.5, y / WIDTH])
        right = np.zeros((2, space.size))
        right[:, space.vertex_dofs] = left.T
        return Walls(LowRank(softness * left, right))

    return made


@dataclass(frozen=True)
class Case:
    """A wavy film between two sides, round a bearing or, with `ends`, on a pad between four edges."""

    cavitation: Cavitation = Cavitation.JFO
    cell: Cell = Cell.QUADRILATERAL
    sides: tuple[float, float] = (0.0, 1e5)
    ends: bool = False
    pocket: bool = False
    height: float = 50e-6
    speed: float = 5.0
    squeeze: float = 0.0
    fluid: Fluid = CONSTANT
    surface: Surface | None = None
    asperities: Asperities | None = None
    walls: Callable[[FilmSpace], Walls] | None = None
    degree: int = 1
    sphere: bool = False
    cavitates: bool = True

    def space(self) -> FilmSpace:
        """Its mesh."""
        if self.sphere:
            return film_space(annulus(0.004, 0.008, (6, 24), cell=self.cell), sphere=Sphere(0.012))
        mesh = rectangle((LENGTH, WIDTH), (30, 6), cell=self.cell, periodic_x=not self.ends)
        return film_space(mesh, degree=self.degree, pockets=("left",) if self.pocket else ())

    def problem(self) -> FilmProblem:
        """Its film."""
        space = self.space()
        names = ("inner", "outer") if self.sphere else ("bottom", "top")
        held = {name: Held(pressure) for name, pressure in zip(names, self.sides, strict=True)}
        if self.ends:
            held |= {"left": Held(self.sides[0]), "right": Held(self.sides[1])}
        if self.pocket:
            held = {"left": Pocket(lambda p: (2e-6 - 1e-12 * p, -1e-12)), "right": Held(self.sides[1])}
        reach = float(np.ptp(space.vertices[:, 0]))

        def thickness(x: Array, y: Array) -> Array:
            return self.height * (1.0 + 0.6 * np.cos(2.0 * np.pi * x / reach) + 0.1 * np.sin(40.0 * y))

        posed = film(
            space.sample(thickness), VISCOSITY, squeeze=np.full((1, 1), self.squeeze),
            velocity_moving=(np.full((1, 1), self.speed), np.full((1, 1), 0.2 * self.speed)),
        )  # fmt: skip
        return FilmProblem(
            space, replace(posed, thickness_at_vertices=thickness(*space.vertices.T)), held, self.cavitation,
            fluid=self.fluid, surface=self.surface, asperities=self.asperities,
            walls=None if self.walls is None else self.walls(space),
        )  # fmt: skip


THIN = {"height": 3e-6, "speed": 0.05}
CASES = {
    "full": Case(Cavitation.NONE, cavitates=False),
    "triangles": Case(Cavitation.NONE, Cell.TRIANGLE, cavitates=False),
    "quadratic": Case(Cavitation.NONE, degree=2, cavitates=False),
    "sphere": Case(Cavitation.NONE, sphere=True, cavitates=False),
    "reynolds": Case(Cavitation.REYNOLDS),
    "reynolds, four edges": Case(Cavitation.REYNOLDS, ends=True, sides=(0.0, 0.0), speed=-5.0),
    "jfo": Case(),
    "jfo triangles": Case(cell=Cell.TRIANGLE),
    "jfo, four edges": Case(ends=True, speed=-5.0),
    "pocket": Case(pocket=True, ends=True, sides=(0.0, 0.0), speed=-5.0),
    "squeeze": Case(squeeze=-1e-4),
    "oil": Case(fluid=OIL),
    "oil, full": Case(Cavitation.NONE, sides=(1e6, 1e6), fluid=OIL, cavitates=False),
    "oil, reynolds": Case(Cavitation.REYNOLDS, fluid=OIL),
    "rough": Case(surface=ROUGH, **THIN),
    "rough squeeze": Case(surface=ROUGH, height=1e-6, speed=0.1, squeeze=2e-5),
    "rough contact": Case(surface=ROUGH, asperities=SUMMITS, fluid=OIL, **THIN),
    "springs": Case(walls=springs(2e-12)),
    "soft": Case(walls=spread(3e-15)),
    "soft by few shapes": Case(walls=of_few(1e-14)),
    "soft oil": Case(Cavitation.NONE, sides=(1e6, 1e6), fluid=OIL, walls=spread(3e-15), cavitates=False),
    "soft contact": Case(asperities=SUMMITS, walls=spread(1e-15), **THIN),
    "springs in rough contact": Case(surface=ROUGH, asperities=SUMMITS, walls=springs(2e-13), **THIN),
}


def _values(solution: FilmSolution) -> Mapping[str, float]:
    found = loads(solution)
    x, y = found.friction_moving
    fixed_x, fixed_y = found.friction_fixed
    return {
        "load": found.load, "contact_load": found.contact_load, "moment_x": found.moment_x, "moment_y": found.moment_y,
        "friction": float(np.hypot(x, y)), "friction_x": x, "friction_y": y,
        "friction_torque": found.friction_torque_moving, "friction_fixed_x": fixed_x, "friction_fixed_y": fixed_y,
        "friction_fixed_torque": found.friction_torque_fixed, "dissipation": found.dissipation,
        "bearing_load": bearing_load(solution).size, "shaft_torque": radius_around(solution.problem.space) * x,
        "shaft_fixed_torque": radius_around(solution.problem.space) * fixed_x,
        **{f"flow.{name}": flow for name, flow in found.flow.items()},
    }  # fmt: skip


@dataclass(frozen=True)
class Solved:
    """A film, its gradients by name, and the films of the same cavity along a growth at the vertices (m)."""

    problem: FilmProblem
    solution: FilmSolution
    solver: FilmSolver

    def gradients(self) -> dict[str, FilmGradient]:
        """The gradients by name, those of a film around a cylinder among them."""
        around = output_names(self.problem, around_cylinder=True)
        torques = {f"shaft_{wall}torque": around[f"friction_{wall}torque"] for wall in ("", "fixed_")}
        names = around | output_names(self.problem) | torques
        return dict(zip(names, film_gradients(self.solver, self.solution, list(names.values())), strict=True))

    def along(self, growth: Array) -> FilmSolution:
        """The film with more thickness."""
        shape, space = self.problem.film, self.problem.space
        assert shape.thickness_at_vertices is not None
        more = replace(
            shape,
            thickness=shape.thickness + space.sample_vertices(growth),
            thickness_at_vertices=shape.thickness_at_vertices + growth,
        )
        return self.solver.solve(replace(self.problem, film=more), self.solution)


def _solved(case: Case) -> Solved:
    problem = case.problem()
    solver = FilmSolver(problem.space)
    solution = solver.solve(problem)
    assert solution.cavity.any() == case.cavitates
    return Solved(problem, solution, solver)


def _growth(space: FilmSpace) -> Array:
    """Random growth at the vertices, the same on both sides of a seam."""
    return np.random.default_rng(0).uniform(0.5, 1.5, space.size)[space.vertex_dofs]


@pytest.mark.parametrize("name", CASES)
def test_gradients_are_slopes_of_the_film(name):
    solved = _solved(CASES[name])
    gradients, space = solved.gradients(), solved.problem.space
    growth, mean = _growth(space), float(solved.problem.film.thickness.mean())
    more, less = (solved.along(sign * STEP * mean * growth) for sign in (1.0, -1.0))
    for other in (more, less):
        assert np.array_equal(other.cavity, solved.solution.cavity)
    now, more_values, less_values = (_values(one) for one in (solved.solution, more, less))
    for output, gradient in gradients.items():
        assert gradient.value == pytest.approx(now[output], rel=1e-9, abs=1e-12 * abs(now["load"]))
        expected = (more_values[output] - less_values[output]) / (2.0 * STEP * mean)
        found = gradient.along(space.sample_vertices(growth), growth)
        assert found == pytest.approx(expected, rel=1e-6, abs=1e-7 * abs(now[output]) / mean)


def test_differences_converge_to_the_gradient_with_their_order():
    """Central differences err by the square of the step: their limit is the gradient."""
    solved = _solved(CASES["oil, full"])
    gradients, growth = solved.gradients(), _growth(solved.problem.space)
    at_points = solved.problem.space.sample_vertices(growth)
    steps = 1e-3 * 50e-6 * np.array([4.0, 2.0, 1.0])
    for name in ("load", "dissipation", "flow.top", "friction"):
        found = gradients[name].along(at_points, growth)
        values = [[_values(solved.along(sign * step * growth))[name] for sign in (1.0, -1.0)] for step in steps]
        errors = [abs((more - less) / (2.0 * step) - found) for step, (more, less) in zip(steps, values, strict=True)]
        assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)
        assert np.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("cells", [16, 32])
def test_density_of_a_parallel_film_in_closed_form(cells, validation):
    """Oil from p to 0 through a parallel film of length L: dW/dh(x) = 1.5 p/h (1 - 2 x/L) per area."""
    height, pressure = 20e-6, 1e6
    space = film_space(rectangle((0.02, 0.01), (cells, 2), cell=Cell.QUADRILATERAL))
    posed = film(np.full((1, 1), height), VISCOSITY)
    problem = FilmProblem(space, posed, {"left": Held(pressure), "right": Held(0.0)})
    solver = FilmSolver(space)
    (load,) = film_gradients(solver, solver.solve(problem), [LoadOutput()])
    x = space.vertices[:, 0]
    inside = (x > 0.0) & (x < 0.02)
    expected = 1.5 * pressure / height * (1.0 - 2.0 * x / 0.02)
    assert load.density[inside] == pytest.approx(expected[inside], rel=1e-9, abs=1e-6 * pressure / height)
    quarter = np.flatnonzero((np.abs(x - 0.005) < 1e-9) & (space.vertices[:, 1] == 0.0))[0]
    validation(
        case="Parallel film under pressure, adjoint",
        source="closed form dW/dh = 1.5 p/h (1 - 2 x/L)",
        quantity=f"load by film thickness at L/4, {cells} cells",
        unit="N/(mm2 um)",
        expected=1e-12 * 0.75 * pressure / height,
        obtained=1e-12 * load.density[quarter],
        relative_tolerance=1e-9,
    )
    assert load.uniform == pytest.approx(0.0, abs=1e-9 * pressure * 2e-4 / height)
    assert load.nodal.sum() == pytest.approx(load.uniform, abs=1e-9 * pressure * 2e-4 / height)


def test_density_does_not_depend_on_the_mesh():
    """In a slider the density at a place converges with the order of the film, nodal derivatives shrink."""
    found = []
    for cells in (32, 64, 128):
        space = film_space(rectangle((0.01, 0.01), (cells, 2), cell=Cell.QUADRILATERAL, periodic_y=True))
        posed = film(space.sample(lambda x, y: 1e-5 * (2.0 - x / 0.01)), VISCOSITY, velocity_moving=(HALF, ZERO))
        solver = FilmSolver(space)
        solution = solver.solve(FilmProblem(space, posed, {"left": Held(0.0), "right": Held(0.0)}))
        (load,) = film_gradients(solver, solution, [LoadOutput()])
        at = np.flatnonzero((np.abs(space.vertices[:, 0] - 0.005) < 1e-9) & (space.vertices[:, 1] == 0.0))
        found.append(float(load.density[at[0]]))
    first, second = abs(found[0] - found[1]), abs(found[1] - found[2])
    assert np.log2(first / second) == pytest.approx(2.0, abs=0.2)
    assert second < 2e-3 * abs(found[2])


HALF = np.full((1, 1), 0.5)


def test_derivatives_at_held_load(validation):
    """Loss at held load: against films whose separation is found anew."""
    solved = _solved(CASES["jfo"])
    gradients, growth = solved.gradients(), _growth(solved.problem.space)
    one, space = np.ones((1, 1)), solved.problem.space
    held = held_gradient(gradients["dissipation"], [gradients["load"]], [one])
    assert held_gradient(gradients["load"], [gradients["load"]], [one]).along(space.sample_vertices(growth)) == (
        pytest.approx(0.0, abs=1e-9 * abs(gradients["load"].uniform))
    )

    def loss(step: float) -> float:
        shift = 0.0
        for _ in range(8):
            found = loads(solved.along(step * growth + shift))
            shift -= (found.load - gradients["load"].value) / gradients["load"].uniform
        return found.dissipation

    step = 1e-4 * 50e-6
    expected = (loss(step) - loss(-step)) / (2.0 * step)
    validation(
        case="Journal bearing that keeps its load (JFO), adjoint",
        source="differences of films whose separation is found anew",
        quantity="dissipation by a random growth of the film",
        unit="W/um",
        expected=1e-6 * expected,
        obtained=1e-6 * held.along(space.sample_vertices(growth), growth),
        relative_tolerance=1e-5,
    )
    with pytest.raises(FilmInputError, match="as many coordinates"):
        held_gradient(gradients["dissipation"], [gradients["load"]], [np.zeros((1, 1))])


def test_derivatives_by_the_squeeze():
    solved = _solved(CASES["squeeze"])
    gradients, size = solved.gradients(), 1e-8
    more, less = (
        _values(solved.solver.solve(replace(solved.problem, film=replace(solved.problem.film, squeeze=changed))))
        for changed in (np.full((1, 1), -1e-4 + size), np.full((1, 1), -1e-4 - size))
    )
    for name in ("load", "flow.top", "dissipation", "friction_x"):
        expected = (more[name] - less[name]) / (2.0 * size)
        assert gradients[name].along(ZERO, None, np.ones((1, 1))) == pytest.approx(expected, rel=1e-6)


def test_large_soft_films_are_solved_without_a_dense_matrix(monkeypatch):
    """Beyond the dense limit GMRES takes the factor of rigid walls; the gradient is the same."""
    solved = _solved(CASES["soft"])
    dense = solved.gradients()
    monkeypatch.setattr("reynolds.adjoint.transposed.DENSE_LIMIT", 10)
    for name, gradient in solved.gradients().items():
        assert gradient.density == pytest.approx(
            dense[name].density, rel=1e-6, abs=1e-7 * abs(dense[name].density).max()
        )


@pytest.mark.parametrize("name", ["jfo", "jfo, four edges", "oil", "rough"])
def test_large_films_on_a_grid_are_solved_by_iteration(name, monkeypatch):
    solved = _solved(CASES[name])
    eliminated = solved.gradients()
    monkeypatch.setattr("reynolds.adjoint.transposed.LARGE", 10)
    monkeypatch.setattr("reynolds.adjoint.transposed.TransposedFilm._eliminated", None)
    for output, gradient in solved.gradients().items():
        expected = eliminated[output].density
        assert gradient.density == pytest.approx(expected, rel=1e-7, abs=1e-8 * np.abs(expected).max())


def test_unknowns_at_which_a_cavity_may_open_are_told():
    """A parallel film at the cavitation pressure neither bears nor lacks oil; the derivative is then one-sided."""
    space = film_space(rectangle((0.02, 0.01), (16, 4), cell=Cell.QUADRILATERAL))
    posed = film(np.full((1, 1), 2e-5), VISCOSITY, velocity_moving=(HALF, ZERO))
    solver = FilmSolver(space)
    held = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
    solution = solver.solve(FilmProblem(space, posed, held))
    weak = weakly_active(solution)
    assert weak.sum() == 15 * 3
    assert not (weak & solution.held).any()
    (load,) = film_gradients(solver, solution, [LoadOutput()])
    wedge = np.broadcast_to(space.points[0] - 0.01, space.area.shape)  # a film that widens along the motion cavitates
    steps = [loads(solver.solve(replace(
        solution.problem, film=replace(posed, thickness=2e-5 + sign * 1e-6 * wedge)
    ))).load for sign in (1.0, -1.0)]  # fmt: skip
    assert steps[0] == 0.0
    assert steps[1] == pytest.approx(-1e-6 * load.along(wedge), rel=0.01)
    for case in ("full", "reynolds", "jfo"):
        assert not weakly_active(_solved(CASES[case]).solution).any()


def test_films_without_the_output_are_refused():
    solved = _solved(CASES["jfo"])
    with pytest.raises(FilmInputError, match="one of bottom, top"):
        film_gradients(solved.solver, solved.solution, [FlowOutput("left")])
    with pytest.raises(FilmInputError, match="asperities"):
        film_gradients(solved.solver, solved.solution, [output_names(CASES["soft contact"].problem())["contact_load"]])
    still = Case(Cavitation.NONE, speed=0.0, sides=(0.0, 0.0)).problem()
    solver = FilmSolver(still.space)
    with pytest.raises(FilmInputError, match="friction_torque"):
        film_gradients(solver, solver.solve(still), [output_names(still)["friction"]])
    in_time = replace(solved.problem, storage=Storage(solved.solution.holds, 1e-3))
    with pytest.raises(FilmInputError, match="a steady film"):
        film_gradients(solved.solver, solved.solver.solve(in_time), [DissipationOutput()])
