"""Periodic motion: the start that one turn leads back to, by many linearised turns for each that is run.

A turn maps the start q to its end M(q), with the slopes M' of that map. Marching turn after turn shrinks a
disturbance by the largest multiplier (eigenvalue of M') a turn, which is slow where that is near one. After
n turns of the linearised map q has moved by (1 + M' + ... + M'^(n-1)) (M(q) - q). For a stable motion that tends
to Newton's step (1 - M')^-1 (M(q) - q), the whole way at once; near an unstable one, where Newton's step goes
against the motion, it grows along the motion. The result is that of a march of many turns.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmNotConverged
from reynolds.numerics.arrays import Array

MOST_TURNS = 30
MOST_DOUBLINGS = 40  # of the linearised turns taken at once: 1e12 of them
CIRCLING = 0.999  # magnitude of a multiplier from which turns hardly come nearer: round-off decides whether they do
INWARDS = 3.0  # times the reach, for a start inside the circles that turns draw
RETREAT = 0.25  # of the reach, after a step too far


class Turn(Protocol):
    """One turn from a start q (k,) m."""

    @property
    def end(self) -> Array:
        """q at its end, (k,) m."""

    @property
    def slopes(self) -> Array:
        """d end / d start, (k, k)."""

    @property
    def allowed(self) -> float:
        """Distance (m) from the periodic motion at which a turn counts as closed."""

    @property
    def reach(self) -> float:
        """Largest change of the next start from this turn's end, m."""

    @property
    def repeats(self) -> bool:
        """True if the rest of the state (oil in the cavity) repeats, too."""


T = TypeVar("T", bound=Turn)

TurnFrom = Callable[[Array, T | None], T]
"""(start q (k,) m, turn before or None) -> turn."""


@dataclass(frozen=True)
class PeriodicTurn(Generic[T]):
    """The turn that closes from `start`, |end - start| of each turn on the way (m), eigenvalues of its slopes."""

    turn: T
    start: Array
    changes: tuple[float, ...]
    multipliers: NDArray[np.complex128]

    @property
    def turns(self) -> int:
        """Turns that were run."""
        return len(self.changes)

    @property
    def largest_multiplier(self) -> float:
        """Factor of a small disturbance of q over a turn; above one it grows, and the motion is unstable."""
        return float(np.abs(self.multipliers).max())

    @property
    def onward(self) -> Array:
        """Start (k,) m of the next turn: the end of linearised turns after this one, within its reach."""
        return _next(self.start, self.turn, 1.0)


def periodic(turn_from: TurnFrom[T], start: Array) -> PeriodicTurn[T]:
    """The periodic motion reached by turns from `start` (k,) m.

    Afterwards neither the turn nor all linearised ones after it lead further than `allowed` from its start in any
    coordinate, and the turn repeats. A start lies no further than `reach` from the end of the turn before; one
    from which the turn goes back, and further than it came, is replaced by a nearer one. Raises
    FilmNotConverged after MOST_TURNS: the motion is not periodic, unstable, or its start far away.
    """
    changes = []
    for at, turn in _turns(turn_from, start):
        changes.append(float(np.abs(turn.end - at).max()))
        away = np.abs(_next(at, turn, 1.0) - at).max()
        if max(away, changes[-1]) <= turn.allowed and turn.repeats:
            return _turned(turn, at, changes)
    raise _never_closed(changes)


def one_turn(turn_from: TurnFrom[T], start: Array) -> PeriodicTurn[T]:
    """One turn from `start` (k,) m, closed or not: for a motion whose drive is still to change."""
    turn = turn_from(start, None)
    return _turned(turn, start, [float(np.abs(turn.end - start).max())])


def _turned(turn: T, start: Array, changes: list[float]) -> PeriodicTurn[T]:
    return PeriodicTurn(turn, start, tuple(changes), np.linalg.eigvals(turn.slopes).astype(complex))


