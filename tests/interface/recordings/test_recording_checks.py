"""Checks of the readings of a recording: each planted slip is found, and nothing in sound ones."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis import (
    Circuit,
    NoteKind,
    RecordedChannel,
    Recording,
    SteadyTable,
    TraceBlock,
    check_recording,
    load_thresholds,
    read_recording,
)
from diagnosis.checks.check import too_few
from diagnosis.checks.outliers import scaled_places
from diagnosis.recording.line_pressures import varied_lines
from diagnosis.study.departures import departure_shapes
from system import INPUTS, OUTPUTS, ChannelName, Dimension
from system.inputs.units import parse_quantity

DISPLACEMENT = 90e-6  # m3/rev
LIMITS = load_thresholds().data
COLUMNS = {name: place for place, name in enumerate(ChannelName)}
UNITS = {
    "speed": ("rpm", 0.05), "displacement_ratio": ("1", 0.0), "p_out": ("bar", 1.5e4), "p_in": ("bar", 2e3),
    "p_case": ("bar", 1e3), "T_in": ("degC", 0.15), "T_case": ("degC", 0.2), "Q_out": ("L/min", 2e-6),
    "Q_in": ("L/min", 2e-6), "Q_case": ("L/min", 4e-7), "torque": ("N m", 0.3),
}  # fmt: skip


def _sound(seed: int = 1) -> Recording:
    """A map of a pump with slips, leakage and friction, and noise: 4 speeds x 6 pressures x 2 ratios x 2 T."""
    rng = np.random.default_rng(seed)
    speed, p_out, ratio, hot = (
        a.ravel() for a in np.meshgrid([105, 160, 210, 260], np.linspace(5e6, 38e6, 6), [0.5, 1.0], [323.0, 343.0])
    )
    viscosity = 0.03 * np.exp(-0.03 * (hot - 323.0))
    leak = 1e-5 * p_out / 35e6 * 0.03 / viscosity * (1.0 + 0.3 * p_out / 35e6)
    flow = ratio * DISPLACEMENT / (2 * np.pi) * speed
    clean = {
        "speed": speed, "displacement_ratio": ratio, "p_out": p_out, "p_in": 2.4e6 + 0 * p_out,
        "p_case": 5e4 + 2e9 * leak, "T_in": hot - 3.0, "T_case": hot + 1e-7 * p_out, "Q_in": flow,
        "Q_out": flow * (1 - p_out / 1.7e9) - leak, "Q_case": leak,
        "torque": ratio * DISPLACEMENT / (2 * np.pi) * (p_out - 2.4e6) * 1.03 + 5.0 + 0.02 * speed,
    }  # fmt: skip
    values = np.full((len(speed), len(ChannelName)), np.nan)
    channels = []
    for name, (unit, sigma) in UNITS.items():
        values[:, COLUMNS[ChannelName.named(name)]] = clean[name] + sigma * rng.standard_normal(len(speed))
        channels.append(RecordedChannel(ChannelName.named(name), name, unit, sigma, 0.0, 0.01 * sigma, 0, 0, 0, ()))
    count = len(speed)
    steady = SteadyTable(values, np.arange(count), np.full(count, np.nan), np.full_like(values, np.nan))
    return Recording("map", "", "", Circuit.CLOSED, tuple(channels), steady, (), ())


def _with(name: str, change) -> Recording:
    """The sound recording with one channel's readings changed."""
    recording = _sound()
    values = recording.steady.values.copy()
    place = COLUMNS[ChannelName.named(name)]
    values[:, place] = change(values[:, place])
    return replace(recording, steady=replace(recording.steady, values=values))


def _told(recording: Recording) -> list:
    return [(note.kind, note.channel, note.text) for note in check_recording(recording, DISPLACEMENT, LIMITS).notes]


@pytest.mark.parametrize("seed", range(5))
def test_sound_readings_tell_nothing(seed):
    recording = _sound(seed)
    checked = check_recording(recording, DISPLACEMENT, LIMITS)
    assert checked.notes == ()
    assert np.array_equal(checked.steady.values, recording.steady.values, equal_nan=True)


