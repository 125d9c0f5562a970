"""Warnings of a film name remedies that its case does not have yet."""

import pytest

from swashfilm.case.file import load_case
from swashfilm.runs.film.checks.validity import beyond_oil
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary

PRESSED = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "10 mm"], cells = [8, 8] }
thickness = "20 um"
viscosity = "30 mPa s"
cavitation = "none"
[boundary]
left = { pressure = "1000 bar" }
right = { pressure = "1000 bar" }
"""
HALF_SPACE = """[elastic]
moving = { kind = "half_space", youngs_modulus = "210 GPa", poissons_ratio = 0.3 }
"""


@pytest.mark.parametrize(("tables", "told"), [("", True), (HALF_SPACE, False)])
def test_elastic_walls_are_no_remedy_for_a_film_that_has_them(tmp_path, tables, told):
    (tmp_path / "case.toml").write_text(PRESSED + tables, "utf-8")
    warnings = {
        one["name"]: one["text"] for one in film_summary(solve_case(load_case(tmp_path / "case.toml")))["warnings"]
    }
    assert "pressure_law in [oil]" in warnings["viscosity_without_pressure"]
    assert ("elastic walls" in warnings["viscosity_without_pressure"]) is told
    assert ("elastic walls" in beyond_oil(2e9, elastic=bool(tables))[1]) is told
