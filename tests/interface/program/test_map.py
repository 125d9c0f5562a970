"""`swashfilm map`, `duty` and `compare`: what they take, leave and refuse."""

import csv
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pint
import pytest
import xarray
from bench_pump import BENCH

import swashfilm as sf
from reynolds import NotConverged
from swashfilm.__main__ import main
from swashfilm.cli.app import build_parser
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.levels import map_axis
from swashfilm.output.warnings import Grade, causes
from swashfilm.runs.compare.run import Side, fidelity_warnings
from swashfilm.runs.map.command import map_case
from swashfilm.runs.map.contour_levels import efficiency_levels
from swashfilm.runs.map.duty.cycle_file import read_cycle
from swashfilm.runs.map.files import read_map
from swashfilm.runs.map.page import axis_rows, best_rows
from swashfilm.runs.map.run import MapCase
from system import Fault, load_pump
from system.maps import point as map_point
from system.maps.plan import MapAxis, MapInput, map_plan

SMALL = [
    "--fidelity", "lumped", "--speeds", "1000..2000rpm:3", "--pressures", "10,20,30MPa",
    "--displacements", "0.5,1", "--check", "4",
]  # fmt: skip


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A whole run, pictures and all; the other tests go without pictures, which take most of the time."""
    folder = tmp_path_factory.mktemp("map") / "run"
    assert main(["map", str(BENCH), *SMALL, "-o", str(folder)]) == 0
    return folder


@pytest.fixture(autouse=True)
def no_pictures(run, monkeypatch):
    for place in ("map.page.map_pictures", "compare.run.compare_pictures"):
        monkeypatch.setattr(f"swashfilm.runs.{place}", lambda *_: {})


@pytest.mark.parametrize(
    ("text", "given", "levels"),
    [
        ("1000,1300,1700,2100rpm", MapInput.SPEED, [1000, 1300, 1700, 2100]),
        ("500..2500rpm:9, 3000rpm", MapInput.SPEED, [*range(500, 2501, 250), 3000]),
        ("60 rpm, 1..3rpm:2", MapInput.SPEED, [1, 3, 60]),
        ("0.28,1,.5", MapInput.RATIO, [0.28, 0.5, 1.0]),
        ("0.2..1:5", MapInput.RATIO, [0.2, 0.4, 0.6, 0.8, 1.0]),
        ("28,51,100%", MapInput.RATIO, [0.28, 0.51, 1.0]),
        ("20..100%:3", MapInput.RATIO, [0.2, 0.6, 1.0]),
        ("1000,1300 1/min", MapInput.SPEED, [1000, 1300]),
        ("20,35Hz", MapInput.SPEED, [1200, 2100]),
    ],
)
def test_levels_are_read(text, given, levels):
    scale = np.pi / 30.0 if given is MapInput.SPEED else 1.0
    assert map_axis("--x", text, given, "").values == pytest.approx([scale * level for level in levels])


@pytest.mark.parametrize(
    ("text", "given", "remedy"),
    [
        ("5-35MPa", MapInput.PRESSURE, "5..35MPa:7"),
        ("5..35MPa", MapInput.PRESSURE, "5MPa..35MPa:7"),
        ("5..35", MapInput.PRESSURE, ""),
    ],
)
def test_habits_get_a_remedy(text, given, remedy):
    assert map_axis("--x", text, given, "").nearest == remedy


@pytest.mark.parametrize(
    ("text", "words"), [("1000", "unit"), ("1..2rpm", "a number of levels"), ("1..2rpm:1", "2 to"), ("x", "rpm")]
)
def test_levels_that_are_none_are_told(text, words):
    found = map_axis("--speeds", text, MapInput.SPEED, "1000,2000rpm")
    assert isinstance(found, Fault)
    assert words in f"{found.found} {found.expected}"


def test_a_map_leaves_its_files(run):
    summary = json.loads((run / "summary.json").read_text())
    assert (summary["kind"], summary["points"], summary["solved"], summary["checked"]) == ("map", 18, 18, 4)
    assert len(list((run / "points").glob("*.json"))) == 22
    rows = list(csv.DictReader((run / "map.csv").open()))
    assert len(rows) == 18
    assert {"shaft speed [r/min]", "delivery pressure [MPa]", "shaft_torque [N m]", "paper.overall [1]"} <= set(rows[0])
    shares = list(csv.reader((run / "shares.csv").open()))
    np.testing.assert_allclose([sum(map(float, row[6:])) for row in shares[1:]], 100.0, atol=0.1)
    page = (run / "report.html").read_text()
    pictures = [name for own in (run / "plots").glob("*.json") for name in json.loads(own.read_text())]
    assert page.count("data:image/") == len(pictures)
    assert all((run / "plots" / name).is_file() for name in pictures)
    assert len(re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)) < 1e6
    assert page.index("best overall efficiency") < page.index("<nav>") < page.index("Efficiency by definition")
    (run / "report.html").unlink()
    assert main(["report", str(run)]) == 0
    assert (run / "report.html").is_file()


def test_the_netcdf_opens_without_us_and_has_units(run):
    with xarray.open_dataset(run / "map.nc", engine="h5netcdf") as data:
        assert data.sizes["shaft_speed"] == 3
        assert data.sizes["inlet_pressure"] == 1
        full = data.sel(displacement_ratio=1.0, delivery_pressure=20e6).isel(temperature=0, inlet_pressure=0)
        assert full["pair_loss"].sel(pair="slipper_swash_plate").shape == (3,)
        assert float(full["overall_efficiency"].sel(definition="paper").max()) > 0.8
        units = pint.UnitRegistry()
        for name, variable in data.variables.items():
            if variable.dtype.kind == "f":
                units.parse_expression(variable.attrs["units"])
                assert variable.attrs["long_name"], name
        assert "[pump]" in data.attrs["resolved_toml"]
        assert data.attrs["source"].startswith("swashfilm ")


def test_a_map_comes_back_from_its_file(run):
    data, error = read_map(run / "map.nc")
    assert data.shape == (3, 3, 2, 1, 1)
    assert error.count == 4
    rows = list(csv.DictReader((run / "map.csv").open()))
    assert data.values["shaft_torque"].flat[5] == pytest.approx(float(rows[5]["shaft_torque [N m]"]))
    assert data.warnings.flat[0][0][0] == "chamber_cavitates"


def test_another_level_solves_its_points_only(run, tmp_path, monkeypatch):
    solved, solve = [], map_point.LumpedSolver.solve
    monkeypatch.setattr(
        map_point.LumpedSolver, "solve", lambda *own: solved.append(own[-1].delivery_pressure) or solve(*own)
    )
    words = [*SMALL[:5], "10,15,20,30MPa", *SMALL[6:8], "--check", "0", "--resume", str(run)]
    assert main(["map", str(BENCH), *words, "-o", str(tmp_path / "more")]) == 0
    assert solved == [15e6] * 6
    summary = json.loads((tmp_path / "more" / "summary.json").read_text())
    assert (summary["kept"], summary["solved"]) == (18, 24)


def test_an_interrupted_map_goes_on(run, tmp_path, monkeypatch, capsys):
    solve, solved = map_point.LumpedSolver.solve, []

    def broken(self, pump, point):
        if len(solved) == 35:
            raise KeyboardInterrupt
        solved.append(point)
        return solve(self, pump, point)

    monkeypatch.setattr(map_point.LumpedSolver, "solve", broken)
    words = ["map", str(BENCH), *SMALL[:3], "1000..2000rpm:9", *SMALL[4:], "-o", str(tmp_path / "run")]
    assert main(words) == 130
    assert f"--resume {tmp_path / 'run.partial'}" in capsys.readouterr().err
    monkeypatch.setattr(map_point.LumpedSolver, "solve", solve)
    assert main([*words, "--resume", str(tmp_path / "run.partial")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert (summary["kept"], summary["solved"]) == (35, 54)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--fidelity", "lumped"], "no point is finished, one takes about 0.006 s of processor time"),
        (["--fidelity", "fixed", "--direct"], "no point is finished, one takes about 2 s of processor time"),
    ],
)
def test_a_map_stopped_before_its_first_point_says_so(words, told, tmp_path, monkeypatch, capsys):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("swashfilm.runs.map.run.run_kept", stopped)
    assert main(["map", str(BENCH), *words, "--workers", "1", "-o", str(tmp_path / "stopped")]) == 130
    assert told in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_grid_too_large_is_refused_before_its_points_are_made(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("system.maps.plan.check_operating_point", lambda *_: pytest.fail("a point is checked"))
    words = ["--speeds", "500..2100rpm:400", "--pressures", "5..35MPa:400", "--fidelity", "lumped"]
    assert main(["map", str(BENCH), *words, "-o", str(tmp_path / "large")]) == 2
    told = capsys.readouterr().err
    assert "640000, levels 400 of shaft speed x 400 of delivery pressure x 4 of displacement ratio" in told
    assert "at most 100000 points" in told


def test_a_point_that_fails_stops_no_other(tmp_path, monkeypatch, capsys):
    solve = map_point.LumpedSolver.solve

    def stalls(self, pump, point):
        if point.delivery_pressure == 20e6:
            raise NotConverged("made to fail")
        return solve(self, pump, point)

    monkeypatch.setattr(map_point.LumpedSolver, "solve", stalls)
    assert main(["map", str(BENCH), *SMALL, "-o", str(tmp_path / "run")]) == 0
    assert "made to fail" in (tmp_path / "run" / "report.html").read_text()
    assert "12 of 18 solved, 6 failed" in capsys.readouterr().out
    (tmp_path / "cycle.csv").write_text(
        "time [s], speed [rpm], pressure [bar], displacement ratio [1]\n0,1500,200,1\n1,1500,200,1\n"
    )
    assert main(["duty", str(tmp_path / "run"), str(tmp_path / "cycle.csv"), "-o", str(tmp_path / "d")]) == 2
    assert "points without a result" in capsys.readouterr().err
    assert main(["map", str(BENCH), *SMALL[:4], "--pressures", "20MPa", "-o", str(tmp_path / "none")]) == 3
    assert json.loads((tmp_path / "none" / "summary.json").read_text())["energy_balance_error_max"] is None


def test_fresh_points_that_fail_are_told(tmp_path, monkeypatch):
    """The error between levels says nothing of them: number, the first with its reason, and the remedy."""
    solve = map_point.LumpedSolver.solve

    def stalls(self, pump, point):
        if point.delivery_pressure not in (10e6, 20e6, 30e6):
            raise NotConverged("made to fail")
        return solve(self, pump, point)

    monkeypatch.setattr(map_point.LumpedSolver, "solve", stalls)
    assert main(["map", str(BENCH), *SMALL, "-o", str(tmp_path / "run")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    (warning,) = (one for one in summary["warnings"] if one.startswith("points_failed"))
    assert "3 of 4 fresh points have no result and are left out of the error between levels, such as " in warning
    assert "made to fail; add levels on both sides of it" in warning


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--speeds", "1000", "--plan", "papr", "--workers", "0"], ["--speeds", "--plan", "--workers"]),
        (
            ["--pressures", "5..25bar:3", "--fidelity", "lumped"],
            ["1 fault", "--pressures", "2.5 MPa gauge\n", "inlet_pressure"],
        ),
        (["--displacements", "1.2", "--fidelity", "lumped"], ["--displacements"]),
        (["--inlet-pressures", "10,25bar"], ["--inlet-pressures", "--direct needs about 13440 s"]),
        (["--fidelity", "lumped", "--direct"], ["--direct"]),
        (["--fidelity", "table", "--table", "no.json"], ["no.json"]),
        (["--workers", "2", "--cluster", "tcp://nowhere:1"], ["--workers"]),
        (["--resume", "nowhere"], ["--resume", "holds no points"]),
        (["--speed", "1000rpm"], ["--speed", "--speeds"]),
    ],
)
def test_what_is_wrong_is_told_before_the_first_point(words, told, tmp_path, capsys):
    assert main(["map", str(BENCH), *words, "-o", str(tmp_path / "run")]) == 2
    error = capsys.readouterr().err
    assert all(text in error for text in told), error
    assert not (tmp_path / "run").exists()


def test_pump_and_axes_are_told_of_together(tmp_path, capsys):
    (tmp_path / "bad.toml").write_text('name = "bad"\nformat = 1\n')
    assert main(["map", str(tmp_path / "bad.toml"), "--speeds", "1000", "--workers", "x"]) == 2
    error = capsys.readouterr().err
    assert all(text in error for text in ("--speeds", "--workers", "[pump]")), error


@pytest.mark.parametrize(
    ("build", "told"),
    [
        (lambda place: None, "no such file or folder"),
        (lambda place: place.write_text('name = "pump"'), "swashfilm map"),
        (lambda place: place.mkdir(), "a folder without map.nc"),
        (lambda place: (place / "points").mkdir(parents=True), "--resume"),
        (lambda place: (place.mkdir(), (place / "map.nc").write_text("x")), "the NetCDF file of a run"),
    ],
)
def test_what_is_no_map_is_told(build, told, tmp_path, capsys):
    place = tmp_path / "pump.toml"
    build(place)
    (tmp_path / "cycle.csv").write_text("")
    assert main(["duty", str(place), str(tmp_path / "cycle.csv"), "-o", str(tmp_path / "d")]) == 2
    assert told in capsys.readouterr().err


def test_both_sides_of_a_comparison_are_told(tmp_path, capsys):
    assert main(["compare", str(tmp_path), "nowhere"]) == 2
    error = capsys.readouterr().err
    assert "A: map" in error
    assert "B: map or pump" in error


def test_solved_points_outlive_an_error(tmp_path, monkeypatch):
    def broken(*_):
        raise ZeroDivisionError("a bug")

    monkeypatch.setattr("swashfilm.runs.map.run.write_tables", broken)
    words = ["map", str(BENCH), *SMALL[:2], "--speeds", "1000rpm", *SMALL[4:], "-o", str(tmp_path / "run")]
    with pytest.raises(ZeroDivisionError) as told:
        main(words)
    assert f"--resume {tmp_path / 'run.partial'}" in told.value.__notes__[0]
    assert list((tmp_path / "run.partial" / "points").glob("*.json"))


@pytest.mark.parametrize(("least", "most"), [(44.1, 85.8), (97.3, 99.73), (99.9, 99.9), (0.0, 100.0), (-3.0, 12.0)])
def test_contours_of_efficiencies_are_close_by_the_best(least, most):
    levels = efficiency_levels(np.array([least, most]))
    steps = np.diff(levels)
    assert levels[0] <= least
    assert levels[-2] <= most <= levels[-1] + 1e-9
    assert 2 <= len(levels) <= 14
    assert np.all(steps[:-1] >= 0.49 * steps[1:])
    assert steps[0] >= steps[-1] > 0.0


def _has_a_page_at_standstill(folder, summary):
    """A cycle without energy in, out and lost has a page that says why it has no mean efficiency."""
    still = folder.parent / "still"
    shutil.copytree(folder, still)
    energies = {words: {"value": 0.0, "error": 0.0} for words in summary["energy_J"]}
    void = {name: one | {"value": None, "error": None} for name, one in summary["efficiency"].items()}
    (still / "summary.json").write_text(json.dumps(summary | {"energy_J": energies, "efficiency": void}))
    assert main(["report", str(still)]) == 0
    assert "It has no mean efficiency: the pump stands still or motors" in (still / "report.html").read_text()


def test_duty_and_compare_leave_their_pages(run, tmp_path, capsys):
    cycle = tmp_path / "cycle.csv"
    cycle.write_text(
        "# a digger\ntime [s], pressure [bar], speed [rpm], displacement_ratio [%]\n"
        "0, 120, 1000, 60\n10, 280, 1900, 100\n10, 150, 1900, 80\n20, 150, 1200, 80\n"
    )
    assert main(["duty", str(run), str(cycle), "-o", str(tmp_path / "duty")]) == 0
    out = capsys.readouterr().out
    assert "Mean efficiency" in out
    assert "constant in the map: oil temperature in the case 50 degC" in out
    page = (tmp_path / "duty" / "report.html").read_text()
    assert page.index("energy lost") < page.index("<nav>") < page.index("Mean efficiency by definition")
    summary = json.loads((tmp_path / "duty" / "summary.json").read_text())
    assert summary["duration_s"] == 20.0
    course = list(csv.DictReader((tmp_path / "duty" / "course.csv").open()))
    step = [float(row["delivery pressure [MPa]"]) for row in course if float(row["time [s]"]) == 10.0]
    assert step == pytest.approx([28.0, 15.0])
    assert summary["energy_J"]["loss"]["error"] < 0.05 * summary["energy_J"]["loss"]["value"]
    assert main(["report", str(tmp_path / "duty")]) == 0
    _has_a_page_at_standstill(tmp_path / "duty", summary)
    other = tmp_path / "worn.toml"
    other.write_text(
        (run / "resolved.toml").read_text().replace('radial_clearance = "15 um"', 'radial_clearance = "25 um"')
    )
    assert main(["compare", str(run), str(other), "--cycle", str(cycle), "-o", str(tmp_path / "cmp")]) == 0
    rows = json.loads((tmp_path / "cmp" / "summary.json").read_text())
    differences = {row["words"]: row for row in rows["differences"]}
    assert differences["piston leakage"]["largest"]["value"] > 0.0
    assert not differences["ball guide-retainer friction"]["told"]
    assert [name.partition(" (")[2] for name in rows["names"]] == ["run)", "worn.toml)"]
    assert len(rows["duty"]) == 2
    assert main(["report", str(tmp_path / "cmp")]) == 0
    page = (tmp_path / "cmp" / "report.html").read_text()
    assert "No difference: ball guide-retainer friction" in page
    assert "+0 kW" not in page
    assert (tmp_path / "cmp" / "B" / "map.nc").is_file()
    set_one = ["--set", "piston.radial_clearance=25um"]
    assert main(["compare", str(run), str(run / "resolved.toml"), *set_one, "-o", str(tmp_path / "set")]) == 0
    found = json.loads((tmp_path / "set" / "summary.json").read_text())
    leaks = next(row for row in found["differences"] if row["words"] == "piston leakage")
    assert leaks["other"] == pytest.approx(differences["piston leakage"]["other"], rel=1e-6)
    assert found["names"][1].endswith("resolved.toml with piston.radial_clearance=25um)")
    assert main(["compare", str(run), str(run), *set_one]) == 2
    assert "a pump as B, whose keys it sets" in capsys.readouterr().err


def test_a_map_beside_itself_is_no_difference(run, tmp_path):
    assert main(["compare", str(run), str(run / "map.nc"), "-o", str(tmp_path / "cmp")]) == 0
    page = (tmp_path / "cmp" / "report.html").read_text("utf-8").replace("\u00a0", " ")
    assert "no difference of overall efficiency: it is within the error of both" in page
    assert "+0 kW" not in page
    assert main(["compare", str(run), str(run), "--fidelity", "fixed"]) == 2


def test_an_unknown_error_between_levels_is_told(run, tmp_path):
    """Maps of other levels whose error nothing measures: the errors told lack it; at the same levels it has no part."""
    one, other = (
        (*SMALL[:2], "--speeds", speeds, *SMALL[4:-1], "0") for speeds in ("1000rpm,2000rpm", "1000rpm,1800rpm")
    )
    for letter, words in zip("ab", (one, other), strict=True):
        assert main(["map", str(BENCH), *words, "-o", str(tmp_path / letter)]) == 0
    assert "not known" in (tmp_path / "a" / "report.html").read_text("utf-8")
    told = []
    for beside in ("b", "a"):
        assert main(["compare", str(tmp_path / "a"), str(tmp_path / beside), "-o", str(tmp_path / f"a{beside}")]) == 0
        told.append(json.loads((tmp_path / f"a{beside}" / "summary.json").read_text("utf-8"))["warnings"])
    (warning,), none = told
    assert warning.startswith("error_unknown: the error of A and B between levels is not known")
    assert none == []
    cycle = tmp_path / "cycle.csv"
    cycle.write_text("time [s],speed [rpm],pressure [bar],displacement ratio [1]\n0,1500,250,1\n9,1500,250,1\n")
    assert main(["duty", str(tmp_path / "a"), str(cycle), "-o", str(tmp_path / "duty")]) == 2


@pytest.mark.parametrize(
    ("levels", "checks", "fresh"), [((1e2, 2e2), None, 2), ((1e2, 2e2, 3e2), None, 0), ((1e2, 2e2), 5, 5)]
)
def test_a_map_of_films_with_two_levels_is_checked_at_fresh_points(levels, checks, fresh):
    plan = map_plan(load_pump("ref90"), (MapAxis(MapInput.SPEED, levels),))
    found = MapCase(plan, Fidelity.FIXED, direct=True, checks=checks)
    assert found.fresh == fresh
    assert found.cost == 2.0 * (len(levels) + fresh)


def test_maps_of_unlike_fidelities_get_a_named_warning(run):
    data, error = read_map(run / "map.nc")
    both = Side("a", data, error), Side("b", replace(data, words="fixed films"), error)
    (warning,) = fidelity_warnings(both)
    (cause,) = causes([warning])
    assert (cause.name, cause.grade) == ("fidelities_differ", Grade.CARE)
    assert cause.remedies == ("solve both maps by one fidelity",)
    assert not [*fidelity_warnings((both[0], both[0]))]


def test_points_beyond_the_rating_are_told_by_all_three_in_the_same_words(tmp_path, capsys):
    """A map, a cycle by it, and a comparison with a pump of a lower rating."""
    place, other = tmp_path / "map", tmp_path / "other.toml"
    levels = [
        "--fidelity",
        "lumped",
        "--speeds",
        "1000..2000rpm:3",
        "--pressures",
        "20,30,40MPa",
        "--displacements",
        "1",
    ]
    assert main(["map", str(BENCH), *levels, "-o", str(place)]) == 0
    rated = "limit rated_pressure, 35 MPa (films and coefficients are extrapolated); stay below it"
    assert f"operating.pressure: at 3 of 9 points; at the first: 40 MPa gauge, {rated}" in capsys.readouterr().out
    cycle = tmp_path / "cycle.csv"
    head = "time [s],speed [rpm],pressure [bar],displacement ratio [1]\n"
    cycle.write_text(head + "0,1500,250,1\n9,1500,380,1\n10,1500,390,1\n")
    assert main(["duty", str(place), str(cycle), "-o", str(tmp_path / "duty")]) == 0
    told = f"operating.pressure: at 2 of 3 rows of the cycle; at the first: 38 MPa gauge, {rated}"
    assert told in capsys.readouterr().out
    text = (place / "resolved.toml").read_text()
    other.write_text(re.sub('rated_pressure = ".*"', 'rated_pressure = "25 MPa"', text))
    assert main(["compare", str(place), str(other), "--cycle", str(cycle), "-o", str(tmp_path / "cmp")]) == 0
    out = capsys.readouterr().out
    assert f", at 3 of 9 points; at the first: 40 MPa gauge, {rated}" in out
    assert ", at 6 of 9 points; at the first: 30 MPa gauge, limit rated_pressure, 25 MPa" in out
    assert "at 2 of 3 rows of the cycle; at the first: 38 MPa gauge, limit rated_pressure, 25 MPa" in out


def test_rows_of_efficiency_begin_with_iso_4409_and_are_short(run, capsys):
    summary = json.loads((run / "summary.json").read_text())
    first, *others = (row[0] for row in best_rows(summary))
    assert first.startswith("overall efficiency (ISO 4409)")
    assert all(len(one) < 70 and one.startswith("overall efficiency (") for one in (first, *others))
    titles = dict(sf.open(run).tables())
    assert titles["Displacement"][0] == ("displacement ratio", "geometric", "swept", "by Toet (ISO 8426-1)")


def test_a_cycle_tells_the_points_with_a_warning_that_it_passes(tmp_path, capsys):
    """A friction law below its speeds at 3 of 9 points, beside which the cycle is half of its time."""
    levels = ["--fidelity", "lumped", "--speeds", "300,1000,2000rpm", "--pressures", "10,20,30MPa"]
    assert main(["map", str(BENCH), *levels, "--displacements", "1", "-o", str(tmp_path / "map")]) == 0
    cycle = tmp_path / "cycle.csv"
    rows = "0,600,200,1\n5,600,200,1\n5,1500,200,1\n10,1500,200,1\n"
    cycle.write_text("time [s],speed [rpm],pressure [bar],displacement ratio [1]\n" + rows)
    capsys.readouterr()
    assert main(["duty", str(tmp_path / "map"), str(cycle), "-o", str(tmp_path / "duty")]) == 0
    told = "friction_at_low_speed: at 3 of 9 points of the map, beside which the cycle spends 50.0% of its time"
    out = capsys.readouterr().out
    assert told in out
    assert "the shaft turns at 300 rpm (limit 500 rpm" in out


def test_the_error_of_a_duty_cycle_is_named(run, tmp_path, capsys):
    """In the table, the tiles and the words: of interpolation, not of the pump's model."""
    cycle = tmp_path / "cycle.csv"
    cycle.write_text("time [s],speed [rpm],pressure [bar],displacement ratio [1]\n0,1500,250,1\n9,1500,300,1\n")
    assert main(["duty", str(run), str(cycle), "-o", str(tmp_path / "duty")]) == 0
    out = capsys.readouterr().out
    assert "interpolation error  mean power" in out
    assert "interpolation error [percentage points]" in out
    page = (tmp_path / "duty" / "report.html").read_text().replace("\u00a0", " ")
    assert re.search(r"interpolation error [\d.e-]+ percentage points", page)


