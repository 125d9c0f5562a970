"""Recordings that no diagnosis can rest on, through the command: told in words with the place, exit code 2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from recording_heads import HEAD

from swashfilm.__main__ import main

UNITS = {
    "speed": "rpm", "displacement_ratio": "1", "p_out": "bar", "T_case": "degC", "Q_out": "L/min", "Q_case": "L/min",
    "torque": "N m",
}  # fmt: skip
SIGMA = {"speed": 0.5, "displacement_ratio": 1e-3, "p_out": 0.2, "T_case": 0.3, "Q_out": 0.08, "Q_case": 0.02}
SIGMA["torque"] = 0.3
POINTS, ROW = 90, 45
Table = Mapping[str, np.ndarray]


def _map(displacement: float = 90.0, seed: int = 1) -> dict[str, np.ndarray]:
    """Readings of a pump of so many cm3/rev at points of no order, in the units of a bench."""
    rng = np.random.default_rng(seed)
    speed, ratio = rng.uniform(600.0, 2400.0, POINTS), rng.uniform(0.3, 1.0, POINTS)
    pressure, warm = rng.uniform(40.0, 380.0, POINTS), rng.uniform(40.0, 70.0, POINTS)
    leak = 0.6 * pressure / 200.0 * np.exp(0.03 * (warm - 50.0))
    made = {
        "speed": speed, "displacement_ratio": ratio, "p_out": pressure, "T_case": warm,
        "Q_out": displacement * ratio * speed / 1e3 - leak, "Q_case": leak,
        "torque": displacement * ratio * pressure / (20.0 * np.pi) + 4.0 + 0.003 * speed,
    }  # fmt: skip
    return {name: column + SIGMA[name] * rng.standard_normal(POINTS) for name, column in made.items()}


def _told(folder: Path, table: Table, points: str, capsys: pytest.CaptureFixture[str], more: Sequence[str] = ()) -> str:
    """What the command says of a table whose recording.toml has these lines for its points."""
    rows = zip(*table.values(), strict=True)
    lines = [",".join(f"{value:.6g}" for value in row) + "".join(f",{cell}" for cell in more[k : k + 1])
             for k, row in enumerate(rows)]  # fmt: skip
    heads = [*table, *(["pump"] if more else [])]
    (folder / "data.csv").write_text("\n".join([",".join(heads), *lines]), "utf-8")
    channels = [
        f'{name} = {{ column = "{name}", unit = "{UNITS[name]}", sigma = {SIGMA[name]} }}'
        for name in table
        if name in UNITS
    ]
    head = HEAD.partition("[steady]")[0]
    (folder / "recording.toml").write_text("\n".join([head, points, "[channel]", *channels]), "utf-8")
    assert main(["diagnose", "ref90", str(folder), "-o", str(folder / "out")]) == 2
    assert not (folder / "out").exists()
    return capsys.readouterr().err


STEADY = '[steady]\nfile = "data.csv"'
SERIES = '[series]\nfile = "data.csv"'


def test_a_series_without_time_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The key that is missing, its line, and what to write there."""
    told = _told(tmp_path, _map(), SERIES, capsys)
    assert "series.time (line" in told
    assert 'time = { column = "time", unit = "s" }' in told


def test_samples_of_a_series_are_no_steady_points(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Ten minutes at 1 Hz under [steady]: a ramp of pressure."""
    ramp = {name: np.full(600, column[0]) for name, column in _map().items()} | {"p_out": np.linspace(40.0, 380.0, 600)}
    told = _told(tmp_path, ramp, STEADY, capsys)
    assert "600 rows that hardly differ from one to the next" in told
    assert "[series] with its time" in told


def test_a_clock_that_changes_its_unit_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    time = np.where(np.arange(POINTS) < ROW, 5.0 * np.arange(POINTS), 5.0 * np.arange(POINTS) / 60.0)
    told = _told(tmp_path, {"t": time, **_map()}, f'{SERIES}\ntime = {{ column = "t", unit = "s" }}', capsys)
    assert f"time steps of 5 s up to row {ROW} and of 0.0833 s from row {ROW + 1} on" in told


@pytest.mark.parametrize(
    ("channel", "factor", "unit"),
    [
        ("p_out", 0.1, "MPa"),
        ("speed", 1.0 / 60.0, "rev/s"),
        ("displacement_ratio", 100.0, "%"),
        ("torque", 1e-3, "kN m"),
    ],
)
def test_a_unit_that_changes_midway_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], channel: str, factor: float, unit: str
) -> None:
    table = _map()
    table[channel] = np.where(np.arange(POINTS) < ROW, 1.0, factor) * table[channel]
    told = _told(tmp_path, table, STEADY, capsys)
    assert f"channel.{channel}.unit" in told
    assert f"from row {ROW + 1} on that fit '{unit}'" in told


@pytest.mark.parametrize("in_turn", [False, True])
def test_two_pumps_in_one_file_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str], in_turn: bool) -> None:
    """One after the other, or by turns: flow and torque of the smaller pump."""
    one, other = _map(), _map(63.0)
    of_one = np.arange(POINTS) % 2 == 0 if in_turn else np.arange(POINTS) < ROW
    told = _told(tmp_path, {name: np.where(of_one, one[name], other[name]) for name in one}, STEADY, capsys)
    assert "two pumps or" in told
    assert ("at 45 points" if in_turn else f"from row {ROW + 1} on") in told


def test_two_pumps_that_are_named_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    told = _told(tmp_path, _map(), STEADY, capsys, more=["A1"] * ROW + ["B2"] * (POINTS - ROW))
    assert f"A1 (rows 1 to {ROW}), B2 (rows {ROW + 1} to {POINTS})" in told


@pytest.mark.parametrize(("sensor", "words"), [("Q_case", "no input is recorded"), ("p_out", "none of Q_out")])
def test_a_single_sensor_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str], sensor: str, words: str) -> None:
    """A flow without any input, and an input without any output."""
    assert words in _told(tmp_path, {sensor: _map()[sensor]}, STEADY, capsys)


def test_inputs_that_never_move_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A series at rest is one operating point: its readings, and what to record."""
    rng = np.random.default_rng(2)
    still = {name: column[0] + SIGMA[name] * rng.standard_normal(POINTS) for name, column in _map().items()}
    timed = {"t": np.arange(float(POINTS)), **still}
    told = _told(tmp_path, timed, f'{SERIES}\ntime = {{ column = "t", unit = "s" }}', capsys)
    assert "at one operating point, inputs do not move" in told
    assert "record other pressures, speeds and temperatures" in told
