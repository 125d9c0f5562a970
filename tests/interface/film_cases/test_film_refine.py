"""Mesh convergence: the report of numbers on finer meshes, and that finer meshes are the same film."""

import csv
import json
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest
import skfem
from bench_pump import BENCH
from slider_case import slider_case

import swashfilm as sf
from reynolds import Cell, annulus, film_space, mesh_from_file, rectangle
from reynolds.fem.mesh import FilmMesh, loop_names
from reynolds.fem.mesh_check import mesh_faults
from reynolds.fem.refine import refine_mesh
from reynolds.numerics.convergence import ConvergenceKind, convergence
from swashfilm.__main__ import main
from swashfilm.output.headline import sizes
from swashfilm.output.refinement import Refinement, refinement_rows, refinement_summary

SLIDER = slider_case('"10 mm", "10 mm"', "16, 2")
LOAD = 0.15888308 * 0.03 * 0.01**2 / 1e-5**2 * 0.01  # closed form (Rayleigh 1918), n = 2


@pytest.mark.parametrize("order", [1.0, 2.0])
def test_a_power_law_gives_its_order_and_its_limit(order):
    found = convergence([5.0 + 0.3 * 2.0 ** (-order * k) for k in range(4)], (1.0, 2.0), 5.0)
    assert found.verdict is ConvergenceKind.CONVERGING
    assert found.order == pytest.approx(order)
    assert found.extrapolated == pytest.approx(5.0)
    assert found.error == pytest.approx(1.25 * 0.3 * 2.0 ** (-3 * order))


@pytest.mark.parametrize(
    ("values", "verdict", "order"),
    [
        ([1.0, 1.0, 1.0], ConvergenceKind.CONVERGED, None),
        ([1.0, 2.0, 2.1], ConvergenceKind.DOUBTFUL, pytest.approx(3.32, abs=0.01)),
        ([1.0, 1.5, 1.2], ConvergenceKind.OSCILLATING, pytest.approx(0.74, abs=0.01)),
        ([1.0, 1.5, 1.5], ConvergenceKind.OSCILLATING, None),
        ([1.0, 1.1, 1.2], ConvergenceKind.NONE, None),
        ([1.0, 1.0, 1.2], ConvergenceKind.NONE, None),
        ([1.0, 1.1, 0.9], ConvergenceKind.NONE, None),
        ([1.0, 1.1], ConvergenceKind.ASSUMED, None),
    ],
)
def test_what_does_not_converge_as_expected_says_so(values, verdict, order):
    found = convergence(values, (2.0, 2.0), 1.0)
    assert (found.verdict, found.order) == (verdict, order)
    if verdict is ConvergenceKind.NONE:
        assert found.extrapolated is None
        assert found.error is None
    else:
        assert abs(found.extrapolated - values[-1]) <= found.error


def test_a_number_that_is_round_off_beside_the_others_of_its_unit_has_no_order():
    """A contact load of 1e-87 N beside a load of 47 N; a contact of 1 N has its order."""
    for contact, verdict in ((1e-87, ConvergenceKind.CONVERGED), (1.0, ConvergenceKind.OSCILLATING)):
        values = [one * contact for one in (2.0, 0.8, 0.98)]
        size = sizes({"load_N": 47.0, "contact_load_N": values[-1]}, {})["contact_load_N"]
        found = convergence(values, (1.0, 2.0), size)
        assert found.verdict is verdict
        shown = refinement_summary(Refinement((9, 36, 144), (1.0, 2.0), {"contact_load_N": found}))
        assert (next(refinement_rows(shown))[1:4] == ("0", "0", "0")) == (contact < 1.0)


