"""`swashfilm diagnose` from files to files: a recording with nothing in it, and one that conceals an effect.

The readings are those of the simulator itself with noise drawn: what is tested is the way through the program.
benchmarks/proof.py tries what it finds on readings of another make.
"""

from __future__ import annotations

import csv
import json
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from recording_heads import HEAD

import diagnosis.finding
from reynolds import Array, NotConverged
from swashfilm.__main__ import main
from swashfilm.runs.diagnose.files import read_rows
from system import BenchPoints, ChannelName, EffectId, LumpedBench, entry_of, load_pump, lumped_point, operating_point

PUMP = load_pump("ref90")
EXAMPLES = Path(__file__).resolve().parents[3] / "examples" / "recordings"
BENCH_PUMP = EXAMPLES / "bench_pump.toml"
READ = (ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE)
NOISE = np.array([0.1, 0.015, 0.3])  # L/min, L/min, N m
CHURNING = entry_of(EffectId.CHURNING).extensions[0]
RECORDING = f"""{HEAD}displacement_ratio = {{ column = "e", unit = "1", sigma = 0.0 }}
p_out = {{ column = "p", unit = "bar", sigma = 0.1 }}
p_in = {{ column = "s", unit = "bar", sigma = 0.02 }}
p_case = {{ column = "c", unit = "bar", sigma = 0.01 }}
T_in = {{ column = "t", unit = "degC", sigma = 0.15 }}
T_case = {{ column = "T", unit = "degC", sigma = 0.15 }}
Q_out = {{ column = "Q", unit = "L/min", sigma = 0.1 }}
Q_case = {{ column = "q", unit = "L/min", sigma = 0.015 }}
torque = {{ column = "M", unit = "N m", sigma = 0.3 }}
"""


def _points() -> BenchPoints:
    grid = np.array(
        [(n, p, e) for n in (500.0, 1000.0, 1500.0, 2100.0) for p in (10e6, 20e6, 35e6) for e in (0.4, 1.0)]
    )
    order = np.random.default_rng(3).permutation(len(grid))
    speed, pressure, ratio = grid[order].T
    case = np.where(order % 2 == 0, 323.15, 343.15)
    same = np.ones(len(grid))
    return BenchPoints(
        speed=speed * np.pi / 30.0, displacement_ratio=ratio, p_out=pressure, p_in=2.5e6 * same,
        p_case=1.5e5 * same, T_case=case, T_in=case - 5.0, hours=np.nan * same, order=np.arange(float(len(grid))),
        warming=0.0 * same,
    )  # fmt: skip


