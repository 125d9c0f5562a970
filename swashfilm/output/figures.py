"""Figures that need no screen, and their pictures as SVG and PNG."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MANY, _FEW = 3000, 100
_PLAIN = dict.fromkeys(("Date", "Creator", "Format", "Type"))
_PATH = re.compile(rb'(?<= d=")[^"]*')
_LONG = re.compile(rb"(\.\d\d)\d+")
_BLANKS = re.compile(rb"\s*([MLQCz])\s*")
_BETWEEN = re.compile(rb">\s+<")
_BY_PYPLOT: ContextVar[bool] = ContextVar("by_pyplot", default=False)


def figure_of(width: float, height: float) -> Figure:
    """Return an empty figure of this size in inches with a layout that avoids overlaps."""
    if _BY_PYPLOT.get():
        from matplotlib import pyplot

        return pyplot.figure(figsize=(width, height), layout="constrained")
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


@contextmanager
def pyplot_figures() -> Iterator[None]:
    """Create the figures inside by pyplot: a notebook shows them, `pyplot.show` opens their windows."""
    before = _BY_PYPLOT.set(True)
    try:
        yield
    finally:
        _BY_PYPLOT.reset(before)


def png_of(figure: Figure) -> bytes:
    """Return the figure as a PNG of 110 dots per inch."""
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=110)
    return picture.getvalue()


def svg_of(figure: Figure) -> bytes:
    """Return the figure as SVG with text as text.

    Areas are pictures inside it where they have many corners; contours stay lines up to that many each.
    """
    import numpy as np
    from matplotlib import rc_context
    from matplotlib.contour import ContourSet

    areas = [cells for axes in figure.axes for cells in axes.collections]
    corners = [int(sum(np.shape(path.vertices)[0] for path in cells.get_paths())) for cells in areas]
    for cells, count in zip(areas, corners, strict=True):
        few = _MANY if isinstance(cells, ContourSet) else _FEW
        cells.set_rasterized(sum(corners) > _MANY and count > few)
    picture = io.BytesIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "swashfilm"}):
        figure.savefig(picture, format="svg", dpi=110, metadata=_PLAIN)
    return _compact(picture.getvalue())


def _compact(svg: bytes) -> bytes:
    """Return an SVG without blanks between its elements, its paths to a hundredth of a point."""
    short = _PATH.sub(lambda path: _BLANKS.sub(rb"\1", _LONG.sub(rb"\1", path[0])), svg)
    return _BETWEEN.sub(b"><", short)
