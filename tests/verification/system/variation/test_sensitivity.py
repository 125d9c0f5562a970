"""Sensitivity of REF90: closed forms, the bench's own slopes, what the geometry refuses, means over a cycle."""

import numpy as np
import pytest

from reynolds.errors import NotConverged
from system import SIMULATED, BenchPoints, LumpedBench, base_parameters, load_pump, map_plan, tolerances
from system.bench.parameters import FILE_KEYS
from system.maps.duty import Cycle
from system.maps.plan import MapAxis, MapInput
from system.maps.point import LumpedSolver
from system.pump.laws.friction_pairs import Pair
from system.pump_file.file import varied
from system.variation.differences import Side, Verdict
from system.variation.measures import NUMBERS, Needs, measures_of
from system.variation.sensitivity import Accuracy, sensitivity, unit_change
from system.variation.sites import cycle_sites, plan_sites
from system.variation.solving import VariedWork, variable_keys
from system.work.kept_results import KeptPoints
from system.work.processes import ProcessPool
from system.work.progress import silent

PUMP = load_pump("ref90")
KEYS = variable_keys(PUMP)
MEASURES = measures_of(Needs.COURSE)
FINE = Accuracy(step=0.01, noise=1e-6, rounds=2)
LEVELS = (MapAxis(MapInput.SPEED, (100.0, 200.0)), MapAxis(MapInput.PRESSURE, (1e7, 2e7, 3e7)))


def found_by(folder, paths, sites, pump=PUMP, earlier=None):
    keys = variable_keys(pump)
    work = VariedWork(pump, LumpedSolver(), sites)
    chosen = {path: keys[path] for path in paths}
    return sensitivity(work, chosen, MEASURES, FINE, folder, ProcessPool(1), silent, earlier)


@pytest.fixture(scope="module")
def at_point(tmp_path_factory):
    return found_by(tmp_path_factory.mktemp("point"), KEYS, plan_sites(map_plan(PUMP, ())))


def of(found, path, measure):
    """Derivative and value of a measure."""
    at = found.place(measure)
    row = next(one for one in found.slopes if one.key.path == path)
    assert row.verdict[at] is Verdict.SMOOTH
    return row.value[at], found.middle[at]


@pytest.mark.parametrize(
    ("path", "leakage", "power"),
    [
        ("valve_plate.film_thickness", "valve_plate", 3.0),
        ("slipper.film_thickness", "slipper", 3.0),  # but for the share of its orifice
    ],
)
def test_leakage_goes_with_the_cube(at_point, path, leakage, power):
    slope, value = of(at_point, path, f"leakage.{leakage}")
    assert slope * KEYS[path].value / value == pytest.approx(power, rel=2e-3)


def test_leakage_of_an_eccentric_piston(at_point):
    """(1 + 1.5 eps^2) of the concentric one, beside the drag flow of the piston."""
    leak = KEYS["piston.eccentricity_ratio"].value
    by_eccentricity, _ = of(at_point, "piston.eccentricity_ratio", "leakage.piston")
    by_clearance, value = of(at_point, "piston.radial_clearance", "leakage.piston")
    pressure_flow = by_eccentricity * (1.0 + 1.5 * leak**2) / (3.0 * leak)
    assert by_clearance * KEYS["piston.radial_clearance"].value == pytest.approx(
        3.0 * pressure_flow + (value - pressure_flow), rel=1e-3
    )


def test_friction_is_proportional_to_its_coefficient(at_point):
    from system import lumped_point, operating_point

    pairs = lumped_point(PUMP, operating_point(PUMP)).pairs
    for pair in Pair:
        path = f"friction.{pair.value}"
        slope, _ = of(at_point, path, "loss")
        assert slope * KEYS[path].value == pytest.approx(pairs.loss(pair).mean_coulomb, rel=1e-6)


def test_what_no_fidelity_of_given_films_reads_has_no_effect(at_point):
    row = next(one for one in at_point.slopes if one.key.path == "valve_plate.waviness.amplitude")
    assert all(one is Verdict.NO_EFFECT for one in row.verdict)


def test_what_the_geometry_refuses(at_point):
    side = {one.key.path: one.stencil.side for one in at_point.slopes}
    assert side["valve_plate.land_radius_2"] is Side.BELOW
    assert side["valve_plate.land_radius_3"] is Side.ABOVE
    refused = {one.key.path: one.reason for one in at_point.refused}
    assert {"bearings.front_share", "bearings.rear_share"} < set(refused)
    assert "shares that sum to 1" in refused["bearings.front_share"]


