"""Sections through a film: cuts through its outstanding places, in data, table and picture."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.runs.film.fields.history import last_of
from swashfilm.runs.film.fields.sections import HIGHEST, LEAST, places, section_figure, sections

SLIDER = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "6 mm"], cells = [32, 16] }
thickness = "1e-5*(2 - x/0.01)"
velocity = ["1 m/s", "0 m/s"]
viscosity = "30 mPa s"
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
top = { pressure = "0 bar" }
bottom = { pressure = "0 bar" }
"""
RING = """
format = 1
[film]
mesh = { kind = "annulus", inner_radius = "5 mm", outer_radius = "10 mm", cells = [16, 48] }
thickness = "10 um"
viscosity = "30 mPa s"
[boundary]
inner = { pressure = "10 bar" }
outer = { pressure = "0 bar" }
"""


def solved(text: str, place: Path) -> tuple[Path, tuple]:
    (place / "case.toml").write_text(text, encoding="utf-8")
    assert main(["film", str(place / "case.toml"), "-o", str(place / "run")]) == 0
    return place / "run", sections(last_of(sf.open(place / "run").to_xarray()))


def test_cuts_run_through_the_highest_pressure_and_the_least_film(tmp_path):
    folder, found = solved(SLIDER, tmp_path)
    assert [(one.place, one.cut.words) for one in found] == [(HIGHEST, "x"), (HIGHEST, "y"), (LEAST, "x"), (LEAST, "y")]
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    for one, axis in zip(found[:2], (0, 1), strict=True):
        assert one.cut.at == pytest.approx(1e3 * summary["pressure_max_at_m"][axis])
        assert np.nanmax(one.values["film_pressure"]) == pytest.approx(summary["pressure_max_Pa"])
    along = found[0]
    assert along.values["film_thickness_cell"] == pytest.approx(1e-5 * (2.0 - along.cut.x / 0.01))
    assert found[3].values["film_thickness_cell"] == pytest.approx(np.full(len(found[3].cut.y), 1e-5), rel=1e-4)
    with (folder / "sections.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == sum(len(one.cut.x) for one in found)
    assert max(float(row["film_pressure [MPa]"]) for row in rows) == pytest.approx(summary["pressure_max_Pa"] * 1e-6)
    page = (folder / "report.html").read_text("utf-8")
    assert "on the left along x, on the right along y." in page
    assert page.count('class="touch"') == 3


def test_a_ring_is_cut_along_its_radius_and_round_it(tmp_path):
    """p = p0 ln(r/R)/ln(r0/R) between parallel walls; an even film has no place that is thinnest."""
    _, (radial, round_) = solved(RING, tmp_path)
    assert (radial.cut.words, round_.cut.words) == ("the radius", "the circumference")
    radius = np.hypot(radial.cut.x, radial.cut.y)
    exact = 1e6 * np.log(radius / 0.01) / np.log(0.5)
    assert radial.values["film_pressure"] == pytest.approx(exact, abs=0.01 * 1e6)
    assert np.isfinite(round_.values["film_pressure"]).all()
    assert np.ptp(np.hypot(round_.cut.x, round_.cut.y)) == pytest.approx(0.0, abs=1e-12)
    assert np.ptp(np.degrees(np.unwrap(np.arctan2(round_.cut.y, round_.cut.x)))) == pytest.approx(360.0)


def test_of_equally_thin_places_that_of_the_highest_pressure_counts(tmp_path):
    folder, _ = solved(SLIDER.replace("1e-5*(2 - x/0.01)", "1e-5*(1 + 2*(x < 0.004))"), tmp_path)
    fields = last_of(sf.open(folder).to_xarray())
    least = places(fields)[LEAST]
    thin = fields["film_thickness"].values < 1.01e-5
    at = np.argmax(np.where(thin, fields["film_pressure"].values, -np.inf))
    assert least == pytest.approx([float(fields["x"][at]), float(fields["y"][at])])


def test_an_axisymmetric_ring_is_even_round_its_circumference(tmp_path):
    """Between its vertices a circle has their pressure: chords of the cells, nearer to the middle, have another."""
    coarse = RING.replace("[16, 48]", "[16, 12]")
    _, (_, round_) = solved(coarse, tmp_path)
    assert round_.values["film_pressure"] == pytest.approx(np.full(len(round_.cut.x), 1e6), rel=1e-5)
    middle = coarse.replace("format = 1", "format = 1\n[constants]\nr0 = 7e-3").replace(
        '"10 um"', '"1e-5 + 1e-3*abs(sqrt(x**2 + y**2) - r0)"'
    )
    (tmp_path / "middle").mkdir()
    found = solved(middle, tmp_path / "middle")[1]
    _, _, _, least = found
    assert (least.place, least.cut.words) == (LEAST, "the circumference")
    assert np.isfinite(least.values["film_pressure"]).all()
    for name in ("film_pressure", "film_thickness_cell"):
        assert least.values[name] == pytest.approx(np.full(len(least.cut.x), least.values[name][0]), rel=1e-4)


def test_a_triangle_ring_is_even_round_its_circumference_too(tmp_path):
    text = RING.replace("[16, 48]", '[16, 12], cell = "triangle"')
    _, (_, round_) = solved(text, tmp_path)
    assert round_.values["film_pressure"] == pytest.approx(np.full(len(round_.cut.x), 1e6), rel=1e-5)


def test_the_names_of_the_lines_stand_below_each_other(tmp_path):
    """On a narrow page names side by side would lie on each other."""
    _, found = solved(SLIDER, tmp_path)
    legend = section_figure(found).axes[-2].get_legend()
    assert legend._ncols == 1
    assert len(legend.get_texts()) == 2


def test_a_cut_along_a_held_edge_is_level(tmp_path):
    """The highest pressure of a ring is that of its inner edge: round-off along the edge is no wave."""
    _, found = solved(RING.replace('"10 um"', '"1e-5 + where(abs(phi) < 0.2, 2e-5, 0)"'), tmp_path)
    pressure, thickness = section_figure(found).axes[1], section_figure(found).axes[3]
    assert pressure.get_ylim()[0] < 0.6 < 1.4 < pressure.get_ylim()[1]  # MPa; from 1 to 0 along the radius
    assert thickness.get_ylim()[1] < 40.0
