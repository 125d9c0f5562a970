"""Page of a comparison: report.html from summary.json and the plots of the run folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.page import kept_pictures, read_summary, write_page
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.compare.plots import FIRST
from swashfilm.runs.map.answer import percent
from swashfilm.runs.map.duty.page import energy_text
from swashfilm.runs.map.slices import place_words
from system.inputs.shown import ROUND_OFF
from system.maps.data import LOSSES
from system.maps.definitions import HEADLINE, agreeing, definition_words
from system.maps.plan import MapInput
from system.maps.specific import OF_POWER
from system.pump.efficiency import EfficiencyDefinition

DIFFERENCE_HEAD = ("", "A, mean", "B, mean", "B - A, mean", "largest B - A", "at", "error of both there")
EFFICIENCY_HEAD = (
    "definition", "A, mean", "B, mean", "B - A, mean", "largest B - A", "at", "error of both there",
)  # fmt: skip
DUTY_HEAD = ("", "A", "B", "B - A", "error of both")
NOTHING = "no difference"
"""Words for a difference within the error of both."""
EFFICIENCY = "overall efficiency, "
SPECIFIC = (
    "Pumps of two sizes: losses as shares of the shaft power at the same point, torque and flow over displacement"
)
_SCALES = {
    "W": (1e-3, "kW"),
    "m3/s": (6e4, "L/min"),
    "1": (100.0, "%"),
    "N m": (1.0, "N m"),
    "N m/(m3/rev)": (1e-6, "N m per mL/r"),
    "rev/s": (0.06, "L/min per mL/r"),
}
_POINTS = "percentage points"
Row = Mapping[str, Any]


def write_compare_page(folder: Path) -> Path:
    """Write report.html of a comparison's run folder from its summary.json and plots/."""
    summary = read_summary(folder)
    pictures = {name: kept_pictures(folder, name) for name in summary["pictures"]}
    caption, picture = next(iter(pictures.pop(FIRST, {}).items()), ("", None))
    return write_page(
        folder,
        "compare",
        answer=compare_answer(summary, picture, caption),
        summary=summary,
        box=[
            (box["words"], f"{box['from']} .. {box['to']}" if box["from"] != box["to"] else box["from"])
            for box in summary["box"]
        ],
        efficiencies=efficiency_rows(summary),
        efficiency_head=EFFICIENCY_HEAD,
        differences=list(difference_rows(summary)),
        difference_head=DIFFERENCE_HEAD,
        specific=list(specific_rows(summary)),
        specific_title=SPECIFIC,
        sizes=_sizes(summary),
        duty=list(duty_rows(summary)) if summary["duty"] else [],
        duty_head=DUTY_HEAD,
        pictures=pictures,
    )


def compare_answer(summary: Row, picture: Picture | None = None, caption: str = "") -> Answer:
    """Return the answer of a comparison: the better map, differences with places, and those within the error."""
    one, other = summary["names"]
    row = next((row for row in summary["differences"] if row["words"] == f"{EFFICIENCY}{HEADLINE.label}"), None)
    tiles = [*(_efficiency_tiles(row, summary) if row else ()), *_loss_tiles(summary)]
    words = [
        f"A is {one}, B is {other}.",
        *(_duty_words(summary) if summary["duty"] else ()),
        *(_efficiency_words(row, summary) if row else ()),
        *_loss_words(summary),
    ]
    return Answer(tuple(tiles), " ".join(words), picture, caption)


def _efficiency_tiles(row: Row, summary: Row) -> Iterator[Tile]:
    for letter, name, key in zip("AB", summary["names"], ("one", "other"), strict=True):
        yield Tile(percent(row[key]), f"{letter}: {name}", "mean overall efficiency (ISO 4409)")
    yield Tile(_apart(row, "1"), "B - A", f"{_POINTS} in the mean; error of both {100.0 * row['error']:.1g}")
    for key, words in (("rise", "B better by up to"), ("fall", "A better by up to")):
        if row[key]["told"] and (row[key]["value"] > 0.0) is (key == "rise"):
            yield Tile(f"{abs(100.0 * row[key]['value']):.3g}", words, f"{_POINTS}, at {_place(row[key], summary)}")


