"""Warnings on a page: every named check has a grade, those of one cause come together, markup stays text."""

import ast
import re
from importlib.resources import files
from pathlib import Path

import pytest

from swashfilm.output.answer import Answer
from swashfilm.output.page import kept, tied, write_page
from swashfilm.output.warnings import GRADES, Grade, causes, counted, grade_of
from system.pump.assembly import PointWarning

ROOT = Path(__file__).parents[3]
NAMED = re.compile(r"([a-z]\w*_\w+): ")
NO_WARNING = {"heldout_rmse", "mass_balance_error"}
"""Starts of docstrings that read like a name."""


def first_text(node):
    """The text with which a string or an f-string begins; None for anything else."""
    if isinstance(node, ast.JoinedStr) and node.values:
        node = node.values[0]
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def named_in(path):
    """Names of warnings in a file: `name: text`, a pair of name and text, {"name": name}, CheckWarning(key, ..)."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if (found := NAMED.match(first_text(node) or "")) and "\n" not in first_text(node):
            yield found[1]
        if isinstance(node, ast.Tuple) and len(node.elts) == 2 and isinstance(node.elts[1], ast.JoinedStr):
            name = first_text(node.elts[0]) or ""
            yield from [name] if re.fullmatch(r"[a-z]+(_[a-z]+)+", name) else []
        if isinstance(node, ast.Dict) and first_text(node.keys[0] if node.keys else None) == "name":
            name = first_text(node.values[0]) or ""
            yield from [name] if re.fullmatch(r"[a-z]+(_[a-z]+)+", name) else []


def stated_keys(path):
    """Keys that a CheckWarning of a file names as a constant."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "CheckWarning":
            yield from [key] if (key := first_text(node.args[0])) and "." in key and key[-1] != "." else []


def sources(*packages):
    return [path for package in packages for path in (ROOT / package).rglob("*.py")]


def test_every_named_warning_has_a_grade():
    names = {name for path in sources("reynolds", "gaps", "system", "swashfilm") for name in named_in(path)}
    names |= {warning.value for warning in PointWarning}
    assert {"load_not_carried", "steps_too_long", "film_hot", "large_error"} <= names
    assert names - NO_WARNING - set(GRADES) == set()


def test_every_key_that_a_check_doubts_by_name_has_a_grade():
    keys = {key for path in sources("system") for key in stated_keys(path)}
    assert "piston.engaged_length" in keys
    assert keys - set(GRADES) - {"oil.bulk_modulus"} == set()  # which needs care: GPa, not MPa?


def test_every_grade_is_of_a_warning_that_the_program_and_its_pages_know():
    code = "".join(path.read_text("utf-8") for path in sources("system", "swashfilm") if path.name != "warnings.py")
    explained = (ROOT / "docs" / "wrong_results.md").read_text("utf-8")
    for name in GRADES:
        assert name.rpartition(".")[2] in code
        assert f"`{name}`" in explained, name


def test_warnings_of_one_cause_come_together_with_their_remedy_once():
    loads = [f"load_not_carried: {part}; push" for part in ("piston: 3 of 4 N", "slipper: 5 of 6 N")]
    told = [*loads, {"name": "film_hot", "text": "130 degC; cool it"}]
    hot, load = causes(told)
    assert (hot.name, hot.grade, hot.remedies) == ("film_hot", Grade.CARE, ("cool it",))
    assert load.texts == ("piston: 3 of 4 N", "slipper: 5 of 6 N")
    assert load.remedies == ("push",)
    assert load.title == "Load not carried, 2 times"


def test_the_line_counts_causes_by_grade():
    told = ["film_hot: x", "load_not_carried: a", "load_not_carried: b", "table_error: c"]
    assert counted(causes(told)) == "3 notes: 1 needs care, 2 limits of the model"
    assert counted(causes(["slipper_lifts: x"])) == "1 note: 1 of the pump's design"


@pytest.mark.parametrize("name", ["piston.engaged_length", "piston.3.engaged_length"])
def test_a_single_part_has_the_grade_of_all(name):
    assert grade_of(name) is Grade.DESIGN


def test_a_page_folds_its_warnings_and_keeps_markup_as_text(tmp_path):
    summary = {"name": "<b>x</b>", "warnings": ["film_hot: <i>130</i> degC; cool it"], "points": 1, "solved": 1}
    content = {"pictures": {}, "rows": [], "failed": [], "case": "", "name": summary["name"]}
    answer = Answer((), "")
    page = write_page(tmp_path, "study", answer=answer, summary=summary, **content).read_text("utf-8")
    assert "1 note: 1 needs care</summary>" in page
    assert "&lt;i&gt;130&lt;/i&gt;" in page
    assert "<b>x</b>" not in page


def test_numbers_stay_with_their_units():
    assert (
        tied("3.2 N m at 4 deg, 1 +- 0.2 mPa s")
        == "3.2\u00a0N\u00a0m at 4\u00a0deg, 1\u00a0+-\u00a00.2\u00a0mPa\u00a0s"
    )


def test_a_tile_breaks_before_a_unit_never_in_it():
    assert kept("338.3 mL/min") == "338.3 mL/min"
    assert kept("3.2 N m") == "3.2 N\u00a0m"
    style = files("swashfilm.output").joinpath("templates", "page.css").read_text("utf-8")
    assert "overflow-wrap: anywhere" not in next(line for line in style.splitlines() if ".tile b {" in line)
