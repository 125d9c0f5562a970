"""Common parts of peers in Python: their arguments, kept data, the line that they print.

`peers.py` starts each peer once per mesh, with `benchmarks` on the path of modules:

    -degree 1 -cells 160 -rows 64 -repeats 5 -eccentricity 0.6 -method direct

A peer may keep, per mesh, all that its users would: mesh, unknowns, sparsity pattern, compiled code, symbolic
factorisation. The time is that of a changed film: from the assembly by the formula of the film (no stored values of it)
to the pressure. The first film, which compiles, is not timed. The clock is processor time, which other work on the
machine disturbs less than wall time; on one thread the two are otherwise the same.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import journal_case


@dataclass(frozen=True)
class Asked:
    """One mesh of one peer: order of the elements, cells round the bearing and over its half-width."""

    degree: int
    cells: int
    rows: int
    repeats: int
    eccentricity: float
    method: str


def asked() -> Asked:
    """The arguments of this process."""
    parser = argparse.ArgumentParser()
    for name in ("degree", "cells", "rows", "repeats"):
        parser.add_argument(f"-{name}", type=int, required=True)
    parser.add_argument("-eccentricity", type=float, required=True)
    parser.add_argument("-method", default="")
    return Asked(**vars(parser.parse_args()))


def least(action: Callable[[], object], repeats: int) -> float:
    """Smallest processor time of the repeats, s."""
    return journal_case.least(action, repeats, time.process_time)


def report(version: str, unknowns: int, solve: float, along: float, across: float) -> None:
    """Print the line that `peers.py` reads: times in s; force of the whole bearing's positive pressures."""
    found = {
        "version": version,
        "unknowns": int(unknowns),
        "solve_s": solve,
        "load": math.hypot(along, across),
        "attitude_deg": math.degrees(math.atan2(across, -along)),
    }
    print(json.dumps(found))
