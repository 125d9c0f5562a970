"""`recording.toml` and its tables become a recording in SI, or every fault at once."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from diagnosis import Circuit, NoteKind, read_recording
from diagnosis.recording.model import point_sigma, reading_sigma
from system import ChannelName, InputFaults

ATMOSPHERE = 101325.0
HEAD = 'format = 1\npressure_reference = "absolute"\n'
STEADY = '[steady]\nfile = "steady.csv"\n'
CHANNELS = """[channel]
speed = { column = "n", unit = "rpm", sigma = 0.5 }
p_out = { column = "p", unit = "bar", sigma = 0.15, sigma_relative = 0.001 }
T_case = { column = "T", unit = "degC", sigma = 0.2 }
Q_out = { column = "Q", unit = "L/min", sigma = 0.08, sigma_relative = 0.0006 }
"""
TABLE = "k,n,p,T,Q\n1,1000,101.01325,50,60\n2,1500,201.01325,51,90\n3,2000,301.01325,52,120\n"


def _written(folder, form=HEAD + STEADY + CHANNELS, table=TABLE):
    (folder / "recording.toml").write_text(form, "utf-8")
    (folder / "steady.csv").write_text(table, "utf-8")
    return folder


def _paths(folder, **files):
    with pytest.raises(InputFaults) as refused:
        read_recording(_written(folder, **files))
    return {fault.path: fault for fault in refused.value.faults}


def test_readings_in_si_with_gauge_pressures(tmp_path):
    recording = read_recording(_written(tmp_path))
    assert recording.circuit is Circuit.OPEN
    assert recording.title == tmp_path.name
    column = recording.steady.column
    assert np.allclose(column(ChannelName.SPEED), np.array([1000, 1500, 2000]) * math.pi / 30, rtol=1e-15)
    assert np.allclose(column(ChannelName.P_OUT), [1e7, 2e7, 3e7], rtol=1e-12)
    assert np.allclose(column(ChannelName.T_CASE), [323.15, 324.15, 325.15])
    assert np.allclose(column(ChannelName.Q_OUT), np.array([60, 90, 120]) / 60e3)
    assert np.isnan(column(ChannelName.TORQUE)).all()
    pressure = recording.channel(ChannelName.P_OUT)
    assert recording.channel(ChannelName.TORQUE) is None
    assert reading_sigma(pressure, np.array([1e7]))[0] == pytest.approx(0.15e5 + 0.001 * (1e7 + ATMOSPHERE))


@pytest.mark.parametrize("name", ["", "recording.toml", "steady.csv"])
def test_named_by_folder_form_or_table(tmp_path, name):
    form = HEAD + (STEADY if name != "steady.csv" else "[steady]\n") + CHANNELS
    _written(tmp_path, form)
    assert len(read_recording(tmp_path / name).steady.values) == 3


def test_decimal_comma_and_other_units_give_the_same(tmp_path):
    (tmp_path / "b").mkdir()
    rows = ["16,666666666666668;10101325;122;3,6", "25;20101325;123,8;5,4", "33,333333333333336;30101325;125,6;7,2"]
    table = "n;p;T;Q\n" + "\n".join(rows)
    form = (HEAD + STEADY + CHANNELS).replace("rpm", "rev/s").replace("bar", "Pa").replace("degC", "degF")
    one, other = read_recording(_written(tmp_path)), read_recording(
        _written(tmp_path / "b", form.replace("L/min", "m3/h"), table)
    )  # fmt: skip
    assert np.allclose(one.steady.values, other.steady.values, rtol=1e-12, equal_nan=True)
    assert any("decimal comma" in note.text for note in other.notes)


@pytest.mark.parametrize(
    ("row", "told"), [(",1/min,MPa,degC,l/min", ["MPa"]), (",rpm,bar,degC,L/min", []), (",a,b,c,d", [])]
)
def test_a_unit_that_the_table_contradicts_is_told(tmp_path, row, told):
    """By the row below the head, or by brackets in it; what is no unit there tells nothing."""
    head, rest = TABLE.split("\n", 1)
    notes = [note.text for note in read_recording(_written(tmp_path, table=f"{head}\n{row}\n{rest}")).notes]
    assert [note.rpartition(" ")[2] for note in notes if "the table says" in note] == told
    bracketed = CHANNELS.replace('"p"', '"p (kPa)"')
    notes = read_recording(_written(tmp_path, HEAD + STEADY + bracketed, TABLE.replace(",p,", ",p (kPa),"))).notes
    assert any(note.text == "p_out: read in bar as stated; the table says kPa" for note in notes)


def test_what_is_taken_is_told(tmp_path):
    recording = read_recording(_written(tmp_path, form="format = 1\n" + STEADY + CHANNELS))
    told = " ".join(note.text for note in recording.notes)
    assert all(note.kind is NoteKind.NOTED for note in recording.notes)
    assert "pressure_reference is not stated" in told
    assert "Q_out: not stated, taken: gain good to 0.10%; zero good to 0.08 L/min" in told
    assert recording.channel(ChannelName.Q_OUT).assumed == ("gain", "zero")


def test_calibration_class_lag_and_quantum(tmp_path):
    more = 'quantum = 0.01, lag = "0.2 s", calibration = { gain = 0.002, zero = "0.1 L/min" } }'
    form = (HEAD + STEADY + CHANNELS).replace("sigma_relative = 0.0006 }", more)
    form = form.replace("sigma_relative = 0.001 }", 'accuracy_class = "B" }')
    recording = read_recording(_written(tmp_path, form))
    flow, pressure = recording.channel(ChannelName.Q_OUT), recording.channel(ChannelName.P_OUT)
    assert (flow.gain_sigma, flow.lag) == (0.002, 0.2)
    assert flow.zero_sigma == pytest.approx(0.1 / 60e3)
    assert flow.quantum == pytest.approx(0.01 / 60e3)
    assert pressure.gain_sigma == pytest.approx(0.015 / math.sqrt(3))  # ISO 4409 class B: 1.5 % above 2 bar
    median = np.median(np.abs(recording.steady.column(ChannelName.P_OUT)))
    assert pressure.zero_sigma == pytest.approx(0.015 / math.sqrt(3) * median)


def test_repeatability_from_repeats_else_a_fault(tmp_path):
    rng = np.random.default_rng(1)
    point = np.repeat(np.arange(10), 3)
    rows = [f"{k},{1000 + 100 * k},{100 + 20 * k},50,{60 + 6 * k + 0.2 * rng.standard_normal():.4f}" for k in point]
    table = "k,n,p,T,Q\n" + "\n".join(rows)
    bare = CHANNELS.replace(", sigma = 0.08, sigma_relative = 0.0006", "")
    stated = HEAD + STEADY + 'repeats = "k"\n' + bare
    channel = read_recording(_written(tmp_path, stated, table)).channel(ChannelName.Q_OUT)
    assert channel.sigma == pytest.approx(0.2 / 60e3, rel=3 / math.sqrt(2 * 20))
    assert "sigma" in channel.assumed
    assert set(_paths(tmp_path, form=HEAD + STEADY + bare, table=table)) == {"channel.Q_out.sigma"}


def test_quantum_is_seen_in_the_readings(tmp_path):
    rng = np.random.default_rng(2)
    rows = [f"{k},{1000 + 7 * k},{100 + k},50,{0.25 * round(4 * (60 + rng.uniform(0, 9)))}" for k in range(60)]
    channel = read_recording(_written(tmp_path, table="k,n,p,T,Q\n" + "\n".join(rows))).channel(ChannelName.Q_OUT)
    assert channel.quantum == pytest.approx(0.25 / 60e3)


@pytest.mark.parametrize("code", [1e38, 9999.0, -9999.0])
def test_a_code_for_no_reading_changes_neither_step_nor_calibration(tmp_path, code):
    """A code in one row once stretched the zero of its meter by a hundred, and hid a fault there."""
    rng = np.random.default_rng(2)
    rows = [[1000 + 10 * k, 100 + 5 * k, 50 + 0.1 * k, round(60 + k + rng.normal(0, 0.1), 3)] for k in range(30)]

    def channel(number):
        rows[12][3] = number
        table = "k,n,p,T,Q\n" + "\n".join(",".join(map(str, [k, *row])) for k, row in enumerate(rows))
        return read_recording(_written(tmp_path, form, table)).channel(ChannelName.Q_OUT)

    form = (HEAD + STEADY + CHANNELS).replace("sigma_relative = 0.0006 }", 'accuracy_class = "A" }')
    sound, coded = channel(72.001), channel(code)
    assert (coded.quantum, coded.gain_sigma) == (sound.quantum, sound.gain_sigma)
    assert coded.zero_sigma == pytest.approx(sound.zero_sigma)
    assert coded.quantum == pytest.approx(0.001 / 60e3)


def test_round_levels_of_a_setting_are_no_steps_of_a_reading(tmp_path):
    rows = [
        f"{k},{1000 + 7.3 * k:.1f},{100 + 1.01 * k:.2f},50,{60 + 0.013 * k:.3f},{0.2 + 0.01 * k:.2f}" for k in range(60)
    ]
    form = HEAD + STEADY + CHANNELS + 'displacement_ratio = { column = "e", unit = "1", sigma = 0.0 }\n'
    recording = read_recording(_written(tmp_path, form, "k,n,p,T,Q,e\n" + "\n".join(rows)))
    assert recording.channel(ChannelName.DISPLACEMENT_RATIO).quantum == 0.0


def test_a_series_without_rest_gives_quasi_steady_points(tmp_path):
    time = np.arange(4000.0)
    pressure = 20.0 + 200.0 * np.abs((time / 100.0) % 2.0 - 1.0)
    flow = 60.0 - 0.01 * pressure + 0.05 * np.random.default_rng(4).standard_normal(time.size)
    rows = [
        f"{t:.0f},1500,{p:.2f},{40.0 + 0.005 * t:.3f},{q:.4f}" for t, p, q in zip(time, pressure, flow, strict=True)
    ]
    form = HEAD.replace("absolute", "gauge") + '[series]\nfile = "steady.csv"\ntime = { column = "t", unit = "s" }\n'
    recording = read_recording(str(_written(tmp_path, form + CHANNELS, "t,n,p,T,Q\n" + "\n".join(rows))))
    found, stated = recording.steady.column(ChannelName.Q_OUT), recording.steady.column(ChannelName.P_OUT)
    error = point_sigma(recording, recording.channel(ChannelName.Q_OUT))
    assert len(found) > 50
    assert recording.steady.warming == pytest.approx(np.full(len(found), 0.005), rel=0.01)
    assert recording.steady.at(slice(3)).warming == pytest.approx(recording.steady.warming[:3])
    assert np.std((found * 60e3 - 60.0 + 0.01 * stated / 1e5) / (60e3 * error)) == pytest.approx(1.0, abs=0.4)
    texts = " ".join(note.text for note in recording.notes)
    assert "quasi-steady points" in texts
    scatter = re.search(r"Q_out: its samples scatter by ([\d.]+) L/min", texts)
    assert float(scatter[1]) == pytest.approx(0.05, rel=0.05)
    assert "repeatability" not in texts  # of means: their standard errors, which no statement and no step replaces
    assert all(channel.quantum == 0.0 for channel in recording.channels)


def test_series_gives_its_plateaus(tmp_path):
    rng = np.random.default_rng(3)
    levels = np.repeat([1000.0, 1500.0, 1200.0], 600)
    count = len(levels)
    speed, flow = levels + 0.5 * rng.standard_normal(count), 0.06 * levels + 0.1 * rng.standard_normal(count)
    rows = [f"{0.1 * k:.1f},{speed[k]:.3f},150,50,{flow[k]:.4f}" for k in range(count)]
    form = HEAD + '[series]\nfile = "steady.csv"\ntime = { column = "t", unit = "s" }\nsteady = { window = "10 s" }\n'
    bare = CHANNELS.replace(", sigma = 0.08, sigma_relative = 0.0006", "")
    recording = read_recording(_written(tmp_path, form + bare, "t,n,p,T,Q\n" + "\n".join(rows)))
    assert len(recording.steady.values) == 3
    flow = recording.steady.column(ChannelName.Q_OUT) * 60e3
    assert set(np.round(flow)) == {60.0, 90.0, 72.0}
    assert np.isnan(recording.steady.errors).all()
    assert np.all(np.diff(recording.steady.hours) > 0.0)
    assert recording.channel(ChannelName.Q_OUT).sigma * 60e3 == pytest.approx(0.1 / math.sqrt(600), rel=0.5)


def test_traces_belong_to_their_points(tmp_path):
    angle = np.arange(0, 360, 2.0)
    rows = [f"{k},{a},{100 * k + 1.01325}" for k in (1, 3) for a in angle]
    form = (
        HEAD
        + STEADY
        + CHANNELS
        + """[traces]
