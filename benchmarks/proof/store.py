"""Outcomes in a folder, one file a case, named by what the case is: an interrupted proof goes on where it was."""

from __future__ import annotations

import json
from functools import cache
from hashlib import sha256
from pathlib import Path

from .cases import Case
from .outcome import Outcome, as_plain, from_plain

HERE = Path(__file__).resolve().parent
PACKAGES = ("system", "diagnosis")
MAKERS = ("plant", "campaigns.py", "sensors.py", "sizing.py", "recordings.py", "writing.py")


def key(case: Case) -> str:
    """Of a case and the plant that makes it: another size, seed, sensor or law is another file."""
    return sha256(f"{case!r} {_digest([HERE / name for name in MAKERS])}".encode()).hexdigest()[:16]


@cache
def program() -> str:
    """Of the program that diagnoses: an outcome made by another one is told as such."""
    root = HERE.parents[1]
    return _digest([root / name for name in PACKAGES])[:12]


def load(folder: Path, case: Case) -> Outcome | None:
    """The outcome of a case, None where there is none yet."""
    path = _path(folder, case)
    return from_plain(json.loads(path.read_text("utf-8"))) if path.exists() else None


def keep(folder: Path, case: Case, outcome: Outcome) -> None:
    """Write an outcome whole or not at all."""
    folder.mkdir(parents=True, exist_ok=True)
    path = _path(folder, case)
    fresh = path.with_suffix(".tmp")
    fresh.write_text(json.dumps(as_plain(outcome), indent=1), encoding="utf-8")
    fresh.replace(path)


def _path(folder: Path, case: Case) -> Path:
    return folder / f"{case.part.value}-{case.seed}-{key(case)}.json"


def _digest(places: list[Path]) -> str:
    found = sha256()
    for place in places:
        for path in sorted([place] if place.is_file() else place.rglob("*.*")):
            if path.suffix in (".py", ".toml"):
                found.update(path.name.encode() + path.read_bytes())
    return found.hexdigest()
