"""`swashfilm table` and `run --fidelity table`: what they leave, and what they refuse.

The points are a stand-in's, written into the cache as solved ones: what the commands do with them is asked here.
"""

import json
from dataclasses import dataclass, replace

import numpy as np
import pytest

from swashfilm.__main__ import main
from swashfilm.runs.table.command import HELD, RANGES
from swashfilm.runs.table.summary import source_words
from system import load_pump, lumped_point, operating_point, resolved_toml
from system.description.effects import PhysicsSection
from system.inputs.sections.reader import section_of
from system.points.table import sources as table_sources
from system.points.table.means import GAP_PAIRS, MEANINGS, SolvedPoint, given_films
from system.points.table.pump_numbers import NUMBERS
from system.points.table.sources import Source
from system.pump.chamber.turn import Gaps

PUMP = load_pump("ref90")
FEW = ["--points", "32", "--held-out", "6"]


@dataclass(frozen=True)
class Lumped:
    """The lumped law as a source: ratios of 1, but a slipper film that touches above 30 MPa."""

    source = Source.FIXED
    stops_at: float = np.inf

    @property
    def stated(self):
        return {"physics": "the lumped law", "mesh": "none", "accuracy": "that of lumped"}

    def solve(self, pump, point):
        if point.delivery_pressure > self.stops_at:
            raise KeyboardInterrupt
        film = given_films(pump)
        slipper = film.slipper * (1.0 if point.delivery_pressure < 30e6 else 0.2)
        least = Gaps(film.piston, slipper, film.valve_plate)
        return SolvedPoint(lumped_point(pump, point), film, least, Gaps(9.0, 5.0, 7.0))


@pytest.fixture
def stand_in(monkeypatch, tmp_path):
    """Solve by the stand-in, and keep what is solved in a folder of the test's own."""
    monkeypatch.setenv("SWASHFILM_CACHE", str(tmp_path / "cache"))

    def use(**of):
        monkeypatch.setattr(table_sources, "solver_of", lambda source, options: Lumped(**of))

    use()
    return use


def test_a_table_is_built_told_and_run(stand_in, tmp_path, capsys):
    folder = tmp_path / "table"
    assert main(["table", "ref90", *FEW, "-o", str(folder)]) == 0
    out = capsys.readouterr()
    assert "condensed from" in out.out
    assert "32 learnt, 6 held out" in out.out
    assert "Error of runs by the table at held-out points" in out.out
    assert "warning: large_error: slipper.film_least" in out.out
    assert "38/38" in out.err
    assert {path.name for path in folder.iterdir()} == {
        "resolved.toml", "pump.schema.json", "table.npz", "table.json", "points.csv", "summary.json", "report.html",
    }  # fmt: skip
    record = json.loads((folder / "table.json").read_text())
    assert record["source"] == "fixed"
    assert record["stated"]["physics"] == "the lumped law"
    assert record["table_format"] >= 1
    assert [row["name"] for row in record["outputs"]] == list(MEANINGS)
    assert [row["name"] for row in record["numbers"]] == list(NUMBERS)
    assert max(row["held_out_largest"] for row in record["numbers"]) < 0.03
    assert "Error of runs by the table" in (folder / "report.html").read_text("utf-8")
    head, *rows = (folder / "points.csv").read_text().splitlines()
    assert head.startswith("set,shaft_speed [r/min],delivery_pressure [MPa],displacement_ratio [1],viscosity [mPa s]")
    assert len(rows) == 38

    run = tmp_path / "run"
    assert main(["run", "ref90", "--fidelity", "table", "-o", str(run)]) == 0
    assert "Gaps by a table of the fidelity fixed" in capsys.readouterr().out
    found = json.loads((run / "summary.json").read_text())
    assert found["fidelity"] == "table"
    assert found["table"]["points"] == {"learnt": 32, "held_out": 6}
    assert set(found["table"]["numbers_largest_error"]) == set(NUMBERS)
    assert set(found["table"]["film_thickness_min_m"]) == set(GAP_PAIRS)
    assert "by a response table of the fidelity fixed</h2>" in (run / "report.html").read_text()
    left = {"source": "floating", "stated": {"physics": "gaps float; left out: roughness, heat"}}
    assert source_words({"table": left}) == "floating without roughness, heat"

    truth = lumped_point(PUMP, operating_point(PUMP))
    assert found["torque"]["shaft_Nm"] == pytest.approx(truth.bench.shaft_torque, rel=1e-3)
    for gap in GAP_PAIRS:
        assert found["leakage"][f"{gap}_m3_per_s"] == pytest.approx(getattr(truth.leakage_flow, gap), rel=1e-3)


def test_a_range_by_table_continues_with_points_of_the_same_table_alone(stand_in, tmp_path, capsys):
    def kept_of(run, *resumed):
        capsys.readouterr()
        words = ["run", "ref90", "--fidelity", "table", "--vary", "operating.pressure=20,25MPa"]
        assert main([*words, *resumed, "-o", str(tmp_path / run)]) == 0
        return "2 points kept" in capsys.readouterr().err

    assert main(["table", "ref90", *FEW, "-o", str(tmp_path / "few")]) == 0
    assert not kept_of("one")
    assert kept_of("two", "--resume", str(tmp_path / "one"))
    assert main(["table", "ref90", "--points", "40", "--held-out", "6", "-o", str(tmp_path / "more")]) == 0
    assert not kept_of("three", "--resume", str(tmp_path / "one"))


