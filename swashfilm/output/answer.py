"""The answer of a page: its main numbers, a paragraph in plain words, and one picture."""

from __future__ import annotations

from dataclasses import dataclass

from swashfilm.output.touch.picture import Picture


@dataclass(frozen=True)
class Tile:
    """A number with its unit, its name, and a note: its error bar, its share or its place."""

    value: str
    name: str
    note: str = ""


@dataclass(frozen=True)
class Answer:
    """First part of a page.

    tiles: three to seven headline numbers. words: a paragraph that can be read out in a meeting. picture: the picture
    of the answer, or None.
    """

    tiles: tuple[Tile, ...]
    words: str
    picture: Picture | None = None
    caption: str = ""
