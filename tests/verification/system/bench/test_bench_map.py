"""A bench map at once against its points one by one: the same pump, the same numbers."""

from dataclasses import replace
from time import process_time

import numpy as np
import pytest
from bench_pump import BENCH

from reynolds import InputError, NotConverged
from system import (
    INPUTS,
    SIMULATED,
    BenchPoints,
    ChannelName,
    Component,
    LumpedBench,
    base_parameters,
    load_pump,
    lumped_point,
    operating_point,
    resolved_toml,
    stroke,
    tolerances,
)
from system.bench import simulator
from system.bench.chamber_map import solve_map
from system.bench.outputs import DRAINS, METERED
from system.bench.parameters import pump_with
from system.bench.sensors import encoder_parameter
from system.bench.simulator import INPUT_STEPS
from system.pump import lumped

REF90 = load_pump(BENCH)
CROSSED = load_pump(BENCH, {"pump.cross_angle": "3 deg", "pump.displacement": "91.31 cm3/rev"})
RPM = np.pi / 30.0
GAPS = ("film_thickness.piston", "film_thickness.slipper", "film_thickness.valve_plate", "eccentricity_ratio",
        "viscosity", "viscosity_slope", "stand_out_share")  # fmt: skip


def _points(speed, ratio, delivery, inlet=2.5e6, case=0.15e6, celsius=50.0):
    rows = np.array(np.broadcast_arrays(speed, ratio, delivery, inlet, case, celsius), dtype=float)
    speed, ratio, delivery, inlet, case, celsius = rows
    kelvin, order = celsius + 273.15, np.arange(len(speed), dtype=float)
    inlets = (delivery, inlet, case, kelvin, kelvin - 3.0)
    return BenchPoints(speed * RPM, ratio, *inlets, order / 60.0, order, 0.0 * order)


MAP = _points(
    [1000.0, 2100.0, 2100.0, 1500.0, 600.0], [1.0, 1.0, 0.4, 0.7, 0.28], [5e6, 35e6, 35e6, 20e6, 30e6],
    [2.5e6, 2.5e6, 2.4e6, 2.6e6, 0.2e6], [0.15e6, 0.1e6, 0.2e6, 0.15e6, 0.1e6], [40.0, 50.0, 60.0, 70.0, 50.0],
)  # fmt: skip


def _class_a(readings):
    """One sigma of each reading of a class A bench: that of the bench recordings."""
    fixed = np.array([0.08 / 6e4, 0.12 / 6e4, 0.015 / 6e4, 0.25])
    return fixed + np.array([0.0006, 0.001, 0.004, 0.0006]) * np.abs(readings)


def _bench(pump=REF90, points=MAP, **given):
    return LumpedBench(pump, points, SIMULATED, base_parameters(pump, tolerances(pump)[0]), **given)


def _means(bench, **changed):
    values = np.array([parameter.value(0.0) for parameter in bench.parameters])
    for name, value in changed.items():
        values[[parameter.name for parameter in bench.parameters].index(name)] = value
    return values


def _lumped_points(pump, points, tolerance):
    for n, speed in enumerate(points.speed):
        point = operating_point(
            pump, shaft_speed=speed, displacement_ratio=points.displacement_ratio[n],
            delivery_pressure=points.p_out[n], inlet_pressure=points.p_in[n], case_pressure=points.p_case[n],
            temperature=points.T_case[n],
        )  # fmt: skip
        yield lumped_point(pump, point, tolerance)


def _one_by_one(pump, points, tolerance):
    read = [found.bench for found in _lumped_points(pump, points, tolerance)]
    return np.array([(one.delivery_flow, one.inlet_flow, one.drain_flow, one.shaft_torque) for one in read])


@pytest.mark.parametrize("pump", [REF90, CROSSED], ids=["ref90", "crossed"])
def test_map_is_its_points(pump):
    bench = _bench(pump, samples_per_pitch=lumped.SAMPLES_PER_PITCH, tolerance=1e-7)
    expected = _one_by_one(pump, MAP, 1e-7)
    found = bench.predict(_means(bench, stand_out_share=1.0))
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-12)


