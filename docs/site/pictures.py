"""Common parts of the gallery and of the example pages: a command's run folder, and a thumbnail of its picture."""

from __future__ import annotations

import io
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import matplotlib
from matplotlib import pyplot
from PIL import Image

import swashfilm as sf
from swashfilm.output.figures import png_of

matplotlib.use("Agg")

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
WHOLE = (0.0, 0.0, 1.0, 1.0)
COLOURS = 64


@contextmanager
def ran(command: str) -> Iterator[Path]:
    """Run a command of the program, without its own name; its run folder lasts as long as the context."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "run"
        words = [sys.executable, "-m", "swashfilm", *shlex.split(command), "-o", str(folder)]
        subprocess.run(words, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        yield folder


def picture(folder: Path, name: str) -> bytes:
    """Return a picture of a run folder as PNG.

    name: a file of the folder, or a method of its result that draws, with its arguments.
    """
    if (file := folder / name).suffix:
        return file.read_bytes()
    method, *words = name.split()
    figure = getattr(sf.open(folder), method)(*words)[0].figure
    pyplot.close(figure)
    return png_of(figure)


def write_thumbnail(picture: bytes, path: Path, width: int, part: tuple[float, float, float, float] = WHOLE) -> None:
    """Write a picture in few colours, no side longer than `width` pixels.

    part: left, top, right, bottom of what is shown, as shares of the picture.
    """
    whole = Image.open(io.BytesIO(picture)).convert("RGB")
    (wide, tall), (left, top, right, bottom) = whole.size, part
    shown = whole.crop((round(left * wide), round(top * tall), round(right * wide), round(bottom * tall)))
    shown.thumbnail((width, width))
    shown.quantize(COLOURS).save(path, optimize=True)
