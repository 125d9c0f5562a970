"""Load of a film unrolled from a cylinder: a vector, as closed forms of journal bearings give it."""

import json
import math

import meshio
import numpy as np
import pytest

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.case.file import load_case
from swashfilm.output.data.files import read_columns
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system import InputFaults

RADIUS, LENGTH, CLEARANCE, SPEED, VISCOSITY = 25e-3, 10e-3, 50e-6, 2.5, 0.03
ROUND = f'kind = "rectangle", size = ["{2.0 * math.pi * RADIUS} m", "{LENGTH} m"], cells = [256, 2]'
RING = 'kind = "annulus", inner_radius = "20 mm", outer_radius = "25 mm", cells = [2, 64]'
LONG = f"""format = 1
[film]
mesh = {{ {ROUND} }}
thickness = "{CLEARANCE}*(1 + RATIO*cos(x/{RADIUS}))"
velocity = ["{SPEED} m/s", "0 m/s"]
viscosity = "{VISCOSITY} Pa s"
cavitation = "none"
geometry = "cylinder"
[boundary]
left = {{ pressure = "0 bar" }}
right = {{ pressure = "0 bar" }}
"""


@pytest.mark.parametrize("ratio", [0.2, 0.5, 0.8])
def test_a_full_film_without_side_flow_bears_sommerfelds_load_across_the_line_of_centres(ratio):
    """Sommerfeld 1904: 12 pi mu U L (R/C)^2 e/((2 + e^2) sqrt(1 - e^2)), friction (C/R) (1 + 2 e^2)/(3 e)."""
    found = sf.film(LONG.replace("RATIO", f"{ratio}")).summary
    scale = 12.0 * math.pi * VISCOSITY * SPEED * LENGTH * (RADIUS / CLEARANCE) ** 2
    load = scale * ratio / ((2.0 + ratio**2) * math.sqrt(1.0 - ratio**2))
    assert found["bearing_load_N"] == pytest.approx(load, rel=2e-3)
    assert found["attitude_angle_deg"] == pytest.approx(90.0, abs=1e-6)
    coefficient = CLEARANCE / RADIUS * (1.0 + 2.0 * ratio**2) / (3.0 * ratio)
    assert found["friction_coefficient"] == pytest.approx(coefficient, rel=2e-3)


def test_the_sensitivity_of_a_journal_is_that_of_its_load_as_a_vector(tmp_path, capsys):
    """The slope by the eccentricity is that of Sommerfeld's load; the plane's integral and moments are refused."""
    text = LONG.replace("RATIO", "e").replace("[boundary]", "[constants]\ne = 0.5\n[boundary]", 1)
    found = sf.film(text, sensitivity="bearing_load").summary["sensitivity"]["outputs"]["bearing_load_N"]
    scale = 12.0 * math.pi * VISCOSITY * SPEED * LENGTH * (RADIUS / CLEARANCE) ** 2
    slope = scale * (2.0 - 0.5**2 + 2.0 * 0.5**4) / ((2.0 + 0.5**2) ** 2 * (1.0 - 0.5**2) ** 1.5)
    assert found["by_constants.e"] == pytest.approx(slope, rel=3e-3)
    case = tmp_path / "journal.toml"
    case.write_text(text, encoding="utf-8")
    assert main(["film", str(case), "--sensitivity", "load,moment_x"]) == 2
    told = capsys.readouterr().err
    assert "'load'" in told
    assert "'moment_x'" in told
    assert "bearing_load" in told


@pytest.mark.parametrize("origin", ["0 mm", "-5 mm", "40 mm"])
def test_the_friction_torque_is_that_about_the_axis_wherever_the_sheet_lies(origin):
    """T = F R and T omega = heat; the unrolled sheet has neither load nor moments."""
    text = LONG.replace("RATIO", "e").replace("[boundary]", "[constants]\ne = 0.5\n[boundary]", 1)
    moved = text.replace("cells = [256, 2]", f'cells = [256, 2], origin = ["{origin}", "{origin}"]')
    outputs = "friction_torque,friction_x"
    found = sf.film(moved, sensitivity=outputs).summary
    torque = found["friction_torque_moving_Nm"]
    assert found["cylinder_radius_m"] == pytest.approx(RADIUS, rel=1e-12)
    assert torque == pytest.approx(RADIUS * found["friction_force_moving_N"][0], rel=1e-12)
    assert torque * SPEED / RADIUS == pytest.approx(-found["dissipation_W"], rel=1e-9)
    slopes = found["sensitivity"]["outputs"]
    assert slopes["friction_torque_Nm"]["value"] == pytest.approx(torque, rel=1e-12)
    by_force = RADIUS * slopes["friction_x_N"]["by_constants.e"]
    assert slopes["friction_torque_Nm"]["by_constants.e"] == pytest.approx(by_force, rel=1e-9)
    assert not {"load_N", "moment_x_Nm", "moment_y_Nm", "carried_load_N"} & set(found)