def _loss_tiles(summary: Row) -> Iterator[Tile]:
    rows = [row for row in summary["differences"] if row["words"] in LOSSES.values()]
    one, other = (1e-3 * sum(row[side] for row in rows) for side in ("one", "other"))
    apart = f"{other - one:+.2g} kW" if any(row["told"] for row in rows) else NOTHING
    yield Tile(apart, "B - A, mean loss", f"A {one:.3g} kW, B {other:.3g} kW")


def _efficiency_words(row: Row, summary: Row) -> Iterator[str]:
    apart = row["other"] - row["one"]
    if not row["told"]:
        yield "There is no difference of overall efficiency: it is within the error of both at every point."
        return
    better, worse = ("B", "A") if apart > 0.0 else ("A", "B")
    if abs(apart) > row["error"]:
        yield (
            f"{better} is better: over the common levels its overall efficiency by ISO 4409 is "
            f"{abs(100.0 * apart):.3g} {_POINTS} above that of {worse} in the mean."
        )
    else:
        yield "In the mean of the common levels there is no difference of overall efficiency."
    for letter, key, share in (("B", "rise", row["above"]), ("A", "fall", row["below"])):
        if share > 0.0:
            yield (
                f"{letter} is better at {_share(share)} of the points, by up to {abs(100.0 * row[key]['value']):.3g} "
                f"{_POINTS} at {_place(row[key], summary)}."
            )


def _duty_words(summary: Row) -> Iterator[str]:
    losses = [side["energy_J"]["loss"] for side in summary["duty"]]
    lost = losses[1]["value"] - losses[0]["value"]
    if abs(lost) <= sum(one["error"] for one in losses):
        yield "Over the cycle there is no difference of the energy lost."
        return
    means = [side["efficiency"][HEADLINE.value]["value"] for side in summary["duty"]]
    known = "" if None in means else f"; its mean efficiency is {percent(means[1])} against {percent(means[0])}"
    yield (
        f"Over the cycle B loses {energy_text(abs(lost), 3)} {'more' if lost > 0.0 else 'less'} than A "
        f"({energy_text(losses[1]['value'])} against {energy_text(losses[0]['value'])}){known}."
    )


def _sizes(summary: Row) -> str:
    return " and ".join(f"{1e6 * one:.4g} mL/r" for one in summary["displacement_m3_per_rev"])


def _share(share: float) -> str:
    return "all" if share == 1.0 else f"{100.0 * share:.0f} %"


def _loss_words(summary: Row) -> Iterator[str]:
    names = {name: name for name in LOSSES.values()} | {f"{name}, {OF_POWER}": name for name in LOSSES.values()}
    rows, unit = summary["differences"], "kW"
    if summary["specific"]:
        rows, unit = summary["specific"], f"points of the {OF_POWER.removeprefix('share of the ')}"
        yield f"The pumps displace {_sizes(summary)}: powers and flows follow the size, shares of the shaft power less."
    losses = [dict(row) | {"words": names[row["words"]]} for row in rows if row["words"] in names]
    told = sorted((row for row in losses if row["told"]), key=lambda row: -abs(row["other"] - row["one"]))
    if told:
        named = ", ".join(f"{row['words']} ({_apart(row, row['unit'])} {unit})" for row in told[:3])
        yield f"The losses that differ most, B less A in the mean: {named}."
    if alike := [row["words"] for row in losses if not row["told"]]:
        yield f"No difference: {', '.join(alike)}."


def _apart(row: Row, unit: str) -> str:
    """Return the difference of the means, without unit."""
    apart = row["other"] - row["one"]
    return f"{_SCALES[unit][0] * apart:+.3g}" if abs(apart) > row["error"] else NOTHING


