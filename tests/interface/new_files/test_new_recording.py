"""`swashfilm new recording`: channels and units by English and German heads, guesses marked, ready to be diagnosed."""

import csv
from pathlib import Path

import numpy as np
import openpyxl
import pytest
from jsonschema import Draft202012Validator
from scipy.io import savemat

import swashfilm as sf
from diagnosis import read_recording
from diagnosis.recording.guess.channels import guessed_columns
from diagnosis.recording.tables.table import TableColumns
from diagnosis.study.acceptance import checked_recording
from diagnosis.study.inputs import assumed_inputs
from swashfilm.__main__ import main
from swashfilm.console.schemas import schema_of
from system.inputs.channels import ChannelName
from system.inputs.toml_table import read_toml
from system.pump_file.file import load_known_pump

OPEN06 = Path(__file__).parents[3] / "examples" / "recordings" / "open-06"
GERMAN = (
    "Messpunkt", "Drehzahl [U/min]", "Schwenkwinkel [-]", "Hochdruck [bar(a)]", "Speisedruck [bar(a)]",
    "Öltemperatur Tank [°C]", "Temperatur Gehäuse [°C]", "Gehäusedruck [bar(a)]", "Förderstrom [l/min]",
    "Saugvolumenstrom [l/min]", "Leckölstrom [l/min]", "Drehmoment [Nm]",
)  # fmt: skip
BARE = ("nr", "n", "alpha", "p2", "p1", "T_tank", "T_case", "p_case", "Q", "Q_in", "Q_leak", "M")


def _rows():
    with (OPEN06 / "steady.csv").open(encoding="utf-8") as file:
        return list(csv.reader(file))


def _csv(path, head):
    lines = [";".join(head), *(";".join(cell.replace(".", ",") for cell in row) for row in _rows()[1:])]
    path.write_text("\n".join(lines) + "\n", "utf-8")
    return path


def _xlsx(path, head, sheets=1):
    book = openpyxl.Workbook()
    for k in range(1, sheets):
        book.create_sheet(f"more{k}").append(["a"])
    for row in [head, *([float(cell) for cell in row] for row in _rows()[1:])]:
        book.active.append(list(row))
    book.active.title = "Karte"
    book.save(path)
    return path


@pytest.mark.parametrize("head", [_rows()[0], GERMAN], ids=["English", "German"])
@pytest.mark.parametrize("write", [_csv, _xlsx])
def test_a_bare_table_is_read_as_its_recording(tmp_path, write, head):
    table = write(tmp_path / f"map.{write.__name__[1:]}", head)
    path = sf.new("recording", table)
    assert path == tmp_path / "recording.toml"
    assert path.read_text("utf-8").startswith("#:schema ./recording.schema.json\n")
    found, known = read_recording(table), read_recording(OPEN06)
    steady = [name for name in ChannelName if np.any(np.isfinite(known.steady.column(name)))]
    absolute = "absolute" in path.read_text("utf-8").partition("[steady]")[0].partition("#:")[2].split("guessed; or")[0]
    for name in steady:
        shift = 101325.0 if name.dimension and name.dimension.name == "PRESSURE" and not absolute else 0.0
        np.testing.assert_allclose(found.steady.column(name), known.steady.column(name) + shift, rtol=1e-9, atol=1e-6)
    assert found.circuit is known.circuit
    assert not list(Draft202012Validator(schema_of("recording")).iter_errors(read_toml(path)[1]))
    checked_recording(table, load_known_pump("ref90"))


def test_a_series_whose_clock_stumbles_is_a_series(tmp_path):
    """Stamps written twice and a clock that is set back once: the rows are samples over time all the same."""
    time = np.concatenate([np.arange(200.0), 195.0 + np.arange(200.0)])
    time[50] = time[49]
    level = 100.0 + 50.0 * np.sin(time / 40.0)
    rows = [f"{t:g};1500;{p:.2f};50;{40 + 0.01 * p:.3f}" for t, p in zip(time, level, strict=True)]
    (tmp_path / "log.csv").write_text(
        "time [s];speed [rpm];p_out [bar];T_case [degC];Q_out [L/min]\n" + "\n".join(rows)
    )
    text = sf.new("recording", tmp_path / "log.csv").read_text("utf-8")
    assert "[series]" in text
    assert 'time = { column = "time [s]", unit = "s" }' in text


