"""Option --sensitivity: numbers, fields and picture of the derivatives by the film, and what it refuses."""

import json
import runpy
from pathlib import Path

import meshio
import numpy as np
import pytest
import xarray

import swashfilm as sf
from reynolds import InputError
from swashfilm.__main__ import main
from swashfilm.case.file import load_case
from swashfilm.runs.film.solve import growth
from swashfilm.runs.film.solve.gap import case_gap
from swashfilm.runs.film.solve.study import solve_case

SLIDER = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "10 mm"], cells = [32, 2], periodic = "y" }
thickness = "h0*(1 + slope*(1 - x/0.01)) + ripple*sin(pi*x/0.01)**2"
velocity = ["1 m/s", "0 m/s"]
viscosity = "30 mPa s"
[constants]
h0 = "10 um"
slope = 1.0
ripple = "0 um"
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""
EXAMPLES = Path(__file__).parents[3] / "examples" / "films"
SLIPPER = """
format = 1
gap = "slipper"
pump = "ref90"
shaft_angle = "270 deg"
[position]
film_thickness = "12 um"
slope_x = "0.02 deg"
[physics]
walls = "{walls}"
"""


@pytest.fixture
def case(tmp_path):
    """A case file of a text."""

    def written(text, name="slider"):
        path = tmp_path / f"{name}.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return written


def _with(text, **constants):
    for name, value in constants.items():
        old = next(line for line in text.splitlines() if line.startswith(f"{name} = "))
        text = text.replace(old, f"{name} = {value}")
    return text


def test_a_film_has_no_tilt_along_a_seam_or_around_a_cylinder():
    """It would jump where the film closes on itself."""
    found = sf.film(SLIDER, sensitivity="load").summary["sensitivity"]
    assert "by_slope_x_rad" in found["outputs"]["load_N"]
    assert "by_slope_y_rad" not in found["outputs"]["load_N"]
    assert list(found["left_out"]) == ["slope_y_rad"]
    turn = SLIDER.replace(', periodic = "y"', "").replace("velocity", 'geometry = "cylinder"\nvelocity', 1)
    found = sf.film(turn, sensitivity="bearing_load").summary["sensitivity"]
    assert "by_slope_y_rad" in found["outputs"]["bearing_load_N"]
    assert list(found["left_out"]) == ["slope_x_rad"]


def test_derivatives_by_constants_of_the_shape_are_slopes_of_the_outputs(case):
    found = sf.film(case(SLIDER), sensitivity="load,flow.left,friction,dissipation").summary
    outputs = found["sensitivity"]["outputs"]
    assert found["sensitivity"]["kept"] == "position"
    for name, step, unit in (("h0", 1e-3, "um"), ("slope", 1e-4, ""), ("ripple", 1e-3, "um")):
        base = found["sensitivity"]["parameters"][f"constants.{name}"] * (1e6 if unit else 1.0)
        more, less = (
            sf.film(case(_with(SLIDER, **{name: f'"{base + sign * step} {unit}"' if unit else base + sign * step})))
            for sign in (1.0, -1.0)
        )
        width = 2.0 * step * (1e-6 if unit else 1.0)
        for key, of in (
            ("load_N", lambda one: one["load_N"]),
            ("flow_m3_per_s.left", lambda one: one["flow_m3_per_s"]["left"]),
            ("friction_N", lambda one: abs(one["friction_force_moving_N"][0])),
            ("dissipation_W", lambda one: one["dissipation_W"]),
        ):
            expected = (of(more.summary) - of(less.summary)) / width
            assert outputs[key][f"by_constants.{name}"] == pytest.approx(expected, rel=1e-5)


def test_fields_and_page_of_the_run_folder(case, tmp_path):
    folder = tmp_path / "run"
    assert main(["film", str(case(SLIDER)), "--sensitivity", "load,flow.left", "--csv", "-o", str(folder)]) == 0
    outputs = json.loads((folder / "summary.json").read_text("utf-8"))["sensitivity"]["outputs"]
    mesh = meshio.read(folder / "film.vtu")
    field = mesh.point_data["sensitivity_load [(N)/m3]"]
    (block,) = mesh.cells
    share = np.full(block.data.size, 1e-4 / block.data.size)  # cells of one size
    area = np.bincount(block.data.ravel(), share, len(field))
    assert float(field @ area) == pytest.approx(outputs["load_N"]["by_film_thickness_m"], rel=1e-9)
    with xarray.open_dataset(folder / "results.nc", engine="h5netcdf") as data:
        assert data["sensitivity_flow_left"].attrs["units"] == "(m3/s)/m3"
        assert data["sensitivity_load"].values == pytest.approx(field)
    page = (folder / "report.html").read_text("utf-8")
    assert "Where a micrometre counts" in page
    assert "per um" in page
    assert "sensitivity_load [(N)/m3]" in (folder / "fields.csv").read_text("utf-8")


def test_finer_meshes_beside_derivatives(case):
    found = sf.film(case(SLIDER), sensitivity="load", refine=3)
    assert set(found.summary["sensitivity"]["outputs"]) == {"load_N"}
    assert "load_N" in found.summary["refinement"]["numbers"]


