"""Figures that need no screen, and their pictures."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_BY_PYPLOT: ContextVar[bool] = ContextVar("by_pyplot", default=False)


def figure_of(width: float, height: float) -> Figure:
    """An empty figure of this size in inches whose parts keep clear of each other."""
    if _BY_PYPLOT.get():
        from matplotlib import pyplot

        return pyplot.figure(figsize=(width, height), layout="constrained")
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


@contextmanager
def pyplot_figures() -> Iterator[None]:
    """Figures made inside belong to pyplot: a notebook shows them, `pyplot.show` opens their windows."""
    before = _BY_PYPLOT.set(True)
    try:
        yield
    finally:
        _BY_PYPLOT.reset(before)


def png_of(figure: Figure) -> bytes:
    """The figure as a PNG of 110 dots an inch."""
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=110)
    return picture.getvalue()
