"""Page of a tolerance: report.html from the files of the run folder."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.data.files import read_netcdf
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.variation.tolerance import rows
from swashfilm.runs.variation.tolerance.files import DATA
from swashfilm.runs.variation.tolerance.plots import SHOWN, scatter_plot, share_plot
from system.variation.measures import DRAIN, EFFICIENCY, LOSS, MEASURES

if TYPE_CHECKING:
    import xarray

CAPTION = "Efficiency, case drain and loss of the series; lines: 5 %, median and 95 %; dashed: the stated limits"
SHARES = "Share of each dimension in the variance: alone, and with all that it acts with; bars: 95 % intervals"


def write_tolerance_page(folder: Path) -> Path:
    """Write report.html of a tolerance's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, ("summary.json", DATA), "a tolerance's run folder")
    return write_page(
        folder,
        "tolerance",
        answer=tolerance_answer(summary, read_netcdf(folder / DATA)),
        summary=summary,
        scatter=list(rows.scatter_rows(summary)),
        scatter_head=rows.SCATTER_HEAD,
        shares={MEASURES[name].words: list(rows.share_rows(summary, name)) for name in SHOWN},
        share_head=rows.SHARE_HEAD,
        share_picture=inlined(share_plot(summary)),
        share_caption=SHARES,
        limits=list(rows.limit_rows(summary)),
        limit_head=rows.LIMIT_HEAD,
        points=list(rows.point_rows(summary)) if summary["points"] > 1 else [],
        point_head=rows.POINT_HEAD,
        dimensions=list(rows.dimension_rows(summary)),
        counts=list(rows.count_rows(summary)),
    )


def tolerance_answer(summary: Mapping[str, Any], data: xarray.Dataset) -> Answer:
    """Return the answer: median and width of efficiency, drain and loss, the costliest dimension, the worst limit."""
    tiles = [_tile(summary, name) for name in (EFFICIENCY, DRAIN, LOSS)]
    first = rows.dearest(summary, EFFICIENCY)[0]
    share = f"{100.0 * first['total']['value']:.0f} %"
    tiles.append(Tile(share, "of the efficiency's variance", f"by {' and '.join(first['names'])}"))
    tiles += [Tile(rows.of_hundred(one["missing"]["value"]), f"miss {one['limit']}") for one in summary["limits"]]
    picture = inlined(scatter_plot(summary, data))
    return Answer(tuple(tiles[:7]), _sentences(summary, first), picture, CAPTION)


def _tile(summary: Mapping[str, Any], name: str) -> Tile:
    measure, ends = MEASURES[name], summary["measures"][name]["quantiles"]
    low, middle, high = (measure.text(one["value"], 4) for one in ends)
    return Tile(middle, f"{measure.words}, median", f"90 % of the pumps: {low} to {high}")


def _sentences(summary: Mapping[str, Any], first: Mapping[str, Any]) -> str:
    measure = MEASURES[EFFICIENCY]
    ends = summary["measures"][EFFICIENCY]["quantiles"]
    width = measure.change(ends[-1]["value"] - ends[0]["value"]).removeprefix("+")
    narrower = measure.change(first["width"]["value"])
    found = (
        f"{summary['pumps']['solved']} pumps scatter by {width} of overall efficiency between 5 and 95 %. "
        f"{' and '.join(first['names'])} has {100.0 * first['total']['value']:.0f} % of that variance; a tolerance "
        f"tighter by a third changes the width by {narrower}."
    )
    for one in summary["limits"]:
        missing = one["missing"]
        found += f" {rows.of_hundred(missing['value'])} pumps miss {one['limit']} ({rows.interval_text(missing)})."
    return found