def test_a_doubtful_order_costs_the_larger_safety():
    assert convergence([1.0, 2.0, 2.1], (2.0, 2.0), 1.0).error == pytest.approx(3.0 * 0.1 / 3.0)
    assert convergence([1.0, 1.3], (2.0, 2.0), 1.0).error == pytest.approx(3.0 * 0.3 / 3.0)


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("build", [rectangle, annulus])
def test_a_finer_mesh_keeps_area_names_and_data(cell, build):
    coarse = build((2.0, 1.0), (3, 2), cell=cell) if build is rectangle else build(1.0, 2.0, (2, 8), cell=cell)
    finer = refine_mesh(coarse)
    fine = finer.film_mesh
    assert fine.boundary_names == coarse.boundary_names
    assert not mesh_faults(fine.mesh.p.T, fine.mesh.t.T)
    for name in coarse.boundary_names:
        ends = [mesh.p[:, mesh.facets[:, mesh.boundaries[name]]] for mesh in (coarse.mesh, fine.mesh)]
        lengths = [np.hypot(*(end[:, 1] - end[:, 0])) for end in ends]
        # Edges of an eighth of a turn are arcs: half of one has the chord 2 r sin(pi/16).
        longer = 1.0 if build is rectangle else 2.0 * np.sin(np.pi / 16.0) / np.sin(np.pi / 8.0)
        assert lengths[1].sum() == pytest.approx(longer * lengths[0].sum())
        assert len(lengths[1]) == 2 * len(lengths[0])
    centres = coarse.mesh.p[:, coarse.mesh.t].mean(axis=1)
    children = fine.mesh.p[:, fine.mesh.t].mean(axis=1).reshape(2, 4, -1).mean(axis=1)
    np.testing.assert_allclose(children, centres, atol=0.05 if build is annulus else 1e-12)
    x, y = fine.mesh.p
    moved = np.hypot(finer.point_data(coarse.mesh.p[0]) - x, finer.point_data(coarse.mesh.p[1]) - y) > 1e-12
    assert moved.sum() == (0 if build is rectangle else 16)  # of middles of edges on the two circles
    data = finer.point_data(3.0 * coarse.mesh.p[0] - coarse.mesh.p[1])
    np.testing.assert_allclose(data[~moved], (3.0 * x - y)[~moved], atol=1e-12)
    assert len(finer.cell_data(np.arange(coarse.mesh.nelements))) == fine.mesh.nelements


def _uneven_ring(turn: float, cell: Cell) -> FilmMesh:
    """A ring, or a part of one, with edges of unequal length about a centre off the origin."""
    radial, around = 4, 24
    angle = turn * (
        np.arange(around + 1) + 0.3 * np.sin(np.arange(around + 1) * 7.0) * (np.arange(around + 1) % around > 0)
    )
    angle /= around
    radius = np.linspace(0.01, 0.02, radial + 1)
    points = np.stack([np.outer(radius, np.cos(angle)) + 0.1, np.outer(radius, np.sin(angle)) - 0.2]).reshape(2, -1)
    i, j = (part.ravel() for part in np.meshgrid(np.arange(radial), np.arange(around), indexing="ij"))
    at, wide = i * (around + 1) + j, around + 1
    quads = np.vstack([at, at + wide, at + wide + 1, at + 1])
    if turn == 2.0 * np.pi:  # the last angle is the first
        quads = np.where(quads % wide == around, quads - around, quads)
        used, quads = np.unique(quads, return_inverse=True)
        points, quads = points[:, used], quads.reshape(4, -1)
    mesh = skfem.MeshQuad(np.ascontiguousarray(points), np.ascontiguousarray(quads))
    mesh = mesh if cell is Cell.QUADRILATERAL else mesh.to_meshtri()
    return FilmMesh(replace(mesh, _boundaries=loop_names(mesh)))


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("turn", [2.0 * np.pi, 1.3])
def test_a_finer_mesh_has_its_round_edges_on_their_circles(cell, turn):
    """The area of the ring is missed by a fourth with each mesh; its straight edges stay straight."""
    meshes = [_uneven_ring(turn, cell)]
    for _ in range(2):
        meshes.append(refine_mesh(meshes[-1]).film_mesh)
    areas = [float(film_space(one).area.sum()) for one in meshes]
    exact = 0.5 * turn * (0.02**2 - 0.01**2)
    missed = [exact - area for area in areas]
    assert missed[1] / missed[0] == pytest.approx(0.25, abs=0.02)
    assert missed[2] / missed[1] == pytest.approx(0.25, abs=0.02)
    edge = meshes[-1].mesh.p[:, np.unique(meshes[-1].mesh.facets[:, meshes[-1].mesh.boundary_facets()])]
    x, y = edge[0] - 0.1, edge[1] + 0.2
    radius = np.hypot(x, y)
    round_ = np.minimum(np.abs(radius - 0.01), np.abs(radius - 0.02)) < 1e-9
    straight = np.minimum(np.abs(y), np.abs(x * np.sin(1.3) - y * np.cos(1.3))) < 1e-12
    assert (round_ | straight).all()


