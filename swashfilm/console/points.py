"""What a run in points ends with, and what it is told on the command line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from system.work.tasks import PartStatus

EXIT_INTERNAL = 1
EXIT_NOT_CONVERGED = 3


def ended(summary: Mapping[str, Any]) -> int:
    """The exit code: 1 where an error of the program's own cost a point, 3 where no point has a result, else 0."""
    if any(point["status"] == PartStatus.INTERNAL.value for point in summary["failed"]):
        return EXIT_INTERNAL
    return 0 if summary["solved"] else EXIT_NOT_CONVERGED
