"""Studies of films: what varies, what comes of every point, and how a study goes on after a break."""

import csv
import json
import tomllib
from pathlib import Path

import meshio
import numpy as np
import pytest
import xarray
from slider_case import slider_case

from swashfilm.__main__ import main
from swashfilm.case.study import StudyCase, _axis, load_film
from swashfilm.runs.film.series import films as film_series
from swashfilm.runs.film.series.films import study_digest
from system import InputFaults
from system.inputs.toml_table import Table

BASE = slider_case('"10 mm", "10 mm"', "8, 2") + "[study]\n"
SPEEDS = '"film.velocity[0]" = ["1 m/s", "2 m/s", "4 m/s"]\n'


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def written(table: str, base: str = BASE) -> Path:
    path = Path("slider.toml")
    path.write_text(base + table, encoding="utf-8")
    return path


def study(table: str) -> StudyCase:
    found = load_film(written(table))
    assert isinstance(found, StudyCase)
    return found


def summary_of(folder: str) -> dict:
    return json.loads((Path(folder) / "summary.json").read_text("utf-8"))


def test_two_keys_vary_all_with_all_or_in_step():
    table = SPEEDS + '"film.viscosity" = { from = "10 mPa s", to = "40 mPa s", points = 3 }\n'
    both = study(table)
    assert both.shape == (3, 3)
    assert len(both.points) == 9
    in_step = study(table + 'combine = "together"\n')
    assert in_step.points == [(0, 0), (1, 1), (2, 2)]
    assert in_step.axes[1].values == ("10 mPa s", "25 mPa s", "40 mPa s")
    assert in_step.case((2, 2)).problem.film.viscosity.item() == 0.04
    assert in_step.case((2, 2)).problem.film.velocity_moving[0].item() == 4.0


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ('{ from = "1 MPa s", to = "100 MPa s", points = 3, spacing = "log" }', [1e6, 1e7, 1e8]),
        ('{ from = "0 degC", to = "100 degC", points = 3 }', [273.15, 323.15, 373.15]),
        ("{ from = 1, to = 3, points = 5 }", [1.0, 1.5, 2.0, 2.5, 3.0]),
    ],
)
def test_a_range_has_equal_steps_or_equal_ratios(text, numbers):
    axis = _axis(Table("study", {"film.k": tomllib.loads(f"a = {text}")["a"]}, []), "film.k")
    assert axis.numbers == pytest.approx(numbers)


