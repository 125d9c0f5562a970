"""One gap of a pump over the revolution as a film case: what it takes, what it leaves, what is wrong with it."""

import csv
import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray

from gaps import Effect
from swashfilm.__main__ import main
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.case.study import load_film
from swashfilm.runs.film.revolution.solve import revolution_summary, solve_revolution
from swashfilm.runs.film.revolution.validity import _motion
from swashfilm.runs.film.series.points import StudyWork
from system import InputFaults, lumped_point

SLIPPER = """format = 1
[film]
gap = "slipper"
pump = "ref90"
revolution = true
chamber_pressure = "5 MPa"
[operating]
pressure = "5 MPa"
[revolution]
steps = 24
films = 3
finer = 0.25
tolerance = 0.1
walls = "rigid"
oil = "isoviscous"
heat = "none"
"""
BLOCK = SLIPPER.replace("slipper", "valve_plate").replace("steps = 24", "steps = 27")


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def written(text: str) -> Path:
    path = Path("case.toml")
    path.write_text(text, encoding="utf-8")
    return path


def case_of(text: str) -> RevolutionCase:
    case = load_film(written(text))
    assert isinstance(case, RevolutionCase)
    return case


def faults_of(text: str) -> dict[str, str]:
    """Nearest choice, or what was expected, of each fault by its path."""
    with pytest.raises(InputFaults) as raised:
        load_film(written(text))
    return {fault.path: fault.nearest or fault.expected for fault in raised.value.faults}


def table(path: str) -> dict[str, np.ndarray]:
    with Path(path).open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], np.array(rows[1:]).T, strict=True))


def test_a_turn_leaves_tables_fields_pictures_and_a_page(capsys):
    assert main(["film", str(written(SLIPPER)), "-o", "out", "--animate", "--refine", "2"]) == 0
    assert "two meshes: order assumed" in capsys.readouterr().out
    names = {path.name for path in Path("out").iterdir()} - {"animation.mp4"}
    assert names == {
        "input.toml", "resolved.toml", "summary.json", "slipper.csv", "convergence.csv", "results.nc", "fields",
        "slipper.pvd", "report.html", "animation.gif", "refinement.csv",
    }  # fmt: skip
    summary = json.loads(Path("out/summary.json").read_text("utf-8"))
    assert "boundary_lubrication" not in {told["name"] for told in summary["warnings"]}
    turn = table("out/slipper.csv")
    least = turn["film_thickness_min [um]"].astype(float)
    assert len(least) == 24
    assert least.min() == pytest.approx(1e6 * summary["film_thickness_min_m"])
    at = turn["shaft_angle [deg]"].astype(float)[least.argmin()]
    assert at == pytest.approx(summary["film_thickness_min_at_deg"])
    leakage = turn["leakage_flow [L/min]"].astype(float).mean() / 6e4
    # The table has 24 instants, the summary what the march has passed.
    assert leakage == pytest.approx(summary["leakage_flow_m3_per_s"], rel=0.02)
    found = summary["refinement"]
    assert found["dofs"][1] > 3 * found["dofs"][0]
    assert {"film_thickness_min_m", "leakage_flow_m3_per_s", "friction_power_W"} <= set(found["numbers"])
    documented(summary)
    turns = table("out/convergence.csv")
    assert len(turns["turn"]) == summary["turns"]
    assert float(turns["multiplier_1 [1]"][-1]) == pytest.approx(summary["largest_multiplier"], rel=1e-5)
    assert set(turn["active"]) <= {"lift", "contact", "cavitation", "retainer", "contact+cavitation"}
    with xarray.open_dataset("out/results.nc", engine="h5netcdf") as data:
        assert data.sizes["film_angle"] == 3
        lowest = data["film_thickness"].min().item()
    assert lowest >= summary["film_thickness_min_m"] * (1.0 - 1e-9)
    films = sorted(path.name for path in Path("out/fields").iterdir())
    assert films == [f"slipper_{k:03d}.vtu" for k in range(3)]
    assert Path("out/slipper.pvd").read_text("utf-8").count("fields/slipper_") == 3
    in_true_place()
    page = Path("out/report.html")
    page.unlink()
    assert main(["report", "out"]) == 0
    text = page.read_text("utf-8")
    assert text.count("data:image/") == 6
    assert "data:image/gif" in text
    assert text.index("least film of the turn") < text.index("<nav>") < text.index("The step error is")


