"""Numbers as people read them: units of tables and CSV files, the way back to SI, round-off, workbooks."""

import json

import numpy as np
import openpyxl
import pytest
import xarray
from hypothesis import given, strategies as st

from swashfilm.__main__ import main
from swashfilm.output.data.files import Column, read_columns, write_columns, write_netcdf
from swashfilm.output.data.workbook import write_workbook
from swashfilm.output.headline import number_text, summary_scales
from swashfilm.output.result import read_table
from system.inputs.shown import PressureUnit, known_unit, pressures_in, shown_in, significant
from system.paper.figure import Unit
from system.variation.measures import MEASURES

CASE = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "10 mm"], cells = [4, 4] }
thickness = "10 um"
viscosity = "30 mPa s"
velocity = ["1 m/s", "0 m/s"]
[boundary]
left = { pressure = "10 bar" }
right = { pressure = "0 bar" }
"""


@pytest.fixture
def case(tmp_path, monkeypatch):
    """A film case in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pad.toml").write_text(CASE, encoding="utf-8")
    return "pad.toml"


@pytest.mark.parametrize(
    ("si", "quantity", "unit", "one"),
    [
        ("Pa", "chamber_pressure", "MPa", 1e-6),
        ("m", "film_thickness_min", "um", 1e6),
        ("m", "piston_x", "mm", 1e3),
        ("m", "eccentricity_x_inner", "um", 1e6),
        ("m3/s", "flow", "L/min", 6e4),
        ("m3/rev", "derived displacement", "mL/r", 1e6),
        ("rad/s", "shaft speed", "r/min", 30.0 / np.pi),
        ("rad/s", "swash_rate", "deg/s", 180.0 / np.pi),
        ("rad", "tilt", "mrad", 1e3),
        ("rad", "shaft_angle", "deg", 180.0 / np.pi),
        ("m2", "delivery_area", "mm2", 1e6),
        ("Pa s", "viscosity", "mPa s", 1e3),
        ("K", "film_temperature", "degC", 1.0 - 273.15),
        ("K", "temperature rise", "K", 1.0),
        ("N m", "torque", "N m", 1.0),
        ("N", "load", "N", 1.0),
        ("W", "loss", "W", 1.0),
    ],
)
def test_every_quantity_has_its_unit(si, quantity, unit, one):
    shown = shown_in(si, quantity)
    assert shown.unit == unit
    assert shown.of(1.0) == pytest.approx(one)
    assert known_unit(unit).to_si(shown.of(1.0)) == pytest.approx(1.0)


def test_pressures_are_in_bar_where_that_is_asked_for():
    with pressures_in(PressureUnit.BAR):
        assert shown_in("Pa").text(35e6) == "350.0 bar"
        assert MEASURES["chamber_pressure_peak"].text(35e6) == "350 bar"
        assert (Unit.PRESSURE.shown, Unit.PRESSURE.factor) == ("bar", 1e-5)
    assert shown_in("Pa").text(35e6) == "35.00 MPa"
    assert MEASURES["chamber_pressure_peak"].text(35e6) == "35 MPa"


@given(st.floats(1e-3, 1e8), st.integers(1, 8))
def test_significant_digits_are_those_of_the_number(value, digits):
    assert float(significant(value, digits)) == pytest.approx(value, rel=0.6 * 10.0 ** (1 - digits))
    assert "e" not in significant(value, digits)


def test_columns_come_back_in_si(tmp_path):
    columns = [
        Column("time", [0.0, 1e-3], "s"), Column("pressure", [1e5, 35e6], "Pa"),
        Column("leak", [-1e-7, np.nan], "m3/s"),
        Column("film temperature", [293.15, 353.15], "K"),
    ]  # fmt: skip
    for unit in PressureUnit:
        with pressures_in(unit):
            write_columns(tmp_path / "course.csv", columns)
        assert f"pressure [{unit.value}]" in (tmp_path / "course.csv").read_text("utf-8")
        found = read_columns(tmp_path / "course.csv")
        for column in columns:
            np.testing.assert_allclose(found[column.name], column.values, rtol=1e-7)
    assert read_table(tmp_path / "course.csv")["pressure"].attrs["units"] == "Pa"


