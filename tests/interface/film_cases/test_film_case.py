"""Film case files: what they mean, that they round-trip, and every fault they can hold."""

from pathlib import Path

import meshio
import numpy as np
import pytest
from bench_pump import BENCH

from reynolds import Cavitation
from swashfilm.__main__ import main
from swashfilm.case.file import FilmCase, load_case
from swashfilm.case.gap.instant import GapCase
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system import InputFaults

MESH = '{ kind = "rectangle", size = ["10 mm", "10 mm"], cells = [8, 4] }'
GOOD = f"""
format = 1
[film]
mesh = {MESH}
thickness = "10 um"
viscosity = "30 mPa s"
[boundary]
left = {{ pressure = "1 bar" }}
"""


@pytest.fixture
def write(tmp_path):
    def written(text: str, name: str = "case.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return written


def faults_of(path: Path) -> InputFaults:
    with pytest.raises(InputFaults) as refused:
        load_case(path)
    return refused.value


def test_what_a_case_leaves_out_is_filled_in_and_told(write):
    case = load_case(write(GOOD))
    assert isinstance(case, FilmCase)
    assert case.problem.cavitation is Cavitation.JFO
    assert case.problem.film.thickness.item() == 1e-5
    for line in ('cavitation = "jfo"', 'squeeze = "0 m/s"', "order = 1", 'periodic = "none"'):
        assert line in case.resolved


def test_a_resolved_case_is_the_same_case(write):
    for number, text in enumerate(
        [
            GOOD,
            GOOD.replace('"10 um"', '"1e-5*(2-x/0.01)"').replace("[8, 4]", '[8, 4], periodic = "y"'),
            GOOD.replace('viscosity = "30 mPa s"', 'cavitation = "none"\norder = 2\nviscosity = "0.03 + y"'),
        ]
    ):  # fmt: skip
        first = load_case(write(text))
        again = load_case(write(first.resolved, f"again{number}.toml"))
        assert again.resolved == first.resolved
        for one, two in zip(vars(first.problem.film).values(), vars(again.problem.film).values(), strict=True):
            np.testing.assert_array_equal(one, two)


def test_an_oil_gives_the_viscosity_of_its_grade_at_its_temperature(write):
    oil = '[oil]\ngrade = "ISO VG 46"\ndensity = "860 kg/m3"\ntemperature = "50 degC"\n'
    case = load_case(write(GOOD.replace('viscosity = "30 mPa s"\n', "") + oil))
    assert case.problem.film.viscosity.item() == pytest.approx(25.8e-3, rel=2e-3)  # REF90


def test_data_of_a_mesh_file_are_fields_by_name(write, tmp_path):
    points = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]]) * 1e-3
    meshio.write_points_cells(
        tmp_path / "two.vtu",
        np.column_stack([points, np.zeros(6)]),
        [("quad", np.array([[0, 1, 4, 3], [1, 2, 5, 4]]))],
        point_data={"mu": np.linspace(0.01, 0.06, 6)},
        cell_data={"h": [np.array([1e-5, 2e-5])]},
    )
    text = GOOD.replace(MESH, '"two.vtu"')
    case = load_case(write(text.replace('"10 um"', '"h"').replace('"30 mPa s"', '"mu"')))
    np.testing.assert_array_equal(case.problem.film.thickness, [[1e-5], [2e-5]])
    assert case.problem.film.viscosity.mean() == pytest.approx(0.035)
    assert faults_of(write(text.replace('"10 um"', '"hh"'))).faults[0].nearest == "h"


def test_a_mesh_file_with_loose_points_is_refused(write, tmp_path):
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 0]]) * 1e-3
    meshio.write_points_cells(tmp_path / "loose.vtu", points, [("triangle", np.array([[0, 1, 2]]))])
    faults = faults_of(write(GOOD.replace(MESH, '"loose.vtu"')))
    assert "1 points in no cell" in str(faults)


def test_data_that_end_at_zero_in_a_point_are_no_film(write, tmp_path):
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) * 1e-3
    ends = {"h": np.array([1e-5, 0.0, 0.0, 1e-5])}
    meshio.write_points_cells(tmp_path / "one.vtu", points, [("quad", np.array([[0, 1, 2, 3]]))], point_data=ends)
    faults = faults_of(write(GOOD.replace(MESH, '"one.vtu"').replace('"10 um"', '"h"')))
    assert "'h' is 0 at x = 0.001 m" in str(faults)


