"""Operating maps: what names a point, what is made of its numbers, and interpolation between the levels."""

from dataclasses import is_dataclass, replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from bench_pump import BENCH
from scipy.interpolate import NdBSpline

from reynolds import InputError
from swashfilm.output.warnings import causes
from system import InputFaults, load_pump, lumped_point, map_plan, operating_point
from system.inputs.sections.fields import fields_of
from system.maps.compare import compare
from system.maps.data import LOSSES, best_points, map_data, warning_counts
from system.maps.duty import Cycle, duty
from system.maps.interpolation import MapInterpolant, axis_spline, check_points, fresh_error, left_out_error, weights
from system.maps.plan import MapAxis, MapInput
from system.maps.point import DirectSolver, LumpedSolver, MapWork, point_numbers
from system.maps.usual_levels import usual_axes
from system.points.floating_gaps import FloatingOptions
from system.points.table.sources import FloatingSolver
from system.pump.efficiency import EfficiencyDefinition
from system.work.tasks import PartStatus, done_part

PUMP = load_pump(BENCH)
RPM = np.pi / 30.0
AXES = (
    MapAxis(MapInput.SPEED, tuple(RPM * speed for speed in (1000.0, 1400.0, 1800.0, 2100.0))),
    MapAxis(MapInput.PRESSURE, (5e6, 12e6, 20e6, 28e6, 35e6)),
    MapAxis(MapInput.RATIO, (0.5, 0.75, 1.0)),
)


@cache
def solved(axes=AXES, pump=PUMP):
    plan, work = map_plan(pump, axes), MapWork(pump, LumpedSolver())
    return map_data(plan, work.solver.words, tuple(done_part(work, point) for point in plan.points))


@cache
def fresh(first, count):
    points = check_points(map_plan(PUMP, AXES), first + count)[first:]
    solver = LumpedSolver()
    rows = [point_numbers(solver.solve(PUMP, point)) for point in points]
    return points, {head.partition(" [")[0]: np.array([row[head] for row in rows]) for head in rows[0]}


def test_the_papers_plan_has_112_points():
    plan = map_plan(PUMP, usual_axes(PUMP))
    assert plan.shape == (4, 7, 4, 1, 1)
    assert len(plan.points) == 112
    assert plan.points[0].inlet_pressure == PUMP.operating.inlet_pressure
    assert plan.points[1].displacement_ratio == 0.51
    assert plan.checked().faults == ()


@pytest.mark.parametrize(
    ("speed", "pressure", "speeds", "pressures"),
    [
        ("2100 rpm", "35 MPa", [1000, 1300, 1700, 2100], [5, 10, 15, 20, 25, 30, 35]),
        ("2600 rpm", "28 MPa", [1250, 1600, 2100, 2600], [4, 8, 12, 16, 20, 24, 28]),
        ("3333 rpm", "25 MPa", [1600, 2050, 2700, 3333], [3.5, 7, 10.5, 14.5, 18, 21.5, 25]),
        ("600 rpm", "6 MPa", [285, 370, 485, 600], [2.55, 3.45, 4.3, 5.15, 6]),  # above the inlet's 2.5 MPa
    ],
)
def test_usual_levels_are_the_papers_shares_of_the_rating(speed, pressure, speeds, pressures):
    stated = {"pump.rated_speed": speed, "pump.rated_pressure": pressure}
    pump = load_pump("ref90", stated | {"operating.speed": speed, "operating.pressure": pressure})
    axes = usual_axes(pump)
    np.testing.assert_allclose(np.array(axes[0].values) / RPM, speeds, rtol=1e-12)
    np.testing.assert_allclose(np.array(axes[1].values) / 1e6, pressures, rtol=1e-12)
    report = map_plan(pump, axes).checked()
    assert not report.faults
    assert not {"operating.speed", "operating.pressure"} & set(report.warnings)


