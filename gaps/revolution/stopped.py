"""The end of a turn at an angle without a solution of the film."""

from typing import Any

from reynolds.errors import FilmNotConverged


class TurnStopped(FilmNotConverged):
    """A film without solution at a shaft angle (rad): what was reached, and what to try."""

    def __init__(self, what: str, remedy: str, angle: float) -> None:
        super().__init__(what, remedy)
        self.angle = angle

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        """Arguments from which another process makes the same error."""
        return type(self), (self.what, self.remedy, self.angle)


def replaced(reason: FilmNotConverged, what: str, remedy: str) -> FilmNotConverged:
    """The same error in other words."""
    if isinstance(reason, TurnStopped):
        return TurnStopped(what, remedy, reason.angle)
    return FilmNotConverged(what, remedy)
