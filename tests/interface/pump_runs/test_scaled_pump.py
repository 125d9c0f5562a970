"""Scaled pumps: missing values by REF90, for every size and number of pistons."""

import json
import math

import pytest

from swashfilm.cli.app import run_command
from system import InputFaults, SwashDrive, check_pump, load_pump, stroke, tolerances
from system.pump.laws.kinematics import displacement
from system.pump_file.file import load_known_pump

SCANT = '[pump]\ndisplacement = "{}"\npistons = {}\n[oil]\ngrade = "ISO VG 46"\n'


def _load(tmp_path, text):
    path = tmp_path / "scant.toml"
    path.write_text(text, "utf-8")
    return load_known_pump(path)


def _geometric(pump):
    drive = SwashDrive(pump.pump.pitch_radius, pump.pump.bore_cone_angle, pump.pump.swash_angle_max)
    return displacement(pump.pump.pistons, math.pi / 4 * pump.pump.piston_diameter**2, stroke(drive))


@pytest.mark.parametrize("volume", [5.0, 60.0, 500.0])
@pytest.mark.parametrize("pistons", [5, 7, 8, 9, 11, 15])
def test_every_size_and_number_of_pistons_is_a_sound_pump(tmp_path, volume, pistons):
    known = _load(tmp_path, SCANT.format(f"{volume} cm3", pistons))
    pump, model = known.pump, load_pump("ref90")
    assert known.scant
    assert known.stated == {"pump.displacement", "pump.pistons", "oil.grade"}
    assert _geometric(pump) == pytest.approx(volume * 1e-6, rel=1e-3)
    assert {warning.path for warning in check_pump(pump).warnings} <= {w.path for w in check_pump(model).warnings}
    assert pump.pump.rated_speed * pump.pump.pitch_radius == pytest.approx(
        model.pump.rated_speed * model.pump.pitch_radius, rel=1e-3
    )
    assert pump.piston.radial_clearance == model.piston.radial_clearance


def test_ref90s_own_size_gives_ref90(tmp_path):
    model = load_pump("ref90")
    pump = _load(tmp_path, SCANT.format("89.86 cm3/rev", 9).replace("VG 46", "VG 68")).pump
    for section in ("pump", "piston", "slipper", "valve_plate", "ports", "block", "bearings", "friction", "oil"):
        for key, value in vars(getattr(model, section)).items():
            if isinstance(value, float):
                assert getattr(getattr(pump, section), key) == pytest.approx(value, rel=2e-3), f"{section}.{key}"


def test_hst196_is_met_from_three_facts(tmp_path, validation):
    """A machine whose drawing is known: 196 mL/r, nine pistons, 15 deg."""
    text = SCANT.format("196 cm3/rev", 9).replace("[oil]", 'swash_angle_max = "15 deg"\n[oil]')
    pump = _load(tmp_path, text).pump.pump
    for quantity, expected, obtained in (
        ("piston diameter", 29.595, 1e3 * pump.piston_diameter),
        ("pitch radius", 59.08, 1e3 * pump.pitch_radius),
    ):
        validation(
            case="HST 196 scaled from REF90 by displacement, pistons and swash angle",
            source="ivanokhotnikov/effmap, drawing",
            quantity=quantity,
            unit="mm",
            expected=expected,
            obtained=obtained,
            relative_tolerance=0.02,
        )


def test_what_is_stated_holds(tmp_path):
    more = '[piston]\nradial_clearance = "28.6 um"\n[operating]\npressure = "207 bar"\n'
    sizes = 'piston_diameter = "29.6 mm"\nswash_angle_max = "15 deg"\n[oil]'
    text = SCANT.format("196 cm3/rev", 9).replace("[oil]", sizes) + more
    known = _load(tmp_path, text)
    assert known.pump.pump.piston_diameter == pytest.approx(0.0296)
    assert known.pump.piston.radial_clearance == pytest.approx(28.6e-6)
    assert known.pump.operating.pressure == pytest.approx(20.7e6)
    assert _geometric(known.pump) == pytest.approx(196e-6, rel=1e-3)
    paths = {assumption.path for assumption in known.assumptions}
    assert "slipper.film_thickness" in paths
    assert not paths & known.stated


