"""Tables of steady points whose rows are samples of a series: each hardly differs from the row before."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

SET = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO)
"""Inputs that a bench sets, and that jump from point to point of a map."""
FEWEST = 300  # rows: more than any map of which no input jumps
MOVED = 0.05  # of the largest reading that such an input moves at least
JUMP = 0.05  # of the range of an input, beyond which a step between two rows is a jump
JUMPS = 0.02  # of the rows: in sampled stairs one row in fifty at most begins another stair


def rows_are_samples(readings: Array, names: Sequence[ChannelName]) -> bool:
    """True where set inputs change, but hardly ever from row to row; readings (N, C) in SI, columns as `names`.

    Points of a map, repeated or not, differ from one to the next in one input at least.
    """
    if len(readings) < FEWEST:
        return False
    jumps, moves = np.zeros(len(readings) - 1, dtype=bool), False
    for name in set(SET) & set(names):
        values = readings[:, list(names).index(name)]
        known = values[np.isfinite(values)]
        extent = float(np.ptp(known)) if known.size else 0.0
        if extent > MOVED * float(np.abs(known).max(initial=0.0)):
            moves = True
            jumps |= np.abs(np.diff(values)) > JUMP * extent
    return moves and float(jumps.mean()) <= JUMPS
