"""Pictures of one pixel in place of drawn ones: layout and rendering take most of the time of a short run."""

from __future__ import annotations

import functools
import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from PIL import Image

from swashfilm.output import figures
from swashfilm.output.scenes.picture3d import Frame, Pictures
from swashfilm.runs.pump import run

SVG = b'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg"/>'
DRAWN = {(Figure, "savefig"): Figure.savefig} | {
    (figures, name): getattr(figures, name) for name in ("_small_svg", "_drawn")
}
"""What renders figures, by its place."""


def _png() -> bytes:
    picture = io.BytesIO()
    Image.new("RGB", (1, 1), "white").save(picture, format="PNG")
    return picture.getvalue()


PNG = _png()


@contextmanager
def blank_pictures() -> Iterator[None]:
    """Figures of pages and 3D pictures of pumps are blank."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", _saved)
        patch.setattr(figures, "_small_svg", lambda figure: SVG)
        patch.setattr(figures, "_drawn", lambda figure, dpi: Image.new("RGB", (1, 1), "white"))
        patch.setattr(run, "painter", _painter)
        yield


@contextmanager
def rendered_figures() -> Iterator[None]:
    """Figures are rendered in full, also where they are blank around."""
    with pytest.MonkeyPatch.context() as patch:
        for (place, name), drawn in DRAWN.items():
            patch.setattr(place, name, drawn)
        yield


@functools.wraps(Figure.savefig)
def _saved(figure: Figure, target: object, **how: object) -> None:
    if how.get("format") == "png" and isinstance(target, io.BytesIO):
        target.write(PNG)
    else:
        DRAWN[Figure, "savefig"](figure, target, **how)


class BlankPainter:
    """A painter of blank pictures of frames whose files are all there."""

    wanted: tuple[Path, ...] = ()

    def begin(self, drawings: Mapping[Path, Sequence[Frame]]) -> None:
        """Write the pictures."""
        for path, frames in drawings.items():
            shown = [file for frame in frames for file in (*frame.films, *(solid.path for solid in frame.solids))]
            assert shown
            assert all(file.is_file() for file in shown)
            path.write_bytes(PNG)
        self.wanted = tuple(drawings)

    def pictures(self) -> Pictures:
        """All that were begun."""
        return Pictures(self.wanted, "")


@contextmanager
def _painter() -> Iterator[BlankPainter]:
    yield BlankPainter()