def test_coarse_map_is_within_a_tenth_of_a_reading_s_noise():
    bench = _bench()
    expected = _one_by_one(REF90, MAP, 1e-7)
    found = bench.predict(_means(bench, stand_out_share=1.0))
    assert np.max(np.abs(found - expected) / _class_a(expected)) < 0.1


def test_values_are_those_of_a_pump_file_that_states_them(tmp_path):
    """The values of a fit return into a pump file: the map at the values is the map of that pump."""
    bench = _bench(samples_per_pitch=lumped.SAMPLES_PER_PITCH, tolerance=1e-7)
    rng = np.random.default_rng(5)
    values = np.array([np.clip(one.value(rng.normal()), one.lower, one.upper) for one in bench.parameters])
    pump = pump_with(REF90, dict(zip([one.name for one in bench.parameters], values, strict=True)))
    path = tmp_path / "found.toml"
    path.write_text(resolved_toml(pump), encoding="utf-8")
    expected = _one_by_one(load_pump(path), MAP, 1e-7)
    assert bench.predict(values) == pytest.approx(expected, rel=1e-6, abs=1e-12)
    assert np.max(np.abs(expected - _one_by_one(REF90, MAP, 1e-7)) / _class_a(expected)) > 3.0


def test_drains_of_the_gaps_are_parts_of_the_case_drain():
    """Without a flow past the films the three make the drain's whole; a shaft uncoupled shows the meter's zero."""
    known = base_parameters(REF90, tolerances(REF90)[0])
    own = (replace(one, name=f"torque.{what}") for one, what in zip(known, ("zero", "gain"), strict=False))
    bench = LumpedBench(REF90, MAP, METERED, (*known, *own))
    found = dict(zip(METERED, bench.predict(_means(bench, **{"torque.zero": 0.7, "torque.gain": 0.5})).T, strict=True))
    parts = [found[one] for one in DRAINS.values()]
    assert all(np.all(part > 0.0) for part in parts)
    np.testing.assert_allclose(np.sum(parts, axis=0), found[ChannelName.Q_CASE], rtol=1e-12)
    np.testing.assert_array_equal(found[ChannelName.TORQUE_UNCOUPLED], 0.7)
    wider = dict(zip(METERED, bench.predict(_means(bench, **{"film_thickness.slipper": 40e-6})).T, strict=True))
    assert np.all(wider[ChannelName.Q_SLIPPER] > found[ChannelName.Q_SLIPPER])
    few = bench.reading((ChannelName.Q_SLIPPER, ChannelName.TORQUE))
    np.testing.assert_array_equal(few.predict(_means(few))[:, 0], bench.predict(_means(bench))[:, 5])


def test_displacement_is_the_full_stroke():
    for pump in (REF90, CROSSED):
        full = stroke(lumped.full_drive(pump))
        larger = pump_with(pump, {"displacement": 1.02})
        assert stroke(lumped.full_drive(larger)) == pytest.approx(1.02 * full, rel=1e-12)


def test_piston_stands_out_by_its_share():
    point = operating_point(REF90, displacement_ratio=0.4)
    lengths = {}
    for share in (0.0, 0.5, 1.0):
        pump = load_pump(BENCH, {"piston.stand_out_share": share})
        lengths[share] = lumped.piston_motion(pump, point).engaged_length
    assert lengths[0.0][0] == pytest.approx(REF90.piston.engaged_length, rel=1e-14)
    assert lengths[0.5] == pytest.approx(0.5 * (lengths[0.0] + lengths[1.0]), rel=1e-14)
    assert lumped.piston_motion(REF90, point).engaged_length == pytest.approx(lengths[1.0], rel=1e-14)


def test_slopes_lead_where_predictions_go():
    """Friction exact, leakage 2 % of its largest change, flows at the ports 10 %; chambers solved anew 3 %."""
    bench = _bench()
    values = _means(bench)
    names = tuple(one.name for one in bench.parameters)
    slopes = bench.slopes(values, names)
    noise = _class_a(bench.predict(values))
    for column, (name, parameter) in enumerate(zip(names, bench.parameters, strict=True)):
        step = 0.3 * parameter.spread * (values[column] if parameter.scale.value == "log" else 1.0)
        ends = []
        for side in (1.0, -1.0):
            moved = values.copy()
            moved[column] += side * step
            ends.append(bench.predict(moved))
        expected = (ends[0] - ends[1]) / (2.0 * step) * step / noise
        off = np.abs(slopes[:, :, column] * step / noise - expected).max(axis=0)
        size = np.abs(expected).max(axis=0)
        assert np.all(off[2:] <= 0.03 * size[2:].max() + 3e-3), name
        assert np.all(off[:2] <= (0.12 if name in GAPS else 0.03) * size[:2].max() + 3e-3), name


