"""The piston's revolutions in their own process, parallel to slipper and block.

The piston takes about as long as the other two together. Its process keeps the last revolution's films, so that
only drives and reports are exchanged.
"""

import multiprocessing
import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection

from gaps.films.reports import PistonReport
from gaps.revolution.march import GapRevolution
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.films.drives import Rubbing, drives
from system.films.parts import FloatingParts
from system.films.rotor import Rotor
from system.points.floating_gaps import FloatingOptions, piston_revolution
from system.work.progress import Report

Found = GapRevolution[PistonReport]
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


class PistonBeside:
    """A process that solves pistons, one of each kind: start them, continue, fetch the results."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def start(self, driven: tuple[Driven, ...]) -> None:
        """Begin a round, from the end of the one before."""
        self._connection.send(driven)

    def fetch(self, report: Report) -> tuple[Found, ...]:
        """The revolutions of the round begun, without the start data of the next; reports progress while it waits.

        Raises as `piston_revolution`, NotConverged where the process has died.
        """
        while True:
            try:
                received = self._connection.recv()
            except (EOFError, ConnectionResetError):
                raise NotConverged(
                    "the piston's process has died; try one process alone, or in a script of your own call it "
                    "under `if __name__ == '__main__':`"
                ) from None
            if isinstance(received, _Progress):
                report(received.done, received.total, received.what)
            elif isinstance(received, Exception):
                raise received
            else:
                return received


@contextmanager
def piston_beside(parts: tuple[FloatingParts, ...], before: Sequence[Found | None]) -> Iterator[PistonBeside]:
    """A process for the pistons as long as the context lasts; Ctrl-C is for this process alone, which ends it.

    before: the revolution from which each piston's first one continues, if any.
    """
    ours, theirs = multiprocessing.get_context("spawn").Pipe()
    process = multiprocessing.get_context("spawn").Process(target=_serve, args=(theirs, parts, before), daemon=True)
    process.start()
    theirs.close()
    try:
        yield PistonBeside(ours)
    finally:
        ours.close()
        process.terminate()
        process.join()


def _serve(connection: Connection, parts: tuple[FloatingParts, ...], first: Sequence[Found | None]) -> None:
    """Rounds of the pistons, one for each request, until the process ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    before = [*first]
    while True:
        try:
            asked: tuple[Driven, ...] = connection.recv()
        except EOFError:
            return
        try:
            found = [_solve(*each, _progress_to(connection)) for each in zip(asked, parts, before, strict=True)]
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


def _solve(asked: Driven, parts: FloatingParts, before: Found | None, report: Report) -> Found:
    driven = drives(asked.rotor, parts, asked.shaft_angle, asked.pressure, asked.rubbing)
    return piston_revolution(asked.rotor, parts, driven.piston, asked.options, before, report)
