"""Outcomes in a folder, one file a case, named by the case's content: an interrupted proof continues where it was."""

from __future__ import annotations

import ast
import json
import tomllib
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from hashlib import sha256
from pathlib import Path

import grimp

from reynolds.numerics.files import replaced

from .cases import Case
from .other import VERSION as OTHER_VERSION
from .outcome import Outcome, as_plain, from_plain
from .parts import Plant
from .plant import VERSION as FIRST_VERSION
from .rough import VERSION as ROUGH_VERSION
from .wide.case import WideCase

HERE = Path(__file__).resolve().parent
PACKAGES = ("diagnosis", "system", "gaps", "reynolds")
ASKED = (
    "diagnosis.checks.check",
    "diagnosis.procedure.recorded",
    "diagnosis.procedure.next_test",
    "diagnosis.recording.reader",
    "diagnosis.study.acceptance",
    "diagnosis.study.inputs",
    "diagnosis.study.scaled.levels",
    "diagnosis.study.prepare",
    "system.pump_file.file",
    "system.description.tolerances",
)
"""Modules of a diagnosis; all their imports count, too."""
TRIERS = (
    "trial.py", "wide/trial.py", "expected.py", "oracle.py", "worth.py", "rivals.py", "baselines.py", "film_trial.py",
    "real.py",
)  # fmt: skip
"""Function that tries a case and keeps its outcome."""
VERSIONS = {Plant.FIRST: FIRST_VERSION, Plant.OTHER: OTHER_VERSION, Plant.ROUGH: ROUGH_VERSION}


def name_of(case: Case | WideCase) -> str:
    """The file of a case, by its definition and the version of its plant: no place or form of a source counts."""
    made = sha256(repr((case.definition, VERSIONS[case.part.plant])).encode()).hexdigest()[:16]
    return f"{case.part.value}-{case.seed}-{made}.json"


def name_of_folder(folder: Path) -> str:
    """The file of a recording that is given, by its content."""
    found = sha256(b"".join(path.read_bytes() for path in sorted(folder.iterdir())))
    return f"bench-{folder.name}-{found.hexdigest()[:16]}.json"


@cache
def counted() -> frozenset[str]:
    """The modules on which a verdict depends."""
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    return frozenset(ASKED).union(*(graph.find_upstream_modules(name) for name in ASKED)) - set(PACKAGES)


@cache
def program() -> str:
    """Digest of all inputs of an outcome, with thresholds and pump; an outcome of another program is marked."""
    root = HERE.parents[1]
    modules = [root.joinpath(*name.split(".")).with_suffix(".py") for name in sorted(counted())]
    data = [path for name in PACKAGES for path in sorted((root / name).rglob("*.toml"))]
    tried = [HERE / name for name in TRIERS]
    return _digest([path for path in modules if path.exists()] + data + tried)[:12]


def load(folder: Path, name: str) -> Outcome | None:
    """The outcome kept under a name, or None."""
    path = folder / name
    return from_plain(json.loads(path.read_text("utf-8"))) if path.exists() else None


def outcomes(folder: Path, listed: Iterable[Case | WideCase]) -> list[Outcome]:
    """The outcomes of these cases that a folder has; those of other draws and of earlier plants stay apart."""
    return [found for case in listed if (found := load(folder, name_of(case))) is not None]


def keep(folder: Path, name: str, outcome: Outcome) -> None:
    """Write an outcome whole or not at all."""
    folder.mkdir(parents=True, exist_ok=True)
    with replaced(folder / name) as beside:
        beside.write_text(json.dumps(as_plain(outcome), indent=1), encoding="utf-8")


def _digest(places: list[Path]) -> str:
    found = sha256()
    for place in places:
        for path in sorted([place] if place.is_file() else place.rglob("*.*")):
            if path.suffix in MEANING:
                found.update(path.name.encode() + MEANING[path.suffix](path.read_text("utf-8")).encode())
    return found.hexdigest()


def _code(text: str) -> str:
    """A module without comments, docstrings and layout."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            node.body = [each for each in node.body if not _is_words(each)] or [ast.Pass()]
    return ast.unparse(tree)


def _is_words(statement: ast.stmt) -> bool:
    """True for a string that stands alone: a docstring of a module, class, function or name."""
    found = statement.value if isinstance(statement, ast.Expr) else None
    return isinstance(found, ast.Constant) and isinstance(found.value, str)


def _values(text: str) -> str:
    """A table without comments and layout."""
    return json.dumps(tomllib.loads(text), sort_keys=True, default=str)


MEANING: Mapping[str, Callable[[str], str]] = {".py": _code, ".toml": _values}
"""The relevant content of a file, by its suffix, without comments."""