def test_a_step_within_cells_keeps_its_least_film(write):
    formula = "where(x < 0.0047, 30e-6, 1e-6)"
    summary = film_summary(solve_case(load_case(write(GOOD.replace("10 um", formula)))))
    assert summary["film_thickness_min_m"] == 1e-6


def test_a_piece_of_film_without_a_pressure_is_a_fault(write, tmp_path):
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) * 1e-3
    both = np.vstack([points, points + np.array([2e-3, 0.0, 0.0])])
    meshio.write_points_cells(tmp_path / "two.vtu", both, [("quad", np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))])
    faults = faults_of(write(GOOD.replace(MESH, '"two.vtu"')))
    assert "1 of 2 separate pieces" in str(faults)


def test_an_edge_of_two_names_has_one_pressure(write, tmp_path):
    points = np.array([[x, y, 0] for y in range(3) for x in range(3)]) * 1e-3
    quads = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    meshio.write_points_cells(tmp_path / "four.vtu", points, [("quad", quads)])
    text = GOOD.replace(MESH, '"four.vtu"')
    assert isinstance(load_case(write(text + 'outer = { pressure = "1 bar" }')), FilmCase)
    faults = faults_of(write(text + 'outer = { pressure = "2 bar" }'))
    assert "shares edges with left" in str(faults)


