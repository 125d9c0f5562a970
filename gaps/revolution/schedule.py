"""Reported angles of a gap's revolution, and the accuracy of its march and closure."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from reynolds.floating.stage import Closeness
from reynolds.numerics.arrays import Array

MORE_EXACT = 10.0  # times, at most, are the steps of the first turns
APART = 1e-9  # rad: nodes nearer than this are one
FEWEST = 24  # nodes of a whole turn with steps as wide as their error allows


@dataclass(frozen=True)
class Accuracy:
    """Accuracy of the march and closure of a revolution.

    step, floor: largest error of the film by one step, share of it in each place and m beside it; balance: share of
    that error within which forces are extrapolated along their slopes; closed: distance from the periodic motion, share
    of the mean film, and oil that differs in place after a turn, share of all; reach: distance of the next start from a
    turn's end, share of the least film there. settled: turns and temperatures until both agree; else one turn and its
    temperatures, on the way to a motion whose drive is still to change.
    """

    step: float = 1e-3
    floor: float = 1e-8
    balance: float = 1e-2
    closed: float = 1e-3
    reach: float = 0.25
    settled: bool = True

    @property
    def closeness(self) -> Closeness:
        """Required balance of the film of a stage."""
        return Closeness(self.balance * self.step, self.balance * self.floor)

    @property
    def rough(self) -> Accuracy:
        """The same for turns of wide steps that only lead near to the periodic motion.

        Their steps are more exact, so that the first turn that stops at all angles closes for a periodic motion.
        """
        if not self.settled:
            return self
        return replace(self, step=max(self.step / MORE_EXACT, min(self.step, self.closed)))


@dataclass(frozen=True)
class Schedule:
    """Schedule of a revolution: shaft speed rad/s, angles (n,) rad to report, `breaks` to step on, films to keep.

    Angles rise from above 0 to the last, at which the turn closes: 2 pi, or a pitch where parts and mesh repeat with
    it. `breaks` are those of kinks of the drive (a port opens). Every `keep`th reported film is kept; between such
    angles steps are as long as their accuracy allows, and reports there are interpolated.
    """

    speed: float
    angles: Array
    breaks: Array = field(default_factory=lambda: np.zeros(0))
    keep: int = 10

    @property
    def kept(self) -> Array:
        """Angles (rad) whose films are kept: every `keep`th."""
        return self.angles[self.keep - 1 :: self.keep]

    @property
    def nodes(self) -> Array:
        """Times (s) at which steps end: those of kept films, of the breaks and of the last angle."""
        stops = np.append(self.kept, self.angles[-1])
        inside = _apart(self.breaks[(self.breaks > 0.0) & (self.breaks < self.angles[-1])], stops)
        return np.unique(np.append(stops, inside)) / self.speed

    @property
    def wide(self) -> Schedule:
        """The same turn with its last angle alone to report, and few nodes besides its breaks."""
        span = self.angles[-1]
        count = max(1, round(FEWEST * span / (2.0 * np.pi)))
        nodes = _apart(span * np.arange(1, count) / count, self.breaks)
        return Schedule(self.speed, self.angles[-1:], np.union1d(self.breaks, nodes), keep=2)


def _apart(angles: Array, others: Array) -> Array:
    """Those of the angles (rad) that lie at none of the others: round-off beside one would be a step of its own."""
    return angles[np.abs(angles[:, None] - others).min(axis=1, initial=np.inf) > APART]


def evenly(speed: float, steps: int, span: float = 2.0 * np.pi, keep: int = 10) -> Schedule:
    """Every span/steps (rad) of the turn, every `keep`th film kept."""
    return Schedule(speed, span * np.arange(1, steps + 1) / steps, keep=keep)
