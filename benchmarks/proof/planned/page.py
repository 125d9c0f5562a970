"""Page of the check of planned campaigns, from the kept trials."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..calibration import wilson
from ..markdown import table
from .trial import ADDED, CORNERS, ODDS, SCORE, concealed

HEAD = """# Check of planned campaigns

Does a campaign of `swashfilm plan` settle what a grid of the same size leaves open? The pump is the plant of the
[proof](proof.md), a simulation of another make with its own laws, noise, calibrations and tolerances. Something is
concealed in it, one thing at a time in a drawn order, as large as a score of {score:g} by the grid: it is seen, and
seldom named. The bench reads delivery flow, case drain, torque and all inputs at 36 points (two temperatures, two
displacements, three speeds, three pressures). A diagnosis follows. Each rival that it leaves open beside the truth, at
odds below {odds:g} to 1, makes a pair. The truth and its open rivals are the suspects of a plan: {corners} corners of
the same range, and up to {added} readings added. These are recorded on the same pump with the bench calibrated anew,
and diagnosed by themselves, without the grid. A pair is settled at odds of {odds:g} to 1 for the truth.

Written by `python benchmarks/plan_check.py`.
"""
TABLE = (
    "concealed", "open rival", "odds by the grid", "foreseen, corners", "foreseen, planned", "odds as planned", "",
)  # fmt: skip


def write_page(results: Path, page: Path) -> Path:
    """Write the page of all trials in a folder."""
    trials = [json.loads(path.read_text("utf-8")) for path in sorted(results.glob("*.json"))]
    pairs = [(trial, pair) for trial in trials for pair in trial["pairs"]]
    hopeful = [pair for _, pair in pairs if not pair["never"]]
    lines = [HEAD.format(score=SCORE, odds=ODDS, corners=CORNERS, added=ADDED), _counts(trials, hopeful, pairs)]
    lines.append(table(TABLE, [_row(trial, pair) for trial, pair in pairs]))
    page.write_text("\n".join(lines), encoding="utf-8")
    return page


def _counts(trials: Sequence[Any], hopeful: Sequence[Any], pairs: Sequence[Any]) -> str:
    settled = sum(pair["odds_planned"] >= ODDS for pair in hopeful)
    text = (
        f"Of {len(concealed())} things that may be concealed {len(trials)} were tried, in "
        f"{sum(trial['seconds'] for trial in trials) / 60.0:.0f} min of process time. "
        f"{sum(bool(trial['pairs']) for trial in trials)} left {len(pairs)} pairs open. "
        f"Of {len(pairs) - len(hopeful)} of these the plan says that no point of this bench tells them apart: it asks "
        "for no readings on their account. "
    )
    if not hopeful:
        return text + "\n"
    low, high = wilson(settled, len(hopeful))
    share = settled / len(hopeful)
    return text + (
        f"**Of the other {len(hopeful)} pairs the planned campaign settles {settled}: {share:.0%} (Wilson's 95 % "
        f"interval {low:.0%} to {high:.0%}); the gate is 80 %.**\n"
    )


def _row(trial: Any, pair: Any) -> tuple[str, ...]:
    never = pair["never"]
    planned = "" if never else f"{min(pair['odds_planned'], 1e6):.3g}"
    told = "never, says the plan" if never else "settled" if pair["odds_planned"] >= ODDS else "open"
    return (
        trial["truth"], pair["rival"], f"{pair['odds_grid']:.2g}", f"{pair['corners']:.1f} sigma",
        "" if never else f"{pair['planned']:.1f} sigma", planned, told,
    )  # fmt: skip
