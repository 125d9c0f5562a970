"""Progress callback of a long computation."""

from collections.abc import Callable

Report = Callable[[int, int, str], None]
"""Called with the steps done, the steps in all (0: not known yet) and the present step's name."""


class Stage(str):
    """Name of a step that is reported at once, since no further report follows for a while."""


def silent(done: int, total: int, what: str) -> None:
    """Ignore progress."""
