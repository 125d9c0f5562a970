"""Compiled work on equal parts, shared by threads: for kernels that release Python's lock (`nogil`)."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from multiprocessing import parent_process
from typing import TYPE_CHECKING, TypeVar

from system.work.processes import cores

if TYPE_CHECKING:
    from concurrent.futures import ThreadPoolExecutor

Result = TypeVar("Result")
SHARES = 2
"""Of a thread: parts need different times."""


def side_by_side(task: Callable[[slice], Result], count: int, fewest: int = 1) -> list[Result]:
    """Results of `task` over slices of `count` parts in their order, at least `fewest` parts a slice.

    A process that is one of several does all of the parts itself: the cores are in use already.
    """
    threads = 1 if parent_process() is not None else cores()
    shares = max(1, min(SHARES * threads, count // fewest)) if threads > 1 else 1
    borders = [count * share // shares for share in range(shares + 1)]
    slices = [slice(begin, end) for begin, end in pairwise(borders)]
    return [task(one) for one in slices] if shares == 1 else list(_threads(threads).map(task, slices))


@cache
def _threads(count: int) -> ThreadPoolExecutor:
    from concurrent.futures import ThreadPoolExecutor

    return ThreadPoolExecutor(count)