def test_agrees_with_the_slopes_of_the_bench(tmp_path):
    """`LumpedBench.slopes`, differences along the steps of one solution, of every parameter that is a key.

    Those of the gaps are to first order (`other_gaps`), good to 1 %, and forward: their error is of the step.
    """
    sites = plan_sites(map_plan(PUMP, LEVELS))
    found = found_by(tmp_path, [path for path in FILE_KEYS.values() if path in KEYS], sites)
    parameters = base_parameters(PUMP, tolerances(PUMP)[0])
    values = np.array([one.centre for one in parameters])
    column = {name: np.array([getattr(point, name) for point in sites.points]) for name in vars(sites.points[0])}
    none = np.zeros(len(sites.points))
    points = BenchPoints(
        speed=column["shaft_speed"], displacement_ratio=column["displacement_ratio"],
        p_out=column["delivery_pressure"], p_in=column["inlet_pressure"], p_case=column["case_pressure"],
        T_case=column["temperature"], T_in=column["temperature"], hours=none, order=none,
        warming=none,
    )  # fmt: skip
    bench = LumpedBench(PUMP, points, SIMULATED, parameters, samples_per_pitch=40, tolerance=1e-9)
    places = [NUMBERS.index(name) for name in ("delivery_flow", "inlet_flow", "drain_flow", "shaft_torque")]
    names = [one.name for one in parameters if FILE_KEYS.get(one.name) in {row.key.path for row in found.slopes}]
    assert len(names) == 14
    slopes = bench.slopes(values, tuple(names))
    for at, name in enumerate(names):
        row = next(one for one in found.slopes if one.key.path == FILE_KEYS[name])
        own = row.sites[:, places]
        largest = np.abs(own).max(axis=0)
        assert np.all(np.abs(slopes[:, :, at] - own) <= 0.015 * largest + 1e-6 * np.abs(own).max()), name


def test_means_over_a_cycle(tmp_path):
    """A cycle that stays at a level is that point; one that is half of the time at either, their mean."""
    path = "slipper.film_thickness"
    axes = (MapAxis(MapInput.PRESSURE, (1e7, 2e7, 3e7)),)
    plan = map_plan(PUMP, axes)
    each = found_by(tmp_path / "each", [path], plan_sites(plan)).slopes[0].sites[:, NUMBERS.index("drain_flow")]

    def drain(pressures):
        cycle = Cycle(np.array([0.0, 1.0, 1.0, 2.0]), {MapInput.PRESSURE: np.array(pressures)})
        return of(found_by(tmp_path / "cycle", [path], cycle_sites(plan, cycle)), path, "drain_flow")[0]

    assert drain([3e7] * 4) == pytest.approx(each[2], rel=1e-9)
    assert drain([1e7, 1e7, 3e7, 3e7]) == pytest.approx(0.5 * (each[0] + each[2]), rel=1e-9)


def test_oil_warms_and_cools_the_points():
    """Viscosity of the point is that of the varied oil."""
    sites = plan_sites(map_plan(PUMP, ()))
    thick = varied(PUMP, (("oil.density", 1.1 * PUMP.oil.density),))
    assert sites.of(thick)[0].viscosity == pytest.approx(1.1 * sites.points[0].viscosity)


def test_nothing_is_solved_twice(tmp_path):
    sites = plan_sites(map_plan(PUMP, ()))
    first = found_by(tmp_path / "one", ["oil.density"], sites)
    kept = KeptPoints(tmp_path / "one")
    again = found_by(tmp_path / "two", ["oil.density"], sites, earlier=kept)
    assert len(list((tmp_path / "two").glob("*.json"))) == first.solved
    assert again.seconds == first.seconds  # as they were kept
    assert np.array_equal(first.slopes[0].value, again.slopes[0].value)


def test_a_pump_without_a_result_is_no_sensitivity(tmp_path, monkeypatch):
    def fails(self, pump, point):
        raise NotConverged("no periodic revolution")

    monkeypatch.setattr(LumpedSolver, "solve", fails)
    with pytest.raises(NotConverged, match="as stated: no periodic revolution"):
        found_by(tmp_path, ["oil.density"], plan_sites(map_plan(PUMP, ())))


def test_a_pump_that_fails_has_a_smaller_step(tmp_path, monkeypatch):
    """The next stencil that the geometry admits; where none is left, the reason."""
    whole, own = LumpedSolver.solve, PUMP.slipper.film_thickness

    def fails_far_off(self, pump, point):
        if abs(pump.slipper.film_thickness - own) > 0.005 * own or pump.oil.density != PUMP.oil.density:
            raise NotConverged("walls apart")
        return whole(self, pump, point)

    monkeypatch.setattr(LumpedSolver, "solve", fails_far_off)
    found = found_by(tmp_path, ["slipper.film_thickness", "oil.density"], plan_sites(map_plan(PUMP, ())))
    assert [one.stencil.step for one in found.slopes] == [pytest.approx(0.0025 * own)]
    assert [(one.key.path, one.reason) for one in found.refused] == [("oil.density", "not converged: walls apart")]


def test_changes_that_people_ask_for():
    assert unit_change(KEYS["slipper.film_thickness"]) == 1e-6
    assert unit_change(KEYS["ports.groove_start"]) == pytest.approx(np.radians(1.0))
    assert unit_change(KEYS["oil.bulk_modulus"]) == pytest.approx(16e6)
    assert unit_change(KEYS["ball_guide.spring_stiffness"]) == pytest.approx(200.0)
