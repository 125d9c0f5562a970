"""[physics] in runs of the fidelity fixed: what a folder tells, a finding's films, and what has no solution."""

import json
from dataclasses import replace

import numpy as np
import pytest
import pyvista
import xarray

from diagnosis.procedure.pump_comparison import OF_FILMS, compare_films
from gaps import Effect, Physics
from swashfilm.__main__ import main
from swashfilm.runs.diagnose.fields import FIELDS_FILE, film_pictures, write_film_fields
from swashfilm.runs.diagnose.files import film_rows
from swashfilm.runs.pump.data import PICTURED_TURN
from system import SMOOTH, EffectId, films_point, load_pump, lumped_point, operating_point, resolved_toml
from system.description.effects import PhysicsSection
from system.films.oil_state import oil_state
from system.inputs.sections.reader import section_of
from system.maps.point import LumpedSolver, MapWork
from system.points.film_effects import SOLVED

REF90 = load_pump("ref90")
BARUS = 1.5e-8
CASE = 0.15e6
FOUND = {"viscosity_pressure": {"coefficient": BARUS}, "churning": {"factor": 1.0}}
NAMES = ("without", "with")


def extended(tables, pump=REF90):
    return replace(pump, physics=section_of(PhysicsSection, tables))


def silent(done, total, what):
    """Report to nobody."""