def test_heads_without_units_are_read_by_size_and_every_guess_is_marked(tmp_path):
    table = _csv(tmp_path / "map.csv", BARE)
    text = sf.new("recording", table).read_text("utf-8")
    found, known = read_recording(table), read_recording(OPEN06)
    for name in (ChannelName.SPEED, ChannelName.Q_OUT, ChannelName.TORQUE, ChannelName.T_IN, ChannelName.Q_CASE):
        np.testing.assert_allclose(found.steady.column(name), known.steady.column(name), rtol=1e-9)
    np.testing.assert_allclose(found.steady.column(ChannelName.P_OUT), known.steady.column(ChannelName.P_OUT) + 101325)
    lines = {line.split(" = ")[0]: line for line in text.splitlines() if "column = " in line}
    assert "guessed: place, by its size; guessed: unit, by its size" in lines["p_out"]
    assert all("guessed" in line for line in lines.values())
    assert "# not used: column 'nr'" in text
    assert "# missing: T_out" in text
    assert "Q_slipper" not in text


@pytest.mark.parametrize(
    ("heads", "circuit", "taken"),
    [
        ({"n [rpm]": 1500, "T_case [degC]": 55}, None, {"T_in": "T_case", "p_in": "the ambient pressure"}),
        ({"n [rpm]": 1500, "T_in [degC]": 50}, "closed", {"T_case": "T_in", "p_in": "the pump file"}),
        ({"p_in [bar]": 25}, None, {"T_case": "the pump file", "T_in": "the pump file", "speed": "the pump file"}),
    ],
)
def test_what_is_missing_is_told_by_the_value_that_a_diagnosis_takes(tmp_path, heads, circuit, taken):
    columns = {"p_out [bar]": 200, "p_case [bar]": 1.5, "Q [l/min]": 100, **heads}
    rows = [";".join(f"{size * (1.0 + 0.01 * k):.4f}" for size in columns.values()) for k in range(12)]
    (tmp_path / "map.csv").write_text("\n".join([";".join(columns), *rows]), "utf-8")
    text = sf.new("recording", tmp_path / "map.csv", **({} if circuit is None else {"circuit": circuit})).read_text(
        "utf-8"
    )
    for name, where in taken.items():
        assert f"# missing: {name}, taken from {where}\n" in text
    pump = load_known_pump("ref90").pump
    assumed = {one.channel.value: one.value for one in assumed_inputs(read_recording(tmp_path), pump)}
    known = {"the ambient pressure": 0.0, "T_case": ChannelName.T_CASE, "T_in": ChannelName.T_IN}
    assert {name: assumed[name] for name, where in taken.items() if where in known} == {
        name: known[where] for name, where in taken.items() if where in known
    }


def test_a_time_series_is_taken_as_one(tmp_path):
    time = np.arange(600) * 0.5
    rows = np.stack([time, 1500 + 0 * time, 200 + 0 * time, 100 + 0.01 * np.sin(time), 300 + 0.05 * np.cos(time)], 1)
    head = "Zeit [s],Drehzahl [1/min],p_HD [bar],Q [l/min],Drehmoment [Nm]"
    np.savetxt(tmp_path / "run.csv", rows, delimiter=",", header=head, comments="")
    text = sf.new("recording", tmp_path / "run.csv", circuit="open").read_text("utf-8")
    assert 'time = { column = "Zeit [s]", unit = "s" }' in text
    assert "[series]" in text
    assert "sigma =" not in text
    assert 'circuit = "open"' in text


@pytest.mark.parametrize(
    ("head", "channel", "unit"),
    [
        ("Outlet Pressure [psi]", "p_out", "psi"),
        ("p_in [bar abs]", "p_in", "bar"),
        ("Case Drain Flow (gallon/min)", "Q_case", "gallon/min"),
        ("Shaft speed [1/min]", "speed", "1/min"),
        ("nMot", "speed", "rpm"),
        ("T_Leck_degC", "T_case", "degC"),
        ("Temp. Austritt [°C]", "T_out", "degC"),
        ("Elektrische Leistung [kW]", "electric_power", "kW"),
        ("Moment", "torque", "N m"),
        ("Saugdruck [mbar]", "p_in", "mbar"),
        ("Durchfluss Druckseite [l/min]", "Q_out", "l/min"),
        ("ps [bar]", "p_in", "bar"),
        ("TL [°C]", "T_case", "degC"),
        ("QL [l/min]", "Q_case", "l/min"),
        ("Débit de fuite [l/min]", "Q_case", "l/min"),
        ("Pression refoulement [bar]", "p_out", "bar"),
        ("壳体压力 [MPa]", "p_case", "MPa"),
        ("进口油温 [°C]", "T_in", "degC"),
        ("泄漏流量 [L/min]", "Q_case", "L/min"),
        ("转速 [rpm]", "speed", "rpm"),
        ("Vitesse [tr/min]", "speed", "rpm"),
        ("n [min⁻¹]", "speed", "rpm"),
        ("Stroke [%]", "displacement_ratio", "%"),
        ("Swash [pct]", "displacement_ratio", "%"),
        ("Case flow [gpm]", "Q_case", "gallon/min"),
        ("Outlet flow [US gal/min]", "Q_out", "gallon/min"),
        ("Q_CASE [LPM]", "Q_case", "L/min"),
        ("Torque [in-lbf]", "torque", "lbf inch"),
        ("Torque [lb-ft]", "torque", "lbf ft"),
        ("Torque [N-m]", "torque", "N m"),
        ("Outlet pressure [MPA]", "p_out", "MPa"),
        ("Outlet pressure [kg/cm2]", "p_out", "kgf/cm2"),
        ("Tcase [DEG F]", "T_case", "degF"),
        ("Qcase [l/min]", "Q_case", "l/min"),
        ("pOut [bar]", "p_out", "bar"),
        ("Outlet flow, L/min", "Q_out", "L/min"),
        ("Förderstrom l/min", "Q_out", "l/min"),
        ("p_HD/bar", "p_out", "bar"),
        ("Q/l/min", "Q_out", "l/min"),
        ("n/min-1", "speed", "min-1"),
    ],
)  # fmt: skip
def test_heads_as_benches_write_them(head, channel, unit):
    units = {head: head.rpartition("[")[2].rpartition("(")[2].strip("])")} if head.endswith(("]", ")")) else {}
    found = guessed_columns(TableColumns({head: np.array([100.0, 1500.0])}, units=units)).channels
    assert [(one.name.value, one.unit) for one in found] == [(channel, unit)]


