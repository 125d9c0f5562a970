"""Start of a film from one near it, or anew."""

from collections.abc import Callable
from typing import Any, TypeVar

from reynolds.errors import FilmNotConverged

Solved = TypeVar("Solved")


def from_last_or_anew(solve: Callable[[Any], Solved], last: Any) -> Solved:
    """The solution from the film before; where that fails (a cavity opens everywhere), from a cold start, None."""
    try:
        return solve(last)
    except FilmNotConverged:
        if last is None:
            raise
        return solve(None)
