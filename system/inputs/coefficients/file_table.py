"""Tables of numbers that are read from a file: they compare and hash by their numbers, and keep its path."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path

from reynolds.numerics.cache import content_key


@dataclass(frozen=True, eq=False, repr=False)
class FileTable:
    """A table of a file: the file's path, and the source of its numbers."""

    path: Path
    source: str

    @cached_property
    def content(self) -> str:
        """Name of the table's content, without the path."""
        return content_key(*(getattr(self, own.name) for own in fields(self) if own.name != "path"))

    def __eq__(self, other: object) -> bool:
        """True for a table of the same file with the same numbers."""
        if not isinstance(other, FileTable):
            return NotImplemented
        return (type(self), self.path, self.content) == (type(other), other.path, other.content)

    def __hash__(self) -> int:
        return hash((self.path, self.content))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self.path)!r}, {self.content!r})"
