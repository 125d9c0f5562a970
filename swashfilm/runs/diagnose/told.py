"""A diagnosis on the terminal: the answer in a few lines; contradictions of recording and pump before the fit."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from swashfilm.console.terminal import show_at_once

if TYPE_CHECKING:
    from diagnosis.recording.model import Recording

WIDTH = 100
MOST_LINES = 10
"""Of the answer: with the lines on files, twelve."""
MORE = " .."
"""Where the page has more."""


def show_contradictions(recording: Recording) -> None:
    """Print where recording and pump file contradict each other."""
    from diagnosis.recording.model import NoteKind

    for note in recording.notes:
        if note.kind is NoteKind.CONTRADICTED:
            show_at_once(f"warning: {note.text}")


def answer_lines(answer: Mapping[str, Any]) -> list[str]:
    """The answer of a diagnosis in at most `MOST_LINES` lines of at most `WIDTH` columns.

    Where it is longer, the last sentences of the longest paragraph are left to the page.
    """
    told = [text for text in _paragraphs(answer) if text]
    while len(lines := [line for text in told for line in textwrap.wrap(text, WIDTH)]) > MOST_LINES:
        longest = max(range(len(told)), key=lambda at: (len(textwrap.wrap(told[at], WIDTH)), at))
        told[longest] = _shorter(told[longest])
    return lines


def _paragraphs(answer: Mapping[str, Any]) -> Iterator[str]:
    yield " ".join(filter(None, (answer["headline"], answer["finding"], answer["cost"])))
    yield f"How sure: {answer['certainty']}"
    yield " ".join(one["text"] for one in answer["look"])
    yield f"Next: {answer['measure']}"
    yield answer["fit"]


def _shorter(text: str) -> str:
    """The text without its last sentence; of one sentence without its last words."""
    whole = text.removesuffix(MORE)
    shorter, _, last = whole.rstrip(".").rpartition(". ")
    if not shorter:
        shorter = " ".join(last.split()[:-5])
    return f"{shorter.rstrip('.')}.{MORE}"
