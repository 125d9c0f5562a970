"""Truths of a split: the concealed causes of each recording, as a file, and its seal."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import Path

from proof.outcome import Outcome


@dataclass(frozen=True)
class Truth:
    """The concealed cause in a recording.

    verdict: as an answer has it; ids, gaps: those of a right answer, "" for no gap; beside: ids of faults beside it,
    which may be named too. score: detectability z; sizes: of the concealed causes, SI.
    """

    recording: str
    plant: str
    part: str
    verdict: str
    ids: tuple[str, ...]
    gaps: tuple[str, ...]
    beside: tuple[str, ...]
    score: float
    sizes: Mapping[str, float]


def truth_of(recording: str, plant: str, expected: Outcome) -> Truth:
    """Return the truth of a recording from the proof's expectation of it."""
    gaps = tuple(pair or "" for pair in expected.pairs)
    return Truth(recording, plant, expected.part, expected.truth, expected.effects, gaps, expected.beside,
                 round(expected.score, 3), dict(expected.sizes))  # fmt: skip


def write_truths(path: Path, truths: list[Truth]) -> str:
    """Write the truths of a split and return the seal: the SHA-256 of the file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps([asdict(one) for one in truths], indent=1) + "\n", encoding="utf-8")
    return seal(path)


def read_truths(path: Path) -> list[Truth]:
    """Return the truths of a file of `write_truths`."""
    rows = json.loads(path.read_text("utf-8"))
    return [Truth(**row | {key: tuple(row[key]) for key in ("ids", "gaps", "beside")}) for row in rows]


def seal(path: Path) -> str:
    """Return the SHA-256 of a file."""
    return sha256(path.read_bytes()).hexdigest()
