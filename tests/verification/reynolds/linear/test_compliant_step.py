"""Film equation: steps between elastic walls.

A step by a few solves of the rigid film, and a wall cut to its largest motions, against dense matrices and closed
forms.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from reynolds import (
    ZERO,
    Array,
    Asperities,
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
    Supports,
    block,
    body_wall,
    both,
    film,
    film_space,
    half_space,
    loads,
    march,
    rectangle,
    winkler,
)
from reynolds.bodies.compliance import LowRank
from reynolds.bodies.wall import face_wall
from reynolds.linear import elastic as compliant
from reynolds.linear.elastic import WallBalance, compliant_answer
from reynolds.numerics.gmres import gmres
from reynolds.solve import solver as solve

LENGTH, WIDE, GAP, VISCOSITY = 10e-3, 2.5e-3, 5e-6, 0.03
STIFFNESS, HIGH = 1e13, 30e6
BRONZE = Elastic(110e9, 0.34)
TOUCHING = Asperities(2e10, 5e-6, 0.3e-6, 100e9, 0.1, summit_height=0.3e-6)


@pytest.fixture
def by_gmres(monkeypatch):
    """Steps by GMRES from 200 free pressures on, as films of more than DENSE_LIMIT take them."""
    monkeypatch.setattr(compliant, "DENSE_LIMIT", 200)


def product(matrix: Array) -> LowRank:
    """The same matrix as a product of full rank."""
    return LowRank(matrix, np.eye(matrix.shape[1]))


@pytest.mark.parametrize("form", ["dense", "product"])
def test_winkler_channel_with_many_unknowns(form, validation, by_gmres):
    space = film_space(rectangle((LENGTH, WIDE), (40, 12), cell=Cell.QUADRILATERAL, periodic_y=True))
    assert space.size > compliant.DENSE_LIMIT
    full = winkler(space, STIFFNESS).matrix.toarray()
    walls = Compliance(full if form == "dense" else product(full))
    ends = {"left": Held(HIGH), "right": Held(0.0)}
    found = FilmSolver(space).solve(FilmProblem(space, film(GAP, VISCOSITY), ends, walls=walls))
    validation(
        case="Channel on Winkler's foundation",
        source="closed form",
        quantity=f"flow per width, {space.size} unknowns, steps by GMRES, walls as {form} matrix",
        unit="m2/s",
        expected=STIFFNESS / (48.0 * VISCOSITY * LENGTH) * ((GAP + HIGH / STIFFNESS) ** 4 - GAP**4),
        obtained=loads(found).flow["right"] / WIDE,
        relative_tolerance=1e-11,
        note="exact on any mesh",
    )
    assert found.iterations <= 5


def soft_bearing(space: FilmSpace, walls: Compliance | None) -> FilmProblem:
    """A film that narrows, widens and ruptures between sides at zero pressure."""
    x, y = space.points
    thickness = 1.5e-6 * (1.0 + 6.0 * (x / LENGTH - 0.5) ** 2 + 2.0 * (y / LENGTH - 0.5) ** 2)
    ends = dict.fromkeys(("left", "right", "top", "bottom"), Held(0.0))
    posed = film(thickness, VISCOSITY, velocity_moving=(np.full((1, 1), 3.0), ZERO))
    return FilmProblem(space, posed, ends, Cavitation.JFO, walls=walls)


@dataclass(frozen=True)
class Counted:
    """Walls that count how often their compliance is asked."""

    matrix: CountedMatrix


class CountedMatrix(LowRank):
    """A product that counts its uses."""

    uses = 0

    def __matmul__(self, pressure: Array) -> Array:
        CountedMatrix.uses += 1
        return super().__matmul__(pressure)


def solved(space: FilmSpace, walls: object) -> tuple[FilmSolution, float]:
    """The film of a second wall speed from that of a first, and uses of the compliance a step."""
    solver = FilmSolver(space)
    first = solver.solve(soft_bearing(space, walls))
    CountedMatrix.uses = 0
    faster = replace(first.problem.film, velocity_moving=(np.full((1, 1), 3.3), ZERO))
    found = solver.solve(replace(first.problem, film=faster), first)
    return found, CountedMatrix.uses / found.iterations


def test_solves_a_step_do_not_grow_with_the_mesh(monkeypatch, by_gmres):
    """A film smooths what the wall feeds back: with finer cells no more solves; pressures as by dense."""
    monkeypatch.setattr(solve, "KEPT", 0.0)  # each step by a balance of its own
    uses = []
    for n in (20, 36):
        space = film_space(rectangle((LENGTH, LENGTH), (n, n), cell=Cell.QUADRILATERAL))
        matrix = half_space(space, Elastic(30e9, 0.3)).matrix
        found, each = solved(space, Counted(CountedMatrix(matrix, np.eye(space.size))))
        assert found.cavity.any()
        uses.append(each)
        if n == 20:
            with monkeypatch.context() as at_once:
                at_once.setattr(compliant, "DENSE_LIMIT", 10**6)
                dense, _ = solved(space, Compliance(matrix))
            assert dense.iterations == found.iterations
            assert found.pressure == pytest.approx(dense.pressure, abs=1e-9 * dense.pressure.max())
            assert found.film_fraction == pytest.approx(dense.film_fraction, abs=1e-9)
    assert uses[1] < 1.2 * uses[0] < 80.0


def test_gmres_keeps_its_tolerance_and_ends():
    random = np.random.default_rng(5)
    matrix = np.eye(60) + 0.5 * random.normal(size=(60, 60)) / np.sqrt(60.0)
    load = random.normal(size=60)
    for tolerance in (1e-2, 1e-6, 1e-12):
        found, left = gmres(lambda v: matrix @ v, load, tolerance, 60)
        assert left <= tolerance
        missed = np.linalg.norm(matrix @ found - load) / np.linalg.norm(load)
        assert missed == pytest.approx(left, rel=1e-2, abs=1e-14)
    found, left = gmres(lambda v: matrix @ v, load, 0.0, 60)  # the whole space
    assert found == pytest.approx(np.linalg.solve(matrix, load), rel=1e-10)
    found, left = gmres(lambda v: matrix @ v, load, 1e-12, 5)
    least = [np.linalg.matrix_power(matrix, k) @ load for k in range(5)]  # the best of Krylov's space, no better
    best = np.linalg.lstsq(matrix @ np.array(least).T, load, rcond=None)[0]
    assert found == pytest.approx(np.array(least).T @ best, rel=1e-8)
    assert left == pytest.approx(np.linalg.norm(matrix @ found - load) / np.linalg.norm(load), rel=1e-9)
    found, left = gmres(lambda v: 3.0 * v, load, 1e-12, 60)  # an eigenvector: there at once
    assert left == 0.0
    assert found == pytest.approx(load / 3.0)
    assert np.array_equal(gmres(lambda v: v, np.zeros(4), 1e-12, 4)[0], np.zeros(4))


def linear_balance(size: int) -> tuple[csc_array, csr_array, Array, Array]:
    """Any balance: a Laplacian, a slope as long as itself, a compliance, and unknowns of which some are held."""
    random = np.random.default_rng(3)
    rigid = csc_array(2.0 * np.eye(size) - np.eye(size, k=1) - np.eye(size, k=-1))
    slope = csr_array(np.eye(size) - np.eye(size, k=1))
    bends = np.exp(-np.abs(np.subtract.outer(np.arange(size), np.arange(size))) / 30.0)
    return rigid, slope, bends, (random.uniform(size=size) > 0.1).astype(float)


@pytest.mark.parametrize("size", [50, 500])
@pytest.mark.parametrize("form", [np.asarray, csr_array, product])
def test_any_load_is_answered(size, form, by_gmres):
    rigid, slope, bends, free = linear_balance(size)
    answer = compliant_answer(WallBalance(rigid, slope, form(bends), free))
    full = rigid.toarray() + slope.toarray() @ bends * free
    for load in (np.ones(size), np.random.default_rng(1).normal(size=size), np.zeros(size)):
        left = np.linalg.norm(full @ answer(load, 1e-11) - load)
        assert left <= 1e-10 * np.linalg.norm(load)


@dataclass(frozen=True)
class Resisted:
    """A compliance that contact resists, multiplied out."""

    compliance: Array
    contact: csr_array

    @property
    def whole(self) -> Array:
        size = len(self.compliance)
        return np.linalg.solve(np.eye(size) - self.compliance @ self.contact.toarray(), self.compliance)

    def __matmul__(self, pressure: Array) -> Array:
        return self.whole @ pressure

    def columns(self, unknowns: Array) -> Array:
        return self.whole[:, unknowns]


def test_contact_within_the_factor():
    """Pressures of oil and contact together need no compliance that contact resists; in cavities, too."""
    rigid, slope, bends, free = linear_balance(60)
    random = np.random.default_rng(4)
    touching = random.choice(60, 25, replace=False)
    assert (free[touching] == 0.0).any()
    contact = csr_array((-random.uniform(size=25), (touching, touching)), shape=(60, 60))
    wider = Resisted(0.1 * bends, contact)
    answer = compliant_answer(WallBalance(rigid, slope, wider, free))
    full = rigid.toarray() + slope.toarray() @ wider.whole * free
    for load in (random.normal(size=60), random.normal(size=(60, 3))):
        assert full @ answer(load, 1e-11) == pytest.approx(load, abs=1e-12)


def test_a_balance_that_iterates_badly_is_factorised(monkeypatch, by_gmres):
    rigid, slope, bends, free = linear_balance(500)
    monkeypatch.setattr(compliant, "MOST_STEPS", 3)
    answer = compliant_answer(WallBalance(rigid, slope, product(bends), free))
    full = rigid.toarray() + slope.toarray() @ bends * free
    load = np.random.default_rng(2).normal(size=500)
    assert answer(load, 1e-11) == pytest.approx(np.linalg.solve(full, load), rel=1e-8, abs=1e-8)
    stuck = csc_array(np.diag(np.r_[0.0, np.ones(499)]))  # what the rigid balance leaves open, the walls close
    by_walls = compliant_answer(WallBalance(stuck, csr_array(np.eye(500)), np.eye(500), np.ones(500)))
    assert by_walls(np.ones(500), 1e-11)[0] == pytest.approx(1.0)


@pytest.mark.parametrize("form", [np.asarray, csr_array, product])
@pytest.mark.parametrize("size", [50, 500])
def test_a_singular_balance_is_refused(form, size):
    nothing = csc_array((size, size))
    with pytest.raises(FilmNotConverged, match=r"singular.*Try: stiffer walls"):
        compliant_answer(WallBalance(nothing, csr_array((size, size)), form(np.eye(size)), np.ones(size)))(
            np.ones(size), 1e-11
        )


def plate(space: FilmSpace, cells: int) -> Body:
    thick = 3e-3
    mesh = block((LENGTH, LENGTH, thick), (cells, cells, 1), origin=(0.0, 0.0, -thick))
    return Body(mesh, BRONZE, Supports(clamped=("left", "right")), "top", Plane((0.0, 0.0, 1.0)))


def test_a_wall_by_its_face_is_the_same_wall():
    space = film_space(rectangle((LENGTH, LENGTH), (14, 14), cell=Cell.QUADRILATERAL))
    one, two = plate(space, 3), replace(plate(space, 2), elastic=Elastic(210e9, 0.3))
    thin, other = face_wall(one, space), face_wall(two, space)
    full = Compliance(body_wall(one, space).matrix)
    assert thin.matrix.rank < 0.25 * space.size
    assert thin.matrix.shape == (len(space.vertices), space.size)
    assert thin.matrix.toarray() == pytest.approx(full.matrix, rel=1e-12, abs=1e-20)
    whole = both(full, Compliance(other.matrix.toarray())).matrix
    sums = {
        "products": both(thin, other),
        "product and matrix": both(full, other),
        "and springs": both(both(thin, other), winkler(space, 1e28)),
    }
    assert sums["products"].matrix.rank == thin.matrix.rank + other.matrix.rank
    some = np.random.default_rng(1).normal(size=space.size)
    for name, found in sums.items():
        close = 1e-10 * np.abs(whole @ some).max()
        assert found.matrix @ some == pytest.approx(whole @ some, abs=close), name
    dense, by_face = (
        FilmSolver(space).solve(soft_bearing(space, walls)) for walls in (Compliance(whole), sums["products"])
    )
    assert by_face.pressure == pytest.approx(dense.pressure, abs=1e-9 * dense.pressure.max())


def test_rough_walls_that_touch_give_way_alike_in_any_form():
    """Contact within the compliance: a product of low rank against the matrix multiplied out."""
    space = film_space(rectangle((LENGTH, LENGTH), (21, 21), cell=Cell.QUADRILATERAL))
    by_face = face_wall(plate(space, 3), space).matrix
    found = []
    for matrix in (by_face, by_face.toarray()):
        soft = soft_bearing(space, Compliance(matrix))
        slow = (np.full((1, 1), 0.1), ZERO)
        near = replace(soft.film, thickness=soft.film.thickness - 1.4e-6, velocity_moving=slow)
        found.append(FilmSolver(space).solve(replace(soft, film=near, asperities=TOUCHING)))
    assert loads(found[0]).contact_load > 1.0
    assert found[0].deformation == pytest.approx(found[1].deformation, abs=1e-9 * found[1].deformation.max())
    assert loads(found[0]).contact_load == pytest.approx(loads(found[1]).contact_load, rel=1e-8)


def test_mass_in_time_between_walls_of_low_rank():
    """The inflow equals the growth of the content, d(Cp)/dt included, at every step."""
    space = film_space(rectangle((LENGTH, LENGTH), (21, 21), cell=Cell.QUADRILATERAL))
    walls = Compliance(face_wall(plate(space, 3), space).matrix)

    def problem(t: float) -> FilmProblem:
        soft = soft_bearing(space, walls)
        return replace(soft, film=replace(soft.film, thickness=soft.film.thickness * (1.0 - 0.2 * t / 1e-3)))

    before = None
    for instant in march(FilmSolver(space), problem, 1e-3, 2.5e-4):
        found = instant.solution
        if before is not None:
            entered = -found.outflow[found.held].sum()
            grown = (found.holds.sum() - before.holds.sum()) / instant.step
            assert entered == pytest.approx(grown, abs=1e-12 * np.abs(found.flow_scale).sum())
        before = found