def test_pumps_of_two_sizes_are_compared_free_of_size(run, tmp_path, capsys):
    """A pump beside itself has no such rows; one of another stroke has shares, torque and flow over displacement."""
    assert main(["compare", str(run), str(run), "-o", str(tmp_path / "same")]) == 0
    assert json.loads((tmp_path / "same" / "summary.json").read_text())["specific"] == []
    assert "two sizes" not in capsys.readouterr().out
    other = tmp_path / "other.toml"
    text = (run / "resolved.toml").read_text()
    text = re.sub('(?m)^displacement = "[^"]*".*\n', "", text)
    other.write_text(re.sub('swash_angle_max = "[^"]*"', 'swash_angle_max = "12 deg"', text))
    assert main(["compare", str(run), str(other), "-o", str(tmp_path / "cmp")]) == 0
    assert "Pumps of two sizes: losses as shares of the shaft power at the same point" in capsys.readouterr().out
    summary = json.loads((tmp_path / "cmp" / "summary.json").read_text())
    one, two = summary["displacement_m3_per_rev"]
    assert two < 0.9 * one
    rows = {row["words"]: row for row in summary["specific"]}
    torque = rows["shaft torque over displacement"]
    assert torque["other"] / torque["one"] == pytest.approx(1.0, abs=0.1)
    whole = rows["total loss, share of the shaft power"]
    parts = sum(row["other"] for words, row in rows.items() if words.endswith("power") and row is not whole)
    assert parts == pytest.approx(whole["other"], rel=2e-3)
    page = (tmp_path / "cmp" / "report.html").read_text().replace("\u00a0", " ")
    assert "Differences free of size" in page
    assert "points of the shaft power" in page


