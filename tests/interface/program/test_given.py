"""Cases of Python values: numbers in SI, paths from the working directory, and faults in terms of the case."""

import copy
import tomllib
from pathlib import Path

import meshio
import numpy as np
import pytest
from slider_case import slider_case

import swashfilm as sf
from swashfilm.api.tables import tables_of_file

SLIDER = {
    "format": 1,
    "film": {
        "mesh": {"kind": "rectangle", "size": [0.01, 0.001], "cells": (16, 2), "periodic": "y"},
        "thickness": "1e-5*(2 - x/0.01)",
        "velocity": [1.0, 0],
        "viscosity": 0.03,
    },
    "boundary": {"left": {"pressure": 0.0}, "right": {"pressure": "0 bar"}},
}
IN_UNITS = slider_case('"10 mm", "1 mm"', "16, 2")


def changed(**film) -> dict:
    found = copy.deepcopy(SLIDER)
    found["film"].update(film)
    return found


def faults_of(case) -> sf.InputFaults:
    with pytest.raises(sf.InputFaults) as raised:
        sf.film(case)
    return raised.value


def test_numbers_of_a_dict_are_in_si():
    expected = sf.film(IN_UNITS).load
    assert sf.film(SLIDER).load == expected
    numpy = changed(viscosity=np.float64(0.03), velocity=np.array([1.0, 0.0]))
    assert sf.film(numpy).load == expected


@pytest.mark.parametrize(
    ("tables", "key", "written"),
    [
        ({"operating": {"temperature": 320, "inlet_pressure_abs": 1e5}}, ("operating", "temperature"), "320 K"),
        (
            {"operating": {"temperature": 320, "inlet_pressure_abs": 1e5}},
            ("operating", "inlet_pressure_abs"),
            "100000.0 Pa",
        ),
        ({"film": {"gap": "slipper", "shaft_angle": 0.1}}, ("film", "shaft_angle"), "0.1 rad"),
        ({"film": {"chamber_pressure": 3e7}}, ("film", "chamber_pressure"), "30000000.0 Pa"),
        ({"film": {"chamber_pressure": [[0.0, 1e5]]}}, ("film", "chamber_pressure"), [["0.0 rad", "100000.0 Pa"]]),
        (
            {"transient": {"control_pressure": [[0.05, 6e5]]}},
            ("transient", "control_pressure"),
            [["0.05 s", "600000.0 Pa"]],
        ),
        ({"transient": {"control_pressure": 6e5}}, ("transient", "control_pressure"), "600000.0 Pa"),
        ({"reference": {"kind": "orifice", "diameter": [1e-3]}}, ("reference", "diameter"), ["0.001 m"]),
        ({"reference": {"kind": "orifice", "pipe_ratio": 2.0}}, ("reference", "pipe_ratio"), 2.0),
        ({"oil": {"tait_slope": 11.0}}, ("oil", "tait_slope"), 11.0),
        ({"thermal": {"fixed_wall": {"temperature": 320.0}}}, ("thermal", "fixed_wall"), {"temperature": "320.0 K"}),
        (
            {"elastic": {"fixed": {"kind": "half_space", "youngs_modulus": 2e11}}},
            ("elastic", "fixed"),
            {"kind": "half_space", "youngs_modulus": "200000000000.0 Pa"},
        ),
        (
            {"pump": {"piston": {"1": {"radial_clearance": 1e-5}}}},
            ("pump", "piston"),
            {"1": {"radial_clearance": "1e-05 m"}},
        ),
        ({"constants": {"c": 1e-5}}, ("constants", "c"), 1e-5),
        ({"film": {"initial_film_fraction": 0.5, "order": 1}}, ("film", "initial_film_fraction"), 0.5),
        (
            {"study": {"film.velocity[0]": {"from": 1.0, "to": 2.0, "points": 3}}},
            ("study", "film.velocity[0]"),
            {"from": "1.0 m/s", "to": "2.0 m/s", "points": 3},
        ),
        (
            {"study": {"pump.piston.radial_clearance": np.array([1e-5])}},
            ("study", "pump.piston.radial_clearance"),
            ["1e-05 m"],
        ),
    ],
)
def test_every_kind_of_quantity_gets_the_si_unit_of_its_key(tables, key, written):
    table, name = key
    assert tables_of_file(tables, Path())[table][name] == written


