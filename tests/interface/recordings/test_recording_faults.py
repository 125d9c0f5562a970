"""Each thing that can be wrong with a recording's files is told: where, what was found, what was expected."""

from __future__ import annotations

from pathlib import Path

import pytest

from diagnosis import read_recording
from system import Fault, InputFaults

HEAD = 'format = 1\npressure_reference = "gauge"\n'
STEADY = '[steady]\nfile = "steady.csv"\n'
SERIES = '[series]\nfile = "steady.csv"\ntime = { column = "t", unit = "s" }\n'
SPEED = 'speed = { column = "n", unit = "rpm", sigma = 0.5 }\n'
CHANNELS = f"[channel]\n{SPEED}" + 'Q_out = { column = "Q", unit = "L/min", sigma = 0.08 }\n'
TRACES = """[traces]
file = "traces.csv"
point = "k"
angle = { column = "angle", unit = "deg" }
p_chamber = { column = "p", unit = "bar", sigma = 0.4 }
"""
TABLE = "k,t,n,Q\n" + "".join(f"{k},{0.1 * k:.1f},{1000 + k % 3},{60 + k % 5}\n" for k in range(1, 61))
TURN = "".join(f"1,{angle},100\n" for angle in range(0, 360, 2))
WHOLE = HEAD + STEADY + CHANNELS


def _faults(folder: Path, form: str, table: str = TABLE, trace: str = TURN) -> list[Fault]:
    (folder / "recording.toml").write_text(form, "utf-8")
    (folder / "steady.csv").write_text(table, "utf-8")
    (folder / "traces.csv").write_text("k,angle,p\n" + trace, "utf-8")
    with pytest.raises(InputFaults) as refused:
        read_recording(folder)
    return list(refused.value.faults)


def _told(faults: list[Fault], path: str, found: str, expected: str) -> bool:
    return any(path == one.path and found in one.found and expected in one.expected for one in faults)


