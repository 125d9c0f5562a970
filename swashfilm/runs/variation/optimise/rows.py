"""Rows of an optimisation's tables, from its summary."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from system.variation.measures import MEASURES

DIMENSION_HEAD = ("dimension", "start", "chosen", "from", "to", "at a bound")
MEASURE_HEAD = ("measure", "start", "chosen", "change")
CONSTRAINT_HEAD = ("constraint", "start", "chosen", "room", "holds")
OBSTACLE_HEAD = ("constraint", "designs that meet it", "best of all", "at the nearest design", "missed by")


def compared_head(head: tuple[str, ...], summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return a head; without a feasible design the chosen one is the nearest."""
    return head if summary["chosen"]["feasible"] else tuple(one.replace("chosen", "nearest") for one in head)


def dimension_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of DIMENSION_HEAD."""
    for one in summary["dimensions"]:
        name = f"{one['name']}, with {', '.join(one['tied'])}" if one["tied"] else one["name"]
        bound = {"low": "lower", "high": "upper", "": ""}[one["at_bound"]]
        yield name, one["start_text"], one["chosen_text"], one["low_text"], one["high_text"], bound


def measure_rows(summary: Mapping[str, Any], *, asked: bool) -> Iterator[tuple[str, ...]]:
    """Yield the rows of MEASURE_HEAD: of objectives and constraints, or of all others."""
    names = asked_names(summary)
    for name, one in summary["measures"].items():
        if (name in names) is asked and one["start"] is not None:
            yield MEASURES[name].words, *compared(name, one)


def asked_names(summary: Mapping[str, Any]) -> list[str]:
    """Return the measures of objectives and constraints, each once."""
    names = [*(one["name"] for one in summary["objectives"]), *(one["measure"] for one in summary["constraints"])]
    return list(dict.fromkeys(names))


def compared(name: str, one: Mapping[str, float]) -> tuple[str, str, str]:
    """Return a measure of start and chosen design, and its change."""
    measure = MEASURES[name]
    return measure.text(one["start"]), measure.text(one["chosen"]), measure.change(one["chosen"] - one["start"])


def constraint_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of CONSTRAINT_HEAD."""
    for one in summary["constraints"]:
        measure = MEASURES[one["measure"]]
        room = measure.change(abs(one["chosen"] - one["value"])).removeprefix("+")
        told = "holds" if one["holds"] else "" if one["met"] else "missed"
        yield one["words"], measure.text(one["start"]), measure.text(one["chosen"]), room, told


def obstacle_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of OBSTACLE_HEAD."""
    for one in summary["obstacles"]:
        measure = MEASURES[one["measure"]]
        missed = measure.change(abs(one["nearest"] - one["value"])).removeprefix("+") if one["violation"] > 0.0 else ""
        count = f"{one['met']} of {summary['counts']['solved']}"
        yield one["words"], count, measure.text(one["best"]), measure.text(one["nearest"]), missed


def point_head(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the head of `point_rows`."""
    names = asked_names(summary)
    return ("operating point", *(f"{MEASURES[name].words}: {side}" for name in names for side in ("start", "chosen")))


def point_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield each operating point with the measures of start and chosen design."""
    for one in summary["at_points"]:
        cells = [compared(name, own)[:2] for name, own in one["measures"].items()]
        yield one["point"], *(cell for pair in cells for cell in pair)


def count_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (what, number) of the designs."""
    counts = summary["counts"]
    yield "designs tried", str(counts["tried"])
    yield "refused by the geometry", str(counts["refused"])
    yield "without a result", str(counts["tried"] - counts["refused"] - counts["solved"])
    yield "feasible", str(counts["feasible"])
    yield "in the Pareto set", str(counts["pareto"])
