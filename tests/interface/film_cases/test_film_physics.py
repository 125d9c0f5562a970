"""Switches of a film case: oil laws, temperature, elastic walls, time; their faults and their round trip."""

import csv
import json
from pathlib import Path

import meshio
import numpy as np
import pytest
import xarray

from reynolds import Barus, BulkModulus, Cavitation, RationalDensity, Roelands
from reynolds.laws.density import DOWSON_HIGGINSON, Tait
from swashfilm.__main__ import main
from swashfilm.case.file import FilmCase, load_case
from swashfilm.case.tables.time_steps import TimeStepsSection
from swashfilm.runs.film.fields.history import fields_over_time
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system import InputFaults

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples" / "films"
BASE = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "1 mm"], cells = [16, 2] }
thickness = "10 um"
velocity = ["1 m/s", "0 m/s"]
VISCOSITY
[boundary]
left = { pressure = "1 bar" }
right = { pressure = "0 bar" }
"""
GIVEN = BASE.replace("VISCOSITY", 'viscosity = "30 mPa s"')
GRADE = BASE.replace("VISCOSITY", "") + (
    '[oil]\ngrade = "ISO VG 46"\ndensity = "860 kg/m3"\ntemperature = "50 degC"\n'
    'specific_heat = "1950 J/(kg K)"\nthermal_conductivity = "0.13 W/(m K)"\n'
)
COOLED = '{ heat_transfer_coefficient = "80 W/(m2 K)", outer_temperature = "20 degC" }'
WALLS = '[thermal]\nfixed_wall = "adiabatic"\nmoving_wall = { temperature = "50 degC" }\n'
PLATE = (
    '[elastic]\nfixed = { kind = "plate", thickness = "2 mm", cells = [4, 1, 1], support = "bottom", '
    'youngs_modulus = "210 GPa", poissons_ratio = 0.3 }\n'
)
ROUGH = '[roughness]\nmoving = "0.3 um"\nfixed = "0.4 um"\n'
CONTACT = (
    '[contact]\nasperity_density = "2e10 1/m2"\nasperity_radius = "5 um"\ncomposite_modulus = "100 GPa"\n'
    "friction_coefficient = 0.1\n"
)
MODULI = ('composite_modulus = "100 GPa"', 'youngs_modulus = ["70 GPa", "200 GPa"]')
THINNING = '[oil]\nshear_law = "carreau"\nsecond_newtonian = 0.2\nrelaxation_time = "1 us"\nshear_exponent = 0.5\n'
WARM_BODY = (
    '{ thermal_conductivity = "50 W/(m K)", thermal_expansion = "12e-6 1/K", unstrained_temperature = "30 degC", '
    'faces = { bottom = { temperature = "30 degC" } } }'
)
TIME = '[time]\nend = "4 ms"\nstep = "1 ms"\n'


@pytest.fixture
def read(tmp_path):
    def reading(text: str) -> FilmCase:
        path = tmp_path / "case.toml"
        path.write_text(text, encoding="utf-8")
        case = load_case(path)
        assert isinstance(case, FilmCase)
        return case

    return reading


@pytest.mark.parametrize(
    ("oil", "viscosity", "density"),
    [
        ('pressure_law = "barus"\npressure_viscosity_coefficient = "20 1/GPa"', Barus(2e-8), None),
        ('pressure_law = "roelands"\npressure_viscosity_coefficient = "20 1/GPa"', Roelands(2e-8), None),
        ('density_law = "dowson_higginson"', None, DOWSON_HIGGINSON),
        ('density_law = "bulk_modulus"\nbulk_modulus = "1.6 GPa"', None, BulkModulus(1.6e9)),
        (
            'density_law = "rational"\ndensity_pressure = "2.22 GPa"\ndensity_limit = 1.66',
            None, RationalDensity(2.22e9, 1.66),
        ),
        ('density_law = "tait"\ntait_modulus = "1.2 GPa"\ntait_slope = 10.5', None, Tait(1.2e9, 10.5)),
    ],
)  # fmt: skip
def test_an_oil_brings_its_laws(read, oil, viscosity, density):
    case = read(GIVEN + "[oil]\n" + oil)
    assert viscosity is None or case.problem.fluid.viscosity == viscosity
    assert density is None or case.problem.fluid.density == density
    again = read(case.resolved)
    assert again.resolved == case.resolved
    assert again.problem.fluid == case.problem.fluid


@pytest.mark.parametrize(
    "text",
    [
        GRADE + WALLS + 'inlet_temperature = "45 degC"\nlevels = 4\n',
        GRADE + WALLS.replace('"adiabatic"', COOLED),
        GRADE.replace('"1 bar"', '"1 bar", temperature = "60 degC"') + WALLS.replace('"adiabatic"', '"turning"'),
        GIVEN + ROUGH + 'lay_angle = "30 deg"\npeklenik_moving = 3.0\n',
        GIVEN.replace('"10 um"', '"1 um"') + ROUGH + CONTACT,
        GIVEN + PLATE,
        GIVEN + PLATE.replace("fixed =", 'winkler = "1e14 Pa/m"\nmoving ='),
        GIVEN + '[elastic]\nmoving = { kind = "half_space", youngs_modulus = "70 GPa", poissons_ratio = 0.33 }\n',
        GIVEN.replace('"1 bar"', '"1e5*(1 + t)"').replace('"10 um"', '"1e-5*(1 + t)"') + TIME + "outputs = 2\n",
        GIVEN.replace("[boundary]", "initial_film_fraction = 0.7\n[boundary]") + TIME,
    ],
)  # fmt: skip
def test_a_resolved_case_of_every_switch_is_the_same_case(read, text):
    first = read(text)
    again = read(first.resolved)
    assert again.resolved == first.resolved
    for table in ("[thermal]", "[elastic]", "[roughness]", "[contact]", "[time]"):
        assert (table in first.resolved) is (table in text)
    assert (first.problem.walls is None) is ("[elastic]" not in text)
    assert film_summary(solve_case(again))["load_N"] == film_summary(solve_case(first))["load_N"]


def example(name: str) -> dict:
    return film_summary(solve_case(load_case(EXAMPLES / f"{name}.toml")))


def test_a_starved_slider_begins_where_its_closed_form_does():
    """Verification cases 3.1: film fraction .65, W* = .114235, pmax* = .207692; the front moves by whole cells."""
    summary = example("starved_slider")
    scale = 0.03 * 1.0 * 0.01**2 / 1e-5**2 * 1e-3
    cell = 1.0 / 140.0
    assert summary["load_N"] == pytest.approx(0.114235 * scale, rel=5.0 * cell)
    assert summary["cavitated_area_fraction"] == pytest.approx(0.142857, abs=1.5 * cell)
    assert summary["film_fraction_min"] == 0.65


def test_a_soft_channel_lets_through_what_winkler_says():
    """Verification cases 3.11: k/(48 mu L) [(h0 + p/k)^4 - h0^4] per width."""
    summary = example("soft_channel")
    flow = 1e13 / (48 * 0.03 * 0.01) * ((5e-6 + 30e6 / 1e13) ** 4 - 5e-6**4) * 1e-3
    assert summary["flow_m3_per_s"]["right"] == pytest.approx(flow, rel=1e-3)
    assert summary["deformation_max_m"] == pytest.approx(3e-6)


def test_a_bent_plate_gives_way_and_the_film_keeps_its_load():
    """Of rigid walls: pi p (r2^2 - r1^2)/(2 ln(r2/r1)) less the pocket's area."""
    summary = example("bending_plate")
    assert 0.2e-6 < summary["deformation_max_m"] < 5e-6
    rigid = np.pi * 5e6 * ((20e-3) ** 2 - (5e-3) ** 2) / (2 * np.log(4.0)) - np.pi * (5e-3) ** 2 * 5e6
    assert summary["load_N"] == pytest.approx(rigid, rel=0.1)
    assert summary["load_N"] > rigid * 0.99


