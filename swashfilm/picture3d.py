"""A 3D picture of a film, drawn by pyvista in a child process.

VTK ends the whole process with a segmentation fault where the machine lacks graphics libraries; in a child
that costs the picture and nothing else. The child is this module run as a program.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

REMEDY = "install the graphics libraries (Debian: apt-get install libegl1 libgl1-mesa-dri) and run it again"
PATIENCE = 120.0  # s; drawing takes two, software rendering of a large mesh some ten


@dataclass(frozen=True)
class Field:
    """A field of a VTU file as a picture shows it: its name, the factor to the unit shown, and that unit."""

    name: str
    factor: float
    unit: str


PRESSURE = Field("film_pressure", 1e-6, "MPa")
THICKNESS = Field("film_thickness", 1e6, "um")


@dataclass(frozen=True)
class Picture:
    """What became of a picture: its file, or None and why not, with what to do."""

    path: Path | None
    reason: str


def draw(
    films: Sequence[Path],
    picture: Path,
    field: Field = PRESSURE,
    *,
    patience: float = PATIENCE,
    child: Sequence[str] = (sys.executable, "-m", "swashfilm.picture3d"),
) -> Picture:
    """Draw VTU films into a PNG, coloured by a field with its unit; never fails but by telling so.

    Afterwards the picture is there, or `reason` says why not: the child died (no graphics libraries), took
    longer than `patience` s, or could not read the files. `child` is the program that draws.
    """
    words = [*child, str(picture), field.name, repr(field.factor), field.unit, *map(str, films)]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=patience, check=False)
    except subprocess.TimeoutExpired:
        return Picture(None, f"no 3D picture: drawing took longer than {patience:g} s; {REMEDY}")
    if done.returncode == 0 and picture.is_file():
        return Picture(picture, "")
    picture.unlink(missing_ok=True)
    if done.returncode < 0:
        died = signal.Signals(-done.returncode).name
        return Picture(None, f"no 3D picture: the drawing process died ({died}); {REMEDY}")
    last = (done.stderr.strip().splitlines() or ["no message"])[-1]
    return Picture(None, f"no 3D picture: {last}; {REMEDY}")


def _draw_here(picture: Path, field: Field, films: Sequence[Path]) -> None:
    """Draw in this process, which VTK may end."""
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
            lighting=False,  # a shadow would be read as a value
            scalar_bar_args={
                "title": title, "vertical": True, "fmt": "%.3g", "color": "black", "title_font_size": 18,
                "label_font_size": 16, "position_x": 0.8, "position_y": 0.2, "height": 0.6, "width": 0.08,
            },
        )  # fmt: skip
    plotter.background_color = "white"
    plotter.add_axes(color="black")
    plotter.view_isometric()
    plotter.screenshot(str(picture))


def _main(words: Sequence[str]) -> None:
    picture, name, factor, unit, *films = words
    os.environ.setdefault("PYVISTA_OFF_SCREEN", "true")
    _draw_here(Path(picture), Field(name, float(factor), unit), [Path(film) for film in films])


if __name__ == "__main__":
    _main(sys.argv[1:])