file = "traces.csv"
point = "k"
encoder_offset = "0.5 deg"
angle = { column = "angle", unit = "deg" }
p_chamber = { column = "p", unit = "bar", sigma = 0.4 }
"""
    )
    (tmp_path / "traces.csv").write_text("k,angle,p\n" + "\n".join(rows), "utf-8")
    recording = read_recording(_written(tmp_path, form))
    assert [trace.point for trace in recording.traces] == [0, 2]
    assert np.allclose(recording.traces[1].mean, 3e7)
    assert recording.channel(ChannelName.ANGLE).zero_sigma == pytest.approx(math.radians(0.5))
    assert recording.channel(ChannelName.P_CHAMBER).sigma == pytest.approx(0.4e5)
    assert set(_paths(tmp_path, form=form.replace('"k"', '"q"'))) == {"traces.point"}
    (tmp_path / "traces.csv").write_text("k,angle,p\n" + "\n".join([*rows, ",3,100", ",4,100"]), "utf-8")
    told = [note.text for note in read_recording(_written(tmp_path, form)).notes]
    assert "traces: 2 rows without a number in 'k' belong to no point and are left out" in told


def test_every_fault_at_once_with_its_line_and_the_nearest_choice(tmp_path):
    form = """format = 1
pressure_reference = "abs"
circuit = "opn"
titel = "x"
[steady]
file = "stedy.csv"
[channel]
sped = { column = "n", unit = "rpm", sigma = 0.5 }
p_out = { column = "p", unit = "Nm", sigma = -1 }
T_case = { column = "T", unit = "degC", sigma_relative = 0.1 }
"""
    faults = _paths(tmp_path, form=form)
    assert {
        "pressure_reference", "circuit", "titel", "channel.sped", "channel.p_out.unit", "channel.p_out.sigma",
        "channel.T_case.sigma_relative",
    } <= set(faults)  # fmt: skip
    assert faults["circuit"].nearest == "open"
    assert faults["channel.sped"].nearest == "speed"
    columns = _paths(tmp_path, form=(HEAD + STEADY + CHANNELS).replace('"Q"', '"q"'))
    assert columns["channel.Q_out.column"].nearest == "Q"
    assert "steady.csv" in _paths(tmp_path, form=(HEAD + STEADY + CHANNELS).replace("steady.csv", "stedy.csv"))[
        "steady.file"
    ].nearest  # fmt: skip


SERIES = '[series]\nfile = "steady.csv"\ntime = { column = "t", unit = "s" }\n'


def _ramp(rows, speed="1500", **columns):
    """A ramp of pressure with a row each second, its flow and the columns named; without a number where empty."""
    heads = ",".join(["t,n,p,T,Q", *columns])
    wobble = [0.01 * (k * k % 7) for k in range(rows)]
    lines = [
        f"{k},{speed if k else 1},{100 + 0.1 * k + wobble[k]:.3f},50,{90 - 0.005 * k - 0.3 * wobble[k]:.4f}"
        for k in range(rows)
    ]
    return "\n".join([heads, *(",".join([line, *columns.values()]) for line in lines)]) + "\n"


@pytest.mark.parametrize("form", [STEADY, SERIES])
@pytest.mark.parametrize("channel", ['torque = { column = "M", unit = "N m"', 'T_in = { column = "M", unit = "degC"'])
def test_a_column_without_a_number_is_told_by_its_channel(tmp_path, form, channel):
    """An output and an input that were not connected, in a table of points and in a ramp."""
    faults = _paths(tmp_path, form=HEAD + form + CHANNELS + channel + " }\n", table=_ramp(60, M=""))
    name = channel.partition(" ")[0]
    assert faults[f"channel.{name}"].found == f"{name} has no reading at any point"
    assert set(faults) == {f"channel.{name}"}


@pytest.mark.parametrize("rows", range(2, 8))
def test_a_series_of_a_few_rows_is_refused_with_the_number_it_needs(tmp_path, rows):
    """One of them at rest, with less than 5 % of the usual speed."""
    faults = _paths(tmp_path, form=HEAD + SERIES + CHANNELS, table=_ramp(rows))
    assert faults["series"].expected == "at least 8 samples of a series"


KEYS = ["format", "title", "steady", "series", "traces", "channel", "circuit", "order", "pump"]
INNER = ["file", "speed", "p_out", "unit", "column", "time", "sigma", "x"]
TEXTS = st.sampled_from(["", "n", "rpm", "10 s", "1 bar"])
ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 3) | st.floats(-1, 1) | TEXTS,
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.sampled_from(INNER), inner, max_size=4),
    max_leaves=8,
)


def _toml(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list):
        return "[" + ", ".join(_toml(item) for item in value if item is not None) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items() if item is not None) + " }"
    return repr(value)


@settings(max_examples=80, deadline=None)
@given(top=st.dictionaries(st.sampled_from(KEYS), ANYTHING, max_size=6))
def test_whatever_a_form_says_it_is_read_or_refused(tmp_path_factory, top):
    text = "\n".join(f"{key} = {_toml(value)}" for key, value in top.items() if value is not None)
    folder = _written(tmp_path_factory.mktemp("fuzz"), text)
    with pytest.raises(InputFaults) as refused:
        read_recording(folder)
    assert refused.value.faults


def test_bench_recordings_are_read(shared):
    folders = sorted((shared / "recordings" / "bench").glob("open-*"))
    assert len(folders) == 10
    for folder in folders:
        recording = read_recording(folder)
        assert recording.pump == "ref90"
        assert np.isfinite(recording.steady.column(ChannelName.TORQUE)).all()
        assert len(recording.traces) == (4 if (folder / "traces.csv").is_file() else 0)