@pytest.mark.parametrize(
    ("old", "new", "path", "words"),
    [
        ("format = 1", "", "format", ["format = 1"]),
        ("format = 1", "format = 2", "format", ["2", "format = 1"]),
        ("[film]", "[flim]", "film", ["missing"]),
        ("thickness", "thikness", "film.thikness", ["unknown key", "thickness"]),
        ('thickness = "10 um"', "", "film.thickness", ["missing", "or a formula"]),
        ('"10 um"', "1e-5", "film.thickness", ["1e-05", "with its unit", '"1e-05 m"']),
        ('"10 um"', '"10 bar"', "film.thickness", ["not a length"]),
        ('"10 um"', '"10 umm"', "film.thickness", ["not known"]),
        ('"10 um"', '"-10 um"', "film.thickness", ["above zero", "x ="]),
        ('"10 um"', '"1e-5*(x-0.005)"', "film.thickness", ["-5e-08 at x = 0 m", "above zero"]),
        ('"10 um"', '"1e-3*x"', "film.thickness", ["is 0 at x = 0 m"]),
        ('"10 um"', '"1e-7/x"', "film.thickness", ["is inf at x = 0 m"]),
        ('"10 um"', '"1e-5*sine(x)"', "film.thickness", ["unknown function sine", "column"]),
        ('"10 um"', '"1e-5*(2-x"', "film.thickness", ["syntax error", "column"]),
        ('"10 um"', '"gap"', "film.thickness", ["unknown name gap", "has none"]),
        ('"30 mPa s"', '"30 mm"', "film.viscosity", ["not a dynamic viscosity"]),
        ('"30 mPa s"', '"0 Pa s"', "film.viscosity", ["above zero"]),
        ('viscosity = "30 mPa s"', "", "film.viscosity", ["[oil]"]),
        ("[boundary]", 'velocity = "1 m/s"\n[boundary]', "film.velocity", ["a list of 2 (of the moving"]),
        ("[boundary]", 'velocity = ["1 m", "0 m/s"]\n[boundary]', "film.velocity[0]", ["not a velocity"]),
        ("[boundary]", 'velocity_fixed = ["1 m", "0 m/s"]\n[boundary]', "film.velocity_fixed[0]", ["a velocity"]),
        ("[boundary]", 'cavitation = "reynold"\n[boundary]', "film.cavitation", ["reynolds"]),
        ("[boundary]", "order = 2\n[boundary]", "film.order", ["full films", "default"]),
        ("[boundary]", "order = 3\n[boundary]", "film.order", ["at most 2", "linear or quadratic"]),
        (
            "[boundary]", 'cavitation_pressure = "2 bar"\n[boundary]', "boundary.left.pressure",
            ["cavitation pressure", "200 kPa"],
        ),
        ("left =", "lefd =", "boundary.lefd", ["not a boundary of this mesh", "bottom, left, right, top", "left"]),
        ('left = { pressure = "1 bar" }', "", "boundary", ["no pressure at any boundary", "left"]),
        ('{ pressure = "1 bar" }', '"1 bar"', "boundary.left", ["a table"]),
        ("pressure = ", "presure = ", "boundary.left.presure", ["unknown key", "pressure"]),
        ('"1 bar" }', '"1 bar", film_fraction = 0.5 }', "boundary.left.pressure", ["100 kPa", "full film"]),
        ('"1 bar" }', '"1 bar", film_fraction = 0 }', "boundary.left.film_fraction", ["more than 0"]),
        ('"1 bar" }', '"1 bar", film_fraction = 1.1 }', "boundary.left.film_fraction", ["at most 1"]),
        (
            "[boundary]", "cavitation = 'reynolds'\n[boundary]\nright = { film_fraction = 0.5 }",
            "boundary.right.film_fraction", ["0.5 with cavitation = 'reynolds'", "'jfo'"],
        ),
        ("cells = [8, 4]", "cells = [8, 0]", "film.mesh.cells[1]", ["0", "at least 1"]),
        ("cells = [8, 4]", "cells = [8.5, 4]", "film.mesh.cells[0]", ["a whole number"]),
        ("cells = [8, 4]", "cells = [100000, 100000]", "film.mesh.cells", ["at most"]),
        ("cells = [8, 4]", 'cells = [8, 4], cell = "triangel"', "film.mesh.cell", ["triangle"]),
        ("cells = [8, 4]", 'cells = [8, 4], periodic = "x"', "boundary.left", ["periodic seam"]),
        ('"rectangle"', '"rectangel"', "film.mesh.kind", ["rectangle"]),
        ('["10 mm", "10 mm"]', '["10 mm", "-10 mm"]', "film.mesh.size[1]", ["-10 mm", "more than 0"]),
        ('["10 mm", "10 mm"]', '["10 mm"]', "film.mesh.size", ["along x and y"]),
        (MESH, '"no.vtu"', "film.mesh", ["no file", "no.vtu"]),
        ("[boundary]", "[study]\n[boundary]", "study", ["a single case"]),
        ('viscosity = "30 mPa s"', '[oil]\ngrade = "ISO VG 45"', "oil.grade", ["ISO VG 46"]),
        ('viscosity = "30 mPa s"', '[oil]\ngrade = "ISO VG 46"', "oil.density", ["a density"]),
        (
            'viscosity = "30 mPa s"',
            '[oil]\ngrade = "ISO VG 46"\ndensity = "860 kg/m3"\ntemperature = "300 degC"',
            "oil.temperature", ["Walther"],
        ),
    ],
)  # fmt: skip
def test_a_fault_says_where_what_and_what_instead(write, old, new, path, words):
    assert old in GOOD
    faults = faults_of(write(GOOD.replace(old, new)))
    told = [fault for fault in faults.faults if fault.path == path]
    assert told, str(faults)
    for word in words:
        assert word in f"{told[0].found} {told[0].expected} {told[0].nearest}", str(faults)


def test_all_faults_come_at_once_with_their_lines(write):
    text = GOOD.replace("10 um", "10 bar").replace("30 mPa s", "1/(").replace("left", "lefd")
    faults = faults_of(write(text))
    assert {fault.path for fault in faults.faults} == {"film.thickness", "film.viscosity", "boundary.lefd"}
    assert "film.thickness (line 5)" in str(faults)
    assert "boundary.lefd (line 8)" in str(faults)


def test_a_file_that_is_no_case_says_so(write, tmp_path):
    (tmp_path / "folder.toml").mkdir()
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe\x00")
    write(GOOD)
    assert faults_of(tmp_path / "cace.toml").faults[0].nearest.endswith("case.toml")
    assert "line 2" in str(faults_of(write("format = 1\n[film\n", "broken.toml")))
    for name in ("folder.toml", "bytes.toml"):
        assert "cannot be read" in str(faults_of(tmp_path / name))


GAP = """
format = 1
[film]
gap = "slipper"
pump = "ref90"
shaft_angle = "270 deg"
[position]
film_thickness = "10 um"
"""


