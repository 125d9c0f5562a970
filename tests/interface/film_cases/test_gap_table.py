"""`swashfilm table` of a gap's case: what it leaves, what it says of itself, and what it refuses."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from bench_pump import BENCH

from swashfilm.__main__ import main
from swashfilm.runs.table.gap_case import load_gap_table
from swashfilm.runs.table.gap_run import read_gap_table
from system import InputFaults

# A concentric piston held at its dead centre: leakage pi d h^3 p/(12 mu l), a power of all that varies.
PISTON = f"""format = 1
[film]
gap = "piston"
pump = "{BENCH}"
shaft_angle = "0 deg"
chamber_pressure = "10 MPa"
[position]
eccentricity_inner = ["0 um", "0 um"]
eccentricity_case = ["0 um", "0 um"]
[table]
"film.chamber_pressure" = {{ from = "5 MPa", to = "20 MPa", spacing = "log" }}
"pump.piston.radial_clearance" = {{ from = "10 um", to = "20 um", spacing = "log" }}
"""
SLIPPER = """format = 1
[film]
gap = "slipper"
pump = "ref90"
revolution = true
[revolution]
steps = 24
films = 3
finer = 0.25
tolerance = 0.1
walls = "rigid"
oil = "isoviscous"
heat = "none"
[table]
"operating.pressure" = { from = "5 MPa", to = "8 MPa" }
"""


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SWASHFILM_CACHE", str(tmp_path / "cache"))
    return tmp_path


def written(text: str, name: str = "case.toml") -> str:
    Path(name).write_text(text, encoding="utf-8")
    return name


def faults_of(text: str) -> dict[str, str]:
    with pytest.raises(InputFaults) as raised:
        load_gap_table(Path(written(text)))
    return {fault.path: f"{fault.found}; {fault.expected}; {fault.nearest}" for fault in raised.value.faults}


def test_a_piston_in_the_middle_is_learnt_as_the_power_law_that_it_is(capsys):
    words = ["table", written(PISTON), "--points", "8", "--held-out", "3"]
    assert main([*words, "-o", "out"]) == 0
    out = capsys.readouterr().out
    assert "piston of ref90" in out
    assert "8 learnt, 3 held out" in out
    assert {path.name for path in Path("out").iterdir()} == {
        "input.toml", "resolved.toml", "table.npz", "table.json", "points.csv", "summary.json", "report.html",
    }  # fmt: skip
    table = read_gap_table(Path("out/table.json"))
    tight = {"film.chamber_pressure": "10 MPa", "pump.piston.radial_clearance": "12 um"}
    one, wide = table.at(tight), table.at(tight | {"pump.piston.radial_clearance": "18 um"})
    assert wide["leakage_flow_m3_per_s"] / one["leakage_flow_m3_per_s"] == pytest.approx(1.5**3, rel=2e-3)
    assert one["film_thickness_mean_m"] == pytest.approx(12e-6, rel=1e-6)
    pressed = table.at(tight | {"film.chamber_pressure": "20 MPa"})
    assert pressed["pressure_max_Pa"] == pytest.approx(20e6, rel=1e-3)
    summary = json.loads(Path("out/summary.json").read_text("utf-8"))
    errors = {row["name"]: row["held_out_largest"] for row in summary["outputs"]}
    assert errors["leakage_flow_m3_per_s"] < 0.02  # in logarithms linear but for the 0.15 MPa of the case
    assert any(one.startswith("piston.guide_length") for one in summary["assumptions"])
    with Path("out/points.csv").open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head[1:3] == ["film.chamber_pressure [MPa]", "pump.piston.radial_clearance [um]"]
    assert "leakage flow by table [L/min]" in head
    assert len(rows) == 11
    page = Path("out/report.html")
    page.unlink()
    assert main(["report", "out"]) == 0
    assert page.read_text("utf-8").count("data:image/") == 3
    assert "Assumed values" in page.read_text("utf-8")
    assert main([*words, "-o", "again"]) == 0
    assert "11 points kept" in capsys.readouterr().err
    assert np.array_equal(read_gap_table(Path("again/table.npz")).response.learnt.values, table.response.learnt.values)


@pytest.mark.slow
def test_a_slipper_over_the_turn_is_learnt(capsys):
    assert main(["table", written(SLIPPER), "--points", "4", "--held-out", "2", "-o", "out"]) == 0
    assert "slipper of ref90" in capsys.readouterr().out
    summary = json.loads(Path("out/summary.json").read_text("utf-8"))
    assert summary["kind"] == "gap_table"
    assert summary["failed"] == []
    assert {"tilt_max_rad", "rubbing_power_W"} <= {row["name"] for row in summary["outputs"]}
    errors = {row["name"]: row["held_out_rms"] for row in summary["outputs"]}
    assert errors["film_thickness_mean_m"] < 0.01


def test_every_fault_is_told_at_once():
    wrong = PISTON.replace('"5 MPa"', '"25 MPa"').replace("radial_clearance", "radial_clearence")
    assert "25 MPa" in faults_of(wrong)['table."film.chamber_pressure".to']
    told = faults_of(PISTON.replace("radial_clearance", "radial_clearence"))
    assert "radial_clearance" in told['table."pump.piston.radial_clearence"']
    told = faults_of(PISTON.partition("[table]")[0] + '[table]\npressure = 3\n"film.chamber_pressure" = ["1 MPa"]\n')
    assert "key of the case" in told['table."pressure"']
    assert "{ from, to }" in told['table."film.chamber_pressure"']
    assert "[table]" in faults_of(PISTON.partition("[table]")[0])["table"]
    assert "one of the two" in faults_of(PISTON + '[study]\n"film.chamber_pressure" = ["1 MPa"]\n')["study"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["table", "case.toml", "--speed", "900rpm..2000rpm"], ["--speed", "a key of [table]"]),
        (["table", "case.toml", "--points", "7"], ["--points", "8 to"]),
        (["table", "case.toml", "--rigid"], ["--rigid", "revolution = true"]),
        (["film", "case.toml"], ["swashfilm table case.toml"]),
    ],
)
def test_bad_words_are_told(words, told, capsys):
    written(PISTON)
    assert main(words) == 2
    error = capsys.readouterr().err
    for part in told:
        assert part in error, error


def test_a_case_with_a_table_is_checked(capsys):
    assert main(["check", written(PISTON)]) == 0
    assert "a table over 2 keys" in capsys.readouterr().out