def test_slopes_by_input_are_differences():
    bench = _bench(inputs=INPUTS)
    values = _means(bench)
    slopes = bench.input_slopes(values)
    assert not np.any(slopes[:, :, INPUTS.index(ChannelName.T_IN)])
    moved = replace(MAP, p_out=MAP.p_out + INPUT_STEPS[ChannelName.P_OUT])
    fine = [_bench(points=points, tolerance=1e-9).predict(values) for points in (moved, MAP)]
    expected = (fine[0] - fine[1]) / INPUT_STEPS[ChannelName.P_OUT]
    assert slopes[:, :, INPUTS.index(ChannelName.P_OUT)] == pytest.approx(expected, rel=3e-3)
    moved = replace(MAP, p_case=MAP.p_case + 2e4)
    expected = (_bench(points=moved).predict(values) - bench.predict(values)) / 2e4
    off = (slopes[:, :, INPUTS.index(ChannelName.P_CASE)] - expected) * 2e4 / _class_a(bench.predict(values))
    assert np.max(np.abs(off)) < 0.02


def test_components_are_what_readings_are_made_of():
    bench = _bench()
    values = _means(bench, stand_out_share=1.0)
    found, readings = bench.components(values), bench.predict(values)
    drain = sum(added[:, 2] for component, added in found.items() if component.value.endswith("_leakage"))
    assert drain == pytest.approx(readings[:, 2], rel=1e-2)  # by every 4 deg, the pressure rises within 10
    assert readings[:, 1] - readings[:, 2] + found[Component.COMPRESSION][:, 0] == pytest.approx(readings[:, 0])
    rubbing = [one for one in Component if one.value.endswith("_friction")] + [Component.BEARINGS]
    power = [one.pairs.power for one in _lumped_points(REF90, MAP, 1e-7)]
    assert sum(found[one][:, 3] for one in rubbing) * MAP.speed == pytest.approx(power, rel=2e-3)
    assert found[Component.DISPLACEMENT][:, 0] == pytest.approx(readings[:, 1], rel=0.12)
    assert np.all(found[Component.TORQUE_SENSOR][:, 3] == readings[:, 3])
    for component, added in found.items():
        assert np.any(added != 0.0), component


def test_traces_are_the_chamber_s_pressure():
    bench = _bench().with_parameters((encoder_parameter(np.radians(0.3)),))
    angle = np.radians(np.arange(0.0, 360.0, 1.0))
    values = _means(bench, stand_out_share=1.0)
    expected = list(_lumped_points(REF90, MAP, 1e-6))[1].cycle.pressure
    found = bench.traces(values, (1, 2), angle)
    assert found.shape == (2, 360)
    assert found[0] == pytest.approx(expected, abs=1e3)
    late = bench.traces(_means(bench, stand_out_share=1.0, encoder_offset=np.radians(2.0)), (1,), angle)
    assert late[0] == pytest.approx(np.roll(found[0], 2), abs=1.0)


def test_courses_are_remembered_by_what_moves_them():
    bench = _bench()
    values = _means(bench)
    first = bench.courses(values)
    assert bench.courses(_means(bench, **{"friction.piston_cylinder": 0.05})) is first
    assert bench.courses(_means(bench, bulk_modulus=1.5e9)) is not first
    assert bench.with_parameters((bench.parameters[0].widened(10.0),)).courses(values) is first


