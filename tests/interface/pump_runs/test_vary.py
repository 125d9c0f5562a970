"""A pump over ranges of keys: `swashfilm run --vary`, and keys set by `--set` on other commands."""

import csv
import json

import pytest

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.console.levels import level_texts
from swashfilm.runs.pump.vary.axes import vary_axes
from system.inputs.faults import InputFaults

FILM = "valve_plate.film_thickness"
LUMPED = ["run", "ref90", "--fidelity", "lumped"]


def told(words, capsys):
    """Return what the command tells of its faults."""
    assert main(words) == 2
    return capsys.readouterr().err


def test_levels_are_read_with_their_unit():
    faults = []
    film, grade, turns = vary_axes([f"{FILM}=6..14um:5", "oil.grade=ISO VG 32,ISO VG 46", "a.b=1,2.5"], faults)
    assert not faults
    assert film.numbers == pytest.approx((6e-6, 8e-6, 10e-6, 12e-6, 14e-6))
    assert film.unit == "m"
    assert grade.values == ("ISO VG 32", "ISO VG 46")
    assert grade.numbers is None
    assert turns.numbers == (1.0, 2.5)
    assert [item.ends for item in level_texts("1,2..4bar:3")] == [("1bar",), ("2bar", "4bar")]


def test_a_pump_over_a_key_leaves_a_study(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main([*LUMPED, "--vary", f"{FILM}=6..14um:3", "--excel", "-o", "run"]) == 0
    out = capsys.readouterr().out
    assert "3 of 3 points; efficiencies by ISO 4409" in out
    assert "delivery flow [L/min]" in out
    with open("run/study.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row[f"{FILM} [um]"]) for row in rows] == [6.0, 10.0, 14.0]
    leaks = [float(row["leakage flow, valve plate [L/min]"]) for row in rows]
    assert leaks[2] / leaks[0] == pytest.approx((14 / 6) ** 3, rel=1e-2)
    assert "Efficiencies are those of ISO 4409." in (tmp_path / "run" / "report.html").read_text("utf-8")
    names = {path.name for path in (tmp_path / "run").iterdir()}
    assert names >= {"study.nc", "summary.json", "report.html", "points", "plots", "run.xlsx"}
    assert main(["report", "run"]) == 0
    assert sf.open("run").summary["kind"] == "pump_study"
    capsys.readouterr()
    assert main([*LUMPED, "--vary", f"{FILM}=6..18um:4", "--resume", "run", "-o", "more"]) == 0
    assert "3 points kept" in capsys.readouterr().err


def test_a_study_of_a_pump_keeps_all_that_it_was_solved_with(tmp_path, monkeypatch):
    """Operating point and fidelity of the command line stand in its input, which the page shows."""
    monkeypatch.chdir(tmp_path)
    words = ["--pressure", "20MPa", "--set", "piston.mass=150g", "--vary", f"{FILM}=8um"]
    assert main([*LUMPED, *words, "-o", "run"]) == 0
    given = (tmp_path / "run" / "input.toml").read_text("utf-8").splitlines()
    for line in (f"{FILM}=8um in levels", "--fidelity lumped", "operating.pressure = 20MPa", "piston.mass = 150g"):
        assert f"# command line: {line}" in given
    assert "--fidelity lumped" in (tmp_path / "run" / "report.html").read_text("utf-8")


def test_two_keys_make_a_grid():
    found = sf.vary("ref90", {FILM: "8..12um:2", "operating.pressure": "100,300bar"}, fidelity="lumped")
    flow = found.to_xarray()["delivery_flow_m3_per_s"]
    assert flow.shape == (2, 2)
    one = sf.run("ref90", fidelity="lumped", pressure="300 bar", set={FILM: "12 um"})
    assert float(flow[1, 1]) == pytest.approx(one.flow_delivery, rel=1e-9)


def test_a_varied_pump_tells_its_numbers_in_the_unit_that_is_asked_for(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    asked = ["--vary", "operating.pressure=10MPa..30MPa:2", "--units", "bar", "-o", "run"]
    assert main([*LUMPED, *asked]) == 0
    told = capsys.readouterr()
    page = (tmp_path / "run" / "report.html").read_text("utf-8").replace("\u00a0", " ")
    head = page[page.index("<h1>") : page.index("<h2")]
    assert "2 operating points over operating.pressure (100 bar, 300 bar)." in head
    assert "The overall efficiency lies between" in head
    assert "(at 300 bar)" in head
    numbers = page[page.index("<h2>Numbers") if "<h2>Numbers" in page else page.index(">Numbers</h2>") :]
    assert "operating.pressure = 300 bar" in numbers
    assert "MPa" not in numbers[: numbers.index("Case as given")]
    assert "MPa" not in told.out + told.err


def test_what_is_wrong_with_a_range_is_told_before_a_point_is_solved(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert "try:      film_thickness" in told([*LUMPED, "--vary", "valve_plate.film_thicknes=6..14um:3"], capsys)
    assert "which is not a length" in told([*LUMPED, "--vary", f"{FILM}=6..14bar:3"], capsys)
    assert "a range with a number of levels" in told([*LUMPED, "--vary", f"{FILM}=6..14um"], capsys)
    assert "KEY=LEVELS" in told([*LUMPED, "--vary", FILM], capsys)
    assert "found:    5 levels from 6um to itself" in told([*LUMPED, "--vary", f"{FILM}=6..6um:5"], capsys)
    text = told([*LUMPED, "--vary", "operating.displacement_ratio=0.2..1.4:7"], capsys)
    assert "operating.displacement_ratio from 0.2 to 1" in text
    assert "2 points have such a fault" in text
    assert "--vary" in told([*LUMPED, "--resume", "."], capsys)
    assert "--vary" in told([*LUMPED, "--vary", f"{FILM}=6..14um:3", "--refine", "2"], capsys)
    assert not list(tmp_path.rglob("*"))
    with pytest.raises(InputFaults, match=r"swashfilm\.vary"):
        sf.run("ref90", fidelity="lumped", vary={FILM: "6..14um:3"})


def test_a_key_has_one_value_on_a_command_line(capsys):
    """No option outweighs another one in silence: both are told, each at its place."""
    speed = "operating.speed"
    text = told([*LUMPED, "--vary", f"{speed}=500..2100rpm:3", "--speed", "1000rpm"], capsys)
    assert f"--vary {speed}\n    found:    beside --speed" in text
    text = told(
        [*LUMPED, "--vary", f"{speed}=500,900rpm", "--vary", f"{speed}=1000rpm", "--set", f"{speed}=1rpm"], capsys
    )
    assert f"--vary {speed}\n    found:    stated twice" in text
    assert f"--vary {speed}\n    found:    beside --set {speed}" in text
    text = told([*LUMPED, "--set", f"{speed}=900rpm", "--speed", "1000rpm"], capsys)
    assert f"--speed\n    found:    '1000rpm' beside --set {speed}=900rpm" in text
    text = told([*LUMPED, "--set", f"{FILM}=8um", "--set", f"{FILM}=10um"], capsys)
    assert f"--set {FILM}\n    found:    '8um' and '10um'" in text


def test_what_is_wrong_at_every_level_is_told_as_of_one_pump(tmp_path, capsys):
    """An unknown fidelity, a file that is not there and a fault beside the key are bad input, and have no level."""
    vary = ["--vary", f"{FILM}=6um,8um"]
    assert "try:      lumped" in told(["run", "ref90", "--fidelity", "lumpd", *vary], capsys)
    missing = told(["run", str(tmp_path / "none.toml"), "--fidelity", "lumped", *vary], capsys)
    assert "which is no built-in pump and no file\n" in missing
    heavy = told([*LUMPED, *vary, "--set", "piston.mass=5 mm"], capsys)
    assert "found:    '5 mm', which is not a mass\n" in heavy


def test_the_fault_of_a_set_key_is_not_one_of_an_option(capsys):
    assert "  operating.pressure\n" in told([*LUMPED, "--set", "operating.pressure=1MPa"], capsys)
    assert "  --pressure\n" in told([*LUMPED, "--pressure", "1MPa"], capsys)


def test_a_map_and_a_case_take_other_values_of_keys(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    case = '[film]\nthickness = "10 um"\nviscosity = "30 mPa s"\nvelocity = ["1 m/s", "0 m/s"]\n'
    mesh = 'mesh = { kind = "rectangle", size = ["10 mm", "10 mm"], cells = [2, 2] }\n'
    edges = '[boundary]\nleft = { pressure = "0 bar" }\nright = { pressure = "0 bar" }\n'
    (tmp_path / "pad.toml").write_text("format = 1\n" + case + mesh + edges, encoding="utf-8")
    assert (
        main(["film", "pad.toml", "--set", "film.thickness=20um", "--set", "film.velocity[0]=2 m/s", "-o", "out"]) == 0
    )
    found = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    assert found["film_thickness_min_m"] == pytest.approx(20e-6)
    assert "# command line: film.thickness = 20um" in (tmp_path / "out" / "input.toml").read_text("utf-8")
    assert "try:      thickness" in told(["film", "pad.toml", "--set", "film.thicknes=20um"], capsys)
    assert "KEY=VALUE" in told(["film", "pad.toml", "--set", "film.thickness"], capsys)
    point = ["map", "ref90", "--fidelity", "lumped", "--plan", "point", "--check", "0"]
    assert main([*point, "--set", f"{FILM}=12um", "-o", "map"]) == 0
    assert f"# command line: {FILM} = 12um" in (tmp_path / "map" / "input.toml").read_text("utf-8")
    assert "film_thickness" in told([*point, "--set", "valve_plate.film_thicknes=12um"], capsys)
