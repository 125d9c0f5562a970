"""The order of test files for an edit: those first that import the edited module, or an importer of it."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from .compiled_code import imports, module_name
from .sample import SHARES

FARTHER = 0.3  # weight of a module that is one import farther from the edit
SAME_FOLDER = 0.05  # weight of a part of the path that test and module share


class Nearness:
    """Imports of all modules and test files, read once."""

    def __init__(self, root: Path):
        self._lazy = {package: _lazy_names(root / package / "__init__.pyi") for package in SHARES}
        tests = sorted((root / "tests").rglob("test_*.py"))
        self._tests = {path.relative_to(root).as_posix(): frozenset(self._imported(path)) for path in tests}
        self._users = Counter(module for modules in self._tests.values() for module in modules)

    def order(self, file: str) -> list[str]:
        """All test files, the nearest first: a module that few tests import weighs most."""
        weights, parts = _weights(module_name(file)), set(Path(file).with_suffix("").parts)
        marks = {
            test: sum(weights.get(module, 0.0) / self._users[module] for module in modules)
            + SAME_FOLDER * len(parts & set(Path(test).parts)) ** 2
            for test, modules in self._tests.items()
        }
        return sorted(marks, key=lambda test: (-marks[test], test))

    def _imported(self, path: Path) -> Iterator[str]:
        """Modules whose names a test file imports, through the lazy names of a package."""
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module:
                known = self._lazy.get(node.module, {})
                yield from (known.get(one.name, node.module) for one in node.names)


def _weights(module: str) -> Mapping[str, float]:
    """1 for the module, `FARTHER` for its importers, the square for theirs, and so on."""
    weights, last, weight = {module: 1.0}, {module}, 1.0
    while last:
        weight *= FARTHER
        last = {user for one in last for user in imports().find_modules_that_directly_import(one)} - weights.keys()
        weights |= dict.fromkeys(last, weight)
    return weights


def _lazy_names(stub: Path) -> Mapping[str, str]:
    """Full name of the module of each name that a package exports."""
    found: dict[str, str] = {}
    for node in ast.parse(stub.read_text("utf-8")).body:
        if isinstance(node, ast.ImportFrom) and node.module:
            inner = node.module if node.level == 0 else f"{stub.parent.name}.{node.module}"
            found |= {one.asname or one.name: inner for one in node.names}
    return found
