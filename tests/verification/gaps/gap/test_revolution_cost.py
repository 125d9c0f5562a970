"""Parts of the program by which `benchmarks/revolution.py` splits the time of a turn."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.revolution import part_of

ROOT = Path(__file__).parents[4]
FOLDERS = {
    "reynolds/linear": "linear solves", "reynolds/laws": "laws of oil, roughness and contact",
    "reynolds/fem": "assembly", "reynolds/floating": "motion", "gaps/revolution": "motion",
}  # fmt: skip


@pytest.mark.parametrize(("folder", "part"), FOLDERS.items(), ids=FOLDERS)
def test_each_module_of_a_folder_is_of_its_part(folder: str, part: str) -> None:
    """Kernels beside their module too."""
    modules = [path for path in (ROOT / folder).rglob("*.py") if path.name != "__init__.py"]
    assert modules
    assert {path.name for path in modules if part_of(f"{path}:function") != part} == set()


def test_loads_are_no_iteration() -> None:
    assert part_of(f"{ROOT}/reynolds/solve/loads.py:loads") == "loads"
    assert part_of(f"{ROOT}/reynolds/solve/solver.py:solve") == "iteration of a film"
    assert part_of("/usr/lib/python3/numpy/core.py:dot") is None