def _place(extreme: Row, summary: Row) -> str:
    varied = {box["words"] for box in summary["box"] if box["from"] != box["to"]}
    return place_words({given: extreme["at"][given.value] for given in MapInput if given.words in varied})


def efficiency_rows(summary: Row) -> list[tuple[str, ...]]:
    """Return (definitions, means of A and B, mean and largest difference, its point, error of both); equal rows once.

    Efficiencies in %, differences in percentage points.
    """
    named = {f"{EFFICIENCY}{one.label}": one for one in EfficiencyDefinition}
    shown = {
        named[row["words"]]: (
            f"{100.0 * row['one']:.1f} %", f"{100.0 * row['other']:.1f} %", *_difference_cells(row, summary, ""),
        )
        for row in summary["differences"]
        if row["unit"] == "1"
    }  # fmt: skip
    return [(definition_words(alike), *cells) for alike, cells in agreeing(shown)]


def difference_rows(summary: Row) -> Iterator[tuple[str, ...]]:
    """Yield (number, means of A and B, mean and largest difference, its point, error of both), no efficiencies."""
    for row in summary["differences"]:
        scale, unit = _SCALES[row["unit"]]
        if row["unit"] != "1":
            means = (f"{row[which] * scale:.4g} {unit}" for which in ("one", "other"))
            yield row["words"], *means, *_difference_cells(row, summary, f" {unit}")


def specific_rows(summary: Row) -> Iterator[tuple[str, ...]]:
    """Yield the rows of DIFFERENCE_HEAD of numbers free of the pumps' size, shares in %; none of pumps of one size."""
    for row in summary["specific"]:
        scale, unit = _SCALES[row["unit"]]
        means = (f"{row[which] * scale:.4g} {unit}" for which in ("one", "other"))
        difference = " points" if row["unit"] == "1" else f" {unit}"
        yield row["words"], *means, *_difference_cells(row, summary, difference)


def _difference_cells(row: Row, summary: Row, unit: str) -> tuple[str, ...]:
    """Return mean and largest difference, its point, and the error of both there."""
    scale, largest = _SCALES[row["unit"]][0], row["largest"]
    small = largest["error"] < ROUND_OFF * abs(largest["value"])
    error = "round-off" if small else f"{largest['error'] * scale:.1g}{unit}"
    if not row["told"]:
        return NOTHING, "", "", error
    mean = _apart(row, row["unit"])
    apart = mean if mean == NOTHING else f"{mean}{unit}"
    return apart, f"{largest['value'] * scale:+.3g}{unit}", _place(largest, summary), error


def duty_rows(summary: Row) -> Iterator[tuple[str, ...]]:
    """Yield (energy, of A, of B, difference, error of both), and so the mean efficiency where both have one."""
    one, other = (side["energy_J"] for side in summary["duty"])
    for words in dict.fromkeys([*one, *other]):
        nothing = {"value": 0.0, "error": 0.0}
        mine, theirs = one.get(words, nothing), other.get(words, nothing)
        apart, error = theirs["value"] - mine["value"], mine["error"] + theirs["error"]
        yield (
            words,
            *(energy_text(side["value"], 5) for side in (mine, theirs)),
            ("+" if apart > 0.0 else "") + energy_text(apart) if abs(apart) > error else NOTHING,
            energy_text(error, 2),
        )
    efficiency = [side["efficiency"][HEADLINE.value] for side in summary["duty"]]
    if any(one["value"] is None for one in efficiency):  # of a cycle at standstill, or one that motors
        return
    apart, error = efficiency[1]["value"] - efficiency[0]["value"], sum(one["error"] for one in efficiency)
    yield (
        "mean overall efficiency (ISO 4409)",
        *(f"{100.0 * one['value']:.2f} %" for one in efficiency),
        f"{100.0 * apart:+.3g} {_POINTS}" if abs(apart) > error else NOTHING,
        f"{100.0 * error:.1g} {_POINTS}",
    )
