"""Progress callback of a long computation."""

from collections.abc import Callable

Report = Callable[[int, int, str], None]
"""Called with the steps done, the steps in all and the present step's name."""


def silent(done: int, total: int, what: str) -> None:
    """Report progress to nobody."""