@pytest.mark.parametrize(
    ("form", "path", "found", "expected"),
    [
        (WHOLE.replace("format = 1", "format = 2"), "format", "2", "format = 1"),
        (WHOLE.replace("format = 1\n", ""), "format", "missing", "format = 1"),
        ("title = 3\n" + WHOLE, "title", "3", "a text"),
        (HEAD + CHANNELS, "steady", "neither [steady] nor [series]", "one of the two"),
        (WHOLE + SERIES, "steady", "both [steady] and [series]", "one of the two"),
        (HEAD + "[steady]\n" + CHANNELS, "steady.file", "missing", "the path of the table"),
        (HEAD + STEADY, "channel", "missing", "a table with speed"),
        (HEAD + STEADY + "[channel]\n", "channel", "an empty table", "at least one of speed"),
        (WHOLE.replace('column = "n", ', ""), "channel.speed.column", "missing", "name of a column"),
        (WHOLE.replace('unit = "rpm", ', ""), "channel.speed.unit", "missing", "a rotational speed"),
        (WHOLE.replace('"rpm"', '"bar"'), "channel.speed.unit", "bar", "a rotational speed"),
        (WHOLE.replace('"n"', '"m"'), "channel.speed.column", "'m'", "one of the columns"),
        (WHOLE.replace("sigma = 0.5", "sigma = -0.5"), "channel.speed.sigma", "-0.5", "at least 0"),
        (WHOLE.replace(", sigma = 0.5", ""), "channel.speed.sigma", "too few repeated", "sigma"),
        (
            WHOLE.replace("sigma = 0.5", 'sigma = 0.5, accuracy_class = "D"'),
            "channel.speed.accuracy_class", "D", "'A', 'B', 'C'",
        ),
        (
            WHOLE.replace("sigma = 0.5", "sigma = 0.5, calibration = { zero = 3 }"),
            "channel.speed.calibration.zero", "3", "with its unit",
        ),
        (
            WHOLE.replace("sigma = 0.5", 'sigma = 0.5, calibration = { zero = "-1 rpm" }'),
            "channel.speed.calibration.zero", "-1 rpm", "at least 0",
        ),
        (
            WHOLE + 'displacement_ratio = { column = "k", unit = "deg", sigma = 0.1 }\n',
            "channel.displacement_ratio.unit", "'deg'", "'1' or '%'",
        ),
        (
            WHOLE + 'T_case = { column = "k", unit = "degC", sigma_relative = 0.1 }\n',
            "channel.T_case.sigma_relative", "0.1", "at most 0: a share of a temperature has no meaning",
        ),
        (WHOLE.replace(STEADY, STEADY + 'repeats = "m"\n'), "steady.repeats", "'m'", "one of the columns"),
        (HEAD + SERIES.replace('time = { column = "t", unit = "s" }\n', "") + CHANNELS, "series.time", "missing",
         "with column, unit"),
        (HEAD + SERIES.replace('"s"', '"rpm"') + CHANNELS, "series.time.unit", "rpm", "a time"),
        (HEAD + SERIES + "steady = { slope = 0 }\n" + CHANNELS, "series.steady.slope", "0", "more than 0"),
        (HEAD + SERIES + 'steady = { window = "10 bar" }\n' + CHANNELS, "series.steady.window", "bar", "a time"),
        (HEAD + SERIES + 'steady = { window = "0.2 s" }\n' + CHANNELS, "series", "samples", "at least 8 samples"),
        (HEAD + SERIES + 'raster = "0.01 s"\n' + CHANNELS, "series", "raster of 0.01 s", "the step of the series"),
        (WHOLE + TRACES.replace('point = "k"\n', ""), "traces.point", "missing", "the name of a column"),
        (WHOLE + TRACES.replace("traces.csv", "none.csv"), "traces.file", "no file", "table"),
        (WHOLE + TRACES.replace(", sigma = 0.4", ""), "traces.p_chamber.sigma", "fewer than 3", "one sigma"),
        (WHOLE + TRACES.replace('angle = { column = "angle", unit = "deg" }\n', ""), "traces.angle", "missing",
         "with column, unit"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_form_is_told(tmp_path: Path, form: str, path: str, found: str, expected: str) -> None:
    faults = _faults(tmp_path, form)
    assert _told(faults, path, found, expected), faults


@pytest.mark.parametrize(
    ("trace", "path", "found"),
    [
        ("".join(f"99,{angle},100\n" for angle in range(0, 360, 2)), "traces.point", "99"),
        ("".join(f"1,{angle},100\n" for angle in range(0, 300, 2)), "traces", "no whole turn"),
    ],
)
def test_what_is_wrong_with_traces_is_told(tmp_path: Path, trace: str, path: str, found: str) -> None:
    faults = _faults(tmp_path, WHOLE + TRACES, trace=trace)
    assert any(one.path == path and found in one.found for one in faults), faults


def test_times_in_no_order_are_told(tmp_path: Path) -> None:
    rows = TABLE.splitlines()
    table = "\n".join([rows[0], *rows[1::3], *rows[2::3], *rows[3::3][::-1]])
    faults = _faults(tmp_path, HEAD + SERIES + CHANNELS, table)
    assert _told(faults, "series", "does not rise", "times that rise")


def test_a_series_of_a_few_samples_is_told(tmp_path: Path) -> None:
    table = "k,t,n,Q\n" + "".join(f"{k},{0.1 * k:.1f},{1000 + 50 * k},{60 + 3 * k}\n" for k in range(5))
    faults = _faults(tmp_path, HEAD + SERIES + CHANNELS, table)
    assert _told(faults, "series", "5 samples", "at least 8 samples")


def test_a_time_of_another_name_is_proposed(tmp_path: Path) -> None:
    (fault,) = _faults(tmp_path, HEAD + SERIES.replace('"t"', '"Zeitstempel"') + CHANNELS)
    assert fault.path == "series.time.column"
    assert fault.nearest == "k"


def test_two_pumps_in_one_table_are_told(tmp_path: Path) -> None:
    rows = TABLE.splitlines()
    named = [f"{row},{'pump' if k == 0 else 'A1' if k < 31 else 'B2'}" for k, row in enumerate(rows)]
    faults = _faults(tmp_path, WHOLE, "\n".join(named))
    assert _told(faults, "steady.file", "A1 (rows 1 to 30), B2 (rows 31 to 60)", "split the table")
