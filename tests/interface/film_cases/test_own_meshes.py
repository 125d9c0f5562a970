"""Meshes of one's own in a pump file: what is read, and what is wrong with one, all at once with the remedy."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np
import pytest

from swashfilm.case.file import load_case
from swashfilm.runs.film.series.films import study_digest
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system import Fault, InputFaults, check_pump, floating_parts, load_pump, resolved_toml
from system.points.table.store import pump_key

EXAMPLE = Path(__file__).parents[3] / "examples" / "films" / "slipper.vtu"
OWN = {"mesh": str(EXAMPLE), "unit": "mm"}


def faults_of(body: dict[str, object], table: str = "slipper") -> dict[str, Fault]:
    with pytest.raises(InputFaults) as raised:
        load_pump("ref90", {f"{table}.body": body})
    return {fault.path.removeprefix(f"{table}.body."): fault for fault in raised.value.faults}


def test_example_stands_for_the_slipper(tmp_path):
    pump = load_pump("ref90", {"slipper.body": OWN})
    own = floating_parts(pump).slipper.laws.walls.parts[0].own
    assert (own.path, own.film, own.held) == (EXAMPLE, "film", ("held",))
    assert own.pressed == (("pocket", "pocket"),)
    assert not [warning for warning in check_pump(pump).warnings if "body" in warning.path]
    file = tmp_path / "pump.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump


def test_a_file_beside_the_pump_file(tmp_path):
    text = resolved_toml(load_pump("ref90")) + '\n[slipper.body]\nmesh = "slipper.vtu"\nunit = "mm"\n'
    (tmp_path / "pump.toml").write_text(text, "utf-8")
    (tmp_path / "slipper.vtu").write_bytes(EXAMPLE.read_bytes())
    assert load_pump(tmp_path / "pump.toml").slipper.body.mesh.path == tmp_path / "slipper.vtu"


@pytest.mark.parametrize(
    ("change", "key", "found", "expected", "nearest"),
    [
        ({"mesh": str(EXAMPLE.with_name("sliper.vtu"))}, "mesh", "no file", "a file beside", "slipper.vtu"),
        ({"mesh": str(EXAMPLE.with_name("step_pad.vtu"))}, "mesh", "holds quad", "one of hexahedron27", ""),
        ({"unit": "furlong"}, "unit", "'furlong'", "one of 'm', 'cm'", ""),
        ({"unit": "m"}, "unit", "a face 29600 mm wide", "29.6 mm", "unit = 'mm'"),
        ({"unit": "in"}, "unit", "a face 751.8 mm wide", "29.6 mm", "unit = 'mm'"),
        ({"film": "flim"}, "film", "'flim'", "film, held, pocket", "film"),
        ({"held": ["hold"]}, "held", "'hold'", "film, held, pocket", "held"),
        ({"held": "held"}, "held", "'held'", "a list of names", ""),
        ({"pocket": "pockt"}, "pocket", "'pockt'", "film, held, pocket", "pocket"),
        ({"film": "held"}, "film", "no face under them", "z = 0 from radius 7.4 mm to 14.8 mm", ""),
        ({"surface": "film"}, "surface", "unknown key", "mesh, unit, film", ""),
    ],
)
def test_what_is_wrong_with_a_mesh(change, key, found, expected, nearest):
    fault = faults_of(OWN | change)[key]
    assert found in fault.found
    assert expected in fault.expected
    assert nearest in fault.nearest


def test_all_that_is_wrong_at_once():
    assert set(faults_of(OWN | {"film": "flim", "held": ["hold"], "pocket": "well"})) == {"film", "held", "pocket"}


@pytest.mark.parametrize(
    ("move", "found", "nearest"),
    [
        (lambda p: np.add(p, (0.0, 0.0, 20.0)), "z 20 mm to 20 mm", "the mesh moved by (0 mm, 0 mm, -20 mm)"),
        (lambda p: p * [1.0, 1.0, -1.0], "no face under them", "the other side of the film"),
        (lambda p: p * [0.9, 0.9, 1.0], "mm from its nearest node", ""),
    ],
)
def test_a_mesh_that_lies_elsewhere(move, found, nearest, tmp_path):
    raw = meshio.read(EXAMPLE)
    raw.points = move(raw.points)
    raw.write(tmp_path / "moved.vtu")
    fault = faults_of(OWN | {"mesh": str(tmp_path / "moved.vtu")})["film"]
    assert found in fault.found
    assert nearest in fault.nearest


def test_what_is_doubtful_about_a_mesh(tmp_path):
    """Coarse, held nowhere, and no face for the pocket's pressure; what is then taken is told."""
    angle = np.arange(6) * np.pi / 3.0
    rings = [(r * np.cos(angle), r * np.sin(angle), np.full(6, z)) for z in (-4.0, 0.0) for r in (7.0, 15.5)]
    points = np.hstack(rings).T
    k, after = np.arange(6), (np.arange(6) + 1) % 6
    lower = np.column_stack([k, k + 6, after + 6, after])
    solid = np.hstack([lower, lower + 12])
    mark = {"film": [np.ones(6, dtype=int), np.zeros(6, dtype=int)]}
    meshio.write_points_cells(
        tmp_path / "coarse.vtu", points, [("quad", lower + 12), ("hexahedron", solid)], cell_data=mark
    )
    pump = load_pump("ref90", {"slipper.body": {"mesh": str(tmp_path / "coarse.vtu"), "unit": "mm"}})
    told = " ".join(str(warning) for warning in check_pump(pump).warnings if "slipper.body" in warning.path)
    assert "facets of" in told
    assert "no face 'pocket'" in told
    assert "no face held" in told
    assert "a free body" in " ".join(map(str, floating_parts(pump).taken))