def test_faults_of_points_are_told_once_before_any_is_solved():
    axes = (MapAxis(MapInput.PRESSURE, (1e6, 20e6)), MapAxis(MapInput.SPEED, (100.0, 150.0, 900.0)))
    found = map_plan(PUMP, axes).checked()
    assert [fault.path for fault in found.faults] == ["operating.pressure"]
    told = next(one for one in causes(found.warnings.values()) if one.name == "operating.speed")
    assert told.title == "Above the rated speed"
    assert told.texts[0].startswith("at 2 of 6 points; at the first: 8594 rpm, limit rated_speed, 2100 rpm")
    assert told.remedies == ("stay below it, or state a higher rated_speed where the pump is made for it",)
    for values in ((), (2.0, 1.0), (1.0, 1.0)):
        with pytest.raises(InputError, match="rise"):
            MapAxis(MapInput.RATIO, values)


def test_a_map_counts_the_points_far_below_the_speeds_of_the_coefficients():
    speeds = MapAxis(MapInput.SPEED, tuple(RPM * speed for speed in (20.0, 500.0, 2100.0)))
    count, text = warning_counts(solved((speeds,)))["friction_at_low_speed"]
    assert count == 1
    assert "turns at 20 rpm (limit 500 rpm: half of 1000 rpm" in text


def numbers_of(model, path=()):
    for name in fields_of(type(model)):
        value = getattr(model, name)
        if is_dataclass(value):
            yield from numbers_of(value, (*path, name))
        elif isinstance(value, float):
            yield (*path, name), value


def with_number(model, path, value):
    inner = value if len(path) == 1 else with_number(getattr(model, path[0]), path[1:], value)
    return replace(model, **{path[0]: inner})


def test_what_changes_a_point_changes_its_name():
    """Every number of the pump file by 1 %: where the result is another, so is the key."""
    pump = load_pump("ref90")
    point = operating_point(pump, delivery_pressure=20e6, displacement_ratio=0.77)
    solver = LumpedSolver()

    def told(changed):
        at = operating_point(changed, delivery_pressure=20e6, displacement_ratio=0.77)
        return MapWork(changed, solver).key(at), np.array(list(point_numbers(solver.solve(changed, at)).values()))

    key, result = MapWork(pump, solver).key(point), told(pump)[1]
    changed = 0
    for path, value in numbers_of(pump):
        if path[0] == "tolerance":
            continue
        other = with_number(pump, path, value * 0.99 if value else 1e-3)
        try:
            other_key, other_result = told(other)
        except (ValueError, InputError):
            continue  # no pump any more
        if not np.array_equal(other_result, result):
            changed += 1
            assert other_key != key, ".".join(path)
    assert changed > 40
    same = replace(pump, name="other")
    assert MapWork(same, solver).key(point) == key
    assert MapWork(pump, solver).key(replace(point, shaft_speed=point.shaft_speed * 1.01)) != key


def test_a_map_holds_what_its_points_have():
    data = solved()
    index = (3, 4, 2, 0, 0)
    point = lumped_point(PUMP, operating_point(PUMP, shaft_speed=2100 * RPM, delivery_pressure=35e6))
    assert data.values["shaft_torque"][index] == point.bench.shaft_torque
    assert data.values["pair_loss.slipper_swash_plate"][index] == point.pairs.slipper_swash_plate.mean
    paper = data.efficiency(EfficiencyDefinition.PAPER)
    assert paper.overall[index] == point.paper_efficiency.overall
    assert paper.volumetric[index] == point.paper_efficiency.volumetric
    swept = data.efficiency(EfficiencyDefinition.ISO_SWEPT)
    assert swept.hydromechanical[index] == point.iso_efficiency.hydromechanical
    total = sum(data.values[column] for column in LOSSES)
    np.testing.assert_allclose(total, data.loss, rtol=1e-3)
    best = {one.definition: one for one in best_points(data)}
    assert best[EfficiencyDefinition.PAPER].overall == paper.overall.max()


