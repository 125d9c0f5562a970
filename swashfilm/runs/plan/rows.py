"""Rows of a plan's tables, from its summary, and the words that they share."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from diagnosis.recording.units import difference, difference_unit
from diagnosis.report.format import CHANNELS, listed
from system.inputs.channels import ChannelName
from system.inputs.shown import shown_in

Summary = Mapping[str, Any]
POINT_COLUMNS = (
    ("speed", "speed", "rad/s"), ("p_out", "pressure", "Pa"), ("displacement_ratio", "displacement ratio", "1"),
    ("T_case", "temperature", "K"), ("p_in", "inlet pressure", "Pa"),
)  # fmt: skip
"""Key in the summary, head without its unit as a campaign file has it, and SI unit of each input."""
FURTHER_HEAD = ("a further meter", "pairs that it tells apart", "among them")
SUSPECT_HEAD = ("suspect", "name for --suspects", "size", "costs", "stands out by", "shows most in")
SENSOR_HEAD = ("meter", "one sigma of a reading", "calibration: gain", "zero", "")
NEVER_HEAD = ("never told apart", "why", "what would tell")
OPEN_HEAD = ("still open", "apart by", "")
HARDLY = 0.1
"""Of the distance needed: a suspect that stands out by less would show at no size that is likely."""
NAMED = 4
"""Pairs that a cell names."""
REASONS = {
    "same_form": "both change the {channel} in the same way over all inputs of the bench",
    "weak": "{weaker} stands out by {seen:.1f} sigma with these points, and by too little with any",
}


def point_head() -> list[str]:
    """Return the heads of points.csv: a campaign file that may be planned again."""
    return [
        "order",
        *(f"{name} [{shown_in(unit, name).unit}]" for _, name, unit in POINT_COLUMNS),
        "repeats [1]",
        "for",
    ]


def point_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield a row for each point to drive, in its order."""
    yield from _point_rows(summary, summary["points"])


def equipped_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the same of the campaign with the requested meters; nothing without one."""
    if summary["equipped"]:
        yield from _point_rows(summary, summary["equipped"]["points"])


def equipment(summary: Summary) -> str:
    """Return the requested meters, in words; empty without one."""
    return listed(one["words"] for one in summary["equipped"]["meters"]) if summary["equipped"] else ""


def _point_rows(summary: Summary, points: Sequence[Summary]) -> Iterator[tuple[str, ...]]:
    for one in points:
        inputs = (f"{shown_in(unit, name).of(one[key]):.6g}" for key, name, unit in POINT_COLUMNS)
        yield str(one["order"]), *inputs, str(one["repeats"]), purpose(summary, one)


def purpose(summary: Summary, point: Mapping[str, Any]) -> str:
    """Return the purpose of a point, in words."""
    if not point["for"]:
        return "planned"
    pairs = "; ".join(pair_words(summary, pair) for pair in point["for"][:2])
    return f"{pairs} (planned, repeated)" if point["planned"] else pairs


def pair_words(summary: Summary, pair: Sequence[int], joined: str = "from") -> str:
    """Return both suspects of a pair in words."""
    one, other = (summary["suspects"][at]["words"] for at in pair)
    return f"{one} {joined} {other}"


def channel_of(name: str) -> str:
    """Return a channel in words."""
    return CHANNELS[ChannelName.named(name)]


def further_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the rows of FURTHER_HEAD."""
    for one in summary["further"]:
        named = "; ".join(pair_words(summary, pair) for pair in one["pairs"][:NAMED])
        yield one["words"], str(len(one["pairs"])), named + (" .." if len(one["pairs"]) > NAMED else "")