def _guessed(head, unit, numbers=(100.0, 150.0)):
    return guessed_columns(TableColumns({head: np.array(numbers)}, units={head: unit}))


@pytest.mark.parametrize("unit", ["skt", "mA", "V", "scfm"])
def test_a_unit_that_is_not_known_is_told_beside_the_guess(unit):
    """A text that resembles a unit is none, and no letter of it makes a torque a time."""
    (found,) = _guessed(f"Torque [{unit}]", unit).channels
    assert (found.name, found.unit) == (ChannelName.TORQUE, "N m")
    assert found.doubts == (f"unit, by its size: '{unit}' is none that is known",)


@pytest.mark.parametrize("unit", ["deg", "°", "cm3"])
def test_an_angle_of_the_swash_plate_is_no_share_of_full_stroke(unit):
    found = _guessed(f"Schwenkwinkel [{unit}]", unit, (4.0, 16.2))
    head = f"Schwenkwinkel [{unit}]"
    assert (found.channels, found.others, found.angles) == ((), (head,), (head,))


@pytest.mark.parametrize(("inlet", "taken"), [(1.01, "absolute"), (0.85, "absolute"), (0.1, "gauge"), (25.0, "gauge")])
def test_an_inlet_at_one_bar_is_absolute(tmp_path, inlet, taken):
    """What no head says about the zero of pressures the inlet of an open circuit tells."""
    rows = [f"{100 + k};{inlet + 0.001 * k};1500;{30 + k}" for k in range(12)]
    (tmp_path / "map.csv").write_text("\n".join(["p_out [bar];p_in [bar];n [rpm];Q_out [l/min]", *rows]), "utf-8")
    assert f'pressure_reference = "{taken}"' in sf.new("recording", tmp_path / "map.csv").read_text("utf-8")


@pytest.mark.parametrize("head", ["point", "Messpunkt", "Leistung [kW]", "M:1", "remark", "id"])
def test_what_no_head_tells_is_no_channel(head):
    assert guessed_columns(TableColumns({head: np.array([1.0, 2.0])})).channels == ()


def test_a_workbook_of_several_sheets_needs_its_name(tmp_path):
    table = _xlsx(tmp_path / "map.xlsx", GERMAN, sheets=2)
    with pytest.raises(sf.InputFaults) as refused:
        sf.new("recording", table)
    assert "Karte" in str(refused.value)
    assert "part" in refused.value.faults[0].nearest
    assert 'sheet = "Karte"' in sf.new("recording", table, part="Karte").read_text("utf-8")
    assert len(read_recording(table).steady.values) == 112
    (tmp_path / "recording.toml").unlink()
    assert main(["new", "recording", "--part", "Karte", str(table)]) == 0


def test_a_struct_of_a_mat_file_is_the_part_that_is_asked_for(tmp_path):
    savemat(tmp_path / "run.mat", {"data": {"n": np.linspace(1000.0, 2000.0, 9), "Q": np.linspace(50.0, 90.0, 9)}})
    with pytest.raises(sf.InputFaults) as refused:
        sf.new("recording", tmp_path / "run.mat")
    assert refused.value.faults[0].nearest == "part data"
    assert 'variable = "data"' in sf.new("recording", tmp_path / "run.mat", part="data").read_text("utf-8")


def _campaign(folder):
    """Two tables of a campaign, the first with its recording.toml."""
    for day, pressure in (("day1", 100), ("day2", 200)):
        rows = [f"{pressure + k};1500;{60 - k / 10}" for k in range(12)]
        (folder / f"{day}.csv").write_text("\n".join(["p_out [bar];n [rpm];Q_out [l/min]", *rows]), "utf-8")
    return sf.new("recording", folder / "day1.csv")