def test_displacement_by_toet_is_below_the_swept_one():
    """The lumped REF90's own numbers; leakage that grows with pressure alone leaves the swept displacement."""
    derived = solved().toet[2, 0, 0].value
    assert derived == pytest.approx(88.25e-6, abs=0.02e-6)
    assert solved().values["swept_displacement"][0, 0, 2, 0, 0] == pytest.approx(88.61e-6, abs=0.01e-6)
    assert solved((MapAxis(MapInput.PRESSURE, (10e6, 20e6)),)).toet == {}


def test_a_failed_point_leaves_a_gap():
    plan, work = map_plan(PUMP, AXES[1:2]), MapWork(PUMP, LumpedSolver())
    outcomes = [done_part(work, point) for point in plan.points]
    outcomes[2] = replace(outcomes[2], status=PartStatus.NOT_CONVERGED, reason="it stalls", record={})
    data = map_data(plan, work.solver.words, tuple(outcomes))
    assert np.sum(data.solved) == 4
    assert np.isnan(data.efficiency(EfficiencyDefinition.PAPER).overall[0, 2, 0, 0, 0])
    with pytest.raises(InputFaults, match="1 of 5 points without a result, the first: it stalls"):
        MapInterpolant(data)


@pytest.mark.parametrize(("levels", "degree"), [(2, 1), (3, 2), (4, 3), (7, 3)])
def test_weights_hold_polynomials(levels, degree):
    places = np.sort(np.random.default_rng(1).uniform(10.0, 30.0, levels))
    axis = MapAxis(MapInput.RATIO, tuple(places))
    x = np.linspace(places[0], places[-1], 11)
    for power in range(degree + 1):
        np.testing.assert_allclose(weights(axis, x) @ places**power, x**power, rtol=1e-9)


def test_coefficients_are_those_of_the_splines():
    interpolant, random = MapInterpolant(solved()), np.random.default_rng(2)
    splines = [axis_spline(axis) for axis in AXES]
    points = np.stack([random.uniform(axis.values[0], axis.values[-1], 20) for axis in AXES], axis=-1)
    ends = np.array([[axis.values[0], axis.values[-1]] for axis in AXES]).T
    coefficients = interpolant.coefficients("drain_flow")[..., 0, 0]
    spline = NdBSpline(tuple(one.knots for one in splines), coefficients, tuple(one.degree for one in splines))
    told = interpolant.at(dict(zip((axis.input for axis in AXES), points.T, strict=True)))
    np.testing.assert_allclose(spline((points - ends[0]) / np.ptp(ends, axis=0)), told["drain_flow"], rtol=1e-12)


def test_between_levels_the_stated_error_holds():
    """Errors told by some fresh points bound those at others; inner levels left out bound them without any."""
    interpolant = MapInterpolant(solved())
    points, found = fresh(0, 24)
    error = fresh_error(interpolant, points, found)
    others, truth = fresh(24, 24)
    told = interpolant.at({given: np.array([getattr(one, given.value) for one in others]) for given in MapInput})
    for name in ("shaft_power", "hydraulic_power", "shaft_torque", "delivery_flow"):
        off = np.abs(told[name] - truth[name])
        assert np.mean(off <= error.largest[name]) >= 0.9
        assert error.largest[name] <= 1e-3 * np.abs(truth[name]).max()
        assert left_out_error(solved()).largest[name] >= error.rms[name]
    at_level = interpolant.at({MapInput.SPEED: 1400 * RPM, MapInput.PRESSURE: 12e6, MapInput.RATIO: 0.75})
    assert at_level["shaft_torque"][0] == pytest.approx(solved().values["shaft_torque"][1, 1, 1, 0, 0], rel=1e-12)
    with pytest.raises(InputError, match="nothing is extrapolated"):
        interpolant.at({MapInput.SPEED: 1400 * RPM, MapInput.PRESSURE: 45e6, MapInput.RATIO: 0.75})