@pytest.mark.parametrize(
    ("name", "factor", "hint"),
    [
        ("p_out", 0.1, "p_out in 'MPa'"),
        ("p_out", 10.0, "factor of 10"),
        ("Q_out", 10.0, "factor of 10"),
        ("Q_out", 60.0 / 1000.0, "'m3/h'"),
        ("torque", 0.1, "torque too small by a factor of 10"),
        ("torque", 1e-3, "'kN m'"),
        ("speed", 0.1, "speed too small by a factor of 10"),
        ("Q_in", 0.1, "Q_in too small by a factor of 10"),
        ("Q_case", -1.0, "of the other sign"),
        ("torque", -1.0, "torque of the other sign"),
        ("Q_case", 10.0, "Q_case is far beyond"),
        ("displacement_ratio", 100.0, "unit = '%'"),
    ],
)
def test_units_off_by_a_factor_are_faults_with_the_unit_that_mends_them(name, factor, hint):
    notes = _told(_with(name, lambda x: factor * x))
    assert hint in " ".join(text for kind, _, text in notes if kind is NoteKind.FAULT)


@pytest.mark.parametrize("wrong", [0.1, 10.0])
def test_flow_and_torque_that_are_off_alike_are_those_of_another_displacement(wrong):
    """The pump file is in doubt before the meters are; a flow alone says nothing of it."""
    notes = check_recording(_sound(), wrong * DISPLACEMENT, LIMITS).notes
    faults = [note.text for note in notes if note.kind is NoteKind.FAULT]
    hints = [text.partition("; pump.displacement of the pump file about ")[2] for text in faults]
    assert len([hint for hint in hints if hint]) >= 2
    for size, unit in (hint.split()[:2] for hint in hints if hint):
        assert parse_quantity(f"{size} {unit}", Dimension.DISPLACEMENT) == pytest.approx(DISPLACEMENT, rel=0.2)
    flow = check_recording(_with("Q_out", lambda x: 10.0 * x), DISPLACEMENT, LIMITS).notes
    assert not any("pump.displacement" in note.text for note in flow)


def test_the_shaft_s_power_in_place_of_its_torque_is_told():
    speed = _sound().steady.column(ChannelName.SPEED)
    notes = _told(_with("torque", lambda x: 1e-3 * x * speed))
    assert "torque is the shaft's power in kW" in " ".join(text for kind, _, text in notes if kind is NoteKind.FAULT)


@pytest.mark.parametrize(("name", "sigma", "share"), [("torque", 0.0, 6.0), ("Q_case", 1.0, 0.0), ("p_out", 1e9, 0.0)])
def test_a_repeatability_beyond_the_readings_is_a_fault(name, sigma, share):
    sound, named = _sound(), ChannelName.named(name)
    channels = [replace(one, sigma=sigma, sigma_relative=share) if one.name is named else one for one in sound.channels]
    faults = [note for note in _told(replace(sound, channels=tuple(channels))) if note[0] is NoteKind.FAULT]
    assert [channel for _, channel, _ in faults] == [named]
    assert "sigma_relative" in faults[0][2]


def test_an_open_circuit_that_is_charged_is_told():
    notes = _told(replace(_sound(), circuit=Circuit.OPEN))
    assert [(kind, channel) for kind, channel, _ in notes] == [(NoteKind.WARNED, ChannelName.P_IN)]
    assert "circuit = 'closed'" in notes[0][2]


def test_kelvin_read_as_celsius():
    kind, channel, text = _told(_with("T_case", lambda x: x + 273.15))[0]
    assert (kind, channel) == (NoteKind.FAULT, ChannelName.T_CASE)
    assert "'K'" in text


def test_gauge_read_as_absolute_and_places_changed():
    assert "gauge pressure taken as absolute" in _told(_with("p_case", lambda x: x - 2.0e5))[0][2]
    recording = _sound()
    values = recording.steady.values.copy()
    pair = [COLUMNS[ChannelName.P_OUT], COLUMNS[ChannelName.P_IN]]
    values[:, pair] = values[:, pair[::-1]]
    swapped = replace(recording, steady=replace(recording.steady, values=values))
    assert any("swapped" in text and kind is NoteKind.FAULT for kind, _, text in _told(swapped))


