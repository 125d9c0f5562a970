"""The revolutions of pistons, or of slippers, in a process of their own, parallel to the block's.

A process keeps the last revolutions' films, so that only drives and reports are exchanged.
"""

import multiprocessing
import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any, Literal

from gaps.revolution.march import GapRevolution
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.films.drives import Rubbing, drives
from system.films.parts import FloatingParts
from system.films.rotor import Rotor
from system.points.floating_gaps import FloatingOptions, piston_revolution, slipper_revolution
from system.work.processes import cores
from system.work.progress import Report

Found = GapRevolution[Any]
OwnGap = Literal[Gap.PISTON, Gap.SLIPPER]
"""The gaps that each chamber has."""
REPORTS_A_TURN = 12


@dataclass(frozen=True)
class Driven:
    """Drives of piston and slipper of a kind of chambers.

    The pump at its point, pressure (N,) Pa over the chamber's angle (N,), friction.
    """

    rotor: Rotor
    shaft_angle: Array
    pressure: Array
    rubbing: Rubbing
    options: FloatingOptions


@dataclass(frozen=True)
class _Progress:
    done: int
    total: int
    what: str


class GapBeside:
    """A process that solves a gap, once for each kind of chambers: start it, continue, fetch the results."""

    def __init__(self, gap: OwnGap, connection: Connection) -> None:
        self._gap, self._connection = gap, connection

    def start(self, driven: tuple[Driven, ...]) -> None:
        """Begin a round, from the end of the one before."""
        self._connection.send(driven)

    def fetch(self, report: Report) -> tuple[Found, ...]:
        """The revolutions of the round begun, without the start data of the next; reports progress while it waits.

        Raises as `piston_revolution` and `slipper_revolution`, NotConverged where the process has died.
        """
        while True:
            try:
                received = self._connection.recv()
            except (EOFError, ConnectionResetError):
                raise NotConverged(
                    f"the process of the {self._gap.value} has died; try one process alone, or in a script of your "
                    "own call it under `if __name__ == '__main__':`"
                ) from None
            if isinstance(received, _Progress):
                report(received.done, received.total, received.what)
            elif isinstance(received, Exception):
                raise received
            else:
                return received


@dataclass(frozen=True)
class GapsBeside:
    """The processes of pistons and of slippers; None where this process solves the slippers."""

    pistons: GapBeside
    slippers: GapBeside | None


@contextmanager
def gaps_beside(
    parts: tuple[FloatingParts, ...], pistons: Sequence[Found | None], slippers: Sequence[Found | None]
) -> Iterator[GapsBeside]:
    """Processes for pistons and slippers, as `gap_beside`; their revolutions from which the first ones continue.

    On two cores the slippers have none: pistons take about as long as slippers and block together.
    """
    apart = cores() > 2
    with (
        gap_beside(Gap.PISTON, parts, pistons) as one,
        gap_beside(Gap.SLIPPER, parts, slippers) if apart else nullcontext() as other,
    ):
        yield GapsBeside(one, other)


@contextmanager
def gap_beside(gap: OwnGap, parts: tuple[FloatingParts, ...], before: Sequence[Found | None]) -> Iterator[GapBeside]:
    """A process for a gap as long as the context lasts; Ctrl-C is for this process alone, which ends it.

    before: the revolution from which the first one of each kind of chambers continues, if any.
    """
    spawning = multiprocessing.get_context("spawn")
    ours, theirs = spawning.Pipe()
    process = spawning.Process(target=_serve, args=(theirs, gap, parts, before), daemon=True)
    process.start()
    theirs.close()
    try:
        yield GapBeside(gap, ours)
    finally:
        ours.close()
        process.terminate()
        process.join()


def _serve(
    connection: Connection, gap: OwnGap, parts: tuple[FloatingParts, ...], first: Sequence[Found | None]
) -> None:
    """Rounds of the gap, one for each request, until the process ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    before = [*first]
    while True:
        try:
            asked: tuple[Driven, ...] = connection.recv()
        except EOFError:
            return
        try:
            found = [_solve(gap, *each, _progress_to(connection)) for each in zip(asked, parts, before, strict=True)]
        except Exception as reason:  # sent to the caller, which raises it
            connection.send(reason)
        else:
            before = [*found]
            connection.send(tuple(one.bare for one in found))


def _progress_to(connection: Connection) -> Report:
    """Progress, seldom enough for a pipe that is not read for a while."""

    def report(done: int, total: int, what: str) -> None:
        if done % max(1, total // REPORTS_A_TURN) == 0:
            connection.send(_Progress(done, total, what))

    return report


def _solve(gap: OwnGap, asked: Driven, parts: FloatingParts, before: Found | None, report: Report) -> Found:
    driven = drives(asked.rotor, parts, asked.shaft_angle, asked.pressure, asked.rubbing)
    if gap is Gap.PISTON:
        return piston_revolution(asked.rotor, parts, driven.piston, asked.options, before, report)
    return slipper_revolution(asked.rotor, parts, driven.slipper, asked.options, before, report)
