"""Sensors of a bench and the priors of a pump: what a reading makes of the truth, and what is taken, told."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from system import BenchPoints, ChannelName, Role, Scale, base_parameters, load_pump, tolerances
from system.bench.parameters import BASE_NAMES, groove_parameters
from system.bench.sensors import (
    SENSOR_NAMES,
    actual,
    drift_parameter,
    encoder_parameter,
    lag_parameter,
    read,
    sensor_parameters,
)

CHANNELS = (ChannelName.Q_CASE, ChannelName.TORQUE)
TRUTH = np.array([[1e-5, 100.0], [2e-5, 300.0], [4e-5, 200.0]])
LEVEL = np.ones(3)
HOURS = np.array([0.0, 0.5, 2.0])
POINTS = BenchPoints(200.0 * LEVEL, LEVEL, 2e7 * LEVEL, 2e6 * LEVEL, 1e5 * LEVEL, 323.15 * LEVEL, 320.0 * LEVEL,
                     HOURS, np.arange(3.0), np.array([0.0, 0.01, -0.02]))  # fmt: skip


@dataclass(frozen=True)
class Calibrated:
    name: ChannelName
    gain_sigma: float
    zero_sigma: float


def test_reading_is_truth_by_gain_and_zero():
    found = read(TRUTH, CHANNELS, POINTS, {"torque.gain": 0.01, "torque.zero": -0.5, "Q_case.zero": 1e-7}, {})
    assert found[:, 1] == pytest.approx(1.01 * TRUTH[:, 1] - 0.5, rel=1e-14)
    assert found[:, 0] == pytest.approx(TRUTH[:, 0] + 1e-7, rel=1e-14)
    assert np.all(read(TRUTH, CHANNELS, POINTS, {"film_thickness.piston": 1e-5}, {}) == TRUTH)


def test_drift_grows_with_hours_else_with_order():
    drift = {"Q_case.drift": 3e-6}
    assert (read(TRUTH, CHANNELS, POINTS, drift, {}) - TRUTH)[:, 0] == pytest.approx([0.0, 0.75e-6, 3e-6])
    unknown = replace(POINTS, hours=np.full(3, np.nan), order=np.array([2.0, 0.0, 1.0]))
    assert (read(TRUTH, CHANNELS, unknown, drift, {}) - TRUTH)[:, 0] == pytest.approx([3e-6, 0.0, 1.5e-6])


def test_a_drift_of_known_course_follows_it():
    course = {ChannelName.Q_CASE: np.array([0.0, 1.0, 0.25])}
    found = read(TRUTH, CHANNELS, POINTS, {"Q_case.drift": 3e-6, "torque.drift": 2.0}, course) - TRUTH
    assert found[:, 0] == pytest.approx([0.0, 3e-6, 0.75e-6])
    assert found[:, 1] == pytest.approx([0.0, 0.5, 2.0])


def test_lag_keeps_a_part_of_the_point_before():
    """In the order in which points were taken, exp(-t/tau) of the last step is left."""
    shuffled = replace(POINTS, order=np.array([1.0, 0.0, 2.0]), hours=np.array([0.5, 0.0, 2.0]))
    found = read(TRUTH, CHANNELS, shuffled, {"torque.lag": 1800.0}, {})[:, 1]
    left = np.exp([-1.0, -3.0])
    assert found == pytest.approx([100.0 + 200.0 * left[0], 300.0, 200.0 - 100.0 * left[1]])


def test_true_inputs_are_readings_less_their_zero():
    found = actual(POINTS, {"p_out.zero": 1e5, "T_case.zero": -2.0, "torque.zero": 3.0})
    assert np.all(found.p_out == POINTS.p_out - 1e5)
    assert np.all(found.T_case == POINTS.T_case + 2.0)
    assert found.speed is POINTS.speed


def test_the_case_is_as_warm_as_read_and_what_it_rose_in_the_lag_of_its_thermometer():
    found = actual(POINTS, {"T_case.lag": 30.0, "T_case.zero": -2.0})
    assert found.T_case == pytest.approx(POINTS.T_case + 2.0 + [0.0, 0.3, -0.6])
    assert found.T_in is POINTS.T_in


def test_sensors_have_a_parameter_for_what_is_uncertain():
    sensors = (
        Calibrated(ChannelName.TORQUE, 1e-3, 0.25),
        Calibrated(ChannelName.Q_CASE, 0.0, 1e-7),
        Calibrated(ChannelName.P_OUT, 1e-3, 1.5e4),
        Calibrated(ChannelName.DISPLACEMENT_RATIO, 0.0, 5e-4),
        Calibrated(ChannelName.SPEED, 1e-3, 0.05),
    )
    found = {one.name: one for one in sensor_parameters(sensors)}
    expected = {"torque.gain": 1e-3, "torque.zero": 0.25, "Q_case.zero": 1e-7, "p_out.zero": 1.5e4}
    assert {name: one.spread for name, one in found.items()} == {**expected, "displacement_ratio.zero": 5e-4}
    assert all(one.role is Role.SENSOR and one.centre == 0.0 for one in found.values())
    more = (drift_parameter(ChannelName.Q_CASE, 1e-6), lag_parameter(ChannelName.Q_OUT, 30.0), encoder_parameter(0.01))
    assert {*found, *(one.name for one in more)} <= SENSOR_NAMES
    assert more[1].scale is Scale.HALF


def test_priors_stand_about_what_the_pump_states():
    pump = load_pump("ref90")
    stated, told = tolerances(pump)
    assert (stated.film_thickness, stated.viscosity, stated.guide_friction) == (0.08, 0.02, 0.06)
    not_stated = ("viscosity_slope", "displacement", "dead_volume", "flow_coefficient", "stand_out_share")
    assert {one.path for one in told} == {f"tolerance.{name}" for name in (*not_stated, "inlet_share")}
    found = {one.name: one for one in base_parameters(pump, stated)}
    uncertain = {one.name for one in base_parameters(pump, replace(stated, inlet_share=0.25))}
    assert {*uncertain, *(one.name for one in groove_parameters())} == BASE_NAMES
    assert uncertain - set(found) == {"inlet_share", "throttle_share"}  # films as warm as the case, for certain
    assert found["film_thickness.slipper"].centre == pump.slipper.film_thickness
    assert found["film_thickness.slipper"].value(1.0) == pytest.approx(pump.slipper.film_thickness * np.exp(0.08))
    assert found["friction.front_bearing"].spread == 0.1
    assert found["flow_coefficient"].upper == 1.0
    assert found["stand_out_share"].centre == 0.5
    frictionless = load_pump("ref90", {"friction.rear_bearing": 0.0, "piston.stand_out_share": 1.0})
    other = {one.name: one for one in base_parameters(frictionless, stated)}
    assert set(other) == set(found) - {"friction.rear_bearing"}
    assert other["stand_out_share"].centre == 1.0


def test_stated_tolerance_is_taken():
    pump = load_pump("ref90", {"tolerance.displacement": 0.003, "tolerance.viscosity_slope": "0.001 1/K"})
    found, told = tolerances(pump)
    assert (found.displacement, found.viscosity_slope) == (0.003, 0.001)
    assert "tolerance.displacement" not in {one.path for one in told}
