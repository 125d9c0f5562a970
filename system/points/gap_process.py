"""The revolutions of a round's gaps, some of them in processes of their own, parallel to the others.

A process keeps the last revolutions' films, so that only drives and reports are exchanged.
"""

import multiprocessing
import signal
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from gaps.films.physics import Physics
from gaps.revolution.march import GapRevolution
from reynolds.errors import NotConverged
from system.description.gap import Gap
from system.films.drives import Drives
from system.points.floating_exchange import FloatingGaps
from system.points.floating_kinds import Group, RoundDrives, drives_of, kinds_driven, options_of, revolutions
from system.points.floating_solved import Solved
from system.work.processes import cores
from system.work.progress import Report

Found = GapRevolution[Any]
REPORTS_A_TURN = 12


@dataclass(frozen=True)
class _Progress:
    done: int
    total: int
    what: str


@dataclass(frozen=True)
class _Solved:
    gap: Gap
    found: tuple[Found, ...]


class GapsBeside:
    """A process that solves some of the gaps: start a round, continue, fetch the results."""

    def __init__(self, gaps: tuple[Gap, ...], connection: Connection) -> None:
        self.gaps, self._connection = gaps, connection

    def start(self, asked: RoundDrives) -> None:
        """Begin a round, from the end of the one before."""
        self._connection.send(asked)

    def fetch(self, report: Report) -> Iterator[tuple[Gap, tuple[Found, ...]]]:
        """The gaps of the round begun, one by one: its revolutions without the start data of the next.

        Reports progress while it waits. Raises as `revolutions`, NotConverged where the process has died.
        """
        for _ in self.gaps:
            found = self._next(report)
            yield found.gap, found.found

    def _next(self, report: Report) -> _Solved:
        while True:
            try:
                received = self._connection.recv()
            except (EOFError, ConnectionResetError):
                names = " and ".join(gap.value.replace("_", " ") for gap in self.gaps)
                raise NotConverged(
                    f"the process of the {names} has died; try one process alone, or in a script of your own call it "
                    "under `if __name__ == '__main__':`"
                ) from None
            if isinstance(received, _Progress):
                report(received.done, received.total, received.what)
            elif isinstance(received, Exception):
                raise received
            else:
                assert isinstance(received, _Solved)
                return received


def gaps_apart(physics: Physics) -> tuple[tuple[Gap, ...], ...]:
    """The gaps of each process beside this one, so that all take about as long; a process has its start to catch up.

    Between elastic walls, or warm, slippers and block together take longer than the pistons, else the pistons do.
    """
    if physics.elastic_walls or physics.heat:
        return ((Gap.PISTON,), (Gap.SLIPPER,)) if cores() > 2 else ((Gap.PISTON,),)
    return ((Gap.SLIPPER,), (Gap.VALVE_PLATE,)) if cores() > 2 else ((Gap.SLIPPER, Gap.VALVE_PLATE),)


@contextmanager
def gaps_beside(
    group: Group, apart: tuple[tuple[Gap, ...], ...], before: Sequence[FloatingGaps] | None
) -> Iterator[tuple[GapsBeside, ...]]:
    """Processes for gaps as long as the context lasts; Ctrl-C is for this process alone, which ends them.

    before: the gaps from which the first round continues, if any.
    """
    with ExitStack() as stack:
        yield tuple(stack.enter_context(_process(group, gaps, before)) for gaps in apart)


@contextmanager
def _process(group: Group, gaps: tuple[Gap, ...], before: Sequence[FloatingGaps] | None) -> Iterator[GapsBeside]:
    spawning = multiprocessing.get_context("spawn")
    ours, theirs = spawning.Pipe()
    first = {gap: _before_of(gap, before) for gap in gaps}
    process = spawning.Process(target=_serve, args=(theirs, group, first), daemon=True)
    process.start()
    theirs.close()
    try:
        yield GapsBeside(gaps, ours)
    finally:
        ours.close()
        process.terminate()
        process.join()


def _before_of(gap: Gap, gaps: Sequence[FloatingGaps] | None) -> tuple[Found, ...]:
    """The revolutions of a gap, one of each kind of chambers, of the block alone; none without gaps."""
    match gap:
        case Gap.PISTON:
            return tuple(own.piston for own in gaps or ())
        case Gap.SLIPPER:
            return tuple(own.slipper for own in gaps or ())
        case Gap.VALVE_PLATE:
            return tuple(own.block for own in (gaps or ())[:1])


def _serve(connection: Connection, group: Group, first: Mapping[Gap, tuple[Found, ...]]) -> None:
    """Rounds of the gaps, one for each request, until the process ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    before = dict(first)
    while True:
        try:
            asked: RoundDrives = connection.recv()
        except EOFError:
            return
        found: list[_Solved | Exception] = []
        try:
            driven = drives_of(asked, group)
            for gap, last in before.items():
                before[gap] = tuple(revolutions(gap, asked, group, driven, last, _progress_to(connection)))
                found.append(_Solved(gap, tuple(one.bare for one in before[gap])))
        except Exception as reason:  # sent to the caller, which raises it
            found.append(reason)
        for one in found:  # last, since films wait in the pipe until they are fetched
            connection.send(one)


def _progress_to(connection: Connection) -> Report:
    """Progress, seldom enough for a pipe that is not read for a while."""

    def report(done: int, total: int, what: str) -> None:
        if done % max(1, total // REPORTS_A_TURN) == 0:
            connection.send(_Progress(done, total, what))

    return report


def gap_revolutions(
    asked: RoundDrives,
    group: Group,
    driven: Sequence[Drives],
    before: Sequence[FloatingGaps] | None,
    beside: Sequence[GapsBeside],
    report: Report,
    solved: Solved,
) -> tuple[FloatingGaps, ...]:
    """The gaps of each kind over the revolution, continued from those before.

    Those of processes `beside` are fetched from them, in which the round has started. Each gap is kept in `solved` as
    soon as it is found.
    """
    kinds, found = kinds_driven(asked, group, driven), {}
    apart = {gap for process in beside for gap in process.gaps}
    for gap in (one for one in Gap if one not in apart):
        turning = revolutions(gap, asked, group, driven, _before_of(gap, before), report)
        found[gap] = solved.keep(gap, kinds, options_of(gap, asked, group), turning)
    for process in beside:
        for gap, turned in process.fetch(report):
            found[gap] = solved.keep(gap, kinds, options_of(gap, asked, group), turned)
    (block,) = found[Gap.VALVE_PLATE]
    return tuple(
        FloatingGaps(piston, slipper, block, of.chambers[0])
        for piston, slipper, of in zip(found[Gap.PISTON], found[Gap.SLIPPER], kinds, strict=True)
    )
