"""Coefficient files: every fault at once with its line, and what a run tells of them."""

from __future__ import annotations

import json

import pytest

from swashfilm.cli.app import run_command
from swashfilm.runs.pump.coefficients.flow import share_beyond
from system import Dimension, InputFaults, load_pump, read_flow_coefficients, read_step_losses, resolved_toml
from system.inputs.csv_table import read_table

PORT = """# source: a bench, 2026
opening [cm2], reynolds [1], flow_coefficient [1]
1, 100, 0.6
0.01, 1, 0.1
1, 1, 0.1
0.01, 100, 0.6
"""


def file_of(place, text, name="port.csv"):
    path = place / name
    path.write_text(text, encoding="utf-8")
    return path


def faults_of(read, path):
    with pytest.raises(InputFaults) as told:
        read(path)
    return {fault.path: fault for fault in told.value.faults}


def test_rows_come_in_any_order_and_unit(tmp_path):
    found = read_flow_coefficients(file_of(tmp_path, PORT))
    assert found.opening == pytest.approx([1e-6, 1e-4])
    assert found.reynolds.tolist() == [[1.0, 100.0], [1.0, 100.0]]
    assert found.flow_number[0] == pytest.approx([10.0, 100.0 / 0.6])
    assert found.source == "a bench, 2026"


def test_every_fault_of_a_file_is_told_with_its_line(tmp_path):
    text = "opening [mm2], reynolds [1], flow_coefficient [1]\n1, 1, 0.1\n1, -2, 1.3\n2, 5, 0.6\n"
    found = faults_of(read_flow_coefficients, file_of(tmp_path, text))
    assert set(found) == {"source", "line 3, reynolds", "line 3, flow_coefficient", "opening"}
    assert "1 mm2 with 2, 2 mm2 with 1" in found["opening"].found


def test_a_flow_that_falls_as_the_drop_rises_is_a_fault(tmp_path):
    text = "# source: x\nopening [mm2], reynolds [1], flow_coefficient [1]\n1, 10, 0.3\n1, 12, 0.6\n"
    assert set(faults_of(read_flow_coefficients, file_of(tmp_path, text))) == {"line 4, flow_coefficient"}


def test_columns_and_numbers_that_are_none_are_told(tmp_path):
    path = file_of(tmp_path, "openning [mm2], reynolds, flow_coefficient [1]\n1, 2, 3\n")
    found = faults_of(read_flow_coefficients, path)
    assert found["column 'openning [mm2]'"].nearest == "opening"
    assert found["column 'reynolds'"].found == "no unit"
    path = file_of(tmp_path, "a [mm], b [1]\n1, x\n1 m, nan\n2\n")
    found = faults_of(lambda place: read_table(place, {"a": Dimension.LENGTH, "b": None}), path)
    assert set(found) == {"line 2, b", "line 3, a", "line 3, b", "line 4"}


def test_loss_factors_are_a_full_grid(tmp_path):
    head = "# source: x\nfilm_ratio [1], reynolds [1], extra_length [1], loss_factor [1]\n"
    found = read_step_losses(file_of(tmp_path, head + "2, 0, .4, -1\n0.5, 0, .4, 1\n2, 5, .4, -.9\n0.5, 5, .4, 1.2\n"))
    assert found.loss_factor.tolist() == [[1.0, 1.2], [-1.0, -0.9]]
    assert set(faults_of(read_step_losses, file_of(tmp_path, head + "2, 0, .4, -1\n0.5, 1, .4, 1\n"))) == {"reynolds"}
    varied = head + "2, 0, .4, -1\n2, 1, .5, 1\n"
    assert set(faults_of(read_step_losses, file_of(tmp_path, varied))) == {"extra_length", "film_ratio"}


def test_time_beyond_a_file_is_counted(tmp_path):
    table = read_flow_coefficients(file_of(tmp_path, PORT))
    from numpy import array

    areas, drops = array([0.0, 5e-7, 5e-5, 5e-5]), array([1e5, 1e2, 1e2, 1e7])
    assert share_beyond(table, areas, drops, 860.0, 0.03) == pytest.approx(2 / 3)


def test_a_run_tells_where_its_coefficients_are_from(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file_of(tmp_path, PORT)
    text = resolved_toml(load_pump("ref90"))
    kept = [line for line in text.splitlines() if not line.startswith(("flow_coefficient", "critical_reynolds"))]
    pump = file_of(tmp_path, "\n".join(kept).replace("[ports]", '[ports]\ncoefficient_file = "port.csv"'), "pump.toml")
    assert run_command(["run", str(pump), "--fidelity", "lumped", "-o", "out"]) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    (told,) = summary["coefficients"]
    assert (told["key"], told["source"]) == ("ports.coefficient_file", "a bench, 2026")
    assert "a bench, 2026" in (tmp_path / "out" / "report.html").read_text("utf-8")
    assert any(one.startswith("coefficients_beyond_file: delivery port") for one in summary["warnings"])


def test_a_bad_file_is_a_fault_of_the_pump(tmp_path):
    pump = file_of(tmp_path, resolved_toml(load_pump("ref90")), "pump.toml")
    file_of(tmp_path, PORT.replace("0.1", "-1"))
    with pytest.raises(InputFaults) as told:
        load_pump(pump, {"ports.coefficient_file": "port.csv", "ports.delivery.coefficient_file": "none.csv"})
    paths = [fault.path for fault in told.value.faults]
    assert paths.count("ports.coefficient_file") == 2
    assert "ports.delivery.coefficient_file" in paths
    with pytest.raises(InputFaults, match="one of \\[ports\\] too"):
        load_pump(pump, {"ports.delivery.coefficient_file": str(file_of(tmp_path, PORT))})
