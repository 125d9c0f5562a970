"""Tables of a plan's run folder."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.tables import write_csv
from swashfilm.runs.plan import rows

APART, POINTS, SENSORS, NEVER = "apart.csv", "points.csv", "sensors.csv", "never.csv"
EQUIPPED = "points_with_meters.csv"


def write_tables(folder: Path, summary: Mapping[str, Any]) -> None:
    """Write the tables: suspect x suspect in sigma, points to drive without and with further meters, the gain of these,
    pairs never separated.
    """
    names = [one["name"] for one in summary["suspects"]]
    distances = (
        [name, *(f"{value:.4g}" for value in own)] for name, own in zip(names, summary["distances"], strict=True)
    )
    write_csv(folder / APART, ["sigma", *names], distances)
    write_csv(folder / POINTS, rows.point_head(), rows.point_rows(summary))
    write_csv(folder / EQUIPPED, rows.point_head(), rows.equipped_rows(summary))
    further = (
        (one["name"], one["words"], len(one["pairs"]), "; ".join(_pair(names, pair) for pair in one["pairs"]))
        for one in summary["further"]
    )
    write_csv(folder / SENSORS, ("meter", "words", "pairs told apart", "pairs"), further)
    never = (
        (*(names[at] for at in one["pair"]), one["reason"], " ".join(names[at] for at in one["unseen"]),
         " ".join(one["further"]))
        for one in summary["never_apart"]
    )  # fmt: skip
    write_csv(folder / NEVER, ("suspect", "other", "reason", "not seen", "meters that would tell"), never)


def _pair(names: list[str], pair: list[int]) -> str:
    return " from ".join(names[at] for at in pair)
