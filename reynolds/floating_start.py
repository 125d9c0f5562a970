"""Where a march of a floating film begins: what it holds at a position, and how that changes with the position."""

from __future__ import annotations

import numpy as np

from reynolds.dirk import State, Tangent
from reynolds.errors import FilmInputError
from reynolds.floating import Floating
from reynolds.floating_stage import Stage, standing
from reynolds.mesh import Array
from reynolds.sensitivity import Response, oil_slopes

NUDGE = (
    1e-9  # m: of the position, for the slope of what a film holds, which is linear but for rough walls that touch
)


def started(floating: Floating, time: float, q: Array) -> State[Stage]:
    """A full film standing still at a position (k,) m, with the tangent of its position.

    Raises FilmInputError where walls overlap, as `standing` does.
    """
    q = np.asarray(q, dtype=float)
    columns = []
    for nudge in NUDGE * np.eye(len(q)):
        ahead, behind = (standing(floating, time, q + sign * nudge) for sign in (1.0, -1.0))
        columns.append((ahead - behind) / (2.0 * NUDGE))
    tangent = Tangent(np.eye(len(q)), np.column_stack(columns))
    return State(time, q, standing(floating, time, q), np.zeros(len(q)), tangent=tangent)


def restarted(floating: Floating, time: float, last: State[Stage], q: Array) -> State[Stage]:
    """What the end of a march holds, moved to a position (k,) m: the start of the next one, with its tangent.

    The film fraction of each unknown stays, and its oil changes with the film over it; so does the rate. Raises
    FilmInputError where that leaves less than no oil somewhere.
    """
    stage = last.stage
    if stage is None:
        return started(floating, time, q)
    k = len(stage.q)
    nothing = np.zeros((len(stage.solution.pressure), k))
    oil = oil_slopes(stage.solution, stage.trial.thicker, Response(nothing, nothing))
    beside = np.zeros((len(last.held) - len(oil), k))  # position, and rates where walls have inertia
    beside[:k] = np.eye(k)
    slopes = np.vstack([oil, beside])
    held = last.held + slopes @ (q - stage.q)
    least = float(held[: len(oil)].min())
    if least < min(0.0, float(last.held[: len(oil)].min())):
        found = f"{least:.3g} m3 of oil at an unknown, {np.abs(q - stage.q).max():.3g} m from the last position"
        raise FilmInputError(f"{floating.name}, start of a turn", found, "a position nearer to it")
    return State(time, np.asarray(q, dtype=float), held, last.rate, last.bend, stage, Tangent(np.eye(k), slopes))