@pytest.mark.parametrize("corners", [3, 4, 6])
def test_a_polygon_stays_one(corners):
    """A film of few straight sides, each one edge long, is no circle though its corners lie on one."""
    angle = 2.0 * np.pi * np.arange(corners) / corners
    points = np.column_stack([[0.0, 0.0], *np.stack([np.cos(angle), np.sin(angle)]).T])
    around = np.arange(corners)
    cells = np.vstack([0 * around, 1 + around, 1 + (around + 1) % corners])
    coarse = FilmMesh(skfem.MeshTri(np.ascontiguousarray(points), cells))
    fine = refine_mesh(coarse).film_mesh
    assert film_space(fine).area.sum() == pytest.approx(film_space(coarse).area.sum(), rel=1e-12)


def test_the_bar_of_a_ring_from_a_file_counts_its_round_edges(tmp_path, monkeypatch):
    """Flow through a ring: pi h^3 dp/(6 mu ln(r2/r1))."""
    monkeypatch.chdir(tmp_path)
    mesh = _uneven_ring(2.0 * np.pi, Cell.TRIANGLE).mesh
    meshio.write_points_cells(
        "ring.vtu", np.column_stack([mesh.p.T, np.zeros(mesh.nvertices)]), [("triangle", mesh.t.T)]
    )
    Path("ring.toml").write_text(
        'format = 1\n[film]\nmesh = "ring.vtu"\nthickness = "20 um"\nviscosity = "30 mPa s"\n[boundary]\n'
        'inner = { pressure = "50 bar" }\nouter = { pressure = "0 bar" }\n',
        encoding="utf-8",
    )
    assert main(["film", "ring.toml", "--refine", "3", "-o", "run"]) == 0
    flow = json.loads(Path("run/summary.json").read_text("utf-8"))["refinement"]["numbers"]["flow_m3_per_s.outer"]
    exact = np.pi * (20e-6) ** 3 * 5e6 / (6.0 * 0.03 * np.log(2.0))
    assert abs(flow["extrapolated"] - exact) <= flow["error"] < 1e-3 * exact


def test_a_slider_on_three_meshes_tends_to_the_closed_form(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("slider.toml").write_text(SLIDER, encoding="utf-8")
    assert main(["film", "slider.toml", "--refine", "3", "-o", "run"]) == 0
    summary = json.loads(Path("run/summary.json").read_text("utf-8"))
    found = summary["refinement"]["numbers"]["load_N"]
    assert found["values"][0] == summary["load_N"]
    assert found["order"] == pytest.approx(2.0, abs=0.05)
    assert abs(found["extrapolated"] - LOAD) <= found["error"]
    with open("run/refinement.csv", encoding="utf-8") as file:
        rows = {row["number"]: row for row in csv.DictReader(file)}
    assert rows["load"]["unit"] == "N"
    assert float(rows["load"]["limit"]) == pytest.approx(found["extrapolated"], rel=1e-7)
    assert "converges as expected" in capsys.readouterr().out
    assert "Finer meshes" in Path("run/report.html").read_text("utf-8")


WARM = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["20 mm", "1 mm"], cells = [20, 1], periodic = "y" }
thickness = "1e-5*(2 - x/0.02)"
velocity = ["25 m/s", "0 m/s"]
[oil]
grade = "ISO VG 46"
density = "860 kg/m3"
temperature = "40 degC"
specific_heat = "1950 J/(kg K)"
thermal_conductivity = "0.13 W/(m K)"
[thermal]
fixed_wall = "adiabatic"
moving_wall = { temperature = "40 degC" }
levels = LEVELS
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""


