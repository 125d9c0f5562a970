"""3D pictures of films between translucent solids, drawn by pyvista in a child process.

VTK ends the whole process with a segmentation fault where the machine lacks graphics libraries. In a child process
only the picture is lost. The child is `swashfilm.output.scenes.plotter3d`.
"""

import json
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from system.inputs.shown import shown_in, titled

REMEDY = "install the graphics libraries (Debian: apt-get install libegl1 libgl1-mesa-dri) and run it again"
PATIENCE = 120.0  # s; a picture takes about 2 s, a turn about 8 s, software rendering of a large mesh longer


@dataclass(frozen=True)
class PictureField:
    """A field of a VTU file in a picture: its head there, the factor to the unit of the picture, and its title."""

    head: str
    factor: float
    title: str


def picture_field(words: str, unit: str) -> PictureField:
    """Return the field `words` of VTU files, in SI there, in the unit of pictures."""
    shown = shown_in(unit, words)
    return PictureField(f"{words.replace(' ', '_')} [{unit}]", shown.factor, titled(words, shown.unit))


def pressure_field() -> PictureField:
    """Return the pressure of films."""
    return picture_field("film pressure", "Pa")


@dataclass(frozen=True)
class Solid:
    """A VTU file of a body, its colour and its opacity."""

    path: Path
    colour: str
    opacity: float


@dataclass(frozen=True)
class Frame:
    """A view: VTU films in the colours of a field, translucent solids, marks (a text, and the film it stands at)."""

    films: Sequence[Path]
    solids: Sequence[Solid] = ()
    marks: Sequence[tuple[str, Path]] = ()
    title: str = ""


@dataclass(frozen=True)
class Pictures:
    """Files of the pictures; without any, the reason and the remedy."""

    paths: tuple[Path, ...]
    reason: str


class Painter:
    """A process that draws in parallel: give it the drawings, and fetch the pictures later."""

    def __init__(self, process: subprocess.Popen[str], beside: Executor, patience: float) -> None:
        self._process, self._beside, self._patience = process, beside, patience
        self._wanted: tuple[Path, ...] = ()
        self._done: Future[tuple[str, str]] | None = None

    def begin(self, drawings: Mapping[Path, Sequence[Frame]]) -> None:
        """Begin pictures of one frame (PNG) or of several (animated WebP), once; return at once."""
        jobs = {str(path): [asdict(one) for one in frames] for path, frames in drawings.items()}
        self._wanted = tuple(drawings)
        self._done = self._beside.submit(self._process.communicate, json.dumps(jobs, default=str), self._patience)

    def pictures(self) -> Pictures:
        """Wait for the pictures begun.

        Raises no exception. Afterwards all pictures exist, or none exists and `reason` names the cause: the process
        died (no graphics libraries), took longer than its patience, or could not read the files.
        """
        assert self._done is not None, "no drawing has begun"
        try:
            _, told = self._done.result()
        except subprocess.TimeoutExpired:
            return self._none(f"drawing took longer than {self._patience:g} s")
        ended = self._process.returncode
        if ended == 0 and all(picture.is_file() for picture in self._wanted):
            return Pictures(self._wanted, "")
        if ended < 0:
            return self._none(f"the drawing process died ({signal.Signals(-ended).name})")
        return self._none((told.strip().splitlines() or ["no message"])[-1])

    def _none(self, why: str) -> Pictures:
        self._process.kill()
        for picture in self._wanted:
            picture.unlink(missing_ok=True)
        return Pictures((), f"{why}; {REMEDY}")


@contextmanager
def painter(
    field: PictureField | None = None,
    *,
    patience: float = PATIENCE,
    child: Sequence[str] = (sys.executable, "-m", "swashfilm.output.scenes.plotter3d"),
) -> Iterator[Painter]:
    """Start a process that draws films in the colours of a field (pressure), which ends with the context.

    patience: s that the pictures may take; child: the program that draws.
    """
    field = field or pressure_field()
    words = [*child, field.head, repr(field.factor), field.title]
    pipe = subprocess.PIPE
    with (
        ThreadPoolExecutor(1) as beside,
        subprocess.Popen(words, stdin=pipe, stdout=pipe, stderr=pipe, text=True) as process,
    ):
        try:
            yield Painter(process, beside, patience)
        finally:
            process.kill()


def draw(drawings: Mapping[Path, Sequence[Frame]], field: PictureField | None = None) -> Pictures:
    """Draw pictures and wait for them, as a `Painter`."""
    with painter(field) as one:
        one.begin(drawings)
        return one.pictures()