def test_a_table_serves_every_temperature_of_a_pump_whose_clearances_change_with_it(stand_in, tmp_path):
    grown = replace(PUMP, physics=section_of(PhysicsSection, {"thermal_clearance": {"piston": {"rate": 1e-2}}}))
    file, run = tmp_path / "grown.toml", tmp_path / "run"
    file.write_text(resolved_toml(grown), encoding="utf-8")
    assert main(["table", str(file), *FEW, "-o", str(tmp_path / "table")]) == 0
    words = ["run", str(file), "--temperature", "70 degC"]
    leakage = []
    for fidelity in ("table", "lumped"):
        assert main([*words, "--fidelity", fidelity, "-o", str(run / fidelity)]) == 0
        leakage.append(json.loads((run / fidelity / "summary.json").read_text())["leakage"]["piston_m3_per_s"])
    assert leakage[0] == pytest.approx(leakage[1], rel=5e-2)  # 32 points learn the growth to some per cent
    assert leakage[0] > 1.5 * lumped_point(PUMP, operating_point(PUMP, temperature=343.15)).leakage_flow.piston


def test_ctrl_c_keeps_what_is_solved(stand_in, tmp_path, capsys):
    stand_in(stops_at=38e6)
    assert main(["table", "ref90", *FEW, "-o", str(tmp_path / "table")]) == 130
    assert "the same command continues" in capsys.readouterr().err
    assert not (tmp_path / "table").exists()
    assert not (tmp_path / "table.partial").exists()
    kept = len(list((tmp_path / "cache" / "tables" / "points").glob("*.json")))
    assert kept > 0
    stand_in()
    assert main(["table", "ref90", *FEW, "-o", str(tmp_path / "table")]) == 0
    assert f"{kept} points kept" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["table", "ref90", "--speed", "500..900"], ["--speed", "500 rpm"]),
        (["table", "ref90", "--speed", "500-900rpm"], ["--speed", "try:      500..900rpm"]),
        (["table", "ref90", "--speed", "900..500rpm"], ["--speed", "the lower end first"]),
        (["table", "ref90", "--speed", "900rpm..500rpm"], ["--speed", "the lower end first"]),
        (["table", "ref90", "--displacement", "half"], ["--displacement", "bare number"]),
        (["table", "ref90", "--speed", "0.5..1..2"], ["--speed", ".. between"]),
        (
            [
                "table",
                "ref90",
                *("--speed", "900rpm", "--pressure", "9MPa", "--displacement", "1"),
                "--temperature",
                "50degC",
            ],
            ["single values only", "at least one range"],
        ),
        (["table", "ref90", "--speed", "900rpm", "--points", "15"], ["--points", "16 to"]),
        (["table", "ref90", "--displacement", "0.5..2"], ["displacement ratio", "at most 1"]),
        (["table", "ref90", "--points", "3", "--workers", "no"], ["--points", "--workers", "2 faults"]),
        (["table", "ref90", "--source", "film"], ["--source", "one of fixed, floating", "fixed"]),
        (["table", "ref90", "--rigid"], ["--source", "floating"]),
        (["table", "ref90", "--source", "floating", "--steps", "100"], ["--steps", "multiple of the 9 pistons"]),
        (["table", "ref90", "--pressure", "1MPa..30MPa"], ["delivery pressure", "2.5 MPa"]),
        (["table", "ref90", "--temperature", "20degC..300degC"], ["degC"]),
        (["table", "ref90", "--sped", "3"], ["--sped", "--speed"]),
        (["table", "ref90", "--vary", "piston.radial_clearance=16um..12um"], ["--vary", "the lower end first"]),
        (["table", "ref90", "--vary", "piston.radial_clearance=12..16"], ["--vary", "with its unit", "12 mm"]),
        (["table", "ref90", "--vary", "piston.radial_clearence"], ["--vary", "try:      piston.radial_clearance"]),
        (["table", "ref90", "--vary", "ports.groove_area=3mm2..5mm2"], ["beside the films", "without an axis"]),
        (["table", "ref90", "--vary", "slipper.orifice_diameter"], ["no tolerance", "slipper.orifice_diameter=A..B"]),
        (
            ["table", "ref90", "--vary", "slipper.land_outer_radius=14mm..30mm"],
            ["--vary slipper.land_outer_radius", "neighbouring slippers overlap", "less than 15.03 mm"],
        ),
        (
            ["table", "ref90", *("--vary", "piston.radial_clearance=9um..11um") * 2],
            ["--vary piston.radial_clearance", "a second time"],
        ),
        (["table", "ref90", *("--vary", "bore.nothing") * 7], ["7 dimensions", "at most 6"]),
        (["table"], ["PUMP"]),
        (["run", "ref90", "--fidelity", "table"], ["no table of this pump", "swashfilm table"]),
        (["run", "ref90", "--table", "x.json"], ["--table", "--fidelity table"]),
        (["run", "ref90", "--fidelity", "table", "--table", "none.json"], ["none.json", "side by side"]),
    ],
)
def test_bad_words_are_told(words, told, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("SWASHFILM_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    error = capsys.readouterr().err
    for part in told:
        assert part in error


def test_help_says_what_a_table_is(capsys):
    with pytest.raises(SystemExit):
        main(["table", "--help"])
    text = capsys.readouterr().out
    for option in (*RANGES, *HELD, "--vary", "--source", "--points", "--held-out", "--workers", "--steps", "--finer"):
        assert option in text
