"""Searches on problems whose best designs are known: Binh and Korn's (1997) and a parabola under a line."""

from dataclasses import dataclass, field
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import OptimizeResult

from reynolds.errors import NotConverged
from reynolds.numerics.cache import content_key
from system.description.keys import pump_keys
from system.inputs.faults import Fault, InputFaults
from system.pump_file.file import load_pump
from system.variation.measures import MEASURES, NUMBERS
from system.variation.optimisation.ending import ending
from system.variation.optimisation.evolution import evolve
from system.variation.optimisation.gradient import descend
from system.variation.optimisation.method import Method, usual_method
from system.variation.optimisation.optimum import optimise
from system.variation.optimisation.pareto import knee
from system.variation.optimisation.problem import Aim, Constraint, Objective, Problem, Varied
from system.variation.optimisation.trust_region import approach
from system.variation.scatter import Bound
from system.work.kept_results import KeptPoints
from system.work.processes import ProcessPool
from system.work.progress import silent
from system.work.tasks import PartStatus

KEYS = pump_keys(load_pump("ref90"))
X, Y = "slipper.mass", "piston.mass"
LOSS, DRAIN, TORQUE, PEAK = (MEASURES[name] for name in ("loss", "drain_flow", "shaft_torque", "chamber_pressure_peak"))


@dataclass(frozen=True)
class Toy:
    """Work whose numbers are functions of two dimensions, of the pump's own where nothing else is stated; asked: the
    variants that were solved."""

    functions: tuple
    own: tuple = (KEYS[X].value, KEYS[Y].value)
    asked: list = field(default_factory=list)
    solver = SimpleNamespace(cost=1e-3)
    pump = None
    sites = SimpleNamespace(points=(None,), weights=np.ones(1))

    def key(self, variant):
        return content_key("toy", repr(variant))

    def solve(self, variant):
        self.asked.append(variant)
        x, y = (dict(variant).get(name, own) for name, own in zip((X, Y), self.own, strict=True))
        if x < 0.0:
            raise InputFaults("toy", [Fault(X, f"{x:.3g} kg", "a mass")])
        if y < 0.0:
            raise NotConverged("no pump of such a mass")
        numbers = dict.fromkeys(NUMBERS, 0.0) | {name: float(of(x, y)) for name, of in self.functions}
        return {"numbers": [[numbers[name] for name in NUMBERS]], "warnings": []}


BINH_KORN = Toy(
    (
        ("loss", lambda x, y: 4.0 * x**2 + 4.0 * y**2),
        ("drain_flow", lambda x, y: (x - 5.0) ** 2 + (y - 5.0) ** 2),
        ("shaft_torque", lambda x, y: (x - 5.0) ** 2 + y**2),
        ("chamber_pressure_peak", lambda x, y: (x - 8.0) ** 2 + (y + 3.0) ** 2),
    )
)
LIMITS = (
    Constraint(TORQUE, Bound.MOST, 25.0, "shaft_torque <= 25"),
    Constraint(PEAK, Bound.LEAST, 7.7, "chamber_pressure_peak >= 7.7"),
)
TWO = (Objective(LOSS, Aim.LEAST), Objective(DRAIN, Aim.LEAST))


def problem(objectives=TWO, constraints=LIMITS, ends=((0.0, 5.0), (0.0, 3.0))):
    space = tuple(Varied(KEYS[path], *own) for path, own in zip((X, Y), ends, strict=True))
    return Problem(space, objectives, constraints, (LOSS, DRAIN, TORQUE, PEAK))


def solved(folder, asked, work, search, earlier=None):
    return optimise(work, asked, search, 1, folder, ProcessPool(1), silent, earlier)


def evolution(designs=40, generations=40, seed=1):
    return partial(evolve, designs=designs, generations=generations, seed=seed)


@pytest.fixture(scope="module")
def front(tmp_path_factory):
    """Binh and Korn's problem by evolution, and the folder of its results."""
    folder = tmp_path_factory.mktemp("binh_korn")
    return solved(folder, problem(), BINH_KORN, evolution()), folder


def distances(aims, exact):
    """Mean distances from the found designs to the exact front and from the exact front to the found designs.

    Generational distance and its inverse; each objective is scaled by its range on the exact front.
    """
    low, span = exact.min(axis=0), np.ptp(exact, axis=0)
    apart = np.linalg.norm(((aims - low) / span)[:, None] - ((exact - low) / span)[None], axis=-1)
    return apart.min(axis=1).mean(), apart.min(axis=0).mean()


