"""Work that falls into parts, done by several processes side by side; a process that dies loses its part only."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from concurrent.futures import Future, ProcessPoolExecutor

Part = TypeVar("Part")
Result = TypeVar("Result")
TICK = 2.0
"""Time between two calls of `meanwhile`, s."""
DIED = "its process died twice, the second time alone: out of memory, or killed from outside"


class WorkerDied(RuntimeError):
    """The process of a part died, and died again with this part alone."""


@dataclass(frozen=True)
class Attempt(Generic[Part, Result]):
    """Result of a part, or the exception that explains its absence."""

    part: Part
    result: Result | None
    fault: Exception | None


def cores() -> int:
    """Number of cores available to this process."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class ProcessPool:
    """Processes that run parts of any task, one after the other; one worker is this process itself."""

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._pool: ProcessPoolExecutor | None = None
        self._begun: set[Future[Any]] = set()

    @property
    def here(self) -> bool:
        """True: all processes are on this machine."""
        return True

    def do(self, task: Callable[[Part], Result], parts: Sequence[Part]) -> Iterator[Result]:
        """The results of `task` in the order of completion; raises the exception of the first part that fails.

        Task and parts as those of `attempts`.
        """
        for attempt in self.attempts(task, parts):
            if attempt.fault is not None:
                raise attempt.fault
            yield attempt.result  # type: ignore[misc]  # a part without a fault has its result

    def attempts(
        self, task: Callable[[Part], Result], parts: Sequence[Part], meanwhile: Callable[[], None] | None = None
    ) -> Iterator[Attempt[Part, Result]]:
        """Result of each part, in the order of completion; no part's failure ends the others.

        `meanwhile` is called every `TICK` seconds while other processes are at parts.

        Task and parts must be picklable. The processes start when they are first needed. Only this process receives
        Ctrl-C. Parts under way when a process died are tried once more, each alone, to identify the one which kills its
        process: its fault is WorkerDied.
        """
        if self.workers == 1 or len(parts) < 2:
            yield from (_tried(task, part) for part in parts)
            return
        waiting, suspects = deque(parts), deque[Part]()
        while waiting or suspects:
            alone = bool(suspects)
            lost: list[Part] = []
            some, most = (suspects, 1) if alone else (waiting, self.workers)
            yield from self._until_a_death(task, some, most, lost, meanwhile)
            if alone:
                yield from (Attempt(part, None, WorkerDied(DIED)) for part in lost)
            else:
                suspects.extend(lost)

    def leave(self) -> None:
        """Stop the others after the parts they are at; at once after a further Ctrl-C."""
        if self._pool is None:
            return
        from concurrent.futures import wait

        try:
            for future in self._begun:
                future.cancel()
            wait(self._begun)
        finally:
            self._stop()

    def _stop(self) -> None:
        """Stop the others at once.

        The pool's own end is not relied on (CPython 3.11): after a Ctrl-C it may wait for ever for processes that it
        has told nothing, and one that starts while the pool breaks is missed by its clean-up.
        """
        pool, self._pool = self._pool, None
        self._begun.clear()
        if pool is not None:
            for process in list((pool._processes or {}).values()):
                process.kill()
            pool.shutdown(cancel_futures=True)

    def _until_a_death(
        self,
        task: Callable[[Part], Result],
        parts: deque[Part],
        most: int,
        lost: list[Part],
        meanwhile: Callable[[], None] | None,
    ) -> Iterator[Attempt[Part, Result]]:
        """Take parts, `most` at a time, until none is left or a process dies, whose parts are then `lost`."""
        from concurrent.futures import FIRST_COMPLETED, wait
        from concurrent.futures.process import BrokenProcessPool

        flying: dict[Future[Result], Part] = {}
        while parts or flying:
            try:
                while parts and len(flying) < most:
                    begun = self._hands().submit(task, parts[0])
                    flying[begun] = parts.popleft()
                    self._begun.add(begun)
            except BrokenProcessPool:  # found at the next submit: what flies is lost, if anything flies
                if not flying:
                    self._stop()
                    continue
            done = wait(flying, TICK if meanwhile else None, FIRST_COMPLETED).done
            if meanwhile and not done:
                meanwhile()
            landed = {future: flying.pop(future) for future in done}
            self._begun -= done
            broken = {f: part for f, part in landed.items() if isinstance(f.exception(), BrokenProcessPool)}
            yield from (_landed(f, part) for f, part in landed.items() if f not in broken)
            if broken:
                lost.extend([*broken.values(), *flying.values()])
                self._stop()
                return

    def _hands(self) -> ProcessPoolExecutor:
        if self._pool is None:
            import multiprocessing
            from concurrent.futures import ProcessPoolExecutor

            self._pool = ProcessPoolExecutor(self.workers, multiprocessing.get_context("spawn"), _begin)
        return self._pool


HERE = ProcessPool(1)
"""This process itself."""


@contextmanager
def process_pool(workers: int) -> Iterator[ProcessPool]:
    """A process pool, ended at the end of the block."""
    executor = ProcessPool(workers)
    try:
        yield executor
    finally:
        executor.leave()


def _tried(task: Callable[[Part], Result], part: Part) -> Attempt[Part, Result]:
    """A part done by this process itself."""
    try:
        return Attempt(part, task(part), None)
    except Exception as fault:  # any exception is the part's reason, or raised by `do`
        return Attempt(part, None, fault)


def _landed(future: Future[Result], part: Part) -> Attempt[Part, Result]:
    fault = future.exception()
    if fault is not None and not isinstance(fault, Exception):
        raise fault
    return Attempt(part, None if fault else future.result(), fault)


def _begin() -> None:
    """Set up a new process: it ignores Ctrl-C and does not outlive the one that started it."""
    import signal
    from threading import Thread

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_leave_with_parent, daemon=True).start()


def _leave_with_parent() -> None:
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
