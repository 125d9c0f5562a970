"""The track record stated by a diagnosis: answers of each kind and certainty, right ones and all."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

from .judged import UNKNOWN, is_named, is_wrong_name, of_class, of_unknown
from .outcome import Claimed, Outcome
from .parts import Part, Plant, plant_of

EDGES = (0.0, 0.8, 0.9, 0.99, 1.0)
"""Bands of the stated probability; the upper edge belongs to the last."""
COMMAND = "python benchmarks/proof.py --record"


def write_record(outcomes: Sequence[Outcome], path: Path) -> None:
    """Write the counts of all parts as JSON; recordings that were available in development do not count.

    A row: answer (name; part, a name that leaves a part of the mismatch; unknown; suspicion; nothing), pump (stated in
    a file, or by its type_plate), band of the stated probability, right ones, cases. A name is right if all its claims
    are concealed, a suspicion if anything is, "nothing" if nothing is. Unknown physics in the class of a claim counts
    neither as its probability nor as right.
    """
    known = {part.value for part in Part}
    counted = [one for one in outcomes if one.part in known and not one.failed]
    found = [(_answer(one), _pump(one), *_band(_stated(one)), _right(one)) for one in counted]
    rows = []
    for key in sorted({one[:4] for one in found}):
        right = [one[4] for one in found if one[:4] == key]
        rows.append(dict(zip(("answer", "pump", "from", "to"), key, strict=True)) | _counts(right))
    lines = ",\n".join(f"  {json.dumps(row)}" for row in rows)
    path.write_text(f'{{"command": "{COMMAND}", "cases": {len(counted)}, "rows": [\n{lines}\n]}}\n', encoding="utf-8")


def _counts(right: Sequence[bool]) -> dict[str, int]:
    return {"right": sum(right), "cases": len(right)}


def _answer(outcome: Outcome) -> str:
    if outcome.status == "suspicion":
        return "suspicion"
    if outcome.verdict in ("no_mismatch", "unknown_physics"):
        return outcome.verdict.removeprefix("no_mismatch").removesuffix("_physics") or "nothing"
    return "part" if outcome.status == "incomplete" else "name"


def _pump(outcome: Outcome) -> str:
    return "type_plate" if plant_of(outcome.part) is Plant.ROUGH else "stated"


def _stated(outcome: Outcome) -> float:
    """The probability of an answer as stated: of a name that of its least certain class."""
    if outcome.claims:
        return min(of_class(outcome, _by_name(one)) for one in outcome.claims)
    if is_named(outcome):
        return of_unknown(outcome)
    return outcome.nothing if outcome.status != "suspicion" else 1.0 - outcome.nothing


def _by_name(claim: Claimed) -> Claimed:
    """A claim whose class has no unknown physics."""
    return replace(claim, equivalent=tuple(one for one in claim.equivalent if one != UNKNOWN))


def _band(probability: float) -> tuple[float, float]:
    return next(band for band in pairwise(EDGES) if probability < band[1] or band[1] == EDGES[-1])


def _right(outcome: Outcome) -> bool:
    if is_named(outcome):
        return not is_wrong_name(replace(outcome, claims=tuple(map(_by_name, outcome.claims))))
    return (outcome.truth == "no_mismatch") == (outcome.verdict == "no_mismatch" and outcome.status != "suspicion")