@pytest.mark.parametrize(
    ("gap", "tail"),
    [
        ("slipper", ""),
        ("slipper", '[load]\nforce = "5 kN"\nmoment_x = "1 N m"\n'),
        ("slipper", '[position]\nfilm_thickness = "9 um"\nslope_x = "0.01 deg"\n'),
        ("piston", '[position]\neccentricity_inner = ["3 um", "1 um"]\neccentricity_case = ["-3 um", "0 um"]\n'),
        ("piston", '[load]\nforce = ["1 kN", "0 N"]\narm = "20 mm"\n[operating]\ntemperature = "70 degC"\n'),
        ("valve_plate", '[position]\nfilm_thickness = "14 um"\nslope_y = "0.01 deg"\n'),
        ("valve_plate", '[load]\nforce = "50 kN"\nmoment_y = "20 N m"\n[physics]\nsurfaces = "smooth"\n'),
    ],
)  # fmt: skip
def test_a_resolved_gap_case_is_the_same_case(write, gap, tail):
    text = GAP.partition("[position]")[0].replace("slipper", gap) + tail
    first = load_case(write(text))
    assert isinstance(first, GapCase)
    again = load_case(write(first.resolved, "again.toml"))
    assert again.resolved == first.resolved
    np.testing.assert_array_equal(again.chamber_pressure, first.chamber_pressure)
    assert (again.load, again.physics) == (first.load, first.physics)
    np.testing.assert_array_equal(again.position, first.position)


def test_gap_and_pump_may_stand_on_top(write):
    text = GAP.replace("[film]\n", "")
    assert load_case(write(text)).resolved == load_case(write(GAP, "b.toml")).resolved


@pytest.mark.parametrize(
    ("old", "new", "path", "words"),
    [
        ('"slipper"', '"sliper"', "film.gap", ["slipper"]),
        ('"ref90"', '"ref9"', "film.pump", ["ref90"]),
        ('pump = "ref90"', "", "film.pump", ["missing", "ref90"]),
        ('"270 deg"', '"270"', "film.shaft_angle", ["unit"]),
        ("[position]", "[load]\nforce = '1 N'\n[position]", "load", ["one of the two"]),
        ('film_thickness = "10 um"', "", "position.film_thickness", ["missing"]),
        ('"10 um"', '"-10 um"', "position.film_thickness", ["more than 0"]),
        ('"10 um"', '"10 um"\nslope_x = "10 deg"', "position", ["do not touch"]),
        ("[position]", "[operating]\nspeed = '2100'\n[position]", "operating.speed", ["unit"]),
        ("[position]", "[operating]\nsped = '2100 rpm'\n[position]", "operating.sped", ["unknown key", "speed"]),
        ("[position]", "chamber_pressure = ['1 bar', '2 bar']\n[position]", "film.chamber_pressure", ["2 press"]),
        ("[position]", "thickness = '1 um'\n[position]", "film.thickness", ["unknown key"]),
        ("[position]", "[physics]\nheat = 'solved'\n[position]", "physics.heat", ["whole turn"]),
        ("[position]", "[physics]\nwalls = 'soft'\n[position]", "physics.walls", ["elastic"]),
    ],
)  # fmt: skip
def test_a_fault_of_a_gap_case_says_where(write, old, new, path, words):
    assert old in GAP
    faults = faults_of(write(GAP.replace(old, new)))
    told = [fault for fault in faults.faults if fault.path == path]
    assert told, str(faults)
    for word in words:
        assert word in f"{told[0].found} {told[0].expected} {told[0].nearest}", str(faults)


@pytest.mark.parametrize(
    ("gap", "position"),
    [
        ("piston", "eccentricity_ratio = 1.0"),
        ("piston", 'eccentricity_inner = ["0 um", "-30 um"]\neccentricity_case = ["0 um", "0 um"]'),
        ("slipper", 'film_thickness = "10 um"\nslope_y = "0.000715 rad"'),  # 14 mm: 10.01 um
        ("valve_plate", 'film_thickness = "8 um"\nslope_x = "-0.000176 rad"'),  # 45.7 mm: 8.04 um
    ],
)
def test_parts_that_touch_between_the_points_of_the_mesh_do_touch(write, gap, position):
    text = GAP.partition("[position]")[0].replace("slipper", gap) + "[position]\n" + position
    assert "do not touch" in str(faults_of(write(text)))