def suspect_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the rows of SUSPECT_HEAD."""
    for one in summary["suspects"]:
        capped = " (its largest likely size)" if one["capped"] else ""
        cost = f"{100.0 * one['costs_efficiency']:.2g}"
        yield (
            one["words"], one["name"], one["size"] + capped, f"{cost} point{'' if cost == '1' else 's'}",
            f"{one['seen_sigma']:.1f} sigma", channel_of(one["shows_in"]),
        )  # fmt: skip


def sensor_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the rows of SENSOR_HEAD."""
    for one in summary["sensors"]:
        name = ChannelName.named(one["name"])
        unit = difference_unit(name)
        parts = [f"{difference(name, one['sigma']):.3g} {unit}".removesuffix(" 1")] if one["sigma"] else []
        parts += [f"{100.0 * one['sigma_relative']:.3g} %"] if one["sigma_relative"] else []
        gain = f"{100.0 * one['gain_sigma']:.2g} %" if one["gain_sigma"] else ""
        zero = f"{difference(name, one['zero_sigma']):.3g} {unit}".removesuffix(" 1") if one["zero_sigma"] else ""
        yield one["name"], " + ".join(parts) or "exact", gain, zero, "ordinary bench" if one["assumed"] else "as stated"


def never_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the rows of NEVER_HEAD: suspects that no reading shows, then the pairs."""
    for at, own in enumerate(summary["suspects"]):
        pairs = [one for one in summary["never_apart"] if at in one["unseen"]]
        if pairs:
            helped = Counter(name for one in pairs for name in one["further"])
            meters = [name for name, count in helped.most_common(2) if count >= len(pairs) / 2]
            yield f"{own['words']} from anything", _too_small(summary, own), _would_tell(summary, own, meters)
    for one in summary["never_apart"]:
        if not one["unseen"]:
            weaker = min((summary["suspects"][at] for at in one["pair"]), key=lambda own: own["seen_sigma"])
            channel = channel_of(weaker["shows_in"])
            why = REASONS[one["reason"]].format(channel=channel, weaker=weaker["words"], seen=weaker["seen_sigma"])
            yield pair_words(summary, one["pair"]), why, _meters(summary, one["further"])


def _too_small(summary: Summary, own: Summary) -> str:
    """Return the reason why a suspect of its size is not seen: it hardly moves a reading, or less than is needed."""
    seen, wanted = own["seen_sigma"], summary["apart_sigma"]
    if seen < HARDLY * wanted:
        return f"hardly moves any reading of this bench, by {seen:.1f} sigma with these points"
    cost = f"{100.0 * own['costs_efficiency']:.2g}"
    points = f"{cost} point{'' if cost == '1' else 's'}"
    return f"too small at {points}: it stands out by {seen:.1f} of the {wanted:.1f} sigma needed, with these points"


def _would_tell(summary: Summary, own: Summary, meters: Sequence[str]) -> str:
    """Return what shows a suspect: meters, and a larger size where one is likely; distances are proportional to it."""
    seen, cost = own["seen_sigma"], summary["cost_of_efficiency"]
    if own["capped"] or seen < HARDLY * summary["apart_sigma"]:
        return _meters(summary, meters)
    times = summary["apart_sigma"] / seen
    asked = f", --cost {100.0 * cost * times:.2g}%" if own["costs_efficiency"] >= cost * (1.0 - 1e-9) else ""
    larger = f"a size {times:.2g} times as large{asked}"
    return f"{_meters(summary, meters)}, or {larger}" if meters else larger


def _meters(summary: Summary, names: Sequence[str]) -> str:
    words = {one["name"]: one["words"] for one in summary["further"]}
    return listed((words[name] for name in names), "or") if names else "no meter that is known here"


def open_rows(summary: Summary, most: int = 20) -> Iterator[tuple[str, str, str]]:
    """Yield the pairs that points could separate and these do not, the nearest first."""
    for pair in summary["open_pairs"][:most]:
        distance = summary["distances"][pair[0]][pair[1]]
        why = "differ by less than such laws are true" if distance >= summary["apart_sigma"] else ""
        yield pair_words(summary, pair), f"{distance:.1f} sigma", why


def count_rows(summary: Summary) -> Iterator[tuple[str, str]]:
    """Yield the counts as the command prints them."""
    readings = summary["planned_readings"]
    yield "pairs of suspects", str(summary["pairs"])
    yield f"told apart by {readings} planned readings", str(summary["told_planned"])
    added = summary["added_readings"]
    yield f"with {added} reading{'s' if added != 1 else ''} more", str(summary["told"])
    if summary["equipped"]:
        yield f"with {equipment(summary)} as well", str(summary["equipped"]["told"])
    yield "still open", str(summary["open"])
    yield "never told apart by points", str(summary["never"])
