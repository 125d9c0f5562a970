"""Faults of a film case and its mesh say where, what and how, all at once."""

import meshio
import numpy as np
import pytest

from swashfilm.__main__ import main
from swashfilm.case.file import load_case
from system import InputFaults

CASE = """
format = 1
[film]
mesh = MESH
thickness = "10 um"
viscosity = "30 mPa s"
[boundary]
outer = { pressure = "0 bar" }
"""
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) * 1e-2
BUILT = '{ kind = "rectangle", size = ["10 mm", "10 mm"], cells = [4, 4] }'


def fault_of(folder, mesh='"film.vtu"', thickness="10 um"):
    text = CASE.replace("MESH", mesh).replace("10 um", thickness)
    (folder / "case.toml").write_text(text.replace("outer =", "left =") if "kind" in mesh else text, "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_case(folder / "case.toml")
    (fault,) = raised.value.faults
    return fault


def test_a_piece_without_a_pressure_has_a_place_and_names(tmp_path):
    points = np.concatenate([2.0 * SQUARE, SQUARE + np.array([0.05, 0.0, 0.0])])
    meshio.write_points_cells(tmp_path / "film.vtu", points, [("quad", np.arange(8).reshape(2, 4))])
    fault = fault_of(tmp_path)
    assert fault.found.endswith("in 1 of 2 separate pieces of the film, the first about x = 0.055 m, y = 0.005 m")
    assert fault.expected == "a boundary with a pressure at each piece, here bottom or inner or right"


@pytest.mark.parametrize(
    ("turn", "told"),
    [
        (lambda p: p[:, [2, 0, 1]], "lies in a plane of constant x"),
        (lambda p: p[:, [0, 2, 1]], "lies in a plane of constant y"),
        (lambda p: p + 0.3 * p[:, [2, 2, 0]], "lies in a tilted plane"),
        (lambda p: p + np.array([[0, 0, 0], [0, 0, 0], [0, 0, 1e-3], [0, 0, 0]]), "is not plane (z varies)"),
    ],
)
def test_a_mesh_in_another_plane_is_told_by_its_plane(tmp_path, turn, told):
    meshio.write_points_cells(tmp_path / "film.vtu", turn(SQUARE), [("quad", np.array([[0, 1, 2, 3]]))])
    assert told in fault_of(tmp_path).found


def test_curved_cells_are_told_the_order_of_gmsh(tmp_path):
    points = np.concatenate([SQUARE[:3], 0.5 * (SQUARE[:3] + SQUARE[[1, 2, 0]])])
    meshio.write_points_cells(tmp_path / "film.vtu", points, [("triangle6", np.array([[0, 1, 2, 3, 4, 5]]))])
    assert "Mesh.ElementOrder = 1" in fault_of(tmp_path).expected


@pytest.mark.parametrize(
    ("formula", "found"),
    [
        ("10e-6^2", "^ at column 6"),
        ("(1e-5) ^ (2)", "^ at column 8"),
        ("10 um*(2-x/10 mm)", "a formula with the unit um"),
        ("(2 - x/10 mm)*1e-5", "a formula with the unit mm"),
        ("x*10 um", "a formula with the unit um"),
        ("10 umm", "a unit that is not known"),
    ],
)
def test_formulas_are_told_by_column_and_without_units(tmp_path, formula, found):
    fault = fault_of(tmp_path, BUILT, formula)
    assert found in fault.found
    assert ("a formula in SI without units" in fault.expected) is ("a formula with" in found)


def test_all_options_of_other_kinds_of_cases_are_told_at_once(tmp_path, capsys):
    (tmp_path / "case.toml").write_text(CASE.replace("MESH", BUILT).replace("outer", "left"), "utf-8")
    assert main(["film", str(tmp_path / "case.toml"), "--animate", "--rigid", "--resume", "nowhere"]) == 2
    told = capsys.readouterr().err
    for option in ("--animate", "--rigid", "--resume"):
        assert f"  {option}\n" in told


def test_check_sets_keys_as_the_commands_do(tmp_path, capsys):
    (tmp_path / "case.toml").write_text(CASE.replace("MESH", BUILT).replace("outer", "left"), "utf-8")
    assert main(["check", str(tmp_path / "case.toml"), "--set", "film.thickness=12um"]) == 0
    assert 'thickness = "12 um"' in capsys.readouterr().out
    assert main(["check", str(tmp_path / "case.toml"), "--set", "film.thickness=12 bar"]) == 2
    assert main(["check", "ref90", "--set", "piston.radial_clearance=13um"]) == 0
    assert 'radial_clearance = "13 um"' in capsys.readouterr().out


def test_data_of_a_mesh_file_that_are_no_thickness_are_named(tmp_path):
    """A vector, and a formula of data: both are in the file, so that they are no unknown names."""
    heights = {"h": np.full(4, 1e-5), "slope": np.ones((4, 3))}
    meshio.write_points_cells(tmp_path / "film.vtu", SQUARE, [("quad", np.arange(4)[None])], point_data=heights)
    vector = fault_of(tmp_path, thickness="slope")
    assert vector.found == "'slope', data of the mesh file that are not one number a point or cell"
    formula = fault_of(tmp_path, thickness="1.1*h")
    assert formula.found == "'1.1*h', a formula of h, which is data of the mesh file"
    assert formula.nearest == "h"


def test_a_number_without_unit_gets_the_unit_that_people_read(tmp_path):
    text = CASE.replace("MESH", BUILT).replace('"30 mPa s"', "30").replace("outer =", "left =")
    (tmp_path / "case.toml").write_text(text, "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_case(tmp_path / "case.toml")
    (fault,) = raised.value.faults
    assert fault.nearest == '"30 mPa s"'


@pytest.mark.parametrize(("at_40", "at_100"), [("0.66 mm2/s", "0.29 mm2/s"), ("6.8 mm2/s", "46 mm2/s")])
def test_a_viscosity_that_is_no_oil_is_told_at_its_key(tmp_path, at_40, at_100):
    oil = f'[oil]\nkinematic_viscosity_40C = "{at_40}"\nkinematic_viscosity_100C = "{at_100}"\n'
    oil += 'density = "860 kg/m3"\ntemperature = "40 degC"\n'
    text = CASE.replace("MESH", BUILT).replace('viscosity = "30 mPa s"\n', "").replace("outer =", "left =")
    (tmp_path / "case.toml").write_text(text + oil, "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_case(tmp_path / "case.toml")
    (fault,) = raised.value.faults
    assert fault.path == "oil.kinematic_viscosity_100C"
    assert fault.found == at_100
