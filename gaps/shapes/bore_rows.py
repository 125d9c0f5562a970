"""Rows along a bore, closer where a run-in edge's wedge carries: as shares of a length, from 0 to 1.

A film ends at both edges. Of the bushing the case edge stays under the film's end, of the piston its chamber end;
over what is left of either the other's edge passes.
"""

from __future__ import annotations

import numpy as np

from reynolds.numerics.arrays import Array

EDGES = 0.8  # of a row's length is taken off at an edge, and put on where rows are widest


def closer_at_both(share: Array) -> Array:
    """Even shares drawn to both edges, widest in the middle."""
    return np.asarray(share - EDGES / (2.0 * np.pi) * np.sin(2.0 * np.pi * share))


def closer_at_start(share: Array) -> Array:
    """Even shares drawn to the first edge, as they were in the middle and widest at the last."""
    return np.asarray(share - EDGES / np.pi * np.sin(np.pi * share))


def closer_at_end(share: Array) -> Array:
    """The mirror image of `closer_at_start`."""
    return 1.0 - closer_at_start(1.0 - share)
