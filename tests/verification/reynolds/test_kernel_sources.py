"""Compiled code of earlier sources is discarded."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import reynolds
from reynolds.compiled.kernel_sources import STAMP, discard_stale, kept_in

ROOT = Path(reynolds.__file__).parents[1]
KERNEL = """
from numba import njit
from film.constants import HALF

@njit(cache=True)
def value(x):
    return HALF * x
"""
FILES = {
    "film/__init__.py": "",
    "film/constants.py": "HALF = 0.5\n",
    "film/kernels.py": KERNEL,
    "film/sums.py": "from numba import njit\nfrom film import kernels\n",
    "film/others.py": "from numba import njit\nfrom film.plain import (\n    A,\n)\n",
    "film/plain.py": "from film.constants import HALF\nA = 1\n",
}


@pytest.fixture(params=["beside", "apart"])
def tree(request, tmp_path, monkeypatch):
    """Sources, whose compiled code numba keeps beside them, or in a folder of the user's choice."""
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    if request.param == "apart":
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kept"))
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    return tmp_path


def test_users_of_a_changed_file_are_found(tree):
    """Directly and through other compiled functions; a second time nothing has changed."""
    assert len(discard_stale(tree, ["film"])) == 3
    assert discard_stale(tree, ["film"]) == []
    (tree / "film/constants.py").write_text("HALF = 0.25\n")
    assert sorted(discard_stale(tree, ["film"])) == ["film/kernels.py", "film/sums.py"]
    (tree / "film/plain.py").write_text("A = 2\n")
    assert discard_stale(tree, ["film"]) == ["film/others.py"]


def test_kept_code_goes_with_its_module_alone(tree):
    discard_stale(tree, ["film"])
    home = kept_in(tree / "film")
    kept = [home / f"{name}-3.py311.{end}" for name in ("kernels.value", "others.sum") for end in ("nbi", "1.nbc")]
    for path in kept:
        path.touch()
    (tree / "film/constants.py").write_text("HALF = 0.25\n")
    discard_stale(tree, ["film"])
    assert [path.exists() for path in kept] == [False, False, True, True]


def test_a_broken_stamp_keeps_nothing(tree):
    discard_stale(tree, ["film"])
    (kept_in(tree / "film") / STAMP).write_text("[1, 2")
    assert len(discard_stale(tree, ["film"])) == 3


def test_the_program_has_discarded_what_was_stale():
    """As it is imported; it knows the loops that call others, and the ports' files."""
    assert discard_stale(ROOT) == []
    known = (kept_in(ROOT / "reynolds") / STAMP).read_text()
    assert "reynolds/compiled/balance_kernels.py" in known
    assert "system/pump/ports/areas.py" in known


@pytest.mark.slow
def test_a_compiled_function_has_the_constants_of_today(tree):
    """Numba's own place of kept code is the one that is cleared."""
    clearing = "from pathlib import Path; kernel_sources.discard_stale(Path.cwd(), ['film'])"
    printing = (
        f"from reynolds.compiled import kernel_sources; {clearing}; from film.kernels import value; print(value(8.0))"
    )
    places = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), str(tree)])}

    def printed() -> str:
        command = [sys.executable, "-c", printing]
        return subprocess.run(command, cwd=tree, env=places, capture_output=True, text=True, check=True).stdout.strip()

    assert printed() == "4.0"
    assert list(kept_in(tree / "film").glob("kernels.value-*.nbi"))
    (tree / "film/constants.py").write_text("HALF = 0.25\n")
    assert printed() == "2.0"
