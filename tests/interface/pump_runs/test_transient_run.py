"""`swashfilm transient`: the case's faults, its run folder, the way back from the resolved case."""

from __future__ import annotations

import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas
import pytest

from swashfilm.cli.app import run_command
from swashfilm.runs.transient.case import TransientSection, load_transient
from swashfilm.runs.transient.stops import contact_rows, contact_summary, contact_words, stop_contacts
from system import InputFaults
from system.inputs.sections.fields import fields_of
from system.multibody.transient import kernels as kernel

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "transients" / "destroke.toml"
SHORT = """format = 1
[transient]
pump = "ref90"
end = "20 ms"
control_pressure = [["0 s", "2.5 MPa"], ["5 ms", "0.6 MPa"]]
[pump.actuator]
area = "18 cm2"
[pump.swash_plate]
inertia = "0.02 kg m2"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("transient")
    (place / "short.toml").write_text(SHORT, "utf-8")
    assert run_command(["transient", str(place / "short.toml"), "-o", str(place / "out")]) == 0
    return place / "out"


def faults_of(text: str, place: Path) -> dict[str, str]:
    path = place / "case.toml"
    path.write_text(text, "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_transient(path)
    return {fault.path: f"{fault.found} | {fault.expected}" for fault in raised.value.faults}


def test_folder_holds_what_the_docs_say(folder):
    names = {path.name for path in folder.iterdir()}
    assert names == {"input.toml", "resolved.toml", "course.csv", "results.nc", "summary.json", "report.html"}
    course = pandas.read_csv(folder / "course.csv")
    assert all(re.search(r" \[(s|deg|deg/s|1|MPa|N m|L/min)\]$", name) for name in course.columns)
    assert course["time [s]"].iloc[-1] == pytest.approx(20e-3, abs=1e-4)
    assert course["swash_angle [deg]"].iloc[-1] < course["swash_angle [deg]"].iloc[0]
    found = json.loads((folder / "summary.json").read_text("utf-8"))
    assert found["kind"] == "transient"
    assert found["checks"]["mass_balance_error"] < 1e-12
    assert [(one["stop"], one["from_start"]) for one in found["stops"]][:1] == [("upper", True)]
    assert not any("actuator.area" in taken for taken in found["assumptions"])
    page = (folder / "report.html").read_text("utf-8")
    assert page.count("<figure") == 4
    assert "swash_plate.damping" in page


@pytest.mark.parametrize(("area", "told"), [("70 cm2", True), ("18 cm2", False)])
def test_an_actuator_wider_than_the_circle_of_the_pistons_is_told(area, told, tmp_path):
    short = SHORT.replace("18 cm2", area).replace("20 ms", "1 ms").replace('"0.6 MPa"', '"1 bar"')
    (tmp_path / "wide.toml").write_text(short, "utf-8")
    assert run_command(["transient", str(tmp_path / "wide.toml"), "-o", str(tmp_path / "out")]) == 0
    warnings = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))["warnings"]
    found = [one for one in warnings if one.startswith("actuator_oversized: ")]
    assert bool(found) is told
    assert all("94.4 mm (limit 90 mm, the pistons' pitch circle)" in one for one in found)


def test_a_contact_tells_when_it_is_and_how_often_the_plate_lifts():
    """Ten instants a turn of 1 s: the upper stop for a turn with a lift; after two turns the lower one to the end."""
    time = np.arange(61) * 0.1
    angle, touch = np.full(61, 0.1), np.zeros(61)
    angle[:11], touch[:11] = 0.2, -5.0
    angle[5], touch[5] = 0.199, 0.0
    angle[31:], touch[31:] = 0.0, 4.0
    touch[32::2], angle[32::2] = 0.0, 1e-5
    impulses = np.zeros(60)
    impulses[30] = 0.7
    rows = np.zeros((61, kernel.CASE + 1))
    rows[:, kernel.MOMENT_STOP] = touch
    plate, point = SimpleNamespace(angle_min=0.0, angle_max=0.2), SimpleNamespace(shaft_speed=2.0 * np.pi)
    found = SimpleNamespace(
        mechanism=SimpleNamespace(plate=plate), swash_angle=angle, time=time, impulses=impulses, rows=rows,
        case=SimpleNamespace(point=point),
    )  # fmt: skip
    upper, lower = contacts = stop_contacts(found)
    assert (upper.stop, upper.from_start, upper.to_end, upper.lifts) == ("upper", True, False, 1)
    assert upper.share == pytest.approx(10.0 / 11.0)
    assert (lower.begin, lower.lifts, lower.impact) == (pytest.approx(3.1), 14, 0.7)
    told = [*contact_words([contact_summary(one) for one in contacts])]
    assert told[0] == "The plate lies against the upper stop until 1000 ms, but lifts once by up to 0.057 deg."
    assert told[1] == (
        "It meets the lower stop at 3100 ms and bounces on it from then on, in touch 52 % of that time, and lifts 5 "
        "times a turn by up to 0.00057 deg."
    )


def test_a_contact_of_an_instant_is_told_as_one():
    """One time and the impact; a longer contact without a lift has no share of its time."""
    one = {"stop": "upper", "share": 1.0, "lifts": 0, "turns": 0.0, "lift_max_rad": 0.0, "impact_max_Nms": 0.7}
    struck, lying, bouncing = contact_rows(
        [
            one | {"from_s": 1e-3, "to_s": 1.2e-3},
            one | {"from_s": 1e-3, "to_s": 9e-3},
            one | {"from_s": 1e-3, "to_s": 9e-3, "share": 0.5, "lifts": 1, "lift_max_rad": 1e-3},
        ]
    )
    assert struck == ("contact with the upper stop", "at 1 ms; impact up to 0.7 N m s")
    assert lying[1] == "1 ms to 9 ms; impact up to 0.7 N m s"
    assert bouncing[1].startswith("1 ms to 9 ms, in touch 50 % of this time, but lifts once by up to 0.057 deg;")


def test_report_is_made_anew_and_check_prints_the_case(folder, capsys):
    (folder / "report.html").unlink()
    assert run_command(["report", str(folder)]) == 0
    assert (folder / "report.html").is_file()
    assert run_command(["check", str(EXAMPLE)]) == 0
    assert "[transient]" in capsys.readouterr().out


def test_resolved_case_gives_the_same_case(folder):
    first, again = load_transient(folder / "input.toml"), load_transient(folder / "resolved.toml")
    assert again.asked.pump == first.asked.pump
    assert again.asked.point == first.asked.point
    assert (again.asked.control_pressure.values == first.asked.control_pressure.values).all()
    assert again.resolved == first.resolved


def test_effects_of_the_pump_act_and_are_named(tmp_path):
    """Also one that [operating] makes act: clearances count from the temperature of the pump's own file."""
    effects = '[pump.physics.churning]\nfactor = 1.0\n[pump.physics.thermal_clearance.piston]\nrate = "0.01 1/K"\n'
    warm = '[operating]\ntemperature = "70 degC"\n'
    drained = {}
    for name, text in (("plain", SHORT + warm), ("affected", SHORT + effects + warm)):
        (tmp_path / f"{name}.toml").write_text(text, "utf-8")
        assert run_command(["transient", str(tmp_path / f"{name}.toml"), "-o", str(tmp_path / name)]) == 0
        drained[name] = pandas.read_csv(tmp_path / name / "course.csv")["drain_flow [L/min]"].iloc[1:100].mean()
    found = json.loads((tmp_path / "affected" / "summary.json").read_text("utf-8"))
    assert found["physics"]["closed_laws"] == ["thermal_clearance", "churning"]
    assert "thermal clearance, churning" in (tmp_path / "affected" / "report.html").read_text("utf-8")
    assert drained["affected"] > 1.1 * drained["plain"]