def test_rough_walls_that_touch_bear_and_rub(read):
    """Composite roughness 0.5 um, h = 1 um: lambda 2; Greenwood and Tripp's F5/2(2) = .005423705 (4.2)."""
    summary = film_summary(solve_case(read(GIVEN.replace('"10 um"', '"1 um"') + ROUGH + CONTACT)))
    assert summary["lambda_ratio_min"] == pytest.approx(2.0)
    factor = 16 * np.sqrt(2) * np.pi / 15 * (2e10 * 5e-6 * 0.5e-6) ** 2 * np.sqrt(0.5 / 5.0)
    assert summary["contact_load_N"] == pytest.approx(factor * 100e9 * 0.005423705 * 1e-5, rel=1e-5)
    assert summary["contact_friction_N"] == pytest.approx(0.1 * summary["contact_load_N"])


def test_a_rough_film_that_is_too_thin_warns(read):
    thin = film_summary(solve_case(read(GIVEN.replace('"10 um"', '"0.4 um"') + ROUGH)))
    warnings = {warning["name"]: warning["text"] for warning in thin["warnings"]}
    assert "0.8" in warnings["boundary_lubrication"]
    thinner = film_summary(solve_case(read(GIVEN.replace('"10 um"', '"0.2 um"') + ROUGH)))
    assert {"boundary_lubrication", "flow_factors_out_of_range"} <= {w["name"] for w in thinner["warnings"]}