def test_a_journal_over_time_keeps_its_load_as_a_vector(tmp_path):
    """Without squeeze and cavity each step is the steady film: history and range over time are Sommerfeld's load."""
    case = tmp_path / "journal.toml"
    text = LONG.replace("RATIO", "0.5").replace("[boundary]", '[time]\nend = "2 ms"\nstep = "1 ms"\n[boundary]')
    case.write_text(text.replace("format = 1\n[film]", "format = 1\n[film]\ninitial_film_fraction = 1.0"))
    assert main(["film", str(case), "-o", str(tmp_path / "run")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    steps = read_columns(tmp_path / "run" / "history.csv")
    for end in ("min", "max"):
        assert summary[f"load_of_time_{end}_N"] == pytest.approx(summary["bearing_load_N"], rel=1e-9)
    assert steps["bearing load"][-1] == pytest.approx(summary["bearing_load_N"], rel=1e-6)
    assert steps["friction torque moving"][-1] == pytest.approx(summary["friction_torque_moving_Nm"], rel=1e-6)
    assert "load" not in steps
    assert steps["attitude angle"][-1] == pytest.approx(math.radians(90.0), abs=1e-6)


SHORT = """format = 1
[film]
mesh = MESH
thickness = "50e-6*(1 + 0.6*cos(x/0.025))"
velocity = ["2.5 m/s", "0 m/s"]
viscosity = "30 mPa s"
cavitation_pressure = "-0.7 bar"
geometry = "cylinder"
[boundary]
bottom = { pressure = "0 bar" }
top = { pressure = "0 bar" }
"""


def _sheet(folder, uneven: float = 0.0) -> None:
    """Write the unrolled journal of 32 x 4 cells as a mesh file in mm; `uneven` shifts the nodes of its right side."""
    x, y = np.meshgrid(np.linspace(0.0, 157.07963, 33), np.linspace(0.0, 10.0, 5), indexing="ij")
    y[-1, 1:-1] += uneven
    at = np.arange(33 * 5).reshape(33, 5)
    quads = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=-1).reshape(-1, 4)
    points = np.column_stack([x.ravel(), y.ravel(), 0.0 * x.ravel()])
    meshio.write_points_cells(folder / "sheet.vtu", points, [("quad", quads)])


def _named(case) -> set[str]:
    return {one["name"] for one in film_summary(solve_case(load_case(case)))["warnings"]}


def test_a_journal_from_a_mesh_file_closes_at_its_seam(tmp_path):
    _sheet(tmp_path)
    case, loads = tmp_path / "case.toml", []
    built = 'kind = "rectangle", size = ["157.07963 mm", "10 mm"], cells = [32, 4], cell = "quadrilateral"'
    for mesh in (f'{{ {built}, periodic = "x" }}', '{ file = "sheet.vtu", unit = "mm", periodic = "x" }'):
        case.write_text(SHORT.replace("MESH", mesh), encoding="utf-8")
        found = film_summary(solve_case(load_case(case)))
        assert "seam_is_a_wall" not in {one["name"] for one in found["warnings"]}
        loads.append(found["bearing_load_N"])
    assert loads[1] == pytest.approx(loads[0], rel=1e-9)
    finer = film_summary(solve_case(load_case(case).refined()))
    assert finer["bearing_load_N"] == pytest.approx(loads[0], rel=0.05)


def test_a_seam_that_is_a_wall_is_told(tmp_path, capsys):
    _sheet(tmp_path)
    case = tmp_path / "case.toml"
    case.write_text(SHORT.replace("MESH", '{ file = "sheet.vtu", unit = "mm" }'), encoding="utf-8")
    assert "seam_is_a_wall" in _named(case)
    assert main(["check", str(case)]) == 0
    told = capsys.readouterr().out
    assert "seam_is_a_wall" in told
    assert "radius 25 mm" in told
    held = 'left = { pressure = "0 bar" }\nright = { pressure = "0 bar" }\n'
    case.write_text(case.read_text("utf-8") + held, encoding="utf-8")
    assert "seam_is_a_wall" not in _named(case)


def test_sides_that_do_not_match_are_no_seam(tmp_path):
    _sheet(tmp_path, uneven=0.4)
    case = tmp_path / "case.toml"
    case.write_text(SHORT.replace("MESH", '{ file = "sheet.vtu", unit = "mm", periodic = "x" }'), encoding="utf-8")
    with pytest.raises(InputFaults, match=r"a node on left at y = 2\.5 that right lacks by 0\.4") as raised:
        load_case(case)
    assert [fault.path for fault in raised.value.faults] == ["film.mesh.periodic"]


@pytest.mark.parametrize(
    ("change", "path"), [(("[boundary]", 'load = "1 kN"\n[boundary]'), "film.load"), ((ROUND, RING), "film.geometry")]
)
def test_what_is_no_turn_of_a_cylinder_is_refused(change, path):
    with pytest.raises(InputFaults) as raised:
        sf.film(LONG.replace("RATIO", "0.5").replace(*change))
    assert path in {fault.path for fault in raised.value.faults}