def test_known_front(front):
    """The front lies on x = y up to (3, 3), then on y = 3: found designs are on it, and reach all of it."""
    found, _ = front
    members = [found.designs[at] for at in found.pareto.members]
    aims = found.problem.aims(members)
    along = np.linspace(0.0, 5.0, 2001)
    exact = np.array([[4.0 * x**2 + 4.0 * y**2, (x - 5.0) ** 2 + (y - 5.0) ** 2]
                      for x, y in zip(along, np.minimum(along, 3.0), strict=True)])  # fmt: skip
    off, left_out = distances(aims, exact)
    assert off < 0.005
    assert left_out < 0.01
    assert np.all(np.diff(aims[:, 0]) > 0.0)
    assert np.all(np.diff(aims[:, 1]) < 0.0)
    assert np.all(found.problem.feasible(members))


def test_growth_ends(front):
    """The hypervolume never falls, ends at one, and its last quarter adds little."""
    growth = front[0].pareto.growth
    assert growth.size == 40
    assert np.all(np.diff(growth) >= 0.0)
    assert growth[-1] == 1.0
    assert 0.0 <= front[0].pareto.late_growth < 0.01


def test_knee(front):
    """The knee is nearest to the ideal point of the scaled front: of x = y, f1 from 0 to 136 and f2 from 4 to 50."""
    found, _ = front
    place = found.designs[knee(found.problem, found.designs, found.pareto.members)].place
    x, y = (value for _, value in found.problem.variant(place))
    s = np.linspace(0.0, 3.0, 3001)
    ideal = s[np.argmin((8.0 * s**2 / 136.0) ** 2 + ((2.0 * (s - 5.0) ** 2 - 4.0) / 46.0) ** 2)]
    assert (x, y) == pytest.approx((ideal, ideal), abs=0.3)


def test_same_seed_and_resumed(front, tmp_path):
    """A search goes on from kept results to the same designs; another seed tries others."""
    found, folder = front
    for one in sorted(folder.glob("*.json"))[::2]:
        one.unlink()
    again = solved(tmp_path / "a", problem(), BINH_KORN, evolution(), KeptPoints(folder))
    assert np.array_equal([one.place for one in found.designs], [one.place for one in again.designs])
    assert found.pareto.members == again.pareto.members
    other = solved(tmp_path / "b", problem(), BINH_KORN, evolution(generations=1, seed=2))
    assert not np.array_equal(other.designs[1].place, found.designs[1].place)


def test_three_objectives(tmp_path):
    """Three squared distances: the best designs are those of the triangle of their centres, twice the same ones."""
    centres = ((1.0, 0.5), (4.0, 0.5), (2.5, 2.5))
    names = ("loss", "drain_flow", "shaft_torque")
    toy = Toy(
        tuple(
            (name, lambda x, y, c=c: (x - c[0]) ** 2 + (y - c[1]) ** 2) for name, c in zip(names, centres, strict=True)
        )
    )
    aims = tuple(Objective(MEASURES[name], Aim.LEAST) for name in names)
    first, second = (solved(tmp_path / name, problem(aims, ()), toy, evolution(generations=30)) for name in ("a", "b"))
    assert np.array_equal([one.place for one in first.designs], [one.place for one in second.designs])
    weights = np.array([(i, j, 60 - i - j) for i in range(61) for j in range(61 - i)]) / 60.0
    inside = weights @ np.array(centres)
    exact = np.sum((inside[:, None] - np.array(centres)[None]) ** 2, axis=-1)
    off, left_out = distances(first.problem.aims([first.designs[at] for at in first.pareto.members]), exact)
    assert off < 0.05
    assert left_out < 0.05


def test_most(tmp_path):
    """An objective that shall be most: the far corner."""
    toy = Toy((("loss", lambda x, y: x + y),))
    found = solved(tmp_path, problem((Objective(LOSS, Aim.MOST),), ()), toy, evolution(20, 30))
    assert found.designs[found.pareto.members[0]].numbers[0] == pytest.approx(8.0, rel=1e-2)


