"""Page of an optimisation: report.html from the files of the run folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.data.files import read_netcdf
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.compare import page as compared
from swashfilm.runs.variation.optimise import rows
from swashfilm.runs.variation.optimise.files import BESIDE, DATA
from swashfilm.runs.variation.optimise.plots import dimension_plot, growth_plot, pareto_plot
from system.maps.definitions import HEADLINE
from system.variation.measures import MEASURES

CAPTION = "All designs that were tried, the Pareto set among them, the start and the chosen design"
GROWTH = "Hypervolume of the Pareto set after each generation: it no longer rises where the set is found"
ALONG = "Dimensions of the designs of the Pareto set, each between its bounds"
MOST_TILES = 4


def write_optimise_page(folder: Path) -> Path:
    """Write report.html of an optimisation's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, ("summary.json", DATA), "an optimisation's run folder")
    data = read_netcdf(folder / DATA)
    several = summary["counts"]["pareto"] > 1
    found = read_summary(folder / BESIDE) if (folder / BESIDE).is_dir() else None
    return write_page(
        folder,
        "optimise",
        answer=optimise_answer(summary, inlined(pareto_plot(summary, data)), found),
        summary=summary,
        dimensions=list(rows.dimension_rows(summary)),
        dimension_head=rows.compared_head(rows.DIMENSION_HEAD, summary),
        asked=list(rows.measure_rows(summary, asked=True)),
        others=list(rows.measure_rows(summary, asked=False)),
        measure_head=rows.compared_head(rows.MEASURE_HEAD, summary),
        constraints=list(rows.constraint_rows(summary)),
        constraint_head=rows.compared_head(rows.CONSTRAINT_HEAD, summary),
        obstacles=[] if summary["chosen"]["feasible"] else list(rows.obstacle_rows(summary)),
        obstacle_head=rows.OBSTACLE_HEAD,
        points=list(rows.point_rows(summary)) if summary["points"] > 1 else [],
        point_head=rows.compared_head(rows.point_head(summary), summary),
        counts=list(rows.count_rows(summary)),
        growth=inlined(growth_plot(summary)) if summary["counts"]["feasible"] else None,
        growth_caption=GROWTH,
        along=inlined(dimension_plot(summary, data)) if several else None,
        along_caption=ALONG,
        beside=[] if found is None else _beside(found),
    )


def _beside(found: Mapping[str, Any]) -> list[tuple[str, tuple[str, ...], list[tuple[str, ...]]]]:
    """Return (title, head, rows) of the tables of start and chosen design."""
    tables = [
        ("Over the cycle", compared.DUTY_HEAD, list(compared.duty_rows(found)) if found["duty"] else []),
        ("Efficiency, differences in percentage points", compared.EFFICIENCY_HEAD, compared.efficiency_rows(found)),
        ("Flows, powers and losses", compared.DIFFERENCE_HEAD, list(compared.difference_rows(found))),
    ]
    return [table for table in tables if table[2]]


def optimise_answer(summary: Mapping[str, Any], picture: Any, beside: Mapping[str, Any] | None) -> Answer:
    """Return the answer: objectives of chosen design and start, the set, active constraints.

    beside: summary of the comparison of both, or None.
    """
    counts, label = summary["counts"], "chosen" if summary["chosen"]["feasible"] else "nearest"
    tiles = [_tile(summary, one["name"], label) for one in summary["objectives"][:MOST_TILES]]
    tiles.append(Tile(str(counts["pareto"]), "designs in the Pareto set", f"{counts['tried']} tried, "
                      f"{counts['feasible']} feasible"))  # fmt: skip
    tiles += [_constraint_tile(one) for one in summary["constraints"] if one["holds"] or not one["met"]][:2]
    if len(tiles) < 3:
        tiles.append(Tile(summary["method"]["name"], "search", summary["method"]["why"]))
    return Answer(tuple(tiles), " ".join([*_sentences(summary), *_within_error(beside)]), picture, CAPTION)


def _tile(summary: Mapping[str, Any], name: str, label: str) -> Tile:
    start, chosen, change = rows.compared(name, summary["measures"][name])
    return Tile(chosen, f"{MEASURES[name].words}, {label}", f"start: {start}, {change}")


def _constraint_tile(one: Mapping[str, Any]) -> Tile:
    measure = MEASURES[one["measure"]]
    if one["holds"]:
        return Tile(measure.text(one["chosen"]), f"{measure.words} holds", one["words"])
    missed = measure.change(abs(one["chosen"] - one["value"])).removeprefix("+")
    return Tile(missed, f"{measure.words} is missed by", one["words"])


def _sentences(summary: Mapping[str, Any]) -> Iterator[str]:
    """Yield the answer in words."""
    counts = summary["counts"]
    if not summary["chosen"]["feasible"]:
        yield f"None of {counts['tried']} designs meets all constraints."
        if summary["obstacles"]:
            first = summary["obstacles"][0]
            measure = MEASURES[first["measure"]]
            missed = measure.change(abs(first["nearest"] - first["value"])).removeprefix("+")
            yield f"{first['words']} is in the way: the nearest design misses it by {missed}."
        return
    changes = [_change_words(summary, one["name"]) for one in summary["objectives"]]
    yield f"The chosen design ({summary['chosen']['why']}) has {', '.join(changes)}."
    holding = [one["words"] for one in summary["constraints"] if one["holds"]]
    yield f"{', '.join(holding)} holds it back." if holding else "No constraint holds it back."
    bounds = [one["name"] for one in summary["dimensions"] if one["at_bound"]]
    if bounds:
        yield f"At a bound: {', '.join(bounds)}."


def _within_error(beside: Mapping[str, Any] | None) -> Iterator[str]:
    """Yield that the efficiencies of start and chosen design do not differ by more than the error of both."""
    words = f"{compared.EFFICIENCY}{HEADLINE.label}"
    row = next((row for row in beside["differences"] if row["words"] == words), None) if beside else None
    if row is not None and not row["told"]:
        error = f"{100.0 * row['error']:.1g}"
        yield f"Their overall efficiencies differ by less than the error of both, {error} percentage points."


def _change_words(summary: Mapping[str, Any], name: str) -> str:
    start, chosen, _ = rows.compared(name, summary["measures"][name])
    return f"{MEASURES[name].words} {chosen} in place of {start}"