def test_a_gap_case_tells_all_its_faults_at_once(write):
    text = GAP.replace('"10 um"', '"10"').replace('"270 deg"', '"270"').replace("[position]", "speed = 3\n[position]")
    text += 'slope = "1 deg"\n[operating]\nspeed = "2100"\n'
    assert {fault.path for fault in faults_of(write(text)).faults} == {
        "operating.speed", "film.shaft_angle", "film.speed", "position.film_thickness", "position.slope",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("gap", "pressure"), [("piston", "'-2 bar'"), ("slipper", "'-1.01 bar'"), ("valve_plate", str(["-2 bar"] * 9))]
)
def test_a_chamber_below_the_pressure_of_a_cavity_is_a_fault(write, gap, pressure):
    text = GAP.partition("[position]")[0].replace("slipper", gap) + f"chamber_pressure = {pressure}\n"
    (fault,) = faults_of(write(text)).faults
    assert fault.path == "film.chamber_pressure"


def test_a_pump_file_stands_beside_the_case(write):
    from importlib.resources import files

    ref90 = files("system.description").joinpath("pumps", "ref90.toml").read_text("utf-8")
    write(ref90.replace("0.9 mm", "1.1 mm"), "my.toml")
    case = load_case(write(GAP.replace('"ref90"', '"my.toml"')))
    assert case.rotor.pump.slipper.orifice_diameter == 1.1e-3


def test_a_parallel_slipper_leaks_what_orifice_and_land_let_through(write):
    """Paper Eq. (16): capillary and land in series; the mesh has the area of its circles."""
    case = load_case(write(GAP.replace('"ref90"', f'"{BENCH}"')))
    summary = film_summary(solve_case(case))
    pump, point = case.rotor.pump, case.rotor.point
    radii = np.log(pump.slipper.land_outer_radius / pump.slipper.land_inner_radius)
    land = np.pi * (10e-6) ** 3 / (6 * point.viscosity * radii)
    orifice = np.pi * pump.slipper.orifice_diameter**4 / (128 * point.viscosity * pump.slipper.orifice_length)
    drop = point.delivery_pressure - point.case_pressure
    expected = drop * land * orifice / (land + orifice)
    assert summary["flow_m3_per_s"]["case"] == pytest.approx(expected, rel=2e-3)
    assert summary["position_source"] == "given"


REST = f'format = 1\n[film]\ngap = "slipper"\npump = "{BENCH}"\nshaft_angle = "270 deg"\nchamber_pressure = "50 bar"\n'


def test_a_stated_load_that_nothing_bears_is_no_number(tmp_path, capsys):
    """Smooth walls; rough ones bear what the film does not."""
    case = tmp_path / "slipper.toml"
    case.write_text(REST + '[load]\nforce = "13000 N"\n[physics]\nsurfaces = "smooth"\n')
    assert main(["film", str(case), "-o", str(tmp_path / "run")]) == 3
    said = capsys.readouterr().err
    assert "no rest" in said
    assert "Try: a load below" in said
    assert not (tmp_path / "run").exists()


def test_a_load_comes_to_rest_on_film_or_contact(write):
    floats = film_summary(solve_case(load_case(write(REST + '[load]\nforce = "1820 N"\n'))))
    assert (floats["position_source"], floats["held_by"]) == ("rest", "lift")
    assert floats["carried_load_N"] == pytest.approx(1820.0, rel=1e-6)
    lifted = film_summary(solve_case(load_case(write(REST + '[load]\nforce = "1500 N"\n'))))
    assert lifted["held_by"] == "retainer"
    assert lifted["carried_load_N"] > 1500.0
    touches = film_summary(solve_case(load_case(write(REST + '[load]\nforce = "3 kN"\n'))))
    assert touches["held_by"] == "contact"
    assert touches["contact_load_N"] > 0.3 * 3000.0
    assert touches["carried_load_N"] == pytest.approx(3000.0, rel=1e-6)


def test_the_block_comes_to_rest_under_its_load(write):
    """Lands between one pressure hold 15.5 kN however thin the film: the rest of the load is the asperities'."""
    text = REST.replace("slipper", "valve_plate").replace('"50 bar"', str(["50 bar"] * 9))
    text += '[operating]\npressure = "50.01 bar"\ninlet_pressure = "50 bar"\n[load]\nforce = "17 kN"\n'
    found = film_summary(solve_case(load_case(write(text))))
    assert found["position_source"] == "rest"
    assert found["carried_load_N"] == pytest.approx(17e3, rel=1e-6)
    assert found["contact_load_N"] == pytest.approx(1.5e3, rel=0.1)
