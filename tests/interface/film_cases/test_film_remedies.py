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


@pytest.mark.parametrize(("roughness", "told"), [('moving = "6 um"', True), ('composite = "6 um"', False)])
def test_friction_without_the_work_on_the_flanks_is_told(tmp_path, roughness, told):
    """One rough wall that slides, a parallel film of three times its roughness: 19 % of the power has no place."""
    sliding = PRESSED.replace("viscosity", 'velocity = ["1 m/s", "0 m/s"]\nviscosity', 1).replace("1000 bar", "0 bar")
    (tmp_path / "case.toml").write_text(f"{sliding}[roughness]\n{roughness}\n", "utf-8")
    found = film_summary(solve_case(load_case(tmp_path / "case.toml")))
    assert (found["energy_balance_error"] > 0.1) is told
    assert any(one["name"] == "friction_of_rough_walls" for one in found["warnings"]) is told
