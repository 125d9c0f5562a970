"""What an export writes: files by their endings, and what their users have to know."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Content:
    """Files of a map by their endings, and warnings."""

    files: Mapping[str, bytes]
    warnings: tuple[str, ...] = ()