def test_the_columns_of_flow_and_torque_swapped_are_told():
    """Each has the other's numbers, in its own unit: L/min and N m."""
    recording = _sound()
    values = recording.steady.values.copy()
    flow, torque = COLUMNS[ChannelName.Q_OUT], COLUMNS[ChannelName.TORQUE]
    values[:, [flow, torque]] = values[:, [torque, flow]] * [1.0 / 6e4, 6e4]
    faults = _told(replace(recording, steady=replace(recording.steady, values=values)))
    hinted = {channel for _, channel, text in faults if "the columns of Q_out and torque swapped" in text}
    assert hinted == {ChannelName.Q_OUT, ChannelName.TORQUE}
    assert not any("swapped" in text for _, _, text in _told(_with("torque", lambda x: 0.1 * x)))


@pytest.mark.parametrize("name", ["Q_out", "Q_case", "torque"])
@pytest.mark.parametrize("size", [12.0, -15.0])
def test_one_slip_is_put_aside_and_nothing_else(name, size):
    def slip(column):
        column = column.copy()
        column[41] += size * max(0.004 * abs(column[41]), UNITS[name][1])
        return column

    recording = _with(name, slip)
    checked = check_recording(recording, DISPLACEMENT, LIMITS)
    removed = [note for note in checked.notes if note.kind is NoteKind.REMOVED]
    assert [(note.channel.value, note.points) for note in removed] == [(name, (41,))]
    assert np.isnan(checked.steady.column(ChannelName.named(name))[41])
    assert np.isfinite(checked.steady.values).sum() == np.isfinite(recording.steady.values).sum() - 1


def test_an_effect_at_the_rim_of_the_map_is_no_outlier():
    recording = _sound()
    speed, p_out = recording.steady.column(ChannelName.SPEED), recording.steady.column(ChannelName.P_OUT)

    def starved(flow):
        return np.where((speed > 250.0) & (p_out > 30e6), 0.97 * flow, flow)

    assert not [note for note in _told(_with("Q_out", starved)) if note[0] is NoteKind.REMOVED]


def _suspects(recording: Recording) -> set[tuple[str, int]]:
    """Channel and point of the suspects; nothing is removed."""
    checked = check_recording(recording, DISPLACEMENT, LIMITS)
    assert not [note for note in checked.notes if note.kind is NoteKind.REMOVED]
    assert np.array_equal(checked.steady.values, recording.steady.values, equal_nan=True)
    return {(note.channel.value, *note.points) for note in checked.notes if note.kind is NoteKind.SUSPECT}


def test_channels_that_depart_together_are_suspects():
    """The slip of the test before, and the torque with it: a state of the bench, or physics."""
    recording = _with("Q_out", lambda x: np.where(np.arange(x.size) == 41, 0.97 * x, x))
    values = recording.steady.values.copy()
    values[41, COLUMNS[ChannelName.TORQUE]] *= 0.97
    assert _suspects(replace(recording, steady=replace(recording.steady, values=values))) == {
        ("Q_out", 41), ("torque", 41),
    }  # fmt: skip


@pytest.mark.parametrize("point", [0, 36, 95])
def test_a_reading_at_an_end_is_a_suspect(point):
    """The first and the last point of the recording, and one at the highest pressure amid speed and order."""
    rim = {0: 0, 95: 95, 36: int(np.flatnonzero(_sound().steady.column(ChannelName.P_OUT) > 37e6)[5])}[point]
    found = _suspects(_with("Q_case", lambda x: np.where(np.arange(x.size) == rim, 1.3 * x, x)))
    assert found <= {("Q_case", rim)}  # at a corner no neighbour vouches for a point: then there is no note
    assert found or point != 36


def test_a_throttled_inlet_is_no_slip():
    """Twelve points of one speed, the inlet pressure stepped down: at the lowest two the flow falls."""
    recording = _sound()
    values = np.concatenate([recording.steady.values, np.repeat(recording.steady.values[41:42], 12, axis=0)])
    rng = np.random.default_rng(2)
    inlet = np.linspace(2.4e6, 2e5, 12)
    values[96:, COLUMNS[ChannelName.P_IN]] = inlet
    for name in ("Q_out", "Q_in", "Q_case", "torque", "speed", "p_out", "p_case", "T_in", "T_case"):
        values[96:, COLUMNS[ChannelName.named(name)]] += UNITS[name][1] * rng.standard_normal(12)
    for name in ("Q_out", "Q_in"):
        values[106:, COLUMNS[ChannelName.named(name)]] *= [0.99, 0.93]
    count = len(values)
    steady = SteadyTable(values, np.arange(count), np.full(count, np.nan), np.full_like(values, np.nan))
    assert {point for _, point in _suspects(replace(recording, steady=steady))} <= {106, 107}


