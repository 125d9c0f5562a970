"""Errors of the pump model: what could not be computed is raised, never returned as a number."""


class NotConverged(RuntimeError):
    """A solve ended without meeting its stated tolerance.

    The message says which solve, how far it got, what was demanded, and what to try.
    """