def approached(turn_from: TurnFrom[T], start: Array) -> PeriodicTurn[T]:
    """The first turn whose end is close to the periodic motion, at any distance of its start `start` (k,) m.

    Afterwards all linearised turns after it lead no further than `allowed` from its end. Cheaper than `periodic` where
    the end of a turn hardly depends on its start. Raises as that does.
    """
    changes = []
    for at, turn in _turns(turn_from, start):
        changes.append(float(np.abs(turn.end - at).max()))
        if np.abs(_next(at, turn, 1.0) - turn.end).max() <= turn.allowed:
            return _turned(turn, at, changes)
    raise _never_closed(changes)


def _never_closed(changes: list[float]) -> FilmNotConverged:
    lately = ", ".join(f"{change:.2g}" for change in changes[-4:])
    return FilmNotConverged(
        f"motion not periodic after {MOST_TURNS} turns, of which the last changed it by {lately} m",
        "a start nearer to it, or smaller steps in time",
    )


def _turns(turn_from: TurnFrom[T], start: Array) -> Iterator[tuple[Array, T]]:
    """MOST_TURNS turns, each with its start, from `start` on towards the periodic motion."""
    at, share = np.asarray(start, dtype=float), 1.0
    before: T | None = None
    last: tuple[Array, T] | None = None
    for _ in range(MOST_TURNS):
        turn = turn_from(at, before)
        yield at, turn
        before = turn
        if last is not None and _too_far(*last, at, turn):
            share *= RETREAT
            at, last = _next(*last, share), None
        else:
            share, last = min(1.0, 2.0 * share), (at, turn)
            at = _next(at, turn, share)


def _too_far(last_start: Array, last: Turn, start: Array, turn: Turn) -> bool:
    """True if a turn goes back, and further than the one before went forth."""
    forth, back = last.end - last_start, turn.end - start
    return bool(back @ (start - last_start) < 0.0 and np.abs(back).max() > np.abs(forth).max())


def _circles(slopes: Array) -> bool:
    """True if the turns circle the periodic motion, and none leads straight away: Newton's step leads to it.

    They do if the leading multipliers are complex or negative; those above one lead away along the circle.
    """
    multipliers = np.linalg.eigvals(slopes)
    sizes = np.abs(multipliers)
    leading = multipliers[sizes >= min(CIRCLING, sizes.max())]
    turning = (leading.imag != 0.0) | (leading.real < 0.0)
    return bool(np.all(turning & (np.abs(leading.imag) > leading.real - 1.0)))


def _next(start: Array, turn: Turn, share: float) -> Array:
    """The end of as many linearised turns as stay within reach of the turn's end; of turns that circle, inwards."""
    if _circles(turn.slopes):
        return _inwards(start, turn, share)
    reach = share * turn.reach
    way, power = turn.end - start, turn.slopes
    beyond = np.zeros(len(start))
    for _ in range(MOST_DOUBLINGS):
        further = way + power @ way
        beyond = further - (turn.end - start)
        if np.abs(beyond).max() > reach or np.array_equal(further, way):
            break
        way, power = further, power @ power
    return _within(reach, turn.end, beyond)


def _inwards(start: Array, turn: Turn, share: float) -> Array:
    """The start of the next turn towards the centre that turns circle, by Newton's step.

    From the turn's end within INWARDS times the reach, or from its start as far as the turn went: the one that comes
    nearer to the centre. The end of a turn along a wide circle is as far from the centre as its start.
    """
    way = turn.end - start
    centre = start + np.linalg.solve(np.eye(len(start)) - turn.slopes, way)
    from_end = _within(share * INWARDS * turn.reach, turn.end, centre - turn.end)
    from_start = _within(share * float(np.abs(way).max()), start, centre - start)
    return min(from_end, from_start, key=lambda place: float(np.abs(centre - place).max()))


def _within(reach: float, end: Array, beyond: Array) -> Array:
    """The place `beyond` an end, or as much of the way there as the reach allows."""
    return np.asarray(end + beyond * min(1.0, reach / max(float(np.abs(beyond).max()), 1e-300)))
