"""A diagnosis on the terminal: the answer in a few lines; contradictions of recording and pump before the fit."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from typing import TYPE_CHECKING, Any

from swashfilm.console.terminal import show_at_once

if TYPE_CHECKING:
    from diagnosis.recording.model import Recording

WIDTH = 100
MOST_LINES = 11
"""Of the answer: with the line on files twelve."""
MORE = " .."
"""Pointer to the page."""
REMAINS = "A part of the mismatch remains"
"""First words of the doubt that follow on the rivals."""
_END = re.compile(r"(?<=\.) (?=[A-Z])")


def show_contradictions(recording: Recording, told: Recording | None = None) -> None:
    """Print contradictions of recording and pump file, without those already printed, `told`."""
    from diagnosis.recording.model import NoteKind

    for note in recording.notes:
        if note.kind is NoteKind.WARNED and (told is None or note not in told.notes):
            show_at_once(f"warning: {note.text}")


def answer_lines(answer: Mapping[str, Any], most: int = MOST_LINES) -> list[str]:
    """The answer of a diagnosis in at most `most` lines of at most `WIDTH` columns.

    From a longer one, last sentences are only on the page: of the inspection, of the measurement, the points not used
    in the fit, of certainty, of the finding its cost and what remains, the whole inspection, and the rivals, in this
    order.
    """
    told = list(_paragraphs(answer))
    while len(lines := [line for one in told for line in textwrap.wrap(one.text, WIDTH)]) > most:
        longer = [at for at, one in enumerate(told) if len(one.sentences) > one.least]
        if not longer:
            return [*lines[: most - 1], f"{lines[most - 1][: WIDTH - len(MORE)]}{MORE}"]
        at = min(longer, key=lambda at: told[at].due)
        told[at] = told[at].shorter()
    return lines


@dataclass(frozen=True)
class _Paragraph:
    """Sentences behind a heading, which may be cut to `few`, the lowest rank first, and to `least`, the lowest `late`.

    The last ones are cut first, but `spare` ones before them.
    """

    heading: str
    sentences: tuple[str, ...]
    few: int
    rank: int
    least: int
    late: int = 0
    spare: tuple[str, ...] = ()
    cut: str = ""

    @property
    def text(self) -> str:
        return f"{self.heading}{' '.join(self.sentences)}{self.cut}" if self.sentences else ""

    @property
    def due(self) -> int:
        """Rank of the next sentence to cut."""
        return self.rank if len(self.sentences) > self.few else self.late

    def shorter(self) -> _Paragraph:
        """The paragraph with one sentence less."""
        at = self.sentences.index(self.spare[-1]) if self.spare else len(self.sentences) - 1
        kept = (*self.sentences[:at], *self.sentences[at + 1 :])
        return replace(self, sentences=kept, spare=self.spare[:-1], cut=MORE)


def _paragraphs(answer: Mapping[str, Any]) -> Iterator[_Paragraph]:
    found = {key: _sentences(answer[key]) for key in ("headline", "finding", "cost", "doubt")}
    rivals = takewhile(lambda one: not one.startswith(REMAINS), found["doubt"])
    few = len(found["headline"]) + len(found["finding"]) + len(list(rivals))
    yield _Paragraph("", sum(found.values(), ()), few, 4, 2, 6, found["cost"])
    yield _Paragraph("How sure: ", _sentences(answer["certainty"]), 1, 3, 1)
    yield _Paragraph("", _sentences(" ".join(_looks(answer["look"]))), 1, 0, 0, 5)
    yield _Paragraph("Next: ", _sentences(answer["measure"]), 2, 1, 2)
    yield _Paragraph("", _sentences(answer["fit"]), 0, 2, 0)


def _looks(looks: Sequence[Mapping[str, str]]) -> Iterator[str]:
    """Places to inspect; of several causes, and of a suspicion, each behind the name of its cause."""
    for one in looks:
        yield f"{one['name']}: {one['text']}" if one["name"] else one["text"]


def _sentences(text: str) -> tuple[str, ...]:
    return tuple(_END.split(text)) if text else ()
