"""A picture as a page embeds it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Picture:
    """A static picture, and the same to touch.

    address: that of an image, with its content. touch: the packed figure that takes its place where the reader's
    browser can draw it, empty where there is none.
    """

    address: str
    touch: str = ""

    def __str__(self) -> str:
        return self.address