def _held(column):
    """Readings of which seven on end are alike."""
    column = column.copy()
    column[20:27] = column[20]
    return column


def test_stuck_sensor_is_put_aside():
    notes = check_recording(_with("torque", _held), DISPLACEMENT, LIMITS).notes
    removed = [note for note in notes if note.kind is NoteKind.REMOVED]
    assert removed[0].channel is ChannelName.TORQUE
    assert removed[0].points == tuple(range(20, 27))


def test_a_stuck_input_is_put_aside_and_a_set_one_told():
    notes = check_recording(_with("T_case", _held), DISPLACEMENT, LIMITS).notes
    removed = [note for note in notes if note.kind is NoteKind.REMOVED]
    assert [(n.channel, n.points) for n in removed] == [(ChannelName.T_CASE, tuple(range(20, 27)))]
    told = _told(_with("p_in", lambda x: 0.0 * x + 2.4e6))
    assert [(kind, channel) for kind, channel, _ in told] == [(NoteKind.NOTED, ChannelName.P_IN)]


def test_rows_written_twice_are_a_fault():
    recording = _sound()
    steady = recording.steady
    twice = steady.at(np.concatenate([np.arange(len(steady.values)), np.arange(20)]))
    told = _told(replace(recording, steady=twice))
    assert any(kind is NoteKind.FAULT and "written twice" in text for kind, _, text in told)


def test_a_flow_computed_from_two_others_is_a_fault():
    own = _sound().steady
    total = own.column(ChannelName.Q_OUT) + own.column(ChannelName.Q_CASE)
    told = _told(_with("Q_in", lambda _: total))
    assert any(kind is NoteKind.FAULT and "one is computed" in text for kind, _, text in told)


def test_two_pumps_in_one_recording_are_told():
    def smaller(column):
        return np.where(np.arange(len(column)) % 2, 0.6 * column, column)

    assert any(kind is NoteKind.NOTED and "two pumps" in text for kind, _, text in _told(_with("Q_in", smaller)))
    recording = _sound()
    values = recording.steady.values.copy()
    for name in (ChannelName.Q_IN, ChannelName.Q_OUT, ChannelName.TORQUE):
        values[:, COLUMNS[name]] = smaller(values[:, COLUMNS[name]])
    told = _told(replace(recording, steady=replace(recording.steady, values=values)))
    assert any(kind is NoteKind.FAULT and "two pumps" in text for kind, _, text in told)


@pytest.mark.parametrize(
    ("name", "change", "told"), [("p_case", 1.3e6, "p_case is"), ("T_case", -9.0, "swapped"), ("T_in", 90.0, "degF")]
)
def test_a_case_that_is_seldom_meant_is_told(name, change, told):
    kinds = {kind for kind, _, text in _told(_with(name, lambda x: x + change)) if told in text}
    assert kinds == {NoteKind.WARNED}


