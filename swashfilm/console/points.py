"""Exit code of a run in points."""

from collections.abc import Mapping
from typing import Any

from system.work.tasks import PartStatus

EXIT_INTERNAL = 1
EXIT_NOT_CONVERGED = 3


def ended(summary: Mapping[str, Any]) -> int:
    """Return the exit code: 1 after an internal error at a point, 3 where no point has a result, else 0."""
    if any(point["status"] == PartStatus.INTERNAL.value for point in summary["failed"]):
        return EXIT_INTERNAL
    return 0 if summary["solved"] else EXIT_NOT_CONVERGED
