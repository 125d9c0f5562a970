"""Distance of the located mismatch from the true one: regions of the map, windows of shaft angle."""

from __future__ import annotations

from math import degrees, pi

import numpy as np

from .outcome import Outcome

HALF = 0.5  # of the largest shift: points with less do not belong to a region
TURN = 2.0 * pi
WIDEST = pi / 3.0  # rad, of a stated window: thresholds.toml


def region_overlap(outcome: Outcome) -> float:
    """Points that are in both regions over points that are in one: stated, and true in the first stated channel.

    True are points at which the shift of that channel is at least HALF of its largest. nan if nothing is stated, or
    without a shift of the channel.
    """
    moved = np.abs(outcome.shift.get(outcome.channels[0], ())) if outcome.channels else np.zeros(0)
    if outcome.region is None or moved.size == 0 or moved.max() == 0.0:
        return float("nan")
    told = np.isin(np.arange(moved.size), outcome.region)
    true = moved >= HALF * moved.max()
    return float(np.sum(told & true) / np.sum(told | true))


def turn_error(outcome: Outcome) -> float:
    """Degrees from the middle of the stated window to the middle of the true one; nan if either is missing.

    A true window wider than WIDEST, the limit of stated ones, spans two places, such as both transitions with a worn
    groove: to the nearer of its ends.
    """
    if outcome.turn is None or outcome.true_turn is None:
        return float("nan")
    start, end = outcome.true_turn
    breadth = (end - start) % TURN
    true = (start, end) if breadth > WIDEST else (start + 0.5 * breadth,)
    told = outcome.turn[0] + 0.5 * ((outcome.turn[1] - outcome.turn[0]) % TURN)
    return min(abs(degrees((told - one + pi) % TURN - pi)) for one in true)
