"""Pictures of one pixel in place of drawn ones: layout and rendering take most of the time of a short run."""

from __future__ import annotations

import functools
import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imsave

from swashfilm.output.scenes.picture3d import Frame, Pictures
from swashfilm.runs.pump.scene import views


def _pixel() -> bytes:
    picture = io.BytesIO()
    imsave(picture, np.ones((1, 1, 3)), format="png")
    return picture.getvalue()


BLANK = {"png": _pixel(), "svg": b'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg"/>'}


@contextmanager
def blank_pictures() -> Iterator[None]:
    """Figures that are saved to memory, and 3D pictures of pumps, are blank."""
    save = Figure.savefig

    @functools.wraps(save)
    def blank(figure: Figure, target: object, **how: object) -> None:
        if isinstance(target, io.BytesIO) and how.get("format") in BLANK:
            target.write(BLANK[str(how["format"])])
        else:
            save(figure, target, **how)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", blank)
        patch.setattr(views, "draw", _undrawn)
        yield


@contextmanager
def rendered_figures() -> Iterator[None]:
    """Figures are rendered in full, also where they are blank around."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", getattr(Figure.savefig, "__wrapped__", Figure.savefig))
        yield


def _undrawn(drawings: Mapping[Path, Sequence[Frame]]) -> Pictures:
    """Blank pictures of frames whose files are all there."""
    for path, frames in drawings.items():
        shown = [file for frame in frames for file in (*frame.films, *(solid.path for solid in frame.solids))]
        assert shown
        assert all(file.is_file() for file in shown)
        path.write_bytes(BLANK["png"])
    return Pictures(tuple(drawings), "")