def test_gradient_meets_a_line(tmp_path):
    """(x - 2)^2 + (y - 1)^2 under x + y <= 2: the foot (1.5, 0.5) of the line, feasible, in some ten steps."""
    toy = Toy((("loss", lambda x, y: (x - 2.0) ** 2 + (y - 1.0) ** 2), ("drain_flow", lambda x, y: x + y)))
    asked = problem((Objective(LOSS, Aim.LEAST),), (Constraint(DRAIN, Bound.MOST, 2.0, "drain_flow <= 2"),))
    assert usual_method(asked, costly=False)[0] is Method.GRADIENT
    found = solved(tmp_path, asked, toy, partial(descend, step=1e-4, iterations=40))
    (best,) = found.pareto.members
    assert [value for _, value in found.problem.variant(found.designs[best].place)] == pytest.approx(
        (1.5, 0.5), abs=2e-3
    )
    assert len(found.designs) < 60


@pytest.mark.parametrize("level", [0.0, 1e-3])
def test_gradient_beside_designs_without_a_result(tmp_path, level):
    """A neighbour of the start has no result, which is no measure of an objective of a millionth, at any level."""
    lightest = KEYS[X].value

    def loss(x, y):
        if x > 1.001 * lightest:
            raise NotConverged("no pump of such a mass")
        return level + 1e-6 * (y - 2.0) ** 2

    asked = problem((Objective(LOSS, Aim.LEAST),), (), ((lightest, 5.0), (0.0, 3.0)))
    found = solved(tmp_path, asked, Toy((("loss", loss),)), partial(descend, step=1e-4, iterations=40))
    (best,) = found.pareto.members
    place = [value for _, value in found.problem.variant(found.designs[best].place)]
    assert place == pytest.approx((lightest, 2.0), abs=2e-2)


@pytest.mark.parametrize(
    ("few", "enough"),
    [
        (partial(descend, step=1e-4, iterations=1), partial(descend, step=1e-4, iterations=40)),
        (partial(approach, designs=8, last=1e-4), partial(approach, designs=200, last=1e-3)),
    ],
    ids=["gradient", "trust region"],
)
def test_a_search_tells_whether_it_has_settled(tmp_path, few, enough):
    toy = Toy((("loss", lambda x, y: 1.0 + (x - 4.0) ** 2 + (x - y) ** 2),))
    asked = problem((Objective(LOSS, Aim.LEAST),), ())
    broken, ended = solved(tmp_path / "few", asked, toy, few), solved(tmp_path / "enough", asked, toy, enough)
    assert (broken.ending.settled, broken.ending.out_of_steps) == (False, True)
    assert (ended.ending.settled, ended.ending.out_of_steps) == (True, False)
    assert solved(tmp_path / "evolution", asked, toy, evolution(8, 2)).ending is None


@pytest.mark.parametrize(("method", "own", "of_the_other"), [(Method.GRADIENT, 9, 5), (Method.TRUST_REGION, 5, 9)])
def test_steps_are_used_up_by_the_status_of_the_method_alone(method, own, of_the_other):
    """Status 5 of SLSQP is a singular matrix: more steps would not mend it."""
    told = [ending(OptimizeResult(success=False, status=status, message="it ends"), method) for status in
            (own, of_the_other)]  # fmt: skip
    assert [one.out_of_steps for one in told] == [True, False]


def test_choice_of_the_search():
    assert usual_method(problem(), costly=True)[0] is Method.EVOLUTION
    method, why = usual_method(problem(TWO[:1]), costly=False)
    assert method is Method.EVOLUTION
    assert why == "the slope of highest chamber pressure jumps, so derivatives mislead"
    method, why = usual_method(problem(TWO[:1]), costly=True)
    assert method is Method.TRUST_REGION
    assert "fewest of costly designs" in why


def test_limit_by_the_start(tmp_path):
    """A constraint of 1.5 times the start is that of its number."""
    toy = Toy((("loss", lambda x, y: 2.0 + x), ("drain_flow", lambda x, y: 5.0 - x)), (1.0, 1.0))
    limit = Constraint(LOSS, Bound.MOST, 0.0, "loss <= 1.5 start", 1.5)
    found = solved(tmp_path, problem((TWO[1],), (limit,)), toy, evolution(20, 30))
    assert found.problem.constraints[0].value == 4.5
    best = found.designs[found.pareto.members[0]]
    assert best.numbers[0] == pytest.approx(4.5, rel=1e-2)
    assert best.numbers[0] <= 4.5 * (1.0 + 1e-6)


