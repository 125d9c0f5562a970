"""A floating film under a constant drive: held at a position, or at rest where its forces balance.

Rest is found by implicit Euler with steps that grow. Long steps do not depend on the path, so that the rest found is
stable and near the start; a motion without rest is an error with its cause.
"""

from dataclasses import replace

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.floating.problem import Floating
from reynolds.floating.stage import FloatingStage
from reynolds.floating.step import full_film
from reynolds.floating.trial import instant_of
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import BACKWARD_EULER, AcceptedStep, S, StageSolver, State, advance
from reynolds.problem import FilmSolution
from reynolds.solve.solver import FilmSolver

GROWTH = 4.0  # of a step after one that was solved
STILL = 3  # steps in a row that move no coordinate by more than allowed, each GROWTH times as long
PATIENCE = 3  # steps solved before a length without solution is tried again, which is costly
MOST_STEPS = 100
SHORTEST = 1e-6  # of the first step
FOR_EVER = 1e9  # s, a step that does not depend on the start


def held_at(
    solver: FilmSolver, floating: Floating, time: float, q: Array, warm: FilmSolution | None = None
) -> FloatingStage:
    """The film of a part held at a position (k,) m, its drive that of `time` (s): forces need not balance.

    Raises FilmInputError where walls overlap, FilmNotConverged where the film does not settle.
    """
    q = np.asarray(q, dtype=float)
    instant = instant_of(solver, floating, time, FOR_EVER, full_film(floating, time, q))
    return FloatingStage(time, instant.tried(q, warm), instant, films=1, steps=0, shift=np.zeros_like(q))


def come_to_rest(solve: StageSolver[S], start: State[S], step: float, allowed: float) -> AcceptedStep[S]:
    """The last step of a motion from `start`, its drive held at `start.time`.

    `step` (s) is the first one, about the response time of the motion. Afterwards three steps in a row, each four times
    the one before, have moved no coordinate by more than `allowed` (m). A step without solution is cut to a quarter,
    and tried again after PATIENCE of the shorter ones. Raises FilmInputError for an invalid step or tolerance,
    FilmNotConverged for a motion that reaches no rest, with its last move.
    """
    if not (np.isfinite(step) and step > 0.0 and allowed > 0.0):
        raise FilmInputError("rest", f"a step of {step:g} s and {allowed:g} m allowed", "both above zero")
    state, shortest, still, moved = replace(start, tangent=None), SHORTEST * step, 0, np.inf
    wait = 0  # steps of this size before a longer one is tried
    for _ in range(MOST_STEPS):
        try:
            taken = advance(BACKWARD_EULER, lambda time, *rest: solve(start.time, *rest), state, step)
        except FilmNotConverged as reason:
            step, still, wait = step / GROWTH, 0, PATIENCE
            if step < shortest:
                raise FilmNotConverged(f"no rest, last move {moved:.2g} m: {reason.what}", reason.remedy) from None
            continue
        moved = float(np.abs(taken.state.q - state.q).max())
        still = still + 1 if moved <= allowed else 0
        if still == STILL:
            return taken
        # The next guess is the position itself: a rate is no estimate over a step four times as long.
        state = replace(taken.state, rate=np.zeros_like(state.rate), acceleration=0.0)
        wait -= 1
        if wait <= 0:
            step *= GROWTH
        else:
            still = 0
    raise FilmNotConverged(f"no rest after {MOST_STEPS} steps, last move {moved:.2g} m", "a smaller force, rough walls")