@pytest.mark.parametrize("speeds", [(1000.0, 2000.0), (1000.0, 1500.0, 2000.0)])
def test_levels_left_out_measure_no_axis_of_two_levels(speeds):
    """Along two levels nothing is left out: the error of the other axes alone would be no bound."""
    axis = MapAxis(MapInput.SPEED, tuple(RPM * speed for speed in speeds))
    error = left_out_error(solved((axis, MapAxis(MapInput.PRESSURE, (10e6, 20e6, 30e6)))))
    assert (error is None) == (len(speeds) == 2)


def cycle_of(time, speed, pressure, ratio):
    inputs = (MapInput.SPEED, MapInput.PRESSURE, MapInput.RATIO)
    values = (np.array(speed, float), np.array(pressure, float), np.array(ratio, float))
    return Cycle(np.array(time, float), dict(zip(inputs, values, strict=True)))


def test_a_constant_cycle_is_its_point_times_the_time():
    data, interpolant = solved(), MapInterpolant(solved())
    error = left_out_error(data)
    found = duty(interpolant, cycle_of([0, 4, 10], [1800 * RPM] * 3, [20e6] * 3, [1.0] * 3), error)
    index = (2, 2, 2, 0, 0)
    assert found.energies["shaft"].value == pytest.approx(10.0 * data.values["shaft_power"][index], rel=1e-9)
    paper = data.efficiency(EfficiencyDefinition.PAPER).overall[index]
    assert found.efficiency[EfficiencyDefinition.PAPER].value == pytest.approx(paper, rel=1e-9)
    sinks = sum(found.energies[words].value for words in LOSSES.values() if words in found.energies)
    assert sinks == pytest.approx(found.energies["loss"].value, rel=1e-3)
    assert found.marked["chamber_overpressure"] == pytest.approx(1.0)


@pytest.mark.parametrize("corner", list(product((1, 2), (2, 3), (1, 2))))
def test_one_warned_corner_marks_the_cells_around_it(corner):
    """Time in a cell counts where any of its corners carries the warning, and no other time does."""
    warnings = np.full(solved().shape, None, dtype=object)
    for index in np.ndindex(warnings.shape):
        warnings[index] = (("told", "once"),) if index == (*corner, 0, 0) else ()
    interpolant = MapInterpolant(replace(solved(), warnings=warnings))
    within, beyond = (1500 * RPM, 22e6, 0.8), (1200 * RPM, 7e6, 0.6)
    cycle = cycle_of([0, 3, 3, 12], *([one, one, other, other] for one, other in zip(within, beyond, strict=True)))
    assert duty(interpolant, cycle, left_out_error(solved())).marked["told"] == pytest.approx(3.0 / 12.0)


def test_a_cycle_with_steps_and_ramps_is_within_its_error():
    """Against the fidelity itself at many instants of the cycle."""
    interpolant = MapInterpolant(solved())
    points, numbers = fresh(0, 24)
    cycle = cycle_of([0, 5, 5, 9], [1100 * RPM, 2000 * RPM, 1500 * RPM, 1500 * RPM], [8e6, 30e6, 15e6, 34e6],
                     [0.6, 0.95, 0.7, 0.7])  # fmt: skip
    found = duty(interpolant, cycle, fresh_error(interpolant, points, numbers))
    truth = 0.0
    for begin, end in ((0, 1), (2, 3)):
        places, shares = np.polynomial.legendre.leggauss(8)
        for place, share in zip(0.5 * (places + 1.0), shares, strict=True):
            at = {given: row[begin] + place * (row[end] - row[begin]) for given, row in cycle.inputs.items()}
            point = operating_point(PUMP, **{given.value: float(value) for given, value in at.items()})
            power = lumped_point(PUMP, point).power
            truth += 0.5 * share * (cycle.time[end] - cycle.time[begin]) * (power.shaft - power.hydraulic)
    assert abs(found.energies["loss"].value - truth) <= found.energies["loss"].error
    with pytest.raises(InputFaults, match="40 MPa at 3 s"):
        duty(interpolant, cycle_of([0, 3], [150, 150], [20e6, 40e6], [0.6, 0.6]), left_out_error(solved()))
    with pytest.raises(InputError, match="two rows"):
        cycle_of([0], [150], [20e6], [0.6])


