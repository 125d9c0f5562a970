"""Page of the check of planned campaigns, from the kept trials."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from ..calibration import wilson
from ..markdown import table
from .kept import all_grids, all_trials
from .plans import ADDED, CORNERS, SCORE
from .trial import ODDS, Pair, Told, Trial, concealed

HEAD = """# Check of planned campaigns

Does a campaign of `swashfilm plan` settle what a grid of the same size leaves open? The pump is the plant of the
[proof](proof.md), a simulation of another make with its own laws, noise, calibrations and tolerances. Something is
concealed in it, one thing at a time in a drawn order, as large as a score of {score:g} by the grid: it is seen, and
seldom named. The bench reads delivery flow, case drain, torque and all inputs at 36 points of a grid at one
temperature, as the campaign `map` of the proof: three displacements, three speeds, four pressures. A diagnosis
follows. Each rival that it leaves open beside the truth, at odds below {odds:g} to 1, makes a pair. The truth and
its open rivals are the suspects of a plan, which does not know which of them is the truth: {corners} corners of the
range of an ordinary bench, and up to {added} readings added, also at other temperatures (inlet at 30 to 80 degC) and
charge pressures (15 and 30 bar), as the proof's bench can set them. All suspects cost as much as makes the truth stand
out by {score:g} sigma on the grid.

The plan is asked twice: with the meters at hand, and with one meter more of its own choice. It may ask for an inlet
flow meter, a metered drain of one gap, the chamber pressure over the turn at four points, or two readings of the torque
meter with the pump uncoupled. The plant has these readings by its own laws, with meters like its others. Each campaign
is recorded on the same pump with the bench calibrated anew, and diagnosed by itself, without the grid. A pair is
settled at odds of {odds:g} to 1 for the truth.

Written by `python benchmarks/plan_check.py`.
"""
REASONS = """
What stays open, and why:

- Films and openings of different gaps are one in the case drain, as long as the films are known to their tolerance
  only: no point separates them, at any temperature or charge pressure. The drain of one gap does, where the pump's case
  can be made so that it is caught. It tells that gap from the two others, not these from each other: that needs a
  second one.
- A zero of the torque meter and a constant drag are one at every point. The meter read with the pump uncoupled
  separates them. The drag of a charge pump follows its pressure: points at two charge pressures separate it from both.
- "Best for this pair" shows that another choice of points would hardly change it: it has the same number of readings
  for the one pair.
- A distance is to first order, at the size that makes the truth stand out by 8 sigma on the grid. Where a pair is
  settled against what was foreseen, or open, the laws bend: those of the plant are not those of the program.
"""
TABLE = (
    "concealed", "open rival", "odds by the grid", "foreseen, grid", "best for this pair", "foreseen, points",
    "odds, points", "meter", "foreseen, meter", "odds, meter",
)  # fmt: skip


def write_page(results: Path, page: Path) -> Path:
    """Write the page of all trials in a folder."""
    trials = list(all_trials(results))
    lines = [HEAD.format(score=SCORE, odds=ODDS, corners=CORNERS, added=ADDED), *_counts(results, trials)]
    lines.append(table(TABLE, [_row(trial, pair) for trial in trials for pair in trial.pairs]))
    page.write_text("\n".join([*lines, REASONS]), encoding="utf-8")
    return page


def _counts(results: Path, trials: Sequence[Trial]) -> Iterator[str]:
    grids, pairs = list(all_grids(results)), [pair for trial in trials for pair in trial.pairs]
    minutes = (sum(one.seconds for one in grids) + sum(one.seconds for one in trials)) / 60.0
    yield (
        f"Of {len(concealed())} things that may be concealed the first {len(grids)} of a drawn order were tried, in "
        f"{minutes:.0f} min of process time. {len(trials)} of them left {len(pairs)} pairs open.\n"
    )
    points, meter = [pair.points for pair in pairs], [pair.meter for pair in pairs]
    foreseen = [[one for one in own if one.told] for own in (points, meter)]
    never, best = (sum(of) for of in zip(*((pair.never, pair.best_told) for pair in pairs), strict=True))
    yield f"- With one meter more {_share(meter)} of the open pairs are settled; the gate is 80 %."
    yield f"- By points alone {_share(points)}."
    yield f"- The plan foresees that no point of this bench tells {never} of them, however often it is read."
    yield f"- The ceiling of points alone: a campaign of {CORNERS + ADDED} readings made for one pair alone, of any"
    yield f"  points read as often as it likes (found by exchange), is foreseen to tell {best} of the {len(pairs)};"
    yield f"  the plan, which serves all pairs of a case at once, {len(foreseen[0])}."
    yield f"- Of the pairs that are foreseen to be told apart, {_share(foreseen[0])} are settled by points alone,"
    yield f"  {_share(foreseen[1])} with the meter."
    yield f"- Asked for: {_asked(trials)}.\n"


def _asked(trials: Sequence[Trial]) -> str:
    counts = Counter(trial.asked or "no meter" for trial in trials)
    return ", ".join(f"`{name}` {count} times" if name != "no meter" else f"no meter {count} times"
                     for name, count in counts.most_common())  # fmt: skip


def _share(told: Sequence[Told]) -> str:
    settled = sum(one.is_settled for one in told)
    if not told:
        return "none of none"
    low, high = wilson(settled, len(told))
    return f"{settled} of {len(told)} (Wilson's 95 % interval {low:.0%} to {high:.0%})"


def _row(trial: Trial, pair: Pair) -> tuple[str, ...]:
    return (
        trial.truth, pair.rival, f"{pair.odds:.2g}", f"{pair.distance:.1f} sigma",
        f"{pair.best:.1f} sigma, {'told apart' if pair.best_told else 'open'}",
        _foreseen(pair.points, "never" if pair.never else "open"), _odds(pair.points, trial.said[0]),
        f"`{trial.asked}`" if trial.asked else "none", _foreseen(pair.meter, "open"), _odds(pair.meter, trial.said[1]),
    )  # fmt: skip


def _foreseen(told: Told, other: str) -> str:
    return f"{told.distance:.1f} sigma, {'told apart' if told.told else other}"


def _odds(told: Told, said: str) -> str:
    if not said:
        return "none recorded"
    return f"{min(told.odds, 1e6):.3g}, {'settled' if told.is_settled else 'open'}"
