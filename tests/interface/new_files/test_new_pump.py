"""`swashfilm new pump`: a complete commented file, runnable at once; faults all at once; questions on a terminal."""

import io
import json
import sys

import pytest
from jsonschema import Draft202012Validator

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.console.schemas import schema_of
from system import check_pump, load_pump, lumped_point, operating_point
from system.inputs.toml_table import read_toml
from system.pump_file.file import load_known_pump

PLATE = {"displacement": "71 cm3", "pistons": 9, "oil": "ISO VG 46", "speed": "2600 rpm", "pressure": "350 bar"}


def _written(tmp_path, name="mine.toml", **changed):
    return sf.new("pump", output=tmp_path / name, **{**PLATE, "circuit": "closed", **changed})


@pytest.mark.parametrize("circuit", ["open", "closed"])
@pytest.mark.parametrize(("displacement", "pistons"), [("10 cm3", 7), ("71 cm3/rev", 9), ("500 cm3", 11)])
def test_a_new_pump_is_complete_and_sound(tmp_path, circuit, displacement, pistons):
    path = _written(tmp_path, displacement=displacement, pistons=pistons, circuit=circuit, speed="1500 rpm")
    known = load_known_pump(path)
    assert not known.scant
    pump = known.pump
    assert pump.name == "mine"
    assert pump.pump.pistons == pistons
    assert pump.operating.pressure == pump.pump.rated_pressure == 35e6
    assert pump.operating.speed == pump.pump.rated_speed
    assert pump.operating.inlet_pressure == (0.0 if circuit == "open" else 2.5e6)
    assert not {warning.path for warning in check_pump(pump).warnings} - {
        warning.path for warning in check_pump(load_pump("ref90")).warnings
    }
    assert not list(Draft202012Validator(schema_of("pump")).iter_errors(read_toml(path)[1]))


@pytest.mark.parametrize(
    ("displacement", "pistons", "speed", "pressure"),
    [("18 cm3", 7, "3000 rpm", "250 bar"), ("71 cm3", 9, "2600 rpm", "28 MPa"), ("250 cm3", 9, "1500 rpm", "350 bar")],
)
def test_the_ports_of_an_open_circuit_neither_starve_nor_trap_a_chamber(
    tmp_path, displacement, pistons, speed, pressure
):
    rating = {"displacement": displacement, "pistons": pistons, "speed": speed, "pressure": pressure}
    pump = load_pump(_written(tmp_path, circuit="open", **rating))
    for share, ratio in ((1.0, 1.0), (0.5, 1.0), (1.0, 0.3)):
        part = pump.pump
        at = operating_point(pump, delivery_pressure=share * part.rated_pressure, displacement_ratio=ratio)
        assert not {remark.warning for remark in lumped_point(pump, at).warnings}


def test_an_open_circuit_of_low_pressure_is_a_pump(tmp_path):
    """Its inlet is that of a tank from the start, not the charged one of the pump that it is scaled from."""
    assert load_pump(_written(tmp_path, circuit="open", pressure="20 bar")).pump.rated_pressure == 2e6


def test_it_is_the_scaled_pump_of_the_same_facts(tmp_path):
    scant = tmp_path / "scant.toml"
    facts = 'displacement = "71 cm3"\npistons = 9\nrated_speed = "2600 rpm"\nrated_pressure = "350 bar"\n'
    point = '[operating]\nspeed = "2600 rpm"\npressure = "350 bar"\n'
    scant.write_text(f'name = "mine"\n[pump]\n{facts}[oil]\ngrade = "ISO VG 46"\n{point}', "utf-8")
    assert load_pump(_written(tmp_path)) == load_pump(scant)


def test_every_key_is_commented_and_every_assumption_marked(tmp_path):
    path = _written(tmp_path)
    text = path.read_text("utf-8")
    assert text.startswith("#:schema ./pump.schema.json\n")
    assert (tmp_path / "pump.schema.json").is_file()
    entries = [line for line in text.splitlines() if " = " in line and not line.startswith(("#", "name", "format"))]
    stated = ("pistons", 'displacement = "', "rated_", "grade", "speed", 'pressure = "350 bar"')
    for line in entries:
        assert line.partition(" # ")[2], line
        assert ("assumed" in line) != line.startswith(stated), line
    assert "# sealing lands 1 .. 2 and 3 .. 4 (inner and outer)\n" in text
    assert "assumed: ref90's +- 50%" in next(line for line in entries if line.startswith("radial_clearance"))
    assert "assumed: scaled from ref90" in next(line for line in entries if line.startswith("piston_diameter"))