def test_what_is_scaled_is_wide_and_what_is_stated_is_not(tmp_path):
    text = SCANT.format("60 cm3", 9) + "[tolerance]\nfriction = 0.2\n"
    wide, _ = tolerances(_load(tmp_path, text).pump)
    usual, _ = tolerances(load_pump("ref90"))
    assert wide.film_thickness > 5.0 * usual.film_thickness
    assert wide.friction == 0.2
    assert wide.bearing_friction > usual.bearing_friction


def test_a_tolerance_is_twice_its_value_at_most(tmp_path):
    with pytest.raises(InputFaults, match="at most 2") as refused:
        _load(tmp_path, SCANT.format("60 cm3", 9) + "[tolerance]\nfriction = 2.0\nbearing_friction = 2.1\n")
    assert {fault.path for fault in refused.value.faults} == {"tolerance.bearing_friction"}


def test_complete_pumps_are_as_they_are():
    known = load_known_pump("ref90")
    assert known.pump == load_pump("ref90")
    assert not known.scant
    assert known.assumptions == ()


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("[oil]\n", {"pump", "oil.grade"}),
        (SCANT.format("9 mm", 3), {"pump.displacement", "pump.pistons"}),
        (SCANT.format("60 cm3", 9) + '[slippr]\nfilm_thickness = "9 um"\n', {"slippr"}),
        (SCANT.format("60 cm3", 9).replace("ement", "ment"), {"pump.displacement", "pump.displacment"}),
        (SCANT.format("-60 cm3", 9), {"pump.displacement"}),
        (SCANT.format("60 cm3", 9).replace("46", "47"), {"oil.grade"}),
        (SCANT.format("60 cm3", 3).replace("46", "47") + '[slippr]\n[piston]\nradial_clearance = "1 bar"\n',
         {"pump.pistons", "oil.grade", "slippr", "piston.radial_clearance"}),
    ],
)  # fmt: skip
def test_faults_all_at_once(tmp_path, text, faults):
    with pytest.raises(InputFaults) as refused:
        _load(tmp_path, text)
    found = [fault.path for fault in refused.value.faults]
    assert faults <= set(found)
    assert len(found) == len(set(found))


def test_a_scaled_pump_runs_and_every_command_tells_what_it_takes(tmp_path, capsys):
    path = tmp_path / "scant.toml"
    path.write_text(SCANT.format("71 cm3", 9), "utf-8")
    assert run_command(["run", str(path), "--fidelity", "lumped", "--speed", "1500rpm", "-o", str(tmp_path / "a")]) == 0
    told = " ".join(capsys.readouterr().out.split())
    for one in load_known_pump(path, {"operating.speed": "1500rpm"}).assumptions:
        assert f"{one.path} {one.value}" in told
    assert "operating.speed" not in told
    summary = json.loads((tmp_path / "a" / "summary.json").read_text("utf-8"))
    assert any("those of ref90, scaled" in text for text in summary["warnings"])
    assert any(text.startswith("slipper.mass: taken") for text in summary["assumptions"])
    case = tmp_path / "gap.toml"
    case.write_text('format = 1\n[film]\ngap = "slipper"\npump = "scant.toml"\n[position]\nfilm_thickness = "12 um"\n')
    assert run_command(["film", str(case), "-o", str(tmp_path / "b")]) == 0
    assert "slipper.mass" in capsys.readouterr().out


def test_values_set_from_outside_leave_a_file_scant(tmp_path):
    path = tmp_path / "scant.toml"
    path.write_text(SCANT.format("71 cm3", 9), "utf-8")
    values = {"slipper.mass": "50 g", "valve_plate.film_thickness": "9 um", "ports.flow_coefficient": 0.6}
    known = load_known_pump(path, values)
    assert known.scant
    assert known.pump.valve_plate.film_thickness == 9e-6
    assert set(values) <= known.stated


def test_what_is_stated_as_a_table_is_not_assumed(tmp_path):
    more = '[piston]\nedge_relief = { width = "5 mm", depth = "9 um" }\n'
    paths = {one.path for one in _load(tmp_path, SCANT.format("60 cm3", 9) + more).assumptions}
    assert "bore.edge_relief.width" in paths
    assert not {path for path in paths if path.startswith("piston.edge_relief")}
