"""The order of test files for an edit: those first that speak of the edited module or of what uses it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from .sample import SHARES

WORD = re.compile(r"[A-Za-z_][A-Za-z_0-9]{3,}")
DEFINED = re.compile(r"^(?:class|def|async def)\s+([A-Za-z_0-9]+)|^([A-Z_][A-Z_0-9]+)\s*[:=]", re.MULTILINE)
FARTHER = 0.3  # weight of a name that is one module farther from the edit


class Nearness:
    """Words of all modules and test files, read once."""

    def __init__(self, root: Path):
        modules = [path for package in SHARES for path in (root / package).rglob("*.py")]
        self._defined = {_place(path, root): _defined(path.read_text()) for path in modules}
        self._used = {_place(path, root): _words(path) for path in modules}
        self._tests = {_place(path, root): _words(path) for path in (root / "tests").rglob("test_*.py")}

    def order(self, file: str) -> list[str]:
        """All test files, the nearest first: a name that few tests speak of weighs most."""
        weights = self._names(file)
        spoken = {name: sum(name in words for words in self._tests.values()) for name in weights}
        marks = {
            test: sum(weights[name] / spoken[name] for name in words & weights.keys()) + 0.01 * _shared_path(test, file)
            for test, words in self._tests.items()
        }
        return sorted(marks, key=lambda test: (-marks[test], test))

    def _names(self, file: str) -> Mapping[str, float]:
        """Names of the module, and of the modules that use it, three steps far."""
        weights = dict.fromkeys(self._defined[file], 1.0)
        reached, weight = {file}, 1.0
        for _ in range(3):
            weight *= FARTHER
            users = {user for user, words in self._used.items() if user not in reached and words & weights.keys()}
            reached |= users
            weights = {name: weight for user in users for name in self._defined[user]} | weights
        return weights


def _place(path: Path, root: Path) -> str:
    return path.relative_to(root).as_posix()


def _words(path: Path) -> frozenset[str]:
    return frozenset(WORD.findall(path.read_text()))


def _defined(text: str) -> frozenset[str]:
    return frozenset(name for pair in DEFINED.findall(text) for name in pair if len(name) > 3)


def _shared_path(test: str, file: str) -> int:
    parts = set(Path(file).with_suffix("").parts)
    return len(parts & set(Path(test).parts))