def test_what_no_map_can_be_made_of_is_told():
    parameters = base_parameters(REF90, tolerances(REF90)[0])
    with pytest.raises(InputError, match="T_out"):
        LumpedBench(REF90, MAP, (ChannelName.T_OUT,), parameters)
    with pytest.raises(InputError, match="swash_droop"):
        LumpedBench(REF90, MAP, SIMULATED, (replace(parameters[0], name="swash_droop.rate"),))
    with pytest.raises(InputError, match="alike"):
        _bench(load_pump(BENCH, {"piston.3": {"radial_clearance": "20 um"}}))
    with pytest.raises(InputError, match="temperature"):
        _bench(points=replace(MAP, T_case=MAP.T_case + 200.0))
    with pytest.raises(NotConverged, match="no pump has these values"):
        _bench().predict(_means(_bench(), viscosity=0.1))
    shut = replace(REF90.ports, kidney_area=1e-14, groove_area=1e-15)
    with pytest.raises(NotConverged, match="at 5 MPa and 1000 r/min"):
        _bench(replace(REF90, ports=shut)).predict(_means(_bench()))


@pytest.mark.slow
def test_map_of_160_points_takes_a_quarter_of_a_second():
    grid = np.meshgrid([1000.0, 1500.0, 2100.0, 2500.0], [0.28, 0.5, 0.75, 1.0], np.linspace(5e6, 35e6, 10))
    bench = _bench(points=_points(*(axis.ravel() for axis in grid)))
    values, best = _means(bench), np.inf
    bench.predict(values)
    for n in range(4):
        values[1] *= 1.0 + 1e-3 * (n + 1)
        begun = process_time()
        bench.predict(values)
        best = min(best, process_time() - begun)
    assert best < 0.25


@pytest.mark.parametrize("loss", [0.5, 1.0, 1.5])
def test_starved_chambers_keep_their_oil_from_turn_to_turn(loss):
    """Beside a cavity the pressure hardly knows how much oil there is: a turn is periodic by its oil.

    By their pressure turns would end 2 % apart where chambers begin to starve, and Q_out jump by 20 sigma.
    """
    starved = load_pump(BENCH, {"physics.incomplete_filling.inlet_loss": loss})
    inlet = np.arange(-50e3, 30e3, 400.0)
    bench = _bench(starved, _points(np.full(inlet.size, 2200.0), 1.0, 20e6, inlet, 0.0))
    values = _means(bench)
    totals = bench.solved(values).courses.totals
    assert np.max(np.abs(totals.outflow.total) / totals.outflow.delivery) < 1e-6
    told = bench.predict(values) / _class_a(bench.predict(values))
    assert np.max(np.abs(np.diff(told, 2, axis=0))) < 1.0


def test_a_starved_cycle_keeps_its_oil():
    """The same of single points, solved to their own tolerance."""
    starved = load_pump(BENCH, {"physics.incomplete_filling.inlet_loss": 1.0})
    for inlet in np.arange(-50e3, 30e3, 8e3):
        point = operating_point(
            starved, shaft_speed=2200.0 * RPM, delivery_pressure=20e6, inlet_pressure=inlet, case_pressure=0.0
        )
        out = lumped_point(starved, point).cycle.outflow
        assert abs(out.total) < 1e-7 * out.delivery


def test_slopes_by_friction_solve_no_chamber(monkeypatch):
    """Chambers that do not change are those that are solved already."""
    bench = _bench(points=_points([1500.0], 1.0, 20e6))
    values, friction = _means(bench), tuple(one.name for one in bench.parameters if one.name.startswith("friction"))
    bench.predict(values)

    def none(*given):
        raise AssertionError(given)

    for name in ("solve_map", "beside", "other_gaps"):
        monkeypatch.setattr(simulator, name, none)
    slopes = bench.slopes(values, friction)
    assert np.all(slopes[0, bench.channels.index(ChannelName.TORQUE)] != 0.0)


@pytest.mark.parametrize(("table", "maps"), [("notch_erosion.advance", 1), ("elastic_opening.slipper.opening", 2)])
def test_a_map_without_effects_is_solved_where_a_law_asks_for_it(table, maps, monkeypatch):
    """Ports that wear ask for no gap; a film that opens asks for the pressure in it."""
    solved = []

    def counted(*given):
        solved.append(given)
        return solve_map(*given)

    monkeypatch.setattr(simulator, "solve_map", counted)
    size = {"notch_erosion.advance": "2 deg", "elastic_opening.slipper.opening": "10 1/GPa"}[table]
    bench = _bench(load_pump(BENCH, {f"physics.{table}": size}), _points([1500.0], 1.0, 20e6))
    bench.predict(_means(bench))
    assert len(solved) == maps
