"""A picture as a page embeds it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Picture:
    """A static picture, and its interactive form.

    address: that of an image, with its content. touch: the packed figure that replaces it if the reader's browser can
    draw it, empty without one.
    """

    address: str
    touch: str = ""

    def __str__(self) -> str:
        return self.address
