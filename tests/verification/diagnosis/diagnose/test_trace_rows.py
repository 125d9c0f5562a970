"""A trace as a few numbers of white noise, and a bench that gives them beside its steady readings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from diagnosis import RecordedChannel, TraceBlock, load_thresholds
from diagnosis.detect.angle_scan import scan_angles
from diagnosis.study.traces.bench import TracedBench, traced_bench
from diagnosis.study.traces.fit import settled_traces
from diagnosis.study.traces.misfits import trace_misfits
from diagnosis.study.traces.rows import WINDOWS, shrunk_covariance, trace_rows, windows
from system import (
    BenchPoints,
    Channel,
    ChannelName,
    LumpedBench,
    Observations,
    base_parameters,
    load_pump,
    maximum_posterior,
    tolerances,
)
from system.bench.parameters import groove_parameters
from system.bench.sensors import encoder_parameter, read_turns, transducer_parameters

PUMP = load_pump("ref90")
RPM = np.pi / 30.0
ANGLE = np.radians(np.arange(0.0, 360.0, 0.5))
RISE, FALL = np.radians(170.0), np.radians(350.0)
TURN = 1e7 * (np.tanh((ANGLE - RISE) / 0.04) - np.tanh((ANGLE - FALL) / 0.04))
CHANNEL = RecordedChannel(ChannelName.P_CHAMBER, "p", "bar", 4e4, 0.0, 0.0, 0.0, 1e-3, 4e4, ())
OUTPUTS = (ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE)
SIGMA = np.array([2e-6, 5e-7, 0.3])
POINTS = BenchPoints(
    np.array([1000.0, 2000.0, 1500.0]) * RPM, np.array([1.0, 0.5, 1.0]), np.array([1e7, 3e7, 2e7]),
    np.full(3, 2.5e6), np.full(3, 1e5), np.full(3, 323.15), np.full(3, 320.15), np.zeros(3), np.arange(3.0),
    np.zeros(3),
)  # fmt: skip


def _block(pressure: np.ndarray, point: int = 0) -> TraceBlock:
    return TraceBlock(point, ANGLE, pressure, None, 1)


def _traced() -> TracedBench:
    """A bench of three points, the chamber recorded at the last two."""
    more = (encoder_parameter(np.radians(0.3)), *transducer_parameters(CHANNEL, 1e-4), *groove_parameters())
    bench = LumpedBench(PUMP, POINTS, OUTPUTS, (*base_parameters(PUMP, tolerances(PUMP)[0]), *more))
    return traced_bench(bench, (_block(TURN, 1), _block(TURN, 2)), CHANNEL)


def _values(bench: TracedBench, **changed: float) -> np.ndarray:
    return np.array([changed.get(one.name, one.value(0.0)) for one in bench.parameters])


def test_windows_are_narrow_where_pressure_is_steep():
    marks = windows(TURN)
    assert np.all(np.diff(marks) >= 0)
    assert set(marks) <= set(range(WINDOWS))
    width = np.bincount(marks, minlength=WINDOWS)
    flank = marks[np.argmin(np.abs(ANGLE - RISE))]
    assert width[flank] < 720 / WINDOWS / 4
    assert width.max() <= 2 * 720 / WINDOWS + 1
    rise = np.array([np.ptp(TURN[marks == mark]) for mark in np.unique(marks)])
    assert rise.max() <= 4.0 * np.ptp(TURN) / WINDOWS


def test_the_numbers_of_a_trace_have_a_noise_of_one():
    """Of readings of one sigma: B B^T sigma^2 is 1 where the trace is flat, less where it is steep."""
    rows = trace_rows(_block(TURN), CHANNEL, TURN)
    variance = np.diag(rows.weights @ rows.weights.T) * 4e4**2
    steep = np.abs(np.gradient(TURN))
    rise = np.array([steep[own != 0.0].max() for own in rows.weights])
    assert variance[rise < 1e3] == pytest.approx(1.0, abs=1e-3)
    assert np.all(variance <= 1.0 + 1e-9)
    four = trace_rows(replace(_block(TURN), cycles=4), CHANNEL, TURN)
    assert four.weights[rise < 1e3] == pytest.approx(2.0 * rows.weights[rise < 1e3], rel=1e-3)


def test_few_cycles_tell_their_covariance_better_when_shrunk():
    """Of twelve cycles of noise that remembers: nearer to the true covariance than that of the sample."""
    random = np.random.default_rng(54)
    true = 0.6 ** np.abs(np.subtract.outer(np.arange(24), np.arange(24)))
    root = np.linalg.cholesky(true)
    apart = []
    for _ in range(40):
        cycles = root @ random.standard_normal((24, 12))
        factor = (cycles - cycles.mean(axis=1, keepdims=True)) / np.sqrt(12 * 11)
        found = 12.0 * shrunk_covariance(factor, np.zeros(24))
        assert np.linalg.eigvalsh(found).min() > 0.0
        apart.append((np.linalg.norm(found - true), np.linalg.norm(12.0 * factor @ factor.T - true)))
    shrunk, plain = np.mean(apart, axis=0)
    assert shrunk < 0.8 * plain


def test_many_cycles_tell_their_own_covariance():
    """Of 2,000 cycles next to nothing is noise: their correlations stay as they are."""
    random = np.random.default_rng(55)
    true = 0.6 ** np.abs(np.subtract.outer(np.arange(24), np.arange(24)))
    cycles = np.linalg.cholesky(true) @ random.standard_normal((24, 2000))
    factor = (cycles - cycles.mean(axis=1, keepdims=True)) / np.sqrt(2000 * 1999)
    found, plain = shrunk_covariance(factor, np.zeros(24)), factor @ factor.T
    assert np.linalg.norm(found - plain) < 0.02 * np.linalg.norm(plain)


def test_a_transducer_reads_late_by_its_lag():
    """Of one harmonic: amplitude 1/sqrt(1 + (k w tau)^2), phase -atan(k w tau); then gain and zero."""
    lag, speed, order = 1e-3, 200.0, 3
    late = order * speed * lag
    values = {"p_chamber.lag": lag, "p_chamber.gain": 0.01, "p_chamber.zero": 5.0}
    found = read_turns(np.cos(order * ANGLE)[None], np.array([speed]), ANGLE, values)
    expected = np.cos(order * ANGLE - np.arctan(late)) / np.sqrt(1.0 + late**2) * 1.01 + 5.0
    assert found[0] == pytest.approx(expected, abs=1e-12)


def test_steady_readings_stay_and_traces_stand_beside_them():
    traced = _traced()
    values = _values(traced, encoder_offset=np.radians(0.2))
    found = traced.predict(values)
    assert found.shape == (3, 3 + traced.observations(_steady(traced, values)).values.shape[1] - 3)
    assert np.array_equal(found[:, :3], traced.bench.predict(values))
    assert np.all(found[0, 3:] == 0.0)
    turns = traced.traces(values, (1, 2), ANGLE)
    for at, row in enumerate(traced.rows):
        assert found[at + 1, 3 : 3 + len(row.weights)] == pytest.approx(row.weights @ turns[at])
    readings = traced.observations(_steady(traced, values))
    assert readings.measured[:, 3:].any(axis=1).tolist() == [False, True, True]


def test_slopes_of_traces_are_those_of_their_predictions():
    traced = _traced()
    values = _values(traced)
    names = ("encoder_offset", "groove_advance", "p_chamber.gain", "friction.piston_cylinder")
    slopes = traced.slopes(values, names)
    step = np.radians(0.03)
    expected = (traced.predict(_values(traced, encoder_offset=step)) - traced.predict(values)) / step
    assert slopes[:, 3:, 0] == pytest.approx(expected[:, 3:], rel=1e-6, abs=1e-6)
    assert np.all(slopes[:, :3, 0] == 0.0)
    assert np.abs(slopes[:, 3:, 1]).max() > 0.0
    assert np.all(slopes[:, 3:, 3] == 0.0)
    assert traced.input_slopes(values).shape == (3, traced.predict(values).shape[1], 7)


def test_grooves_that_begin_sooner_are_found_in_traces():
    """A bench's own readings, encoder off by .4 deg, grooves begun .8 deg sooner: each back within 3 sigma.

    And told by them: less than half of its prior variance is left (of the encoder .28, by small enough steps).
    """
    traced = _traced()
    true = {"encoder_offset": np.radians(0.4), "groove_advance": np.radians(0.8)}
    values = _values(traced, **true)
    turns = traced.traces(values, (1, 2), ANGLE)
    blocks = tuple(
        replace(row, block=replace(row.block, mean=turn)) for row, turn in zip(traced.rows, turns, strict=True)
    )
    recorded = replace(traced, rows=blocks)
    fit = maximum_posterior(recorded, recorded.observations(_steady(traced, values)))
    for name, value in true.items():
        assert abs(fit.values[fit.index(name)] - value) < 3.0 * fit.sigma(name)
        assert fit.sigma(name) ** 2 < 0.5 * fit.parameters[fit.index(name)].spread ** 2


def test_a_misfit_is_as_uncertain_as_the_readings_and_a_flank_by_the_step_of_its_angle():
    """sigma^2 = (reading^2 + quantum^2/12)/cycles + (p_(k+1) - p_(k-1))^2/(4 * 12)."""
    traced = _traced()
    values = _values(traced)
    (turn,) = traced.traces(values, (1,), ANGLE)
    rows = (replace(traced.rows[0], block=replace(traced.rows[0].block, mean=turn, cycles=4)),)
    channel = replace(CHANNEL, sigma=3e4, sigma_relative=0.0, quantum=6e4)
    (found,) = trace_misfits(replace(traced, rows=rows), channel, 0.01)
    steep = 0.5 * (np.roll(turn, -1) - np.roll(turn, 1))
    expected = np.sqrt((3e4**2 + 6e4**2 / 12.0) / 4.0 + steep**2 / 12.0)
    assert found.sigma == pytest.approx(expected, rel=0.02)
    assert found.residual == pytest.approx(np.zeros(len(turn)), abs=0.02 * np.ptp(turn))


def test_what_tolerance_moves_is_no_window_though_a_flank_is_not_linear():
    """Encoder and flow coefficient 2 spreads off: windows stand out about the prior mean, none about the fit."""
    traced = _traced()
    moved = {"encoder_offset": 2.0, "flow_coefficient": -2.0}
    values = np.array([one.value(moved.get(one.name, 0.0)) for one in traced.parameters])
    turns = traced.traces(values, (1, 2), ANGLE)
    noise = 4e4 * np.random.default_rng(71).standard_normal(turns.shape)
    rows = tuple(
        replace(row, block=replace(row.block, mean=turn)) for row, turn in zip(traced.rows, turns + noise, strict=True)
    )
    recorded, limits = replace(traced, rows=rows), load_thresholds().locate
    assert scan_angles(trace_misfits(recorded, CHANNEL, 0.01), (), limits, 1) is not None
    assert scan_angles(trace_misfits(recorded, CHANNEL, 3.0), (), limits, 1) is None
    assert np.abs(settled_traces(recorded, 1.0)).max() <= 1.0


def _steady(traced: TracedBench, values: np.ndarray) -> Observations:
    found = traced.bench.predict(values)
    return Observations(
        channels=tuple(Channel(name.value, name.dimension) for name in OUTPUTS),
        values=found,
        sigma=np.tile(SIGMA, (3, 1)),
        inputs=tuple(name.value for name in traced.bench.inputs),
        input_sigma=np.zeros((3, len(traced.bench.inputs))),
        quantum=np.zeros(3),
        blocks=np.arange(3),
    )