def documented(summary: dict[str, object]) -> None:
    """Keys of the summary and variables of the results are those of docs/files.md."""
    page = (Path(__file__).parents[3] / "docs" / "files.md").read_text("utf-8")
    keys = page.partition("## summary.json of a revolution\n")[2].partition("\n## ")[0]
    first = "".join(line.split("|")[1] for line in keys.splitlines() if line.startswith("| `"))
    assert set(re.findall(r"`([^`]+)`", first)) == set(summary)
    with xarray.open_dataset("out/results.nc", engine="h5netcdf") as data:
        names = {str(name) for name in data.variables}
    told = page.partition("Of a revolution, over `shaft_angle`")[2]
    assert names - {"shaft_angle"} <= set(re.findall(r"`([^`]+)`", told))


def in_true_place() -> None:
    """The slipper at 360 deg lies on the swash plate at the inner dead centre."""
    import meshio

    rotor = case_of(SLIPPER).rotor
    found = meshio.read("out/fields/slipper_002.vtu").points
    middle = found.mean(axis=0)
    normal = np.linalg.svd(found - middle)[2][-1]
    assert abs(normal[2]) == pytest.approx(np.cos(rotor.drive.swash_angle), rel=1e-6)
    assert middle[0] > 0.9 * rotor.pump.pump.pitch_radius
    assert middle[1] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.long
def test_a_film_that_warms_tells_its_temperatures():
    """In table, results, fields and page: between the oil that enters at 50 degC and the hottest place."""
    import meshio

    assert main(["film", str(written(SLIPPER.replace("none", "solved"))), "-o", "out"]) == 0
    summary, turn = json.loads(Path("out/summary.json").read_text("utf-8")), table("out/slipper.csv")
    mean, hottest = (turn[f"film_temperature_{what} [degC]"].astype(float) for what in ("mean", "max"))
    assert np.all((mean > 50.0) & (mean < hottest))
    assert hottest.max() + 273.15 == pytest.approx(summary["film_temperature_max_K"], abs=1e-3)
    with xarray.open_dataset("out/results.nc", engine="h5netcdf") as data:
        assert data.attrs["fixed_wall_temperature_K"] == pytest.approx(summary["fixed_wall_temperature_K"])
        kept = data["film_temperature"].values
        assert data["film_temperature"].attrs["units"] == "K"
    assert np.array_equal(meshio.read("out/fields/slipper_002.vtu").point_data["film_temperature [K]"], kept[2])
    assert 323.0 < kept.min() < kept.max() <= summary["film_temperature_max_K"]
    assert Path("out/report.html").read_text("utf-8").count("data:image/") == 6


def test_the_ring_repeats_with_the_pitch():
    assert main(["film", str(written(BLOCK)), "-o", "out"]) == 0
    turn = table("out/valve_plate.csv")
    assert turn["shaft_angle [deg]"].astype(float) == pytest.approx([40.0 / 3.0, 80.0 / 3.0, 40.0])
    summary = json.loads(Path("out/summary.json").read_text("utf-8"))
    assert summary["span_deg"] == pytest.approx(40.0)


def test_a_film_that_may_not_cavitate_warns():
    """A rim that falls by more than the film pulls on the oil behind the slipper."""
    fallen = 'cavitation = "none"\n[pump.slipper]\nrim_relief.depth = "20 um"\n'
    stated = SLIPPER.replace('chamber_pressure = "5 MPa"', 'chamber_pressure = "1 bar"')
    study = solve_revolution(case_of(stated + fallen))
    assert "pressure_below_cavitation" in {told["name"] for told in revolution_summary(study)["warnings"]}


