"""Outcome of a command on a mutated file."""

from __future__ import annotations

import json
import re
import signal
from dataclasses import dataclass
from enum import Enum
from html.parser import HTMLParser
from pathlib import Path

from .mutations import CANARY, MARK

RAISED = 70
"""Exit code of a child in which an exception was not caught."""
MEMORY = 1_500_000_000
"""Bytes beyond which the memory of a command counts as unbounded."""
_PLACE = re.compile(
    r"swashfilm: (not converged: .|.+: \d+ faults?\n {2}\S|.+: found .+, expected |.+: .+; expected )", re.DOTALL
)
_LEFT = (".part", ".tmp", ".half")
"""Endings of files that are being written."""
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f\x80-\x9f]")


class Outcome(Enum):
    """Outcome of a case."""

    REFUSED = "refused in words"
    ACCEPTED = "accepted"
    TRACEBACK = "traceback"
    WORDLESS = "no place told"
    CRASH = "crash"
    HANG = "hang"
    MEMORY = "memory"
    RUN = "code run"
    INJECTED = "markup injected"
    HALF = "half file"
    OUTSIDE = "outside changed"

    @property
    def good(self) -> bool:
        """True for an outcome as promised: a refusal in words, or a complete result."""
        return self in (Outcome.REFUSED, Outcome.ACCEPTED)


@dataclass(frozen=True)
class Ended:
    """End of a command: its exit code or the signal, whether it had to be ended, its memory, its output."""

    code: int | None
    signal: int
    hung: bool
    memory: float
    said: str


def judged(folder: Path, ended: Ended, untouched: bool) -> tuple[Outcome, str]:
    """Return the outcome of a command in a folder, and its evidence."""
    last = ended.said.strip()[-300:]
    if any(folder.rglob(CANARY)):
        return Outcome.RUN, "the file was run"
    if not untouched:
        return Outcome.OUTSIDE, "a file outside was changed"
    if ended.hung or ended.signal in (signal.SIGXCPU, signal.SIGKILL):
        return Outcome.HANG, last
    if ended.memory > MEMORY or ("MemoryError" in ended.said and ended.code not in (2, 3)):
        return Outcome.MEMORY, f"{ended.memory / 1e6:.0f} MB: {last}"
    if ended.code is None:
        return Outcome.CRASH, f"signal {ended.signal}: {last}"
    if ended.code not in (0, 2, 3) or "Traceback (most recent" in ended.said:
        return Outcome.TRACEBACK, last
    if found := _CONTROL.search(ended.said):
        return Outcome.INJECTED, f"the terminal gets {found[0]!r}"
    for page in folder.rglob("*.html"):
        if told := injected(page):
            return Outcome.INJECTED, told
    if half := _half(folder, ended.code):
        return Outcome.HALF, half
    if ended.code == 0:
        return Outcome.ACCEPTED, ""
    if not _PLACE.match(ended.said[ended.said.find("swashfilm: ") :]):
        return Outcome.WORDLESS, last
    return Outcome.REFUSED, last[:120]


def injected(page: Path) -> str:
    """Return the parts of a page from a mutated file that are more than text; empty without any."""
    found = _Elements()
    if page.is_symlink() or not page.is_file() or MARK.encode() not in (content := page.read_bytes()):
        return ""
    if b"</html>" not in content:
        return ""  # the mutated page itself, which no command has written
    found.feed(content.decode("utf-8", "replace"))
    return found.told


class _Elements(HTMLParser):
    told = ""
    _script = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = dict(attrs)
        self._script = tag == "script" and named.get("type") in (None, "text/javascript", "module")
        if named.get("id") == MARK or "onerror" in named or "onmouseover" in named:
            self.told = f"<{tag}> by a file's text"

    def handle_data(self, data: str) -> None:
        if self._script and MARK in data:
            self.told = "a script by a file's text"


def _half(folder: Path, code: int) -> str:
    """Return the incomplete or not finite parts of the written files; empty without any."""
    if left := [path.name for path in folder.rglob("*") if path.name.endswith(_LEFT)]:
        return f"left behind: {', '.join(left)}"
    out = folder / "out"
    if code and out.exists():
        return "a result of a command that failed"
    if code == 0 and out.exists():
        try:
            json.loads((out / "summary.json").read_text("utf-8"), parse_constant=_refused)
        except (OSError, ValueError) as reason:
            return f"summary.json: {reason}"
        if not (out / "report.html").read_bytes().rstrip().endswith(b"</html>"):
            return "report.html ends early"
    return "a partial folder beside the result" if code == 0 and (folder / "out.partial").exists() else ""


def _refused(name: str) -> None:
    raise ValueError(f"{name} is no number")
