"""Report of the compilation of the solvers, which is no part of the remaining time.

numba compiles a kernel at its first call on a machine and keeps it on disk.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

REPORTED_FROM = 2.0
"""Shortest compilation that is reported, s."""


class Compiling:
    """Compilation by this process: its time so far, s; `report` gets a line once it exceeds REPORTED_FROM."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report, self._depth, self._began, self._reported = report, 0, 0.0, False
        self.seconds = 0.0

    def begin(self) -> None:
        """Start the clock; a compilation within another is part of it."""
        self._depth += 1
        if self._depth == 1:
            self._began = time.monotonic()

    def end(self) -> None:
        """Stop the clock."""
        self._depth -= 1
        if self._depth:
            return
        self.seconds += time.monotonic() - self._began
        if self.seconds > REPORTED_FROM and not self._reported:
            self._reported = True
            self._report("compiling the solvers for this machine, once; later runs do without")

    def finish(self) -> None:
        """Report the whole time of a compilation that was reported."""
        if self._reported:
            self._report(f"compiled in {self.seconds:.0f} s")


@contextmanager
def compilation(report: Callable[[str], None]) -> Iterator[Compiling]:
    """Yield the compilation within the context, with a `report` of it; None where numba is not loaded."""
    found = Compiling(report)
    if "numba" not in sys.modules:
        yield found
        return
    from numba.core import event

    class Listener(event.Listener):
        """Compilation of kernels."""

        def on_start(self, event: Any) -> None:
            found.begin()

        def on_end(self, event: Any) -> None:
            found.end()

    with event.install_listener("numba:compile", Listener()):
        yield found
    found.finish()
