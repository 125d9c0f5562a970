"""Figures that need no screen, and their pictures as SVG, PNG and WebP."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from swashfilm.output.touch.fields import kept_field

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.backend_bases import FigureCanvasBase
    from matplotlib.figure import Figure
    from PIL.Image import Image
    from typing_extensions import Buffer

Canvas = TypeVar("Canvas", bound="FigureCanvasBase")
_MANY, _FEW = 3000, 100
LARGE = 16_000
"""Bytes of an SVG in a page; a larger one becomes a picture of pixels, mostly a third as large."""
_LONGEST = 5 * LARGE // 2
"""Bytes of an SVG that is LARGE even when its numbers are shortened."""
_INKS = 32
"""Number of colours of a picture of lines."""
_FIELD_QUALITY, _FIELD_DPI, _LINES_DPI = 50, 64, 90
FEWEST_PIXELS = 700
"""Least width of a picture of a field."""
_PLAIN = dict.fromkeys(("Date", "Creator", "Format", "Type"))
_FONTS = ["DejaVu Sans", "Verdana"]
_PATH = re.compile(rb'(?<= d=")[^"]*')
_LONG = re.compile(rb"(\.\d)\d+")
_BLANKS = re.compile(rb"\s*([MLQCz])\s*")
_BETWEEN = re.compile(rb">\s+<")
_NAMES = re.compile(rb' id="(?:figure|axes|[xy]tick|line2d|patch|text|matplotlib\.axis|QuadContourSet)_\d+"')
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


def legend_below(axes: Axes, columns: int = 2) -> None:
    """Name the curves below the axes, where the names cover none of them."""
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22), ncols=columns, fontsize="small", frameon=False)


def legend_beside(axes: Axes) -> None:
    """Name the curves on the right of the axes, where the names cover none of them."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize="small", frameon=False)


def _literal(figure: Figure) -> None:
    """Draw texts literally: a dollar sign in a name begins no formula. Powers of ten beside log axes remain some."""
    from matplotlib.text import Text
    from matplotlib.ticker import FixedFormatter

    texts = figure.findobj(Text)  # makes the ticks
    axes = [axis for own in figure.axes for axis in (own.xaxis, own.yaxis)]
    powers = {
        id(label)
        for axis in axes
        if not isinstance(axis.get_major_formatter(), FixedFormatter)
        for tick in (*axis.majorTicks, *axis.minorTicks)
        for label in (tick.label1, tick.label2)
    }
    for text in texts:
        if id(text) not in powers:
            text.set_parse_math(False)


def png_of(figure: Figure) -> bytes:
    """Return the figure as a PNG of 110 dots per inch."""
    _literal(figure)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=110)
    return picture.getvalue()


def _write_svg(figure: Figure, file: io.BytesIO) -> None:
    """Write the figure as SVG with text as text.

    Areas are pictures inside it where they have many corners; contours stay lines up to that many each.
    """
    from matplotlib import rc_context
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.contour import ContourSet

    areas = [cells for axes in figure.axes for cells in axes.collections]
    corners = [sum(np.size(path.vertices) // 2 for path in cells.get_paths()) for cells in areas]
    for cells, count in zip(areas, corners, strict=True):
        few = _MANY if isinstance(cells, ContourSet) else _FEW
        cells.set_rasterized(bool(sum(corners) > _MANY and count > few))
    _literal(figure)
    with (
        rc_context({"svg.fonttype": "none", "svg.hashsalt": "swashfilm", "font.sans-serif": _FONTS}),
        _canvas(figure, FigureCanvasSVG, 110) as canvas,
    ):
        canvas.print_svg(file, metadata=_PLAIN)  # lays out and draws at once


def _shortened(svg: bytes) -> bytes:
    """Return an SVG without blanks between its elements and names of them, its paths to a tenth of a point."""
    short = _PATH.sub(lambda path: _BLANKS.sub(rb"\1", _LONG.sub(rb"\1", path[0])), svg)
    return _NAMES.sub(b"", _BETWEEN.sub(b"><", short))


def compact(figure: Figure) -> bytes:
    """Return the figure as SVG where it shows no field and is not LARGE; otherwise as WebP, of lines without loss."""
    areas = [area for axes in figure.axes for area in axes.collections]
    if any(kept_field(area) or area.get_rasterized() for area in areas):
        pixels = _drawn(figure, max(_FIELD_DPI, FEWEST_PIXELS / figure.get_figwidth()))
        return _webp(pixels, quality=_FIELD_QUALITY, method=6)
    if (vector := _small_svg(figure)) is not None:
        return vector
    figure.set_layout_engine("none")  # it is laid out already
    return _webp(_drawn(figure, _LINES_DPI).quantize(_INKS).convert("RGB"), quality=_FIELD_QUALITY, lossless=True)


def _small_svg(figure: Figure) -> bytes | None:
    """Return the figure as SVG, None where it is LARGE; a much larger one is not drawn to its end."""
    file = _Bounded()
    try:
        _write_svg(figure, file)
    except _Exceeded:
        return None
    vector = _shortened(file.getvalue())
    return vector if len(vector) <= LARGE else None


class _Exceeded(Exception):
    """A file exceeds its limit."""


class _Bounded(io.BytesIO):
    """A file of at most _LONGEST bytes; writing more raises _Exceeded."""

    def write(self, more: Buffer, /) -> int:
        """Write more bytes; return their number."""
        written = super().write(more)
        if self.tell() > _LONGEST:
            raise _Exceeded
        return written


def _drawn(figure: Figure, dpi: float) -> Image:
    """Return the pixels of a figure at so many dots per inch; no file comes between."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL.Image import fromarray

    with _canvas(figure, FigureCanvasAgg, dpi) as canvas:
        canvas.draw()
        return fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")


@contextmanager
def _canvas(figure: Figure, kind: type[Canvas], dpi: float) -> Iterator[Canvas]:
    """Put a figure on a canvas of this kind, which draws it once and lays it out then, and back on its own one."""
    own, usual = figure.canvas, figure.dpi
    figure.dpi = dpi
    try:
        yield kind(figure)
    finally:
        figure.set_canvas(own)
        figure.dpi = usual


def _webp(pixels: Image, **how: Any) -> bytes:
    """Return a picture as WebP."""
    picture = io.BytesIO()
    pixels.save(picture, format="WEBP", **how)
    return picture.getvalue()


def smaller(picture: bytes) -> bytes:
    """Return a picture of a folder as WebP for its page."""
    from PIL import Image

    try:
        pixels = Image.open(io.BytesIO(picture)).convert("RGB")
    except Image.DecompressionBombError as reason:
        raise ValueError(str(reason)) from None
    return _webp(pixels, quality=_FIELD_QUALITY, method=6)