def test_copies_and_readings_without_noise_are_faults():
    recording = _sound()
    own = recording.steady.column(ChannelName.Q_OUT)
    assert any("follows" in text for _, _, text in _told(_with("Q_in", lambda _: 1.02 * own + 1e-6)))
    values = np.repeat(recording.steady.values[::2], 2, axis=0)
    values[1::2, COLUMNS[ChannelName.TORQUE]] += 0.3
    numbers = np.repeat(np.arange(len(values) // 2), 2)
    repeated = replace(recording, steady=replace(recording.steady, values=values, repeats=numbers))
    found = {n.channel for n in check_recording(repeated, DISPLACEMENT, LIMITS).notes if "without noise at" in n.text}
    assert found == {ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE}


@pytest.mark.parametrize("further", [(), ("Q_slipper",), ("Q_slipper", "Q_piston")])
def test_a_flow_of_the_balance_that_is_computed_is_told_beside_drains_of_gaps(further):
    """The case drain as inlet less delivery; a gap's own drain is no part of the balance, and is not named."""
    recording = _sound()
    values = recording.steady.values.copy()
    column = {name: values[:, COLUMNS[ChannelName.named(name)]] for name in ("Q_in", "Q_out", "Q_case")}
    drains = np.random.default_rng(3).uniform(0.2, 0.4, (len(further), len(values))) * column["Q_case"]
    values[:, COLUMNS[ChannelName.Q_CASE]] = column["Q_in"] - column["Q_out"]
    of_flow = recording.channel(ChannelName.Q_CASE)
    more = tuple(replace(of_flow, name=ChannelName.named(one), column=one) for one in further)
    for one, drain in zip(further, drains, strict=True):
        values[:, COLUMNS[ChannelName.named(one)]] = drain
    steady = replace(recording.steady, values=values)
    told = _told(replace(recording, steady=steady, channels=(*recording.channels, *more)))
    assert [text for _, _, text in told if "one is computed" in text] == [
        "Q_out, Q_in, Q_case depend on each other without noise: one is computed; leave it out of [channel]"
    ]


COARSE = """format = 1
pressure_reference = "gauge"
[steady]
file = "steady.csv"
repeats = "k"
[channel]
p_out = { column = "p", unit = "bar", sigma = 0.1 }
torque = { column = "M", unit = "N m", sigma = 0.1, more }
"""


def _thrice(folder, step, more=""):
    """Notes on five set points read three times; the torque, which scatters by .1 N m, shown in steps."""
    rng = np.random.default_rng(8)
    torque = np.repeat([71.0, 143.0, 208.0, 275.0, 339.0], 3) + 0.1 * rng.standard_normal(15)
    pressure = np.repeat([50.0, 100.0, 150.0, 200.0, 250.0], 3) + 0.1 * rng.standard_normal(15)
    shown = step * np.round((np.repeat(torque[::3], 3) if step < 0.1 else torque) / step)
    rows = [f"{k // 3},{p:.2f},{m:.4f}" for k, (p, m) in enumerate(zip(pressure, shown, strict=True))]
    (folder / "steady.csv").write_text("k,p,M\n" + "\n".join(rows), "utf-8")
    (folder / "recording.toml").write_text(COARSE.replace(", more", more), "utf-8")
    recording = read_recording(folder)
    return recording.channel(ChannelName.TORQUE), [text for _, _, text in _told(recording)]


@pytest.mark.parametrize("more", ["", ", quantum = 1"])
def test_repeats_on_a_coarse_display_are_alike(tmp_path, more):
    """Its step is that of the readings, stated or not, and the noise is that of the step."""
    channel, told = _thrice(tmp_path, 1.0, more)
    assert channel.quantum == 1.0
    assert not any("without noise" in text for text in told)


def test_repeats_with_finer_digits_than_their_noise_are_not_measured(tmp_path):
    assert any("torque repeats itself without noise" in text for text in _thrice(tmp_path, 0.001)[1])


@pytest.mark.parametrize(
    ("name", "middle", "swing", "sigma", "varies"),
    [
        ("p_in", 0.0, 500.0, 1e3, False),
        ("p_in", 25e5, 1e4, 1e3, False),
        ("p_in", 0.0, 2e4, 2e4, False),
        ("p_in", 0.0, 2e4, 5e2, True),
        ("p_case", 2e5, 1e5, 1e3, True),
        ("p_case", -5e4, 2e4, 1e3, True),
    ],
)
def test_the_pressure_of_a_line_varies_beyond_its_control_and_its_scatter(name, middle, swing, sigma, varies):
    """Of the absolute pressure, in the checks as in the study: +-.005 bar about 0 gauge is no input that moves."""
    recording = _sound()
    place = COLUMNS[ChannelName.named(name)]
    values = recording.steady.values.copy()
    values[:, place] = middle + swing * np.cos(7.0 * np.arange(len(values)))
    channels = tuple(replace(one, sigma=sigma) if one.name.value == name else one for one in recording.channels)
    changed = replace(recording, steady=replace(recording.steady, values=values), channels=channels)
    assert (ChannelName.named(name) in varied_lines(changed)) is varies
    of_study = {one for family in departure_shapes(changed).families for one in family.inputs}
    assert (ChannelName.named(name) in of_study) is varies
    assert scaled_places(changed).shape[1] - 4 == len(varied_lines(changed))


def test_an_output_without_noise_is_a_fault():
    recording = _sound()
    perfect = tuple(replace(c, sigma=0.0) if c.name is ChannelName.TORQUE else c for c in recording.channels)
    told = _told(replace(recording, channels=perfect))
    assert any(kind is NoteKind.FAULT and channel is ChannelName.TORQUE for kind, channel, _ in told)


def test_gaps_and_too_few_readings_are_told():
    def gap(column):
        column = column.copy()
        column[[3, 4]] = np.nan
        return column

    (kind, channel, text), *_ = _told(_with("Q_case", gap))
    assert (kind, channel) == (NoteKind.NOTED, ChannelName.Q_CASE)
    assert "2 of 96" in text
    count = 4 * 96
    warm = _with("T_out", lambda _: _sound().steady.column(ChannelName.T_CASE))
    assert too_few(warm, count) is not None  # an outlet temperature is not simulated
    assert too_few(_sound(), count - 1) is None
    fault = too_few(_sound(), count)
    assert fault is not None
    assert fault.kind is NoteKind.FAULT
    assert "at 96 operating points" in fault.text
    alone = replace(_sound(), steady=_sound().steady.at(slice(0, 1)))
    still = too_few(alone, 8)
    assert still is not None
    assert "one operating point, inputs do not move" in still.text
    assert len(OUTPUTS) + len(INPUTS) <= len(ChannelName)


def test_more_points_than_a_diagnosis_takes_are_told_with_the_share_to_keep():
    recording = _sound()
    rows = np.arange(1001) % 96
    many = replace(recording, steady=recording.steady.at(rows))
    (told,) = [text for kind, _, text in _told(many) if kind is NoteKind.FAULT and "at most" in text]
    assert told.startswith("1001 steady points, of which a diagnosis takes 1000 at most; keep one row in 2")
    assert not any(
        "at most" in text for _, _, text in _told(replace(recording, steady=recording.steady.at(rows[:1000])))
    )


def test_bench_recordings_tell_nothing(shared):
    from diagnosis import read_recording

    for folder in sorted((shared / "recordings" / "bench").glob("open-*")):
        recording = read_recording(folder)
        assert check_recording(recording, DISPLACEMENT, LIMITS).notes == recording.notes, folder.name


def _without_speed(recording: Recording) -> Recording:
    values = recording.steady.values.copy()
    values[:, COLUMNS[ChannelName.SPEED]] = np.nan
    channels = tuple(one for one in recording.channels if one.name is not ChannelName.SPEED)
    return replace(recording, channels=channels, steady=replace(recording.steady, values=values))


def test_speeds_that_are_not_recorded_are_a_fault_where_the_flow_shows_them():
    faults = [text for kind, name, text in _told(_without_speed(_sound())) if kind is NoteKind.FAULT]
    assert len(faults) == 1
    assert "Q_out over displacement_ratio varies" in faults[0]
    assert "Add the speed" in faults[0]


def test_one_speed_need_not_be_recorded():
    sound = _sound()
    rows = sound.steady.column(ChannelName.SPEED) < 110.0
    kept = SteadyTable(
        sound.steady.values[rows], np.arange(rows.sum()), np.full(rows.sum(), np.nan), sound.steady.errors[rows]
    )
    told = _told(_without_speed(replace(sound, steady=kept)))
    assert not [text for kind, _, text in told if kind is NoteKind.FAULT]


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("T_in", -9999.0 + 273.15, "reads -9999 degC, beyond the range of a bench"),
        ("Q_case", -9999.0 / 6e4, "reads -9999 L/min, beyond the range of a bench"),
        ("torque", 9999.0, "reads 9999 N m, nines far from all other readings"),
        ("speed", 0.0, "reads 0 rpm, beyond the range of a bench"),
        ("speed", -105.0, "reads -1002.68 rpm, beyond the range of a bench"),
        ("p_out", 3.2e8, "reads 3200 bar gauge, beyond the range of a bench"),
        ("Q_out", 0.0, "reads 0 L/min, far from all other readings: no signal"),
    ],
)
def test_readings_that_no_bench_gives_are_put_aside(name, value, told):
    """Six of 48, a logger's code or a sensor without a signal; no other reading goes with them."""
    at = np.arange(3, 48, 8)

    def slip(values):
        values[at] = value
        return values

    checked = check_recording(_with(name, slip), DISPLACEMENT, LIMITS)
    (note,) = checked.notes
    assert (note.kind, note.channel, note.points) == (NoteKind.REMOVED, ChannelName.named(name), tuple(at))
    assert told in note.text
    assert np.isnan(checked.steady.values).sum() == np.isnan(_sound().steady.values).sum() + len(at)


