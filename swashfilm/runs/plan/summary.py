"""Summary of a plan's run: SI, indices of suspects from 0."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.next_point.meters import ALWAYS
from diagnosis.planning.design import Equipped, Purpose, driven
from diagnosis.planning.never import Never
from diagnosis.planning.plan import Plan
from swashfilm.formats.versions import headed
from swashfilm.runs.plan.case import PlanCase
from swashfilm.runs.plan.limits import AXES
from system.bench.points import BenchPoints

INPUTS = ("speed", "p_out", "displacement_ratio", "T_case", "T_in", "p_in", "p_case")


def plan_summary(case: PlanCase, found: Plan, unseen: tuple[str, ...], seconds: float) -> dict[str, Any]:
    """Return the summary. unseen: names of asked suspects that no meter of the bench shows at all."""
    before, after, never = found.told_planned, found.told, found.never
    return {
        **headed("plan"),
        "name": case.pump.name,
        "pairs": len(found.pairs),
        "told_planned": len(before),
        "told": len(after),
        "never": len(never),
        "open": len(found.open),
        "apart_sigma": found.wanted,
        "cost_of_efficiency": case.asked.cost,
        "planned_points": len(case.asked.planned.speed),
        "planned_readings": int(case.asked.repeats.sum()),
        "added_readings": len(found.added),
        "most_added": found.most,
        "spent": found.is_spent,
        "nats": list(found.totals),
        "suspects": [_suspect(found, at) for at in range(len(found.suspects))],
        "not_shown": list(unseen),
        "distances": found.after.tolist(),
        "distances_planned": found.before.tolist(),
        "distances_ever": found.ever.tolist(),
        "points": list(_points(found, found.counts, found.added)),
        "box": {name: list(ends) for name, ends in zip(AXES, case.box.ends, strict=False)},
        "sensors": list(_sensors(case, found)),
        "further": [
            {"name": one.name, "words": one.words, "pairs": [list(pair) for pair in one.pairs]}
            for one in found.worths
        ],
        "equipped": None if found.equipped is None else _equipped(found, found.equipped),
        "never_apart": [_never(one) for one in never],
        "open_pairs": [list(pair) for pair in sorted(found.open, key=lambda pair: found.after[pair])],
        "warnings": [],
        "cost": {"processor_s": seconds},
    }  # fmt: skip


def _suspect(found: Plan, at: int) -> dict[str, Any]:
    own = found.suspects[at]
    return {
        "name": own.name, "words": own.words, "kind": own.hypothesis.kind.value, "size": own.size,
        "costs_efficiency": own.costs, "capped": own.capped, "seen_sigma": float(found.seen[at]),
        "shows_in": found.shows[at],
    }  # fmt: skip


def _points(found: Plan, counts: NDArray[np.int64], added: Sequence[Purpose]) -> Iterator[dict[str, Any]]:
    """Yield every point to drive of so many readings at each, in its order."""
    purposes: dict[int, list[list[int]]] = {}
    for one in added:
        purposes.setdefault(one.point, []).extend([list(pair) for pair in one.pairs])
    points: BenchPoints = found.points
    for number, at in enumerate(driven(counts, points), start=1):
        unique = [list(pair) for pair in dict.fromkeys(tuple(pair) for pair in purposes.get(int(at), []))]
        yield {
            "order": number,
            **{name: float(getattr(points, name)[at]) for name in INPUTS},
            "repeats": int(counts[at]),
            "planned": int(found.planned[at]),
            "for": unique,
        }


def _equipped(found: Plan, own: Equipped) -> dict[str, Any]:
    """The campaign with the requested meters."""
    return {
        "meters": [{"name": one.name, "words": one.words} for one in own.meters],
        "told": len(own.told),
        "added_readings": len(own.added),
        "distances": own.after.tolist(),
        "points": list(_points(found, own.counts, own.added)),
    }


def _sensors(case: PlanCase, found: Plan) -> Iterator[dict[str, Any]]:
    fixed = {one.value for one in ALWAYS}
    for one in case.meters:
        if one.name.value in found.channels:
            yield {
                "name": one.name.value, "sigma": one.sigma, "sigma_relative": one.sigma_relative,
                "gain_sigma": one.gain_sigma, "zero_sigma": one.zero_sigma, "input": one.name.value in fixed,
                "assumed": "sigma" in one.assumed,
            }  # fmt: skip


def _never(one: Never) -> dict[str, Any]:
    return {
        "pair": list(one.pair),
        "reason": one.reason.name.lower(),
        "unseen": list(one.unseen),
        "further": [meter.name for meter in one.meters],
    }


def hopeless(summary: Mapping[str, Any]) -> np.ndarray:
    """Return (S, S), true for pairs that no point separates."""
    count = len(summary["suspects"])
    found = np.zeros((count, count), dtype=bool)
    for one in summary["never_apart"]:
        first, second = one["pair"]
        found[first, second] = found[second, first] = True
    return found