def test_a_study_leaves_tables_plots_and_a_page(capsys):
    written(SPEEDS + '"film.thickness" = ["1e-5*(2 - x/0.01)", "2e-5*(2 - x/0.01)"]\n')
    assert main(["film", "slider.toml", "-o", "run"]) == 0
    with open("run/study.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 6
    loads = {(row["film.velocity[0] [m/s]"], row["film.thickness"]): float(row["load [N]"]) for row in rows}
    assert loads["4", "1e-5*(2 - x/0.01)"] == pytest.approx(4.0 * loads["1", "1e-5*(2 - x/0.01)"])
    assert loads["1", "1e-5*(2 - x/0.01)"] == pytest.approx(4.0 * loads["1", "2e-5*(2 - x/0.01)"])
    with xarray.open_dataset("run/study.nc", engine="h5netcdf") as data:
        assert data["load_N"].dims == ("film.velocity[0]", "film.thickness")
        assert data["load_N"].attrs["units"] == "N"
        np.testing.assert_array_equal(data["film.velocity[0]"], [1.0, 2.0, 4.0])
    summary = summary_of("run")
    assert summary["solved"] == summary["points"] == 6
    assert summary["numbers"]["load_N"]["max_at"]["film.velocity[0]"] == "4 m/s"
    assert {"load_N.png", "friction_force_moving_N.x.png", "stribeck.png"} <= {
        p.name for p in Path("run/plots").iterdir()
    }
    page = Path("run/report.html").read_text("utf-8")
    assert page.count("data:image/") == len(list(Path("run/plots").iterdir()))
    assert "6 of 6 points" in capsys.readouterr().out
    Path("run/report.html").unlink()
    assert main(["report", "run"]) == 0
    assert Path("run/report.html").is_file()


def test_a_point_that_fails_tells_why_and_stops_no_other(capsys):
    written('"film.thickness" = ["10 um", "-10 um"]\n')
    assert main(["film", "slider.toml", "-o", "run"]) == 0
    (failed,) = summary_of("run")["failed"]
    assert failed["status"] == "faulty"
    assert "film.thickness: '-10 um' is -1e-05" in failed["reason"]
    assert "above zero" in capsys.readouterr().out


def test_a_study_without_any_result_ends_with_3(monkeypatch):
    from reynolds import FilmNotConverged

    def stall(case):
        raise FilmNotConverged("it stalls", "something else")

    monkeypatch.setattr(film_series, "solve_case", stall)
    written(SPEEDS)
    assert main(["film", "slider.toml", "-o", "run"]) == 3
    summary = summary_of("run")
    assert {point["reason"] for point in summary["failed"]} == {"it stalls. Try: something else"}
    assert summary["mass_balance_error_max"] is None


def test_an_interrupted_study_goes_on_where_it_stopped(monkeypatch, capsys):
    written(SPEEDS)
    solve, solved = film_series.solve_case, []

    def broken(case):
        if len(solved) == 2:
            raise KeyboardInterrupt
        solved.append(case)
        return solve(case)

    monkeypatch.setattr(film_series, "solve_case", broken)
    assert main(["film", "slider.toml", "-o", "run"]) == 130
    told = capsys.readouterr().err
    assert "To continue: swashfilm film slider.toml -o run --resume run.partial" in told
    assert len(list(Path("run.partial/points").glob("*.json"))) == 2
    monkeypatch.setattr(film_series, "solve_case", lambda case: solved.append(case) or solve(case))
    assert main(["film", "slider.toml", "-o", "run", "--resume", "run.partial"]) == 0
    assert len(solved) == 3
    assert summary_of("run")["solved"] == 3
    assert len(list(Path("run.partial/points").glob("*.json"))) == 2
    written('"film.velocity[0]" = ["1 m/s", "2 m/s", "3 m/s"]\n')
    assert main(["film", "slider.toml", "-o", "more", "--resume", "run"]) == 0
    assert len(solved) == 4
    written(SPEEDS, BASE.replace("30 mPa s", "31 mPa s"))
    assert main(["film", "slider.toml", "-o", "other", "--resume", "run"]) == 0
    assert len(solved) == 7


def test_points_of_another_mesh_file_or_program_are_solved_anew(monkeypatch, here):
    film = 'format = 1\n[film]\nmesh = "pad.vtu"\nthickness = "h"\nvelocity = ["u", "0 m/s"]\n'
    film += 'viscosity = "1 Pa s"\n[boundary]\nouter = { pressure = "0 bar" }\n[study]\n'
    path = written('"film.viscosity" = ["30 mPa s"]\n', film)

    def key_at(speed: float) -> str:
        points = [(1e-3 * x, 1e-3 * y, 0.0) for y in range(3) for x in range(3)]
        quads = [("quad", np.array([[k, k + 1, k + 4, k + 3] for k in (0, 1, 3, 4)]))]
        data = {"h": [np.array([2e-5, 1e-5, 2e-5, 1e-5])], "u": [np.full(4, speed)]}
        meshio.write_points_cells(here / "pad.vtu", np.array(points), quads, cell_data=data)
        return study_digest(load_film(path).case((0,)))

    slow = key_at(1.0)
    assert key_at(2.0) != slow == key_at(1.0)
    monkeypatch.setattr(film_series, "version", lambda package: "0.0")
    assert key_at(1.0) != slow


def test_two_workers_give_what_one_gives():
    written(SPEEDS)
    assert main(["film", "slider.toml", "-o", "one"]) == 0
    assert main(["film", "slider.toml", "-o", "two", "--workers", "2"]) == 0
    assert summary_of("one")["numbers"] == summary_of("two")["numbers"]


@pytest.mark.parametrize(
    ("table", "path", "words"),
    [
        ('"film.thicknes" = ["1 um"]', 'study."film.thicknes"', ["unknown key", '"film.thickness"']),
        ('"flim.thickness" = ["1 um"]', 'study."flim.thickness"', ["unknown key", '"film.thickness"']),
        ('"film.thickness" = "1 um"', 'study."film.thickness"', ["a list of values, or a range"]),
        ('"film.thickness" = []', 'study."film.thickness"', ["a list of values, or a range"]),
        ('"film.thickness" = ["1 bar"]', 'study."film.thickness"', ["not a length"]),
        ('film.thickness = ["1 um"]', 'study."film"', ["in quotes"]),
        ('"film.thickness" = { from = "1 um", to = "2 um" }', 'study."film.thickness".points', ["2 to"]),
        ('"film.thickness" = { from = "1 m", to = "2 Pa", points = 3 }', 'study."film.thickness"', ["one kind"]),
        ('"film.thickness" = { form = "1 m", to = "2 m", points = 3 }', 'study."film.thickness".form', ["from"]),
        (
            '"film.thickness" = { from = "0 um", to = "2 um", points = 3, spacing = "log" }',
            'study."film.thickness".spacing', ["above zero"],
        ),
        (SPEEDS + '"film.viscosity" = ["1 Pa s"]\ncombine = "together"', "study.combine", ["3 of", "1 of"]),
        (SPEEDS + 'combine = "al"', "study.combine", ["'all', 'together'", "all"]),
        ("", "study", ["no varied key"]),
        (SPEEDS + '"film.order" = { from = 1, to = 2, points = 9999 }', "study", ["29997 points", "at most"]),
    ],
)  # fmt: skip
def test_a_fault_of_a_study_says_where(table, path, words):
    with pytest.raises(InputFaults) as refused:
        load_film(written(table))
    told = [fault for fault in refused.value.faults if fault.path == path]
    assert told, str(refused.value)
    for word in words:
        assert word in f"{told[0].found} {told[0].expected} {told[0].nearest}", str(refused.value)


def test_a_key_of_the_pump_of_a_gap_is_meant_with_pump_before_it():
    Path("gap.toml").write_text(
        'format = 1\n[film]\ngap = "slipper"\npump = "ref90"\n[study]\n"oil.grade" = ["ISO VG 46"]\n', "utf-8"
    )
    with pytest.raises(InputFaults) as refused:
        load_film(Path("gap.toml"))
    assert [fault.nearest for fault in refused.value.faults] == ['"pump.oil.grade"']


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--workers", "0"], ["--workers", "1 to 64"]),
        (["--refine", "3"], ["--refine", "beside a study"]),
        (["--csv"], ["--csv", "beside a study"]),
        (["--resume", "nowhere"], ["--resume", "holds no points"]),
    ],
)
def test_options_that_do_not_fit_are_told(words, told, capsys):
    written(SPEEDS)
    assert main(["film", "slider.toml", *words]) == 2
    text = capsys.readouterr().err
    for word in told:
        assert word in text, text
    assert not Path("runs").exists() or not list(Path("runs").iterdir())


def test_a_single_film_takes_no_workers(capsys):
    Path("one.toml").write_text(BASE.replace("[study]", ""), encoding="utf-8")
    assert main(["film", "one.toml", "--workers", "2"]) == 2
    assert "a study" in capsys.readouterr().err


def test_a_study_is_checked(capsys):
    written(SPEEDS)
    assert main(["check", "slider.toml"]) == 0
    assert "a study of 3 points" in capsys.readouterr().out