def test_nines_among_their_like_are_readings():
    """99.9 bar among others is a pressure; a flow of 0 at no displacement is a flow."""
    sound = _sound()
    values = sound.steady.values.copy()
    values[0, COLUMNS[ChannelName.P_OUT]] = 99.9e5
    values[1, [COLUMNS[ChannelName.DISPLACEMENT_RATIO], COLUMNS[ChannelName.Q_OUT]]] = 0.0
    found = check_recording(replace(sound, steady=replace(sound.steady, values=values)), None, LIMITS)
    assert not any("nines" in note.text or "no signal" in note.text for note in found.notes)


def test_an_output_that_never_changes_is_a_fault():
    found = _told(_with("Q_case", lambda values: 0 * values + 1e-5))
    assert (NoteKind.FAULT, ChannelName.Q_CASE) in {(kind, channel) for kind, channel, text in found if "stuck" in text}


def test_a_recording_of_inputs_alone_is_a_fault():
    sound = _sound()
    bare = replace(sound, channels=tuple(one for one in sound.channels if one.name in INPUTS))
    assert any("none of Q_out, Q_in, Q_case, torque" in text for _, _, text in _told(bare))


def test_rows_without_any_reading_are_not_written_twice():
    sound = _sound()
    values = sound.steady.values.copy()
    values[4:12] = np.nan
    found = check_recording(replace(sound, steady=replace(sound.steady, values=values)), DISPLACEMENT, LIMITS)
    assert not any("written twice" in note.text for note in found.notes)