def test_a_film_as_thin_as_its_walls_are_rough_warns_of_contact_with_its_share_of_friction():
    """Eight micrometres bear the slipper on smooth lands; summits of ten touch."""
    rough = '[pump.surfaces.slipper_swash_plate]\ncomposite_roughness = "10 um"\n'
    summary = revolution_summary(solve_revolution(case_of(SLIPPER + rough)))
    (told,) = (one["text"] for one in summary["warnings"] if one["name"] == "boundary_lubrication")
    assert f"{summary['rubbing_power_W'] / summary['friction_power_W']:.0%} (limit 10%)" in told
    assert f"bears up to {summary['contact_load_max_N']:.0f} N at" in told
    assert f"composite roughness at {summary['film_thickness_min_at_deg']:.0f} deg" in told


@pytest.mark.slow
def test_a_piston_turns_within_its_clearance():
    text = SLIPPER.replace("slipper", "piston").replace('"5 MPa"', '"1 MPa"', 1)
    text = text.replace("[operating]", '[operating]\nspeed = "1000 rpm"')  # half the steps of 2100 rpm
    assert main(["film", str(written(text)), "-o", "out"]) == 0
    turn = table("out/piston.csv")
    assert float(turn["eccentricity_x_case [um]"].astype(float).max()) < 25.0
    assert set("+".join(turn["active"]).split("+")) <= {"lift", "contact", "cavitation"}


def test_a_resolved_case_is_the_same_case():
    case = case_of(SLIPPER + 'surfaces = "smooth"\n[pump.slipper]\nrim_relief.depth = "3 um"\n')
    again = case_of(case.resolved)
    assert again.options == case.options
    assert again.rotor == case.rotor
    assert again.chamber_pressure == case.chamber_pressure
    warm = case_of(SLIPPER.replace("none", "solved"))
    assert warm.options.physics.heat
    assert case_of(warm.resolved).options == warm.options
    assert case.options.physics.left_out == (
        Effect.PRESSURE_VISCOSITY, Effect.ROUGHNESS, Effect.ELASTIC_WALLS, Effect.HEAT,
    )  # fmt: skip


def test_pressures_come_from_the_cycle_from_rows_from_steps_and_from_a_file():
    listed = {0: 1, 90: 2, 180: 3, 270: 2, 360: 1}
    rows = str([[f"{angle} deg", f"{pressure} MPa"] for angle, pressure in listed.items()])
    Path("p.csv").write_text("pressure [bar],angle [deg]\n10,0\n20,90\n30,180\n20,270\n", encoding="utf-8")
    found = []
    for stated in (rows, '["1 MPa", "2 MPa", "3 MPa", "2 MPa"]', '"p.csv"'):
        case = case_of(SLIPPER.replace('chamber_pressure = "5 MPa"', f"chamber_pressure = {stated}"))
        angles, pressures = case.chamber_pressure.over_turn(case.rotor)
        assert pressures[np.searchsorted(angles, 0.5 * np.pi)] == pytest.approx(2e6, rel=1e-6)
        found.append(pressures)
    assert found[0] == pytest.approx(found[1])
    assert found[0] == pytest.approx(found[2])
    case = case_of(SLIPPER.replace('chamber_pressure = "5 MPa"\n', ""))
    cycle = lumped_point(case.rotor.pump, case.rotor.point).cycle
    assert np.array_equal(case.chamber_pressure.over_turn(case.rotor)[1], cycle.pressure)


def test_every_fault_is_told_at_once():
    wrong = SLIPPER.replace("5 MPa", "5 MPs").replace("steps = 24", "step = 24").replace("rigid", "rigd")
    wrong = wrong.replace("0.1", "2").replace(
        "[operating]", 'shaft_angle = "3 deg"\n[load]\nforce = "1 N"\n[operating]'
    )
    assert set(faults_of(wrong)) == {
        "film.chamber_pressure", "film.shaft_angle", "load", "operating.pressure", "revolution.step",
        "revolution.walls", "revolution.tolerance",
    }  # fmt: skip
    assert faults_of(wrong)["revolution.step"] == "steps"
    assert faults_of(BLOCK.replace("steps = 27", "steps = 28"))["revolution.steps"] == "27"
    assert "cycle" in faults_of(SLIPPER.replace('"5 MPa"', '"cycl"', 1))["film.chamber_pressure"]
    assert "[film]" in faults_of(SLIPPER.replace("[film]\n", "").partition("[revolution]")[0])["gap"]


