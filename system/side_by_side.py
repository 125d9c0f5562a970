"""Work that falls into parts, done by several processes side by side."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

Part = TypeVar("Part")
Result = TypeVar("Result")


def cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def side_by_side(task: Callable[[Part], Result], parts: Sequence[Part], workers: int) -> Iterator[Result]:
    """The results of `task` in the order in which they are done; one worker is this process itself.

    Task and parts must be fit to be sent to another process. Ctrl-C is for this process alone, which then stops
    the others after the parts they are at.
    """
    if workers == 1 or len(parts) < 2:
        yield from map(task, parts)
        return
    import multiprocessing
    import signal
    from concurrent.futures import ProcessPoolExecutor, as_completed

    pool = ProcessPoolExecutor(
        workers, multiprocessing.get_context("spawn"), signal.signal, (signal.SIGINT, signal.SIG_IGN)
    )
    try:
        for done in as_completed([pool.submit(task, part) for part in parts]):
            yield done.result()
    finally:
        pool.shutdown(cancel_futures=True)
