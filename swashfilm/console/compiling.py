"""Compilation of the solvers: told while it is under way, and left out of the remaining time.

numba compiles a kernel at its first call on a machine and keeps it on disk.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

WORTH_TELLING = 2.0
"""Compilation (s) from which it is told."""


class Compiling:
    """Time spent in compilation so far, by this process; `tell` gets a line once that is worth it."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell, self._depth, self._began, self._told = tell, 0, 0.0, False
        self.seconds = 0.0

    def begin(self) -> None:
        """Count from now on; compilations within one count once."""
        self._depth += 1
        if self._depth == 1:
            self._began = time.monotonic()

    def end(self) -> None:
        """Count no longer."""
        self._depth -= 1
        if self._depth:
            return
        self.seconds += time.monotonic() - self._began
        if self.seconds > WORTH_TELLING and not self._told:
            self._told = True
            self._tell("compiling the solvers for this machine, once; later runs do without")

    def finish(self) -> None:
        """Tell the whole time, if compilation was told."""
        if self._told:
            self._tell(f"compiled in {self.seconds:.0f} s")


@contextmanager
def compilation(tell: Callable[[str], None]) -> Iterator[Compiling]:
    """Yield the compilation within the context, told by `tell`; none where numba is not loaded."""
    found = Compiling(tell)
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
