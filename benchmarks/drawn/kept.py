"""Outcomes that are kept: a line of JSON each, of a case that was solved twice the last one."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from reynolds.numerics.files import append_whole, json_lines

from .trial import Fate, Outcome

KEPT = Path(__file__).with_name("outcomes.jsonl")


def read_outcomes(path: Path) -> list[Outcome]:
    """Return the outcomes of a file, none without a file."""
    found = {(one["kind"], one["number"]): one for one in json_lines(path)}
    return [Outcome(**one | {"fate": Fate(one["fate"])}) for one in found.values()]


def write_outcome(path: Path, one: Outcome) -> None:
    """Add an outcome to the file."""
    append_whole(path, json.dumps(asdict(one)).encode() + b"\n")
