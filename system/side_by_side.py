"""Work that falls into parts, done by several processes side by side."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from concurrent.futures import Executor

Part = TypeVar("Part")
Result = TypeVar("Result")


def cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Crew:
    """Processes that take parts of any task, one after the other; one worker is this process itself."""

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._pool: Executor | None = None

    def do(self, task: Callable[[Part], Result], parts: Sequence[Part]) -> Iterator[Result]:
        """The results of `task` in the order in which they are done.

        Task and parts must be fit to be sent to another process. The others are started when they are first
        needed. Ctrl-C is for this process alone.
        """
        if self.workers == 1 or len(parts) < 2:
            yield from map(task, parts)
            return
        from concurrent.futures import as_completed

        if self._pool is None:
            self._pool = _pool(self.workers)
        for done in as_completed([self._pool.submit(task, part) for part in parts]):
            yield done.result()

    def leave(self) -> None:
        """Stop the others after the parts they are at."""
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)


@contextmanager
def crew(workers: int) -> Iterator[Crew]:
    """A crew for as long as it is needed."""
    hands = Crew(workers)
    try:
        yield hands
    finally:
        hands.leave()


def side_by_side(task: Callable[[Part], Result], parts: Sequence[Part], workers: int) -> Iterator[Result]:
    """The results of `task` in the order in which they are done, by a crew that leaves when it has done them."""
    with crew(workers) as hands:
        yield from hands.do(task, parts)


def _pool(workers: int) -> Executor:
    import multiprocessing
    import signal
    from concurrent.futures import ProcessPoolExecutor

    return ProcessPoolExecutor(
        workers, multiprocessing.get_context("spawn"), signal.signal, (signal.SIGINT, signal.SIG_IGN)
    )
