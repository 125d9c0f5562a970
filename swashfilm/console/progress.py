"""Progress of a long computation: a bar with the remaining time on a terminal, plain lines in a log."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TextIO

from swashfilm.console.compiling import Compiling, compilation
from system.work.progress import Report, Stage

LINE_EVERY = 5.0  # s between two lines in a log


@dataclass
class BeforeWriting:
    """Progress of the solution of a run, whose units in all include those of writing: `share` of the solution's."""

    report: Report
    share: float
    total: int = 0

    def __call__(self, done: int, total: int, what: str) -> None:
        self.total = total
        self.report(done, round(total * (1.0 + self.share)), what)

    def writing(self) -> None:
        """The solution is complete."""
        whole = round(self.total * (1.0 + self.share))
        self.report(self.total, whole, Stage("writing fields, pictures and report"))


@contextmanager
def progress(total: int, label: str, stream: TextIO | None = None) -> Iterator[Report]:
    """Yield a callback that shows the progress of `label`, by default on the standard error.

    The computation may correct the total, and return to a lower step (a new round). The remaining time is
    extrapolated from the steps of the present round. It is not shown before the first step, nor while the total is
    unknown (0). A line reports the compilation of the solvers, which is no part of the remaining time in a log.
    """
    out = sys.stderr if stream is None else stream
    if not out.isatty():
        with compilation(lambda text: _line(out, f"{label}: {text}")) as compiling:
            yield _lines(label, out, compiling)
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    time_left = TimeRemainingColumn(elapsed_when_finished=True)
    words = (TextColumn("{task.description}"), TextColumn("{task.fields[what]}"))
    columns = (words[0], BarColumn(), MofNCompleteColumn(), time_left, words[1])
    console = Console(file=out)
    with (
        compilation(lambda text: console.print(f"{label}: {text}", markup=False)),
        Progress(*columns, console=console, transient=True) as bar,
    ):
        task = bar.add_task(label, total=total or None, what="")

        def show(done: int, steps: int, what: str) -> None:
            if done < bar.tasks[task].completed:
                bar.reset(task)
            bar.update(task, completed=done, total=steps or None, what=what)

        yield show


def _line(out: TextIO, text: str) -> None:
    out.write(f"{text}\n")
    out.flush()


def _lines(label: str, out: TextIO, compiling: Compiling) -> Report:
    """Return a callback that writes lines: the first step, the last, and one every few seconds between."""
    began = round_began = time.monotonic()
    compiled = 0.0
    shown = began - LINE_EVERY
    last = 0

    def show(done: int, steps: int, what: str) -> None:
        nonlocal shown, last, round_began, compiled
        now = time.monotonic()
        if done < last:
            round_began, compiled = now, compiling.seconds
        last = done
        if now - shown < LINE_EVERY and not isinstance(what, Stage) and (done < steps or not steps):
            return
        shown = now
        spent = now - round_began - (compiling.seconds - compiled)
        ahead = f", {spent / done * (steps - done):.0f} s to go" if 0 < done < steps else ""
        count = f"{done}/{steps} " if steps else ""
        _line(out, f"{label}: {count}{what} ({now - began:.1f} s{ahead})")

    return show
