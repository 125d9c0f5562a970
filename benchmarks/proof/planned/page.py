"""Page of the check of planned campaigns, from the kept trials."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from ..calibration import wilson
from ..markdown import table
from .trial import ADDED, CORNERS, ODDS, SCORE, concealed

HEAD = """# Check of planned campaigns

Does a campaign of `swashfilm plan` settle what a grid of the same size leaves open? The pump is the plant of the
[proof](proof.md), a simulation of another make with its own laws, noise, calibrations and tolerances. Something is
concealed in it, one thing at a time in a drawn order, as large as a score of {score:g} by the grid: it is seen, and
seldom named. The bench reads delivery flow, case drain, torque and all inputs at 36 points of a grid at one
temperature, as the campaign `map` of the proof: three displacements, three speeds, four pressures. A diagnosis
follows. Each rival that it leaves open beside the truth, at odds below {odds:g} to 1, makes a pair. The truth and
its open rivals are the suspects of a plan: {corners} corners of the range of an ordinary bench, and up to {added}
readings added, which may also be at other temperatures. All suspects cost as much as makes the truth stand out by
{score:g} sigma on the grid. These readings are recorded on the same pump with the bench calibrated anew, and
diagnosed by themselves, without the grid. A pair is settled at odds of {odds:g} to 1 for the truth.

Written by `python benchmarks/plan_check.py`.
"""
TABLE = ("concealed", "open rival", "odds by the grid", "foreseen, grid", "foreseen, planned", "odds as planned", "")


def write_page(results: Path, page: Path) -> Path:
    """Write the page of all trials in a folder."""
    trials = [json.loads(path.read_text("utf-8")) for path in sorted(results.glob("*.json"))]
    pairs = [(trial, pair) for trial in trials for pair in trial["pairs"]]
    lines = [HEAD.format(score=SCORE, odds=ODDS, corners=CORNERS, added=ADDED), *_counts(trials)]
    lines.append(table(TABLE, [_row(trial, pair) for trial, pair in pairs]))
    page.write_text("\n".join(lines), encoding="utf-8")
    return page


def _counts(trials: Sequence[Any]) -> Iterator[str]:
    pairs = [pair for trial in trials for pair in trial["pairs"]]
    told = [pair for pair in pairs if pair["told"]]
    never = sum(pair["never"] for pair in pairs)
    minutes = sum(trial["seconds"] for trial in trials) / 60.0
    yield (
        f"Of {len(concealed())} things that may be concealed, in a drawn order, the first {len(trials)} were tried, in "
        f"{minutes:.0f} min of process time. {sum(bool(trial['pairs']) for trial in trials)} of them left {len(pairs)} "
        f"pairs open. The plan foresees that its readings tell {len(told)} of these apart, and that no point of this "
        f"bench tells {never}.\n"
    )
    yield f"- Of all open pairs the planned campaign settles {_share(pairs)}; the gate is 80 %."
    yield f"- Of those that the plan foresees to be told apart it settles {_share(told)}.\n"


def _share(pairs: Sequence[Any]) -> str:
    settled = sum(pair["odds_planned"] >= ODDS for pair in pairs)
    if not pairs:
        return "none of none"
    low, high = wilson(settled, len(pairs))
    return f"{settled} of {len(pairs)} (Wilson's 95 % interval {low:.0%} to {high:.0%})"


def _row(trial: Any, pair: Any) -> tuple[str, ...]:
    foreseen = "told apart" if pair["told"] else "never" if pair["never"] else "open"
    settled = "settled" if pair["odds_planned"] >= ODDS else "open"
    planned = "none made" if pair["never"] and not trial["said_planned"] else f"{min(pair['odds_planned'], 1e6):.3g}"
    return (
        trial["truth"], pair["rival"], f"{pair['odds_grid']:.2g}", f"{pair['grid']:.1f} sigma",
        f"{pair['planned']:.1f} sigma, {foreseen}", planned, settled,
    )  # fmt: skip