def test_the_bar_of_a_warm_film_counts_its_levels():
    """Two levels across a film err by 3 % of the load, which finer cells alone would not see."""
    fine = sf.film(WARM.replace("LEVELS", "12").replace("[20, 1]", "[160, 1]")).load
    found = sf.film(WARM.replace("LEVELS", "2"), refine=3).summary["refinement"]["numbers"]
    assert abs(found["load_N"]["extrapolated"] - fine) <= found["load_N"]["error"] < 0.01 * fine
    assert "heat_balance_error" not in found


def test_data_of_a_mesh_file_go_along(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mesh = rectangle((0.01, 0.01), (10, 2), cell=Cell.QUADRILATERAL).mesh
    inlet = mesh.p[0, mesh.t].mean(axis=0) < 0.007
    meshio.write_points_cells(
        "step.vtu",
        np.column_stack([mesh.p.T, np.zeros(mesh.nvertices)]),
        [("quad", mesh.t.T)],
        point_data={"mu": np.full(mesh.nvertices, 0.03)},
        cell_data={"h": [np.where(inlet, 2e-5, 1e-5)]},
    )
    assert mesh_from_file(Path("step.vtu")).boundary_names
    text = SLIDER.partition("[film]")[0] + (
        '[film]\nmesh = "step.vtu"\nthickness = "h"\nviscosity = "mu"\nvelocity = ["1 m/s", "0 m/s"]\n[boundary]\n'
        'left = { pressure = "0 bar" }\nright = { pressure = "0 bar" }\n'
    )
    Path("step.toml").write_text(text, encoding="utf-8")
    assert main(["film", "step.toml", "--refine", "2", "-o", "run"]) == 0
    found = json.loads(Path("run/summary.json").read_text("utf-8"))["refinement"]["numbers"]["load_N"]
    assert found["values"] == pytest.approx([60.9677, 60.9677], rel=1e-5)  # Rayleigh's step is exact on either mesh
    assert found["verdict"] == "converged to round-off"


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--refine", "1"], ["--refine", "'1'", "2 to 5"]),
        (["--refine", "three"], ["--refine", "2 to 5"]),
        (["--refin", "3"], ["--refin", "try:      --refine"]),
    ],
)
def test_a_wrong_number_of_meshes_is_told(words, told, tmp_path, capsys):
    path = tmp_path / "slider.toml"
    path.write_text(SLIDER, encoding="utf-8")
    assert main(["film", str(path), *words]) == 2
    text = capsys.readouterr().err
    for word in told:
        assert word in text, text


def test_a_gap_of_a_pump_has_finer_meshes_too(tmp_path):
    path = tmp_path / "gap.toml"
    text = f'format = 1\n[film]\ngap = "slipper"\npump = "{BENCH}"\n[position]\nfilm_thickness = "9 um"\n'
    path.write_text(text + 'slope_x = "0.01 deg"\n', encoding="utf-8")
    assert main(["film", str(path), "--refine", "3", "-o", str(tmp_path / "run")]) == 0
    found = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))["refinement"]
    assert found["dofs"] == [577, 2305, 9217]
    assert found["numbers"]["load_N"]["order"] == pytest.approx(2.0, abs=0.1)