def test_a_warm_film_is_in_balance_with_its_walls():
    summary = example("warm_slider")
    assert summary["temperature_max_K"] > 313.15
    out = summary["oil_heat_W"] + summary["wall_heat_W"]["moving"] + summary["wall_heat_W"]["fixed"]
    assert out == pytest.approx(summary["dissipation_W"], rel=0.01)
    assert abs(summary["wall_heat_W"]["fixed"]) < 1e-9
    assert summary["heat_balance_error"] < 1e-9


def test_a_viscosity_that_falls_with_temperature_needs_no_grade(read):
    oil = GRADE.partition("[oil]")[2].replace('grade = "ISO VG 46"', 'temperature_coefficient = "0.03 1/K"')
    cold = film_summary(solve_case(read(GIVEN)))
    warm = film_summary(solve_case(read(GIVEN + "[oil]" + oil + WALLS)))
    assert warm["temperature_max_K"] > 323.15
    assert warm["dissipation_W"] < cold["dissipation_W"]


@pytest.mark.parametrize(("step", "steps"), [(1e-3, 4), (1.7e-3, 3), (1.2e-3, 4), (4e-3, 1)])
def test_no_step_is_longer_than_stated(step, steps):
    """Equal steps end at the end of the time, as a march takes them."""
    section = TimeStepsSection(end=4e-3, step=step)
    assert section.steps == steps
    assert section.step_taken <= step * (1.0 + 1e-9)


