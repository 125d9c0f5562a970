"""Public benchmark of concealed physics: recordings of three pump plants, answers of any tool, one scorer."""

VERSION = 2
"""Raised when recordings or truths of a split change."""