def test_what_cannot_be_refined_is_told(tmp_path, capsys):
    path = tmp_path / "fine.toml"
    path.write_text(SLIDER.replace("[16, 2]", "[400, 200]"), encoding="utf-8")
    assert main(["film", str(path), "--refine", "5"]) == 2
    assert "at most 10000000 cells" in capsys.readouterr().err


SQUEEZED = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "1 mm"], cells = [16, 1], periodic = "y" }
thickness = "1e-5*(1.25 + 0.5*cos(4*pi*t))"
viscosity = "30 mPa s"
[time]
end = "0.5 s"
step = "50 ms"
[boundary]
left = { pressure = "0.5 bar" }
right = { pressure = "0.5 bar" }
"""


def test_the_bar_of_a_transient_counts_its_time_step(tmp_path):
    """A strip squeezed to and fro: F/W = -mu L^3 (dh/dt)/h^3 + p0 L at each instant of the full film."""
    path = tmp_path / "squeezed.toml"
    path.write_text(SQUEEZED, encoding="utf-8")
    assert main(["film", str(path), "--refine", "4", "-o", str(tmp_path / "run")]) == 0
    found = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))["refinement"]
    assert found["time_steps"] == [10, 20, 40, 80]
    angle = np.linspace(0.0, np.pi, 10001)
    film, closing = 1e-5 * (1.25 + 0.5 * np.cos(angle)), 2e-5 * np.pi * np.sin(angle)
    most = float(np.max(0.03 * 0.01**3 * closing / film**3 * 0.001) + 0.5e5 * 0.01 * 0.001)
    peak = found["numbers"]["load_of_time_max_N"]
    assert abs(peak["extrapolated"] - most) <= peak["error"] < 0.1 * most
    assert abs(peak["values"][0] - most) > 0.2 * most
    assert not {"time_steps", "mass_balance_error_of_time"} & set(found["numbers"])
    assert "half the time step" in (tmp_path / "run" / "report.html").read_text("utf-8")


def test_a_transient_of_too_many_steps_is_told(tmp_path, capsys):
    path = tmp_path / "squeezed.toml"
    path.write_text(SQUEEZED.replace("50 ms", "1 us"), encoding="utf-8")
    assert main(["film", str(path), "--refine", "3"]) == 2
    assert "at most 1000000 steps" in capsys.readouterr().err


HALF_SPACE = """
format = 1
[film]
mesh = { kind = "annulus", inner_radius = "1 mm", outer_radius = "10 mm", cells = [12, 16] }
thickness = "20 um"
viscosity = "30 mPa s"
cavitation = "none"
[elastic]
moving = { kind = "half_space", youngs_modulus = "210 GPa", poissons_ratio = 0.3 }
[boundary]
inner = { pressure = "100 bar" }
outer = { pressure = "0 bar" }
"""


def test_half_spaces_beyond_the_memory_are_refused_before_they_are_solved(tmp_path, monkeypatch, capsys):
    path = tmp_path / "case.toml"
    path.write_text(HALF_SPACE, encoding="utf-8")
    needed = 4 * 8 * (13 * 16) ** 2
    for place in ("reynolds.bodies.foundation", "swashfilm.runs.film.refine"):
        monkeypatch.setattr(f"{place}.physical_memory", lambda: 20.0 * needed)
    assert main(["film", str(path), "--refine", "3"]) == 2
    told = capsys.readouterr().err
    assert "3328 unknowns, each of which deforms all others: about 0.354 GB" in told
    assert "plate, disc, ring" in told
    assert main(["film", str(path), "--refine", "2", "-o", str(tmp_path / "run")]) == 0
    told = capsys.readouterr().err
    assert "mesh 2 of 2, its fields and walls" in told
    assert "mesh 2 of 2, 800 unknowns" in told
    monkeypatch.setattr("reynolds.bodies.foundation.physical_memory", lambda: 0.5 * needed)
    assert main(["film", str(path)]) == 2
    assert "elastic.moving" in capsys.readouterr().err
