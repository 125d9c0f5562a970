"""Page of a sensitivity: report.html from the files of the run folder."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.variation.sensitivity import rows
from swashfilm.runs.variation.sensitivity.plots import PANELS, cost_plot, tolerance_plot
from system.variation.measures import EFFICIENCY, LOSS, MEASURES

CAPTION = (
    "What one micrometre of a length, one degree of an angle and one per cent of every other dimension cost. "
    "Red: the pump loses more where the dimension grows"
)
BY_SIGMA = "What one standard deviation of each stated tolerance costs"


def write_sensitivity_page(folder: Path) -> Path:
    """Write report.html of a sensitivity's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, ("summary.json",), "a sensitivity's run folder")
    by_sigma = tolerance_plot(summary)
    return write_page(
        folder,
        "sensitivity",
        answer=sensitivity_answer(summary),
        summary=summary,
        costs=list(rows.cost_rows(summary)),
        cost_head=rows.COST_HEAD,
        changes=list(rows.measure_rows(summary)),
        change_head=rows.measure_head(summary),
        middle=list(rows.middle_rows(summary)),
        rough=list(rows.rough_rows(summary)),
        quiet=rows.without_effect(summary),
        sides=list(rows.side_rows(summary)),
        refused=list(rows.refused_rows(summary)),
        by_sigma=inlined(by_sigma) if by_sigma is not None else "",
        sigma_caption=BY_SIGMA,
    )


def sensitivity_answer(summary: Mapping[str, Any]) -> Answer:
    """Return the answer: loss and efficiency, and the costliest length, angle and other dimension."""
    measures = summary["measures"]
    tiles = [
        Tile(MEASURES[LOSS].text(measures[LOSS]["value"]), "total loss", summary["solver"]),
        Tile(MEASURES[EFFICIENCY].text(measures[EFFICIENCY]["value"]), "overall efficiency", "ISO 4409"),
    ]
    said = []
    for kind in PANELS:
        if dearest := rows.ranked(summary, kind)[:1]:
            row = dearest[0]
            change, points = (_words(row, name) for name in (LOSS, EFFICIENCY))
            tiles.append(Tile(change, f"dearest by +{row['change_text']}", f"{row['key']}, {points}"))
            verb = "lowers" if change.startswith("-") else "raises"
            said.append(f"{row['change_text']} more of {row['key']} {verb} the loss by {change[1:]} ({points})")
    picture = cost_plot(summary)
    return Answer(tuple(tiles), _sentences(summary, said), None if picture is None else inlined(picture), CAPTION)


def _words(row: rows.Row, measure: str) -> str:
    return MEASURES[measure].change(rows.cost(row, measure))


def _sentences(summary: Mapping[str, Any], said: list[str]) -> str:
    dimensions = summary["dimensions"]
    count, costly = len(dimensions) + len(summary["refused"]), sum(rows.cost(row, LOSS) != 0.0 for row in dimensions)
    found = f"Of {count} dimensions {costly} change the loss."
    if said:
        found += f" The dearest of each kind: {'; '.join(said)}."
    if unknown := len(summary["refused"]) + sum(rows.derivative(row, LOSS) is None for row in dimensions):
        found += f" {unknown} of them {'has' if unknown == 1 else 'have'} no derivative."
    sized = [row for row in rows.ranked(summary) if row["sigma"] is not None]
    if sized:
        row = max(sized, key=lambda one: abs(rows.cost(one, LOSS, "sigma")))
        change = MEASURES[LOSS].change(rows.cost(row, LOSS, "sigma"))
        found += f" By the stated tolerances {row['key']} counts most: {row['sigma_text']}, {change}."
    return found