def test_a_displacement_ratio_in_percent_is_hinted_at():
    found = _told(_with("displacement_ratio", lambda values: 0.01 * values))
    assert any("displacement_ratio in '1'" in text for _, _, text in found)


@pytest.mark.parametrize(("factor", "faults"), [(1.0, 0), (10.0, 1), (0.1, 1)])
def test_traces_are_held_against_delivery_pressure(factor, faults):
    """A chamber is at delivery pressure for a good part of the turn; bar read as MPa is ten times that."""
    sound = _sound()
    angle = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    course = np.where(angle > np.pi, sound.steady.column(ChannelName.P_OUT)[5], 2.4e6)
    traced = replace(
        sound,
        traces=(TraceBlock(5, angle, factor * course, None, 1),),
        channels=(*sound.channels, RecordedChannel(ChannelName.P_CHAMBER, "p", "bar", 4e4, 0, 0, 0, 0, 0, ())),
    )
    found = [text for _, channel, text in _told(traced) if channel is ChannelName.P_CHAMBER]
    assert len(found) == faults


def _of_channels(*names: str, held: tuple[str, ...] = ()) -> Recording:
    """The sound recording with some channels alone, those `held` at one level with noise."""
    sound = _sound()
    values = np.full_like(sound.steady.values, np.nan)
    for name in names:
        place = COLUMNS[ChannelName.named(name)]
        column = sound.steady.values[:, place]
        noise = UNITS[name][1] * np.random.default_rng(2).standard_normal(len(column))
        values[:, place] = np.median(column) + noise if name in held else column
    kept = tuple(one for one in sound.channels if one.name.value in names)
    return replace(sound, channels=kept, steady=replace(sound.steady, values=values))


def test_points_that_are_all_alike_are_warned_of_and_a_single_output_is_noted():
    recording = _of_channels("speed", "p_out", "Q_case", held=("speed", "p_out", "Q_case"))
    kinds = {
        note.text.partition(",")[0].partition(":")[0]: note.kind
        for note in check_recording(recording, None, LIMITS).notes
    }
    assert kinds["all points are one"] is NoteKind.WARNED
    assert kinds["Q_case is the only output"] is NoteKind.NOTED


def test_an_input_that_stays_is_noted():
    recording = _of_channels("speed", "p_out", "T_case", "Q_case", "Q_out", held=("p_out",))
    (note,) = (n for n in check_recording(recording, None, LIMITS).notes if n.channel is ChannelName.P_OUT)
    assert note.kind is NoteKind.NOTED
    assert "how they grow with it are alike" in note.text


def test_an_output_without_any_input_is_a_fault():
    faults = [n for n in check_recording(_of_channels("Q_case"), None, LIMITS).notes if n.kind is NoteKind.FAULT]
    assert "no input is recorded" in faults[0].text
