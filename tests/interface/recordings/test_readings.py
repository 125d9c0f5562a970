"""From a recording to points and readings: what is missing is told, never guessed in silence."""

from __future__ import annotations

import numpy as np
import pytest

from diagnosis import Circuit, NoteKind, RecordedChannel, Recording, SteadyTable, TraceBlock, observations
from diagnosis.report.tables import steady_rows
from diagnosis.study.inputs import assumed_parameters, bench_points, complete, measured
from diagnosis.verdict.row_numbers import table_rows
from reynolds import InputError
from system import INPUTS, ChannelName, PumpDescription, load_pump
from system.bench.sensors import actual

C = ChannelName
SIGMAS = {C.SPEED: 0.05, C.P_OUT: 1.5e4, C.T_IN: 0.2, C.Q_CASE: 2.5e-7}


def _channel(name: ChannelName) -> RecordedChannel:
    return RecordedChannel(name, name.value, "", SIGMAS[name], 1e-3, 0.0, 0.0, 1e-3, SIGMAS[name], ())


def _recording(circuit: Circuit = Circuit.CLOSED) -> Recording:
    """Six points of speed, delivery pressure, inlet temperature and drain flow; the third has no speed."""
    order = list(C)
    values = np.full((6, len(order)), np.nan)
    values[:, order.index(C.SPEED)] = [50.0, 100.0, np.nan, 150.0, 200.0, 200.0]
    values[:, order.index(C.P_OUT)] = np.linspace(5e6, 30e6, 6)
    values[:, order.index(C.T_IN)] = 320.0
    values[:, order.index(C.Q_CASE)] = np.linspace(1e-5, 4e-5, 6)
    angle = np.linspace(0.0, 6.0, 40)
    traces = tuple(TraceBlock(point, angle, angle, None, 1) for point in (2, 4))
    table = SteadyTable(values, np.arange(6), np.full(6, np.nan), np.full_like(values, np.nan))
    return Recording("six", "", "", circuit, tuple(map(_channel, SIGMAS)), table, traces, ())


def test_a_point_without_an_input_is_taken_out_and_told() -> None:
    found = complete(_recording())
    assert len(found.steady.values) == len(found.steady.repeats) == 5
    assert [trace.point for trace in found.traces] == [3]
    assert found.notes[-1].kind is NoteKind.REMOVED
    assert found.notes[-1].points == (2,)
    assert complete(found) is found


def test_points_are_told_by_the_rows_of_their_own_table() -> None:
    """The third of six rows lacks an input: the points that are left are rows 1, 2, 4, 5, 6, here and in files."""
    found = complete(_recording())
    assert table_rows(_recording()).tolist() == [1, 2, 3, 4, 5, 6]
    assert table_rows(found).tolist() == [1, 2, 4, 5, 6]
    assert [row["point"] for row in steady_rows(found)] == ["1", "2", "4", "5", "6"]


@pytest.fixture
def pump() -> PumpDescription:
    return load_pump("ref90")


def test_what_is_not_measured_is_taken_and_told(pump: PumpDescription) -> None:
    points, notes = bench_points(complete(_recording()), pump)
    assert {note.channel for note in notes} == {C.DISPLACEMENT_RATIO, C.P_IN, C.P_CASE, C.T_CASE}
    assert np.all(points.p_in == pump.operating.inlet_pressure)
    assert np.all(points.T_case == 320.0)
    assert np.all(points.displacement_ratio == pump.operating.displacement_ratio)
    told = {note.text for note in notes}
    assert "T_case is not measured: assumed equal to T_in +- 5 K" in told
    assert "p_in is not measured: assumed 25 +- 2.5 bar" in told
    opened, _ = bench_points(complete(_recording(Circuit.OPEN)), pump)
    assert np.all(opened.p_in == 0.0)


def test_what_is_taken_may_be_off(pump: PumpDescription) -> None:
    """By one amount at all points: p_in 10 % of the charge pressure, of an open circuit 0.1 bar."""
    found = {one.name: one for one in assumed_parameters(complete(_recording()), pump)}
    assert list(found) == ["displacement_ratio.zero", "p_in.zero", "p_case.zero", "T_case.zero"]
    assert found["p_in.zero"].spread == pytest.approx(0.1 * pump.operating.inlet_pressure)
    opened = {one.name: one for one in assumed_parameters(complete(_recording(Circuit.OPEN)), pump)}
    assert opened["p_in.zero"].spread == pytest.approx(1e4)
    points, _ = bench_points(complete(_recording()), pump)
    assert actual(points, {"p_in.zero": 2e5}).p_in == pytest.approx(points.p_in - 2e5)


def test_readings_carry_their_noise_and_that_of_the_inputs() -> None:
    recording = complete(_recording())
    inputs = measured(recording, INPUTS)
    assert inputs == (C.SPEED, C.P_OUT, C.T_IN)
    found = observations(recording, (C.Q_CASE,), inputs)
    assert found.values.shape == (5, 1)
    assert found.sigma[:, 0] == pytest.approx(2.5e-7 + 1e-3 * found.values[:, 0])
    assert found.input_sigma[:, 1] == pytest.approx(1.5e4 + 1e-3 * recording.steady.column(C.P_OUT))
    assert len(set(found.blocks)) > 1
    with pytest.raises(InputError, match="torque"):
        observations(recording, (C.TORQUE,), inputs)