def _scaled(data, **factors):
    """The map with some of its columns times a factor."""
    return replace(data, values={**data.values, **{name: by * data.values[name] for name, by in factors.items()}})


@pytest.mark.parametrize("factors", [{"shaft_power": 0.0}, {"shaft_power": -1.0}, {"hydraulic_power": -1.0}])
def test_a_cycle_that_does_not_pump_has_no_efficiency(factors):
    """At standstill and while it motors energies are what they are; a ratio of them means nothing."""
    error = replace(left_out_error(solved()), largest=dict.fromkeys(solved().values, 1.0))
    cycle = cycle_of([0, 10], [1800 * RPM] * 2, [20e6] * 2, [1.0] * 2)
    usual, found = (duty(MapInterpolant(data), cycle, error) for data in (solved(), _scaled(solved(), **factors)))
    assert len(usual.efficiency) == len(EfficiencyDefinition)
    assert found.efficiency == {}
    assert {"shaft", "hydraulic", "loss"} <= set(found.energies)


def test_points_without_power_at_the_shaft_leave_the_error_of_an_efficiency():
    """Both maps at other levels, one with points that motor: their error is that of the points that pump."""
    data, error = solved(), left_out_error(solved())
    power = data.values["shaft_power"].copy()
    power[0, 0] *= -1e-9
    motoring = replace(data, values={**data.values, "shaft_power": power})
    axes = (MapAxis(MapInput.SPEED, AXES[0].values[:-1]), *AXES[1:])
    found = compare(motoring, solved(axes), (error, error)).differences[0]
    assert found.words.startswith("overall efficiency")
    assert 0.0 < found.error < 0.1


def test_a_map_beside_itself_has_no_difference():
    found = compare(solved(), solved(), (None, None))
    assert not any(one.significant for one in found.differences)
    worn = load_pump(BENCH, {"piston.radial_clearance": "25 um"})
    differences = {one.words: one for one in compare(solved(), solved(pump=worn), (None, None)).differences}
    assert differences["piston leakage"].largest.value > 0.0
    assert differences["piston leakage"].significant
    assert not differences["ball guide-retainer friction"].significant
    efficiency = differences["overall efficiency, ISO 4409, swept displacement"]
    assert efficiency.fall.value <= efficiency.rise.value
    assert efficiency.above + efficiency.below <= 1.0


def test_maps_of_other_levels_meet_in_their_common_box():
    other = solved(
        (
            MapAxis(MapInput.SPEED, (1200 * RPM, 1500 * RPM, 1900 * RPM)),
            MapAxis(MapInput.PRESSURE, (8e6, 15e6, 22e6, 30e6)),
            MapAxis(MapInput.RATIO, (0.6, 0.8, 1.0)),
        )
    )
    errors = left_out_error(solved()), left_out_error(other)
    found = compare(solved(), other, errors)
    assert found.one.axes[1].values == (8e6, 12e6, 20e6, 28e6, 30e6)
    assert not any(one.significant for one in found.differences if one.unit == "W")
    far = solved((MapAxis(MapInput.PRESSURE, (40e6, 41e6, 42e6)),))
    with pytest.raises(InputFaults, match="delivery pressure"):
        compare(solved(), far, (None, None))


def test_a_map_names_the_film_physics_that_it_leaves_out():
    """So two maps of one pump by other physics are told apart; the content of their points is as ever."""
    whole, rigid = (DirectSolver(FloatingSolver(own), 60.0) for own in (FloatingOptions(), FloatingOptions().rigid))
    assert whole.words == "floating, each point solved"
    assert rigid.words == "floating without pressure viscosity, elastic walls, heat, each point solved"
    assert rigid.stated["fidelity"] == whole.stated["fidelity"] == whole.words
