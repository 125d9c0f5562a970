"""Errors of a film that gives no number."""


class FilmInputError(ValueError):
    """A film problem that cannot be posed: where, what was found, what was expected."""

    def __init__(self, where: str, found: str, expected: str) -> None:
        super().__init__(f"{where}: {found}; expected {expected}")
        self.where, self.found, self.expected = where, found, expected

    def __reduce__(self) -> tuple[type, tuple[str, str, str]]:
        """Arguments from which another process rebuilds the error (pickle)."""
        return type(self), (self.where, self.found, self.expected)


class FilmNotConverged(RuntimeError):
    """The solve stopped short of its tolerance: what was reached, and what to try."""

    def __init__(self, what: str, remedy: str) -> None:
        super().__init__(f"{what}. Try: {remedy}")
        self.what, self.remedy = what, remedy

    def __reduce__(self) -> tuple[type, tuple[str, str]]:
        """Arguments from which another process rebuilds the error (pickle)."""
        return type(self), (self.what, self.remedy)
