"""Page of a plan: report.html from the files of the run folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from diagnosis.report.format import listed
from swashfilm.output.answer import Answer, Tile
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.plan import rows
from swashfilm.runs.plan.limits import AXES
from swashfilm.runs.plan.plots import FEW, apart_plot, points_plot

CAPTION = (
    "How far apart the campaign with its added points tells every two suspects. Blue: told apart. Red: still open. "
    "Grey: told by no point{numbers}"
)
NUMBERED = ". The columns have the numbers of the rows"
POINTS = (
    "Points of the campaign; a larger mark is read more often; marks of warmer oil lie a little to the right of colder"
)


def write_plan_page(folder: Path) -> Path:
    """Write report.html of a plan's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, ("summary.json",), "a plan's run folder")
    return write_page(
        folder,
        "plan",
        answer=plan_answer(summary),
        whole_width=len(summary["suspects"]) > FEW,
        summary=summary,
        points=list(rows.point_rows(summary)),
        point_head=rows.point_head(),
        points_picture=inlined(points_plot(summary)),
        points_caption=POINTS,
        equipped=list(rows.equipped_rows(summary)),
        equipment=rows.equipment(summary),
        further=list(rows.further_rows(summary)),
        further_head=rows.FURTHER_HEAD,
        never=list(rows.never_rows(summary)),
        never_head=rows.NEVER_HEAD,
        open_pairs=list(rows.open_rows(summary)),
        open_head=rows.OPEN_HEAD,
        suspects=list(rows.suspect_rows(summary)),
        suspect_head=rows.SUSPECT_HEAD,
        sensors=list(rows.sensor_rows(summary)),
        sensor_head=rows.SENSOR_HEAD,
        shown={name: [AXES[name].text(end) for end in ends] for name, ends in summary["box"].items()},
    )


def plan_answer(summary: Mapping[str, Any]) -> Answer:
    """Return the answer: pairs separated as planned, with the added points, with the meters; pairs never separated."""
    pairs, equipped = summary["pairs"], summary["equipped"]
    tiles = [
        Tile(
            f"{summary['told_planned']} of {pairs}",
            "pairs told apart as planned",
            _readings(summary["planned_readings"]),
        )
    ]
    if summary["added_readings"]:
        tiles.append(
            Tile(f"{summary['told']} of {pairs}", "with added points", f"{_readings(summary['added_readings'])} more")
        )
    if equipped:
        count = len(equipped["meters"])
        label = "with one meter more" if count == 1 else f"with {count} meters more"
        tiles.append(Tile(f"{equipped['told']} of {pairs}", label, rows.equipment(summary)))
    tiles.append(Tile(str(summary["open"]), "pairs still open", "points could tell them"))
    tiles.append(Tile(str(summary["never"]), "pairs never told apart", "by any point of this bench"))
    caption = CAPTION.format(numbers=NUMBERED if len(summary["suspects"]) > FEW else "")
    return Answer(tuple(tiles), " ".join(_sentences(summary)), inlined(apart_plot(summary)), caption)


def _sentences(summary: Mapping[str, Any]) -> Iterator[str]:
    pairs, told = summary["pairs"], summary["told_planned"]
    planned, added = _readings(summary["planned_readings"]), summary["added_readings"]
    yield f"The planned test, {planned}, tells {told} of {pairs} pairs of suspects apart."
    if added:
        yield f"With {_readings(added)} more it tells {summary['told']}; points.csv lists all in the order to drive."
    elif summary["most_added"] and told < pairs:
        yield "No further point tells more."
    if summary["spent"]:
        yield f"More readings than {summary['most_added']} would tell more: --add N allows them."
    if summary["equipped"]:
        equipped = summary["equipped"]
        readings = _readings(summary["planned_readings"] + equipped["added_readings"])
        yield (
            f"With {rows.equipment(summary)} as well, a test of {readings} tells {equipped['told']}; "
            "points_with_meters.csv lists them."
        )
    elif summary["further"] and summary["told"] < pairs:
        yield "No further meter tells more."
    yield from _never(summary)
    cost = 100.0 * summary["cost_of_efficiency"]
    yield (
        f"Each suspect has the size that costs {cost:g} point{'s' if cost != 1.0 else ''} of efficiency on average or "
        "moves the drain by half, its largest likely size where that is less."
    )


def _never(summary: Mapping[str, Any]) -> Iterator[str]:
    if not summary["never"]:
        yield "Nothing is left that points could never tell."
        return
    unseen = [
        one["words"]
        for at, one in enumerate(summary["suspects"])
        if any(at in each["unseen"] for each in summary["never_apart"])
    ]
    alike = [one["pair"] for one in summary["never_apart"] if one["reason"] == "same_form"]
    if unseen:
        some = [*unseen[:4], f"{len(unseen) - 4} more"] if len(unseen) > 5 else unseen
        yield f"No point shows {listed(some, 'or')} at such a size."
    if alike:
        some = [rows.pair_words(summary, pair) for pair in alike[:3]]
        rest = len(alike) - 3
        more = f", nor {rest} pair{'s' if rest > 1 else ''} more" if rest > 0 else ""
        yield f"No point tells {'; '.join(some)}{more}."


def _readings(count: int) -> str:
    return f"{count} reading{'s' if count != 1 else ''}"