@pytest.fixture(scope="module")
def pump_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("pump") / "found.toml"
    path.write_text(resolved_toml(extended(FOUND)), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def run(pump_file, tmp_path_factory):
    folder = tmp_path_factory.mktemp("films") / "run"
    assert main(["run", str(pump_file), "--fidelity", "fixed", "-o", str(folder)]) == 0
    return folder


def test_the_summary_tells_what_the_films_solve(run):
    summary = json.loads((run / "summary.json").read_text("utf-8"))
    assert summary["physics"] == {"films_solve": ["viscosity_pressure"], "closed_laws": ["churning"]}
    page = (run / "report.html").read_text("utf-8")
    assert "the films solve viscosity pressure; by closed-form laws: churning." in page


def test_results_and_fields_for_paraview_hold_the_oils_state(run):
    """Barus' law at every vertex; no temperature of films that have the case's."""
    with xarray.open_dataset(run / "results.nc", engine="h5netcdf") as data:
        pressure, viscosity = (data[f"slipper_{name}"].values for name in ("film_pressure", "film_viscosity"))
        assert data["slipper_film_viscosity"].attrs["units"] == "Pa s"
        assert "slipper_film_temperature" not in data
    resting = json.loads((run / "summary.json").read_text("utf-8"))["operating_point"]["viscosity_Pa_s"]
    np.testing.assert_allclose(
        viscosity, resting * np.exp(BARUS * (pressure - CASE)), rtol=0.02
    )  # between a cell's points
    mesh = pyvista.read(next((run / "fields").glob("slipper_*.vtu")))
    assert {"film_pressure [Pa]", "film_thickness [m]", "film_viscosity [Pa s]"} <= set(mesh.point_data)


def test_oil_of_a_cold_film_has_the_cases_state():
    """A film that is warm by name only: its viscosity and temperature are those of the case."""
    point = operating_point(REF90)
    films = films_point(REF90, point, positions_per_pitch=2, finer=0.25, tolerance=1.0)
    solution = films.gaps.slipper[0].solution
    assert oil_state(REF90, Physics(heat=False, pressure_viscosity=False), solution, point.viscosity) == {}
    found = oil_state(REF90, SMOOTH.including(Effect.HEAT), solution, point.viscosity)
    np.testing.assert_allclose(found["film_viscosity"], point.viscosity)
    np.testing.assert_allclose(found["film_temperature"], point.temperature)


def test_a_lumped_run_has_every_effect_by_its_closed_law(pump_file, tmp_path):
    assert main(["run", str(pump_file), "--fidelity", "lumped", "-o", str(tmp_path / "run")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    assert summary["physics"] == {"films_solve": [], "closed_laws": ["viscosity_pressure", "churning"]}


def test_a_run_at_another_temperature_has_the_films_of_that_temperature(tmp_path):
    """The clearance's law starts from the pump's own temperature, also where the command line gives another."""
    path = tmp_path / "pump.toml"
    path.write_text(resolved_toml(extended({"thermal_clearance": {"slipper": {"rate": 0.01}}})), encoding="utf-8")
    plain, found = tmp_path / "plain", tmp_path / "found"
    for name, folder in (("ref90", plain), (str(path), found)):
        assert main(["run", name, "--temperature", "70degC", "--fidelity", "lumped", "-o", str(folder)]) == 0
    one, other = (json.loads((folder / "summary.json").read_text("utf-8")) for folder in (plain, found))
    times = other["leakage"]["slipper_m3_per_s"] / one["leakage"]["slipper_m3_per_s"]
    assert 1.4 < times < 1.2**3  # its orifice takes a part of the pressure
    again = load_pump(str(found / "resolved.toml"))
    assert again.slipper.film_thickness == pytest.approx(1.2 * REF90.slipper.film_thickness)
    assert not again.physics.on


@pytest.mark.parametrize("fidelity", ["lumped", "fixed", "floating"])
def test_a_clearance_that_warmth_closes_is_refused_however_it_is_stated(fidelity, capsys):
    """By --set beside --temperature: the law starts from the file's temperature in every fidelity."""
    shrinks = ["--set", "physics.thermal_clearance.piston.rate=-0.02 1/K", "--temperature", "110degC"]
    assert main(["run", "ref90", "--fidelity", fidelity, *shrinks]) == 2
    assert "a film that is closed at +60 K; expected above -0.0158 1/K" in capsys.readouterr().err


def test_a_run_at_the_pumps_own_temperature_keeps_the_law(tmp_path):
    path = tmp_path / "pump.toml"
    path.write_text(resolved_toml(extended({"thermal_clearance": {"slipper": {"rate": 0.01}}})), encoding="utf-8")
    found = tmp_path / "found"
    assert main(["run", str(path), "--speed", "1500rpm", "--fidelity", "lumped", "-o", str(found)]) == 0
    assert load_pump(str(found / "resolved.toml")).physics.thermal_clearance is not None


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """Run folders of films without and with a slipper that opens, and their comparison."""
    folder = tmp_path_factory.mktemp("both")
    pumps = {"without": REF90, "with": extended({"elastic_opening": {"slipper": {"opening": 2e-8}}})}
    points = {name: lumped_point(pump, operating_point(pump)) for name, pump in pumps.items()}
    compared = compare_films(pumps, points, {EffectId.ELASTIC_OPENING}, silent)
    for name, films in compared.points.items():
        (folder / name).mkdir()
        write_film_fields(folder / name, films)
    return folder, compared


def test_a_finding_is_followed_into_the_films(both):
    """Fields of both pumps for ParaView; leakage by closed-form law and by films, by nearly the same factor."""
    folder, told = both
    for name in NAMES:
        assert (folder / name / "pump.pvd").is_file()
        assert (folder / name / FIELDS_FILE).is_file()
    rows = {row["quantity"]: row for row in film_rows(told)}
    assert list(rows) == [
        f"{what}, {gap}" for gap in ("piston", "slipper", "valve plate") for what in ("leakage", "shear")
    ]
    opened = rows["leakage, slipper"]
    law, films = (float(opened[f"{kind}_with"]) / float(opened[f"{kind}_without"]) for kind in ("lumped", "films"))
    assert law > 2.0
    assert films == pytest.approx(law, rel=0.05)
    same = rows["leakage, valve plate"]
    assert float(same["films_with"]) == pytest.approx(float(same["films_without"]), rel=0.01)
    assert "18 shaft angles" in told.text


def test_the_gap_that_opens_is_drawn_without_beside_with(both):
    folder, _ = both
    found = {"effects": [{"id": "elastic_opening", "pair": "slipper"}, {"id": "churning", "pair": None}]}
    pictures = film_pictures(folder, NAMES, found)
    ((caption, png),) = pictures.items()
    assert f"slipper at {20 * round(18 * PICTURED_TURN)} deg of the shaft, without and with" in caption
    assert png.axes
    everywhere = film_pictures(folder, NAMES, {"effects": [{"id": "film_heating", "pair": None}]})
    assert len(everywhere) == 3
    assert film_pictures(folder / "with", NAMES, found) == {}


def test_a_finding_beside_the_films_solves_none():
    told = compare_films({"without": REF90}, {}, {EffectId.CHURNING}, silent)
    assert told.points == {}
    assert "does not act on the films" in told.text
    assert set(SOLVED) < set(OF_FILMS)


def test_films_that_cannot_be_solved_tell_why():
    """A part that stands in a wall."""
    touching = replace(REF90, slipper=replace(REF90.slipper, tilt_radial=2e-3))
    told = compare_films({"without": touching}, {}, {EffectId.FILM_HEATING}, silent)
    assert told.text.startswith("The films could not be solved: ")
    assert told.points == {}


def test_films_of_a_worn_piston_are_compared_beside_the_others(tmp_path):
    """Fields without and with a finding: of the most common chambers, and of the one that differs."""
    single = load_pump("ref90", {"piston.3.radial_clearance": "25 um"})
    pumps = {"without": single, "with": replace(single, physics=extended(FOUND).physics)}
    points = {name: lumped_point(pump, operating_point(pump)) for name, pump in pumps.items()}
    found = compare_films(pumps, points, {EffectId.VISCOSITY_PRESSURE}, silent)
    assert set(found.points) == set(pumps)
    write_film_fields(tmp_path, found.points["with"])
    assert (tmp_path / FIELDS_FILE).is_file()
    assert (tmp_path / "chamber_3" / "fields" / "piston_000.vtu").is_file()


def test_a_maps_points_are_kept_by_the_temperature_that_clearances_change_from():
    """Two pumps that are alike but for it have other points; without the law it is no part of a point."""
    stated = {"thermal_clearance": {"slipper": {"rate": 0.01}}}
    for tables, same in ((stated, False), (FOUND, True)):
        one = extended(tables)
        other = replace(one, operating=replace(one.operating, temperature=343.15))
        keys = {MapWork(pump, LumpedSolver()).key(operating_point(REF90)) for pump in (one, other)}
        assert (len(keys) == 1) == same


def test_a_map_of_films_solved_point_by_point_reads_them(pump_file, run, tmp_path):
    words = ["map", str(pump_file), "--fidelity", "fixed", "--plan", "point", "--direct", "--check", "0"]
    assert main([*words, "-o", str(tmp_path / "map")]) == 0
    told = json.loads((tmp_path / "map" / "summary.json").read_text("utf-8"))["assumptions"]
    assert told[0] == "[physics]: solved in the films: viscosity_pressure; by closed-form laws: churning"
    assert not any("oil.pressure_viscosity" in one for one in told)
    with xarray.open_dataset(tmp_path / "map" / "map.nc", engine="h5netcdf") as data:
        drain = float(data["drain_flow"].values.ravel()[0])
    flow = json.loads((run / "summary.json").read_text("utf-8"))["flow"]
    assert drain == pytest.approx(flow["case_m3_per_s"], rel=1e-9)
