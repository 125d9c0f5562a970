"""Results of the check as files: one of the grid's diagnosis, one of the planned campaigns, made where missing."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ..cases import Concealed
from .trial import ByGrid, Pair, Told, Trial, by_grid, tried


def kept_grid(results: Path, one: Concealed, number: int) -> ByGrid:
    """The grid's diagnosis of a case; one of another cause by the same number is made anew."""
    path = results / f"grid-{number:03d}.json"
    if not path.exists() or _grid(path).name != one.label:
        _keep(path, by_grid(one, number))
    return _grid(path)


def kept_trial(results: Path, one: Concealed, number: int, grid: ByGrid) -> Trial:
    """The planned campaigns of a case; those of another cause or of other open pairs are made anew."""
    path = results / f"planned-{number:03d}.json"
    if not path.exists() or not _fits(_trial(path), one, grid):
        _keep(path, tried(one, number, grid))
    return _trial(path)


def _fits(found: Trial, one: Concealed, grid: ByGrid) -> bool:
    return found.name == one.label and [pair.rival for pair in found.pairs] == grid.open


def all_grids(results: Path) -> Iterator[ByGrid]:
    """Every grid's diagnosis, in the order of the cases."""
    return map(_grid, sorted(results.glob("grid-*.json")))


def all_trials(results: Path) -> Iterator[Trial]:
    """The planned campaigns of every case whose grid leaves pairs open, in the order of the cases."""
    return map(_trial, sorted(results.glob("planned-*.json")))


def _keep(path: Path, found: ByGrid | Trial) -> None:
    path.write_text(json.dumps(asdict(found), indent=1), encoding="utf-8")


def _grid(path: Path) -> ByGrid:
    return ByGrid(**json.loads(path.read_text("utf-8")))


def _trial(path: Path) -> Trial:
    data = json.loads(path.read_text("utf-8"))
    pairs = tuple(_pair(one) for one in data["pairs"])
    return Trial(**{**data, "pairs": pairs, "said": tuple(data["said"]), "readings": tuple(data["readings"])})


def _pair(data: dict[str, Any]) -> Pair:
    return Pair(**{**data, "points": Told(**data["points"]), "meter": Told(**data["meter"])})