def test_round_off_is_written_as_nothing(tmp_path):
    write_columns(tmp_path / "table.csv", [Column("load", [1.65e-47, 500.0], "N"), Column("force", [3e-14, 1.0], "N")])
    assert (tmp_path / "table.csv").read_text("utf-8").splitlines()[1:] == ["0,0", "500,1"]
    summary = {"moment_x_Nm": 4e-16, "moment_y_Nm": -1e-15, "load_N": 12.5, "scale": {"moment_Nm": 10.0}}
    scales = summary_scales(summary)
    assert number_text("moment_x_Nm", 4e-16, scales) == "0 N m (round-off)"
    assert number_text("load_N", 12.5, scales) == "12.50 N"
    assert number_text("contact_load_fraction", 1e-254, scales) == "0 (round-off)"


def test_every_variable_of_a_netcdf_file_has_a_unit_and_a_name(tmp_path):
    data = xarray.Dataset(
        {"film_pressure": ("vertex", [1.0, 2.0], {"units": "Pa"}), "cells": (("cell", "corner"), [[0, 1]])},
        coords={"x": ("vertex", [0.0, 1.0], {"units": "m", "long_name": "along the slide"})},
    )
    write_netcdf(data, tmp_path / "results.nc", "film")
    with xarray.open_dataset(tmp_path / "results.nc", engine="h5netcdf") as found:
        assert found["film_pressure"].attrs == {"units": "Pa", "long_name": "film pressure"}
        assert found["x"].attrs == {"units": "m", "long_name": "along the slide"}
        assert found["cells"].attrs["units"] == "1"


def test_a_film_is_shown_in_bar_and_kept_in_si(case, capsys):
    assert main(["film", case, "--units", "bar", "--csv", "-o", "run"]) == 0
    assert "10.00 bar" in capsys.readouterr().out
    with open("run/fields.csv", encoding="utf-8") as file:
        assert "film_pressure [bar]" in file.readline()
    with open("run/summary.json", encoding="utf-8") as file:
        assert json.load(file)["pressure_max_Pa"] == pytest.approx(1e6)
    assert main(["film", case, "--units", "Bar"]) == 2
    assert "bar" in capsys.readouterr().err


def test_a_run_leaves_a_workbook(case):
    assert main(["film", case, "--excel", "--csv", "-o", "run"]) == 0
    book = openpyxl.load_workbook("run/run.xlsx")
    assert book.sheetnames == ["summary", "fields", "sections"]
    assert all(sheet.freeze_panes == "A2" for sheet in book)
    rows = {name: (value, unit) for name, value, unit in book["summary"].iter_rows(values_only=True)}
    assert rows["number"] == ("value", "unit")
    assert rows["pressure max"] == (1.0, "MPa")
    assert rows["film thickness min"] == (10.0, "um")
    head, first = list(book["fields"].iter_rows(values_only=True))[:2]
    assert "film_pressure [MPa]" in head
    assert all(isinstance(cell, (int, float)) for cell in first)


def test_a_text_of_a_workbook_is_no_formula(tmp_path):
    texts = ["=1+1", "+x", "-x", "@x", "-1.5"]
    (tmp_path / "summary.json").write_text(
        json.dumps({"format": 1, "kind": "film", "name": "=cmd()"}), encoding="utf-8"
    )
    (tmp_path / "table.csv").write_text("reason\n" + "\n".join(texts) + "\n", encoding="utf-8")
    write_workbook(tmp_path, tmp_path / "book.xlsx")
    book = openpyxl.load_workbook(tmp_path / "book.xlsx")
    cells = [row[0] for row in book["table"].iter_rows(min_row=2)]
    assert [cell.value for cell in cells] == ["=1+1", "+x", "-x", "@x", -1.5]
    assert [cell.data_type for cell in cells] == ["s", "s", "s", "s", "n"]
    assert [row[1].data_type for row in book["summary"].iter_rows(min_row=2) if row[1].value == "=cmd()"] == ["s"]
