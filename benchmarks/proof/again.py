"""Outcomes of an earlier state of the program, some of them drawn at random and tried by the present state."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from reynolds.numerics.files import replaced

from .calibration import wilson
from .outcome import Outcome
from .store import program

FILE = "again.json"


@dataclass(frozen=True)
class Again:
    """Cases drawn at random from the outcomes of earlier states, tried by the state `program`.

    same: by the name of its file, whether the present outcome has the verdict, status and claims of the earlier one.
    """

    program: str
    same: Mapping[str, bool]


def draw(known: Mapping[str, Outcome], count: int) -> Iterator[str]:
    """`count` names of outcomes of earlier states, in an order that the present state determines."""
    earlier = sorted(name for name, one in known.items() if one.program != program())
    order = np.random.default_rng(int(program(), 16)).permutation(len(earlier))
    return (earlier[at] for at in order[:count])


def told_alike(one: Outcome, other: Outcome) -> bool:
    """True if verdict, status and claimed effects with their gaps are the same."""
    return _finding(one) == _finding(other)


def keep_again(folder: Path, name: str, same: bool) -> None:
    """Add a case to those of the present state; those of an earlier state go."""
    known = load_again(folder)
    found = Again(program(), {**(known.same if known else {}), name: same})
    with replaced(folder / FILE) as beside:
        beside.write_text(json.dumps(asdict(found), indent=1), encoding="utf-8")


def load_again(folder: Path) -> Again | None:
    """The cases tried again by the present state, None without any."""
    path = folder / FILE
    found = Again(**json.loads(path.read_text("utf-8"))) if path.exists() else None
    return found if found is not None and found.program == program() else None


def sentence(folder: Path) -> str:
    """The sentence of the page: the share of the same findings with Wilson's interval; empty without a case."""
    found = load_again(folder)
    if found is None:
        return ""
    hits, count = sum(found.same.values()), len(found.same)
    low, high = wilson(hits, count)
    return (
        f"Of the cases of earlier states {count} were drawn at random and tried by the present one: {hits} with the "
        f"same verdict, status and names ({low:.0%} to {high:.0%}).\n"
    )


def _finding(one: Outcome) -> tuple[str, str, Sequence[tuple[str, str | None]]]:
    return one.verdict, one.status, sorted((each.effect, each.pair or "") for each in one.claims)
