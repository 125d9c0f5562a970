"""Outcomes that are kept: a line of JSON each, of a case that was solved twice the last one."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from reynolds.numerics.files import append_whole

from .trial import Fate, Outcome

KEPT = Path(__file__).with_name("outcomes.jsonl")


def read_outcomes(path: Path) -> list[Outcome]:
    """Return the outcomes of a file, none where there is no file."""
    if not path.is_file():
        return []
    lines = map(json.loads, path.read_text("utf-8").splitlines())
    found = {(one["kind"], one["number"]): one for one in lines}
    return [Outcome(**one | {"fate": Fate(one["fate"])}) for one in found.values()]


def write_outcome(path: Path, one: Outcome) -> None:
    """Add an outcome to the file, whole or not at all."""
    append_whole(path, json.dumps(asdict(one)).encode() + b"\n")
