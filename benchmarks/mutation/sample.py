"""The mutations that are tried: a random sample of all edits of the physics, independent of other changes."""

from __future__ import annotations

from itertools import islice
from pathlib import Path

from .edits import Edit, edits, is_program

SHARES = {"reynolds": 0.3, "gaps": 0.25, "system": 0.3, "diagnosis": 0.15}
# Files that read, write, word or draw, and types: their mistakes are no physics.
LEFT_OUT = (
    "errors.py",
    "numerics/files.py",
    "numerics/npz.py",
    "numerics/hdf5.py",
    "/report/",
    "/words",
    "recording/read",
)


def physics(root: Path, package: str) -> list[Path]:
    """The modules of a package that compute."""
    found = sorted((root / package).rglob("*.py"))
    return [path for path in found if not any(part in path.as_posix() for part in LEFT_OUT)]


def sample(root: Path, count: int) -> list[Edit]:
    """`count` edits, shared among the packages by `SHARES`, in an order that mixes them.

    Edits are ordered by the digest of their own text: a sample at random that does not change with other lines.
    """
    chosen = []
    for package, share in SHARES.items():
        programs = (edit for edit in _ordered(root, package) if is_program(edit, (root / edit.file).read_bytes()))
        chosen += [(place / share, edit) for place, edit in enumerate(islice(programs, 1 + int(share * count)))]
    return [edit for _, edit in sorted(chosen, key=lambda one: (one[0], one[1].name))][:count]


def names(root: Path) -> frozenset[str]:
    """The names of all edits of the present sources."""
    return frozenset(edit.name for package in SHARES for edit in _ordered(root, package))


def _ordered(root: Path, package: str) -> list[Edit]:
    found = {}
    for path in physics(root, package):
        for edit in edits(path.relative_to(root).as_posix(), path.read_bytes()):
            found[edit.name] = edit
    return [found[name] for name in sorted(found)]