def test_a_cycle_may_have_semicolons_and_decimal_commas(run, tmp_path):
    rows = "time [s];speed [rpm];pressure [bar];displacement ratio [1]\n0;1500;200;0,5\n1,5;1500;200,5;1\n"
    (tmp_path / "cycle.csv").write_text(rows)
    found = read_cycle(tmp_path / "cycle.csv", read_map(run / "map.nc")[0].axes)
    assert found.time.tolist() == [0.0, 1.5]
    assert found.inputs[MapInput.RATIO].tolist() == [0.5, 1.0]
    assert found.inputs[MapInput.PRESSURE] == pytest.approx([20e6, 20.05e6])


def test_all_faults_of_a_cycle_come_at_once_with_their_lines(run, tmp_path, capsys):
    """Cells that are no numbers, a time that falls, and inputs beyond the map."""
    rows = "0,1500,200,1\n2,x,200,1\n1,-1500,200,1\n3,1500,0,1\n4,0,200,1,9\n5,0,200,1\n"
    (tmp_path / "cycle.csv").write_text("time [s],speed [rpm],pressure [bar],displacement ratio [1]\n" + rows)
    assert main(["duty", str(run), str(tmp_path / "cycle.csv"), "-o", str(tmp_path / "d")]) == 2
    error = capsys.readouterr().err
    for told in ("5 faults", "line 6", "speed, line 3", "time, line 4", "1 s after 2 s in line 3",
                 "speed, lines 4, 7", "pressure, line 5", "the map's box"):  # fmt: skip
        assert told in error


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("time [s], speed [rpm], pressure [bar]\n0,1,1\n1,1,1\n", "displacement ratio"),
        ("time [s], sped [rpm], pressure [bar], displacement ratio [1]\n0,1,1,1\n1,1,1,1\n", "try:      speed"),
        ("time [s], speed [bar], pressure [bar], displacement ratio [1]\n0,1,1,1\n1,1,1,1\n", "rotational speed"),
        ("time [s], speed [rpm], pressure [bar], displacement ratio [1]\n0,x,1,1\n1,1,1,1\n", "speed, line 2"),
        ("time [s], speed [rpm], pressure [bar], displacement ratio [1]\n1,1,1,1\n0,1,1,1\n", "order of their time"),
        ("time [s], speed [rpm], pressure [bar], displacement ratio [1]\n1,1,1,1\n\n0,1,1,1\n", "time, line 4"),
        ("time [s], speed [rpm], pressure [bar], displacement ratio [1]\n1,1,1,1\n1,1,1,1\n", "1 s in all 2 rows"),
        (
            "time [s], speed [rpm], pressure [bar], displacement ratio [1]\n0,1500,200,1\n1,1500,500,1\n",
            "50 MPa at 1 s",
        ),
        (
            "time [s], speed [rpm], pressure [bar], displacement ratio [1]\n0,-5,200,1\n1,1500,500,1\n",
            "cycle.csv: 2 faults",
        ),
        ("time [s], speed [rpm], pressure [bar], displacement ratio [1]\n0,nan,200,1\n1,1500,inf,1\n", "2 faults"),
        ("time [s];speed [rpm];pressure [bar];displacement ratio [1]\n0;1;1;0,5\n1;1.5;1;1\n", "try:      0.5"),
        ("time [s], speed [rpm], pressure [bar], displacement ratio [1]\n0,1,1,0,5\n1,1,1,0,5\n", "5 cells"),
        ("time [s], speed [rpm], speed [rpm], displacement ratio [1]\n0,1,1,1\n1,1,1,1\n", "twice"),
        ("time, speed, pressure\n0,1,1\n1,1,1\n", "1 fault"),
        ("time, speed, pressure\n0,1,1\n1,1,1\n", "try:      time [s], speed [rpm], pressure [bar]"),
    ],
)
def test_what_is_wrong_with_a_cycle_is_told(run, text, told, tmp_path, capsys):
    (tmp_path / "cycle.csv").write_text(text)
    assert main(["duty", str(run), str(tmp_path / "cycle.csv"), "-o", str(tmp_path / "d")]) == 2
    assert told in capsys.readouterr().err
    assert not Path(tmp_path / "d").exists()