def test_a_transient_leaves_its_films_and_its_history(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = GIVEN.replace('"10 um"', '"1e-5*(1 - 20*t)"').replace('"1 m/s"', '"0 m/s"').replace("1 bar", "0 bar")
    text = text.replace(
        '"rectangle", size = ["10 mm", "1 mm"], cells = [16, 2]',
        '"rectangle", size = ["10 mm", "1 mm"], cells = [32, 1], periodic = "y"',
    )
    Path("press.toml").write_text(text + TIME + "outputs = 2\n", encoding="utf-8")
    assert main(["film", "press.toml", "-o", "run"]) == 0
    with open("run/history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["time [s]"]) for row in rows] == pytest.approx([1e-3, 2e-3, 3e-3, 4e-3])
    # A strip pressed at V: load per width mu V L^3/h^3, h at the end of the step.
    for row in rows:
        thickness = 1e-5 * (1 - 20 * float(row["time [s]"]))
        assert float(row["load [N]"]) == pytest.approx(0.03 * 2e-4 * 0.01**3 / thickness**3 * 1e-3, rel=2e-3)
    assert sorted(path.name for path in Path("run").glob("film_*.vtu")) == ["film_0001.vtu", "film_0002.vtu"]
    assert 'timestep="0.004"' in Path("run/film.pvd").read_text("utf-8")
    summary = json.loads(Path("run/summary.json").read_text("utf-8"))
    assert summary["time_steps"] == 4
    assert summary["mass_balance_error_of_time"] < 1e-9
    with xarray.open_dataset("run/results.nc", engine="h5netcdf") as fields:
        np.testing.assert_allclose(fields["time"], [2e-3, 4e-3])
        assert fields["film_pressure"].dims == ("time", "vertex")
        assert fields["cells"].dims == ("cell", "corner")
        np.testing.assert_allclose(fields["film_thickness"].isel(vertex=0), [9.6e-6, 9.2e-6])


def test_a_long_series_is_thinned_and_told(read, monkeypatch):
    from swashfilm.runs.film.checks import validity as film_warnings

    study = solve_case(read(GIVEN + TIME))
    films = 4 * film_warnings.MOST_FIELDS * 8 * len(study.solution.problem.space.vertices)
    monkeypatch.setattr(film_warnings, "MOST_BYTES", films / 2)
    np.testing.assert_allclose(fields_over_time(study)["time"], [2e-3, 4e-3])
    assert "results_thinned" in {warning["name"] for warning in film_summary(study)["warnings"]}


def test_fields_of_every_switch_are_written(tmp_path):
    for name, fields in (("warm_slider", {"temperature", "film_fraction"}), ("soft_channel", {"deformation"})):
        assert main(["film", str(EXAMPLES / f"{name}.toml"), "-o", str(tmp_path / name), "--csv"]) == 0
        heads = {head.partition(" [")[0] for head in meshio.read(tmp_path / name / "film.vtu").point_data}
        assert fields <= heads
        header = (tmp_path / name / "fields.csv").read_text("utf-8").splitlines()[0]
        assert fields | {"x", "y", "film_pressure"} <= {head.split(" [")[0] for head in header.split(",")}


def test_a_film_that_warms_itself_is_told(read):
    """Couette: heat mu U^2/h per area, and between cold walls a mean rise of mu U^2/(12 k): 0.02 K and 31 K."""
    for speed, told in (("1 m/s", False), ("40 m/s", True)):
        warnings = film_summary(solve_case(read(GIVEN.replace("1 m/s", speed))))["warnings"]
        assert ("temperature_not_solved" in {warning["name"] for warning in warnings}) is told


def test_a_film_hotter_than_its_oil_is_no_number(read):
    """The case is well stated: no film is found for it."""
    from reynolds import NotConverged

    hot = read(GRADE.replace('"1 m/s"', '"60 m/s"').replace('"10 um"', '"3 um"') + WALLS.replace("50 degC", "140 degC"))
    with pytest.raises(NotConverged) as refused:
        solve_case(hot)
    for word in ("oil temperature", "a lower speed"):
        assert word in str(refused.value)


def test_an_oil_that_thins_with_shear_drags_less(read):
    """Shear rate 1e5 1/s, relaxation time 1 us: 0.2 + 0.8 (1.01)^(-1/4) of the viscosity."""
    text = GIVEN.replace('"1 bar"', '"0 bar"')
    still, thin = (film_summary(solve_case(read(text + more))) for more in ("", THINNING))
    share = 0.2 + 0.8 * 1.01**-0.25
    assert thin["friction_force_moving_N"][0] == pytest.approx(share * still["friction_force_moving_N"][0], rel=1e-6)
    eyring = film_summary(solve_case(read(text + '[oil]\nshear_law = "eyring"\neyring_stress = "5 kPa"\n')))
    share = np.arcsinh(0.6) / 0.6
    assert eyring["friction_force_moving_N"][0] == pytest.approx(share * still["friction_force_moving_N"][0], rel=1e-6)
    first = read(text + THINNING)
    assert read(first.resolved).resolved == first.resolved


def test_temperature_in_time_comes_to_the_steady_one(read):
    walls = "[thermal]\nfixed_wall = { temperature = '60 degC' }\nmoving_wall = { temperature = '50 degC' }\n"
    steady = film_summary(solve_case(read(GRADE + walls)))
    marched = solve_case(read(GRADE + walls + TIME.replace("4 ms", "40 ms").replace("1 ms", "10 ms")))
    summary = film_summary(marched)
    assert summary["temperature_mean_K"] == pytest.approx(steady["temperature_mean_K"], abs=0.05)
    assert summary["temperature_of_time_max_K"] >= summary["temperature_max_K"]
    assert marched.history[0].temperature_max is not None


def test_a_warm_body_takes_the_heat_and_grows_into_the_film(read):
    """All of the heat leaves through the bottom of the plate: its mean rise under the film is Q d/(k A)."""
    hot = read(GRADE.replace('"1 m/s"', '"20 m/s"') + PLATE + WALLS.replace('"adiabatic"', WARM_BODY))
    solved = solve_case(hot)
    assert solved.heat is not None
    rise = solved.heat.to_fixed * 2e-3 / (50.0 * 1e-5)
    area = hot.problem.space.lumped(np.ones(hot.problem.space.area.shape))
    mean = np.average(solved.heat.fixed_wall, weights=area)
    assert rise > 5.0
    assert mean - 303.15 == pytest.approx(rise, rel=0.01)
    assert film_summary(solved)["film_thickness_min_m"] < 1e-5
    assert read(hot.resolved).resolved == hot.resolved


@pytest.mark.parametrize(
    ("text", "path", "words"),
    [
        (GIVEN + '[oil]\ngrade = "ISO VG 46"\n', "oil.grade", ["beside film.viscosity", "one of the two"]),
        (GIVEN + '[oil]\npressure_law = "baros"\n', "oil.pressure_law", ["'barus'", "barus"]),
        (
            GIVEN + '[oil]\npressure_law = "barus"\n', "oil.pressure_viscosity_coefficient",
            ["a pressure coefficient", "20 1/GPa"],
        ),
        (
            GIVEN + '[oil]\npressure_law = "barus"\npressure_viscosity_coefficient = "20 GPa"\n',
            "oil.pressure_viscosity_coefficient", ["not a pressure coefficient"],
        ),
        (GIVEN + '[oil]\ndensity_law = "bulk_modulus"\n', "oil.bulk_modulus", ["a bulk modulus"]),
        (
            GIVEN + '[oil]\ndensity_law = "rational"\ndensity_pressure = "2 GPa"\ndensity_limit = 0.9\n',
            "oil.density_limit", ["0.9", "more than 1"],
        ),
        (
            GIVEN + '[oil]\ndensity_law = "tait"\ntait_modulus = "1 GPa"\ntait_slope = 0\n', "oil.tait_slope",
            ["more than 0"],
        ),
        (GIVEN + '[oil]\nrelaxation_time = "1 us"\n', "oil.relaxation_time", ["a shear_law that has it"]),
        (GIVEN + '[oil]\nshear_law = "carrot"\n', "oil.shear_law", ["'carrot'", "carreau"]),
        (GIVEN + '[oil]\nshear_law = "carreau"\n', "oil.relaxation_time", ["a time"]),
        (GIVEN + THINNING.replace("0.5", "1.5"), "oil.shear_exponent", ["at most 1"]),
        (GIVEN + '[oil]\nshear_law = "eyring"\n', "oil.eyring_stress", ["a pressure"]),
        (GRADE + WALLS.replace('"adiabatic"', WARM_BODY), "thermal.fixed_wall", ["elastic.fixed"]),
        (GRADE + PLATE + WALLS.replace('"adiabatic"', WARM_BODY.replace("30 degC", "30 bar")),
         "thermal.fixed_wall.faces.bottom.temperature", ["not a temperature"]),
        (GRADE + PLATE + WALLS.replace('"adiabatic"', WARM_BODY.replace("bottom = {", "faces = {}, b = {")),
         "thermal.fixed_wall.faces.faces", ["an empty table", "a table with temperature; or"]),
        (GIVEN + '[oil]\npresure_law = "barus"\n', "oil.presure_law", ["unknown key", "pressure_law"]),
        (GIVEN + WALLS, "thermal", ["no table [oil]"]),
        (GRADE.replace("specific_heat", "spec_heat") + WALLS, "oil.spec_heat", ["specific_heat"]),
        (GRADE + WALLS.replace('"adiabatic"', '"adiabat"'), "thermal.fixed_wall", ["'adiabat'", "'adiabatic'"]),
        (GRADE + "[thermal]\nfixed_wall = 'adiabatic'\n", "thermal.moving_wall", ["missing"]),
        (GRADE + WALLS + "levels = 1\n", "thermal.levels", ["at least 2"]),
        (
            GRADE + WALLS.replace('temperature = "50', 'heat_transfer_coefficient = "50'),
            "thermal.moving_wall.heat_transfer_coefficient", ["a heat transfer coefficient"],
        ),
        (
            GIVEN + "[oil]" + GRADE.partition("[oil]")[2].replace('grade = "ISO VG 46"', "") + WALLS,
            "oil.temperature_coefficient", ["the decrease of viscosity"],
        ),
        (
            GRADE + 'temperature_coefficient = "0.03 1/K"\n', "oil.temperature_coefficient",
            ["without film.viscosity", "40 and 100 degC"],
        ),
        (GIVEN + "[elastic]\n", "elastic", ["an empty table", "winkler"]),
        (GIVEN + '[elastic]\nwinkler = "1e13 Pa"\n', "elastic.winkler", ["not a stiffness per area"]),
        (GIVEN + PLATE.replace('"plate"', '"plat"'), "elastic.fixed.kind", ["plate"]),
        (GIVEN + PLATE.replace("[4, 1, 1]", "[4, 1]"), "elastic.fixed.cells", ["a list of 3", "whole number"]),
        (GIVEN + PLATE.replace('"bottom"', '"top"'), "elastic.fixed.support", ["'bottom', 'edge', 'free'"]),
        (GIVEN + PLATE.replace("0.3", "0.5"), "elastic.fixed.poissons_ratio", ["less than 0.5"]),
        (GIVEN + PLATE.replace("thickness", "thick"), "elastic.fixed.thick", ["unknown key", "thickness"]),
        (
            GIVEN + PLATE.replace('kind = "plate"', 'mesh = "no.msh", face = "top"'), "elastic.fixed.mesh",
            ["no file"],
        ),
        (GIVEN + TIME.replace("1 ms", "9 ms"), "time.step", ["at most the end"]),
        (GIVEN + TIME + "outputs = 0\n", "time.outputs", ["at least 1"]),
        (GIVEN + TIME.replace("end", "till"), "time.end", ["a time"]),
        (
            GIVEN.replace("[boundary]", 'squeeze = "1 um/s"\n[boundary]') + TIME, "film.squeeze",
            ["beside a table [time]"],
        ),
        (
            GIVEN.replace("[boundary]", "initial_film_fraction = 0.5\n[boundary]"), "film.initial_film_fraction",
            ["steady"],
        ),
        (
            GIVEN.replace("[boundary]", "initial_film_fraction = 1.5\n[boundary]") + TIME,
            "film.initial_film_fraction", ["at most 1"],
        ),
        (GIVEN.replace('"10 um"', '"1e-5*(1 + t)"'), "film.thickness", ["needs a table [time]"]),
        (GIVEN.replace('"1 bar"', '"1e5*x"') + TIME, "boundary.left.pressure", ["a formula of t"]),
        (
            GIVEN.replace('"1 bar"', '"1e5*(1 - 1000*t)"') + TIME, "boundary.left.pressure",
            ["-100 kPa at 0.002 s", "at least the cavitation pressure"],
        ),
        (
            GIVEN.replace('"1 bar"', '"1e7*t", film_fraction = 0.5') + TIME, "boundary.left.pressure",
            ["10 kPa at 0.001 s", "full film"],
        ),
        (GIVEN + "[contact]\n", "contact", ["no table [roughness]"]),
        (GIVEN + ROUGH.replace('"0.3 um"', '"-1 um"'), "roughness.moving", ["at least 0 mm"]),
        (GIVEN + ROUGH + "peklenik = 20\n", "roughness.peklenik", ["20"]),
        (GIVEN + '[roughness]\ncomposit = "1 um"\n', "roughness.composit", ["unknown key", "composite"]),
        (GIVEN + '[roughness]\ncomposite = "0 um"\n', "roughness.composite", ["more than 0"]),
        (GIVEN + ROUGH + CONTACT.replace("asperity_radius", "radius"), "contact.asperity_radius", ["a length"]),
        (GIVEN + ROUGH + CONTACT.replace("0.1\n", "-0.1\n"), "contact.friction_coefficient", ["at least 0"]),
        (GIVEN + ROUGH + CONTACT.replace(*MODULI), "contact.poissons_ratio", ["missing", "of the two walls"]),
    ],
)  # fmt: skip
def test_a_fault_of_a_switch_says_where(read, text, path, words):
    with pytest.raises(InputFaults) as refused:
        read(text)
    told = [fault for fault in refused.value.faults if fault.path == path]
    assert told, str(refused.value)
    for word in words:
        assert word in f"{told[0].found} {told[0].expected} {told[0].nearest}", str(refused.value)


def test_a_film_that_closes_in_time_says_when(read):
    case = read(GIVEN.replace('"10 um"', '"1e-5*(1 - 500*t)"') + TIME)
    with pytest.raises(ValueError, match=r"at t = 0.002 s, film.thickness: .* above zero everywhere"):
        solve_case(case)


def test_the_fixed_wall_may_move_instead(read):
    wedge = GIVEN.replace('"10 um"', '"1e-5*(2 - x/0.01)"').replace("1 bar", "0 bar")
    one = film_summary(solve_case(read(wedge)))
    other = film_summary(solve_case(read(wedge.replace("velocity =", "velocity_fixed ="))))
    assert other["load_N"] == pytest.approx(one["load_N"])
    assert other["friction_force_fixed_N"] == pytest.approx(one["friction_force_moving_N"])
    assert read(wedge).problem.cavitation is Cavitation.JFO
    assert np.all(read(wedge).problem.film.velocity_fixed[0] == 0.0)