def test_a_table_beside_the_recording_of_another_is_not_read_as_that(tmp_path, capsys):
    """The table asked for is the one that is read, or none is: never silently another one."""
    stated = _campaign(tmp_path)
    with pytest.raises(sf.InputFaults) as refused:
        read_recording(tmp_path / "day2.csv")
    (fault,) = refused.value.faults
    assert (fault.path, fault.found) == ("steady.file", "'day1.csv'")
    assert "'day2.csv'" in fault.expected
    command = fault.nearest.partition("swashfilm ")[2].split()
    assert main(command) == 0
    assert f"swashfilm check {tmp_path / 'day2.toml'}" in capsys.readouterr().out
    assert read_recording(tmp_path / "day2.toml").steady.column(ChannelName.P_OUT)[0] == pytest.approx(200e5)
    stated.write_text(stated.read_text("utf-8").replace('file = "day1.csv"\n', ""), "utf-8")
    for day, pressure in (("day1", 100e5), ("day2", 200e5)):
        assert read_recording(tmp_path / f"{day}.csv").steady.column(ChannelName.P_OUT)[0] == pytest.approx(pressure)


def test_a_recording_lies_beside_its_table(tmp_path, capsys):
    _campaign(tmp_path)
    (tmp_path / "other").mkdir()
    assert main(["new", "recording", str(tmp_path / "day2.csv"), "-o", str(tmp_path / "other" / "a.toml")]) == 2
    assert "beside the table" in capsys.readouterr().err
    assert main(["new", "recording", str(tmp_path / "day2.csv")]) == 2
    assert f"-o {tmp_path / 'recording-2.toml'}" in capsys.readouterr().err


def test_a_folder_without_a_recording_has_its_first_step(tmp_path):
    (tmp_path / "map.csv").write_text("p_out [bar];Q_out [l/min]\n1;2\n", "utf-8")
    with pytest.raises(sf.InputFaults) as refused:
        read_recording(tmp_path)
    assert refused.value.faults[0].nearest == f"swashfilm new recording {tmp_path / 'map.csv'}"


def test_faults_all_at_once_and_nothing_is_overwritten(tmp_path, capsys):
    table = _csv(tmp_path / "map.csv", GERMAN)
    path = sf.new("recording", table)
    before = path.read_text("utf-8")
    assert main(["new", "recording", str(table), "--circuit", "opn", "--oil", "ISO VG 46"]) == 2
    told = capsys.readouterr().err
    assert all(word in told for word in ("exists", "--circuit", "--oil"))
    assert path.read_text("utf-8") == before


def test_a_table_without_an_output_is_a_fault(tmp_path):
    (tmp_path / "map.csv").write_text("point,remark\n1,2\n3,4\n", "utf-8")
    with pytest.raises(sf.InputFaults, match="flow, a torque"):
        sf.new("recording", tmp_path / "map.csv")


def test_what_is_wrong_with_the_readings_is_told_and_the_file_is_written(tmp_path, capsys):
    head, *rows = _rows()
    lines = [",".join([*head, "pump"]), *(",".join([*row, "AB"[k > 50]]) for k, row in enumerate(rows))]
    (tmp_path / "map.csv").write_text("\n".join(lines) + "\n", "utf-8")
    assert main(["new", "recording", str(tmp_path / "map.csv")]) == 0
    assert "warning: steady.file: several pumps in the column 'pump'" in capsys.readouterr().out
    assert (tmp_path / "recording.toml").is_file()


def test_a_folder_without_permission_is_a_fault(tmp_path, monkeypatch):
    table = _csv(tmp_path / "map.csv", GERMAN)

    def refused(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "write_text", refused)
    with pytest.raises(sf.InputFaults, match="Permission denied"):
        sf.new("recording", table)


def test_a_bare_table_is_pointed_to_the_command(tmp_path, capsys):
    table = _csv(tmp_path / "map.csv", GERMAN)
    assert main(["diagnose", "ref90", str(table)]) == 2
    assert f"swashfilm new recording {table}" in capsys.readouterr().err


def test_text_in_the_place_of_a_workbook_is_told(tmp_path):
    """A renamed CSV has no part to name: its ending is wrong. A damaged workbook is neither."""
    table = _csv(tmp_path / "map.csv", GERMAN).rename(tmp_path / "map.xlsx")
    with pytest.raises(sf.InputFaults) as refused:
        sf.new("recording", table)
    assert refused.value.faults[0].nearest == "text, to be named map.csv"
    table.write_bytes(b"PK\x03\x04\n\x00")
    with pytest.raises(sf.InputFaults) as refused:
        sf.new("recording", table)
    assert refused.value.faults[0].nearest == ""
