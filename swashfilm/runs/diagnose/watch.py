"""Watch of a recording: the diagnosis again whenever its files arrive or change, one line each time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from diagnosis.recording.reader import FILE
from diagnosis.report.format import effect_words
from diagnosis.report.text import finding, headline
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from reynolds.errors import InputError, NotConverged
from reynolds.numerics.files import read_text
from system.inputs.faults import InputFaults
from system.inputs.toml_table import parse_toml

POLL = 1.0  # s between two looks at the folder
SETTLE = 3  # looks without change before files count as complete
CHANGED_CHANCE = 0.1  # by which the probability of the same answer changes, to be reported

Stamp = tuple[int, int]
Files = Mapping[Path, Stamp]


@dataclass(frozen=True)
class Answer:
    """Verdict of one diagnosis in a sentence, probability by claimed effect, number of points, its page."""

    verdict: str
    effects: Mapping[str, float]
    points: int
    page: Path

    @property
    def text(self) -> str:
        """The answer in one line."""
        claimed = ", ".join(f"{name} (probability {chance:.2f})" for name, chance in self.effects.items())
        return f"{self.verdict.rstrip('.')}{f': {claimed}' if claimed else ''}, {self.points} points"


def answer_of(found: Diagnosis, points: int, page: Path) -> Answer:
    """The answer of a diagnosis of `points` points, in full on its page."""
    effects = {effect_words([claim.effect], claim.pair): claim.probability for claim in found.effects}
    words = headline(found)
    if found.status is VerdictStatus.SUSPICION:
        words = finding(found).partition(":")[0]
    return Answer(words, effects, points, page)


def watch(
    folder: Path,
    diagnosed: Callable[[], Answer],
    show: Callable[[str], None],
    pause: Callable[[float], None] = time.sleep,
) -> None:
    """Show a line for the present recording and for each change of its files; ends by KeyboardInterrupt alone.

    diagnosed: the diagnosis of the present files. A fault of the files and a fit that does not converge are shown, and
    the watch continues. pause: waits so many seconds.
    """
    last: Answer | None = None
    for _ in changes(folder, pause):
        clock = time.strftime("%H:%M:%S")
        try:
            answer = diagnosed()
        except (InputFaults, InputError) as reason:
            show(f"{clock} not diagnosed, waiting for the files to change: {_in_line(reason)}")
        except NotConverged as reason:
            show(f"{clock} not converged, waiting for more: {_in_line(reason)}")
        else:
            show(f"{clock} {compared(last, answer)}; {answer.page}")
            last = answer


def compared(last: Answer | None, answer: Answer) -> str:
    """An answer in one line, and its change since the last one."""
    if last is None:
        return f"first answer: {answer.text}"
    if (last.verdict, set(last.effects)) != (answer.verdict, set(answer.effects)):
        return f"the answer has changed: {answer.text}; before: {last.text}"
    if any(abs(answer.effects[name] - chance) > CHANGED_CHANCE for name, chance in last.effects.items()):
        return f"the same answer with another probability: {answer.text}; before: {last.text}"
    return f"the same answer: {answer.text}"


def changes(folder: Path, pause: Callable[[float], None]) -> Iterator[Files]:
    """Yield the files of a recording at once and after every change, when they have been still for `SETTLE` looks."""
    diagnosed: Files | None = None
    seen, still = recorded_files(folder), SETTLE if recorded_files(folder) else 0
    while True:
        if still >= SETTLE and seen != diagnosed:
            diagnosed = seen
            yield seen
        pause(POLL)
        now = recorded_files(folder)
        still = still + 1 if now == seen else 0
        seen = now


def recorded_files(folder: Path) -> Files:
    """Time and size of a folder's recording.toml and of the tables that it names, as far as they are there."""
    found: dict[Path, Stamp] = {}
    for path in [folder / FILE, *_tables(folder)]:
        try:
            status = path.stat()
        except OSError:  # gone since
            continue
        if path.is_file():
            found[path] = status.st_mtime_ns, status.st_size
    return found


def _tables(folder: Path) -> Iterator[Path]:
    """Tables named by recording.toml; none while it is absent or incomplete."""
    try:
        stated: dict[str, Any] = parse_toml(read_text(folder / FILE))
    except (OSError, ValueError):
        return
    for section in stated.values():
        if isinstance(section, dict) and isinstance(section.get("file"), str):
            yield folder / section["file"]


def _in_line(reason: Exception) -> str:
    """Return an error in one line: of each fault place, found and expected."""
    if isinstance(reason, InputFaults):
        told = (f"{one.path}: {one.found}, expected {one.expected}" for one in reason.faults)
        return "; ".join([reason.source, *told])
    return "; ".join(line.strip() for line in str(reason).splitlines())
