"""OpenFOAM cases: a small one written here, Poiseuille flow in a channel, and the faults of bad ones."""

from __future__ import annotations

import os

import numpy as np
import pytest
from openfoam_case import DENSITY, DROP, FLOW, HEIGHT, write_case

from swashfilm.cli.app import run_command
from system import InputFaults, read_flow_coefficients
from system.inputs.coefficients.loss_files import GROOVE_HEADS, STEP_HEADS
from system.inputs.coefficients.openfoam_case import read_case_flow
from system.inputs.csv_table import read_table


@pytest.mark.parametrize(("dimensions", "scale"), [("0 2 -2 0 0 0 0", 1.0 / DENSITY), ("1 -1 -2 0 0 0 0", 1.0)])
def test_flow_and_drop_of_the_last_time_are_read(tmp_path, dimensions, scale):
    found = read_case_flow(write_case(tmp_path / "case", dimensions, scale), "inlet", "outlet", DENSITY)
    assert found.time == 100.0
    assert found.flow == pytest.approx(FLOW, rel=1e-5)
    assert found.pressure_drop == pytest.approx(DROP, rel=1e-5)
    assert abs(found.balance_error) < 1e-6


def test_a_case_becomes_a_row_of_a_coefficient_file(tmp_path, capsys):
    case, file = write_case(tmp_path / "case"), tmp_path / "port.csv"
    words = ["coefficients", str(case), "--inlet", "inlet", "--outlet", "outlet", "--throat-area", "400 mm2"]
    words += ["--density", f"{DENSITY} kg/m3", "-o", str(file), "--viscosity"]
    assert run_command([*words, "20 mm2/s"]) == 0
    assert run_command([*words, "10 mm2/s"]) == 0
    assert "18 L/min" in capsys.readouterr().out
    found = read_flow_coefficients(file)
    coefficient = FLOW / (4e-4 * np.sqrt(2.0 * DROP / DENSITY))
    assert found.flow_coefficient[0] == pytest.approx([coefficient] * 2, rel=1e-4)
    assert found.reynolds[0, 0] == pytest.approx(FLOW / 4e-4 * np.sqrt(16e-4 / np.pi) / 20e-6, rel=1e-4)
    assert found.source == "OpenFOAM, case"
    with pytest.raises(InputFaults, match="does not have yet"):
        run_command([*words, "10 mm2/s"])


def film_words(case, file, viscosity, ratio="0.1", *more):
    """Poiseuille flow between planes, as if a film of HEIGHT, LENGTH/2 on either side, met another."""
    words = ["coefficients", str(case), "--inlet", "inlet", "--outlet", "outlet", "--throat-area", "200 mm2"]
    words += ["--density", f"{DENSITY} kg/m3", "--viscosity", viscosity, "--film", "10 mm", "-o", str(file)]
    return [*words, "--before", "100 mm", "--behind", "100 mm", "--film-ratio", ratio, *more]


def test_a_slow_case_gives_the_extra_length_and_faster_ones_the_loss_factor(tmp_path):
    case, file = write_case(tmp_path / "case"), tmp_path / "steps.csv"
    speed, nu = FLOW / 2e-4, 0.02  # Re = .75
    head, viscous = 0.5 * DENSITY * speed**2, 12.0 * DENSITY * nu * speed / HEIGHT
    length = 0.1 * 0.1**3 + 0.1  # of the film that is ten times as thick, and of the thin one
    assert run_command(film_words(case, file, "20000 mm2/s")) == 0
    kinetic = 54.0 / 35.0 * (1.0 - 0.1**2)
    extra = (DROP - viscous * length / HEIGHT - kinetic * head) / viscous
    assert run_command(film_words(case, file, "100 mm2/s")) == 0  # Re 150
    columns = read_table(file, STEP_HEADS).columns
    assert columns["reynolds"] == pytest.approx([0.75, 150.0], rel=1e-4)
    assert columns["extra_length"] == pytest.approx([extra, extra], rel=1e-4)
    faster = viscous * 100.0 / 20000.0
    loss = (DROP - faster * (length / HEIGHT + extra)) / head
    assert columns["loss_factor"] == pytest.approx([kinetic, loss], rel=1e-4)
    with pytest.raises(InputFaults, match="does not have yet"):
        run_command(film_words(case, file, "100 mm2/s"))
    with pytest.raises(InputFaults, match="a slower flow first"):
        run_command(film_words(case, file, "100 mm2/s", "10"))


def test_a_groove_has_a_width_and_its_own_length_of_film(tmp_path):
    case, file = write_case(tmp_path / "case"), tmp_path / "grooves.csv"
    assert run_command(film_words(case, file, "20000 mm2/s", "2", "--width-ratio", "4")) == 0
    columns = read_table(file, GROOVE_HEADS).columns
    viscous = 12.0 * DENSITY * 0.02 * FLOW / 2e-4 / HEIGHT
    assert columns["loss_factor"][0] == 0.0
    assert columns["extra_length"][0] == pytest.approx(DROP / viscous - 20.0 - 4.0 / 8.0, rel=1e-4)


def test_parts_of_a_step_are_told(tmp_path):
    words = film_words(tmp_path, "x.csv", "1 mm2/s", "1")
    del words[words.index("--film") : words.index("--film") + 2]
    with pytest.raises(InputFaults) as told:
        run_command(words)
    assert [fault.path for fault in told.value.faults] == ["--film", "--film-ratio"]


def test_what_is_wrong_with_a_case_is_told(tmp_path):
    case = write_case(tmp_path / "case")
    with pytest.raises(InputFaults, match="one of inlet, outlet") as told:
        read_case_flow(case, "inlett", "outlets", DENSITY)
    assert [fault.nearest for fault in told.value.faults] == ["inlet", "outlet"]
    with pytest.raises(InputFaults, match="inlet and outlet swapped"):
        read_case_flow(case, "outlet", "inlet", DENSITY)
    with pytest.raises(InputFaults, match="controlDict"):
        read_case_flow(tmp_path, "inlet", "outlet", DENSITY)
    leaky = write_case(tmp_path / "leaky", outflow=0.9)
    with pytest.raises(InputFaults, match="of the inflow"):
        read_case_flow(leaky, "inlet", "outlet", DENSITY)
    odd = write_case(tmp_path / "odd", dimensions="0 0 0 1 0 0 0")
    with pytest.raises(InputFaults, match="kinematic"):
        read_case_flow(odd, "inlet", "outlet", DENSITY)


def test_pipes_and_devices_in_a_case_are_all_told_and_none_is_waited_for(tmp_path):
    case = write_case(tmp_path / "case")
    for name in ("constant/polyMesh/faces", "100/p"):
        (case / name).unlink()
    os.mkfifo(case / "constant/polyMesh/faces")
    (case / "100/p").symlink_to("/dev/zero")
    with pytest.raises(InputFaults) as told:
        read_case_flow(case, "inlet", "outlet", DENSITY)
    assert [(one.path, one.found) for one in told.value.faults] == [
        ("100/p", "a device, not a file"),
        ("constant/polyMesh/faces", "a pipe, not a file"),
    ]


def test_sizes_without_units_are_all_told(tmp_path):
    words = ["coefficients", str(tmp_path), "--inlet", "a", "--outlet", "b", "--throat-area", "1", "--density", "2 m"]
    with pytest.raises(InputFaults) as told:
        run_command([*words, "--viscosity", "0 mm2/s"])
    assert [fault.path for fault in told.value.faults] == ["--throat-area", "--density", "--viscosity"]
