"""A diagnosis on the terminal: the answer in a few lines; contradictions of recording and pump before the fit."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from swashfilm.console.terminal import show_at_once

if TYPE_CHECKING:
    from diagnosis.recording.model import Recording

WIDTH = 100
MOST_LINES = 11
"""Of the answer: with the line on files twelve."""
MORE = " .."
"""Pointer to the page."""
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
    in the fit, of certainty, and of the finding, in this order; of the finding its cost goes before its rivals.
    """
    told = list(_paragraphs(answer))
    while len(lines := [line for one in told for line in textwrap.wrap(one.text, WIDTH)]) > most:
        longer = [at for at, one in enumerate(told) if len(one.sentences) > one.least]
        if not longer:
            return [*lines[: most - 1], f"{lines[most - 1][: WIDTH - len(MORE)]}{MORE}"]
        at = min(longer, key=lambda at: told[at].rank)
        told[at] = told[at].shorter()
    return lines


@dataclass(frozen=True)
class _Paragraph:
    """Sentences behind a heading, which may be cut down to `least`, the lowest rank first.

    The last ones are cut first, but `spare` ones before them.
    """

    heading: str
    sentences: tuple[str, ...]
    least: int
    rank: int
    spare: tuple[str, ...] = ()
    cut: str = ""

    @property
    def text(self) -> str:
        return f"{self.heading}{' '.join(self.sentences)}{self.cut}" if self.sentences else ""

    def shorter(self) -> _Paragraph:
        """The paragraph with one sentence less."""
        at = self.sentences.index(self.spare[-1]) if self.spare else len(self.sentences) - 1
        kept = (*self.sentences[:at], *self.sentences[at + 1 :])
        return replace(self, sentences=kept, spare=self.spare[:-1], cut=MORE)


def _paragraphs(answer: Mapping[str, Any]) -> Iterator[_Paragraph]:
    found = tuple(one for key in ("headline", "finding", "cost", "doubt") for one in _sentences(answer[key]))
    yield _Paragraph("", found, 2, 4, _sentences(answer["cost"]))
    yield _Paragraph("How sure: ", _sentences(answer["certainty"]), 1, 3)
    yield _Paragraph("", _sentences(" ".join(_looks(answer["look"]))), 1, 0)
    yield _Paragraph("Next: ", _sentences(answer["measure"]), 2, 1)
    yield _Paragraph("", _sentences(answer["fit"]), 0, 2)


def _looks(looks: Sequence[Mapping[str, str]]) -> Iterator[str]:
    """Places to inspect; of several causes, and of a suspicion, each behind the name of its cause."""
    for one in looks:
        yield f"{one['name']}: {one['text']}" if one["name"] else one["text"]


def _sentences(text: str) -> tuple[str, ...]:
    return tuple(_END.split(text)) if text else ()