def test_a_mesh_that_has_changed_is_another_pump(tmp_path):
    """A result that is kept by content is not taken for a pump whose mesh has changed since."""
    file = tmp_path / "slipper.vtu"
    file.write_bytes(EXAMPLE.read_bytes())
    before = load_pump("ref90", {"slipper.body": OWN | {"mesh": str(file)}})
    keys = [pump_key(before), repr(before)]
    raw = meshio.read(file)
    raw.points[:, :2] *= 1.0001
    raw.write(file)
    after = load_pump("ref90", {"slipper.body": OWN | {"mesh": str(file)}})
    assert pump_key(after) != keys[0]
    assert repr(after) != keys[1]
    assert pump_key(load_pump("ref90")) != keys[0]


def test_block_and_plate_are_closed_rings(tmp_path):
    """A face with a port through it is told with the remedy."""
    fault = faults_of(OWN | {"film": "pocket"}, "valve_plate")["film"]
    assert "no face under them" in fault.found
    assert "kidneys and ports filled" in fault.expected


FREE = """
format = 1
[film]
mesh = { kind = "annulus", inner_radius = "8.2 mm", outer_radius = "14 mm", cells = [2, 12] }
thickness = "10 um"
viscosity = "0.03 Pa s"
[boundary]
inner = { pressure = "10 MPa" }
outer = { pressure = "0 MPa" }
[elastic.fixed]
mesh = "MESH"
unit = "mm"
face = "film"
clamped = ["held"]
youngs_modulus = "110 GPa"
poissons_ratio = 0.34
"""


def test_a_free_film_on_a_mesh_in_its_unit(tmp_path):
    """The same example under a film that is no gap of a pump; in metres it does not lie under it."""
    file = tmp_path / "own.toml"
    file.write_text(FREE.replace("MESH", str(EXAMPLE)), "utf-8")
    summary = film_summary(solve_case(load_case(file)))
    assert 0.1e-6 < summary["deformation_max_m"] < 10e-6
    file.write_text(file.read_text("utf-8").replace('unit = "mm"\n', ""), "utf-8")
    with pytest.raises(InputFaults, match="no face under them"):
        load_case(file)


def test_a_study_knows_the_content_of_a_body_file(tmp_path):
    """Points of a study under another body of the same file name are not taken from an earlier run."""
    mesh, keys = meshio.read(EXAMPLE), []
    (tmp_path / "own.toml").write_text(FREE.replace("MESH", "own.vtu"), "utf-8")
    for thicker in (1.0, 1.1):
        mesh.points[:, 2] *= thicker
        mesh.write(tmp_path / "own.vtu")
        keys.append(study_digest(load_case(tmp_path / "own.toml")))
    assert keys[0] != keys[1]
