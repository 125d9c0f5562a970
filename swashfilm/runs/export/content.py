"""Content of an export: files by their endings, and warnings for their users."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Content:
    """Files of a map by their endings, and warnings."""

    files: Mapping[str, bytes]
    warnings: tuple[str, ...] = ()
