"""3D pictures of films between translucent solids, drawn by pyvista in a child process.

VTK ends the whole process with a segmentation fault where the machine lacks graphics libraries. In a child process
only the picture is lost. The child is `swashfilm.output.scenes.plotter3d`.
"""

import json
import signal
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
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


def thickness_field() -> PictureField:
    """Return the thickness of films."""
    return picture_field("film thickness", "m")


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


def draw(
    drawings: Mapping[Path, Sequence[Frame]],
    field: PictureField | None = None,
    *,
    patience: float = PATIENCE,
    child: Sequence[str] = (sys.executable, "-m", "swashfilm.output.scenes.plotter3d"),
) -> Pictures:
    """Draw pictures of one frame (PNG) or of several (animated WebP) with films in the colours of a field (pressure).

    Raises nothing. Afterwards all pictures exist, or none exists and `reason` names the cause: the child process died
    (no graphics libraries), took longer than `patience` s, or could not read the files. `child` is the program that
    draws.
    """
    jobs = json.dumps({str(path): [asdict(one) for one in frames] for path, frames in drawings.items()}, default=str)
    field = field or pressure_field()
    words = [*child, field.head, repr(field.factor), field.title]
    try:
        done = subprocess.run(words, input=jobs, capture_output=True, text=True, timeout=patience, check=False)
    except subprocess.TimeoutExpired:
        return _none(drawings, f"drawing took longer than {patience:g} s")
    if done.returncode == 0 and all(picture.is_file() for picture in drawings):
        return Pictures(tuple(drawings), "")
    if done.returncode < 0:
        return _none(drawings, f"the drawing process died ({signal.Signals(-done.returncode).name})")
    return _none(drawings, (done.stderr.strip().splitlines() or ["no message"])[-1])


def _none(drawings: Iterable[Path], why: str) -> Pictures:
    for picture in drawings:
        picture.unlink(missing_ok=True)
    return Pictures((), f"{why}; {REMEDY}")
