"""Progress of a floating point as a whole, in units of work: rounds until agreement, gaps of a round, turns of a gap.

The number of rounds is not known in advance: before the first has ended there is no total. The first round takes
longer, since its films have no start. The number of the others is estimated from the mean rate at which the changes
fell; it is at least the usual one until the changes are within their tolerances.
"""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from system.description.gap import Gap
from system.work.progress import Report

FIRST, LATER = 100, 70
"""Units of the first round and of a later one (`ref90`, all physics: 11 s and 6 to 9 s on two cores)."""
EXPECTED_ROUNDS = 6
SLOWEST = 0.8
"""Factor by which a round reduces the changes, at most."""
_NAMES = {Gap.PISTON: "piston", Gap.SLIPPER: "slipper", Gap.VALVE_PLATE: "block"}
GAP_SHARES = {"slipper": 0.25, "block": 0.3, "piston": 0.45}
"""Share of each gap in the work of a round."""
WAITING = 0.15
"""Share of a round in which this process waits for those of other gaps."""
TURNS = 1
"""Number of turns after which a gap counts as nine tenths solved."""


def shares_of_gaps(apart: Collection[Gap] = ()) -> Mapping[str, float]:
    """Share of each gap in the time of a round, by the name of its progress; apart: gaps of other processes."""
    if not apart:
        return GAP_SHARES
    elsewhere = {_NAMES[gap] for gap in apart}
    found: dict[str, float] = {}
    for names, time in ((elsewhere, WAITING), (set(GAP_SHARES) - elsewhere, 1.0 - WAITING)):
        whole = sum(GAP_SHARES[name] for name in names)
        found |= {name: time * GAP_SHARES[name] / whole for name in names}
    return found


@dataclass
class WholeRun:
    """Progress of one point: reports to `report` the units done and the total, as known now.

    shares: of the gaps in a round; most: rounds.
    """

    report: Report
    most: int
    shares: Mapping[str, float]
    rounds: int = 0
    expected: int = EXPECTED_ROUNDS
    changes: list[float] = field(default_factory=list)
    turns: dict[str, set[str]] = field(default_factory=dict)
    done: int = 0

    def begun(self) -> Report:
        """A round begins; returns the progress callback of its gaps."""
        self.rounds += 1
        self.turns = {}
        return self._turn

    def ended(self, change: float) -> None:
        """A round has ended; change: the largest of its changes over its tolerance."""
        self.changes.append(change)
        self.expected = min(self.most, self.rounds + self._left(change))
        self.done = max(self.done, self._before(self.rounds + 1))

    def _left(self, change: float) -> int:
        """Rounds still expected: the changes continue to fall at their rate, and the last round confirms it."""
        if change <= 1.0:
            return 1
        usual = max(1, EXPECTED_ROUNDS - self.rounds)
        if self.rounds == 1:
            return usual
        rate = min((change / max(self.changes[0], 1.0)) ** (1.0 / (self.rounds - 1)), SLOWEST)
        return max(usual, math.ceil(math.log(change) / -math.log(rate)))

    def _turn(self, done: int, total: int, what: str) -> None:
        """One report of a gap: steps of a turn whose name begins with the gap's."""
        gap, _, turn = what.partition(", ")
        self.turns.setdefault(gap, set()).add(turn)
        *passed, last = self.turns
        of_last = 1.0 - 0.1 ** ((len(self.turns[last]) - 1 + done / total) / TURNS)
        share = sum(self.shares[one] for one in passed) + of_last * self.shares[last]
        units = FIRST if self.rounds == 1 else LATER
        self.done = max(self.done, self._before(self.rounds) + int(share * units))
        known = max(self._before(self.expected + 1), self.done) if self.changes else 0
        self.report(self.done, known, f"round {self.rounds}, {what}")

    def _before(self, number: int) -> int:
        """Units of the rounds before one."""
        return 0 if number == 1 else FIRST + LATER * (number - 2)