def test_what_is_in_the_way(tmp_path):
    """No design has x + y >= 9 on a box up to 8; the other limit is met by all."""
    toy = Toy((("loss", lambda x, y: x + y), ("drain_flow", lambda x, y: 1.0)))
    limits = (Constraint(DRAIN, Bound.LEAST, 0.5, "b"), Constraint(LOSS, Bound.LEAST, 9.0, "a"))
    found = solved(tmp_path, problem((TWO[0],), limits), toy, evolution(20, 30))
    assert found.pareto.members == ()
    assert not found.pareto.growth.any()
    first, second = found.obstacles.rows
    assert (first.constraint.text, first.met, second.met) == ("a", 0, found.obstacles.solved)
    assert first.nearest == first.best == pytest.approx(8.0, rel=1e-2)
    assert first.violation == pytest.approx((9.0 - first.nearest) / 9.0)


def test_designs_without_a_result(tmp_path):
    """Refused and not converged designs are counted, have no part in the set, and do not stop the search."""
    ends = ((-2.0, 5.0), (-1.0, 3.0))
    found = solved(tmp_path, problem(ends=ends), BINH_KORN, evolution(20, 10))
    assert found.count(PartStatus.FAULTY) > 0
    assert found.count(PartStatus.NOT_CONVERGED) > 0
    assert all(found.designs[at].solved for at in found.pareto.members)
    assert len(found.pareto.members) > 5


def test_start_without_a_result(tmp_path):
    with pytest.raises(NotConverged, match="as stated"):
        solved(tmp_path, problem(), Toy(BINH_KORN.functions, (-1.0, -1.0)), evolution(20, 1))


def test_trust_region_meets_a_kinked_line(tmp_path):
    """(x - 2)^2 + (y - 1)^2 under max(x + y, 2 x) <= 2: the kink (1, 1), by a quadratic model in few designs."""
    functions = (
        ("loss", lambda x, y: 1.0 + (x - 2.0) ** 2 + (y - 1.0) ** 2),
        ("drain_flow", lambda x, y: max(x + y, 2 * x)),
    )
    asked = problem((Objective(LOSS, Aim.LEAST),), (Constraint(DRAIN, Bound.MOST, 2.0, "drain_flow <= 2"),))
    found = solved(tmp_path, asked, Toy(functions), partial(approach, designs=30, last=1e-3))
    (best,) = found.pareto.members
    place = [value for _, value in found.problem.variant(found.designs[best].place)]
    assert place == pytest.approx((1.0, 1.0), abs=0.03)
    assert len(found.designs) <= 30


def test_trust_region_past_designs_without_a_result(tmp_path):
    """The start beside masses below zero: refused designs turn the search back, and it ends where it should."""
    toy = Toy((("loss", lambda x, y: 1.0 + (x - 1.5) ** 2 + (y - 1.0) ** 2),))
    asked = problem((Objective(LOSS, Aim.LEAST),), (), ((-2.0, 5.0), (-1.0, 3.0)))
    found = solved(tmp_path, asked, toy, partial(approach, designs=60, last=1e-3))
    assert found.count(PartStatus.FAULTY) + found.count(PartStatus.NOT_CONVERGED) > 0
    (best,) = found.pareto.members
    place = [value for _, value in found.problem.variant(found.designs[best].place)]
    assert place == pytest.approx((1.5, 1.0), abs=0.05)


def test_trust_region_keeps_its_budget(tmp_path):
    toy = Toy((("loss", lambda x, y: 1.0 + (x - 4.0) ** 2 + (y - 2.0) ** 4),))
    asked = problem((Objective(LOSS, Aim.LEAST),), ())
    found = solved(tmp_path, asked, toy, partial(approach, designs=8, last=1e-4))
    assert len(found.designs) <= 8


@pytest.mark.parametrize("search", [partial(approach, designs=8, last=1e-4), partial(descend, step=1e-4, iterations=4)])
def test_the_start_is_solved_once(tmp_path, search):
    """The pump as stated sets the limits by the start and is the first design of a search from there."""
    toy = Toy((("loss", lambda x, y: 1.0 + (x - 4.0) ** 2 + (y - 2.0) ** 2),))
    found = solved(tmp_path, problem((Objective(LOSS, Aim.LEAST),), ()), toy, search)
    assert found.designs[0].numbers[0] == found.start.numbers[0]
    assert toy.asked.count(()) == 1
    assert tuple(zip((X, Y), toy.own, strict=True)) not in toy.asked