def test_a_study_of_numbers():
    found = sf.study(SLIDER | {"study": {"film.viscosity": np.array([0.02, 0.04])}})
    load = found.to_xarray().load_N.values
    assert load[1] == pytest.approx(2.0 * load[0], rel=1e-9)


def test_texts_and_files_need_units():
    assert "film.viscosity" in str(faults_of(IN_UNITS.replace('"30 mPa s"', "0.03")))


def test_values_that_no_file_holds_are_faults_all_at_once_with_the_way_that_works():
    told = faults_of(changed(thickness=np.full(10, 1e-5), viscosity=lambda x, y: 0.03, load=None, mesh=object()))
    found = {fault.path: fault for fault in told.faults}
    assert set(found) == {"film.thickness", "film.viscosity", "film.load", "film.mesh"}
    assert found["film.thickness"].found == "an array of shape (10,)"
    assert found["film.viscosity"].found.startswith("a function")
    assert "reynolds.film" in found["film.thickness"].nearest
    assert "reynolds.film" in found["film.viscosity"].nearest
    assert faults_of(SLIDER | {3: "x"}).faults[0].found == "the key 3"


@pytest.fixture
def here(tmp_path, monkeypatch):
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]) * 1e-2
    cells = [("quad", np.array([[0, 1, 4, 3], [1, 2, 5, 4]]))]
    meshio.write_points_cells(tmp_path / "pad.vtu", points, cells, point_data={"h": np.full(6, 1e-5)})
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("mesh", ["pad.vtu", Path("pad.vtu"), {"file": "pad.vtu", "unit": "m"}])
def test_paths_of_tables_and_texts_count_from_the_working_directory(here, mesh):
    tables = changed(mesh=mesh, thickness="h")
    expected = sf.film(tables)
    assert expected.dofs == 6
    text = IN_UNITS.replace(
        '{ kind = "rectangle", size = ["10 mm", "1 mm"], cells = [16, 2], periodic = "y" }', "'pad.vtu'"
    )
    assert sf.film(text.replace('"1e-5*(2 - x/0.01)"', '"h"')).dofs == 6
    told = str(faults_of(changed(mesh="padd.vtu")))
    assert f"'{here}/padd.vtu', which is no file" in told
    assert f"try:      {here}/pad.vtu" in told


def test_faults_of_tables_are_those_of_the_case_without_lines(here):
    told = str(faults_of(changed(mesh="none.vtu", thicknes=1)))
    assert told.startswith("case: 2 faults\n")
    assert "(line" not in told
    assert "swashfilm-" not in told
    of_text = str(faults_of(IN_UNITS.replace("viscosity", "viscosty")))
    assert of_text.startswith("case: ")
    assert "film.viscosty (line 7)" in of_text


def test_a_run_of_tables_has_a_case_that_can_be_run_again(here):
    folder = sf.film(changed(mesh="pad.vtu", thickness="h")).save(here / "run")
    written = tomllib.loads((Path(folder) / "input.toml").read_text("utf-8"))
    assert written["film"]["mesh"] == str(here / "pad.vtu")
    assert sf.film(Path(folder) / "input.toml").dofs == 6


def test_numbers_of_keys_are_in_si_too():
    assert sf.load_pump("ref90", {"piston.radial_clearance": 1e-5}).piston.radial_clearance == 1e-5
    assert (
        sf.film(IN_UNITS.replace("1e-5*(2 - x/0.01)", "1 um"), set={"film.thickness": 1e-5}).film_thickness_min == 1e-5
    )


def test_a_case_of_a_later_version_is_told_the_command_that_upgrades(tmp_path):
    (tmp_path / "case.toml").write_text(IN_UNITS.replace("format = 1", "format = 99"), "utf-8")
    for case in (SLIDER | {"format": 99}, tmp_path / "case.toml"):
        assert "pip install --upgrade swashfilm" in str(faults_of(case))
    with pytest.raises(sf.InputFaults) as raised:
        sf.film(IN_UNITS, refine=99)
    assert [fault.path for fault in raised.value.faults] == ["refine"]