def test_it_checks_and_runs(tmp_path, capsys):
    path = str(_written(tmp_path))
    assert main(["check", path]) == 0
    assert main(["run", path, "--fidelity", "lumped", "-o", str(tmp_path / "run")]) == 0
    assert "leaves" not in capsys.readouterr().out
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    assert summary["flow"]["delivery_m3_per_s"] == pytest.approx(71e-6 * 2600 / 60, rel=0.06)


def test_two_viscosities_in_place_of_a_grade(tmp_path):
    oil = load_pump(_written(tmp_path, oil="46 mm2/s, 6.8 mm2/s")).oil
    assert (oil.kinematic_viscosity_40C, oil.kinematic_viscosity_100C) == (46e-6, 6.8e-6)


@pytest.mark.parametrize("short", ["VG 46", "iso vg 46", "VG46", "46", "HLP 46", "HLP46", "hm 46", "HLPD 46"])
def test_short_names_of_a_grade(tmp_path, short):
    assert 'grade = "ISO VG 46"' in _written(tmp_path, oil=short).read_text("utf-8")


def test_numbers_are_si(tmp_path):
    pump = load_pump(_written(tmp_path, displacement=71e-6, speed=260.0, pressure=35e6))
    assert pump.pump.displacement == pytest.approx(71e-6 / (2 * 3.141592653589793) * 6.283185307179586)
    assert (pump.pump.rated_speed, pump.pump.rated_pressure) == (260.0, 35e6)


def test_faults_all_at_once_and_nothing_is_overwritten(tmp_path):
    before = _written(tmp_path).read_text("utf-8")
    with pytest.raises(sf.InputFaults) as refused:
        _written(tmp_path, displacement="60 mm", pistons=3, oil="VG 47", speed="0 rpm", pressure=None, circuit="opn")
    faults = {fault.path: fault for fault in refused.value.faults}
    assert set(faults) == {"output", "displacement", "pistons", "oil", "speed", "pressure", "circuit"}
    assert faults["oil"].nearest == "ISO VG 46"
    assert faults["circuit"].nearest == "open"
    assert faults["output"].nearest.endswith("mine-2.toml")
    assert (tmp_path / "mine.toml").read_text("utf-8") == before


def test_an_answer_that_makes_no_pump_is_a_fault_of_its_option(tmp_path):
    """Closed, the inlet is charged; an oil thins as it warms. Each is told where it was said."""
    with pytest.raises(sf.InputFaults) as refused:
        _written(tmp_path, pressure="20 bar", oil="6.8 mm2/s, 46 mm2/s")
    told = {fault.path: f"{fault.found}, {fault.expected}" for fault in refused.value.faults}
    assert set(told) == {"pressure", "oil"}
    assert "more than inlet_pressure, 2.5 MPa gauge" in told["pressure"]
    assert told["oil"].startswith("46 mm2/s, less than the 6.8 mm2/s at 40 degC")


def test_an_option_of_another_kind_and_an_unknown_kind(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "pump", "extra", "--part", "sheet", "--pistns", "9"]) == 2
    told = capsys.readouterr().err
    assert all(word in told for word in ("--part", "'extra'", "--pistns", "--displacement"))
    assert main(["new", "pmp"]) == 2
    assert "try:      pump" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


class Terminal(io.StringIO):
    """Text that is typed."""

    def isatty(self):
        return True


def test_a_terminal_is_asked_until_the_answer_is_good(tmp_path, monkeypatch):
    typed, shown = Terminal("71\n71 cm3\n9\n46\nISO VG 46\n2600rpm\n350bar\nclosd\nclosed\n"), Terminal()
    monkeypatch.setattr(sys, "stdin", typed)
    monkeypatch.setattr(sys, "stdout", shown)
    monkeypatch.chdir(tmp_path)
    assert main(["new", "pump"]) == 0
    assert load_pump("pump.toml").pump.pistons == 9
    assert shown.getvalue().count("expected") == 3


def test_an_end_of_the_answers_is_a_fault(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdin", Terminal("71 cm3\n"))
    monkeypatch.setattr(sys, "stdout", Terminal())
    monkeypatch.chdir(tmp_path)
    assert main(["new", "pump"]) == 2
    assert "--pistons" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
