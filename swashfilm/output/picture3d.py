"""3D picture of a film, drawn by pyvista in a child process.

VTK ends the whole process with a segmentation fault where the machine lacks graphics libraries. In a child process
only the picture is lost. The child runs this module as a program.
"""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

REMEDY = "install the graphics libraries (Debian: apt-get install libegl1 libgl1-mesa-dri) and run it again"
PATIENCE = 120.0  # s; drawing takes about 2 s, software rendering of a large mesh about 10 s


@dataclass(frozen=True)
class PictureField:
    """A field of a VTU file in a picture: its name, the factor to the unit of the picture, and that unit."""

    name: str
    factor: float
    unit: str


PRESSURE = PictureField("film_pressure", 1e-6, "MPa")
THICKNESS = PictureField("film_thickness", 1e6, "um")


@dataclass(frozen=True)
class Pictures:
    """Files of the pictures; without any, the reason and the remedy."""

    paths: tuple[Path, ...]
    reason: str


def draw(
    drawings: Mapping[Path, Sequence[Path]],
    field: PictureField = PRESSURE,
    *,
    patience: float = PATIENCE,
    child: Sequence[str] = (sys.executable, "-m", "swashfilm.output.picture3d"),
) -> Pictures:
    """Draw PNGs, each of some VTU films, coloured by a field with its unit; raise nothing.

    Afterwards all pictures exist, or none exists and `reason` names the cause: the child process died (no graphics
    libraries), took longer than `patience` s, or could not read the files. `child` is the program that draws.
    """
    jobs = json.dumps({str(picture): [str(film) for film in films] for picture, films in drawings.items()})
    words = [*child, field.name, repr(field.factor), field.unit, jobs]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=patience, check=False)
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
    return Pictures((), f"no 3D picture: {why}; {REMEDY}")


def _draw_here(picture: Path, field: PictureField, films: Sequence[Path]) -> None:
    """Draw in this process; VTK may end it."""
    import pyvista

    pyvista.OFF_SCREEN = True
    plotter = pyvista.Plotter(off_screen=True, window_size=(1000, 760))
    meshes = [pyvista.read(film) for film in films]
    for mesh in meshes:
        mesh[field.name] = mesh[field.name] * field.factor
    lowest = min(float(mesh[field.name].min()) for mesh in meshes)
    highest = max(float(mesh[field.name].max()) for mesh in meshes)
    title = f"{field.name.replace('_', ' ')} / {field.unit}"
    for number, mesh in enumerate(meshes):
        plotter.add_mesh(
            mesh, scalars=field.name, clim=(lowest, highest), cmap="viridis", show_scalar_bar=number == 0,
            lighting=False,  # a shadow would look like another value
            scalar_bar_args={
                "title": title, "vertical": True, "fmt": "%.3g", "color": "black", "title_font_size": 18,
                "label_font_size": 16, "position_x": 0.82, "position_y": 0.2, "height": 0.6, "width": 0.08,
            },
        )  # fmt: skip
    plotter.background_color = "white"
    plotter.add_axes(color="black")
    plotter.view_isometric()
    plotter.camera.zoom(0.8)  # room for the scale beside the films
    plotter.screenshot(str(picture))
    plotter.close()


def _main(words: Sequence[str]) -> None:
    name, factor, unit, jobs = words
    os.environ.setdefault("PYVISTA_OFF_SCREEN", "true")
    for picture, films in json.loads(jobs).items():
        _draw_here(Path(picture), PictureField(name, float(factor), unit), [Path(film) for film in films])


if __name__ == "__main__":
    _main(sys.argv[1:])