def test_python_gives_tables_and_pictures(case):
    run = sf.film(case(SLIDER), sensitivity=["load"])
    assert any(title.startswith("Sensitivity") for title, _ in run.tables())
    assert len(run.plot_sensitivity()) == 2  # with its colour bar
    assert sf.film(case(SLIDER)).plot_sensitivity() == []


def test_a_film_under_a_load_keeps_it(case):
    """h0 is taken up by the separation; the loss depends on slope and ripple at held load."""
    text = SLIDER.replace("velocity", 'load = "40 N"\nvelocity', 1)
    found = sf.film(case(text), sensitivity="dissipation").summary["sensitivity"]
    assert found["kept"] == "load"
    by = found["outputs"]["dissipation_W"]
    assert "by_film_thickness_m" not in by
    more, less = (sf.film(case(_with(text, ripple=f'"{size} um"'))).summary["dissipation_W"] for size in (0.1, -0.1))
    assert by["by_constants.ripple"] == pytest.approx((more - less) / 0.2e-6, rel=2e-3)


@pytest.mark.parametrize("walls", ["rigid", "elastic"])
def test_gaps_of_a_pump_by_their_position_and_shapes(case, walls):
    path = case(SLIPPER.format(walls=walls), "slipper")
    found = sf.film(path, sensitivity="load,flow.case,friction_torque").summary["sensitivity"]["outputs"]
    read, step = load_case(path), 1e-9
    gap = case_gap(read)
    near = solve_case(read).solution

    def load(change):
        solved = gap.held_at(read.shaft_angle, read.position + np.array([change, 0.0, 0.0])).balanced
        return float(np.sum(solved.pressure @ gap.film.space.lumped(np.ones((1, 1)))))

    expected = (load(step) - load(-step)) / (2.0 * step)
    assert found["load_N"]["by_film_thickness_m"] == pytest.approx(expected, rel=1e-4)
    assert near.problem.walls is None  # as it is written: of its deformed shape
    assert any(key.startswith("by_face_") for key in found["load_N"])


def test_a_parameter_without_a_derivative_is_named_with_the_reason(case, monkeypatch):
    """Below zero a root is no number; a shape ends beside its value."""
    text = SLIDER.replace("h0*(1", "h0*(sqrt(edge) + 1", 1).replace("[constants]", "[constants]\nedge = 0.0")
    run = sf.film(case(text), sensitivity="load")
    found = run.summary["sensitivity"]
    assert found["left_out"] == {
        "slope_y_rad": "the film closes on itself along y",
        "constants.edge": "the thickness beside its value is no number",
    }
    assert "by_constants.h0" in found["outputs"]["load_N"]
    assert ("every output", "edge", "left out: the thickness beside its value is no number", "") in run.tables()[-1][1]

    def ends(shape, value):
        raise InputError("edge relief", "no width", "two places apart")

    monkeypatch.setattr(growth, "_differences", ends)
    left_out = sf.film(case(SLIPPER.format(walls="rigid"), "slipper"), sensitivity="load").summary["sensitivity"]
    why = left_out["left_out"]["face_edge_relief_end_m"]
    assert why == "its value is at an end of its range: edge relief: no width; expected two places apart"


def test_the_example_finds_rayleighs_step(capsys):
    """0.2064 mu U B^2/h^2 per width at a step of 1.866 (Rayleigh 1918), from a wedge of 0.1602."""
    found = runpy.run_path(str(EXAMPLES / "shape_by_gradient.py"))
    assert "step  0: load 48.05 N, 0.1602" in capsys.readouterr().out
    assert 0.2060 < found["load"].value / found["unit"] < 0.2064
    assert 1e6 * found["thickness"][8, 0] == pytest.approx(18.66, abs=0.2)


@pytest.mark.parametrize(
    ("names", "told"),
    [
        ("lod", "try:      load"),
        ("flow.bottom", "a boundary with a pressure"),
        ("load,contact_load", "outputs of this film: load, moment_x"),
        (",", "outputs of this film"),
    ],
)
def test_outputs_that_a_film_does_not_have_are_told_with_the_valid_ones(case, capsys, names, told):
    between_sides = SLIDER.replace(', periodic = "y"', "")  # bottom and top are closed
    assert main(["film", str(case(between_sides)), "--sensitivity", names]) == 2
    assert told in capsys.readouterr().err


@pytest.mark.parametrize(
    ("example", "told"),
    [
        ("oscillating_squeeze", "a steady film"),
        ("warm_slider", "a film without it"),
        ("stribeck_study", "a single film"),
    ],
)
def test_films_without_an_adjoint_are_refused_with_the_remedy(capsys, example, told):
    assert main(["film", str(EXAMPLES / f"{example}.toml"), "--sensitivity", "load"]) == 2
    assert told in capsys.readouterr().err


def test_a_cavity_that_may_open_anywhere_warns(case):
    """A parallel film at the cavitation pressure."""
    text = _with(SLIDER, slope=0.0)
    names = [one["name"] for one in sf.film(case(text), sensitivity="load").summary["warnings"]]
    assert "weakly_active_cavity" in names
    names = [one["name"] for one in sf.film(case(SLIDER), sensitivity="load").summary["warnings"]]
    assert "weakly_active_cavity" not in names
