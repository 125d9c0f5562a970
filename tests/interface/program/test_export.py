"""`swashfilm export`: what each format's reader finds is the map; holes and names are told."""

import re
import shlex
from pathlib import Path

import numpy as np
import pandas
import pint
import pytest
from kept_maps import LEVELS, kept_map
from scipy.io import loadmat

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.runs.export.numbers import TABLES, numbers
from swashfilm.runs.map.files import read_map
from system.inputs.units import RPM
from system.maps.plan import MapInput

MODELICA_TABLE = re.compile(r"double (\w+)\((\d+),(\d+)\)")
AMESIM_UNITS = {"rev/min": RPM, "bar": 1e5, "Nm": 1.0, "L/min": 1.0 / 6e4, "W": 1.0, "mm": 1e-3}
"""SI value of Amesim's units."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return kept_map(tmp_path_factory.mktemp("export") / "whole", LEVELS)


@pytest.fixture(scope="module")
def holed(tmp_path_factory):
    return kept_map(tmp_path_factory.mktemp("export") / "holed", LEVELS, without=(5, 6))


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def of_map(folder):
    data, _ = read_map(folder / "map.nc")
    return {number.name: number for number in numbers(data)}


def turns():
    """Pint's units, and a turn as pumps have it."""
    units = pint.UnitRegistry()
    units.define("@alias turn = rev = r")
    return units


def caret(unit):
    """A unit as pint reads it: m^3/s, N*m."""
    return re.sub(r"(?<=m)3", "^3", unit).replace("N m", "N*m")


def read_modelica(text):
    """Tables by the grammar of the Modelica Standard Library: `#1`, then heads and numbers; # begins a remark."""
    first, *rest = text.splitlines()
    assert first == "#1"
    words = " ".join(line.partition("#")[0] for line in rest)
    found, places = {}, list(MODELICA_TABLE.finditer(words))
    for place, following in zip(places, [*places[1:], None], strict=True):
        cells = words[place.end() : following.start() if following else None].split()
        found[place[1]] = np.array(cells, dtype=float).reshape(int(place[2]), int(place[3]))
    return found


