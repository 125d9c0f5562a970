"""Films whose thickness does not go with their extent: told before they are solved, and by `check`."""

import meshio
import numpy as np
import pytest

from swashfilm.__main__ import main
from swashfilm.case.file import load_case
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system import InputFaults

CASE = """
format = 1
[film]
mesh = MESH
thickness = THICKNESS
viscosity = "30 mPa s"
velocity = ["1 m/s", "0 m/s"]
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""
BUILT = '{ kind = "rectangle", size = ["10 mm", "10 mm"], cells = [8, 8] }'


def written(folder, mesh=BUILT, thickness="10 um", thick=1e-5):
    """Write a case, and a mesh of 10 x 10 mm with coordinates in mm and `thick` as film thickness at its points."""
    line = np.linspace(0.0, 10.0, 9)
    x, y = (part.ravel() for part in np.meshgrid(line, line))
    corner = np.add.outer(9 * np.arange(8), np.arange(8)).ravel()
    cells = np.stack([corner, corner + 1, corner + 10, corner + 9], axis=1)
    data = {"film_thickness": np.full(81, thick)}
    meshio.write_points_cells(
        folder / "in_mm.vtu", np.stack([x, y, 0.0 * x], axis=1), [("quad", cells)], point_data=data
    )
    (folder / "case.toml").write_text(CASE.replace("MESH", mesh).replace("THICKNESS", f'"{thickness}"'), "utf-8")
    return folder / "case.toml"


def warned(case) -> dict[str, str]:
    return {one["name"]: one["text"] for one in film_summary(solve_case(load_case(case)))["warnings"]}


@pytest.mark.parametrize(
    ("mesh", "thickness"),
    [('{ file = "in_mm.vtu", unit = "mm" }', "film_thickness"), (BUILT, "10 + x"), (BUILT, "1 m")],
)
def test_a_film_thicker_than_its_extent_is_refused_before_it_is_solved(tmp_path, capsys, mesh, thickness):
    case = written(tmp_path, mesh, thickness, thick=10.0)
    with pytest.raises(InputFaults, match="times the film's extent of 10 mm") as raised:
        load_case(case)
    assert [fault.path for fault in raised.value.faults] == ["film.thickness"]
    assert main(["check", str(case)]) == 2
    assert "is it in um? times 1e-6" in capsys.readouterr().err


def test_check_has_the_warning_of_a_film_that_is_not_thin(tmp_path, capsys):
    assert main(["check", str(written(tmp_path, thickness="1 mm"))]) == 0
    assert "warning: film_not_thin: the mean film is 0.1 of" in capsys.readouterr().out


def test_a_mesh_in_millimetres_is_told_with_the_key_of_its_unit(tmp_path, capsys):
    case = written(tmp_path, '"in_mm.vtu"', "film_thickness")
    text = warned(case)["film_extent_unlikely"]
    assert "10 m wide (limit 2 m)" in text
    assert 'unit = "mm" }' in text
    assert main(["check", str(case)]) == 0
    assert "warning: film_extent_unlikely: " in capsys.readouterr().out
    mended = written(tmp_path, '{ file = "in_mm.vtu", unit = "mm" }', "film_thickness")
    assert "film_extent_unlikely" not in warned(mended)


def test_a_film_of_less_than_a_millionth_of_its_extent_is_told(tmp_path):
    assert (
        "the mean film is 5e-07 of its extent (limit 1e-06)"
        in warned(written(tmp_path, thickness="5 nm"))["film_extent_unlikely"]
    )


@pytest.mark.parametrize(("unit", "metres"), [("mm", 1e-3), ("in", 25.4e-3), ("cm", 1e-2)])
def test_the_unit_of_a_mesh_file_scales_its_coordinates_alone(tmp_path, unit, metres):
    found = load_case(written(tmp_path, f'{{ file = "in_mm.vtu", unit = "{unit}" }}', "film_thickness"))
    space = found.problem.space
    assert np.ptp(space.vertices, axis=0) == pytest.approx([10.0 * metres] * 2)
    assert found.problem.film.thickness == pytest.approx(1e-5)
    finer = found.refined()
    assert np.ptp(finer.problem.space.vertices, axis=0) == pytest.approx([10.0 * metres] * 2)
    (tmp_path / "again.toml").write_text(found.resolved, "utf-8")
    assert load_case(tmp_path / "again.toml").resolved == found.resolved


def test_a_unit_that_is_none_is_told_at_its_key(tmp_path):
    with pytest.raises(InputFaults) as raised:
        load_case(written(tmp_path, '{ file = "in_mm.vtu", unit = "furlong" }'))
    assert [fault.path for fault in raised.value.faults] == ["film.mesh.unit"]