@pytest.mark.parametrize(
    ("stated", "told"),
    [
        ('["1 MPa", "2 MPa"]', "2 rows"),
        ('"-2 bar"', "-200 kPa"),
        ('[["0 deg", "1 MPa"], ["90 deg", "1 MPa"], ["80 deg", "1 MPa"], ["95 deg", "1 MPa"]]', "90 deg, 80 deg"),
        ('"none.csv"', "no file"),
        ("3", "3"),
    ],
)
def test_pressures_that_are_none_are_refused(stated, told):
    with pytest.raises(InputFaults, match=told):
        load_film(written(SLIPPER.replace('chamber_pressure = "5 MPa"', f"chamber_pressure = {stated}")))


def test_the_command_line_leaves_physics_out(capsys):
    case = load_film(written(SLIPPER), {"surfaces": "smooth", "cavitation": "none"})
    assert isinstance(case, RevolutionCase)
    assert {Effect.ROUGHNESS, Effect.CAVITATION} <= set(case.options.physics.left_out)
    assert "# command line: revolution.surfaces = smooth" in case.text
    instant = SLIPPER.replace("revolution = true\n", "").partition("[revolution]")[0]
    assert main(["film", str(written(instant)), "--rigid", "--smooth"]) == 2
    told = capsys.readouterr().err
    assert "--rigid" in told
    assert "--smooth" in told
    assert "revolution = true" in told
    assert main(["film", str(written(instant)), "--animate"]) == 2
    assert main(["film", str(written(SLIPPER)), "--csv", "--workers", "2"]) == 2
    told = capsys.readouterr().err
    assert "--csv" in told
    assert "--workers" in told
    assert "revolution = true in [film]" in faults_of(instant + "[revolution]\nsteps = 24\n")["revolution"]


STUDY = SLIPPER + '[study]\n"pump.slipper.rim_relief.depth" = ["2 um", "3 um"]\n'


@pytest.mark.long
def test_a_study_varies_the_pump_and_goes_on_after_a_break(monkeypatch):
    assert main(["film", str(written(STUDY)), "-o", "out"]) == 0
    found = table("out/study.csv")
    least = found["film thickness min [um]"].astype(float)
    assert len(least) == 2
    assert least[0] != pytest.approx(least[1], rel=1e-3)
    assert {"film_thickness_min_m.png", "course_tilt_rad.png"} <= {path.name for path in Path("out/plots").iterdir()}
    with xarray.open_dataset("out/study.nc", engine="h5netcdf") as data:
        curves = data["course_film_thickness_min_m"]
        assert curves.dims == ("pump.slipper.rim_relief.depth", "shaft_angle_deg")
        assert curves.min("shaft_angle_deg").values == pytest.approx(1e-6 * least)
    monkeypatch.setattr(StudyWork, "solve", _refused)
    assert main(["film", str(written(STUDY)), "-o", "again", "--resume", "out"]) == 0
    assert np.array_equal(table("again/study.csv")["film thickness min [um]"], found["film thickness min [um]"])


def _refused(*_):
    raise AssertionError("a point that was kept")


def test_a_turn_that_does_not_settle_says_where(capsys):
    text = SLIPPER.replace("slipper", "piston").replace('"5 MPa"', '"20 MPa"') + 'surfaces = "smooth"\n'
    assert main(["film", str(written(text)), "-o", "out"]) == 3
    told = capsys.readouterr().err
    assert re.search(r"after \d+(\.\d+)? deg: .*piston at .* s: walls that touch", told)
    assert not Path("out").exists()


@pytest.mark.parametrize(
    ("multiplier", "told"),
    [(1.5 + 0.0j, "another, stable one may exist"), (1.5j, "once round in 4 turns"), (-1.5 + 0.0j, "in 2 turns")],
)
def test_a_disturbance_that_grows_straight_away_does_not_whirl(multiplier, told):
    """A real positive multiplier turns nothing: no turns once round are told."""
    closing = SimpleNamespace(largest_multiplier=1.5, multipliers=np.array([multiplier, 0.1]))
    found = SimpleNamespace(closing=closing, turn=SimpleNamespace(step_error=0.0))
    ((name, text),) = _motion(None, found, 0.0)
    assert name == "motion_unstable"
    assert told in text
