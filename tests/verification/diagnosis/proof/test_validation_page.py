"""The committed validation page holds the cases that the tests assert, and no others."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[4]
PAGE = ROOT / "docs" / "validation.md"
RECORDERS = ("validation", "energy_balances")
"""Fixtures of tests/conftest.py that record rows."""


def _cases_in_tests() -> set[str]:
    found = set()
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in RECORDERS:
                case = next(word.value for word in node.keywords if word.arg == "case")
                assert isinstance(case, ast.Constant), f"{path.name}:{node.lineno}: case must be a literal"
                found.add(case.value)
    return found


def _cases_on_page() -> set[str]:
    rows = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
    return {row.split("|")[1].strip() for row in rows} - {"case"}


def test_page_is_not_stale(request):
    if request.config.getoption("validation_page"):
        pytest.skip("the page is being written")
    command = "python -m pytest -m '' --validation-page=docs/validation.md"
    assert _cases_on_page() == _cases_in_tests(), f"write it anew: {command}"
