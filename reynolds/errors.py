"""Errors of the program: an input that cannot be used, and a solution that was not found."""

from typing import Any


class InputError(ValueError):
    """An input that cannot be used: where, what was found, what was expected."""

    def __init__(self, where: str, found: str, expected: str) -> None:
        super().__init__(f"{where}: {found}; expected {expected}")
        self.where, self.found, self.expected = where, found, expected

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        """Arguments from which another process makes the same error."""
        return type(self), (self.where, self.found, self.expected)


class FilmInputError(InputError):
    """A film problem that cannot be posed."""


class BeyondBarus(FilmInputError):
    """A pressure beyond the range of Barus' law."""


class WallsOverlap(FilmInputError):
    """A given position at which a part lies in its wall: by its name, at a time (s), with its least gap (m)."""

    def __init__(self, part: str, time: float, least: float) -> None:
        super().__init__(f"{part} at {time:.6g} s", f"a least gap of {least:.3g} m", "walls apart")
        self.part, self.time, self.least = part, time, least

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        """Arguments from which another process makes the same error."""
        return type(self), (self.part, self.time, self.least)


class NotConverged(RuntimeError):
    """A solve ended without meeting its stated tolerance.

    The message states the solve, the tolerance reached, the tolerance demanded, and what to try.
    """


class FilmNotConverged(NotConverged):
    """The solve of a film stopped short of its tolerance: what was reached, and what to try."""

    def __init__(self, what: str, remedy: str) -> None:
        super().__init__(f"{what}. Try: {remedy}")
        self.what, self.remedy = what, remedy

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        """Arguments from which another process makes the same error."""
        return type(self), (self.what, self.remedy)