def read_amesim(text):
    """Units, levels and values of a table of two axes or more."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    axes = int(re.match(r"# Table format: (\d)D\n", text)[1])
    units = dict(re.findall(r"^# (\w+_unit) = (\S+)$", text, re.MULTILINE))
    levels = [np.fromstring(line, sep=" ") for line in lines[axes : 2 * axes]]
    assert [len(one) for one in levels] == [int(line) for line in lines[:axes]]
    values = np.array(" ".join(lines[2 * axes :]).split(), dtype=float)
    return units, levels, values.reshape([len(one) for one in levels], order="F")


def test_modelica_reads_the_map(whole, tmp_path):
    assert main(["export", str(whole), "--to", "modelica", "-o", "Pump.mo"]) == 0
    found, known = read_modelica((tmp_path / "Pump.txt").read_text()), of_map(whole)
    assert len(found) == len(TABLES) * 4
    for name in TABLES:
        for k, index in enumerate(np.ndindex(2, 2, 1), start=1):
            table = found[f"{name.replace('.', '_')}_{k}"]
            np.testing.assert_array_equal(table[0, 1:], LEVELS[MapInput.PRESSURE])
            np.testing.assert_array_equal(table[1:, 0], LEVELS[MapInput.SPEED])
            np.testing.assert_array_equal(table[1:, 1:], known[name].values[:, :, *index])


def test_the_modelica_model_takes_each_table_at_its_levels(whole, tmp_path):
    main(["export", str(whole), "--to", "modelica", "-o", "Pump.mo"])
    model, tables = (tmp_path / "Pump.mo").read_text(), read_modelica((tmp_path / "Pump.txt").read_text())
    assert model.startswith("package Pump ")
    assert model.endswith("end Pump;\n")
    assert 'fileName = "Pump.txt"' in model
    named = re.findall(r"tableName=\{([^}]*)\}", model)
    assert {name for row in named for name in re.findall(r'"(\w+)"', row)} == set(tables)
    products = re.search(r" weight = \{(.*)\};", model)[1].split(", ")
    levels = {
        name: [float(one) for one in row.split(", ")] for name, row in re.findall(r"weights\((\w+), \{(.*)\}\);", model)
    }
    assert levels == {given.value: list(LEVELS[given]) for given in (MapInput.RATIO, MapInput.TEMPERATURE)}
    torques, known = re.findall(r'"(\w+)"', named[0]), of_map(whole)["shaft_torque"].values
    for table, factors in zip(torques, products, strict=True):
        taken = {name: int(k) - 1 for name, k in re.findall(r"(\w+)_weight\[(\d)\]", factors)}
        own = known[:, :, taken["displacement_ratio"], taken["temperature"], 0]
        np.testing.assert_array_equal(tables[table][1:, 1:], own)


def test_a_modelica_model_of_speed_and_pressure_alone_has_one_table_each(tmp_path):
    folder = kept_map(tmp_path / "line", {MapInput.PRESSURE: (10e6, 20e6)})
    assert main(["export", str(folder), "--to", "modelica", "-o", "Pump.mo"]) == 0
    model = (tmp_path / "Pump.mo").read_text()
    assert " weight = {1};" in model
    assert re.findall(r"RealInput (\w+)\(", model) == ["delivery_pressure"]
    assert set(read_modelica((tmp_path / "Pump.txt").read_text())) == {f"{name.replace('.', '_')}_1" for name in TABLES}


def test_matlab_reads_the_map(holed, tmp_path, capsys):
    assert main(["export", str(holed), "--to", "matlab"]) == 0
    assert "2 of 48 points without a result" in capsys.readouterr().out
    found = loadmat(tmp_path / "ref90.mat", squeeze_me=True, simplify_cells=True)
    assert list(found["dimensions"]) == [given.value for given in LEVELS]
    for given, values in LEVELS.items():
        np.testing.assert_array_equal(found[given.value], values)
    assert found["held"] == {"inlet_pressure": pytest.approx(2.5e6)}
    known, units = of_map(holed), turns()
    for name, number in known.items():
        np.testing.assert_array_equal(found[number.identifier], np.squeeze(number.values))
        assert len(number.identifier) <= 63, f"{name}: MATLAB cuts longer names"
        assert units.parse_units(found["units"][number.identifier]) == units.parse_units(caret(number.unit))
        assert found["meaning"][number.identifier] == number.words
    assert np.sum(np.isnan(found["shaft_torque"])) == 2


def test_amesim_tables_hold_the_map(whole, tmp_path):
    assert main(["export", str(whole), "--to", "amesim", "-o", "a/pump.data"]) == 0
    files = {path.name for path in (tmp_path / "a").iterdir()}
    assert files == {f"pump_{name.replace('.', '_')}.data" for name in TABLES}
    for name, number in of_map(whole).items():
        if name not in TABLES:
            continue
        units, levels, values = read_amesim((tmp_path / "a" / f"pump_{number.identifier}.data").read_text())
        np.testing.assert_allclose(
            values * AMESIM_UNITS[units["table_unit"]], np.squeeze(number.values), rtol=1e-11, atol=1e-18
        )
        np.testing.assert_allclose(levels[0] * AMESIM_UNITS[units["axis1_unit"]], LEVELS[MapInput.SPEED], rtol=1e-11)
        np.testing.assert_allclose(levels[1] * AMESIM_UNITS[units["axis2_unit"]], LEVELS[MapInput.PRESSURE], rtol=1e-11)
        assert "axis3_unit" not in units
        assert units["axis4_unit"] == "degC"
        np.testing.assert_allclose(levels[3] + 273.15, LEVELS[MapInput.TEMPERATURE], rtol=1e-11)


def test_an_amesim_table_of_one_axis_has_pairs(tmp_path):
    folder = kept_map(tmp_path / "line", {MapInput.PRESSURE: (10e6, 20e6)})
    assert main(["export", str(folder), "--to", "amesim", "-o", "pump.data"]) == 0
    text = (tmp_path / "pump_shaft_torque.data").read_text()
    assert text.startswith("# Table format: 1D\n")
    assert np.loadtxt(text.splitlines())[:, 0].tolist() == [100.0, 200.0]


def test_csv_has_a_line_for_each_point_in_the_units_of_its_heads(holed, tmp_path, capsys):
    assert main(["export", str(holed), "--to", "csv", "-o", "pump.csv"]) == 0
    assert "written as nan" in capsys.readouterr().out
    frame, known = pandas.read_csv(tmp_path / "pump.csv"), of_map(holed)
    assert frame["shaft_speed [r/min]"].unique().tolist() == [1000.0, 1500.0, 2000.0]
    assert frame["delivery_pressure [bar]"].unique().tolist() == [100.0, 200.0, 250.0, 300.0]
    assert frame["reason"].dropna().tolist() == ["no film", "no film"]
    units = turns()
    read = {head.partition(" [")[0]: head for head in frame.columns}
    for name, number in known.items():
        unit = re.search(r"\[(.*)\]$", read[name])[1]
        given = np.asarray(frame[read[name]])
        si = units.Quantity(given, caret(unit)).to(caret(number.unit)).magnitude if unit != "%" else given / 100.0
        np.testing.assert_allclose(si, np.ravel(number.values), rtol=1e-11, atol=1e-18)


@pytest.mark.parametrize("to", ["modelica", "amesim", "fmu"])
def test_a_format_without_holes_refuses_them(to, holed, tmp_path, capsys):
    assert main(["export", str(holed), "--to", to]) == 2
    error = capsys.readouterr().err
    assert all(text in error for text in ("2 of 48 points", "no film", "--resume", "--to matlab or csv")), error
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("nowhere --to matlap", ["no such file or folder", "modelica, matlab", "try:      matlab"]),
        ("{whole} --to csv -o pump.txt", ["ends in .csv", "-o pump.csv"]),
        ("{whole} --to csv -o ''", ["ends in .csv"]),
        ("{whole} --to modelica -o 3-pumps.mo", ["a capital first", "-o Map_3_pumps.mo"]),
        ("{whole} --to modelica -o here/model.mo", ["a capital first", "-o here/Model.mo"]),
        ("{whole} --to modelica -o Real.mo", ["it names the package"]),
        ("{whole}", ["--to"]),
    ],
)
def test_what_is_wrong_is_told_and_nothing_is_written(words, told, whole, tmp_path, capsys):
    assert main(["export", *shlex.split(words.format(whole=whole))]) == 2
    error = capsys.readouterr().err
    assert all(text in error for text in told), error
    assert not list(tmp_path.iterdir())


def test_nothing_is_overwritten(whole, tmp_path, capsys):
    (tmp_path / "Pump.txt").write_text("mine")
    (tmp_path / "Pump_2.mo").write_text("mine")
    assert main(["export", str(whole), "--to", "modelica", "-o", "Pump.mo"]) == 2
    error = capsys.readouterr().err
    assert "Pump.txt, which exists" in error
    assert "-o Pump_3.mo" in error
    assert not (tmp_path / "Pump.mo").exists()


def test_a_file_that_cannot_be_written_is_told(whole, tmp_path, capsys):
    (tmp_path / "there").write_text("")
    assert main(["export", str(whole), "--to", "csv", "-o", "there/pump.csv"]) == 2
    assert "a file that can be created" in capsys.readouterr().err


def test_a_single_point_is_a_line_of_csv_and_no_table(tmp_path, capsys):
    folder = kept_map(tmp_path / "point", {})
    assert main(["export", str(folder), "--to", "matlab"]) == 2
    assert "--to csv" in capsys.readouterr().err
    assert sf.export(folder, "csv") == (Path("ref90.csv"),)


def test_holes_are_a_warning_in_python(holed):
    with pytest.warns(UserWarning, match="2 of 48 points without a result.*written as nan"):
        written = sf.export(holed, "csv")
    assert [path.is_file() for path in written] == [True]


def test_a_map_is_exported_from_python(whole, tmp_path):
    assert sf.export(whole, "modelica", tmp_path / "Pump.mo") == (tmp_path / "Pump.mo", tmp_path / "Pump.txt")
