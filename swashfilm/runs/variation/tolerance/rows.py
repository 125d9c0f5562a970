"""Rows of a tolerance's tables, from its summary."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from system.variation.measures import MEASURES, significant

SCATTER_HEAD = ("number", "5 %", "median", "95 %", "mean", "standard deviation", "5 to 95 %")
SHARE_HEAD = ("dimension", "share alone", "share in all", "width, a third tighter", "mean, a third tighter")
LIMIT_HEAD = ("limit", "miss it", "95 % interval", "miss it at one point or more", "95 % interval")
POINT_HEAD = ("operating point", "efficiency: 5 %", "median", "95 %", "case drain: 5 %", "median", "95 %")
LEAST_SHARE = 0.005
"""Share of the variance below which a dimension has no row of its own."""


def scatter_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of SCATTER_HEAD."""
    for name, one in summary["measures"].items():
        measure = MEASURES[name]
        ends = [quantile_text(name, each) for each in one["quantiles"]]
        width = one["quantiles"][-1]["value"] - one["quantiles"][0]["value"]
        yield (
            one["words"], *ends, measure.text(one["mean"], 5), _size(name, one["deviation"]), _size(name, width),
        )  # fmt: skip


def quantile_text(name: str, quantile: Mapping[str, float]) -> str:
    """Return a quantile with half the width of its interval."""
    measure = MEASURES[name]
    value, unit = measure.text(quantile["value"], 5).split(" ", 1)
    half = 0.5 * (quantile["high"] - quantile["low"]) * measure.scale
    return f"{value} +- {significant(half, 1)} {unit}"


def dearest(summary: Mapping[str, Any], name: str) -> list[Mapping[str, Any]]:
    """Return the shares of a measure, the largest total first."""
    return sorted(summary["measures"][name]["shares"], key=lambda one: -float(one["total"]["value"]))


def share_rows(summary: Mapping[str, Any], name: str) -> Iterator[tuple[str, ...]]:
    """Yield the rows of SHARE_HEAD of a measure; dimensions below LEAST_SHARE in one row."""
    small = []
    for one in dearest(summary, name):
        if one["total"]["value"] < LEAST_SHARE:
            small += one["names"]
            continue
        shares = (_share(one[part]) for part in ("first", "total"))
        changes = (_interval(name, one[part]) for part in ("width", "mean"))
        yield " and ".join(one["names"]), *shares, *changes
    if small:
        yield f"{len(small)} others", f"below {100.0 * LEAST_SHARE:g} % each"


def limit_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of LIMIT_HEAD: pumps of a hundred."""
    for one in summary["limits"]:
        cells = [one["limit"]]
        for part in ("missing", "missing_at_a_point"):
            found = one[part]
            cells += [of_hundred(found["value"]), interval_text(found)]
        yield tuple(cells)


def of_hundred(share: float) -> str:
    """Return a share as pumps of a hundred."""
    return f"{100.0 * share:.3g} of 100"


def interval_text(found: Mapping[str, float]) -> str:
    """Return the interval of a share as pumps of a hundred."""
    return " to ".join(significant(100.0 * found[end], 2) for end in ("low", "high"))


def point_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of POINT_HEAD."""
    for one in summary["at_points"]:
        cells = [
            MEASURES[name].text(each["value"], 4)
            for name in ("efficiency.overall", "drain_flow")
            for each in one[name]["quantiles"]
        ]
        yield one["point"], *cells


def dimension_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (dimension, value, tolerance, one sigma)."""
    for one in summary["dimensions"]:
        yield one["name"], one["text"], one["words"], one["sigma_text"]


def count_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (what, number) of the pumps."""
    pumps = summary["pumps"]
    yield "pumps drawn", str(pumps["drawn"])
    yield "pumps with a result", str(pumps["solved"])
    yield "refused by the geometry", str(sum(pumps["refused"].values()))
    yield "without a result", str(sum(pumps["failed"].values()))
    yield "operating points", str(summary["points"])


def _share(found: Mapping[str, float]) -> str:
    return f"{100.0 * found['value']:.1f} +- {significant(50.0 * (found['high'] - found['low']), 1)} %"


def _interval(name: str, found: Mapping[str, float]) -> str:
    measure = MEASURES[name]
    half = 0.5 * (found["high"] - found["low"]) * measure.scale
    number, _, unit = measure.change(found["value"]).partition(" ")
    return f"{number} +- {significant(half, 1)} {unit}"


def _size(name: str, value: float) -> str:
    return MEASURES[name].change(value).removeprefix("+")
