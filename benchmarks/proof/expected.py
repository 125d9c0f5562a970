"""Outcomes before any diagnosis: the truth of a case, or of a recording that is given with its answer."""

from __future__ import annotations

import json
from pathlib import Path

from .cases import VERDICTS, Case
from .outcome import Outcome
from .recordings import Made

BENCH = Path(__file__).resolve().parents[3] / "shared" / "recordings" / "bench"
GIVEN = "bench"


def of_case(case: Case, made: Made) -> Outcome:
    """The truth of a case."""
    known = [one for one in case.concealed if one.id]
    return Outcome(
        name=case.name, part=case.part.value, campaign=case.campaign, seed=case.seed, asked=case.score,
        score=made.score, sizes=made.sizes, truth=VERDICTS[case.part], effects=tuple(one.id for one in known),
        pairs=tuple(one.pair for one in known), shares=made.shares, true_turn=made.turn,
        shift={name: tuple(round(float(one), 3) for one in moved) for name, moved in made.shift.items()},
    )  # fmt: skip


def of_folder(folder: Path) -> Outcome:
    """The answer in answers.json beside the folder; its score is unknown: 0."""
    answer = json.loads((folder.parent / "answers.json").read_text("utf-8"))[folder.name]
    effects, channels = tuple(answer.get("effects", ())), answer.get("channels", ())
    pairs = (answer.get("pair"), *(None for _ in effects[1:]))[: len(effects)]
    return Outcome(
        name=folder.name, part=GIVEN, campaign=folder.name, seed=0, asked=0.0, score=0.0, sizes={},
        truth=answer["verdict"], effects=effects, pairs=pairs,
        shares={name: 1.0 / len(channels) for name in channels},
    )  # fmt: skip


def given() -> tuple[Path, ...]:
    """The recordings that are given, as far as they are beside the checkout."""
    return tuple(sorted(BENCH.glob("open-*"))) if BENCH.is_dir() else ()