def test_every_fault_is_told_at_once(tmp_path):
    text = """format = 2
[transient]
pump = "ref9"
end = "20"
control_presure = "2.5 MPa"
course = "jump"
"""
    found = faults_of(text, tmp_path)
    assert set(found) == {
        "format", "transient.pump", "transient.end", "transient.course", "transient.control_presure",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "path", "told"),
    [
        ('[["0 s", "2.5 MPa"], ["5 ms", "0.6 MPa"]]', '[["1 ms", "2.5 MPa"]]', "control_pressure", "rise from 0 s"),
        ('"5 ms", "0.6 MPa"', '"5 ms", "6"', "control_pressure[1]", "with its unit"),
        ('[["0 s", "2.5 MPa"], ["5 ms", "0.6 MPa"]]', "2.5", "control_pressure", "rows such as"),
        ('"20 ms"', '"100 s"', "end", "at most 1000 turns"),
        ('area = "18 cm2"', 'strokes = "sideways"', "pump.actuator.strokes", "'up'"),
        ('inertia = "0.02 kg m2"', 'angle_min = "17 deg"', "swash_plate.angle_min", "to below 16.2 deg"),
    ],
)
def test_faults_name_what_is_expected(tmp_path, old, new, path, told):
    found = faults_of(SHORT.replace(old, new), tmp_path)
    assert any(path in key and told in value for key, value in found.items()), found


def test_start_below_the_lower_stop_is_refused(tmp_path):
    text = SHORT.replace("inertia", 'angle_min = "8 deg"\ninertia') + "[operating]\ndisplacement_ratio = 0.2\n"
    assert "angle_min" in faults_of(text, tmp_path)["transient.pump (operating.displacement_ratio)"]


def test_a_step_too_long_is_told(tmp_path, capsys):
    path = tmp_path / "long.toml"
    path.write_text(SHORT.replace("[pump.actuator]", 'step = "5 deg"\n[pump.actuator]'), "utf-8")
    with pytest.raises(Exception, match=r"transient.step.*at most"):
        run_command(["transient", str(path), "-o", str(tmp_path / "none")])
    assert not (tmp_path / "none").exists()


def test_documented_keys_are_those_of_the_case():
    text = (ROOT / "docs" / "files.md").read_text("utf-8")
    part = text.split("### [transient]", 1)[1].split("\n## ", 1)[0]
    documented = set(re.findall(r"^\| `(\w+)` \|", part, re.MULTILINE))
    assert documented == set(fields_of(TransientSection))


def test_values_that_the_pump_file_leaves_out_are_told_in_the_run(tmp_path: Path) -> None:
    (tmp_path / "scant.toml").write_text(
        '[pump]\ndisplacement = "60 cm3/rev"\npistons = 9\n[oil]\ngrade = "ISO VG 46"\n', "utf-8"
    )
    text = SHORT.replace('"ref90"', '"scant.toml"').replace('"20 ms"', '"2 ms"')
    (tmp_path / "short.toml").write_text(text.replace(', ["5 ms", "0.6 MPa"]', ""), "utf-8")
    assert run_command(["transient", str(tmp_path / "short.toml"), "-o", str(tmp_path / "out")]) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    assert any(one.startswith("values_scaled: ") for one in summary["warnings"])
    assert any(one.startswith("pump.piston_diameter") for one in summary["assumptions"])