def test_the_loss_of_a_map_has_its_digits_once(run):
    summary = json.loads((run / "summary.json").read_text("utf-8"))
    least, largest = (f"{summary['loss'][end] * 1e-3:.4g}" for end in ("least_W", "largest_W"))
    assert dict(axis_rows(summary))["loss (shaft power minus p Q)"] == f"{least} .. {largest} kW"
    one = summary | {"loss": {"least_W": 1678.1, "largest_W": 1678.1}}
    assert dict(axis_rows(one))["loss (shaft power minus p Q)"] == "1.678 kW"


def test_a_set_input_with_levels_is_no_silent_value(capsys):
    """The levels of a map would outweigh it; alone, or with --plan point, it is the map's own."""
    speed = "operating.speed=900rpm"
    for words in (["map", "ref90"], ["sensitivity", "ref90", "--plan", "paper"], ["compare", "ref90", "ref90"]):
        assert main([*words, "--fidelity", "lumped", "--set", speed]) == 2
        told = capsys.readouterr().err
        assert "--set operating.speed\n    found:    beside levels of it, 1000 r/min, 1300 r/min" in told
    for plan, held in (("paper", "operating.temperature=80degC"), ("point", speed)):
        words = ["map", "ref90", "--fidelity", "lumped", "--plan", plan, "--set", held]
        assert len(map_case(build_parser().parse_args(words)).plan.axes) == len(MapInput)