def _record(folder: Path, churning: float, noise: float = 1.0) -> Path:
    """A recording of REF90 as described, with so many times Wendt's churning and the noise stated."""
    points = _points()
    bench = LumpedBench(PUMP, points, READ, (), (CHURNING,))
    truth: Array = bench.predict(np.array([churning])) * np.array([6e4, 6e4, 1.0])
    readings = truth + noise * NOISE * np.random.default_rng(4).normal(size=truth.shape)
    columns = {
        "n": points.speed * 30.0 / np.pi, "e": points.displacement_ratio, "p": points.p_out * 1e-5,
        "s": points.p_in * 1e-5, "c": points.p_case * 1e-5, "t": points.T_in - 273.15, "T": points.T_case - 273.15,
        "Q": readings[:, 0], "q": readings[:, 1], "M": readings[:, 2],
    }  # fmt: skip
    (folder / "recording.toml").write_text(RECORDING, encoding="utf-8")
    with (folder / "steady.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows([f"{value:.5f}" for value in row] for row in zip(*columns.values(), strict=True))
    return folder


@pytest.mark.slow
def test_nothing_left_out_is_no_mismatch(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Said so, though no next point can be proposed, with a note; and that the recording names another pump."""
    folder, out, pump = _record(tmp_path, 0.0), tmp_path / "out", tmp_path / "found.toml"
    form = folder / "recording.toml"
    form.write_text(form.read_text("utf-8").replace('"ref90"', '"A10VSO 45"'), encoding="utf-8")

    def no_point(*given: object) -> None:
        raise NotConverged("the pump at 400 bar")

    monkeypatch.setattr(diagnosis.finding, "with_next_point", no_point)
    words = ["diagnose", "ref90", str(folder), "-o", str(out), "--apply", str(pump), "--workers", "1"]
    assert main(words) == 0
    found = json.loads((out / "diagnosis.json").read_text("utf-8"))
    assert (found["verdict"], found["status"], found["effects"]) == ("no_mismatch", "named", [])
    assert not pump.exists()
    assert "no next point can be proposed: the pump at 400 bar" in found["notes"]
    assert "the recording is of A10VSO 45; it is compared with ref90" in found["notes"]
    told = capsys.readouterr().out
    assert "No mismatch. Simulation and recording agree" in told
    assert "nothing is claimed" in told


@pytest.mark.slow
def test_an_effect_left_out_is_named_and_applied(tmp_path: Path) -> None:
    """Churning as Wendt has it, named, its size within 4 sigma; the pump found runs with it."""
    folder, out, pump = _record(tmp_path, 1.0), tmp_path / "out", tmp_path / "found.toml"
    words = ["diagnose", "ref90", str(folder), "-o", str(out), "--apply", str(pump), "--workers", "1"]
    assert main(words) == 0
    found = json.loads((out / "diagnosis.json").read_text("utf-8"))
    assert found["verdict"] == "missing_physics"
    assert found["status"] in ("named", "class")
    (claim,) = found["effects"]
    torque = found["fit"]["heldout"]["torque"]
    assert torque["after"] < 1.5 * torque["noise"]  # 24 readings scatter by 15 %
    assert torque["after"] < torque["before"]
    assert claim["id"] == "churning"
    (size,) = claim["parameters"]
    assert abs(size["value"] - 1.0) < 4.0 * size["sigma"]
    _reads_as_recorded(pump)
    (schema, _, head), described = pump.read_text("utf-8").partition("\n"), load_pump(pump)
    assert schema == "#:schema ./pump.schema.json"
    assert head.startswith("# ref90 as fitted to the recording 'made', 24 points, on 20")
    assert f"churning, probability {claim['probability']:.2f}: " in head
    assert "--fidelity fixed has churning as closed-form laws" in head
    assert described.name == "ref90, fitted to made"
    assert 0.0 < described.tolerance.film_thickness < 0.5
    tables = ("changes.csv", "next_points.csv", "residuals.csv", "hypotheses.csv", "parameters.csv", "report.html")
    assert all((out / name).is_file() for name in tables)
    rows = {row["quantity"]: row for row in read_rows(out / "changes.csv")}
    torque = rows["shaft torque"]
    assert float(torque["with"]) > float(torque["without"]) + 5.0 * NOISE[2]
    assert float(rows["delivery flow"]["change"]) == 0.0
    assert all((out / name / "report.html").is_file() for name in ("without", "with"))


def _reads_as_recorded(path: Path) -> None:
    """The pump found has the truth's torque at the point of most churning, and the pump as described has not."""
    point = operating_point(
        PUMP, shaft_speed=2100.0 * np.pi / 30.0, delivery_pressure=10e6, inlet_pressure=2.5e6,
        case_pressure=1.5e5, displacement_ratio=1.0, temperature=323.15,
    )  # fmt: skip
    one = BenchPoints(
        **{field.name: np.atleast_1d(getattr(_points(), field.name)[0]) for field in fields(BenchPoints)}
        | {"speed": np.array([point.shaft_speed]), "displacement_ratio": np.ones(1), "p_out": np.array([10e6]),
           "T_case": np.array([323.15])}
    )  # fmt: skip
    truth = float(LumpedBench(PUMP, one, READ, (), (CHURNING,)).predict(np.array([1.0]))[0, 2])
    found = lumped_point(load_pump(str(path)), point).bench.shaft_torque
    plain = lumped_point(PUMP, point).bench.shaft_torque
    assert abs(found - truth) < 3.0 * NOISE[2] < abs(plain - truth)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--apply", "{there}"], "nothing is overwritten"),
        (["--apply", "nowhere/at/all.toml"], "in no folder"),
        (["--workers", "none"], "a number of processes"),
        (["--workers", "0"], "a number of processes"),
    ],
)
def test_options_that_cannot_be_are_told(
    words: list[str], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    there = tmp_path / "there.toml"
    there.touch()
    assert main(["diagnose", "ref90", str(tmp_path), *(word.format(there=there) for word in words)]) == 2
    assert told in capsys.readouterr().err


def test_a_recording_is_checked_without_being_diagnosed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its channels with units and what was taken of it; every fault of the readings at once."""
    folder = _record(tmp_path, 0.0)
    assert main(["check", str(folder)]) == 0
    told = capsys.readouterr().out
    assert "24 points" in told
    assert "0.015 L/min" in told
    text = RECORDING.replace('"p", unit = "bar"', '"p", unit = "MPa"').replace(
        '"M", unit = "N m"', '"M", unit = "kN m"'
    )
    (folder / "recording.toml").write_text(text, encoding="utf-8")
    assert main(["check", str(folder / "steady.csv")]) == 2
    error = capsys.readouterr().err
    assert "unit = 'bar'" in error
    assert "torque" in error


def test_readings_without_noise_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file that a simulator wrote is no recording: exit code 2, with what to do."""
    folder = _record(tmp_path, 0.0, noise=0.01)
    assert main(["diagnose", "ref90", str(folder), "-o", str(tmp_path / "out")]) == 2
    assert "far less than their repeatability" in capsys.readouterr().err


def test_the_nearest_recording_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "bench_map").mkdir()
    assert main(["diagnose", "ref90", str(tmp_path / "bench_mab")]) == 2
    error = capsys.readouterr().err
    assert "no such file" in error
    assert "bench_map" in error


@pytest.mark.long
def test_walls_as_the_film_solver_has_them_are_found_by_two_processes(tmp_path: Path) -> None:
    """The finding is a share of the computed compliance, in a pump that runs to it."""
    out = tmp_path / "out"
    words = ["diagnose", str(BENCH_PUMP), str(EXAMPLES / "open-04"), "--film-tables", "--workers", "2", "-o", str(out)]
    assert main(words) == 0
    (told,) = json.loads((out / "diagnosis.json").read_text("utf-8"))["effects"]
    assert (told["id"], told["pair"]) == ("elastic_opening", "slipper")
    (parameter,) = told["parameters"]
    assert (parameter["name"], parameter["unit"]) == ("compliance", "1")
    opening = load_pump(out / "pump_extended.toml").physics.elastic_opening
    assert opening is not None
    assert opening.slipper is not None
    assert opening.slipper.compliance == pytest.approx(parameter["value"], rel=1e-12)
    assert main(["run", str(out / "pump_extended.toml"), "--fidelity", "lumped", "-o", str(tmp_path / "run")]) == 0


@pytest.mark.long
def test_the_front_door_diagnoses_and_opens_the_same(tmp_path):
    import swashfilm as sf

    found = sf.diagnose(BENCH_PUMP, EXAMPLES / "open-06", workers=1)
    assert found.effects[0]["id"] == "port_short_circuit"
    assert found.statement in repr(found)
    assert found.plot_evidence()
    assert found.plot_effect()
    again = sf.open(found.save(tmp_path / "run"))
    assert again.paragraphs == found.paragraphs
