"""Mistakes of a stranger in a film case, and numbers that cannot be read: the message names place and value."""

import json
from pathlib import Path

import meshio
import numpy as np
import pytest

from swashfilm.__main__ import main
from swashfilm.case.file import load_case
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary

CASE = """format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "1 mm"], cells = [16, 2] }
thickness = "1e-5*(2 - x/0.01)"
velocity = ["1 m/s", "0 m/s"]
viscosity = "30 mPa s"
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""
OIL = """[oil]
density = "860 kg/m3"
temperature = "40 degC"
specific_heat = "2000 J/(kg K)"
thermal_conductivity = "0.13 W/(m K)"
temperature_coefficient = "0.03 1/K"
"""
WALLS = '[thermal]\nfixed_wall = "adiabatic"\nmoving_wall = { temperature = "40 degC" }\n'
FULL = CASE.replace("viscosity", 'cavitation = "none"\norder = 2\nviscosity', 1)
ROUGH = '[roughness]\nmoving = "0 um"\nfixed = "0 um"\n'
STEEL = 'youngs_modulus = "210 GPa"\npoissons_ratio = 0.3\n'
DISC = """[elastic.fixed]
kind = "disc"
thickness = "2 mm"
outer_radius = "2 mm"
cells = [4, 8, 1]
support = "bottom"
"""
NOTHING_THERE = '[study]\n"film.velocity[7]" = ["1 m/s", "2 m/s"]\n'


@pytest.fixture
def told(tmp_path, capsys):
    """Words of the command on a case that it refuses; nothing is written."""

    def refused(text: str) -> str:
        path = tmp_path / "case.toml"
        path.write_text(text, encoding="utf-8")
        assert main(["film", str(path), "-o", str(tmp_path / "run")]) == 2
        assert [item.name for item in tmp_path.iterdir()] == ["case.toml"]
        return capsys.readouterr().err

    return refused


@pytest.mark.parametrize("cells", ["[1, 1]", "[1, 64]"])
def test_a_mesh_without_a_point_inside_is_refused(told, cells):
    faults = told(CASE.replace("[16, 2]", cells))
    assert "none is left to solve for" in faults
    assert "at least 2 cells" in faults


@pytest.mark.parametrize("cells", ["[2, 1]", "[4, 1]"])
def test_a_mesh_that_hardly_sees_the_film_is_told(tmp_path, cells):
    (tmp_path / "case.toml").write_text(CASE.replace("[16, 2]", cells), encoding="utf-8")
    warned = film_summary(solve_case(load_case(tmp_path / "case.toml")))["warnings"]
    assert any(warning.startswith("coarse_mesh: pressure is solved at only") for warning in map(told_of, warned))


def told_of(warning) -> str:
    return warning if isinstance(warning, str) else f"{warning['name']}: {warning['text']}"


def test_a_missing_file_is_told_the_nearest(told, tmp_path):
    mesh = CASE.split("mesh = ")[1].splitlines()[0]
    faults = told(CASE.replace(mesh, '"caes.toml"'))
    assert "which is no file" in faults
    assert str(tmp_path / "case.toml") in faults


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        ('"30 mPa s"', '"30,5 mPa s"', "30.5 mPa s"),
        ('["1 m/s"', '["1,250 m/s"', "1.250 m/s or 1250 m/s"),
        ("format = 1", "format = 1,5", "1.5"),
    ],
)
def test_a_decimal_comma_is_told(told, old, new, hint):
    assert f"try:      {hint}\n" in told(CASE.replace(old, new))


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        (CASE + ROUGH, "roughness.moving (line 11)", ["two smooth walls", "no table [roughness]"]),
        (CASE + ROUGH + 'composite = "1 um"\n', "roughness.moving (line 11)", ["beside composite"]),
        (FULL + OIL + WALLS, "film.order (line 7)", ["2 with a table [thermal]", "order = 1"]),
        (
            CASE + OIL + WALLS.replace("{ temp", '{ heat_transfer_coefficient = "5 W/(m2 K)", temp'),
            "thermal.moving_wall.heat_transfer_coefficient (line 18)",
            ["beside temperature = '40 degC'", "a table with temperature; or"],
        ),
        (CASE + OIL.replace("0.03", "0") + WALLS, "oil.temperature_coefficient (line 15)", ["more than 0"]),
        (CASE + DISC + STEEL, "elastic.fixed (line 10)", ["have no face under them", "under the whole film"]),
        (CASE + DISC + STEEL.replace("210", "0"), "elastic.fixed.youngs_modulus", ["more than 0 GPa"]),
        (CASE + NOTHING_THERE, 'study."film.velocity[7]"', ["entry 7 of film.velocity", "from 0 to 1"]),
    ],
)  # fmt: skip
def test_a_contradiction_is_told_at_its_key_and_once(told, text, place, words):
    message = told(text)
    assert place in message
    paths = [line for line in message.splitlines()[1:] if not line.startswith("    ")]
    assert len(paths) == len(set(paths))
    for word in words:
        assert word in message


def test_a_temperature_beyond_the_oils_law_is_told_once(told):
    oil = '[oil]\ngrade = "ISO VG 46"\ndensity = "860 kg/m3"\ntemperature = "400 degC"\n'
    message = told(CASE.replace('viscosity = "30 mPa s"\n', "") + oil)
    assert "oil.temperature (line 12)" in message
    assert message.count("expected") == 1


def test_a_byte_order_mark_is_no_fault(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("\ufeff" + CASE, encoding="utf-8")
    assert load_case(path).problem is not None


def summary_of(path: Path, text: str) -> dict:
    path.write_text(text, encoding="utf-8")
    summary = film_summary(solve_case(load_case(path)))
    json.dumps(summary, allow_nan=False)
    return summary


def test_a_film_that_bears_round_off_has_no_friction_coefficient(tmp_path):
    """Parallel walls bear nothing: a friction of mu U A/h over a load of round-off is no number."""
    flat = CASE.replace("1e-5*(2 - x/0.01)", "12.4624723244e-6").replace("[16, 2]", "[24, 12]")
    summary = summary_of(tmp_path / "case.toml", flat)
    assert summary["friction_coefficient"] is None
    assert summary["hersey_number_m"] is None
    assert summary["friction_force_moving_N"][0] == pytest.approx(-0.03 * 1e-5 / 12.4624723244e-6)


def test_the_warning_of_a_film_pulled_below_cavitation_names_the_law_that_conserves_mass(tmp_path):
    diverging = CASE.replace("2 - x", "1 + x").replace("viscosity", 'cavitation = "none"\nviscosity', 1)
    warnings = {warning["name"]: warning["text"] for warning in summary_of(tmp_path / "c.toml", diverging)["warnings"]}
    assert "'jfo'" in warnings["pressure_below_cavitation"]


def test_a_pressure_that_no_oil_bears_is_told_with_limit_and_remedy(tmp_path):
    thin = CASE.replace("1e-5*(2 - x/0.01)", "2e-8*(2 - x/0.01)")
    warnings = {warning["name"]: warning["text"] for warning in summary_of(tmp_path / "c.toml", thin)["warnings"]}
    assert "(limit 1000 MPa," in warnings["film_pressure_beyond_oil"]
    assert "; check the units" in warnings["film_pressure_beyond_oil"]
    assert "viscosity_without_pressure" not in warnings


def test_an_edge_of_two_names_tells_its_flow_once(tmp_path):
    """A square pressed at 1 mm/s lets 1 mm/s x its area out through its one open edge, by the name stated."""
    points = np.array([[x, y, 0.0] for x in (0.0, 0.005, 0.01) for y in (0.0, 0.01)])
    cells = [[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]]
    mesh = meshio.Mesh(
        points,
        [("line", [[0, 1]]), ("triangle", cells)],
        cell_data={key: [np.array([1]), np.full(4, 2)] for key in ("gmsh:physical", "gmsh:geometrical")},
        field_data={"mouth": np.array([1, 1]), "pad": np.array([2, 2])},
    )
    meshio.write(tmp_path / "pad.msh", mesh, file_format="gmsh22", binary=False)
    case = CASE[: CASE.index("mesh")] + (
        'mesh = "pad.msh"\nthickness = "10 um"\nviscosity = "30 mPa s"\nsqueeze = "-1 mm/s"\n'
        '[boundary]\nmouth = { pressure = "0 bar" }\n'
    )
    flow = summary_of(tmp_path / "case.toml", case)["flow_m3_per_s"]
    assert flow["mouth"] == pytest.approx(1e-7)
    assert flow["right"] == 0.0
    assert not {"left", "outer"} & set(flow)


def named(summary: dict) -> set[str]:
    return {warning["name"] for warning in summary["warnings"]}


def test_a_film_whose_inlet_is_closed_is_told_to_run_dry(tmp_path):
    closed = CASE.replace('left = { pressure = "0 bar" }\n', "")
    summary = summary_of(tmp_path / "case.toml", closed)
    assert "film_runs_dry" in named(summary)
    assert str(summary["moment_y_Nm"]) == "0.0"
    assert "film_runs_dry" not in named(summary_of(tmp_path / "fed.toml", CASE))


def test_a_journal_without_supply_is_told_that_its_load_is_the_meshs(tmp_path):
    journal = CASE.replace("cells = [16, 2]", 'cells = [32, 4], periodic = "x"')
    journal = journal.replace("1e-5*(2 - x/0.01)", "1e-5*(2 + cos(2*pi*x/0.01))")
    journal = journal.replace("left", "bottom").replace("right", "top")
    assert "film_without_supply" in named(summary_of(tmp_path / "case.toml", journal))
    for remedy in ('cavitation_pressure = "-0.7 bar"', 'cavitation = "reynolds"'):
        mended = journal.replace("viscosity", f"{remedy}\nviscosity", 1)
        assert "film_without_supply" not in named(summary_of(tmp_path / "mended.toml", mended))
    fed = journal.replace('top = { pressure = "0 bar" }', 'top = { pressure = "1 bar" }')
    assert "film_without_supply" not in named(summary_of(tmp_path / "fed.toml", fed))


def test_a_wedge_the_wrong_way_round_is_told(tmp_path):
    opening = CASE.replace('"1 m/s"', '"-1 m/s"')
    assert "film_builds_no_pressure" in named(summary_of(tmp_path / "case.toml", opening))
    assert not named(summary_of(tmp_path / "closing.toml", CASE)) & {"film_builds_no_pressure", "film_without_supply"}
    apart = CASE.replace('velocity = ["1 m/s", "0 m/s"]', 'squeeze = "10 mm/s"\ncavitation_pressure = "-0.9 bar"')
    (text,) = (
        one["text"]
        for one in summary_of(tmp_path / "apart.toml", apart)["warnings"]
        if one["name"] == "film_builds_no_pressure"
    )
    assert "is the sign of squeeze right?" in text
    assert "velocity" not in text


def test_a_cavity_below_vacuum_is_told(tmp_path):
    deep = CASE.replace("viscosity", 'cavitation_pressure = "-1.1 bar"\nviscosity', 1)
    assert "cavitation_below_vacuum" in named(summary_of(tmp_path / "case.toml", deep))
    vacuum = deep.replace("-1.1 bar", "-1.01 bar")
    assert "cavitation_below_vacuum" not in named(summary_of(tmp_path / "vacuum.toml", vacuum))


def test_the_table_of_fields_has_a_unit_in_every_head(tmp_path):
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    assert main(["film", str(tmp_path / "case.toml"), "-o", str(tmp_path / "run"), "--csv"]) == 0
    heads = (tmp_path / "run" / "fields.csv").read_text("utf-8").splitlines()[0].split(",")
    assert {"x [mm]", "y [mm]", "film_pressure [MPa]", "film_thickness [um]", "film_fraction [1]"} == set(heads)


@pytest.mark.parametrize(
    ("text", "key"),
    [
        (
            CASE.replace('left = { pressure = "0 bar"', 'left = { pressure = "0 bar", temperature = "90 degC"'),
            "boundary.left",
        ),
        (
            CASE + '[oil]\ntemperature = "40 degC"\ntemperature_coefficient = "0.03 1/K"\n',
            "oil.temperature_coefficient",
        ),
        (CASE + '[oil]\nspecific_heat = "2000 J/(kg K)"\n', "oil.specific_heat"),
        (CASE + '[oil]\nthermal_conductivity = "0.13 W/(m K)"\n', "oil.thermal_conductivity"),
        (CASE + '[oil]\nthermal_expansion = "7e-4 1/K"\n', "oil.thermal_expansion"),
    ],
)
def test_a_key_that_only_a_solved_temperature_uses_is_told_without_thermal(told, text, key):
    message = told(text)
    assert key in message
    assert "without a table [thermal]" in message
    assert message.count("found:") == 1
