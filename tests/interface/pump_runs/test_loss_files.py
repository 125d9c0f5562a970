"""Files of losses of lands: every fault at once, what a run tells, and reference -> file -> run."""

from __future__ import annotations

import json

import numpy as np
import pytest

from swashfilm.cli.app import run_command
from swashfilm.runs.pump.coefficients.edge_losses import loss_records, losses_left_out
from system import InputFaults, check_pump, load_pump, lumped_point, operating_point, read_step_losses, resolved_toml
from system.inputs.coefficients.loss_files import read_groove_losses
from system.maps.point import LumpedSolver, MapWork
from system.pump.land_losses import land_losses

STEPS = "film_ratio [1], reynolds [1], extra_length [1], loss_factor [1]"
GROOVES = "film_ratio [1], width_ratio [1], reynolds [1], extra_length [1], loss_factor [1]"


def file_of(place, head, rows, name="losses.csv", source="# source: a bench, 2026\n"):
    path = place / name
    path.write_text(f"{source}{head}\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return path


def steps_of(place, largest=5.0, ratio=20.0, name="losses.csv"):
    rows = [f"{r}, {re}, .63, {k}" for r, k in ((1.0 / ratio, 1.6), (ratio, -1.5)) for re in (0, largest)]
    return file_of(place, STEPS, rows, name)


def faults_of(read, path):
    with pytest.raises(InputFaults) as told:
        read(path)
    return {fault.path: fault for fault in told.value.faults}


def test_wrong_columns_units_and_numbers_are_told(tmp_path):
    found = faults_of(read_step_losses, file_of(tmp_path, "film_ratio, reynolds [1], loss [1]", ["1, 2, 3"]))
    assert found["column 'film_ratio'"].found == "no unit"
    assert {"column 'loss [1]'", "column 'extra_length'", "column 'loss_factor'"} <= set(found)
    path = file_of(tmp_path, STEPS.replace("reynolds [1]", "reynolds [mm]"), ["0.1, 2, 3, 4", "9, 2, 3, 4"])
    assert "bare number" in faults_of(read_step_losses, path)["line 3, reynolds"].expected
    path = file_of(tmp_path, STEPS, ["0.1, -2, .6, 1.5", "-9, 0, .6, 1.5"], source="")
    assert {"source", "line 2, reynolds", "line 3, film_ratio"} <= set(faults_of(read_step_losses, path))


def test_a_file_of_one_direction_is_told(tmp_path):
    path = file_of(tmp_path, STEPS, ["10, 0, .6, -1.5", "2, 0, .4, -1.2"])
    assert "2 to 10" in faults_of(read_step_losses, path)["film_ratio"].found


def test_grooves_are_by_depth_and_width(tmp_path):
    rows = [f"{r}, {w}, {re}, {r + w}, {re}" for r in (10, 3) for w in (5, 1) for re in (5, 0)]
    found = read_groove_losses(file_of(tmp_path, GROOVES, rows))
    assert found.sizes.tolist() == [[3, 1], [3, 5], [10, 1], [10, 5]]
    assert found.extra_length.tolist() == [4.0, 8.0, 11.0, 15.0]
    assert found.loss_factor.tolist() == [[0.0, 5.0]] * 4
    assert (
        "film_ratio"
        in faults_of(read_step_losses, file_of(tmp_path, GROOVES, rows))["column 'width_ratio [1]'"].expected
    )
    path = file_of(tmp_path, GROOVES, [row.replace("10,", "0.5,", 1) for row in rows])
    assert "line 3, film_ratio" in faults_of(read_groove_losses, path)


def test_bad_files_are_faults_of_the_pump_all_at_once(tmp_path):
    bad = str(file_of(tmp_path, STEPS, ["0.1, -2, .6, 1.5", "9, 0, .6, 1.5"]))
    with pytest.raises(InputFaults) as told:
        load_pump(
            "ref90",
            {
                "slipper.pocket_file": bad,
                "valve_plate.kidney_file": bad,
                "slipper.orifice_file": bad,
                "slipper.groove_file": "none.csv",
            },
        )
    paths = {fault.path for fault in told.value.faults}
    assert paths == {
        "slipper.pocket_file", "valve_plate.kidney_file", "slipper.orifice_file", "slipper.groove_file",
    }  # fmt: skip


def test_a_bore_has_a_file_or_a_coefficient(tmp_path):
    rows = ["0.5, 1, .2", "0.5, 50, .5"]
    bore = file_of(tmp_path, "opening [mm2], reynolds [1], flow_coefficient [1]", rows)
    with pytest.raises(InputFaults, match="one of the two"):
        load_pump("ref90", {"slipper.orifice_file": str(bore), "slipper.orifice_flow_coefficient": 0.7})


@pytest.mark.parametrize("openings", [(0.5,), (0.1, 100.0)], ids=["any opening", "openings on both sides"])
def test_a_bore_that_its_file_covers_is_not_warned_of(tmp_path, openings):
    rows = [f"{a}, {re}, {c}" for a in openings for re, c in ((1, 0.2), (50, 0.5))]
    bore = file_of(tmp_path, "opening [mm2], reynolds [1], flow_coefficient [1]", rows)
    pump = load_pump("ref90", {"slipper.orifice_file": str(bore)})
    assert not [warning for warning in check_pump(pump).warnings if warning.path == "slipper.orifice_file"]


def test_files_that_do_not_hold_are_warned_of(tmp_path):
    shallow = steps_of(tmp_path, ratio=2.0)
    rows = [f"{a}, {re}, {c}" for a in (0.1, 0.2) for re, c in ((1, 0.2), (50, 0.5))]
    bore = file_of(tmp_path, "opening [mm2], reynolds [1], flow_coefficient [1]", rows, "bore.csv")
    pump = load_pump("ref90", {"slipper.pocket_file": str(shallow), "slipper.orifice_file": str(bore)})
    found = {warning.path: warning for warning in check_pump(pump).warnings}
    assert (found["slipper.pocket_file"].value, found["slipper.pocket_file"].limit) == (
        "steps of film_ratio 0.5 and 2 at most", "0.1 and 10",
    )  # fmt: skip
    assert found["slipper.orifice_file"].limit == "0.1 mm2 to 0.2 mm2"
    rows = [f"20, {w}, {re}, 1, 0" for w in (1, 3) for re in (0, 5)]
    grooves = file_of(tmp_path, GROOVES, rows, "grooves.csv")
    over = {"slipper.groove_file": str(grooves), "slipper.grooves": [["10 mm", "10.5 mm"]]}
    (found,) = (one for one in check_pump(load_pump("ref90", over)).warnings if one.path == "slipper.groove_file")
    assert (found.value, found.limit) == ("a groove 50 films wide", "width_ratio 1 to 3")


def test_a_run_tells_where_its_losses_are_from_and_where_they_end(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    steps_of(tmp_path, largest=0.1, name="steps.csv")
    text = resolved_toml(load_pump("ref90"))
    for table, key in (("slipper", "pocket_file"), ("valve_plate", "kidney_file")):
        text = text.replace(f"[{table}]", f'[{table}]\n{key} = "steps.csv"')
    pump = tmp_path / "pump.toml"
    pump.write_text(text, encoding="utf-8")
    assert run_command(["run", str(pump), "--fidelity", "lumped", "-o", "out"]) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    assert [one["key"] for one in summary["coefficients"]] == ["slipper.pocket_file", "valve_plate.kidney_file"]
    assert {one["source"] for one in summary["coefficients"]} == {"a bench, 2026"}
    assert "extra length 0.63 and 0.63, Re 0 .. 0.1" in summary["coefficients"][0]["range"]
    told = [one for one in summary["warnings"] if one.startswith("coefficients_beyond_file")]
    assert len(told) == 2
    assert "slipper.pocket_file" in told[0]
    assert "limit 1% of the turn" in told[0]
    assert "a bench, 2026" in (tmp_path / "out" / "report.html").read_text("utf-8")


def test_a_reference_s_file_is_a_pump_s(tmp_path):
    """The loop: passages are solved, their table is named by a pump, its leakage is less by what they lose."""
    case = tmp_path / "step.toml"
    text = 'format = 1\n[reference]\nkind = "step"\nfilm_ratio = [0.5, 2]\nreynolds = [0, 5]\ncells = 2\n'
    case.write_text(text, encoding="utf-8")
    assert run_command(["reference", str(case), "-o", str(tmp_path / "step")]) == 0
    losses = tmp_path / "step" / "loss_factor.csv"
    plain, edged = (load_pump("ref90", given) for given in ({}, {"slipper.pocket_file": str(losses)}))
    before, after = (lumped_point(pump, operating_point(pump)).leakage_flow.slipper for pump in (plain, edged))
    slipper, film = load_pump("ref90").slipper, read_step_losses(losses)
    lengths = film.extra_length * slipper.film_thickness
    more = lengths[0] / slipper.land_inner_radius + lengths[1] / slipper.land_outer_radius
    log = slipper.lands.log_ratio
    # Inertia is a few 1e-5 here: Re is about one.
    assert after / before == pytest.approx(log / (log + more), abs=1e-4)
    (told,) = loss_records(edged)
    assert told["source"].startswith("swashfilm")


def test_a_map_s_point_is_another_where_a_file_has_changed(tmp_path):
    path = steps_of(tmp_path)
    pump = load_pump("ref90", {"slipper.pocket_file": str(path)})
    work = MapWork(pump, LumpedSolver())
    before = work.key(operating_point(pump))
    assert before == work.key(operating_point(pump))
    steps_of(tmp_path, ratio=30.0)
    assert MapWork(pump, LumpedSolver()).key(operating_point(pump)) == before
    again = load_pump("ref90", {"slipper.pocket_file": str(path)})
    assert MapWork(again, LumpedSolver()).key(operating_point(again)) != before


def test_floating_gaps_say_what_they_leave_out(tmp_path):
    pump = load_pump("ref90", {"valve_plate.kidney_file": str(steps_of(tmp_path))})
    (told,) = losses_left_out(pump)
    assert told.startswith("losses_left_out: valve_plate.kidney_file")
    assert losses_left_out(load_pump("ref90")) == []


def test_single_slippers_files_are_told_at_their_own(tmp_path):
    text = resolved_toml(load_pump("ref90")) + f'[slipper.3]\npocket_file = "{steps_of(tmp_path)}"\n'
    pump = tmp_path / "pump.toml"
    pump.write_text(text, encoding="utf-8")
    (told,) = loss_records(load_pump(pump))
    assert told["key"] == "slipper.3.pocket_file"
    assert np.all([word in told["range"] for word in ("0.05", "20")])


def test_a_groove_s_reference_is_a_slipper_s(tmp_path):
    case = tmp_path / "groove.toml"
    text = 'format = 1\n[reference]\nkind = "groove"\nfilm_ratio = 3\nwidth_ratio = [1, 3]\nreynolds = 0\ncells = 2\n'
    case.write_text(text, encoding="utf-8")
    assert run_command(["reference", str(case), "-o", str(tmp_path / "groove")]) == 0
    file = tmp_path / "groove" / "loss_factor.csv"
    found = read_groove_losses(file)
    assert found.sizes.tolist() == [[3.0, 1.0], [3.0, 3.0]]
    over = {"slipper.groove_file": str(file), "slipper.grooves": [["10 mm", "10.01 mm"]]}
    (edge,) = land_losses(load_pump("ref90", over)).slipper.edges
    assert edge.extra_length == pytest.approx(found.extra_length[0] + 1.0 / 27.0, rel=1e-5)
