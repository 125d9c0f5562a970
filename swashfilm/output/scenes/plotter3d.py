"""The program that draws 3D pictures: a `picture3d.painter` runs it in a process of its own, which VTK may end."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.scenes.picture3d import Frame, PictureField, Solid

SIZE, MOVING = (1000, 760), (720, 548)  # pixels of a picture and of an animation
FRAME_TIME = 120  # ms, of an animation
BEYOND = 0.02  # of the vertices between solids: their values may lie above the scale
TOWARDS = np.array([0.30, -1.0, 0.42])
"""Direction of the camera from the middle of solids: from the delivery side of a pump, at negative y."""
COLOURS = "viridis"


def main(words: Sequence[str]) -> None:
    """Draw the pictures of the standard input, JSON of frames by path."""
    os.environ.setdefault("PYVISTA_OFF_SCREEN", "true")
    os.environ.setdefault("LP_NUM_THREADS", "0")  # of software rendering: more of them wait for each other
    import pyvista  # noqa: F401, while the drawings are on their way

    head, factor, title = words
    field = PictureField(head, float(factor), title)
    for path, frames in json.load(sys.stdin).items():
        _save(Path(path), field, [_frame(one) for one in frames])


def _frame(raw: dict[str, Any]) -> Frame:
    solids = [Solid(Path(one["path"]), one["colour"], one["opacity"]) for one in raw["solids"]]
    marks = [(text, Path(path)) for text, path in raw["marks"]]
    return Frame([Path(film) for film in raw["films"]], solids, marks, raw["title"])


def _save(path: Path, field: PictureField, frames: Sequence[Frame]) -> None:
    """Write one frame as it is, several as an animation."""
    from PIL import Image

    pictures = [Image.fromarray(one) for one in _drawn(field, frames, SIZE if len(frames) == 1 else MOVING)]
    if len(pictures) == 1:
        pictures[0].save(path, format="PNG")
    else:
        pictures[0].save(
            path, format="WEBP", save_all=True, append_images=pictures[1:], duration=FRAME_TIME, loop=0, quality=60
        )


def _drawn(field: PictureField, frames: Sequence[Frame], size: tuple[int, int]) -> Iterator[Array]:
    """Yield the picture of each frame, (height, width, 3) of 0 to 255, all on one scale and from one place."""
    import pyvista

    pyvista.OFF_SCREEN = True
    plotter: Any = pyvista.Plotter(off_screen=True, window_size=size)
    plotter.background_color = "white"
    limits = _limits(field, frames)
    actors: dict[Solid, Any] = {}  # a solid of several frames is uploaded once
    for number, frame in enumerate(frames):
        plotter.scalar_bars.clear()
        plotter.clear_actors()
        plotter.suppress_rendering = True  # until the frame is complete
        _add_films(plotter, field, frame, limits, size)
        for solid in _from_behind(frame.solids):
            if solid in actors:
                plotter.add_actor(actors[solid], reset_camera=False, render=False)
            else:
                actors[solid] = plotter.add_mesh(_read(solid.path), color=solid.colour, opacity=solid.opacity)
        _add_texts(plotter, frame, size)
        if number == 0:
            _look(plotter, frame)
        plotter.suppress_rendering = False
        plotter.render()
        yield plotter.screenshot(return_img=True)
    plotter.close()


def _add_films(plotter: Any, field: PictureField, frame: Frame, limits: tuple[float, float], size: Any) -> None:
    """Add the films, unshaded: a shadow would look like another value."""
    import pyvista

    films = pyvista.merge([_film(field, path) for path in frame.films])
    font = size[1] // 45
    actor = plotter.add_mesh(
        films, scalars=field.title, clim=limits, cmap=COLOURS, lighting=False,
        scalar_bar_args={
            "title": field.title, "vertical": True, "fmt": "%.3g", "color": "black", "title_font_size": font + 2,
            "label_font_size": font, "position_x": 0.85, "position_y": 0.2, "height": 0.6, "width": 0.07,
            "n_labels": 5,
        },
    )  # fmt: skip
    # Before the walls that they touch.
    actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-4.0, -40.0)


def _add_texts(plotter: Any, frame: Frame, size: tuple[int, int]) -> None:
    """Add title and marks."""
    font = size[1] // 45
    if frame.title:
        plotter.add_text(frame.title, position="upper_left", font_size=font * 0.6, color="black")
    if frame.marks:
        places = [_read(film).points.mean(axis=0) for _, film in frame.marks]
        plotter.add_point_labels(
            np.array(places), [text for text, _ in frame.marks], show_points=False, shape=None, always_visible=True,
            text_color="black", font_size=font, bold=True, name="marks",
        )  # fmt: skip


def _look(plotter: Any, frame: Frame) -> None:
    """Turn the camera: at a pump between solids upright, at films alone along a diagonal."""
    plotter.add_axes(color="black")
    if frame.solids:
        plotter.view_vector(TOWARDS, viewup=(0.0, 0.0, 1.0))
        plotter.camera.zoom(1.25)
    else:
        plotter.view_isometric()
        plotter.camera.zoom(0.8)  # room for the scale beside the films


def _limits(field: PictureField, frames: Sequence[Frame]) -> tuple[float, float]:
    """Return the ends of the scale; between solids a few values lie above it."""
    values = np.concatenate([_film(field, path)[field.title] for path in {p for one in frames for p in one.films}])
    low, high = float(values.min()), float(values.max())
    if not frames[0].solids:
        return low, high
    return low, float(np.quantile(values, 1.0 - BEYOND))


def _from_behind(solids: Sequence[Solid]) -> list[Solid]:
    """Return the solids from the farthest to the nearest: colours of translucent ones mix in that order."""
    return sorted(solids, key=lambda solid: float(_read(solid.path).center @ TOWARDS))


@cache
def _read(path: Path) -> Any:
    import pyvista

    return pyvista.read(path).extract_surface(algorithm="dataset_surface")


@cache
def _film(field: PictureField, path: Path) -> Any:
    """Return a film with the field in the unit of the picture and no other."""
    film = _read(path).copy()
    values = np.asarray(film.point_data[field.head]) * field.factor
    film.clear_data()
    film.point_data[field.title] = values
    return film


if __name__ == "__main__":
    main(sys.argv[1:])
