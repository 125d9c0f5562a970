"""Film cases that state their load, and constants in their formulas."""

import json
from pathlib import Path

import pytest

from swashfilm.__main__ import main
from swashfilm.case.file import FilmCase, load_case
from swashfilm.case.study import StudyCase, load_film
from system import InputFaults

GOOD = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "2 mm"], cells = [16, 1], periodic = "y" }
thickness = "rise*(1 - x/0.01)"
velocity = ["speed", "0 m/s"]
viscosity = "30 mPa s"
load = "20 N"
[constants]
rise = "10 um"
speed = 1
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""
WARM = """
[oil]
temperature = "40 degC"
temperature_coefficient = "0.03 1/K"
density = "860 kg/m3"
specific_heat = "1950 J/(kg K)"
thermal_conductivity = "0.13 W/(m K)"
[thermal]
fixed_wall = { temperature = "40 degC" }
moving_wall = { temperature = "40 degC" }
"""


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def written(text: str) -> Path:
    path = Path("case.toml")
    path.write_text(text, encoding="utf-8")
    return path


def test_a_film_settles_where_it_bears_its_load():
    assert main(["film", str(written(GOOD)), "-o", "run"]) == 0
    summary = json.loads(Path("run/summary.json").read_text("utf-8"))
    assert summary["load_N"] == pytest.approx(20.0, rel=2e-6)
    assert summary["carried_load_N"] == pytest.approx(20.0, rel=2e-6)
    assert summary["film_thickness_min_m"] == pytest.approx(summary["separation_m"], rel=1e-12)
    assert summary["mass_balance_error"] < 1e-10
    for moved in ('load = "20 N"', "separation"):
        assert moved in Path("run/report.html").read_text("utf-8").replace("&#34;", '"')


def test_moments_free_the_tilts():
    text = GOOD.replace('"rise*(1 - x/0.01)"', '"0 um"').replace('"20 N"', '"20 N"\nmoment_y = "-0.116 N m"')
    assert main(["film", str(written(text.replace('rise = "10 um"\n', ""))), "-o", "run"]) == 0
    summary = json.loads(Path("run/summary.json").read_text("utf-8"))
    assert summary["moment_y_Nm"] == pytest.approx(-0.116, rel=1e-5)
    assert summary["slope_x_rad"] < 0.0
    assert summary["slope_y_rad"] == 0.0


def test_what_a_film_balances_has_no_limit_over_meshes():
    text = GOOD.replace('"rise*(1 - x/0.01)"', '"0 um"').replace('"20 N"', '"20 N"\nmoment_y = "-0.116 N m"')
    assert main(["film", str(written(text.replace('rise = "10 um"\n', ""))), "--refine", "2", "-o", "run"]) == 0
    found = json.loads(Path("run/summary.json").read_text("utf-8"))["refinement"]["numbers"]
    assert {"separation_m", "slope_x_rad", "film_thickness_min_m", "moment_x_Nm"} <= set(found)
    assert not {"load_N", "carried_load_N", "moment_y_Nm"} & set(found)


def test_a_warm_film_settles_thinner():
    assert main(["film", str(written(GOOD)), "-o", "cold"]) == 0
    assert main(["film", str(written(GOOD + WARM)), "-o", "warm"]) == 0
    cold, warm = (json.loads(Path(f"{run}/summary.json").read_text("utf-8")) for run in ("cold", "warm"))
    assert warm["load_N"] == pytest.approx(20.0, rel=2e-6)
    assert warm["temperature_max_K"] > 313.15
    assert warm["separation_m"] < cold["separation_m"]


def test_a_resolved_case_is_the_same_case():
    first = load_case(written(GOOD.replace('"20 N"', '"20 N"\nmoment_x = "0 N m"')))
    assert isinstance(first, FilmCase)
    again = load_case(written(first.resolved))
    assert isinstance(again, FilmCase)
    assert again.resolved == first.resolved
    assert again.stated.film.rigid_load == first.stated.film.rigid_load
    assert again.stated.constants == {"rise": 1e-5, "speed": 1.0}


def test_a_load_that_no_position_bears_is_told(capsys):
    text = GOOD.replace('"20 N"', '"1e9 N"')
    assert main(["film", str(written(text)), "-o", "run"]) == 3
    told = capsys.readouterr().err
    assert "no position of the walls bears 1e+09 N" in told
    assert "separation" in told


def test_a_constant_is_a_key_of_a_study():
    path = written(GOOD + '[study]\n"constants.rise" = ["5 um", "10 um"]\n')
    study = load_film(path)
    assert isinstance(study, StudyCase)
    assert study.case((0,)).problem.film.thickness.max() < study.case((1,)).problem.film.thickness.max()
    with pytest.raises(InputFaults, match=r"constants\.rize"):
        load_film(written(GOOD + '[study]\n"constants.rize" = ["5 um", "10 um"]\n'))


@pytest.mark.parametrize(
    ("old", "new", "path", "words"),
    [
        ('"20 N"', '"-20 N"', "film.load", ["more than 0 N"]),
        ('"20 N"', '"20 bar"', "film.load", ["not a force"]),
        ('load = "20 N"', 'moment_x = "1 N m"', "film.moment_x", ["without a load"]),
        ("[boundary]", '[load]\nforce = "1 N"\n[boundary]', "load", ["in [film]"]),
        ('"20 N"', '"20 N"\nmoment_x = "1 N"', "film.moment_x", ["not a torque"]),
        ("[boundary]", '[time]\nend = "1 s"\nstep = "1 s"\n[boundary]', "film.load", ["[time]"]),
        ('"10 um"', '"10 umm"', "constants.rise", ["bare number", "unit"]),
        ('"10 um"', "true", "constants.rise", ["bare number"]),
        ('"10 um"', '"10 um"\nx = 1', "constants.x", ["define already"]),
        ('"10 um"', '"10 um"\nsin = 1', "constants.sin", ["define already"]),
        ('"10 um"', '"10 um"\nh-0 = 1', "constants.h-0", ["a letter first"]),
        ("rise =", "rice =", "film.thickness", ["unknown name rise", "rice"]),
        ('["speed"', '["sped"', "film.velocity[0]", ["unknown name sped", "speed"]),
        ('{ pressure = "0 bar" }', '{ pressure = "rize" }', "boundary.left.pressure", ["unknown name rize", "rise"]),
    ],
)
def test_a_fault_says_where_what_and_what_instead(old, new, path, words):
    assert old in GOOD
    with pytest.raises(InputFaults) as refused:
        load_case(written(GOOD.replace(old, new)))
    told = [fault for fault in refused.value.faults if fault.path == path]
    assert told, str(refused.value)
    for word in words:
        assert word in f"{told[0].found} {told[0].expected} {told[0].nearest}", str(refused.value)
